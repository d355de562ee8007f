// SPDX-License-Identifier: BSD-3-Clause
// The scene's header and block: inside the page, or fetched in pieces from the server that sent it.

import { blockOfBase64, blockOfBytes, type Block } from "./block";
import type { Scene } from "./scene_types";

const PIECE_BYTES = 4 * 1024 * 1024;

/** How much has come; total is 0 while unknown. */
export type Progress = (loaded: number, total: number) => void;

/** Read the header in the page. */
export function readHeader(): Scene {
  const text = document.getElementById("scene")?.textContent;
  if (!text) throw new Error('the page holds no scene: expected a script element with id "scene"');
  const scene = JSON.parse(text) as Scene;
  if (scene.schema !== "forcetorque/scene/1") {
    throw new Error(`expected a scene of schema "forcetorque/scene/1", got ${JSON.stringify(scene.schema)}`);
  }
  return scene;
}

/** Read the block: base64 in the page, or the file that the page names. */
export async function readBlock(progress: Progress): Promise<Block> {
  const element = document.getElementById("data");
  if (!element) throw new Error('the page holds no data: expected a script element with id "data"');
  const url = element.dataset["url"];
  if (url) return blockOfBytes(await fetchInPieces(url, progress));
  const block = blockOfBase64(element.textContent ?? "");
  element.textContent = "";
  return block;
}

async function fetchInPieces(url: string, progress: Progress): Promise<ArrayBuffer> {
  progress(0, 0);
  const first = await fetchPiece(url, 0);
  if (first.status === 200) {
    const whole = await first.arrayBuffer();
    progress(whole.byteLength, whole.byteLength);
    return whole;
  }
  const total = Number(/\/(\d+)$/.exec(first.headers.get("Content-Range") ?? "")?.[1] ?? Number.NaN);
  if (!Number.isFinite(total)) throw new Error(`${url}: the server sent a piece without saying how long the whole is`);
  const bytes = new Uint8Array(total);
  let place = 0;
  for (let answer = first; ; answer = await fetchPiece(url, place)) {
    const piece = new Uint8Array(await answer.arrayBuffer());
    if (piece.length === 0 || place + piece.length > total) {
      throw new Error(`${url}: expected ${total - place} more bytes at most, got ${piece.length}`);
    }
    bytes.set(piece, place);
    place += piece.length;
    progress(place, total);
    if (place === total) return bytes.buffer;
  }
}

async function fetchPiece(url: string, start: number): Promise<Response> {
  const answer = await fetch(url, { headers: { Range: `bytes=${start}-${start + PIECE_BYTES - 1}` } });
  if (!answer.ok) throw new Error(`${url}: the server answered ${answer.status} ${answer.statusText}`);
  return answer;
}
