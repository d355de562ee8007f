// SPDX-License-Identifier: BSD-3-Clause
// The scene with its arrays.

import { Columns } from "./columns";
import { PackedArray } from "./packed";
import type { ArrayRef, ContactSeries, Scene, Sensor, WrenchSeries } from "./scene_types";

/** What a wrench is made of. */
export type Quantity = "force" | "moment";

/** Unit of a quantity. */
export const UNIT = { force: "N", moment: "N m" } as const;

/** Where a quantity starts in a wrench. */
export const FIRST = { force: 0, moment: 3 } as const;

type Vector = [number, number, number];

/** Header and arrays of a scene. */
export class SceneData {
  readonly time: Float64Array;
  private readonly unpacked = new Map<number, Float32Array>();
  private readonly packed = new Map<number, PackedArray>();
  /** Quantities over time. */
  readonly columns = new Columns(this);

  constructor(
    readonly scene: Scene,
    private readonly block: ArrayBuffer,
  ) {
    this.time = this.doubles(scene.time_s);
  }

  /** Number of samples. */
  get samples(): number {
    return this.scene.samples;
  }

  /** Values of a float32 array, unpacked when they are first asked for. */
  floats(ref: ArrayRef): Float32Array {
    if (ref.packed_bytes !== null) {
      const values = this.unpacked.get(ref.offset) ?? this.rows(ref).all();
      this.unpacked.set(ref.offset, values);
      return values;
    }
    return new Float32Array(this.block, this.placed(ref, "float32", 4), size(ref));
  }

  /** Values of one row of a float32 array over time, of which no more than a block is unpacked. */
  row(ref: ArrayRef, index: number): Float32Array {
    if (ref.packed_bytes !== null) return this.rows(ref).row(index);
    const columns = ref.shape[1] ?? 1;
    return this.floats(ref).subarray(index * columns, (index + 1) * columns);
  }

  private rows(ref: ArrayRef): PackedArray {
    const known = this.packed.get(ref.offset);
    if (known) return known;
    this.within(ref.offset + (ref.packed_bytes ?? 0));
    const packed = new PackedArray(this.block, ref.offset, ref.shape[0] ?? 0, ref.shape[1] ?? 0);
    this.packed.set(ref.offset, packed);
    return packed;
  }

  /** Values of a float64 array. */
  doubles(ref: ArrayRef): Float64Array {
    return new Float64Array(this.block, this.placed(ref, "float64", 8), size(ref));
  }

  /** Values of a uint32 array. */
  integers(ref: ArrayRef): Uint32Array {
    return new Uint32Array(this.block, this.placed(ref, "uint32", 4), size(ref));
  }

  /** Force or moment of a series at a sample; NaN where absent. */
  vector(series: WrenchSeries | ContactSeries, sample: number, quantity: Quantity): Vector {
    const values = this.row(series.values, sample);
    const at = FIRST[quantity];
    return [values[at] ?? Number.NaN, values[at + 1] ?? Number.NaN, values[at + 2] ?? Number.NaN];
  }

  /** Coordinate of a column at a sample; rad or m; NaN where absent. */
  position(sample: number, column: number): number {
    return this.row(this.scene.positions, sample)[column] ?? Number.NaN;
  }

  /** Whether a coordinate is a length; its joint is then prismatic. */
  isLength(column: number): boolean {
    const name = this.scene.coordinates[column];
    return this.scene.robot.joints.some((joint) => joint.name === name && joint.type === "prismatic");
  }

  /** The sensor of this place, if there is one. */
  sensor(place: number): Sensor | undefined {
    return this.scene.sensors[place];
  }

  /** Last sample at or before an instant; the first one if all are later. */
  sampleAt(seconds: number): number {
    let low = 0;
    let high = this.samples;
    while (low < high) {
      const middle = (low + high) >> 1;
      if ((this.time[middle] ?? 0) <= seconds) low = middle + 1;
      else high = middle;
    }
    return Math.max(0, low - 1);
  }

  /** First sample at or after an instant; the number of samples if there is none. */
  firstAt(seconds: number): number {
    const before = this.sampleAt(seconds);
    return (this.time[before] ?? seconds) < seconds ? before + 1 : before;
  }

  /** Sample closest to an instant. */
  nearestSample(seconds: number): number {
    const before = this.sampleAt(seconds);
    const after = Math.min(before + 1, this.samples - 1);
    const nearer = Math.abs((this.time[after] ?? 0) - seconds) < Math.abs((this.time[before] ?? 0) - seconds);
    return Math.max(0, nearer ? after : before);
  }

  /** First and last instant; s. */
  get span(): [number, number] {
    return [this.time[0] ?? 0, this.time[this.samples - 1] ?? 0];
  }

  private placed(ref: ArrayRef, dtype: ArrayRef["dtype"], bytes: number): number {
    if (ref.dtype !== dtype) throw new Error(`expected an array of ${dtype}, got ${ref.dtype}`);
    this.within(ref.offset + bytes * size(ref));
    return ref.offset;
  }

  private within(end: number): void {
    const { byteLength } = this.block;
    if (end > byteLength) throw new Error(`an array ends at byte ${end}, the data are ${byteLength} bytes long`);
  }
}

function size(ref: ArrayRef): number {
  return ref.shape.reduce((product, length) => product * length, 1);
}
