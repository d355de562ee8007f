// SPDX-License-Identifier: BSD-3-Clause
// Fewer points that look the same.

import type { Column } from "./columns";

/** Give every k-th of the samples for which `kept` holds, so that at most `limit` are left. */
export function everyKth(samples: number, limit: number, kept: (sample: number) => boolean): Uint32Array {
  let count = 0;
  for (let i = 0; i < samples; i++) if (kept(i)) count++;
  const step = Math.max(1, Math.ceil(count / limit));
  const chosen = new Uint32Array(Math.ceil(count / step));
  let seen = 0;
  for (let i = 0; i < samples; i++) {
    if (!kept(i)) continue;
    if (seen % step === 0) chosen[seen / step] = i;
    seen++;
  }
  return chosen;
}

const WIDEST = 4; // pixels of a block at most

/** Points of a line, for uPlot: null is absent. */
export interface Line {
  readonly x: number[];
  readonly y: (number | null)[][];
}

/** Give the lowest and the highest value of each pixel column.
 *
 * @param time Instants; shape (n,).
 * @param columns What is drawn.
 * @param first First sample.
 * @param end Sample after the last one.
 * @param pixels Width of the plot.
 */
export function minMax(
  time: Float64Array,
  columns: readonly Column[],
  first: number,
  end: number,
  pixels: number,
): Line {
  const count = end - first;
  if (count <= 2 * pixels) {
    const samples = Array.from({ length: count }, (_, k) => first + k);
    return {
      x: samples.map((i) => time[i] ?? 0),
      y: columns.map((column) => samples.map((i) => present(column.at(i)))),
    };
  }
  const x: number[] = [];
  const y: (number | null)[][] = columns.map(() => []);
  // whole blocks where each is hardly wider than a pixel: no sample is then unpacked
  const block = columns.reduce((longest, column) => Math.max(longest, column.isSummedUp ? column.block : 1), 1);
  const whole = block > 1 && count >= (block * pixels) / WIDEST ? block : 1;
  const steps = Math.min(pixels, Math.floor(count / whole));
  const edge = (step: number): number =>
    step === steps ? end : Math.max(first, whole * Math.round((first + (count * step) / steps) / whole));
  for (let step = 0; step < steps; step++) {
    const [from, to] = [step === 0 ? first : edge(step), edge(step + 1)];
    x.push(time[from] ?? 0, time[(from + to) >> 1] ?? 0);
    columns.forEach((column, k) => {
      const { low, high, count: values } = column.summary(from, to);
      y[k]?.push(values ? low : null, values ? high : null);
    });
  }
  return { x, y };
}

function present(value: number): number | null {
  return Number.isNaN(value) ? null : value;
}

/** Round steps of an axis: 1, 2 or 5 times a power of ten, about `count` of them. */
export function ticks(low: number, high: number, count: number): number[] {
  if (!(high > low)) return [low];
  const rough = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((k) => k * power).find((s) => s >= rough) ?? rough;
  const marks: number[] = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++)
    marks.push(Number((k * step).toPrecision(12)));
  return marks;
}
