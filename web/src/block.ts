// SPDX-License-Identifier: BSD-3-Clause
// The bytes of the page's arrays. Those inside the page are text until they are needed.

/** Bytes that can be read piece by piece. */
export interface Block {
  /** Length; bytes. */
  readonly byteLength: number;
  /** A copy of the bytes from `start` to before `end`, which starts at the beginning of its buffer. */
  read(start: number, end: number): Uint8Array;
}

/** Bytes that the page holds as base64, of which no more is decoded than is read. */
export function blockOfBase64(text: string): Block {
  const padding = text.endsWith("==") ? 2 : text.endsWith("=") ? 1 : 0;
  return {
    byteLength: (text.length / 4) * 3 - padding,
    read(start, end) {
      const before = start % 3; // three bytes are four characters
      const from = ((start - before) / 3) * 4;
      return decoded(text.slice(from, Math.ceil(end / 3) * 4)).slice(before, before + end - start);
    },
  };
}

/** Browsers of before 2025 have no `fromBase64`. */
const fromBase64 = (Uint8Array as { fromBase64?: (text: string) => Uint8Array }).fromBase64;

function decoded(text: string): Uint8Array {
  if (fromBase64) return fromBase64.call(Uint8Array, text);
  const piece = atob(text);
  const bytes = new Uint8Array(piece.length);
  for (let k = 0; k < piece.length; k++) bytes[k] = piece.charCodeAt(k);
  return bytes;
}
