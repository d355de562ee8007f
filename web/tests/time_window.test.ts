// SPDX-License-Identifier: BSD-3-Clause
// The window of the time plots stays inside the log; marks of an axis are round.

import { deepEqual, equal, ok } from "node:assert/strict";
import { test } from "node:test";

import { everyKth, ticks } from "../src/thin";
import { moved, zoomed } from "../src/time_window";

const WHOLE = [0, 100] as const;

test("a window is stretched about an instant, which stays where it was", () => {
  const [start, end] = zoomed([20, 60], 0.5, 30, WHOLE, 10_000);
  deepEqual([start, end], [25, 45]);
});

test("a window is never longer than the log, nor shorter than four periods", () => {
  deepEqual(zoomed([20, 60], 100, 30, WHOLE, 10_001), [0, 100]);
  const [start, end] = zoomed([20, 60], 1e-9, 30, WHOLE, 10_001);
  ok(Math.abs(end - start - 0.04) < 1e-9);
});

test("a window that is moved stops at the ends of the log", () => {
  deepEqual(moved([20, 60], 10, WHOLE), [30, 70]);
  deepEqual(moved([20, 60], 90, WHOLE), [60, 100]);
  deepEqual(moved([20, 60], -90, WHOLE), [0, 40]);
});

test("every k-th sample of those that are kept, and no more than the limit", () => {
  deepEqual([...everyKth(10, 3, (i) => i % 2 === 0)], [0, 4, 8]);
  deepEqual([...everyKth(10, 100, (i) => i > 7)], [8, 9]);
  equal(everyKth(10, 3, () => false).length, 0);
});

test("marks of an axis are multiples of 1, 2 or 5", () => {
  deepEqual(ticks(0, 10, 5), [0, 2, 4, 6, 8, 10]);
  deepEqual(ticks(-0.3, 0.3, 3), [-0.2, 0, 0.2]);
  deepEqual(ticks(4, 4, 3), [4]);
});
