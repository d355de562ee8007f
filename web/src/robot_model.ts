// SPDX-License-Identifier: BSD-3-Clause
// The robot's shapes, moved link by link; without shapes, lines between the links' origins.

import {
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  Color,
  CylinderGeometry,
  DoubleSide,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshLambertMaterial,
  SphereGeometry,
  Vector3,
} from "three";

import { toMatrix } from "./arrows";
import { ERROR, INK } from "./colours";
import type { Pose } from "./kinematics";
import type { SceneData } from "./scene_data";
import type { Shape } from "./scene_types";

const ERROR_COLOUR = new Color(ERROR);

/** What is drawn of the robot itself. */
export class RobotModel extends Group {
  private readonly links = new Map<string, Group>();
  private readonly bones: LineSegments | null;
  private readonly surfaces: { link: string; material: MeshLambertMaterial; own: Color }[] = [];

  constructor(private readonly data: SceneData) {
    super();
    const { shapes } = data.scene.robot;
    for (const name of data.scene.robot.links) {
      const link = new Group();
      link.matrixAutoUpdate = false;
      this.links.set(name, link);
      this.add(link);
    }
    for (const shape of shapes) this.links.get(shape.link)?.add(this.solid(shape));
    this.bones =
      shapes.length === 0 ? new LineSegments(new BufferGeometry(), new LineBasicMaterial({ color: INK })) : null;
    if (this.bones) {
      this.bones.frustumCulled = false;
      this.add(this.bones);
    }
  }

  /** Take the posture of these poses. */
  place(poses: ReadonlyMap<string, Pose>): void {
    for (const [name, link] of this.links) {
      const pose = poses.get(name);
      link.visible = pose !== undefined; // a link that no joint reaches is nowhere
      if (pose) link.matrix.copy(toMatrix(pose));
    }
    this.bones?.geometry.setFromPoints(
      this.data.scene.robot.joints.flatMap((j) => [origin(poses, j.parent), origin(poses, j.child)]),
    );
  }

  /** Give some links a share of the colour of errors, and all others their own. */
  tint(links: ReadonlySet<string>, share: number): void {
    for (const { link, material, own } of this.surfaces)
      material.color.copy(own).lerp(ERROR_COLOUR, links.has(link) ? share : 0);
  }

  private solid(shape: Shape): Mesh {
    const [red = 0.7, green = 0.7, blue = 0.7, opacity = 1] = shape.colour;
    const material = new MeshLambertMaterial({
      color: neutral(new Color().setRGB(red, green, blue, "srgb")),
      opacity,
      transparent: opacity < 1,
      flatShading: true, // scanned and drawn parts alike keep their edges, and files need no normals
      side: DoubleSide,
    });
    this.surfaces.push({ link: shape.link, material, own: material.color.clone() });
    const mesh = new Mesh(this.surface(shape), material);
    mesh.matrixAutoUpdate = false;
    mesh.matrix.copy(toMatrix(shape.link_H_shape));
    if (shape.kind === "mesh") {
      const [x = 1, y = 1, z = 1] = shape.size;
      mesh.matrix.scale(new Vector3(x, y, z));
    }
    return mesh;
  }

  private surface(shape: Shape): BufferGeometry {
    const [a = 0, b = 0, c = 0] = shape.size;
    if (shape.kind === "box") return new BoxGeometry(a, b, c);
    if (shape.kind === "sphere") return new SphereGeometry(a, 24, 16);
    if (shape.kind === "cylinder") return new CylinderGeometry(a, a, b, 32).rotateX(Math.PI / 2); // its axis is z
    const mesh = this.data.scene.robot.meshes[shape.mesh ?? -1];
    const geometry = new BufferGeometry();
    if (mesh) {
      geometry.setAttribute("position", new BufferAttribute(this.data.floats(mesh.vertices), 3));
      geometry.setIndex(new BufferAttribute(this.data.integers(mesh.faces), 1));
    }
    return geometry;
  }
}

/** A light grey, lighter for a lighter colour: on a red robot the red of an error would not be seen. */
function neutral({ r, g, b }: Color): Color {
  return new Color().setScalar(0.25 + 0.6 * (0.2126 * r + 0.7152 * g + 0.0722 * b));
}

/** Origin of a link in the world. */
export function origin(poses: ReadonlyMap<string, Pose>, link: string): Vector3 {
  const pose = poses.get(link);
  return new Vector3(pose?.[3] ?? 0, pose?.[7] ?? 0, pose?.[11] ?? 0);
}
