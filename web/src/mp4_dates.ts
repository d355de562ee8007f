// SPDX-License-Identifier: BSD-3-Clause
// An MP4 file says when it was made; without that, the same frames make the same file.

const CONTAINERS = new Set(["moov", "trak", "mdia"]);
const DATED = new Set(["mvhd", "tkhd", "mdhd"]);

/** Set the dates of creation and change to zero, in place (ISO 14496-12, 8.2.2, 8.3.2, 8.4.2). */
export function clearDates(file: Uint8Array<ArrayBuffer>): Uint8Array<ArrayBuffer> {
  walk(file, 0, file.length);
  return file;
}

function walk(file: Uint8Array, start: number, end: number): void {
  const view = new DataView(file.buffer, file.byteOffset, file.byteLength);
  for (let at = start; at + 8 <= end;) {
    const size = view.getUint32(at);
    const type = String.fromCharCode(...file.subarray(at + 4, at + 8));
    if (CONTAINERS.has(type)) walk(file, at + 8, at + size);
    if (DATED.has(type)) file.fill(0, at + 12, at + 12 + (file[at + 8] === 1 ? 16 : 8)); // version 1 has 64 bits each
    if (size < 8) return; // 0: to the end of the file; 1: 64 bits, which only a box of media has
    at += size;
  }
}
