// SPDX-License-Identifier: BSD-3-Clause
// What is encircled in a plane, as time.

import type { Clouds } from "./clouds";
import { inOrder, type Mark } from "./marks";
import type { SceneData } from "./scene_data";
import type { Span } from "./store";

const JOINED_S = 0.25; // shorter gaps do not divide an interval

/** Whether a point lies in a polygon. */
export function contains(polygon: readonly (readonly [number, number])[], x: number, y: number): boolean {
  let within = false;
  polygon.forEach(([ax, ay], k) => {
    const [bx, by] = polygon[(k + 1) % polygon.length] ?? [ax, ay];
    if (ay > y !== by > y && x < ax + ((bx - ax) * (y - ay)) / (by - ay)) within = !within;
  });
  return within;
}

/** Time of the chosen points of a cloud: each until the next point of the cloud. */
export function spansOf(data: SceneData, clouds: Clouds, chosen: (place: number) => boolean): Span[] {
  const spans: { start_s: number; end_s: number }[] = [];
  clouds.samples.forEach((sample, k) => {
    if (!chosen(k)) return;
    const start_s = data.time[sample] ?? 0;
    const end_s = data.time[clouds.samples[k + 1] ?? sample] ?? start_s;
    const before = spans.at(-1);
    const end = Math.min(end_s, start_s + JOINED_S); // after the cloud's last point of an interval comes a gap
    if (before && start_s - before.end_s < JOINED_S) before.end_s = end;
    else spans.push({ start_s, end_s: end });
  });
  return spans.filter(({ start_s, end_s }) => end_s > start_s);
}

/** Saved samples at which the spans begin and end. */
export function asMarks(data: SceneData, spans: readonly Span[], marks: readonly Mark[]): Mark[] {
  const saved = spans.flatMap(({ start_s, end_s }) =>
    (["begin", "end"] as const).map((mark): Mark => {
      const first = data.firstAt(start_s);
      const sample = mark === "begin" ? first : Math.max(first, data.firstAt(end_s) - 1);
      return { sample, time_s: data.time[sample] ?? 0, mark, label: "", use: "ignore" };
    }),
  );
  return inOrder([...marks, ...saved]);
}
