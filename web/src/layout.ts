// SPDX-License-Identifier: BSD-3-Clause
// Where everything is on the page.

import { button, choice, el } from "./dom";
import { COMPONENTS, expectedOf } from "./columns";
import { goToContact, goToEvent, goToWorst, keysOf } from "./keyboard";
import type { Shown } from "./plots";
import type { Quantity, SceneData } from "./scene_data";
import type { Large, Store } from "./store";

/** Columns of the time plots. */
const KINDS: readonly Shown["kind"][] = ["error", "measured"];

/** A panel with what is drawn in it. */
export interface Plot {
  readonly panel: HTMLElement;
  readonly shown: Shown;
}

/** Panels into which views are drawn. */
export interface Panels {
  readonly robot: HTMLElement;
  readonly space: HTMLElement;
  readonly planes: readonly HTMLElement[];
  /** Strips of intervals above the plots. */
  readonly strips: readonly HTMLElement[];
  /** Contacts on skin under the strips; none where the scene has no skin. */
  readonly rasters: readonly HTMLElement[];
  readonly plots: readonly Plot[];
  readonly side: HTMLElement;
  /** Text over the robot that says how long arrows are. */
  readonly scale: HTMLElement;
  /** Titles of the robot and of the space, where buttons may be added. */
  readonly robotTitle: HTMLElement;
  readonly spaceTitle: HTMLElement;
  readonly status: HTMLElement;
  readonly app: HTMLElement;
}

/** Build the page; `footer` moves along the recording. */
export function layout(data: SceneData, store: Store, footer: (say: (text: string) => void) => HTMLElement): Panels {
  const status = el("p", { role: "status", class: "status" });
  const robot = el("div", { class: "view" });
  const space = el("div", { class: "view" });
  const scale = el("p", { class: "overlay" });
  const planes = [0, 1, 2].map(() => el("div", { class: "view" }));
  const times = timePlots(data, store);
  const side = el("aside", { class: "side", "aria-label": "Details" });
  const robotTitle = el("div", { class: "tools" });
  const spaceTitle = el("div", { class: "tools" });
  const views = el(
    "div",
    { class: "views" },
    panel(store, "Robot", "robot", robotTitle, robot, scale),
    panel(store, "Force space", "space", spaceTitle, space),
    panel(store, "Planes", "planes", el("div", { class: "tools" }), el("div", { class: "three" }, ...planes)),
  );
  // without sensors there is neither force space nor a course of forces: skin alone has the page to itself
  views.classList.toggle("robot-alone", data.scene.sensors.length === 0);
  store.on(["large"], () => {
    views.dataset["large"] = store.state.large ?? "";
  });
  const app = el(
    "div",
    { class: "app" },
    header(data, store),
    el("main", {}, views, times.root),
    side,
    footer((text) => {
      status.textContent = text;
    }),
  );
  store.on(["quantity"], () => {
    const heading = app.querySelector(".space h2");
    if (heading) heading.textContent = store.state.quantity === "force" ? "Force space" : "Torque space";
  });
  const { strips, rasters, plots } = times;
  return { robot, space, planes, strips, rasters, plots, side, scale, robotTitle, spaceTitle, status, app };
}

function header(data: SceneData, store: Store): HTMLElement {
  if (data.scene.sensors.length === 0) return el("header", {}, el("h1", { title: data.scene.title }, data.scene.title), keysList(data));
  const sensors = data.scene.sensors.map((s, k) => [String(k), s.serial ? `${s.name} (${s.serial})` : s.name] as const);
  const sensor = choice("Sensor", sensors, "0", (value) => store.set({ sensor: Number(value) }));
  store.on(["sensor"], () => {
    sensor.value = String(store.state.sensor);
  });
  const quantity = el("span", { class: "segments", role: "radiogroup", "aria-label": "Quantity" });
  for (const [value, text] of [
    ["force", "Force"],
    ["moment", "Torque"],
  ] as const) {
    const radio = el("input", { type: "radio", name: "quantity", value });
    radio.addEventListener("change", () => store.set({ quantity: value satisfies Quantity }));
    store.on(["quantity"], () => {
      radio.checked = store.state.quantity === value;
    });
    quantity.append(el("label", {}, radio, el("span", {}, text)));
  }
  return el("header", {}, el("h1", { title: data.scene.title }, data.scene.title), sensor, quantity, keysList(data));
}

function keysList(data: SceneData): HTMLElement {
  return el(
    "details",
    { class: "keys" },
    el("summary", {}, "Keys"),
    el("dl", {}, ...keysOf(data).flatMap(([key, does]) => [el("dt", {}, key), el("dd", {}, does)])),
  );
}

