// SPDX-License-Identifier: BSD-3-Clause
// Skin on the robot: pressure as colour of its surface, contacts as arrows with an ellipsoid of one standard deviation.

import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DoubleSide,
  Group,
  Mesh,
  MeshBasicMaterial,
  SphereGeometry,
  Vector3,
} from "three";

import { Arrow, toMatrix } from "./arrows";
import { HEURISTIC, SKIN } from "./colours";
import { PRESSURES } from "./visual_roles";
import type { Pose } from "./kinematics";
import { label } from "./labels3d";
import type { SceneData } from "./scene_data";
import type { SkinContactFrames, SkinEventSeries, SkinPatch } from "./scene_types";
import { contactsOf, frameAt, largestForce, type SkinContact } from "./skin_frames";
import type { State } from "./store";

/** Share of the robot's size that the largest contact is long. */
const LONGEST = 0.2;
const STOPS = PRESSURES.map((colour) => new Color(colour));
const BALL = new SphereGeometry(1, 20, 14);

/** What is drawn of skin, for programs. */
export interface SkinShown {
  readonly pressed: Readonly<Record<string, number>>;
  readonly contacts: Readonly<Record<string, readonly number[][]>>;
  readonly ellipsoids: number;
}

/** Arrows of the contacts of one series, as many as a frame has. */
class ContactArrows extends Group {
  private readonly arrows: Arrow[] = [];
  private readonly balls: Mesh[] = [];
  private readonly words: Group | null;
  private tips: number[][] = [];

  constructor(
    private readonly colour: string,
    private readonly size: number,
    word: string | null,
  ) {
    super();
    this.matrixAutoUpdate = false;
    this.words = word === null ? null : new Group();
    if (this.words && word !== null) {
      this.words.add(label(word, colour, 0.03 * size, true));
      this.add(this.words);
    }
  }

  /** Draw these contacts; forces become this long by unit. */
  point(contacts: readonly SkinContact[], metresPer: number): void {
    while (this.arrows.length < contacts.length) this.addOne();
    this.tips = [];
    this.arrows.forEach((arrow, k) => {
      const ball = this.balls[k];
      const contact = contacts[k];
      if (ball) ball.visible = false;
      arrow.visible = false;
      if (!contact) return;
      const from = new Vector3().fromArray([...contact.place]);
      const along = new Vector3().fromArray([...contact.force]).multiplyScalar(metresPer);
      arrow.point(from, along);
      this.tips.push(from.clone().add(along).toArray());
      if (ball && contact.spread) this.stretch(ball, from.add(along), contact.spread, metresPer);
    });
    const [first] = contacts;
    if (this.words) {
      this.words.visible = first !== undefined;
      if (first) this.words.position.fromArray([...first.place]);
    }
  }

  /** Tips of the arrows in the world. */
  inWorld(): number[][] {
    return this.visible ? this.tips.map((tip) => new Vector3().fromArray(tip).applyMatrix4(this.matrix).toArray()) : [];
  }

  /** Number of ellipsoids that are drawn. */
  get ellipsoids(): number {
    return this.visible ? this.balls.filter((ball) => ball.visible).length : 0;
  }

  private stretch(ball: Mesh, centre: Vector3, spread: readonly number[], metresPer: number): void {
    const [a = 0, b = 0, c = 0, d = 0, e = 0, f = 0, g = 0, h = 0, i = 0] = spread.map((value) => value * metresPer);
    ball.matrix.set(a, b, c, centre.x, d, e, f, centre.y, g, h, i, centre.z, 0, 0, 0, 1);
    ball.visible = true;
  }

  private addOne(): void {
    const arrow = new Arrow(this.colour, 0.0038 * this.size, "force");
    const ball = new Mesh(
      BALL,
      new MeshBasicMaterial({
        color: this.colour,
        opacity: 0.35,
        transparent: true,
        depthTest: false,
        depthWrite: false,
        side: DoubleSide, // the axes of an ellipsoid may be a mirror image
      }),
    );
    ball.matrixAutoUpdate = false;
    ball.visible = false;
    ball.renderOrder = 21;
    this.arrows.push(arrow);
    this.balls.push(ball);
    this.add(arrow, ball);
  }
}

/** The surface of one patch. */
class Surface extends Mesh<BufferGeometry, MeshBasicMaterial> {
  /** Taxels with a pressure. */
  pressed = 0;
  private readonly colours: BufferAttribute;

