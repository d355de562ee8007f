// SPDX-License-Identifier: BSD-3-Clause
// Contacts on skin at an instant.

import type { SceneData } from "./scene_data";
import type { SkinContactFrames } from "./scene_types";

/** One contact. */
export interface SkinContact {
  readonly place: readonly number[];
  readonly force: readonly number[];
  /** Half axes of one standard deviation as the columns of a matrix, row by row; null where unknown. */
  readonly spread: readonly number[] | null;
  /** Number that it keeps from frame to frame. */
  readonly identity: number;
}

/** Frame that is shown at an instant; null before the first, and after the hold of one without a next. */
export function frameAt(data: SceneData, frames: SkinContactFrames, seconds: number): number | null {
  const times = data.doubles(frames.time_s);
  let low = 0;
  let high = times.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((times[middle] ?? 0) <= seconds) low = middle + 1;
    else high = middle;
  }
  const start = times[low - 1];
  return start !== undefined && seconds < start + frames.hold_s ? low - 1 : null;
}

/** Contacts of a frame; none without a frame. */
export function contactsOf(data: SceneData, frames: SkinContactFrames, frame: number | null): SkinContact[] {
  if (frame === null) return [];
  const first = data.integers(frames.first);
  const [places, forces] = [data.floats(frames.place), data.floats(frames.force)];
  const spreads = frames.spread ? data.floats(frames.spread) : null;
  const identities = data.integers(frames.identity);
  const [start, end] = [first[frame] ?? 0, first[frame + 1] ?? 0];
  return Array.from({ length: end - start }, (_, k) => {
    const at = start + k;
    const spread = spreads ? [...spreads.subarray(9 * at, 9 * at + 9)] : null;
    return {
      place: [...places.subarray(3 * at, 3 * at + 3)],
      force: [...forces.subarray(3 * at, 3 * at + 3)],
      spread: spread?.every(Number.isFinite) ? spread : null,
      identity: identities[at] ?? 0,
    };
  });
}

/** Standard deviation of the norm of a force: what its ellipsoid is long along it; NaN where unknown. */
export function deviation({ force, spread }: SkinContact): number {
  const norm = Math.hypot(...force);
  if (!spread || norm === 0) return Number.NaN;
  const along = [0, 1, 2].map((axis) =>
    force.reduce((sum, component, row) => sum + (component / norm) * (spread[3 * row + axis] ?? 0), 0),
  );
  return Math.hypot(...along);
}

/** Largest force of contacts; 0 without any. */
export function largestForce(data: SceneData, frames: SkinContactFrames): number {
  return largest(data, frames)[1];
}

/** Largest force of the contacts of every frame; 0 where it has none. */
export function frameForces(data: SceneData, frames: SkinContactFrames): Float32Array {
  const [first, forces] = [data.integers(frames.first), data.floats(frames.force)];
  const largestOf = new Float32Array(Math.max(0, first.length - 1));
  largestOf.forEach((_, frame) => {
    for (let k = first[frame] ?? 0; k < (first[frame + 1] ?? 0); k++) {
      const norm = Math.hypot(forces[3 * k] ?? 0, forces[3 * k + 1] ?? 0, forces[3 * k + 2] ?? 0);
      largestOf[frame] = Math.max(largestOf[frame] ?? 0, norm);
    }
  });
  return largestOf;
}

/** Instants at which contacts begin, of patches and of what a skinManager saw; s. */
export function contactStarts(data: SceneData): number[] {
  return [...data.scene.skin, ...data.scene.skin_events].flatMap(({ contacts }) => {
    const [times, first, identities] = [data.doubles(contacts.time_s), data.integers(contacts.first), data.integers(contacts.identity)];
    let known = new Set<number>();
    return [...times].filter((time, frame) => {
      const before = times[frame - 1];
      if (before !== undefined && time > before + contacts.hold_s) known = new Set();
      const now = new Set(identities.subarray(first[frame] ?? 0, first[frame + 1] ?? 0));
      const begins = [...now].some((identity) => !known.has(identity));
      known = now;
      return begins;
    });
  });
}

/** First sample of the frame with the largest contact, of patches before what a skinManager saw; null if none. */
export function largestContact(data: SceneData): number | null {
  for (const all of [data.scene.skin, data.scene.skin_events]) {
    const found = all.map(({ contacts }) => ({ contacts, most: largest(data, contacts) }));
    const { contacts, most } = found.sort((one, other) => other.most[1] - one.most[1])[0] ?? {};
    if (!contacts || !most || most[1] === 0) continue;
    const frame = data.integers(contacts.first).findIndex((first) => first > most[0]) - 1;
    return Math.min(data.firstAt(data.doubles(contacts.time_s)[frame] ?? 0), data.samples - 1);
  }
  return null;
}

/** Number of the contact with the largest force, and that force; N. */
function largest(data: SceneData, frames: SkinContactFrames): readonly [number, number] {
  const forces = data.floats(frames.force);
  let most: readonly [number, number] = [0, 0];
  for (let k = 0; k + 2 < forces.length; k += 3) {
    const norm = Math.hypot(forces[k] ?? 0, forces[k + 1] ?? 0, forces[k + 2] ?? 0);
    if (norm > most[1]) most = [k / 3, norm];
  }
  return most;
}
