// SPDX-License-Identifier: BSD-3-Clause
// Where everything is on the page.

import { button, choice, el } from "./dom";
import { KEYS } from "./keyboard";
import type { Quantity, SceneData } from "./scene_data";
import type { Store } from "./store";

/** Panels into which views are drawn. */
export interface Panels {
  readonly robot: HTMLElement;
  readonly space: HTMLElement;
  readonly planes: readonly HTMLElement[];
  readonly strip: HTMLElement;
  readonly plots: readonly HTMLElement[];
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
  const strip = el("div", { class: "strip" });
  const plots = [0, 1, 2].map(() => el("div", { class: "plot" }));
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
  const unzoom = button("Whole recording", () => store.set({ window: data.span }), { class: "unzoom" });
  store.on(["window"], () => {
    const [start, end] = data.span;
    unzoom.hidden = store.state.window[0] === start && store.state.window[1] === end;
  });
  const courses = data.scene.sensors.length === 0 ? [] : plots;
  const time = el("section", { class: "times", "aria-label": "Time plots" }, strip, ...courses, unzoom);
  const app = el(
    "div",
    { class: "app" },
    header(data, store),
    el("main", {}, views, time),
    side,
    footer((text) => {
      status.textContent = text;
    }),
  );
  store.on(["quantity"], () => {
    const heading = app.querySelector(".space h2");
    if (heading) heading.textContent = store.state.quantity === "force" ? "Force space" : "Torque space";
  });
  return { robot, space, planes, strip, plots, side, scale, robotTitle, spaceTitle, status, app };
}

function header(data: SceneData, store: Store): HTMLElement {
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
  const keys = el(
    "details",
    { class: "keys" },
    el("summary", {}, "Keys"),
    el("dl", {}, ...KEYS.flatMap(([key, does]) => [el("dt", {}, key), el("dd", {}, does)])),
  );
  return el("header", {}, el("h1", { title: data.scene.title }, data.scene.title), sensor, quantity, keys);
}

function panel(
  store: Store,
  title: string,
  name: "robot" | "space" | "planes",
  tools: HTMLElement,
  ...content: HTMLElement[]
): HTMLElement {
  const larger = button("⤢", () => store.set({ large: store.state.large === name ? null : name }), {
    "aria-label": `Enlarge ${title.toLowerCase()}`,
    title: "Enlarge",
  });
  store.on(["large"], () => larger.setAttribute("aria-pressed", String(store.state.large === name)));
  tools.append(larger);
  const heading = el("div", { class: "heading" }, el("h2", {}, title), tools);
  return el("section", { class: `panel ${name}`, "aria-label": title }, heading, ...content);
}