  constructor(
    private readonly data: SceneData,
    private readonly patch: SkinPatch,
  ) {
    // drawn a little nearer than the link's own mesh, in which it lies
    const material = new MeshBasicMaterial({ vertexColors: true, side: DoubleSide, polygonOffset: true });
    [material.polygonOffsetFactor, material.polygonOffsetUnits] = [-4, -4];
    super(new BufferGeometry(), material);
    const count = patch.vertices.shape[0] ?? 0;
    this.colours = new BufferAttribute(new Float32Array(3 * count), 3);
    this.geometry.setAttribute("position", new BufferAttribute(data.floats(patch.vertices), 3));
    this.geometry.setAttribute("color", this.colours);
    this.geometry.setIndex(new BufferAttribute(data.integers(patch.faces), 1));
    this.matrixAutoUpdate = false;
  }

  /** Colour the pressures of a frame; none without a frame. */
  colour(frame: number | null): void {
    const count = this.colours.count;
    const pressures = frame === null ? null : this.data.floats(this.patch.pressure).subarray(frame * count);
    this.pressed = 0;
    for (let taxel = 0; taxel < count; taxel++) {
      const pressure = pressures?.[taxel] ?? 0;
      if (pressure > 0) this.pressed++;
      const { r, g, b } = pressureColour(pressure / (this.patch.largest_Pa || 1));
      this.colours.setXYZ(taxel, r, g, b);
    }
    this.colours.needsUpdate = true;
  }
}

/** All skin of a scene. */
export class SkinView extends Group {
  /** Length of one newton on skin, in the robot's view; m. */
  readonly metresPer: number;
  private readonly patches: { patch: SkinPatch; surface: Surface; arrows: ContactArrows }[];
  private readonly events: { series: SkinEventSeries; arrows: ContactArrows; metresPer: number }[];

  constructor(
    private readonly data: SceneData,
    size: number,
  ) {
    super();
    const { skin, skin_events: events } = data.scene;
    this.metresPer = unit(data, skin.map((patch) => patch.contacts), size);
    const heuristic = unit(data, events.map((series) => series.contacts), size);
    this.patches = skin.map((patch) => {
      return { patch, surface: new Surface(data, patch), arrows: new ContactArrows(SKIN, size, null) };
    });
    this.events = events.map((series) => {
      return { series, arrows: new ContactArrows(HEURISTIC, size, "heuristic"), metresPer: heuristic };
    });
    for (const { surface, arrows } of this.patches) this.add(surface, arrows);
    for (const { arrows } of this.events) this.add(arrows);
  }

  /** Show the frames of the state's instant in the posture of these poses. */
  update(state: State, poses: ReadonlyMap<string, Pose>): void {
    const seconds = this.data.time[state.sample] ?? Number.NaN;
    for (const { patch, surface, arrows } of this.patches) {
      const pose = poses.get(patch.link);
      surface.visible = arrows.visible = state.skin && pose !== undefined;
      if (!surface.visible || !pose) continue;
      const frame = frameAt(this.data, patch.contacts, seconds);
      surface.matrix.copy(toMatrix(pose));
      surface.colour(frame);
      this.turn(arrows, patch.contacts, frame, pose, this.metresPer);
    }
    for (const { series, arrows, metresPer } of this.events) {
      const pose = poses.get(series.link);
      arrows.visible = state.skinEvents && pose !== undefined;
      if (pose) this.turn(arrows, series.contacts, frameAt(this.data, series.contacts, seconds), pose, metresPer);
    }
  }

  /** What is drawn now. */
  shown(): SkinShown {
    const all = [
      ...this.patches.map(({ patch, arrows }) => [patch.name, arrows] as const),
      ...this.events.map(({ series, arrows }) => [series.name, arrows] as const),
    ];
    return {
      pressed: Object.fromEntries(
        this.patches.map(({ patch, surface }) => [patch.name, surface.visible ? surface.pressed : 0]),
      ),
      contacts: Object.fromEntries(all.map(([name, arrows]) => [name, arrows.inWorld()])),
      ellipsoids: all.reduce((sum, [, arrows]) => sum + arrows.ellipsoids, 0),
    };
  }

  private turn(
    arrows: ContactArrows,
    frames: SkinContactFrames,
    frame: number | null,
    pose: Pose,
    metresPer: number,
  ): void {
    arrows.matrix.copy(toMatrix(pose));
    arrows.point(contactsOf(this.data, frames, frame), metresPer);
  }
}

/** Colour of a pressure from 0 to 1. */
export function pressureColour(share: number): Color {
  const place = Math.min(1, Math.max(0, share)) * (STOPS.length - 1);
  const below = Math.min(Math.floor(place), STOPS.length - 2);
  return new Color().lerpColors(STOPS[below] ?? new Color(), STOPS[below + 1] ?? new Color(), place - below);
}

function unit(data: SceneData, all: readonly SkinContactFrames[], size: number): number {
  const peak = Math.max(0, ...all.map((frames) => largestForce(data, frames)));
  return peak > 0 ? (LONGEST * size) / peak : 1;
}
