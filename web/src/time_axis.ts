// SPDX-License-Identifier: BSD-3-Clause
// The time axis of strips above the plots: the same pixels as theirs.

import { LEFT, RIGHT } from "./plots";
import type { Store } from "./store";

/** Pixels and instants of a panel that shows the window of the time plots. */
export class TimeAxis {
  constructor(
    private readonly panel: HTMLElement,
    private readonly store: Store,
  ) {}

  /** Pixels of the panel between which time is shown. */
  get ends(): readonly [number, number] {
    return [LEFT, this.panel.clientWidth - RIGHT];
  }

  /** Pixel of an instant. */
  pixel(time: number): number {
    const [start, end] = this.store.state.window;
    const [left, right] = this.ends;
    return left + ((time - start) / (end - start || 1)) * (right - left);
  }

  /** Instant of a pixel. */
  instant(pixel: number): number {
    const [start, end] = this.store.state.window;
    const [left, right] = this.ends;
    return start + ((pixel - left) / (right - left)) * (end - start);
  }
}

/** Make the canvas of a panel as sharp as the screen, and give its pen in CSS pixels; null where it has no room. */
export function penOf(canvas: HTMLCanvasElement, width: number, height: number): CanvasRenderingContext2D | null {
  const pen = canvas.getContext("2d");
  if (!pen || width <= LEFT + RIGHT) return null;
  canvas.width = Math.round(width * devicePixelRatio);
  canvas.height = Math.round(height * devicePixelRatio);
  pen.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
  pen.font = "10px system-ui, 'DejaVu Sans', sans-serif";
  return pen;
}
