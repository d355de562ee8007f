// SPDX-License-Identifier: BSD-3-Clause
// Saved samples, and the intervals that begin and end at them.

import type { SceneData } from "./scene_data";
import type { SceneInterval } from "./scene_types";

const NANOSECOND = 1e-9; // s; instants are whole ones

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
  /** Lines of an experiment file that say its support, or ask for it. */
  readonly supportLines: readonly string[];
  /** Intervals of the experiment in which samples would be used twice. */
  readonly overlaps: readonly string[];
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
      const span = { start_s: begin.time_s, end_s: instantAfter(data, mark.sample), use: begin.use };
      const lines = { supportLines: supportLines(data, span), overlaps: overlaps(data, span) };
      intervals.push({ begin, label, ...span, ...lines });
      begin = null;
    }
  }
  return intervals;
}

/** Saved begins and ends that make no interval. */
export function unpaired(marks: readonly Mark[]): Mark[] {
  const lone: Mark[] = [];
  let begin: Mark | null = null;
  for (const mark of inOrder(marks)) {
    if (mark.mark === "point") continue;
    if (mark.mark === "end" && begin === null) lone.push(mark);
    if (mark.mark === "begin" && begin !== null) lone.push(begin);
    begin = mark.mark === "begin" ? mark : null;
  }
  return begin === null ? lone : [...lone, begin];
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

/** Instant of the next sample; the last one ends with the log, which an experiment file does not let anything exceed. */
function instantAfter(data: SceneData, sample: number): number {
  const last = data.samples - 1;
  const [start, end] = data.span;
  const period = last > 0 ? (end - start) / last : 1;
  return Math.min(sample < last ? (data.time[sample + 1] ?? 0) : end + period, data.scene.end_s);
}

interface Span {
  readonly start_s: number;
  readonly end_s: number;
  readonly use: Use;
}

// as `intervals_toml` of the library; a test compares both
function supportLines(data: SceneData, { start_s, end_s, use }: Span): string[] {
  const { intervals } = data.scene;
  if (!intervals.every((each) => each.states_support)) return [];
  const holds = intervals.find((i) => i.support !== null && i.start_s <= start_s && end_s <= i.end_s + NANOSECOND);
  if (holds) return [`support = ${tomlText(holds.support ?? "")}`];
  return use === "ignore" ? [] : ['# support = "..."  # state the link that stands still'];
}

function overlaps(data: SceneData, { start_s, end_s, use }: Span): string[] {
  return data.scene.intervals
    .filter((each) => use !== "ignore" && each.use !== "ignore")
    .filter((each) => each.start_s < end_s - NANOSECOND && start_s < each.end_s - NANOSECOND)
    .map((each) => each.label);
}

/** A text as a basic string of TOML; that of JSON is one, apart from the delete character. */
export function tomlText(text: string): string {
  return JSON.stringify(text).replaceAll("\u007f", "\\u007f");
}
