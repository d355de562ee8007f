// SPDX-License-Identifier: BSD-3-Clause
// The error of the chosen sensor on the robot: an arrow at its frame, and the colour of the limb beyond it.

import { Group, Matrix3, Vector3 } from "three";

import { Arrow, toMatrix } from "./arrows";
import { ERROR } from "./colours";
import { expectedOf, mainSeries, type Component } from "./columns";
import { compose, IDENTITY, type Pose } from "./kinematics";
import { worstSample } from "./points_of_interest";
import type { RobotModel } from "./robot_model";
import type { SceneData } from "./scene_data";
import type { Sensor } from "./scene_types";
import type { State } from "./store";

const LONGEST = 0.25; // share of the robot's size that the worst error is long
const TINT = 0.85; // share of its own colour that the limb gives up at most
const TINTED = 0.1; // share of the largest expected load at which it does

/** What is drawn of the error. */
export class ErrorOnRobot extends Group {
  /** Length of one newton, or of one newton metre, of error; m; null where no error is known. */
  metresPer: number | null = null;
  private readonly arrows: Readonly<Record<State["quantity"], Arrow>>;
  /** Error at which the limb has the full colour; N, N m; null where no error is known. */
  fullColour: number | null = null;
  private key = "";

  constructor(
    private readonly data: SceneData,
    private readonly model: RobotModel,
    private readonly size: number,
  ) {
    super();
    const width = 0.0075 * size;
    this.arrows = { force: new Arrow(ERROR, width, "force"), moment: new Arrow(ERROR, 0.7 * width, "moment") };
    this.add(this.arrows.force, this.arrows.moment);
  }

  /** Show the error of the state in the posture of these poses. */
  update(state: State, poses: ReadonlyMap<string, Pose>): void {
    const sensor = this.data.sensor(state.sensor);
    this.fit(state);
    const error = sensor && state.errorOnRobot && this.metresPer !== null ? this.vector(state, sensor) : null;
    for (const arrow of Object.values(this.arrows)) arrow.visible = false;
    this.model.tint(new Set(), 0);
    if (!sensor || !error || this.metresPer === null || this.fullColour === null) return;
    const pose = toMatrix(compose(poses.get(sensor.link) ?? IDENTITY, sensor.link_H_sensor));
    const size = error.length();
    error.applyMatrix3(new Matrix3().setFromMatrix4(pose)).multiplyScalar(this.metresPer);
    this.arrows[state.quantity].point(new Vector3().setFromMatrixPosition(pose), error);
    if (Number.isFinite(size)) this.model.tint(limb(this.data, sensor), TINT * Math.min(1, size / this.fullColour));
  }

  private vector(state: State, sensor: Sensor): Vector3 | null {
    const series = mainSeries(sensor, state.hidden);
    if (!series) return null;
    const at = (component: Component): number =>
      this.data.columns.error(sensor, series, state.quantity, component)?.at(state.sample) ?? Number.NaN;
    return new Vector3(at(0), at(1), at(2));
  }

  /** The worst error of the validation data sets the scale of the arrow, the largest expected load that of the colour. */
  private fit(state: State): void {
    const key = JSON.stringify([state.sensor, state.quantity, [...state.hidden]]);
    if (key === this.key) return;
    this.key = key;
    const sensor = this.data.sensor(state.sensor);
    const series = mainSeries(sensor, state.hidden);
    const sample = worstSample(this.data, { ...state, window: this.data.span });
    const error = sensor && series && this.data.columns.error(sensor, series, state.quantity, 3);
    const worst = error && sample !== null ? error.at(sample) : 0;
    const expected = expectedOf(sensor);
    const load = expected?.peak[state.quantity === "force" ? 0 : 1] ?? 0;
    this.metresPer = worst > 0 ? (LONGEST * this.size) / worst : null;
    this.fullColour = load > 0 ? TINTED * load : null;
  }
}

/** Links beyond a sensor, up to the next sensors. */
function limb({ scene }: SceneData, sensor: Sensor): ReadonlySet<string> {
  const ends = ({ acting, acted_on }: Sensor): string | undefined =>
    scene.robot.joints.find(
      ({ parent, child }) => (parent === acting && child === acted_on) || (parent === acted_on && child === acting),
    )?.child;
  const first = ends(sensor);
  const others = new Set(scene.sensors.filter((other) => other !== sensor).map(ends));
  const links = new Set<string>(first === undefined ? [] : [first]);
  for (const { parent, child } of scene.robot.joints) if (links.has(parent) && !others.has(child)) links.add(child);
  return links;
}