/** Errors on the left, wrenches on the right: a row for each component, those of moments shown when enlarged too. Where
 *  no wrench is expected, as of a stream, forces on the left and moments on the right; without sensors the time alone. */
function timePlots(data: SceneData, store: Store): { root: HTMLElement } & Pick<Panels, "strips" | "rasters" | "plots"> {
  // both show the same: one is enough for who listens
  const { live, sensors } = data.scene;
  const kinds = sensors.length > 0 ? KINDS : KINDS.slice(0, 1);
  const strips = kinds.map((kind) => el("div", { class: "strip", "aria-hidden": kind === "error" ? null : "true" }));
  const rasters = hasSkin(data) ? strips.map((_, k) => el("div", { class: "raster", "aria-hidden": k === 0 ? null : "true" })) : [];
  const plots: Plot[] = [];
  const quantities = ["force", "moment"] as const;
  const groups = quantities.map((quantity) => ({ name: `rows ${quantity}`, columns: KINDS.map((kind) => ({ kind, quantity })) }));
  const streamed = { name: "rows", columns: quantities.map((quantity) => ({ kind: "measured", quantity }) as const) };
  const bare = live || !sensors.some(expectedOf);
  const rows = (sensors.length === 0 && !live ? [] : bare ? [streamed] : groups).map(({ name, columns }) => {
    const panels = COMPONENTS.flatMap((component) =>
      columns.map((column) => {
        const last = component === 3;
        const panel = el("div", { class: last ? "plot last" : "plot", "data-kind": column.kind });
        plots.push({ panel, shown: { ...column, component, last } });
        return panel;
      }),
    );
    return el("div", { class: name }, ...panels);
  });
  const when = el("span", { class: "muted" });
  store.on(["sample", "hover"], () => {
    const { sample, hover } = store.state;
    when.textContent = `at ${(data.time[hover ?? sample] ?? 0).toFixed(3)} s`;
  });
  const headings = rows.length === 0 ? ["Time"] : bare ? ["Force", "Torque"] : ["Error: measured − expected", "Measured and expected"];
  const head = el(
    "div",
    { class: "heading columns" },
    ...headings.map((text, k) => el("h2", {}, text, ...(k === 0 ? [" ", when] : []))),
    timeTools(data, store),
  );
  const above = live ? [head] : [head, el("div", { class: "strips" }, ...strips, ...rasters)];
  const root = el("section", { class: live ? "times live" : bare ? "times bare" : "times", "aria-label": "Time plots" }, ...above, ...rows);
  store.on(["quantity"], () => {
    root.dataset["quantity"] = store.state.quantity;
  });
  return { root, strips: live ? [] : strips, rasters, plots };
}

function hasSkin({ scene }: SceneData): boolean {
  return !scene.live && scene.skin.length + scene.skin_events.length > 0;
}

function timeTools(data: SceneData, store: Store): HTMLElement {
  const unzoom = button("Whole recording", () => store.set({ window: data.span }));
  store.on(["window"], () => {
    const [start, end] = data.span;
    unzoom.hidden = store.state.window[0] === start && store.state.window[1] === end;
  });
  const tools = el("div", { class: "tools" }, unzoom);
  if (data.scene.sensors.length > 0 && !data.scene.live) {
    if (data.scene.sensors.some(expectedOf))
      tools.append(button("Worst sample", () => goToWorst(data, store), { title: "Largest error of the validation data in view (w)" }));
    tools.append(button("Next event", () => goToEvent(data, store, 1), { title: "Next interval, finding or saved sample (n)" }));
  }
  if (hasSkin(data))
    tools.append(button("Next contact", () => goToContact(data, store, 1), { title: "Next contact on skin (c)" }));
  if (data.scene.sensors.length > 0) tools.append(largerButton(store, "time plots", "times"));
  return tools;
}

function largerButton(store: Store, title: string, name: Large): HTMLButtonElement {
  const larger = button("⤢", () => store.set({ large: store.state.large === name ? null : name }), {
    "aria-label": `Enlarge ${title}`,
    title: "Enlarge",
  });
  store.on(["large"], () => larger.setAttribute("aria-pressed", String(store.state.large === name)));
  return larger;
}

function panel(
  store: Store,
  title: string,
  name: Large,
  tools: HTMLElement,
  ...content: HTMLElement[]
): HTMLElement {
  tools.append(largerButton(store, title.toLowerCase(), name));
  const heading = el("div", { class: "heading" }, el("h2", {}, title), tools);
  return el("section", { class: `panel ${name}`, "aria-label": title }, heading, ...content);
}
