// SPDX-License-Identifier: BSD-3-Clause
// The space of forces or moments: clouds of all samples, and where the current one lies.

import { BufferAttribute, BufferGeometry, Group, Points, PointsMaterial, Vector3, type Sprite } from "three";

import type { Cloud, CloudMaker, Clouds } from "./clouds";
import { EXPECTED, PAPER } from "./colours";
import { empty } from "./dispose";
import { dotTexture } from "./dot_texture";
import type { Frames } from "./frames";
import { drawnRectangles, thinOut } from "./label_places";
import type { SceneData } from "./scene_data";
import { cube, toCube } from "./space_axes";
import type { State, Store } from "./store";
import { goesOn } from "./transport";
import { View3D } from "./view3d";
import { asEllipsoid, wireframe } from "./wireframes";

const REACH = 12; // pixels within which a click takes a point
const MOVED = 4; // pixels after which a click is a turn of the view

/** The view of the force or moment space. */
export class SpaceView extends View3D {
  private readonly fixedParts = new Group();
  private readonly markers = new Group();
  private clouds: Clouds | null = null;
  private drawn = "";
  private texts: readonly Sprite[] = [];

  constructor(
    panel: HTMLElement,
    frames: Frames,
    private readonly data: SceneData,
    private readonly maker: CloudMaker,
    private readonly store: Store,
  ) {
    super(panel, "Force or moment space with the current sample", frames);
    this.scene.add(this.fixedParts, this.markers);
    this.lookFrom(new Vector3(2.75, -4.6, 2.2), new Vector3(0, -0.1, -0.05));
    this.jumpOnClick();
  }

  /** Show the state. */
  update(state: State): void {
    const clouds = this.maker.of(state);
    const look = JSON.stringify([[...state.hidden], state.wireframes]);
    if (clouds !== this.clouds || look !== this.drawn) this.rebuild(clouds, state);
    this.clouds = clouds;
    this.drawn = look;
    this.mark(clouds, state);
    this.frames.later(this);
  }

  override draw(): void {
    this.scene.updateMatrixWorld();
    thinOut(this.texts, this.camera);
    super.draw();
  }

  /** Rectangles of names and numbers of the axes that are drawn; CSS pixels of the canvas. */
  labels(): ReturnType<typeof drawnRectangles> {
    return drawnRectangles(this.texts, this.camera, this.canvas);
  }

  /** Where a sample of a series is on the canvas. */
  sampleOnCanvas(series: number, sample: number): { x: number; y: number } | null {
    const cloud = this.clouds?.clouds[series];
    if (!this.clouds || !cloud) return null;
    return this.onCanvas(toCube(this.clouds, this.data.vector(cloud.series, sample, this.store.state.quantity)));
  }

  /** Samples whose points are drawn. */
  samples(): Uint32Array {
    return this.clouds?.samples ?? new Uint32Array();
  }

  private rebuild(clouds: Clouds, state: State): void {
    empty(this.fixedParts);
    const { group, texts } = cube(clouds, state.quantity);
    this.texts = texts;
    this.fixedParts.add(group);
    for (const cloud of this.visible(clouds, state)) {
      this.fixedParts.add(points(clouds, cloud));
      if (!state.wireframes) continue;
      const lines = new Group();
      if (cloud.sphere) lines.add(wireframe(asEllipsoid(cloud.sphere), EXPECTED, 0.22));
      if (cloud.ellipsoid) lines.add(wireframe(cloud.ellipsoid, cloud.colour, 0.45));
      lines.scale.setScalar(1 / clouds.half);
      lines.position.copy(toCube(clouds, [0, 0, 0]));
      this.fixedParts.add(lines);
    }
  }

  /** Mark the current sample of every series, also inside the cloud. */
  private mark(clouds: Clouds, state: State): void {
    empty(this.markers);
    for (const cloud of this.visible(clouds, state)) {
      const at = toCube(clouds, this.data.vector(cloud.series, state.sample, state.quantity));
      if (!Number.isFinite(at.x + at.y + at.z)) continue;
      const geometry = new BufferGeometry().setFromPoints([at]);
      for (const [size, colour] of [
        [17, PAPER],
        [14, cloud.colour],
        [5, PAPER],
      ] as const) {
        const dot = new Points(
          geometry,
          new PointsMaterial({
            color: colour,
            size,
            sizeAttenuation: false,
            map: dotTexture(),
            transparent: true,
            depthTest: false,
            alphaTest: 0.5,
          }),
        );
        dot.renderOrder = 20;
        this.markers.add(dot);
      }
    }
  }

  private visible(clouds: Clouds, state: State): Cloud[] {
    return clouds.clouds.filter((cloud) => !state.hidden.has(cloud.series.name));
  }

  private jumpOnClick(): void {
    let from: [number, number] = [0, 0];
    this.canvas.addEventListener("pointerdown", (event) => {
      from = [event.clientX, event.clientY];
    });
    this.canvas.addEventListener("click", (event) => {
      if (Math.hypot(event.clientX - from[0], event.clientY - from[1]) > MOVED || goesOn(this.data, this.store)) return;
      const box = this.canvas.getBoundingClientRect();
      const sample = this.closest(event.clientX - box.left, event.clientY - box.top);
      if (sample !== null) this.store.set({ sample, playing: false });
    });
  }

  /** Sample of the point that is drawn closest to a place on the canvas, if one is near. */
  private closest(x: number, y: number): number | null {
    if (!this.clouds) return null;
    let best: { sample: number; distance: number } | null = null;
    for (const cloud of this.visible(this.clouds, this.store.state)) {
      this.clouds.samples.forEach((sample, k) => {
        const at = this.clouds && this.onCanvas(toCube(this.clouds, cloud.points.subarray(3 * k, 3 * k + 3)));
        if (!at || Number.isNaN(at.x)) return;
        const distance = Math.hypot(at.x - x, at.y - y);
        if (distance < (best?.distance ?? REACH)) best = { sample, distance };
      });
    }
    return (best as { sample: number } | null)?.sample ?? null;
  }
}

function points(clouds: Clouds, cloud: Cloud): Points {
  const places = new Float32Array(cloud.points.length);
  const middle = new Vector3(...clouds.centre);
  let count = 0;
  const at = new Vector3();
  for (let k = 0; k + 2 < cloud.points.length; k += 3) {
    at.fromArray(cloud.points, k).sub(middle).divideScalar(clouds.half); // as toCube
    if (Number.isFinite(at.x + at.y + at.z)) at.toArray(places, count++ * 3);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(places.subarray(0, 3 * count), 3));
  return new Points(
    geometry,
    new PointsMaterial({ color: cloud.colour, size: 3, sizeAttenuation: false, map: dotTexture(), alphaTest: 0.5 }),
  );
}
