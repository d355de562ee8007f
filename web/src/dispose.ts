// SPDX-License-Identifier: BSD-3-Clause
// Freeing what a part of a scene holds on the graphics card.

import { type BufferGeometry, type Material, type Object3D, Sprite } from "three";

/** Remove all children of a group and free what they hold; textures of points are shared and stay. */
export function empty(group: Object3D): void {
  group.traverse((part) => {
    if (part === group) return;
    if (part instanceof Sprite) {
      part.material.map?.dispose();
      part.material.dispose(); // the geometry of sprites is shared by all
      return;
    }
    const { geometry, material } = part as { geometry?: BufferGeometry; material?: Material };
    geometry?.dispose();
    material?.dispose();
  });
  group.clear();
}
