// SPDX-License-Identifier: BSD-3-Clause
// A plot over time of one component: of wrenches, or of their errors. The cursor is an element that is moved: a jump
// redraws no line.

import uPlot from "uplot";

import { faded, INK, MUTED, PALE, seriesColour, seriesDash, USES } from "./colours";
import type { Column, Component } from "./columns";
import { el } from "./dom";
import type { Drawable, Frames } from "./frames";
import { markedIntervals } from "./marks";
import { UNIT, type Quantity, type SceneData } from "./scene_data";
import type { Sensor, WrenchSeries } from "./scene_types";
import type { Store } from "./store";
import { minMax } from "./thin";
import { moved, zoomed } from "./time_window";

/** Width of the axis on the left, shared with the strip of intervals; CSS pixels. */
export const LEFT = 58;
/** Room on the right; CSS pixels. */
export const RIGHT = 10;
const AXIS_LABEL = 13; // pixels; the style sheet gives the last plot 33 more
const MOVED = 4; // pixels after which a click is a drag
const WHEEL = 0.0015; // logarithm of the factor by which a pixel of the wheel stretches the window
const FONT = `${Math.round(0.92 * Number.parseFloat(getComputedStyle(document.body).fontSize))}px system-ui, 'DejaVu Sans', sans-serif`;

/** What a plot shows. */
export interface Shown {
  readonly kind: "error" | "measured";
  readonly quantity: Quantity;
  readonly component: Component;
  /** Whether the axis of time stands below it. */
  readonly last: boolean;
}

/** What a plot shows, and from where to where. */
export interface PlotRange extends Omit<Shown, "last"> {
  /** Start and end; s. */
  readonly x: readonly [number, number];
  /** Lower and upper end; N or N m. */
  readonly y: readonly [number, number];
}

/** A line of the plot, with the half width of its band. */
interface Drawn {
  readonly series: WrenchSeries;
  readonly column: Column;
  readonly band: Column | null;
}

/** The plot of one component. */
export class ComponentPlot implements Drawable {
  private plot: uPlot | null = null;
  private readonly cursor = el("div", { class: "plot-cursor" });
  private readonly pointer = el("div", { class: "plot-pointer" });
  private readonly readout = el("div", { class: "readout" });
  private bounds: [number, number] = [-1, 1];
  private form = "";
  private content = "";

  constructor(
    private readonly panel: HTMLElement,
    private readonly shown: Shown,
    frames: Frames,
    private readonly data: SceneData,
    private readonly store: Store,
  ) {
    panel.append(this.readout);
    new ResizeObserver(() => frames.later(this)).observe(panel);
    const keys = ["sensor", "quantity", "hidden", "window", "marks", "selected", "large", "scaleByCalibrations"] as const;
    store.on(keys, () => frames.later(this));
    store.on(["sample", "hover"], () => this.moveCursor());
  }

  /** Draw now. */
  draw(): void {
    const { state } = this.store;
    const [width, height] = [this.panel.clientWidth, this.panel.clientHeight];
    if (width <= LEFT || height === 0 || this.data.samples === 0) return;
    const spans = [...markedIntervals(this.data, state.marks), ...state.selected].map((i) => [i.start_s, i.end_s]);
    const form = JSON.stringify([width, height, devicePixelRatio, state.sensor, [...state.hidden]]);
    const content = JSON.stringify([form, state.window, spans, state.scaleByCalibrations]);
    if (content === this.content) return;
    this.content = content;
    const drawn = this.drawn();
    const lines = this.lines(drawn, width);
    if (form === this.form && this.plot) this.plot.setData(lines);
    else {
      this.form = form;
      this.plot?.destroy();
      this.plot = new uPlot(this.options(width, height, drawn), lines, this.panel);
      this.plot.over.append(this.pointer, this.cursor);
      this.followPointer(this.plot);
    }
  }

  /** What is shown, and from where to where; null while nothing is drawn. */
  range(): PlotRange | null {
    if (!this.plot || this.panel.clientHeight === 0) return null;
    const { kind, quantity, component } = this.shown;
    return { kind, quantity, component, x: [...this.store.state.window], y: [...this.bounds] };
  }

  /** Move the cursor to the current sample, and tell the values there or under the pointer. */
  private moveCursor(): void {
    const { sample, hover, window } = this.store.state;
    for (const [line, at] of [
      [this.cursor, sample],
      [this.pointer, hover],
    ] as const) {
      const now = at === null ? Number.NaN : (this.data.time[at] ?? 0);
      line.hidden = !this.plot || !(now >= window[0] && now <= window[1]);
      if (this.plot && !line.hidden)
        line.style.transform = `translateX(${Math.round(this.plot.valToPos(now, "x"))}px)`;
    }
    if (!this.plot) return;
    const sensor = this.sensor();
    this.readout.replaceChildren(
      ...this.drawn().map(({ series, column }) => {
        const value = column.at(hover ?? sample);
        const digits = this.shown.quantity === "force" ? 2 : 3;
        const chip = el("span", { class: "chip" });
        if (sensor) chip.style.background = seriesColour(sensor, series);
        return el("span", {}, chip, Number.isFinite(value) ? value.toFixed(digits) : "–");
      }),
    );
  }

