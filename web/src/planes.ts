// SPDX-License-Identifier: BSD-3-Clause
// The clouds along each axis: planes x-y, y-z and x-z.

import { faded, FAINT, INK, MUTED, PALE, PAPER } from "./colours";
import type { Cloud, CloudMaker, Clouds } from "./clouds";
import { el } from "./dom";
import type { Drawable, Frames } from "./frames";
import { UNIT, type SceneData } from "./scene_data";
import { contains, spansOf } from "./selection";
import type { Span, Store } from "./store";
import { ticks } from "./thin";
import { goesOn } from "./transport";
import { asEllipsoid, outline } from "./wireframes";

const MARGIN = { left: 32, right: 6, top: 5, bottom: 16 };
const MOVED = 4; // pixels after which a click is a drag
const REACH = 10; // pixels within which a click takes a point
const FONT = `${Math.round(0.92 * Number.parseFloat(getComputedStyle(document.body).fontSize))}px system-ui, 'DejaVu Sans', sans-serif`;

/** One planar view. */
export class PlaneView implements Drawable {
  private readonly canvas: HTMLCanvasElement;
  private readonly points = document.createElement("canvas");
  private key = "";
  private last: Clouds | null = null;
  /** What a drag encircles; pixels. */
  private path: readonly (readonly [number, number])[] = [];

  constructor(
    private readonly panel: HTMLElement,
    readonly plane: readonly [number, number],
    private readonly frames: Frames,
    private readonly data: SceneData,
    private readonly maker: CloudMaker,
    private readonly store: Store,
  ) {
    const [i, j] = plane;
    this.canvas = el("canvas", {
      role: "img",
      "aria-label": `Plane ${"xyz"[i] ?? ""}-${"xyz"[j] ?? ""} of the force or moment space`,
    });
    panel.append(this.canvas);
    this.encircle();
    new ResizeObserver(() => frames.later(this)).observe(panel);
  }

  /** Show the state in the next frame. */
  update(): void {
    this.frames.later(this);
  }

  /** Where a point is on the canvas; CSS pixels. */
  place(clouds: Clouds, point: ArrayLike<number>): [number, number] {
    return this.placing(clouds)(point, 0);
  }

  /** Where points are on the canvas that begin at a place of an array; quick for many of them. */
  private placing(clouds: Clouds): (points: ArrayLike<number>, at: number) => [number, number] {
    const [i, j] = this.plane;
    const { left, right, top, bottom } = MARGIN;
    const [width, height] = [this.panel.clientWidth - left - right, this.panel.clientHeight - top - bottom];
    const pixels = Math.min(width, height) / (2 * clouds.half); // the same both ways: a sphere stays a circle
    const x = left + width / 2 - (clouds.centre[i] ?? 0) * pixels;
    const y = top + height / 2 + (clouds.centre[j] ?? 0) * pixels;
    return (points, at) => [x + (points[at + i] ?? Number.NaN) * pixels, y - (points[at + j] ?? Number.NaN) * pixels];
  }

  /** Where a sample of a series is on the screen; CSS pixels. */
  sampleOnScreen(series: number, sample: number): { x: number; y: number } | null {
    const clouds = this.maker.of(this.store.state);
    const cloud = clouds.clouds[series];
    if (!cloud) return null;
    const box = this.canvas.getBoundingClientRect();
    const [x, y] = this.place(clouds, this.data.vector(cloud.series, sample, this.store.state.quantity));
    return { x: box.left + x, y: box.top + y };
  }

