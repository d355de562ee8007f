// SPDX-License-Identifier: BSD-3-Clause
// The points of a sensor's force or moment space, shared by the view in space and the planes.

import { INK, seriesColour } from "./colours";
import { ignoredSpans } from "./marks";
import { FIRST, type Quantity, type SceneData } from "./scene_data";
import type { Ellipsoid, Sphere, WrenchSeries } from "./scene_types";
import type { State } from "./store";
import { everyKth } from "./thin";
import type { Window } from "./time_window";

/** Most points of all series together. */
const LIMIT = 20_000;
/** Points of the overview may be so many times fewer than those that could be drawn. */
const FEWER = 4;
/** Values farther than this many half widths of nearly all others do not widen the view. */
const FAR = 3;

/** Points of one series. */
export interface Cloud {
  readonly series: WrenchSeries;
  readonly colour: string;
  /** Rows of three, one for each sample of the clouds; NaN where absent. */
  readonly points: Float32Array;
  readonly ellipsoid: Ellipsoid | null;
  readonly sphere: Sphere | null;
}

/** Points of all series of a sensor. */
export interface Clouds {
  /** Samples that the points are of. */
  readonly samples: Uint32Array;
  readonly clouds: readonly Cloud[];
  /** Middle of the view. */
  readonly centre: readonly [number, number, number];
  /** Half the edge of the cube that is shown. */
  readonly half: number;
}

const NONE: Clouds = { samples: new Uint32Array(), clouds: [], centre: [0, 0, 0], half: 1 };

/** Makes the clouds of the state, and remembers the last ones. */
export class CloudMaker {
  private readonly last = {
    whole: { key: "", clouds: NONE },
    window: { key: "", clouds: NONE },
  };

  constructor(private readonly data: SceneData) {}

  /** Clouds of all series of the chosen sensor in the window, whether they are shown or not. */
  of(state: State): Clouds {
    const { sensor, quantity, window } = state;
    const spans = state.hideIgnored ? ignoredSpans(this.data, state.marks) : [];
    const all = this.data.span;
    // of a stream that goes on, once a second: a cloud is drawn anew as a whole
    const following = this.data.scene.live !== null && state.playing;
    const key = JSON.stringify([sensor, quantity, following ? Math.floor(all[1]) : all, spans.map((s) => [s.start_s, s.end_s])]);
    const whole = this.remembered("whole", key, () => {
      const clouds = makeClouds(this.data, sensor, quantity, spans, all);
      return { ...clouds, ...bounds(clouds.clouds) };
    });
    if (following || (window[0] <= all[0] && window[1] >= all[1])) return whole;
    return this.remembered("window", `${key} ${window.join(" ")}`, () => {
      const clouds = makeClouds(this.data, sensor, quantity, spans, window);
      return { ...clouds, centre: whole.centre, half: whole.half }; // what is left stays where it was
    });
  }

  private remembered(which: "whole" | "window", key: string, make: () => Clouds): Clouds {
    if (this.last[which].key !== key) this.last[which] = { key, clouds: make() };
    return this.last[which].clouds;
  }
}

function makeClouds(
  data: SceneData,
  place: number,
  quantity: Quantity,
  spans: readonly { start_s: number; end_s: number }[],
  window: Window,
): Pick<Clouds, "samples" | "clouds"> {
  const left = new Uint8Array(data.samples).fill(1);
  left.fill(0, data.firstAt(window[0]), data.sampleAt(window[1]) + 1);
  for (const { start_s, end_s } of spans) left.fill(1, data.firstAt(start_s), data.firstAt(end_s));
  const sensor = data.sensor(place);
  const series = sensor?.wrenches ?? [];
  const limit = Math.floor(LIMIT / Math.max(1, series.length));
  const kept = left.reduce((count, out) => count + 1 - out, 0);
  const every = series[0]?.overview?.every ?? Infinity;
  // points of the overview, where they are not much fewer: no sample is then unpacked
  const ready = FEWER * kept >= every * Math.min(limit, kept);
  const step = ready ? every : 1;
  const samples = everyKth(Math.ceil(data.samples / step), limit, (k) => left[step * k] === 0).map((k) => step * k);
  const clouds = series.map((one) => ({
    series: one,
    colour: sensor ? seriesColour(sensor, one) : INK,
    points: pick(data, one, samples, step, FIRST[quantity]),
    ellipsoid: quantity === "force" ? one.ellipsoid_force : one.ellipsoid_moment,
    sphere: quantity === "force" ? one.reference_force : one.reference_moment,
  }));
  return { samples, clouds };
}

function pick(data: SceneData, { values, overview }: WrenchSeries, samples: Uint32Array, step: number, first: number): Float32Array {
  const points = new Float32Array(3 * samples.length);
  const ready = step > 1 && overview ? data.floats(overview.points) : null;
  samples.forEach((sample, k) => {
    const rows = ready ?? data.over(values, sample, sample + 1);
    const at = 6 * (ready ? sample / step : sample) + first;
    points.set(rows.subarray(at, at + 3), 3 * k);
  });
  return points;
}

function bounds(clouds: readonly Cloud[]): Pick<Clouds, "centre" | "half"> {
  const edges = [0, 1, 2].map((axis) => {
    const values = clouds.flatMap(({ points }) =>
      Array.from(points.filter((value, k) => k % 3 === axis && !Number.isNaN(value))),
    );
    const found = values.length > 0 ? [interval(Float64Array.from(values).sort())] : [];
    const spheres = clouds.flatMap(({ sphere }) =>
      sphere ? [[sphere.centre[axis] ?? 0, sphere.radius] as const] : [],
    );
    const all = [...found, ...spheres.map(([middle, radius]) => [middle - radius, middle + radius] as const)];
    return all.length > 0
      ? ([Math.min(...all.map(([low]) => low)), Math.max(...all.map(([, high]) => high))] as const)
      : ([0, 0] as const);
  });
  const [x, y, z] = edges.map(([low, high]) => (low + high) / 2);
  const widest = Math.max(...edges.map(([low, high]) => high - low));
  return { centre: [x ?? 0, y ?? 0, z ?? 0], half: widest > 0 ? 0.55 * widest : 1 };
}

function interval(sorted: Float64Array): [number, number] {
  const at = (share: number): number => sorted[Math.round(share * (sorted.length - 1))] ?? 0;
  const [low, middle, high] = [at(0.01), at(0.5), at(0.99)];
  const reach = FAR * Math.max(high - middle, middle - low);
  return [Math.max(at(0), middle - reach), Math.min(at(1), middle + reach)];
}
