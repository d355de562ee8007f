// SPDX-License-Identifier: BSD-3-Clause
// Quantities over time that are plotted: components and norms of wrenches, of their errors, and of the band around them.

import type { Use } from "./marks";
import { FIRST, type Quantity, type SceneData } from "./scene_data";
import type { ArrayRef, Sensor, WrenchSeries } from "./scene_types";

/** Component of a force or moment; 3 is the norm. */
export type Component = 0 | 1 | 2 | 3;

/** Components in the order of the plots. */
export const COMPONENTS: readonly Component[] = [0, 1, 2, 3];

/** Half the width of an interval that holds 95 % of a normal error, in standard deviations. */
export const DEVIATIONS_95 = 1.96;

const BLOCK = 64; // samples that are summed up together where the library has not summed up more

/** What is known of some samples of a column. */
export interface Summary {
  readonly low: number;
  readonly high: number;
  readonly sum: number;
  readonly squares: number;
  readonly count: number;
}

const NOTHING: Summary = { low: Infinity, high: -Infinity, sum: 0, squares: 0, count: 0 };

/** What the library summed up. */
interface Overview {
  /** Samples of a block. */
  readonly samples: number;
  /** What is known of a block; null where its samples must be asked. */
  of(block: number): Summary | null;
}

/** Where values come from. */
interface Source {
  /** Unpack the samples from `first` to before `end`. */
  need(first: number, end: number): void;
  /** Value at a sample that was unpacked; NaN where absent. */
  value(sample: number): number;
  readonly overview: Overview | null;
}

/** Values of one quantity, with sums and extremes of blocks, so that a window of any length is summed up at once. */
export class Column {
  /** Samples that are summed up together. */
  readonly block: number;
  private blocks: Summary[] | null = null;
  private readonly others = new Map<string, Column>();

  constructor(
    readonly samples: number,
    private readonly source: Source,
  ) {
    this.block = source.overview?.samples ?? BLOCK;
  }

  /** Whether the library summed the column up. */
  get isSummedUp(): boolean {
    return this.source.overview !== null;
  }

  /** Value at a sample; NaN where absent. */
  at(sample: number): number {
    this.source.need(sample, sample + 1);
    return this.source.value(sample);
  }

  /** A column of the same samples that depends on this one, made when it is first asked for.
   *
   * @param name Name of the other column.
   * @param value Value of the other one at a sample, of this one's.
   * @param of What is known of a block of the other one, of what is known of this one's; null where that does not tell.
   * @param beside Another column that the value depends on.
   */
  beside(
    name: string,
    value: (own: number, sample: number, beside: number) => number,
    of: (block: number, own: Summary, beside: Summary) => Summary | null,
    beside?: Column,
  ): Column {
    const { need, value: own, overview } = this.source;
    const other = beside?.source;
    const summed = overview && (!other || other.overview) ? overview : null;
    const known =
      this.others.get(name) ??
      new Column(this.samples, {
        need: (first, end) => {
          need(first, end);
          other?.need(first, end);
        },
        value: (sample) => value(own(sample), sample, other ? other.value(sample) : Number.NaN),
        overview: summed && {
          samples: summed.samples,
          of: (k) => {
            const one = summed.of(k);
            const two = other ? (other.overview?.of(k) ?? null) : one;
            if (!one || !two) return null;
            return one.count > 0 && two.count > 0 ? of(k, one, two) : NOTHING;
          },
        },
      });
    this.others.set(name, known);
    return known;
  }

  /** Sum up the samples from `first` to before `end`. */
  summary(first: number, end: number): Summary {
    const { block } = this;
    const [from, to] = [Math.ceil(first / block), Math.floor(end / block)];
    if (to <= from) return this.scan(first, end, NOTHING);
    let total = this.scan(first, from * block, NOTHING);
    for (let k = from; k < to; k++) total = joined(total, this.ofBlock(k));
    return this.scan(to * block, end, total);
  }

  /** Sample from `first` to before `end` whose value is farthest from zero; null if all are absent. */
  farthest(first: number, end: number): number | null {
    let best: number | null = null;
    let distance = -1;
    const { block, source } = this;
    // the farthest block first: few others are then unpacked
    const spans: { start: number; stop: number; reach: number }[] = [];
    for (let start = first, stop = first; start < end; start = stop) {
      stop = Math.min(end, (Math.floor(start / block) + 1) * block);
      const { low, high, count } = this.summary(start, stop);
      if (count > 0) spans.push({ start, stop, reach: Math.max(-low, high) });
    }
    spans.sort((a, b) => b.reach - a.reach || a.start - b.start);
    for (const { start, stop, reach } of spans) {
      if (reach < distance) break;
      source.need(start, stop);
      for (let i = start; i < stop; i++) {
        const size = Math.abs(source.value(i));
        if (size > distance || (size === distance && best !== null && i < best)) [best, distance] = [i, size];
      }
    }
    return best;
  }