  /** Draw now. */
  draw(): void {
    const [width, height] = [this.panel.clientWidth, this.panel.clientHeight];
    if (width === 0 || height === 0) return;
    const { state } = this.store;
    const clouds = this.maker.of(state);
    const key = JSON.stringify([width, height, devicePixelRatio, [...state.hidden], state.wireframes, state.selected]);
    if (key !== this.key || clouds !== this.last) {
      this.key = key;
      this.last = clouds;
      this.drawPoints(clouds, prepare(this.points, width, height));
    }
    const pen = prepare(this.canvas, width, height);
    pen.drawImage(this.points, 0, 0, width, height);
    if (this.path.length > 1) {
      pen.strokeStyle = INK;
      pen.beginPath();
      for (const [x, y] of this.path) pen.lineTo(x, y);
      pen.stroke();
    }
    for (const cloud of this.visible(clouds)) {
      const [x, y] = this.place(clouds, this.data.vector(cloud.series, state.sample, state.quantity));
      for (const [radius, colour] of [
        [6.5, PAPER],
        [5, cloud.colour],
        [1.8, PAPER],
      ] as const) {
        pen.fillStyle = colour;
        pen.beginPath();
        pen.arc(x, y, radius, 0, 2 * Math.PI);
        if (Number.isFinite(x + y)) pen.fill();
      }
    }
  }

  private visible(clouds: Clouds): Cloud[] {
    return clouds.clouds.filter((cloud) => !this.store.state.hidden.has(cloud.series.name));
  }

  private drawPoints(clouds: Clouds, pen: CanvasRenderingContext2D): void {
    this.drawAxes(clouds, pen);
    const { left, right, top, bottom } = MARGIN;
    pen.save();
    pen.beginPath();
    pen.rect(left, top, this.panel.clientWidth - left - right, this.panel.clientHeight - top - bottom);
    pen.clip();
    const { selected } = this.store.state;
    const chosen = Uint8Array.from(clouds.samples, (sample) => (isIn(selected, this.data.time[sample] ?? 0) ? 1 : 0));
    const place = this.placing(clouds);
    for (const cloud of this.visible(clouds)) {
      const pale = faded(cloud.colour, 0.12);
      for (let k = 0; k + 2 < cloud.points.length; k += 3) {
        const [x, y] = place(cloud.points, k);
        pen.fillStyle = selected.length === 0 || chosen[k / 3] ? cloud.colour : pale;
        if (Number.isFinite(x + y)) pen.fillRect(x - 0.8, y - 0.8, 1.6, 1.6);
      }
      if (!this.store.state.wireframes) continue;
      const shapes = [
        [cloud.sphere && asEllipsoid(cloud.sphere), MUTED],
        [cloud.ellipsoid, cloud.colour],
      ] as const;
      for (const [shape, colour] of shapes) {
        if (!shape) continue;
        pen.strokeStyle = colour;
        pen.beginPath();
        for (const [a, b] of outline(shape, this.plane)) {
          const point = [0, 0, 0];
          point[this.plane[0]] = a;
          point[this.plane[1]] = b;
          pen.lineTo(...this.place(clouds, point));
        }
        pen.stroke();
      }
    }
    pen.restore();
  }

  private drawAxes(clouds: Clouds, pen: CanvasRenderingContext2D): void {
    const [i, j] = this.plane;
    const { left, right, top, bottom } = MARGIN;
    const [width, height] = [this.panel.clientWidth, this.panel.clientHeight];
    const [ci, cj] = [clouds.centre[i] ?? 0, clouds.centre[j] ?? 0];
    const pixels = Math.min(width - left - right, height - top - bottom) / (2 * clouds.half);
    const reach = [(width - left - right) / 2 / pixels, (height - top - bottom) / 2 / pixels] as const;
    pen.font = FONT;
    pen.fillStyle = MUTED;
    pen.strokeStyle = PALE;
    pen.textAlign = "center";
    for (const value of ticks(ci - reach[0], ci + reach[0], width / 45)) {
      const x = this.place(clouds, i === 0 ? [value, cj, cj] : [cj, value, cj])[0];
      stroke(pen, x, top, x, height - bottom);
      if (x > left + 8 && x < width - right - 8) pen.fillText(text(value), x, height - bottom + 11);
    }
    pen.textAlign = "right";
    for (const value of ticks(cj - reach[1], cj + reach[1], height / 30)) {
      const y = this.place(clouds, j === 2 ? [ci, ci, value] : [ci, value, ci])[1];
      stroke(pen, left, y, width - right, y);
      if (y > top + 4) pen.fillText(text(value), left - 4, y + 4);
    }
    pen.strokeStyle = FAINT;
    pen.strokeRect(left + 0.5, top + 0.5, width - left - right, height - top - bottom);
    const letter = this.store.state.quantity === "force" ? "f" : "t";
    const unit = UNIT[this.store.state.quantity];
    pen.fillStyle = INK;
    pen.textAlign = "left"; // the names stand inside, at the ends of the axes
    pen.fillText(`${letter}${"xyz"[j] ?? ""} [${unit}]`, left + 4, top + 12);
    pen.textAlign = "right";
    pen.fillText(`${letter}${"xyz"[i] ?? ""} [${unit}]`, width - right - 4, height - bottom - 5);
  }

