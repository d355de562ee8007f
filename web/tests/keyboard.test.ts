// SPDX-License-Identifier: BSD-3-Clause
// The help of a page names keys that do something there.

import { deepEqual } from "node:assert/strict";
import { test } from "node:test";

import { keysOf } from "../src/keyboard";
import type { SceneData } from "../src/scene_data";

const WRENCHES = { expected: { role: "expected" }, measured: { role: "measured" } } as const;

function absent(live: boolean, ...sensors: (keyof typeof WRENCHES)[][]): string[] {
  const page = (streamed: boolean, rows: (keyof typeof WRENCHES)[][]): string[] => {
    const sensors = rows.map((row) => ({ wrenches: row.map((one) => WRENCHES[one]) }));
    const scene = { live: streamed ? {} : null, sensors, skin: [], skin_events: [] };
    return keysOf({ scene } as unknown as SceneData).map(([key]) => key);
  };
  const here = page(live, sensors);
  return page(false, [["expected", "measured"]]).filter((key) => !here.includes(key));
}

test("keys of what a page lacks are not named", () => {
  deepEqual(absent(false, ["expected"]), []);
  deepEqual(absent(false, ["measured"]), ["w"]);
  deepEqual(absent(false), ["w", "Esc", "f t"]);
  deepEqual(absent(true, ["measured"]), ["w", "n, Shift+n", "p b e", "s"]);
});