  private sensor(): Sensor | undefined {
    return this.data.sensor(this.store.state.sensor);
  }

  private drawn(): Drawn[] {
    const { kind, quantity, component } = this.shown;
    const { columns } = this.data;
    const sensor = this.sensor();
    const series = sensor?.wrenches.filter((one) => !this.store.state.hidden.has(one.name)) ?? [];
    return series.flatMap((one) => {
      const column =
        kind === "measured"
          ? columns.measured(one, quantity, component)
          : sensor && columns.error(sensor, one, quantity, component);
      // the norm of a sum is not the sum of norms: only that of the error has a band
      const hasBand = kind === "error" || component !== 3;
      return column ? [{ series: one, column, band: hasBand ? columns.band(one, quantity, component) : null }] : [];
    });
  }

  private lines(drawn: readonly Drawn[], width: number): uPlot.AlignedData {
    const { window, scaleByCalibrations } = this.store.state;
    const first = this.data.sampleAt(window[0]);
    const end = Math.min(this.data.samples, this.data.sampleAt(window[1]) + 2);
    const bands = drawn.flatMap(({ column, band }) => (band ? edges(column, band, this.shown) : []));
    const columns = [...drawn.map(({ column }) => column), ...bands];
    const line = minMax(this.data.time, columns, first, end, width - LEFT - RIGHT);
    const calibrated = drawn.map(({ series }, k) => (series.calibrated ? k : -1)).filter((k) => k >= 0);
    const alone = this.shown.kind === "error" && scaleByCalibrations && calibrated.length > 0;
    const fitted = alone ? [...calibrated, ...bands.map((_, k) => drawn.length + k)] : columns.map((_, k) => k);
    this.bounds = yBounds(
      fitted.map((k) => line.y[k] ?? []),
      this.shown,
    );
    return [line.x, ...line.y];
  }

  private options(width: number, height: number, drawn: readonly Drawn[]): uPlot.Options {
    const { quantity, component, last } = this.shown;
    const sensor = this.sensor();
    const letter = quantity === "force" ? "f" : "t";
    const colour = (series: WrenchSeries): string => (sensor ? seriesColour(sensor, series) : INK);
    const bands = drawn.filter(({ band }) => band !== null);
    return {
      width,
      height,
      padding: [5, RIGHT, last ? 0 : 4, 0],
      legend: { show: false },
      cursor: { show: false },
      scales: {
        x: { time: false, range: () => [...this.store.state.window] },
        y: { range: () => this.bounds }, // that of what is in the window
      },
      axes: [
        {
          show: true,
          size: last ? 20 : 0,
          font: FONT,
          stroke: INK,
          grid: { stroke: PALE },
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
          grid: { stroke: PALE },
          ticks: { size: 4 },
          gap: 2,
          space: 15, // so that a low plot has more than one number
          label: `${component === 3 ? `|${letter}|` : `${letter}${"xyz"[component]}`} [${UNIT[quantity]}]`,
          labelSize: 14,
          labelGap: 0,
          labelFont: FONT,
        },
      ],
      series: [
        {},
        ...drawn.map(({ series }) => ({
          label: series.name,
          stroke: colour(series),
          width: series.role === "expected" ? 2 : 1,
          dash: sensor ? seriesDash(sensor, series).map((length) => length * devicePixelRatio) : [],
          points: { show: false },
        })),
        ...bands.flatMap(() => [0, 1].map(() => ({ width: 0, points: { show: false } }))),
      ],
      bands: bands.map(({ series }, k) => ({
        series: [drawn.length + 2 * k + 2, drawn.length + 2 * k + 1] as [number, number],
        fill: faded(colour(series), 0.2),
      })),
      hooks: {
        drawClear: [(plot) => this.drawBackground(plot)],
        draw: [() => this.moveCursor()], // before, the plot knows neither its new size nor its new scale
      },
    };
  }

