// SPDX-License-Identifier: BSD-3-Clause
// The bytes of a page that is served: fetched piece by piece, first those that are needed first.

import type { Block } from "./block";

const PIECE = 1 << 18; // bytes that are fetched together
const MOST = 16; // pieces of one request

/** How much of what is needed has come; total is 0 while unknown. */
export type Progress = (loaded: number, total: number) => void;

/** Bytes from `start` to before `end`. */
export type Range = readonly [start: number, end: number];

/** Bytes of a server, each fetched once. */
export class ServedBlock implements Block {
  private readonly bytes: Uint8Array;
  private readonly has: Uint8Array;

  private constructor(
    private readonly url: string,
    readonly byteLength: number,
  ) {
    this.bytes = new Uint8Array(byteLength);
    this.has = new Uint8Array(Math.ceil(byteLength / PIECE));
  }

  /** Ask the server how much there is, and keep its first piece. */
  static async at(url: string): Promise<ServedBlock> {
    const answer = await answerOf(url, `bytes=0-${PIECE - 1}`);
    const first = new Uint8Array(await answer.arrayBuffer());
    const total =
      answer.status === 200 ? first.length : Number(/\/(\d+)$/.exec(answer.headers.get("Content-Range") ?? "")?.[1]);
    if (!Number.isFinite(total)) throw new Error(`${url}: the server sent a piece without the length of the whole`);
    const block = new ServedBlock(url, total);
    block.keep(0, Math.ceil(first.length / PIECE), first);
    return block;
  }

  /** Bytes that are missing are waited for: the page needs them to draw. */
  read(start: number, end: number): Uint8Array {
    for (const [from, to] of this.missing([[start, end]])) {
      const request = new XMLHttpRequest();
      request.open("GET", this.url, false);
      request.setRequestHeader("Range", this.header(from, to));
      request.overrideMimeType("text/plain; charset=x-user-defined"); // a request that is waited for gives text alone
      try {
        request.send();
      } catch {
        throw silent(this.url);
      }
      if (request.status !== 206) throw refused(this.url, request.status);
      const text = request.responseText;
      const bytes = new Uint8Array(text.length);
      for (let k = 0; k < text.length; k++) bytes[k] = text.charCodeAt(k); // the low byte is the byte that was sent
      this.keep(from, to, bytes);
    }
    return this.bytes.slice(start, end);
  }

  /** Fetch what is missing of some ranges. */
  async fetch(ranges: readonly Range[], progress: Progress = () => undefined): Promise<void> {
    const size = (runs: readonly Range[]): number => runs.reduce((sum, [from, to]) => sum + to - from, 0);
    const total = size(this.missing(ranges));
    for (let runs = this.missing(ranges); runs[0]; runs = this.missing(ranges)) {
      const [from, to] = runs[0];
      const answer = await answerOf(this.url, this.header(from, to));
      this.keep(from, to, new Uint8Array(await answer.arrayBuffer()));
      progress(total - size(this.missing(ranges)), total);
    }
  }

  /** Pieces that have not come, in runs of first and after last. */
  private missing(ranges: readonly Range[]): Range[] {
    const wanted = new Set<number>();
    for (const [start, end] of ranges)
      for (let k = Math.floor(start / PIECE); k * PIECE < Math.min(end, this.byteLength); k++)
        if (!this.has[k]) wanted.add(k);
    const runs: [number, number][] = [];
    for (const k of [...wanted].sort((a, b) => a - b)) {
      const last = runs.at(-1);
      if (last?.[1] === k && k - last[0] < MOST) last[1] = k + 1;
      else runs.push([k, k + 1]);
    }
    return runs;
  }

  private header(from: number, to: number): string {
    return `bytes=${from * PIECE}-${Math.min(to * PIECE, this.byteLength) - 1}`;
  }

  private keep(from: number, to: number, bytes: Uint8Array): void {
    const expected = Math.min(to * PIECE, this.byteLength) - from * PIECE;
    if (bytes.length !== expected) throw new Error(`${this.url}: expected ${expected} bytes, got ${bytes.length}`);
    this.bytes.set(bytes, from * PIECE);
    this.has.fill(1, from, to);
  }
}

async function answerOf(url: string, range: string): Promise<Response> {
  const answer = await fetch(url, { headers: { Range: range } }).catch(() => {
    throw silent(url);
  });
  if (!answer.ok) throw refused(url, answer.status);
  return answer;
}

function silent(url: string): Error {
  return new Error(`${url}: the server does not answer; start the command again`);
}

function refused(url: string, status: number): Error {
  return new Error(`${url}: the server answered ${status}; start the command again`);
}
