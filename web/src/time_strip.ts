// SPDX-License-Identifier: BSD-3-Clause
// Intervals, findings and saved samples along the time axis, above the plots.

import { ACCENT, ALARM, faded, INK, USES } from "./colours";
import { el } from "./dom";
import type { Drawable, Frames } from "./frames";
import { markedIntervals } from "./marks";
import { LEFT, RIGHT } from "./plots";
import type { SceneData } from "./scene_data";
import type { Store } from "./store";
import { penOf, TimeAxis } from "./time_axis";

const INTERVALS = { top: 1, height: 14 };
const FINDINGS = { top: 17, height: 9 };

/** The strip of what happened when. */
export class TimeStrip implements Drawable {
  private readonly canvas: HTMLCanvasElement;
  private readonly axis: TimeAxis;

  constructor(
    private readonly panel: HTMLElement,
    private readonly frames: Frames,
    private readonly data: SceneData,
    private readonly store: Store,
  ) {
    this.canvas = el("canvas", { role: "img" });
    this.axis = new TimeAxis(panel, store);
    panel.append(this.canvas);
    new ResizeObserver(() => frames.later(this)).observe(panel);
    this.canvas.addEventListener("click", (event) => {
      const at = this.axis.instant(event.clientX - this.canvas.getBoundingClientRect().left);
      store.set({ sample: data.nearestSample(at), playing: false });
    });
    this.canvas.addEventListener("mousemove", (event) => {
      this.canvas.title = this.describe(this.axis.instant(event.clientX - this.canvas.getBoundingClientRect().left));
    });
  }

  /** Draw again in the next frame. */
  update(): void {
    this.frames.later(this);
  }

  /** Draw now. */
  draw(): void {
    const [width, height] = [this.panel.clientWidth, this.panel.clientHeight];
    const pen = penOf(this.canvas, width, height);
    if (!pen) return;
    const intervals = [...this.data.scene.intervals, ...markedIntervals(this.data, this.store.state.marks)];
    const findings = this.data.scene.findings;
    this.canvas.setAttribute(
      "aria-label",
      `Time axis with ${intervals.length} intervals and ${findings.length} findings; both are listed beside the plots`,
    );
    for (const { label, start_s, end_s, use } of intervals) this.bar(pen, start_s, end_s, use, label);
    for (const { start_s, end_s } of findings) this.finding(pen, start_s, end_s);
    for (const { start_s, end_s } of this.store.state.selected) {
      const [from, to] = [Math.max(LEFT, this.axis.pixel(start_s)), Math.min(width - RIGHT, this.axis.pixel(end_s))];
      pen.fillStyle = faded(INK, 0.45);
      if (to >= from) pen.fillRect(from, 0, Math.max(1, to - from), height);
    }
    for (const mark of this.store.state.marks) this.flag(pen, mark.time_s, mark.mark);
    pen.fillStyle = INK;
    pen.fillText("intervals", 4, INTERVALS.top + 11);
    pen.fillStyle = ALARM;
    pen.fillText("findings", 4, FINDINGS.top + 8);
  }

  private bar(pen: CanvasRenderingContext2D, start: number, end: number, use: keyof typeof USES, label: string): void {
    const from = Math.max(LEFT, this.axis.pixel(start));
    const to = Math.min(this.panel.clientWidth - RIGHT, this.axis.pixel(end));
    if (to <= from) return;
    pen.fillStyle = faded(USES[use], 0.4);
    pen.fillRect(from, INTERVALS.top, to - from, INTERVALS.height);
    pen.strokeStyle = USES[use];
    pen.strokeRect(from + 0.5, INTERVALS.top + 0.5, Math.max(0, to - from - 1), INTERVALS.height - 1);
    pen.fillStyle = INK;
    const text = use === "ignore" ? `${label} (ignored)` : label;
    if (pen.measureText(text).width < to - from - 6) pen.fillText(text, from + 4, INTERVALS.top + 11);
  }

  /** A long one is pale, so that short ones inside it are seen. */
  private finding(pen: CanvasRenderingContext2D, start: number | null, end: number | null): void {
    if (start === null) return;
    const right = this.panel.clientWidth - RIGHT;
    const [from, to] = [this.axis.pixel(start), this.axis.pixel(end ?? start)];
    if (to < LEFT || from > right) return;
    pen.fillStyle = faded(ALARM, 0.25);
    pen.fillRect(Math.max(LEFT, from), FINDINGS.top, Math.min(right, to) - Math.max(LEFT, from), FINDINGS.height);
    pen.fillStyle = ALARM;
    for (const edge of [from, to]) {
      if (edge >= LEFT && edge <= right) pen.fillRect(edge - 0.75, FINDINGS.top, 1.5, FINDINGS.height);
    }
  }

  private flag(pen: CanvasRenderingContext2D, time: number, mark: "begin" | "end" | "point"): void {
    const x = this.axis.pixel(time);
    if (x < LEFT || x > this.panel.clientWidth - RIGHT) return;
    const tip = mark === "begin" ? 6 : mark === "end" ? -6 : 0;
    pen.fillStyle = ACCENT;
    pen.fillRect(x - 0.75, 0, 1.5, this.panel.clientHeight);
    pen.beginPath();
    if (tip === 0) pen.arc(x, 4, 3.5, 0, 2 * Math.PI);
    else
      for (const [a, b] of [
        [x, 0],
        [x + tip, 4],
        [x, 8],
      ] as const)
        pen.lineTo(a, b);
    pen.fill();
  }

  private describe(time: number): string {
    const near = 3 * Math.abs(this.axis.instant(1) - this.axis.instant(0));
    const { intervals, findings } = this.data.scene;
    return [
      ...intervals.filter((i) => i.start_s <= time && time < i.end_s).map((i) => `${i.label} (${i.use})`),
      ...findings
        .filter((f) => f.start_s !== null && f.start_s - near <= time && time <= (f.end_s ?? f.start_s) + near)
        .map((f) => `${f.stream}: ${f.kind}: ${f.message}`),
    ]
      .slice(0, 12)
      .join("\n");
  }
}
