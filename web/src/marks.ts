// SPDX-License-Identifier: BSD-3-Clause
// Saved samples, and the intervals that begin and end at them.

import type { SceneData } from "./scene_data";
import type { SceneInterval } from "./scene_types";

/** What an interval is for. */
export type Use = SceneInterval["use"];

/** A saved sample. */
export interface Mark {
  readonly sample: number;
  readonly time_s: number;
  readonly mark: "begin" | "end" | "point";
  readonly label: string;
  /** Use of the interval that begins here. */
  readonly use: Use;
}

/** An interval between a saved begin and the next saved end, which is its last sample. */
export interface MarkedInterval {
  /** Saved sample at which it begins. */
  readonly begin: Mark;
  readonly label: string;
  readonly start_s: number;
  /** Instant of the sample after the last one: ends are excluded, as in an experiment file. */
  readonly end_s: number;
  readonly use: Use;
  /** Support of the experiment's interval that holds it. */
  readonly support: string | null;
}

/** Put saved samples in the order of time; a begin comes before an end at the same sample. */
export function inOrder(marks: readonly Mark[]): Mark[] {
  const rank = { begin: 0, point: 1, end: 2 } as const;
  return [...marks].sort((a, b) => a.sample - b.sample || rank[a.mark] - rank[b.mark]);
}

/** Form intervals: each begin with the next end, unless another begin comes first. */
export function markedIntervals(data: SceneData, marks: readonly Mark[]): MarkedInterval[] {
  const intervals: MarkedInterval[] = [];
  const taken = new Set(data.scene.intervals.map((interval) => interval.label));
  let begin: Mark | null = null;
  for (const mark of inOrder(marks)) {
    if (mark.mark === "begin") begin = mark;
    else if (mark.mark === "end" && begin !== null) {
      const label = unused(begin.label || "marked", taken);
      const span = { start_s: begin.time_s, end_s: instantAfter(data, mark.sample) };
      intervals.push({ begin, label, ...span, use: begin.use, support: supportOf(data, span) });
      begin = null;
    }
  }
  return intervals;
}

/** Spans of time that are not to be used, of the experiment and saved. */
export function ignoredSpans(data: SceneData, marks: readonly Mark[]): { start_s: number; end_s: number }[] {
  return [...data.scene.intervals, ...markedIntervals(data, marks)].filter((interval) => interval.use === "ignore");
}

function unused(label: string, taken: Set<string>): string {
  let name = label;
  for (let k = 2; taken.has(name); k++) name = `${label} ${k}`;
  taken.add(name);
  return name;
}

function instantAfter(data: SceneData, sample: number): number {
  const last = data.samples - 1;
  const [start, end] = data.span;
  const period = last > 0 ? (end - start) / last : 1;
  return sample < last ? (data.time[sample + 1] ?? 0) : end + period;
}

function supportOf(data: SceneData, span: { start_s: number; end_s: number }): string | null {
  const end = Math.min(span.end_s, data.span[1]);
  const holds = data.scene.intervals.find((i) => i.support !== null && i.start_s <= span.start_s && end <= i.end_s);
  return holds?.support ?? null;
}
