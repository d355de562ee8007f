// SPDX-License-Identifier: BSD-3-Clause
// Packed arrays, unpacked block by block when they are first looked at; `viewer/packing.py` describes their form.

import { inflateSync } from "fflate";

import type { Block } from "./block";

const ABSENT = 65_535; // code of NaN
const WORD = 8; // parts start at a multiple of so many bytes
const FIRST_ABSENT = 128; // added to the order of a column whose first row is absent

/** What a column of a block starts with: its value and its change before the first row, in steps. */
interface Head {
  readonly begin: number;
  readonly slope: number;
  readonly step: number;
  /** Whether differences are of the second order. */
  readonly twice: boolean;
  /** Whether the first row is absent. */
  readonly absent: boolean;
}

/** An array of rows over time. */
export class PackedArray {
  /** Number of rows that are unpacked together; the first of them is known before. */
  readonly rowsOfBlock: number;
  /** 1 for every block that was unpacked, for who keeps its values. */
  readonly isUnpacked: Uint8Array;
  private readonly starts: Uint32Array;
  private readonly steps: Float64Array;
  private readonly first: number;

  /**
   * @param block All data of the page.
   * @param offset Where the array begins; bytes.
   * @param rows Number of rows.
   * @param columns Number of columns.
   */
  constructor(
    private readonly block: Block,
    offset: number,
    private readonly rows: number,
    private readonly columns: number,
  ) {
    const [rowsOfBlock = 1, count = 0] = new Uint32Array(block.read(offset, offset + 8).buffer);
    this.rowsOfBlock = rowsOfBlock;
    this.starts = new Uint32Array(block.read(offset + 8, offset + 8 + 4 * (count + 1)).buffer);
    this.isUnpacked = new Uint8Array(count);
    const place = offset + aligned(8 + 4 * (count + 1));
    this.first = place + 8 * columns;
    this.steps = new Float64Array(block.read(place, this.first).buffer);
  }

  /** Values of a row that is the first of a block, known before the block is unpacked. */
  firstRow(k: number): Float32Array {
    return Float32Array.from(this.head(k), ({ begin, slope, step, twice, absent }) =>
      absent ? Number.NaN : (twice ? begin + slope : begin) * step,
    );
  }

  /** Values of a block, row by row. */
  unpack(k: number): Float32Array {
    const { columns } = this;
    const head = this.head(k);
    const length = Math.min(this.rowsOfBlock, this.rows - k * this.rowsOfBlock);
    const packed = this.block.read(this.first + (this.starts[k] ?? 0) + 10 * columns, this.first + (this.starts[k + 1] ?? 0));
    const bytes = inflateSync(packed, { out: new Uint8Array(2 * columns * length) });
    const values = new Float32Array(columns * length);
    head.forEach(({ begin, slope: before, step, twice }, column) => {
      let whole = begin;
      let slope = before;
      const low = 2 * column * length;
      for (let row = 0; row < length; row++) {
        const code = (bytes[low + row] ?? 0) + 256 * (bytes[low + length + row] ?? 0);
        const change = code === ABSENT ? 0 : (code >> 1) ^ -(code & 1);
        if (twice) whole += slope += change;
        else whole += change;
        values[row * columns + column] = code === ABSENT ? Number.NaN : whole * step;
      }
    });
    return values;
  }

  /** What each column of a block starts with. */
  private head(k: number): Head[] {
    const { columns } = this;
    const start = this.first + (this.starts[k] ?? 0);
    const bytes = this.block.read(start, start + 10 * columns);
    const numbers = new Int32Array(bytes.buffer, 0, 2 * columns);
    return Array.from({ length: columns }, (_, column) => {
      const order = bytes[9 * columns + column] ?? 1;
      return {
        begin: numbers[column] ?? 0,
        slope: numbers[columns + column] ?? 0,
        step: (this.steps[column] ?? 0) * 2 ** (bytes[8 * columns + column] ?? 0),
        twice: order % FIRST_ABSENT === 2,
        absent: order >= FIRST_ABSENT,
      };
    });
  }
}

function aligned(size: number): number {
  return Math.ceil(size / WORD) * WORD;
}
