// SPDX-License-Identifier: BSD-3-Clause
// The last seconds of a stream, in arrays that begin empty: new rows come at their end, old ones leave at their begin.

import type { Block } from "./block";
import { SceneData, type Quantity } from "./scene_data";
import type { ArrayRef, ContactSeries, LiveFeed, LiveUpdate, Scene, WrenchSeries } from "./scene_types";

const STEPS = [1, 2, 5, 10]; // a scale that follows every sample would never be at rest

interface Kept {
  readonly values: Float32Array;
  readonly columns: number;
}

/** Samples of a stream. */
export class LiveData extends SceneData {
  readonly feed: LiveFeed;
  /** Whether there is room for less than the time that is wanted. */
  isFull = false;
  private count = 0;
  private readonly kept: readonly Kept[];

  constructor(scene: Scene, block: Block) {
    const refs = arraysOf(scene);
    const capacity = scene.time_s.shape[0] ?? 0;
    const arrays = refs.map((ref) => new Float32Array(capacity * (ref.shape[1] ?? 1)));
    const known = new Map<number, Float32Array | Float64Array>(refs.map((ref, k) => [ref.offset, arrays[k] ?? new Float32Array()]));
    super(scene, block, known.set(scene.time_s.offset, new Float64Array(capacity)));
    if (!scene.live) throw new Error("expected a scene of a stream");
    this.feed = scene.live;
    this.kept = arrays.map((values, k) => ({ values, columns: refs[k]?.shape[1] ?? 1 }));
    for (const { values } of this.kept) values.fill(Number.NaN);
  }

  override get samples(): number {
    return this.count;
  }

  /** Largest corrected norm in what is shown, rounded up to a step; a reading by the prior has any offset. */
  override peak(series: WrenchSeries | ContactSeries, quantity: Quantity): number {
    if (!("calibrated" in series && series.calibrated)) return 0;
    const { high } = this.columns.measured(series, quantity, 3).summary(0, this.count);
    if (!(high > 0)) return 0;
    const power = 10 ** Math.floor(Math.log10(high));
    return power * (STEPS.find((step) => step * power >= high) ?? 10);
  }

  /** Take the rows of an update in, as the scene describes them. */
  add({ rows }: LiveUpdate, bytes: Uint8Array): void {
    const expected = rows * (8 + 4 * this.kept.reduce((sum, { columns }) => sum + columns, 0));
    if (bytes.length !== expected) throw new Error(`expected ${expected} bytes of ${rows} rows, got ${bytes.length}`);
    if (rows === 0) return;
    const time = new Float64Array(bytes.slice(0, 8 * rows).buffer);
    this.makeRoom(rows, (time[rows - 1] ?? 0) - this.feed.window_s);
    this.time.set(time, this.count);
    let at = 8 * rows;
    for (const { values, columns } of this.kept) {
      const end = at + 4 * rows * columns;
      values.set(new Float32Array(bytes.slice(at, end).buffer), this.count * columns);
      at = end;
    }
    this.count += rows;
    this.columns.forget();
  }

  /** Leave out what is older than an instant, and more where there is no room for some rows. */
  private makeRoom(rows: number, oldest_s: number): void {
    const old = this.count === 0 ? 0 : this.firstAt(oldest_s);
    const over = this.count + rows - this.time.length;
    this.isFull = over > old;
    const leave = Math.min(this.count, Math.max(old, over));
    this.time.copyWithin(0, leave, this.count);
    for (const { values, columns } of this.kept) values.copyWithin(0, leave * columns, this.count * columns);
    this.count -= leave;
  }
}

/** Arrays of an update, in their order. */
function arraysOf({ positions, root, sensors }: Scene): ArrayRef[] {
  const series = sensors.flatMap(({ wrenches }) => wrenches);
  return [positions, root, ...series.flatMap(({ values, deviation }) => (deviation ? [values, deviation] : [values]))];
}
