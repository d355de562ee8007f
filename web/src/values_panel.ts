// SPDX-License-Identifier: BSD-3-Clause
// The numbers of the current sample: wrenches, and the joint configuration.

import { seriesColour } from "./colours";
import { el, spoken } from "./dom";
import type { Drawable, Frames } from "./frames";
import { UNIT, type Quantity, type SceneData } from "./scene_data";
import type { Sensor } from "./scene_types";
import type { Store } from "./store";

const DEGREES = 180 / Math.PI;

/** Table of the chosen quantity, one row per series. */
export class ValuesPanel implements Drawable {
  readonly root = el("div", { class: "values" });

  constructor(
    private readonly data: SceneData,
    private readonly store: Store,
    frames: Frames,
  ) {
    store.on(["sample", "sensor", "quantity", "hidden"], () => frames.later(this));
  }

  draw(): void {
    const { sample, sensor: place, quantity, hidden } = this.store.state;
    const sensor = this.data.sensor(place);
    const letter = quantity === "force" ? "f" : "t";
    const head = [`${letter}x`, `${letter}y`, `${letter}z`, `|${letter}|`];
    const rows = (sensor?.wrenches ?? [])
      .filter((series) => !hidden.has(series.name))
      .map((series) => {
        const vector = this.data.vector(series, sample, quantity);
        const cells = [...vector, Math.hypot(...vector)].map((value) => el("td", {}, shown(value, quantity)));
        const chip = el("span", { class: "chip" });
        chip.style.background = sensor ? seriesColour(sensor, series) : "";
        return el("tr", {}, el("th", { scope: "row", title: series.name }, chip, spoken(series.name)), ...cells);
      });
    this.root.replaceChildren(
      el(
        "table",
        {},
        el("caption", {}, `${quantity === "force" ? "Force" : "Torque"} [${UNIT[quantity]}]${acts(sensor)}`),
        el("thead", {}, el("tr", {}, el("th", { scope: "col" }, spoken("series")), ...head.map((text) => el("th", { scope: "col" }, text)))),
        el("tbody", {}, ...rows),
      ),
    );
  }
}

/** Table of the joints, drawn only while it is open. */
export class JointsPanel implements Drawable {
  readonly root: HTMLDetailsElement;
  private readonly body = el("tbody");

  constructor(
    private readonly data: SceneData,
    private readonly store: Store,
    frames: Frames,
  ) {
    const table = el("table", {}, this.body);
    this.root = el("details", {}, el("summary", {}, `Joint configuration (${data.scene.coordinates.length})`), table);
    this.root.addEventListener("toggle", () => frames.later(this));
    store.on(["sample"], () => frames.later(this));
  }

  draw(): void {
    if (!this.root.open) return;
    const { sample } = this.store.state;
    this.body.replaceChildren(
      ...this.data.scene.coordinates.map((name, k) => {
        const value = this.data.position(sample, k);
        const length = this.data.isLength(k);
        const text = Number.isNaN(value)
          ? "absent"
          : length
            ? `${value.toFixed(4)} m`
            : `${(value * DEGREES).toFixed(2)}°`;
        return el("tr", {}, el("th", { scope: "row" }, name), el("td", {}, text));
      }),
    );
  }
}

/** Who acts on whom: arrows and numbers of sensors are of either sign. */
function acts(sensor: Sensor | undefined): string {
  if (!sensor) return "";
  return sensor.acting === null ? ` unexplained on ${sensor.acted_on}` : ` of ${sensor.acting} on ${sensor.acted_on}`;
}

function shown(value: number, quantity: Quantity): string {
  return Number.isFinite(value) ? value.toFixed(quantity === "force" ? 2 : 3) : "–";
}
