// SPDX-License-Identifier: BSD-3-Clause
// The robot in its posture, with the wrenches at its sensors.

import { Box3, DirectionalLight, GridHelper, Group, HemisphereLight, Vector3 } from "three";

import { toMatrix } from "./arrows";
import { EARTH, FAINT, PALE, SKY } from "./colours";
import { empty } from "./dispose";
import { ErrorOnRobot } from "./error_on_robot";
import type { Frames } from "./frames";
import { linkPoses, type Pose } from "./kinematics";
import { drawnRectangles, spread } from "./label_places";
import { origin, RobotModel } from "./robot_model";
import type { SceneData } from "./scene_data";
import { SkinView } from "./skin_view";
import type { State } from "./store";
import { View3D } from "./view3d";
import { WrenchArrows } from "./wrench_arrows";

const POSTURES = 24;
/** Size of a picture of a sensor's frame alone; m. */
const FRAME_ALONE = 0.1;

/** The view of the robot. */
export class RobotView extends View3D {
  readonly wrenches: WrenchArrows;
  readonly skin: SkinView;
  readonly error: ErrorOnRobot;
  private readonly model: RobotModel;
  private readonly ground = new Group();

  constructor(
    panel: HTMLElement,
    frames: Frames,
    private readonly data: SceneData,
  ) {
    super(panel, "Robot in its posture at the current sample", frames);
    const light = new DirectionalLight(SKY, 1.9);
    light.position.set(2, -3, 5);
    this.scene.add(new HemisphereLight(SKY, EARTH, 2.2), light);
    this.model = new RobotModel(data);
    this.scene.add(this.model);
    this.scene.add(this.ground);
    const size = this.aim();
    this.wrenches = new WrenchArrows(data, size);
    this.scene.add(this.wrenches);
    this.skin = new SkinView(data, size);
    this.error = new ErrorOnRobot(data, this.model, size);
    this.scene.add(this.skin, this.error);
  }

  /** Look at the robot from where its postures are seen whole; gives its size; m. */
  aim(): number {
    const room = this.reach();
    const reach = room.getSize(new Vector3()).length();
    const size = reach > 1e-3 ? reach : FRAME_ALONE;
    this.floor(room, size);
    const middle = room.getCenter(new Vector3());
    const { sensors, coordinates } = this.data.scene;
    // skin alone and a load without a robot fill their room, a robot does not
    const away = (sensors.length === 0 ? 1.25 : coordinates.length === 0 ? 1.6 : 1) * size;
    this.lookFrom(middle.clone().add(new Vector3(0.82, -0.95, 0.45).multiplyScalar(away)), middle);
    return size;
  }

  /** Show the state. */
  update(state: State): void {
    const poses = linkPoses(this.data, state.sample);
    this.model.place(poses);
    this.wrenches.update(state, poses);
    this.skin.update(state, poses);
    this.error.update(state, poses);
    this.frames.later(this);
  }

  override draw(): void {
    this.scene.updateMatrixWorld();
    spread(this.wrenches.texts, this.camera);
    super.draw();
  }

  /** Rectangles of names and letters that are drawn; CSS pixels of the canvas. */
  labels(): ReturnType<typeof drawnRectangles> {
    return drawnRectangles(this.wrenches.texts, this.camera, this.canvas);
  }

  /** Room of the robot over postures of the whole recording. */
  private reach(): Box3 {
    const count = Math.min(POSTURES, Math.max(1, this.data.samples));
    const postures = Array.from({ length: count }, (_, k) => this.data.keySample(Math.floor((k * this.data.samples) / count), POSTURES));
    const room = new Box3();
    let poses = new Map<string, Pose>();
    for (const sample of new Set(postures)) {
      poses = linkPoses(this.data, sample);
      for (const link of poses.keys()) room.expandByPoint(origin(poses, link));
    }
    this.model.place(poses);
    this.model.updateMatrixWorld(true);
    for (const { link, vertices } of this.data.scene.skin) {
      const pose = poses.get(link);
      if (!pose) continue;
      const box = new Box3().setFromArray(this.data.floats(vertices));
      room.union(box.applyMatrix4(toMatrix(pose)));
    }
    return room.union(new Box3().setFromObject(this.model));
  }

  private floor(room: Box3, size: number): void {
    const grid = new GridHelper(2 * size, 20, FAINT, PALE);
    grid.rotateX(Math.PI / 2); // drawn in x-z, wanted in x-y
    const middle = room.getCenter(new Vector3());
    grid.position.set(middle.x, middle.y, room.min.z);
    empty(this.ground);
    this.ground.add(grid);
  }
}
