// SPDX-License-Identifier: BSD-3-Clause
// Fewer points that look the same.

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

/** Points of a line, for uPlot: null is absent. */
export interface Line {
  readonly x: number[];
  readonly y: (number | null)[][];
}

/** Give the lowest and the highest value of each pixel column, in the order in which they come.
 *
 * @param time Instants; shape (n,).
 * @param columns Arrays of rows of six, each with the place of its value in a row.
 * @param first First sample.
 * @param end Sample after the last one.
 * @param pixels Width of the plot.
 */
export function minMax(
  time: Float64Array,
  columns: readonly { values: Float32Array; place: number }[],
  first: number,
  end: number,
  pixels: number,
): Line {
  const count = end - first;
  if (count <= 2 * pixels) {
    const at = Array.from({ length: count }, (_, k) => first + k);
    return {
      x: at.map((i) => time[i] ?? 0),
      y: columns.map(({ values, place }) => at.map((i) => present(values[6 * i + place]))),
    };
  }
  const x: number[] = [];
  const y: (number | null)[][] = columns.map(() => []);
  for (let pixel = 0; pixel < pixels; pixel++) {
    const from = first + Math.floor((count * pixel) / pixels);
    const to = first + Math.floor((count * (pixel + 1)) / pixels);
    x.push(time[from] ?? 0, time[(from + to) >> 1] ?? 0);
    columns.forEach(({ values, place }, k) => y[k]?.push(...extremes(values, place, from, to)));
  }
  return { x, y };
}

function extremes(values: Float32Array, place: number, from: number, to: number): [number | null, number | null] {
  let low = -1;
  let high = -1;
  for (let i = from; i < to; i++) {
    const value = values[6 * i + place] ?? Number.NaN;
    if (Number.isNaN(value)) continue;
    if (low < 0 || value < (values[6 * low + place] ?? 0)) low = i;
    if (high < 0 || value > (values[6 * high + place] ?? 0)) high = i;
  }
  if (low < 0) return [null, null];
  return [present(values[6 * Math.min(low, high) + place]), present(values[6 * Math.max(low, high) + place])];
}

function present(value: number | undefined): number | null {
  return value === undefined || Number.isNaN(value) ? null : value;
}

/** Lowest and highest of all values at one place of the rows; null if all are absent. */
export function range(values: Float32Array, place: number): [number, number] | null {
  let low = Number.POSITIVE_INFINITY;
  let high = Number.NEGATIVE_INFINITY;
  for (let at = place; at < values.length; at += 6) {
    const value = values[at] ?? Number.NaN;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return low <= high ? [low, high] : null;
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
