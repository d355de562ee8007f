// SPDX-License-Identifier: BSD-3-Clause
// The sample that the page opens at: at the first one of a log there is seldom anything to judge.

import type { SceneData } from "./scene_data";

/**
 * First sample in an interval at which the wrench of a sensor is expected; of an interval for validation if there is
 * one, else for calibration; 0 without any.
 */
export function openingSample(data: SceneData, sensor: number): number {
  const expected = data.sensor(sensor)?.wrenches.find((series) => series.role === "expected");
  if (!expected) return 0;
  const values = data.floats(expected.values);
  const uses = ["validation", "calibration"] as const;
  for (const { start_s, end_s } of uses.flatMap((use) => data.scene.intervals.filter((one) => one.use === use))) {
    for (let sample = data.sampleAt(start_s); sample < data.samples; sample++) {
      const now = data.time[sample] ?? end_s;
      if (now >= end_s) break;
      if (now >= start_s && Number.isFinite(values[6 * sample])) return sample;
    }
  }
  return 0;
}
