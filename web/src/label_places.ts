// SPDX-License-Identifier: BSD-3-Clause
// Where texts go that would lie on each other.

import { Vector3, type Object3D, type PerspectiveCamera, type Sprite } from "three";

/** Where a text is in a picture: its middle and its size. */
export interface Box {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
}

/** Heights that a text may go up, those nearest to its place first. */
const STEPS = [0, 1, -1, 2, -2, 3, -3, 4, -4];

/** Give heights to move boxes up by, so that none lies on one before it; 0 where all places are taken. */
export function heightsUp(boxes: readonly Box[]): number[] {
  const placed: Box[] = [];
  return boxes.map((box) => {
    const at = (step: number): Box => ({ ...box, y: box.y + step * box.height });
    const step = STEPS.find((k) => placed.every((other) => !meet(at(k), other))) ?? 0;
    placed.push(at(step));
    return step;
  });
}

function meet(a: Box, b: Box): boolean {
  return 2 * Math.abs(a.x - b.x) < a.width + b.width && 2 * Math.abs(a.y - b.y) < a.height + b.height;
}

/** Move the texts that are seen off each other in the picture of a camera; the nearest ones stay.
 *
 * Matrices of the world are up to date.
 */
export function spread(texts: readonly Sprite[], camera: PerspectiveCamera): void {
  const seen = seenBy(texts, camera);
  heightsUp(seen).forEach((step, k) => seen[k]?.text.center.set(0.5, 0.5 - step));
}

/** Hide the texts that would lie on one before them.
 *
 * Matrices of the world are up to date.
 */
export function thinOut(texts: readonly Sprite[], camera: PerspectiveCamera): void {
  for (const text of texts) text.visible = true;
  const placed: Box[] = [];
  const boxes = new Map(seenBy(texts, camera).map((box) => [box.text, box]));
  for (const text of texts) {
    const box = boxes.get(text);
    text.visible = box !== undefined && placed.every((other) => !meet(box, other));
    if (box && text.visible) placed.push(box);
  }
}

/** Give rectangles of the texts that are drawn; CSS pixels of a canvas. */
export function drawnRectangles(
  texts: readonly Sprite[],
  camera: PerspectiveCamera,
  { clientWidth: wide, clientHeight: high }: HTMLCanvasElement,
): { left: number; top: number; right: number; bottom: number }[] {
  return drawnBoxes(texts, camera).map(({ x, y, width, height }) => ({
    left: 0.5 * wide * (1 + x - 0.5 * width),
    right: 0.5 * wide * (1 + x + 0.5 * width),
    top: 0.5 * high * (1 - y - 0.5 * height),
    bottom: 0.5 * high * (1 - y + 0.5 * height),
  }));
}

/** Give boxes of the texts that are drawn, where they are after `spread`; the picture reaches from -1 to 1. */
function drawnBoxes(texts: readonly Sprite[], camera: PerspectiveCamera): Box[] {
  return seenBy(texts, camera).map(({ text, x, y, width, height }) => {
    return { x, y: y + (0.5 - text.center.y) * height, width, height };
  });
}

/** Texts before a camera that no group hides, with their boxes before `spread`, the nearest first. */
function seenBy(texts: readonly Sprite[], camera: PerspectiveCamera): (Box & { text: Sprite; depth: number })[] {
  camera.updateMatrixWorld();
  const high = Math.tan((camera.fov * Math.PI) / 360);
  return texts
    .filter(isShown)
    .map((text) => {
      const place = new Vector3().setFromMatrixPosition(text.matrixWorld);
      const depth = -place.clone().applyMatrix4(camera.matrixWorldInverse).z;
      const { x, y } = place.project(camera);
      const height = text.scale.y / (high * depth);
      return { text, depth, x, y, width: text.scale.x / (high * depth * camera.aspect), height };
    })
    .filter(({ depth }) => depth > 0)
    .sort((a, b) => a.depth - b.depth);
}

function isShown(thing: Object3D): boolean {
  return thing.visible && (thing.parent === null || isShown(thing.parent));
}
