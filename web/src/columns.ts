// SPDX-License-Identifier: BSD-3-Clause
// Quantities over time that are plotted: components and norms of wrenches, of their errors, and of the band around them.

import type { Use } from "./marks";
import { FIRST, type Quantity, type SceneData } from "./scene_data";
import type { Sensor, WrenchSeries } from "./scene_types";

/** Component of a force or moment; 3 is the norm. */
export type Component = 0 | 1 | 2 | 3;

/** Components in the order of the plots. */
export const COMPONENTS: readonly Component[] = [0, 1, 2, 3];

/** Half the width of an interval that holds 95 % of a normal error, in standard deviations. */
export const DEVIATIONS_95 = 1.96;

const BLOCK = 64; // samples that are summed up together

/** What is known of some samples of a column. */
export interface Summary {
  readonly low: number;
  readonly high: number;
  readonly sum: number;
  readonly squares: number;
  readonly count: number;
}

const NOTHING: Summary = { low: Infinity, high: -Infinity, sum: 0, squares: 0, count: 0 };

/** Values of one quantity, with sums and extremes of blocks, so that a window of any length is summed up at once. */
export class Column {
  private blocks: Summary[] | null = null;
  private readonly others = new Map<string, Column>();

  /**
   * @param samples Number of samples.
   * @param at Value at a sample; NaN where absent.
   */
  constructor(
    readonly samples: number,
    readonly at: (sample: number) => number,
  ) {}

  /** A column of the same samples that depends on this one, made when it is first asked for. */
  beside(name: string, at: (sample: number) => number): Column {
    const known = this.others.get(name) ?? new Column(this.samples, at);
    this.others.set(name, known);
    return known;
  }

  /** Sum up the samples from `first` to before `end`. */
  summary(first: number, end: number): Summary {
    const [from, to] = [Math.ceil(first / BLOCK), Math.floor(end / BLOCK)];
    if (to <= from) return this.scan(first, end, NOTHING);
    this.blocks ??= this.summedUp();
    let total = this.scan(first, from * BLOCK, NOTHING);
    for (let k = from; k < to; k++) total = joined(total, this.blocks[k] ?? NOTHING);
    return this.scan(to * BLOCK, end, total);
  }

  /** Sample from `first` to before `end` whose value is farthest from zero; null if all are absent. */
  farthest(first: number, end: number): number | null {
    let best: number | null = null;
    let distance = -1;
    for (let start = first; start < end; start += BLOCK) {
      const stop = Math.min(end, start + BLOCK);
      const { low, high } = this.summary(start, stop);
      if (!(Math.max(-low, high) > distance)) continue;
      for (let i = start; i < stop; i++) {
        const size = Math.abs(this.at(i));
        if (size > distance) [best, distance] = [i, size];
      }
    }
    return best;
  }

  private summedUp(): Summary[] {
    return Array.from({ length: Math.floor(this.samples / BLOCK) }, (_, k) =>
      this.scan(k * BLOCK, (k + 1) * BLOCK, NOTHING),
    );
  }

  private scan(first: number, end: number, before: Summary): Summary {
    let { low, high, sum, squares, count } = before;
    for (let i = first; i < end; i++) {
      const value = this.at(i);
      if (Number.isNaN(value)) continue;
      if (value < low) low = value;
      if (value > high) high = value;
      sum += value;
      squares += value * value;
      count++;
    }
    return { low, high, sum, squares, count };
  }
}

function joined(a: Summary, b: Summary): Summary {
  return {
    low: Math.min(a.low, b.low),
    high: Math.max(a.high, b.high),
    sum: a.sum + b.sum,
    squares: a.squares + b.squares,
    count: a.count + b.count,
  };
}

/** Columns of a scene, each made when it is first asked for. */
export class Columns {
  private readonly known = new Map<string, Column>();
  private readonly masks = new Map<Use, Uint8Array>();

  constructor(private readonly data: SceneData) {}

  /** Make all columns anew, because values changed. */
  forget(): void {
    this.known.clear();
    this.masks.clear();
  }

  /** Component or norm of a series. */
  measured(series: WrenchSeries, quantity: Quantity, component: Component): Column {
    return this.remembered(`measured ${series.values.offset} ${quantity} ${component}`, () =>
      componentOf(this.data.floats(series.values), null, FIRST[quantity], component),
    );
  }

  /** Component or norm of measured minus expected, absent in ignored intervals; null without an expected wrench. */
  error(sensor: Sensor, series: WrenchSeries, quantity: Quantity, component: Component): Column | null {
    const expected = expectedOf(sensor);
    if (!expected || series === expected) return null;
    return this.remembered(`error ${series.values.offset} ${quantity} ${component}`, () => {
      const [values, less] = [this.data.floats(series.values), this.data.floats(expected.values)];
      const error = componentOf(values, less, FIRST[quantity], component);
      const ignored = this.inUse("ignore");
      return (sample) => (ignored[sample] ? NaN : error(sample));
    });
  }

  /** Half the width of the 95 % band of a series; of the norm, the root of the sum of squares; null if unknown. */
  band(series: WrenchSeries, quantity: Quantity, component: Component): Column | null {
    const { deviation } = series;
    if (!deviation) return null;
    return this.remembered(`band ${deviation.offset} ${quantity} ${component}`, () => {
      const norm = componentOf(this.data.floats(deviation), null, FIRST[quantity], component);
      return (sample) => DEVIATIONS_95 * norm(sample);
    });
  }

  /** Part of an error that lies in intervals of a use; absent elsewhere. */
  partOf(error: Column, use: Use): Column {
    const inUse = this.inUse(use);
    return error.beside(use, (sample) => (inUse[sample] ? error.at(sample) : NaN));
  }

  /** 1 at every sample whose instant lies in an interval of a use, else 0. */
  private inUse(wanted: Use): Uint8Array {
    const known = this.masks.get(wanted);
    if (known) return known;
    const { data } = this;
    const mask = new Uint8Array(data.samples);
    for (const { use, start_s, end_s } of data.scene.intervals)
      if (use === wanted) mask.fill(1, data.firstAt(start_s), data.firstAt(end_s));
    this.masks.set(wanted, mask);
    return mask;
  }

  private remembered(key: string, make: () => (sample: number) => number): Column {
    const known = this.known.get(key);
    if (known) return known;
    const column = new Column(this.data.samples, make());
    this.known.set(key, column);
    return column;
  }
}

/** The expected series of a sensor, if it has one. */
export function expectedOf(sensor: Sensor | undefined): WrenchSeries | undefined {
  return sensor?.wrenches.find((series) => series.role === "expected");
}

/** The series whose error is looked at first: of a calibration, else measured; of those that are not hidden. */
export function mainSeries(sensor: Sensor | undefined, hidden: ReadonlySet<string>): WrenchSeries | undefined {
  const measured = sensor?.wrenches.filter((one) => one.role === "measured" && !hidden.has(one.name)) ?? [];
  return measured.find((one) => one.calibrated) ?? measured[0];
}

function componentOf(
  values: Float32Array,
  less: Float32Array | null,
  first: number,
  component: Component,
): (sample: number) => number {
  const of = (place: number): number => (values[place] ?? NaN) - (less === null ? 0 : (less[place] ?? NaN));
  if (component !== 3) return (sample) => of(6 * sample + first + component);
  return (sample) => {
    const at = 6 * sample + first;
    return Math.hypot(of(at), of(at + 1), of(at + 2));
  };
}
