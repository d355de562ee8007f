// SPDX-License-Identifier: BSD-3-Clause
// Arrows of forces (one head) and moments (two heads), and the axes of frames; all are drawn over the robot.

import { ConeGeometry, CylinderGeometry, Group, Matrix4, Mesh, MeshBasicMaterial, Quaternion, Vector3 } from "three";

import { AXES, INK } from "./colours";
import type { Pose } from "./kinematics";
import { label } from "./labels3d";
import type { Quantity } from "./scene_data";

const UP = new Vector3(0, 1, 0);
const SHAFT = new CylinderGeometry(1, 1, 1, 10).translate(0, 0.5, 0);
const HEAD = new ConeGeometry(1, 1, 14).translate(0, -0.5, 0);

/** Make a pose of the scene from 16 numbers, row by row. */
export function toMatrix(pose: Pose): Matrix4 {
  return new Matrix4().fromArray(pose as number[]).transpose();
}

/** An arrow; a moment has a second head. */
export class Arrow extends Group {
  private readonly shaft: Mesh;
  private readonly heads: Mesh[];

  constructor(
    colour: string,
    private readonly width: number,
    quantity: Quantity,
  ) {
    super();
    const material = new MeshBasicMaterial({ color: colour, depthTest: false, depthWrite: false, transparent: true });
    this.shaft = new Mesh(SHAFT, material);
    this.heads = Array.from({ length: quantity === "force" ? 1 : 2 }, () => new Mesh(HEAD, material));
    this.add(this.shaft, ...this.heads);
    for (const part of this.children) part.renderOrder = 20;
    this.visible = false;
  }

  /** Point from here along a vector; hidden where the vector is absent or zero. */
  point(from: Vector3, vector: Vector3): void {
    const length = vector.length();
    this.visible = Number.isFinite(length) && length > 1e-9;
    if (!this.visible) return;
    this.position.copy(from);
    this.quaternion.copy(new Quaternion().setFromUnitVectors(UP, vector.clone().divideScalar(length)));
    const head = Math.min(4.5 * this.width, 0.5 * length);
    this.shaft.scale.set(this.width, Math.max(length - head, 1e-9), this.width);
    this.heads.forEach((cone, k) => {
      cone.scale.set(0.45 * head, head, 0.45 * head);
      cone.position.y = length - 0.7 * k * head;
    });
  }
}

/** The axes of a frame with their names. */
export function axes(length: number, width: number, named: boolean): Group {
  const group = new Group();
  const directions = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];
  directions.forEach((direction, k) => {
    const colour = AXES[k] ?? INK;
    const arrow = new Arrow(colour, width, "force");
    arrow.point(new Vector3(), direction.clone().multiplyScalar(length));
    group.add(arrow);
    if (named) {
      const name = label("xyz"[k] ?? "", colour, 0.45 * length, true);
      name.position.copy(direction).multiplyScalar(1.25 * length);
      group.add(name);
    }
  });
  group.matrixAutoUpdate = false;
  return group;
}
