// SPDX-License-Identifier: BSD-3-Clause
// Texts that would lie on each other go up or down; others stay.

import { deepEqual } from "node:assert/strict";
import { test } from "node:test";

import { Group, PerspectiveCamera, Sprite } from "three";

import { heightsUp, spread, thinOut } from "../src/label_places";

const box = (x: number, y: number) => ({ x, y, width: 4, height: 1 });

test("texts move off those before them by as little as they can", () => {
  deepEqual(heightsUp([box(0, 0), box(1, 0.2), box(2, 0.1), box(9, 0)]), [0, 1, -2, 0]);
  deepEqual(heightsUp([box(0, 0), box(0, 1), box(4, 0)]), [0, 0, 0]); // edge to edge is apart
});

function textsAt(...places: (readonly [number, number, number])[]): Sprite[] {
  return places.map((place) => {
    const text = new Sprite();
    text.position.set(...place);
    new Group().add(text).updateMatrixWorld();
    return text;
  });
}

test("of two texts at one place in the picture the nearer one stays", () => {
  const texts = textsAt([0, 0, -5], [0, 0, -4]);
  spread(texts, new PerspectiveCamera(40, 1));
  deepEqual(texts.map(({ center }) => center.y), [-1.5, 0.5]); // one height of the farther, smaller one is not enough
});

test("a text that would lie on one before it is hidden until it does not", () => {
  const texts = textsAt([0, 0, -5], [0.5, 0, -5], [1.2, 0, -5]);
  const seen = (): boolean[] => {
    thinOut(texts, new PerspectiveCamera(40, 1));
    return texts.map(({ visible }) => visible);
  };
  deepEqual(seen(), [true, false, true]); // the last one meets only what is hidden
  texts[0]?.position.setX(-1);
  texts[0]?.updateMatrixWorld();
  deepEqual(seen(), [true, true, false]);
});
