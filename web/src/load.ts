// SPDX-License-Identifier: BSD-3-Clause
// The scene's header and block: inside the page, or on the server that sent it.

import { blockOfBase64, type Block } from "./block";
import type { ArrayRef, Scene } from "./scene_types";
import { ServedBlock, type Progress, type Range } from "./served_block";

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

/** Read the block: base64 in the page, or the file that the page names, of which comes first what is shown first. */
export async function readBlock(scene: Scene, progress: Progress): Promise<Block> {
  const element = document.getElementById("data");
  if (!element) throw new Error('the page holds no data: expected a script element with id "data"');
  const url = element.dataset["url"];
  if (url) {
    const block = await ServedBlock.at(url);
    await block.fetch(shownFirst(scene).map(rangeOf), progress);
    return block;
  }
  const block = blockOfBase64(element.textContent ?? "");
  element.textContent = "";
  return block;
}

/** Fetch what the first view did not need, so that the page no longer depends on the server. */
export async function readRest(block: Block): Promise<void> {
  // a server that has ended by then is no error before something is looked at that has not come
  if (block instanceof ServedBlock) await block.fetch([[0, block.byteLength]]).catch(() => undefined);
}

/** Arrays of the first view: overviews, else series; of postures, and of series with an overview, it reads a block. */
function shownFirst({ time_s, sensors: [first] }: Scene): ArrayRef[] {
  const series = first?.wrenches ?? [];
  return [
    time_s,
    ...series.flatMap(({ values, deviation, overview }) =>
      overview
        ? [overview.wrench, overview.error, overview.deviation, overview.points]
        : [values, values.base, deviation],
    ),
  ].filter((ref) => ref !== null && ref !== undefined);
}

const BYTES = { float32: 4, float64: 8, uint32: 4 } as const;

function rangeOf({ offset, packed_bytes, dtype, shape }: ArrayRef): Range {
  return [offset, offset + (packed_bytes ?? BYTES[dtype] * shape.reduce((product, length) => product * length, 1))];
}
