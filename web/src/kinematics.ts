// SPDX-License-Identifier: BSD-3-Clause
// Where the robot's links are. Poses are 16 numbers, row by row: p_a = a_H_b p_b.

import type { SceneData } from "./scene_data";
import type { Joint } from "./scene_types";

/** A pose, row by row. */
export type Pose = readonly number[];

/** A pose that moves nothing. */
export const IDENTITY: Pose = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

/** The product a_H_c = a_H_b b_H_c. */
export function compose(a: Pose, b: Pose): Pose {
  const product = Array.from({ length: 16 }, () => 0);
  for (let row = 0; row < 4; row++) {
    for (let column = 0; column < 4; column++) {
      let sum = 0;
      for (let k = 0; k < 4; k++) sum += (a[4 * row + k] ?? 0) * (b[4 * k + column] ?? 0);
      product[4 * row + column] = sum;
    }
  }
  return product;
}

/** Pose of the root link in the world at a sample. */
export function rootPose(data: SceneData, sample: number): Pose {
  const values = data.row(data.scene.root, sample);
  const [x = 0, y = 0, z = 0, qw = 1, qx = 0, qy = 0, qz = 0] = values;
  if (values.length < 7 || values.some(Number.isNaN)) return IDENTITY;
  const s = 2 / (qw * qw + qx * qx + qy * qy + qz * qz); // float32 components are a unit only nearly
  return [
    1 - s * (qy * qy + qz * qz),
    s * (qx * qy - qz * qw),
    s * (qx * qz + qy * qw),
    x,
    s * (qx * qy + qz * qw),
    1 - s * (qx * qx + qz * qz),
    s * (qy * qz - qx * qw),
    y,
    s * (qx * qz - qy * qw),
    s * (qy * qz + qx * qw),
    1 - s * (qx * qx + qy * qy),
    z,
    0,
    0,
    0,
    1,
  ];
}

/** Coordinate of a joint at a sample; what is not known counts as zero of its column. */
export function jointCoordinate(data: SceneData, joint: Joint, sample: number): number {
  if (joint.column === null) return joint.offset;
  const value = data.position(sample, joint.column);
  return joint.multiplier * (Number.isNaN(value) ? 0 : value) + joint.offset;
}

/** Poses of all links in the world at a sample, by name. */
export function linkPoses(data: SceneData, sample: number): Map<string, Pose> {
  const { robot } = data.scene;
  const poses = new Map<string, Pose>([[robot.root_link, rootPose(data, sample)]]);
  for (const joint of robot.joints) {
    const parent = poses.get(joint.parent);
    if (!parent) throw new Error(`joint ${joint.name}: link ${joint.parent} comes after it`);
    const atZero = compose(parent, joint.parent_H_child);
    poses.set(joint.child, joint.type === "fixed" ? atZero : compose(atZero, across(joint, data, sample)));
  }
  return poses;
}

function across(joint: Joint, data: SceneData, sample: number): Pose {
  const [x = 0, y = 0, z = 1] = joint.axis;
  const q = jointCoordinate(data, joint, sample);
  if (joint.type === "prismatic") return [1, 0, 0, x * q, 0, 1, 0, y * q, 0, 0, 1, z * q, 0, 0, 0, 1];
  // Rodrigues: R = 1 + sin(q) [a]x + (1 - cos(q)) [a]x^2
  const s = Math.sin(q);
  const v = 2 * Math.sin(q / 2) ** 2;
  return [
    1 - v * (y * y + z * z),
    v * x * y - s * z,
    v * x * z + s * y,
    0,
    v * x * y + s * z,
    1 - v * (x * x + z * z),
    v * y * z - s * x,
    0,
    v * x * z - s * y,
    v * y * z + s * x,
    1 - v * (x * x + y * y),
    0,
    0,
    0,
    0,
    1,
  ];
}
