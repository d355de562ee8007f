// SPDX-License-Identifier: BSD-3-Clause
// Sensor frames with the wrenches that were measured and expected, and contacts.

import { Group, Matrix3, Matrix4, Sprite, Vector3 } from "three";

import { Arrow, axes, toMatrix } from "./arrows";
import { CONTACT, INK, seriesColour } from "./colours";
import { compose, IDENTITY, type Pose } from "./kinematics";
import { label } from "./labels3d";
import type { Quantity, SceneData } from "./scene_data";
import type { ContactSeries, WrenchSeries } from "./scene_types";
import type { State } from "./store";

const QUANTITIES: readonly Quantity[] = ["force", "moment"];
/** Share of the robot's size that the largest wrench is long. */
const LONGEST = 0.3;

/** Arrows of one series at one place. */
interface Drawn {
  readonly series: WrenchSeries | ContactSeries;
  readonly arrows: Readonly<Record<Quantity, Arrow>>;
}

/** One frame at a link, with arrows. */
interface Place {
  readonly sensor: number | null;
  readonly link: string;
  readonly link_H_frame: Pose;
  readonly frame: Group;
  readonly drawn: readonly Drawn[];
}

/** Everything that is drawn at sensors and contacts. */
export class WrenchArrows extends Group {
  /** Names of sensors and contacts, and letters of the axes. */
  readonly texts: Sprite[] = [];
  private readonly places: Place[];

  constructor(
    private readonly data: SceneData,
    private readonly size: number,
  ) {
    super();
    const { sensors, contacts } = data.scene;
    this.places = [
      ...sensors.map((sensor, k) => this.place(k, sensor.name, sensor.link, sensor.link_H_sensor, sensor.wrenches)),
      ...contacts.map((c) => this.place(null, c.name, c.link, c.link_H_contact, [c])),
    ];
  }

  /** Length of one newton and of one newton metre; m. */
  get metresPer(): Readonly<Record<Quantity, number>> {
    return { force: this.unit("force"), moment: this.unit("moment") };
  }

  /** Show the wrenches of the state in the posture of these poses. */
  update(state: State, poses: ReadonlyMap<string, Pose>): void {
    const { metresPer } = this;
    for (const place of this.places) {
      const pose = compose(poses.get(place.link) ?? IDENTITY, place.link_H_frame);
      const shown = place.sensor === null ? state.contacts : state.allSensors || place.sensor === state.sensor;
      place.frame.matrix.copy(toMatrix(pose));
      place.frame.visible = shown;
      for (const { series, arrows } of place.drawn) {
        const visible = shown && !("role" in series && state.hidden.has(series.name));
        for (const quantity of QUANTITIES) {
          const wanted = visible && (quantity === "force" ? state.forceArrows : state.momentArrows);
          const vector = new Vector3(...this.data.vector(series, state.sample, quantity)).multiplyScalar(metresPer[quantity]);
          turn(arrows[quantity], vector, wanted ? pose : null);
        }
      }
    }
  }

  private place(
    sensor: number | null,
    name: string,
    link: string,
    link_H_frame: Pose,
    series: readonly (WrenchSeries | ContactSeries)[],
  ): Place {
    const frame = new Group();
    frame.matrixAutoUpdate = false;
    frame.matrix = new Matrix4();
    const drawnAxes = axes(0.07 * this.size, 0.002 * this.size, sensor !== null);
    frame.add(drawnAxes);
    this.texts.push(...drawnAxes.children.filter((part) => part instanceof Sprite));
    // a contact at a sensor has its name there already
    if (sensor !== null || !this.data.scene.sensors.some((one) => one.name === name && one.link === link)) {
      const text = label(name, sensor === null ? CONTACT : INK, 0.032 * this.size, true);
      text.position.set(0, 0, -0.035 * this.size);
      frame.add(text);
      this.texts.push(text);
    }
    this.add(frame);
    const drawn = series.map((one) => {
      const colour = "role" in one ? this.colour(sensor, one) : CONTACT;
      // the expected wrench is the widest, so that a measured one on top of it leaves its rim
      const width = ("role" in one && one.role === "expected" ? 0.0065 : 0.0042) * this.size;
      const arrows = { force: new Arrow(colour, width, "force"), moment: new Arrow(colour, 0.7 * width, "moment") };
      this.add(arrows.force, arrows.moment);
      return { series: one, arrows };
    });
    return { sensor, link, link_H_frame, frame, drawn };
  }

  private colour(sensor: number | null, series: WrenchSeries): string {
    const of = sensor === null ? undefined : this.data.sensor(sensor);
    return of ? seriesColour(of, series) : CONTACT;
  }

  private unit(quantity: Quantity): number {
    const largest = this.data.scene.sensors.flatMap(({ wrenches }) => {
      const expected = wrenches.filter(({ role }) => role === "expected");
      return (expected.length > 0 ? expected : wrenches).map((one) => this.data.peak(one, quantity));
    });
    const peak = Math.max(0, ...largest);
    return peak > 0 ? (LONGEST * this.size) / peak : 1;
  }
}

/** Let an arrow begin at a pose and be a vector of its frame; hidden without a pose. */
function turn(arrow: Arrow, vector: Vector3, pose: Pose | null): void {
  if (pose === null) {
    arrow.visible = false;
    return;
  }
  const matrix = toMatrix(pose);
  arrow.point(new Vector3().setFromMatrixPosition(matrix), vector.applyMatrix3(new Matrix3().setFromMatrix4(matrix)));
}