  /** A click goes to a point; a drag chooses what it encircles. */
  private encircle(): void {
    let path: [number, number][] | null = null;
    const at = (event: MouseEvent): [number, number] => {
      const box = this.canvas.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    this.canvas.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      path = [at(event)];
      this.canvas.setPointerCapture(event.pointerId);
    });
    this.canvas.addEventListener("pointermove", (event) => {
      if (path === null) return;
      path.push(at(event));
      this.path = path;
      this.frames.later(this);
    });
    this.canvas.addEventListener("pointerup", (event) => {
      const drawn = path ?? [];
      [path, this.path] = [null, []];
      const [x, y] = drawn[0] ?? [0, 0];
      if (drawn.every(([a, b]) => Math.hypot(a - x, b - y) <= MOVED)) this.jump(event);
      else this.store.set({ selected: this.within(drawn) });
      this.frames.later(this);
    });
    this.canvas.addEventListener("pointercancel", () => {
      [path, this.path] = [null, []];
      this.frames.later(this);
    });
  }

  /** Time of the points in a polygon on the canvas. */
  private within(polygon: readonly [number, number][]): Span[] {
    const clouds = this.maker.of(this.store.state);
    const visible = this.visible(clouds);
    return spansOf(this.data, clouds, (k) =>
      visible.some(({ points }) => contains(polygon, ...this.place(clouds, points.subarray(3 * k, 3 * k + 3)))),
    );
  }

  private jump(event: MouseEvent): void {
    if (goesOn(this.data, this.store)) return;
    const clouds = this.maker.of(this.store.state);
    const box = this.canvas.getBoundingClientRect();
    let best = { sample: -1, distance: REACH };
    for (const cloud of this.visible(clouds)) {
      clouds.samples.forEach((sample, k) => {
        const [x, y] = this.place(clouds, cloud.points.subarray(3 * k, 3 * k + 3));
        const distance = Math.hypot(x - event.clientX + box.left, y - event.clientY + box.top);
        if (distance < best.distance) best = { sample, distance };
      });
    }
    if (best.sample >= 0) this.store.set({ sample: best.sample, playing: false });
  }
}

function isIn(spans: readonly Span[], seconds: number): boolean {
  return spans.some(({ start_s, end_s }) => start_s <= seconds && seconds < end_s);
}

function prepare(canvas: HTMLCanvasElement, width: number, height: number): CanvasRenderingContext2D {
  canvas.width = Math.round(width * devicePixelRatio);
  canvas.height = Math.round(height * devicePixelRatio);
  const pen = canvas.getContext("2d");
  if (!pen) throw new Error("this browser draws nothing on a canvas");
  pen.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
  pen.fillStyle = PAPER;
  pen.fillRect(0, 0, width, height);
  return pen;
}

function stroke(pen: CanvasRenderingContext2D, x0: number, y0: number, x1: number, y1: number): void {
  pen.beginPath();
  pen.moveTo(x0, y0);
  pen.lineTo(x1, y1);
  pen.stroke();
}

function text(value: number): string {
  return String(Number(value.toPrecision(6))).replace("-", "−");
}