  private drawBackground(plot: uPlot): void {
    const { left, top, width, height } = plot.bbox;
    const bar = (start: number, end: number, colour: string): void => {
      const from = Math.max(left, plot.valToPos(start, "x", true));
      const to = Math.min(left + width, plot.valToPos(end, "x", true));
      plot.ctx.fillStyle = colour;
      if (to > from) plot.ctx.fillRect(from, top, to - from, height);
    };
    const { marks, selected } = this.store.state;
    for (const { start_s, end_s, use } of [...this.data.scene.intervals, ...markedIntervals(this.data, marks)])
      bar(start_s, end_s, faded(USES[use], use === "ignore" ? 0.3 : 0.12));
    for (const { start_s, end_s } of selected) bar(start_s, end_s, faded(MUTED, 0.35));
    if (this.shown.kind === "measured") return;
    const zero = Math.round(plot.valToPos(0, "y", true));
    plot.ctx.fillStyle = MUTED;
    if (zero >= top && zero <= top + height) plot.ctx.fillRect(left, zero, width, 1);
  }

  /** Click: go there; drag: move the window, with Shift span a new one; wheel: stretch it; double click: all. */
  private followPointer(plot: uPlot): void {
    const { over } = plot;
    const x = (event: MouseEvent): number => event.clientX - over.getBoundingClientRect().left;
    const instant = (pixels: number): number => plot.posToVal(pixels, "x");
    let from: { x: number; window: readonly [number, number]; spans: boolean; moved: boolean } | null = null;
    over.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      from = { x: x(event), window: this.store.state.window, spans: event.shiftKey, moved: false };
      over.setPointerCapture(event.pointerId);
    });
    over.addEventListener("pointermove", (event) => {
      const now = x(event);
      if (from === null) {
        this.store.set({ hover: this.data.nearestSample(instant(now)) });
        return;
      }
      from.moved ||= Math.abs(now - from.x) > MOVED;
      if (!from.moved) return;
      if (from.spans) {
        const [left, right] = [Math.min(from.x, now), Math.max(from.x, now)];
        plot.setSelect({ left, width: right - left, top: 0, height: over.clientHeight }, false);
      } else {
        const seconds = ((from.x - now) / over.clientWidth) * (from.window[1] - from.window[0]);
        this.store.set({ window: moved(from.window, seconds, this.data.span) });
      }
    });
    over.addEventListener("pointerup", (event) => {
      const began = from;
      from = null;
      if (began === null) return;
      if (!began.moved) this.store.set({ sample: this.data.nearestSample(instant(x(event))), playing: false });
      else if (began.spans) {
        const [start = 0, end = 0] = [instant(began.x), instant(x(event))].sort((a, b) => a - b);
        plot.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
        const { span, samples } = this.data;
        this.store.set({ window: zoomed([start, end], 1, (start + end) / 2, span, samples) });
      }
    });
    over.addEventListener("pointercancel", () => {
      from = null;
    });
    over.addEventListener("pointerleave", () => this.store.set({ hover: null }));
    over.addEventListener("dblclick", () => this.store.set({ window: this.data.span }));
    over.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        const { window } = this.store.state;
        const { span, samples } = this.data;
        const pan = ((event.shiftKey ? event.deltaY : event.deltaX) / over.clientWidth) * (window[1] - window[0]);
        const next =
          event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY)
            ? moved(window, pan, span)
            : zoomed(window, Math.exp(WHEEL * event.deltaY), instant(x(event)), span, samples);
        this.store.set({ window: next });
      },
      { passive: false },
    );
  }
}

/** Lower and upper edge of a band: about zero for an error, about the line for a wrench. */
function edges(column: Column, band: Column, { kind, component }: Shown): Column[] {
  const norm = component === 3;
  return [-1, 1].map((sign) => {
    const name = sign < 0 ? "lower" : "upper";
    if (kind === "error") {
      const side = sign < 0 && norm ? 0 : sign;
      return band.beside(
        name + (norm ? " of the norm" : ""),
        (width) => side * width,
        (_, width) => ({ ...width, ...ordered(side * width.low, side * width.high) }),
      );
    }
    return column.beside(
      name,
      (own, _, width) => own + sign * width,
      (_, own, width) => ({ ...own, ...ordered(own.low + sign * width.high, own.high + sign * width.high) }),
      band,
    );
  });
}

function ordered(a: number, b: number): { low: number; high: number } {
  return { low: Math.min(a, b), high: Math.max(a, b) };
}

function yBounds(lines: readonly (readonly (number | null)[])[], { kind, component }: Shown): [number, number] {
  let low = kind === "error" ? 0 : Infinity;
  let high = kind === "error" ? 0 : -Infinity;
  for (const line of lines)
    for (const value of line) {
      if (value === null) continue;
      if (value < low) low = value;
      if (value > high) high = value;
    }
  if (!(low <= high)) return [-1, 1];
  const room = high > low ? 0.06 * (high - low) : Math.max(1, 0.1 * Math.abs(high));
  return [kind === "error" && component === 3 ? low : low - room, high + room];
}
