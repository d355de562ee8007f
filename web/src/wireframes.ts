// SPDX-License-Identifier: BSD-3-Clause
// Spheres and ellipsoids as lines of latitude and longitude.

import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments } from "three";

import type { Ellipsoid, Sphere } from "./scene_types";

const MERIDIANS = 12;
const PARALLELS = 8;
const STEPS = 48;

/** The ellipsoid that a sphere is. */
export function asEllipsoid({ centre, radius }: Sphere): Ellipsoid {
  return { centre, axes: [radius, 0, 0, 0, radius, 0, 0, 0, radius] };
}

/** Lines on an ellipsoid: points `centre + axes u`. */
export function wireframe({ centre, axes }: Ellipsoid, colour: string, opacity: number): LineSegments {
  const places: number[] = [];
  for (const [from, to] of unitSphere()) {
    for (const u of [from, to]) {
      for (let row = 0; row < 3; row++) {
        let sum = centre[row] ?? 0;
        for (let k = 0; k < 3; k++) sum += (axes[3 * row + k] ?? 0) * (u[k] ?? 0);
        places.push(sum);
      }
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(Float32Array.from(places), 3));
  return new LineSegments(
    geometry,
    new LineBasicMaterial({ color: colour, opacity, transparent: true, depthWrite: false }),
  );
}

/** The ellipse in which an ellipsoid is seen along an axis, as points; both axes of the plane.
 *
 * With P the two rows of A of the plane, it is centre + L (cos, sin) for any L with L L^T = P P^T; here L is the lower
 * Cholesky factor.
 */
export function outline({ centre, axes }: Ellipsoid, plane: readonly [number, number]): [number, number][] {
  const [i, j] = plane;
  const dot = (a: number, b: number): number =>
    [0, 1, 2].reduce((sum, k) => sum + (axes[3 * a + k] ?? 0) * (axes[3 * b + k] ?? 0), 0);
  const l11 = Math.sqrt(dot(i, i));
  const l21 = l11 > 0 ? dot(i, j) / l11 : 0;
  const l22 = Math.sqrt(Math.max(0, dot(j, j) - l21 * l21));
  return Array.from({ length: 2 * STEPS + 1 }, (_, k) => {
    const [c, s] = [Math.cos((Math.PI * k) / STEPS), Math.sin((Math.PI * k) / STEPS)];
    return [(centre[i] ?? 0) + l11 * c, (centre[j] ?? 0) + l21 * c + l22 * s];
  });
}

function* unitSphere(): Generator<[number[], number[]]> {
  const at = (latitude: number, longitude: number): number[] => [
    Math.cos(latitude) * Math.cos(longitude),
    Math.cos(latitude) * Math.sin(longitude),
    Math.sin(latitude),
  ];
  const turn = (2 * Math.PI) / STEPS;
  for (let m = 0; m < MERIDIANS / 2; m++) {
    const longitude = (2 * Math.PI * m) / MERIDIANS;
    for (let k = 0; k < STEPS; k++) yield [at(turn * k, longitude), at(turn * (k + 1), longitude)];
  }
  for (let p = 1; p < PARALLELS; p++) {
    const latitude = -Math.PI / 2 + (Math.PI * p) / PARALLELS;
    for (let k = 0; k < STEPS; k++) yield [at(latitude, turn * k), at(latitude, turn * (k + 1))];
  }
}
