// SPDX-License-Identifier: BSD-3-Clause
// Contacts on skin over time: a row for each patch, its colour the largest force of a contact.

import { DARK, faded, HEURISTIC, INK, MUTED, PAPER } from "./colours";
import { el } from "./dom";
import type { Drawable, Frames } from "./frames";
import type { SceneData } from "./scene_data";
import type { SkinContactFrames } from "./scene_types";
import { frameForces } from "./skin_frames";
import { pressureColour } from "./skin_view";
import type { Store } from "./store";
import { penOf, TimeAxis } from "./time_axis";
import { PRESSURES } from "./visual_roles";

/** Height of a row; CSS pixels. */
const ROW = 14;
const SHADES = 64;
/** Share of the colours below which a contact would not be told from none. */
const PALEST = 0.15;

/** One patch, or what a skinManager saw on one link. */
interface Row {
  readonly name: string;
  readonly frames: SkinContactFrames;
  /** Largest force of each frame; N, or of the heuristic. */
  readonly forces: Float32Array;
  readonly shades: readonly string[];
  /** Colour without a contact. */
  readonly bed: string;
  readonly full: number;
  readonly unit: string;
}

/** The raster. */
export class SkinRaster implements Drawable {
  private readonly canvas = el("canvas", { role: "img" });
  private readonly axis: TimeAxis;
  private readonly rows: readonly Row[];

  constructor(
    private readonly panel: HTMLElement,
    private readonly frames: Frames,
    private readonly data: SceneData,
    private readonly store: Store,
  ) {
    this.axis = new TimeAxis(panel, store);
    const { skin, skin_events: events } = data.scene;
    const pressures = shades((share) => pressureColour(share).getStyle());
    this.rows = [
      ...rowsOf(data, skin, pressures, DARK ? PRESSURES[0] : PAPER, "N"), // the largest is dark: its bed is light
      ...rowsOf(data, events, shades((share) => faded(HEURISTIC, share)), PAPER, "heuristic"),
    ];
    const names = this.rows.map(({ name }) => name).join(", ");
    this.canvas.setAttribute("aria-label", `Contacts on skin over time: ${names}; the next one by the key c`);
    this.canvas.style.height = `${this.height}px`;
    panel.append(this.canvas);
    new ResizeObserver(() => frames.later(this)).observe(panel);
    this.canvas.addEventListener("click", (event) => {
      const at = this.axis.instant(event.clientX - this.canvas.getBoundingClientRect().left);
      store.set({ sample: data.nearestSample(at), playing: false });
    });
    this.canvas.addEventListener("mousemove", (event) => {
      const box = this.canvas.getBoundingClientRect();
      this.canvas.title = this.describe(event.clientX - box.left, Math.floor((event.clientY - box.top) / ROW));
    });
  }

  private get height(): number {
    return ROW * this.rows.length + 2;
  }

  /** Draw again in the next frame. */
  update(): void {
    this.frames.later(this);
  }

  /** Draw now. */
  draw(): void {
    const pen = penOf(this.canvas, this.panel.clientWidth, this.height);
    if (!pen) return;
    const [left, right] = this.axis.ends;
    this.rows.forEach((row, k) => {
      const top = ROW * k + 1;
      pen.fillStyle = row.bed;
      pen.fillRect(left, top, right - left, ROW - 2);
      this.columns(row).forEach((force, column) => {
        if (!(force > 0)) return;
        pen.fillStyle = row.shades[Math.round((SHADES - 1) * Math.min(1, force / row.full))] ?? INK;
        pen.fillRect(left + column, top, 1, ROW - 2);
      });
      pen.strokeStyle = faded(MUTED, 0.35);
      pen.strokeRect(left + 0.5, top + 0.5, right - left - 1, ROW - 3);
      pen.fillStyle = INK;
      pen.fillText(short(pen, row.name, left - 8), 4, top + 9);
    });
    const now = this.axis.pixel(this.data.time[this.store.state.sample] ?? Number.NaN);
    if (!(now >= left && now <= right)) return;
    for (const [colour, half] of [[PAPER, 2], [INK, 1]] as const) {
      pen.fillStyle = colour;
      pen.fillRect(now - half, 0, 2 * half, this.height);
    }
  }

  /** Largest force of a row in each pixel. */
  private columns({ frames, forces }: Row): Float32Array {
    const [left, right] = this.axis.ends;
    const columns = new Float32Array(Math.max(0, Math.ceil(right - left)));
    const times = this.data.doubles(frames.time_s);
    forces.forEach((force, k) => {
      if (!(force > 0)) return;
      const start = times[k] ?? Number.NaN;
      const end = Math.min(start + frames.hold_s, times[k + 1] ?? Number.POSITIVE_INFINITY);
      if (!(this.axis.pixel(end) > left)) return; // before the window
      const first = Math.max(0, Math.floor(this.axis.pixel(start) - left));
      const last = Math.min(columns.length - 1, Math.floor(this.axis.pixel(end) - left - 1e-6));
      for (let column = first; column <= Math.max(first, last) && column < columns.length; column++)
        columns[column] = Math.max(columns[column] ?? 0, force);
    });
    return columns;
  }

  private describe(pixel: number, place: number): string {
    const row = this.rows[place];
    if (!row) return "";
    const [left] = this.axis.ends;
    const force = this.columns(row)[Math.floor(pixel - left)] ?? 0;
    return force > 0 ? `${row.name}: ${force.toFixed(2)} ${row.unit} at most` : `${row.name}: no contact`;
  }
}

function rowsOf(
  data: SceneData,
  all: readonly { readonly name: string; readonly contacts: SkinContactFrames }[],
  colours: readonly string[],
  bed: string,
  unit: string,
): Row[] {
  const rows = all.map(({ name, contacts }) => ({ name, frames: contacts, forces: frameForces(data, contacts) }));
  const full = rows.reduce((most, { forces }) => forces.reduce((a, b) => Math.max(a, b), most), 0) || 1;
  return rows.map((row) => ({ ...row, shades: colours, bed, full, unit }));
}

/** Colours of forces from 0 to the largest, of which the palest is seen. */
function shades(colour: (share: number) => string): string[] {
  return Array.from({ length: SHADES }, (_, k) => colour(PALEST + ((1 - PALEST) * k) / (SHADES - 1)));
}

function short(pen: CanvasRenderingContext2D, text: string, room: number): string {
  if (pen.measureText(text).width <= room) return text;
  let count = text.length;
  while (count > 1 && pen.measureText(`${text.slice(0, count)}…`).width > room) count--;
  return `${text.slice(0, count)}…`;
}