  private ofBlock(k: number): Summary {
    const { overview } = this.source;
    if (overview) return overview.of(k) ?? this.scan(k * this.block, (k + 1) * this.block, NOTHING);
    this.blocks ??= Array.from({ length: Math.floor(this.samples / BLOCK) }, (_, one) =>
      this.scan(one * BLOCK, (one + 1) * BLOCK, NOTHING),
    );
    return this.blocks[k] ?? NOTHING;
  }

  private scan(first: number, end: number, before: Summary): Summary {
    if (end <= first) return before;
    const { source } = this;
    source.need(first, end);
    let { low, high, sum, squares, count } = before;
    for (let i = first; i < end; i++) {
      const value = source.value(i);
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
    return this.remembered(`measured ${series.values.offset} ${quantity} ${component}`, () => ({
      ...this.components([series.values], quantity, component),
      overview: this.overview(series, series.overview?.wrench, quantity, component),
    }));
  }

  /** Component or norm of measured minus expected, absent in ignored intervals; null without an expected wrench. */
  error(sensor: Sensor, series: WrenchSeries, quantity: Quantity, component: Component): Column | null {
    const expected = expectedOf(sensor);
    if (!expected || series === expected) return null;
    return this.remembered(`error ${series.values.offset} ${quantity} ${component}`, () => {
      const { need, value } = this.components([series.values, expected.values], quantity, component);
      const ignored = this.inUse("ignore");
      return {
        need,
        value: (sample) => (ignored[sample] ? NaN : value(sample)),
        overview: this.overview(series, series.overview?.error, quantity, component),
      };
    });
  }

  /** Half the width of the 95 % band of a series; of the norm, the root of the sum of squares; null if unknown. */
  band(series: WrenchSeries, quantity: Quantity, component: Component): Column | null {
    const { deviation, overview } = series;
    if (!deviation) return null;
    return this.remembered(`band ${deviation.offset} ${quantity} ${component}`, () => {
      const { need, value } = this.components([deviation], quantity, component);
      return {
        need,
        value: (sample) => DEVIATIONS_95 * value(sample),
        overview: this.overview(series, overview?.deviation, quantity, component, DEVIATIONS_95),
      };
    });
  }

  /** Part of an error that lies in intervals of a use; absent elsewhere. */
  partOf(error: Column, use: Use): Column {
    const inUse = this.inUse(use);
    const { block } = error;
    const inside = new Uint32Array(Math.ceil(inUse.length / block));
    for (let i = 0; i < inUse.length; i++) if (inUse[i]) inside[Math.floor(i / block)]!++;
    return error.beside(
      use,
      (own, sample) => (inUse[sample] ? own : NaN),
      (k, own) => (inside[k] === block ? own : inside[k] === 0 ? NOTHING : null),
    );
  }

  /** Component or norm of wrenches, or of the difference of two. */
  private components(refs: readonly ArrayRef[], quantity: Quantity, component: Component): Omit<Source, "overview"> {
    const { data } = this;
    const [values, less] = refs.map((ref) => data.over(ref, 0, 0));
    return {
      need: (first, end) => {
        for (const ref of refs) data.over(ref, first, end);
      },
      value: componentOf(values ?? new Float32Array(), less ?? null, FIRST[quantity], component),
    };
  }

  private overview(
    { overview }: WrenchSeries,
    table: ArrayRef | null | undefined,
    quantity: Quantity,
    component: Component,
    scale = 1,
  ): Overview | null {
    if (!overview || !table) return null;
    const values = this.data.floats(table);
    const columns = table.shape[1] ?? 0;
    const place = (quantity === "force" ? 0 : 4) + component;
    return {
      samples: overview.samples,
      of(k) {
        const at = columns * k + place;
        const [low, high] = [scale * (values[at] ?? NaN), scale * (values[at + 8] ?? NaN)];
        if (Number.isNaN(low)) return NOTHING;
        const [sum, squares, count] = columns > 16 ? [values[at + 16], values[at + 24], values[at + 32]] : [];
        return { low, high, sum: sum ?? NaN, squares: squares ?? NaN, count: count ?? overview.samples };
      },
    };
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

  private remembered(key: string, make: () => Source): Column {
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
