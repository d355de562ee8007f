// SPDX-License-Identifier: BSD-3-Clause
// A canvas with a scene, a camera to turn around it, and drawing on demand.

import { Color, PerspectiveCamera, Scene, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

import { PAPER } from "./colours";
import { el } from "./dom";
import type { Drawable, Frames } from "./frames";

const TURN = Math.PI / 24;
const ZOOM = 1.15;
const LARGEST_RATIO = 2;

/** A view of a scene; z is up. */
export class View3D implements Drawable {
  readonly canvas: HTMLCanvasElement;
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(35, 1, 0.01, 100);
  private readonly renderer: WebGLRenderer | null;
  private readonly controls: OrbitControls;
  private home: { from: Vector3; at: Vector3 } = { from: new Vector3(3, -3, 2), at: new Vector3() };
  private fixed = false;
  private size = "";

  constructor(
    private readonly panel: HTMLElement,
    name: string,
    readonly frames: Frames,
  ) {
    this.renderer = makeRenderer();
    this.canvas = this.renderer?.domElement ?? document.createElement("canvas");
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", name);
    panel.append(this.canvas);
    if (!this.renderer)
      panel.append(el("p", { class: "overlay absent" }, "This browser draws nothing in 3-D: it has no WebGL 2."));
    this.scene.background = new Color(PAPER);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.addEventListener("change", () => frames.later(this));
    this.canvas.addEventListener("keydown", (event) => this.turnByKey(event));
    this.fit();
    new ResizeObserver(() => this.fit()).observe(panel);
  }

  /** Look from here, now and after a reset. */
  lookFrom(from: Vector3, at: Vector3): void {
    this.home = { from: from.clone(), at: at.clone() };
    const distance = from.distanceTo(at);
    this.camera.near = distance / 100;
    this.camera.far = distance * 20;
    this.reset();
  }

  /** Look from where the view began. */
  reset(): void {
    this.camera.position.copy(this.home.from);
    this.controls.target.copy(this.home.at);
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.frames.later(this);
  }

  /** Draw now. */
  draw(): void {
    this.renderer?.render(this.scene, this.camera);
  }

  /** Draw in a fixed size, one pixel each, until `release`. */
  hold(width: number, height: number): void {
    this.fixed = true;
    this.resize(width, height, 1, false);
  }

  /** Take the size of the panel again. */
  release(): void {
    this.fixed = false;
    this.size = "";
    this.fit();
  }

  /** Where a point of the scene is on the canvas; CSS pixels from its upper left corner; null if behind the camera. */
  onCanvas(point: Vector3): { x: number; y: number } | null {
    const p = point.clone().project(this.camera);
    if (p.z > 1) return null;
    return { x: (0.5 + 0.5 * p.x) * this.canvas.clientWidth, y: (0.5 - 0.5 * p.y) * this.canvas.clientHeight };
  }

  private fit(): void {
    const { clientWidth: width, clientHeight: height } = this.panel;
    const ratio = Math.min(devicePixelRatio, LARGEST_RATIO);
    const size = `${width} ${height} ${ratio}`;
    if (this.fixed || width === 0 || height === 0 || size === this.size) return;
    this.size = size;
    this.resize(width, height, ratio, true);
    this.frames.later(this);
  }

  private resize(width: number, height: number, ratio: number, style: boolean): void {
    this.renderer?.setPixelRatio(ratio);
    this.renderer?.setSize(width, height, style);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
  }

  /** Alt and arrows turn the view, plus and minus come closer and go away, 0 resets. */
  private turnByKey(event: KeyboardEvent): void {
    const arm = this.camera.position.clone().sub(this.controls.target);
    const side = new Vector3().crossVectors(this.camera.up, arm).normalize();
    const turns: Record<string, () => void> = {
      ArrowLeft: () => arm.applyAxisAngle(this.camera.up, -TURN),
      ArrowRight: () => arm.applyAxisAngle(this.camera.up, TURN),
      ArrowUp: () => arm.applyAxisAngle(side, -TURN),
      ArrowDown: () => arm.applyAxisAngle(side, TURN),
    };
    const zooms: Record<string, () => void> = {
      "+": () => arm.divideScalar(ZOOM),
      "-": () => arm.multiplyScalar(ZOOM),
      "0": () => arm.copy(this.home.from).sub(this.controls.target),
    };
    const move = event.altKey ? turns[event.key] : zooms[event.key];
    if (!move) return;
    event.preventDefault();
    event.stopPropagation();
    move();
    this.camera.position.copy(this.controls.target).add(arm);
    this.controls.update();
    this.frames.later(this);
  }
}

/** Planes, plots and numbers work without a graphics card, so its absence is no end of the page. */
function makeRenderer(): WebGLRenderer | null {
  try {
    // the picture is kept after it is shown, so that it can be copied into a film
    return new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  } catch {
    return null;
  }
}
