// SPDX-License-Identifier: BSD-3-Clause
// Sums and extremes of a window are those of its samples, with an overview and without.

import { deepEqual, equal, ok } from "node:assert/strict";
import { test } from "node:test";

import { Column, type Summary } from "../src/columns";
import { minMax } from "../src/thin";

const SAMPLES = 1000;
const BLOCK = 50;
const values = Float64Array.from({ length: SAMPLES }, (_, i) =>
  i % 97 === 0 || (i >= 400 && i < 500) ? Number.NaN : Math.round(100 * Math.sin(0.7 * i)) + (i === 777 ? -300 : 0),
);
const time = Float64Array.from({ length: SAMPLES }, (_, i) => i / 100);

function summary(first: number, end: number): Summary {
  const inside = [...values.subarray(first, end)].filter((value) => !Number.isNaN(value));
  return {
    low: Math.min(...inside),
    high: Math.max(...inside),
    sum: inside.reduce((sum, value) => sum + value, 0),
    squares: inside.reduce((sum, value) => sum + value * value, 0),
    count: inside.length,
  };
}

/** A column, and the samples that it asked for. */
function column(withOverview: boolean): { column: Column; asked: Set<number> } {
  const asked = new Set<number>();
  const made = new Column(SAMPLES, {
    need: (first, end) => {
      for (let i = first; i < end; i++) asked.add(i);
    },
    value: (sample) => {
      ok(asked.has(sample)); // what was not unpacked has no value
      return values[sample] ?? Number.NaN;
    },
    overview: withOverview ? { samples: BLOCK, of: (k) => summary(k * BLOCK, (k + 1) * BLOCK) } : null,
  });
  return { column: made, asked };
}

for (const withOverview of [false, true]) {
  const which = withOverview ? "with an overview" : "without";
  test(`a window is summed up ${which}`, () => {
    for (const [first, end] of [[0, SAMPLES], [3, 41], [49, 51], [60, 940], [400, 500], [950, 1000]] as const)
      deepEqual(column(withOverview).column.summary(first, end), summary(first, end));
  });
  test(`the value farthest from zero is found ${which}`, () => {
    equal(column(withOverview).column.farthest(0, SAMPLES), 777);
    equal(column(withOverview).column.farthest(400, 500), null);
    const best = column(withOverview).column.farthest(10, 60) ?? -1;
    equal(Math.abs(values[best] ?? 0), Math.max(...[...values.subarray(10, 60)].map((v) => Math.abs(v) || 0)));
  });
}

test("with an overview the whole is drawn without a sample, and the farthest value from one block", () => {
  const { column: whole, asked } = column(true);
  const line = minMax(time, [whole], 0, SAMPLES, 20);
  equal(asked.size, 0);
  equal(Math.min(...(line.y[0] ?? []).map((value) => value ?? 0)), summary(0, SAMPLES).low);
  deepEqual((line.y[0] ?? []).slice(16, 20), [null, null, null, null]); // 400 to 500
  whole.farthest(0, SAMPLES);
  equal(asked.size, BLOCK);
});

test("where a pixel shows few samples, these are drawn", () => {
  const { column: part, asked } = column(true);
  const line = minMax(time, [part], 100, 140, 30);
  equal(asked.size, 40);
  deepEqual(line.x, [...time.subarray(100, 140)]);
});

test("a column beside another one is absent where one of both is", () => {
  const { column: one } = column(true);
  const none = new Column(SAMPLES, {
    need: () => undefined,
    value: () => Number.NaN,
    overview: { samples: BLOCK, of: () => ({ low: Infinity, high: -Infinity, sum: 0, squares: 0, count: 0 }) },
  });
  const edge = one.beside("upper", (own, _, width) => own + width, (_, own, width) => ({ ...own, high: own.high + width.high }), none);
  equal(edge.summary(0, SAMPLES).count, 0);
  ok(Number.isNaN(edge.at(5)));
});
