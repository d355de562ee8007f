// SPDX-License-Identifier: BSD-3-Clause
// Error of every series in the window of the time plots.

import { seriesColour } from "./colours";
import { COMPONENTS, type Column } from "./columns";
import { button, el, spoken } from "./dom";
import type { Drawable, Frames } from "./frames";
import { UNIT, type SceneData } from "./scene_data";
import type { Sensor, WrenchSeries } from "./scene_types";
import type { Store } from "./store";

/** Tables of rms, mean and largest error, one per series. */
export class StatisticsPanel implements Drawable {
  readonly root = el("div", { class: "values" });

  constructor(
    private readonly data: SceneData,
    private readonly store: Store,
    frames: Frames,
  ) {
    store.on(["window", "sensor", "quantity", "hidden"], () => frames.later(this));
  }

  draw(): void {
    const { sensor: place, hidden } = this.store.state;
    const sensor = this.data.sensor(place);
    const tables = (sensor?.wrenches ?? [])
      .filter((series) => series.role === "measured" && !hidden.has(series.name))
      .flatMap((series) => (sensor ? this.table(sensor, series) : []));
    const none = el("p", { class: "absent" }, "No error in this window: no wrench is expected, or its samples are ignored.");
    this.root.replaceChildren(...(tables.length > 0 ? tables : [none]));
  }

  private table(sensor: Sensor, series: WrenchSeries): HTMLElement[] {
    const { quantity, window } = this.store.state;
    const [first, end] = [this.data.firstAt(window[0]), this.data.sampleAt(window[1]) + 1];
    const columns = COMPONENTS.flatMap((c) => this.data.columns.error(sensor, series, quantity, c) ?? []);
    const count = columns[0]?.summary(first, end).count ?? 0;
    if (count === 0) return [];
    const letter = quantity === "force" ? "f" : "t";
    const chip = el("span", { class: "chip" });
    chip.style.background = seriesColour(sensor, series);
    const rows = columns.map((column, k) => {
      const name = k === 3 ? `|${letter}|` : `${letter}${"xyz"[k] ?? ""}`;
      return el("tr", {}, el("th", { scope: "row" }, name), ...this.cells(column, first, end));
    });
    const norm = columns[3];
    const uses = (["calibration", "validation"] as const).flatMap((use) => {
      const part = norm && this.data.columns.partOf(norm, use);
      return part && part.summary(first, end).count > 0 ? [{ use, part }] : [];
    });
    if (uses.length > 1)
      for (const { use, part } of uses)
        rows.push(el("tr", {}, el("th", { scope: "row" }, `|${letter}| ${use}`), ...this.cells(part, first, end)));
    const head = ["rms", "mean", "largest"].map((text) => el("th", { scope: "col" }, text));
    return [
      el(
        "table",
        { class: "statistics" },
        el("caption", {}, chip, ` ${series.name} [${UNIT[quantity]}], n = ${count}`),
        el("thead", {}, el("tr", {}, el("th", { scope: "col" }, spoken("component")), ...head)),
        el("tbody", {}, ...rows),
      ),
    ];
  }

  private cells(column: Column, first: number, end: number): HTMLElement[] {
    const { sum, squares, count } = column.summary(first, end);
    const worst = column.farthest(first, end) ?? first;
    const go = button(this.shown(column.at(worst)), () => this.store.set({ sample: worst, playing: false }), {
      class: "link",
      title: `at ${(this.data.time[worst] ?? 0).toFixed(3)} s`,
    });
    const values = [Math.sqrt(squares / count), sum / count].map((value) => el("td", {}, this.shown(value)));
    return [...values, el("td", {}, go)];
  }

  private shown(value: number): string {
    return value.toFixed(this.store.state.quantity === "force" ? 2 : 3);
  }
}
