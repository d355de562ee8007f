// SPDX-License-Identifier: BSD-3-Clause
// Keys that work wherever nothing else takes them.

import type { SceneData } from "./scene_data";
import type { Store } from "./store";
import { save, step, togglePlay } from "./transport";

/** What the keys do, for the help of the page. */
export const KEYS: readonly (readonly [key: string, does: string])[] = [
  ["← →", "one sample back, on; with Shift ten"],
  ["Home End", "first, last sample"],
  ["Space", "play, pause"],
  ["f t", "force, torque"],
  ["p b e", "the saved sample is a point, begin, end"],
  ["s", "save the sample"],
  ["Alt + arrows, + −, 0", "turn, zoom, reset the focused 3-D view"],
];

/** Listen to the keys. */
export function listen(data: SceneData, store: Store, say: (text: string) => void): void {
  const actions: Record<string, () => void> = {
    Home: () => store.set({ sample: 0, playing: false }),
    End: () => store.set({ sample: Math.max(0, data.samples - 1), playing: false }),
    " ": () => togglePlay(data, store),
    f: () => store.set({ quantity: "force" }),
    t: () => store.set({ quantity: "moment" }),
    p: () => store.set({ markKind: "point" }),
    b: () => store.set({ markKind: "begin" }),
    e: () => store.set({ markKind: "end" }),
    s: () => save(data, store, say),
  };
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || takes(event.target, event.key)) return;
    const by = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
    const action = by !== 0 ? () => step(data, store, event.shiftKey ? 10 * by : by) : actions[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}

/** Give the arrows back after a choice by mouse: a list or radio button would keep them for itself. */
export function releaseAfterMouse(): void {
  document.addEventListener("change", ({ target }) => {
    const keeps =
      target instanceof HTMLSelectElement || (target instanceof HTMLInputElement && target.type === "radio");
    if (keeps && !target.matches(":focus-visible")) target.blur();
  });
}

/** Whether the focused element has its own use of a key. */
function takes(target: EventTarget | null, key: string): boolean {
  if (target instanceof HTMLInputElement) {
    if (target.type === "range") return false;
    if (target.type === "checkbox") return key === " ";
    if (target.type === "radio") return key === " " || key.startsWith("Arrow");
    return true;
  }
  if (target instanceof HTMLSelectElement || target instanceof HTMLTextAreaElement) return true;
  return target instanceof HTMLElement && target.closest("button, summary, a") !== null && key === " ";
}
