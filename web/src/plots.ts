// SPDX-License-Identifier: BSD-3-Clause
// A plot over time for each axis. The cursor is an element that is moved: a jump redraws no line.

import uPlot from "uplot";

import { faded, INK, seriesColour, USES } from "./colours";
import { el } from "./dom";
import type { Drawable, Frames } from "./frames";
import { markedIntervals } from "./marks";
import { FIRST, UNIT, type SceneData } from "./scene_data";
import type { WrenchSeries } from "./scene_types";
import type { Store } from "./store";
import { minMax } from "./thin";

/** Width of the axis on the left, shared with the strip of intervals; CSS pixels. */
export const LEFT = 58;
/** Room on the right; CSS pixels. */
export const RIGHT = 10;
const AXIS_LABEL = 13; // pixels; the style sheet gives the last plot 33 more
const MOVED = 4; // pixels after which a click is a choice of a span
const FONT = "11px system-ui, 'DejaVu Sans', sans-serif";

/** The plot of one axis. */
export class AxisPlot implements Drawable {
  private plot: uPlot | null = null;
  private readonly cursor = el("div", { class: "plot-cursor" });
  private bounds: [number, number] = [-1, 1];
  private key = "";

  constructor(
    private readonly panel: HTMLElement,
    private readonly axis: 0 | 1 | 2,
    private readonly frames: Frames,
    private readonly data: SceneData,
    private readonly store: Store,
  ) {
    new ResizeObserver(() => frames.later(this)).observe(panel);
  }

  /** Draw the lines again if they changed. */
  update(): void {
    this.frames.later(this);
  }

  /** Draw now. */
  draw(): void {
    const { state } = this.store;
    const [width, height] = [this.panel.clientWidth, this.panel.clientHeight];
    if (width <= LEFT || height === 0 || this.data.samples === 0) return;
    const spans = markedIntervals(this.data, state.marks).map((i) => [i.start_s, i.end_s, i.use]);
    const key = JSON.stringify([width, height, state.sensor, state.quantity, [...state.hidden], state.window, spans]);
    if (key !== this.key) {
      this.key = key;
      this.rebuild(width, height);
    }
  }

  /** Move the cursor to the current sample. */
  moveCursor(): void {
    const { sample, window } = this.store.state;
    const now = this.data.time[sample] ?? 0;
    this.cursor.hidden = !this.plot || now < window[0] || now > window[1];
    if (this.plot) this.cursor.style.transform = `translateX(${Math.round(this.plot.valToPos(now, "x"))}px)`;
  }

  private shown(): WrenchSeries[] {
    const wrenches = this.data.sensor(this.store.state.sensor)?.wrenches ?? [];
    return wrenches.filter((series) => !this.store.state.hidden.has(series.name));
  }

  private rebuild(width: number, height: number): void {
    const { state } = this.store;
    const place = FIRST[state.quantity] + this.axis;
    const series = this.shown();
    const columns = series.map((one) => ({ values: this.data.floats(one.values), place }));
    this.bounds = yBounds(series.map((one) => this.data.range(one, place)));
    const first = Math.max(0, this.data.sampleAt(state.window[0]));
    const end = Math.min(this.data.samples, this.data.sampleAt(state.window[1]) + 2);
    const line = minMax(this.data.time, columns, first, end, width - LEFT - RIGHT);
    this.plot?.destroy();
    this.plot = new uPlot(this.options(width, height, series), [line.x, ...line.y], this.panel);
    this.plot.over.append(this.cursor);
    this.jumpOnClick(this.plot);
  }

  private options(width: number, height: number, series: readonly WrenchSeries[]): uPlot.Options {
    const { state } = this.store;
    const sensor = this.data.sensor(state.sensor);
    const letter = state.quantity === "force" ? "f" : "t";
    const last = this.axis === 2;
    return {
      width,
      height,
      padding: [5, RIGHT, last ? 0 : 4, 0],
      legend: { show: false },
      cursor: { x: false, y: false, points: { show: false }, drag: { x: true, y: false, setScale: false } },
      scales: {
        x: { time: false, range: () => [state.window[0], state.window[1]] },
        y: { range: () => this.bounds }, // pinned: a range of its own would go blank when the window moves
      },
      axes: [
        {
          show: true,
          size: last ? 20 : 0,
          font: FONT,
          stroke: INK,
          grid: { stroke: "#eceff3" },
          ticks: { size: last ? 4 : 0 },
          label: last ? "time [s]" : "",
          labelSize: last ? AXIS_LABEL : 0,
          labelGap: 0,
          gap: 2,
          labelFont: FONT,
          values: last ? (_, at) => at.map(String) : () => [],
        },
        {
          size: LEFT - 14,
          font: FONT,
          stroke: INK,
          grid: { stroke: "#eceff3" },
          ticks: { size: 4 },
          gap: 2,
          space: 15, // so that a low plot has more than one number
          label: `${letter}${"xyz"[this.axis] ?? ""} [${UNIT[state.quantity]}]`,
          labelSize: 14,
          labelGap: 0,
          labelFont: FONT,
        },
      ],
      series: [
        {},
        ...series.map((one) => ({
          label: one.name,
          stroke: sensor ? seriesColour(sensor, one) : INK,
          width: one.role === "expected" ? 2 : 1,
          points: { show: false },
        })),
      ],
      hooks: {
        drawClear: [(plot) => this.drawSpans(plot)],
        draw: [() => this.moveCursor()], // before, the plot knows neither its new size nor its new scale
        setSelect: [(plot) => this.zoom(plot)],
      },
    };
  }

  private drawSpans(plot: uPlot): void {
    const { left, top, width, height } = plot.bbox;
    const bar = (start: number, end: number, colour: string): void => {
      const from = Math.max(left, plot.valToPos(start, "x", true));
      const to = Math.min(left + width, plot.valToPos(end, "x", true));
      plot.ctx.fillStyle = colour;
      if (to > from) plot.ctx.fillRect(from, top, to - from, height);
    };
    const intervals = [...this.data.scene.intervals, ...markedIntervals(this.data, this.store.state.marks)];
    for (const { start_s, end_s, use } of intervals)
      bar(start_s, end_s, faded(USES[use], use === "ignore" ? 0.3 : 0.12));
  }

  private zoom(plot: uPlot): void {
    const { left, width } = plot.select;
    if (width <= MOVED) return;
    const window: [number, number] = [plot.posToVal(left, "x"), plot.posToVal(left + width, "x")];
    queueMicrotask(() => this.store.set({ window })); // uPlot is still in its own event
  }

  private jumpOnClick(plot: uPlot): void {
    let from = 0;
    plot.over.addEventListener("mousedown", (event) => {
      from = event.clientX;
    });
    plot.over.addEventListener("click", (event) => {
      if (Math.abs(event.clientX - from) > MOVED) return;
      const at = plot.posToVal(event.clientX - plot.over.getBoundingClientRect().left, "x");
      this.store.set({ sample: this.data.nearestSample(at), playing: false });
    });
    plot.over.addEventListener("dblclick", () => this.store.set({ window: this.data.span }));
  }
}

function yBounds(ranges: readonly ([number, number] | null)[]): [number, number] {
  const found = ranges.filter((r) => r !== null);
  if (found.length === 0) return [-1, 1];
  const low = Math.min(...found.map(([value]) => value));
  const high = Math.max(...found.map(([, value]) => value));
  const room = high > low ? 0.06 * (high - low) : Math.max(1, 0.1 * Math.abs(high));
  return [low - room, high + room];
}
