// SPDX-License-Identifier: BSD-3-Clause
// Texts that would lie on each other go up or down; others stay.

import { deepEqual } from "node:assert/strict";
import { test } from "node:test";

import { Group, PerspectiveCamera, Sprite } from "three";

import { heightsUp, spread } from "../src/label_places";

const box = (x: number, y: number) => ({ x, y, width: 4, height: 1 });

test("texts move off those before them by as little as they can", () => {
  deepEqual(heightsUp([box(0, 0), box(1, 0.2), box(2, 0.1), box(9, 0)]), [0, 1, -2, 0]);
  deepEqual(heightsUp([box(0, 0), box(0, 1), box(4, 0)]), [0, 0, 0]); // edge to edge is apart
});

test("of two texts at one place in the picture the nearer one stays", () => {
  const camera = new PerspectiveCamera(40, 1);
  const texts = [-5, -4].map((z) => {
    const text = new Sprite();
    text.position.set(0, 0, z);
    const group = new Group().add(text);
    group.updateMatrixWorld();
    return text;
  });
  spread(texts, camera);
  deepEqual(texts.map(({ center }) => center.y), [-1.5, 0.5]); // one height of the farther, smaller one is not enough
});
