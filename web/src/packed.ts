// SPDX-License-Identifier: BSD-3-Clause
// Packed arrays, unpacked block by block when they are first looked at; `viewer/packing.py` describes their form.

import { inflateSync } from "fflate";

const ABSENT = 65_535; // code of NaN
const WORD = 8; // parts start at a multiple of so many bytes

/** An array of rows over time. */
export class PackedArray {
  private readonly rowsOfBlock: number;
  private readonly starts: Uint32Array;
  private readonly steps: Float64Array;
  private readonly first: number;
  private readonly blocks: (Float32Array | undefined)[] = [];

  /**
   * @param block All data of the page.
   * @param offset Where the array begins; bytes.
   * @param rows Number of rows.
   * @param columns Number of columns.
   */
  constructor(
    private readonly block: ArrayBuffer,
    offset: number,
    private readonly rows: number,
    private readonly columns: number,
  ) {
    const [rowsOfBlock = 1, count = 0] = new Uint32Array(block, offset, 2);
    this.rowsOfBlock = rowsOfBlock;
    this.starts = new Uint32Array(block, offset + 8, count + 1);
    const place = offset + aligned(8 + 4 * (count + 1));
    this.steps = new Float64Array(block, place, columns);
    this.first = place + 8 * columns;
  }

  /** Values of a row. */
  row(index: number): Float32Array {
    const k = Math.floor(index / this.rowsOfBlock);
    const at = (index - k * this.rowsOfBlock) * this.columns;
    return this.unpacked(k).subarray(at, at + this.columns);
  }

  /** All values, row by row. */
  all(): Float32Array {
    const values = new Float32Array(this.rows * this.columns);
    for (let k = 0; k + 1 < this.starts.length; k++)
      values.set(this.unpack(k), k * this.rowsOfBlock * this.columns);
    return values;
  }

  private unpacked(k: number): Float32Array {
    const values = this.blocks[k] ?? this.unpack(k);
    this.blocks[k] = values;
    return values;
  }

  private unpack(k: number): Float32Array {
    const { columns } = this;
    const [start = 0, end = 0] = [this.starts[k], this.starts[k + 1]];
    const length = Math.min(this.rowsOfBlock, this.rows - k * this.rowsOfBlock);
    const size = 10 * columns + 2 * columns * length;
    const bytes = inflateSync(new Uint8Array(this.block, this.first + start, end - start), { out: new Uint8Array(size) });
    const head = new Int32Array(bytes.buffer, 0, 2 * columns);
    const values = new Float32Array(columns * length);
    for (let column = 0; column < columns; column++) {
      const step = (this.steps[column] ?? 0) * 2 ** (bytes[8 * columns + column] ?? 0);
      const twice = bytes[9 * columns + column] === 2;
      let whole = head[column] ?? 0;
      let slope = head[columns + column] ?? 0;
      const low = 10 * columns + 2 * column * length;
      for (let row = 0; row < length; row++) {
        const code = (bytes[low + row] ?? 0) + 256 * (bytes[low + length + row] ?? 0);
        const change = code === ABSENT ? 0 : (code >> 1) ^ -(code & 1);
        if (twice) whole += slope += change;
        else whole += change;
        values[row * columns + column] = code === ABSENT ? Number.NaN : whole * step;
      }
    }
    return values;
  }
}

function aligned(size: number): number {
  return Math.ceil(size / WORD) * WORD;
}
