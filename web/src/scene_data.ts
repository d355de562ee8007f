// SPDX-License-Identifier: BSD-3-Clause
// The scene with its arrays.

import type { Block } from "./block";
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
  private readonly packed = new Map<number, PackedArray>();
  /** Quantities over time. */
  readonly columns = new Columns(this);
  /** Whether these are of a stream that has ended. */
  isOver = false;

  constructor(
    readonly scene: Scene,
    private readonly block: Block,
    /** Arrays by their place, made when they are first asked for. */
    private readonly known = new Map<number, Float32Array | Float64Array | Uint32Array>(),
  ) {
    this.time = this.doubles(scene.time_s);
  }

  /** Number of samples. */
  get samples(): number {
    return this.scene.samples;
  }

  /** Values of a float32 array. */
  floats(ref: ArrayRef): Float32Array {
    return this.over(ref, 0, ref.shape[0] ?? 0);
  }

  /** A float32 array whose rows from `first` to before `end` are unpacked; others are zero until they are. */
  over(ref: ArrayRef, first: number, end: number): Float32Array {
    if (ref.packed_bytes === null) return this.remembered(ref, () => new Float32Array(this.bytes(ref, "float32", 4)));
    const [rows = 0, columns = 1] = ref.shape;
    const values = this.remembered(ref, () => new Float32Array(rows * columns));
    if (!(end > first)) return values;
    const packed = this.packedArray(ref);
    const { rowsOfBlock } = packed;
    for (let k = Math.floor(first / rowsOfBlock); k * rowsOfBlock < end; k++) {
      if (packed.isUnpacked[k]) continue;
      packed.isUnpacked[k] = 1;
      const block = packed.unpack(k);
      const start = k * rowsOfBlock;
      const until = Math.min(rows, start + rowsOfBlock);
      if (ref.base) addMapped(block, ref, this.over(ref.base, start, until).subarray(start * columns, until * columns));
      values.set(block, start * columns);
    }
    return values;
  }

  /** Values of one row of a float32 array over time, of which no more than a block is unpacked. */
  row(ref: ArrayRef, index: number): Float32Array {
    const columns = ref.shape[1] ?? 1;
    if (ref.packed_bytes !== null && !ref.base) {
      const packed = this.packedArray(ref);
      const k = index / packed.rowsOfBlock;
      if (Number.isInteger(k) && !packed.isUnpacked[k]) return packed.firstRow(k);
    }
    return this.over(ref, index, index + 1).subarray(index * columns, (index + 1) * columns);
  }

  /** First sample of the block of postures that holds a sample, known without unpacking the block; the sample itself
   *  where there are fewer than some number of blocks, whose first samples would not tell where the robot goes. */
  keySample(sample: number, fewest: number): number {
    const { positions } = this.scene;
    if (positions.packed_bytes === null) return sample;
    const rows = this.packedArray(positions).rowsOfBlock;
    return this.samples < fewest * rows ? sample : sample - (sample % rows);
  }

  private packedArray(ref: ArrayRef): PackedArray {
    const known = this.packed.get(ref.offset);
    if (known) return known;
    this.within(ref.offset + (ref.packed_bytes ?? 0));
    const packed = new PackedArray(this.block, ref.offset, ref.shape[0] ?? 0, ref.shape[1] ?? 0);
    this.packed.set(ref.offset, packed);
    return packed;
  }

  /** Values of a float64 array. */
  doubles(ref: ArrayRef): Float64Array {
    return this.remembered(ref, () => new Float64Array(this.bytes(ref, "float64", 8)));
  }

  /** Values of a uint32 array. */
  integers(ref: ArrayRef): Uint32Array {
    return this.remembered(ref, () => new Uint32Array(this.bytes(ref, "uint32", 4)));
  }

  /** Force or moment of a series at a sample; NaN where absent. */
  vector(series: WrenchSeries | ContactSeries, sample: number, quantity: Quantity): Vector {
    const values = this.row(series.values, sample);
    const at = FIRST[quantity];
    return [values[at] ?? Number.NaN, values[at + 1] ?? Number.NaN, values[at + 2] ?? Number.NaN];
  }

  /** Largest force or moment of a series; 0 where all are absent. */
  peak(series: WrenchSeries | ContactSeries, quantity: Quantity): number {
    return "peak" in series ? (series.peak[quantity === "force" ? 0 : 1] ?? 0) : 0;
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

  private remembered<T extends Float32Array | Float64Array | Uint32Array>(ref: ArrayRef, make: () => T): T {
    if (ref.shape.includes(0)) return make(); // it starts where another array starts
    const values = (this.known.get(ref.offset) as T | undefined) ?? make();
    this.known.set(ref.offset, values);
    return values;
  }

  private bytes(ref: ArrayRef, dtype: ArrayRef["dtype"], bytes: number): ArrayBuffer {
    if (ref.dtype !== dtype) throw new Error(`expected an array of ${dtype}, got ${ref.dtype}`);
    const end = ref.offset + bytes * ref.shape.reduce((product, length) => product * length, 1);
    this.within(end);
    return this.block.read(ref.offset, end).buffer as ArrayBuffer;
  }

  private within(end: number): void {
    const { byteLength } = this.block;
    if (end > byteLength) throw new Error(`an array ends at byte ${end}, the data are ${byteLength} bytes long`);
  }
}

/** Add to rows of values the matrix of their reference times the rows of another array. */
function addMapped(values: Float32Array, ref: ArrayRef, base: Float32Array): void {
  const columns = ref.shape[1] ?? 1;
  const matrix = ref.matrix ?? [];
  for (let at = 0; at < values.length; at += columns)
    for (let i = 0; i < columns; i++) {
      let sum = values[at + i] ?? 0;
      for (let j = 0; j < columns; j++) sum += (matrix[columns * i + j] ?? 0) * (base[at + j] ?? 0);
      values[at + i] = sum;
    }
}
