// SPDX-License-Identifier: BSD-3-Clause
// Samples worth a look: the worst error, the next event, the next contact on skin.

import { mainSeries } from "./columns";
import { markedIntervals } from "./marks";
import type { Quantity, SceneData } from "./scene_data";
import { contactStarts } from "./skin_frames";
import type { State } from "./store";

const EARLIER_S = 1e-6; // an event at the shown instant is not the next one

/** What the worst sample is looked for in. */
export interface Search {
  readonly sensor: number;
  readonly quantity: Quantity;
  readonly hidden: ReadonlySet<string>;
  readonly window: readonly [number, number];
}

/** Sample in the window with the largest error: of the validation data, else of the calibration data; null if none. */
export function worstSample(data: SceneData, search: Search): number | null {
  const sensor = data.sensor(search.sensor);
  const series = mainSeries(sensor, search.hidden);
  const error = sensor && series ? data.columns.error(sensor, series, search.quantity, 3) : null;
  if (!error) return null;
  const [start, end] = search.window;
  for (const use of ["validation", "calibration"] as const) {
    let worst: number | null = null;
    for (const { start_s, end_s } of data.scene.intervals.filter((interval) => interval.use === use)) {
      const until = Math.min(data.firstAt(end_s), data.sampleAt(end) + 1);
      const sample = error.farthest(data.firstAt(Math.max(start, start_s)), until);
      if (sample !== null && (worst === null || error.at(sample) > error.at(worst))) worst = sample;
    }
    if (worst !== null) return worst;
  }
  return null;
}

/** Sample at which the next interval, finding or saved sample begins, or the one before; null if there is none. */
export function nextEvent(data: SceneData, state: State, direction: 1 | -1): number | null {
  const instants = [
    ...[...data.scene.intervals, ...markedIntervals(data, state.marks), ...state.selected].map((one) => one.start_s),
    ...data.scene.findings.flatMap(({ start_s }) => (start_s === null ? [] : [start_s])),
    ...state.marks.map(({ time_s }) => time_s),
  ];
  return nextOf(data, state, instants, direction);
}

/** Sample at which the next contact on skin begins, or the one before; null if there is none. */
export function nextContact(data: SceneData, state: State, direction: 1 | -1): number | null {
  const samples = contactStarts(data).map((seconds) => data.time[data.firstAt(seconds)] ?? seconds);
  return nextOf(data, state, samples, direction);
}

function nextOf(data: SceneData, state: State, all: readonly number[], direction: 1 | -1): number | null {
  const now = data.time[state.sample] ?? 0;
  const instants = all.map((seconds) => data.time[data.nearestSample(seconds)] ?? seconds);
  const beyond = instants.filter((instant) => direction * (instant - now) > EARLIER_S);
  if (beyond.length === 0) return null;
  return data.nearestSample(direction > 0 ? Math.min(...beyond) : Math.max(...beyond));
}
