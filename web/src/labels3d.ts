// SPDX-License-Identifier: BSD-3-Clause
// Short texts in space that always face the viewer.

import { CanvasTexture, Sprite, SpriteMaterial } from "three";

import { faded, PAPER } from "./colours";

const HEIGHT = 64; // pixels of the texture

/** Make a text; `height` in the units of the scene. */
export function label(text: string, colour: string, height: number, onTop = false): Sprite {
  const canvas = document.createElement("canvas");
  const font = `600 ${0.75 * HEIGHT}px system-ui, "DejaVu Sans", sans-serif`;
  let pen = canvas.getContext("2d");
  if (!pen) throw new Error("this browser draws no text on a canvas");
  pen.font = font;
  canvas.width = Math.ceil(pen.measureText(text).width) + 12;
  canvas.height = HEIGHT;
  pen = canvas.getContext("2d");
  if (pen) {
    pen.font = font;
    pen.textAlign = "center";
    pen.textBaseline = "middle";
    pen.lineWidth = 6;
    pen.lineJoin = "round";
    pen.strokeStyle = faded(PAPER, 0.85);
    pen.strokeText(text, canvas.width / 2, HEIGHT / 2);
    pen.fillStyle = colour;
    pen.fillText(text, canvas.width / 2, HEIGHT / 2);
  }
  const map = new CanvasTexture(canvas);
  map.colorSpace = "srgb";
  const sprite = new Sprite(new SpriteMaterial({ map, depthTest: !onTop, depthWrite: false }));
  sprite.scale.set((height * canvas.width) / HEIGHT, height, 1);
  sprite.renderOrder = onTop ? 30 : 5;
  return sprite;
}
