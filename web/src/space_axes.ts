// SPDX-License-Identifier: BSD-3-Clause
// The cube around the force or moment space, with ticks along three of its edges.

import { BufferGeometry, Group, LineBasicMaterial, LineSegments, Vector3, type Sprite } from "three";

import type { Clouds } from "./clouds";
import { AXES, FAINT, MUTED } from "./colours";
import { label } from "./labels3d";
import { UNIT, type Quantity } from "./scene_data";
import { ticks } from "./thin";

const LETTER = { force: "f", moment: "t" } as const;
const TEXT = 0.17;

/** Draw a cube of edge 2 about the origin that stands for the clouds' cube, see `toCube`; gives it with its texts, names
 *  of the axes before numbers. */
export function cube(clouds: Clouds, quantity: Quantity): { group: Group; texts: Sprite[] } {
  const group = new Group();
  const corner = (k: number): Vector3 => new Vector3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
  const edges = [0, 1, 2, 3, 4, 5, 6, 7].flatMap((k) =>
    [1, 2, 4].filter((bit) => !(k & bit)).flatMap((bit) => [corner(k), corner(k | bit)]),
  );
  group.add(lines(edges, FAINT));
  const scales = [0, 1, 2].map((axis) => scale(clouds, quantity, axis));
  const texts = [...scales.map(({ title }) => title), ...scales.flatMap(({ numbers }) => numbers)];
  group.add(...scales.map(({ axis }) => axis), ...texts);
  return { group, texts };
}

/** Where a force or moment is in the cube. */
export function toCube(clouds: Clouds, point: ArrayLike<number>): Vector3 {
  const [x, y, z] = [0, 1, 2].map((k) => ((point[k] ?? Number.NaN) - (clouds.centre[k] ?? 0)) / clouds.half);
  return new Vector3(x, y, z);
}

function scale(
  clouds: Clouds,
  quantity: Quantity,
  axis: number,
): { axis: LineSegments; title: Sprite; numbers: Sprite[] } {
  const colour = AXES[axis] ?? FAINT;
  const middle = clouds.centre[axis] ?? 0;
  const along = (value: number, out: number): Vector3 => {
    const place = axis === 2 ? new Vector3(-1, 1, 0) : new Vector3(-1, -1, -1);
    place.setComponent(axis, (value - middle) / clouds.half);
    const away = axis === 0 ? new Vector3(0, -1, 0) : new Vector3(-1, 0, 0);
    return place.addScaledVector(away, out);
  };
  const values = ticks(middle - clouds.half, middle + clouds.half, 4);
  const strokes = values.flatMap((value) => [along(value, 0), along(value, 0.04)]);
  const ends = [along(middle - clouds.half, 0), along(middle + clouds.half, 0)];
  const numbers = values.map((value) => placed(label(String(value), MUTED, TEXT), along(value, 0.2)));
  const title = label(`${LETTER[quantity]}${"xyz"[axis] ?? ""} [${UNIT[quantity]}]`, colour, 1.15 * TEXT, true);
  placed(title, along(middle + 1.2 * clouds.half, 0));
  return { axis: lines([...strokes, ...ends], colour), title, numbers };
}

function placed<T extends { position: Vector3 }>(thing: T, at: Vector3): T {
  thing.position.copy(at);
  return thing;
}

function lines(points: Vector3[], colour: string): LineSegments {
  return new LineSegments(new BufferGeometry().setFromPoints(points), new LineBasicMaterial({ color: colour }));
}
