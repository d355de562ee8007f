// SPDX-License-Identifier: BSD-3-Clause
// Elements of the page, made in one expression.

type Attributes = Readonly<Record<string, string | number | boolean | null>>;

/** Make an element; an attribute of false or null is left out, one of true is empty. */
export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value !== false && value !== null) element.setAttribute(name, value === true ? "" : String(value));
  }
  element.append(...children);
  return element;
}

/** Change a text where it differs: what the user selected stays selected, and a reader aloud is not told twice. */
export function say(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

/** Make a text for who listens, where others see a colour or a picture. */
export function spoken(text: string): HTMLElement {
  return el("span", { class: "spoken" }, text);
}

/** Make a button that says what it does. */
export function button(text: string, action: () => void, attributes: Attributes = {}): HTMLButtonElement {
  const element = el("button", { type: "button", ...attributes }, text);
  element.addEventListener("click", action);
  return element;
}

/** Make a check box inside its label. */
export function checkBox(
  label: (Node | string)[],
  checked: boolean,
  action: (checked: boolean) => void,
  name?: string,
): { row: HTMLLabelElement; box: HTMLInputElement } {
  const box = el("input", { type: "checkbox", "aria-label": name ?? null });
  box.checked = checked;
  box.addEventListener("change", () => action(box.checked));
  return { row: el("label", { class: "check" }, box, ...label), box };
}

/** Make a list to choose one of. */
export function choice(
  label: string,
  options: readonly (readonly [value: string, text: string])[],
  chosen: string,
  action: (value: string) => void,
): HTMLSelectElement {
  const select = el("select", { "aria-label": label });
  for (const [value, text] of options) select.append(el("option", { value }, text));
  select.value = chosen;
  select.addEventListener("change", () => action(select.value));
  return select;
}

/** Offer bytes or text as a file. */
export function download(name: string, content: BlobPart, type: string): void {
  const url = URL.createObjectURL(new Blob([content], { type }));
  const link = el("a", { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}

/** Name of a file beginning with the experiment's title. */
export function fileName(title: string, ending: string): string {
  return `${title.replace(/[^\w.-]+/gu, "_").slice(0, 80) || "experiment"}${ending}`;
}
