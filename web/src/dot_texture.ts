// SPDX-License-Identifier: BSD-3-Clause
// A round dot, because points are squares by themselves.

import { DataTexture, type Texture } from "three";

const SIDE = 32;
let dot: Texture | null = null;

/** Texture of a filled circle; one for the whole page. */
export function dotTexture(): Texture {
  if (dot) return dot;
  const pixels = new Uint8Array(4 * SIDE * SIDE).fill(255);
  for (let i = 0; i < SIDE * SIDE; i++) {
    const [x, y] = [(i % SIDE) - SIDE / 2 + 0.5, Math.floor(i / SIDE) - SIDE / 2 + 0.5];
    pixels[4 * i + 3] = Math.hypot(x, y) < SIDE / 2 ? 255 : 0;
  }
  dot = new DataTexture(pixels, SIDE, SIDE);
  dot.needsUpdate = true;
  return dot;
}
