// SPDX-License-Identifier: BSD-3-Clause
// Keys that work wherever nothing else takes them.

import { expectedOf } from "./columns";
import { nextContact, nextEvent, worstSample } from "./points_of_interest";
import type { SceneData } from "./scene_data";
import type { Store } from "./store";
import { moved, zoomed } from "./time_window";
import { save, step, togglePlay } from "./transport";

const STRETCH = 1.5; // factor of one press
const SHIFT = 0.25; // share of the window

/** What the keys do. */
const KEYS: readonly (readonly [key: string, does: string])[] = [
  ["← →", "one sample back, on; with Shift ten"],
  ["Home End", "first, last sample"],
  ["Space", "play, pause"],
  ["w", "worst sample of the validation data in view"],
  ["n, Shift+n", "next, previous event: interval, finding, saved sample"],
  ["c, Shift+c", "next, previous contact on skin"],
  ["+ − 0", "stretch, shrink the time in view, all of it; wheel likewise"],
  ["[ ]", "move the time in view; drag likewise, Shift+drag chooses it"],
  ["Esc", "forget what was encircled in a plane"],
  ["f t", "force, torque"],
  ["p b e", "the saved sample is a point, begin, end"],
  ["s", "save the sample"],
  ["Alt + arrows, + −, 0", "turn, zoom, reset the focused 3-D view"],
];

/** Whether a page has what a key acts on; a stream has no expected wrenches, intervals or samples to save. */
function acts(data: SceneData, key: string): boolean {
  const { live, sensors, skin, skin_events: events } = data.scene;
  if (key === "w") return !live && sensors.some(expectedOf);
  if (key === "c") return !live && skin.length + events.length > 0;
  if (["n", "p", "b", "e", "s"].includes(key)) return !live;
  return sensors.length > 0 || !["f", "t", "Esc"].includes(key);
}

/** What the keys of a page do, for its help. */
export function keysOf(data: SceneData): typeof KEYS {
  return KEYS.filter(([keys]) => acts(data, keys.split(/[ ,]/)[0] ?? ""));
}

/** Listen to the keys. */
export function listen(data: SceneData, store: Store, say: (text: string) => void): void {
  const actions: Record<string, () => void> = {
    Home: () => store.set({ sample: 0, playing: false }),
    End: () => store.set({ sample: Math.max(0, data.samples - 1), playing: false }),
    " ": () => togglePlay(data, store),
    w: () => goToWorst(data, store),
    n: () => goToEvent(data, store, 1),
    N: () => goToEvent(data, store, -1),
    c: () => goToContact(data, store, 1),
    C: () => goToContact(data, store, -1),
    "+": () => stretch(data, store, 1 / STRETCH),
    "-": () => stretch(data, store, STRETCH),
    "0": () => store.set({ window: data.span }),
    "[": () => shift(data, store, -SHIFT),
    "]": () => shift(data, store, SHIFT),
    Escape: () => store.set({ selected: [] }),
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
    if (!action || !acts(data, event.key.toLowerCase())) return;
    event.preventDefault();
    action();
  });
}

/** Show the sample with the largest error of the validation data in view. */
export function goToWorst(data: SceneData, store: Store): void {
  const sample = worstSample(data, store.state);
  if (sample !== null) store.set({ sample, playing: false });
}

/** Show where the next event begins, or the one before; the window follows. */
export function goToEvent(data: SceneData, store: Store, direction: 1 | -1): void {
  goTo(data, store, nextEvent(data, store.state, direction));
}

/** Show where the next contact on skin begins, or the one before; the window follows. */
export function goToContact(data: SceneData, store: Store, direction: 1 | -1): void {
  goTo(data, store, nextContact(data, store.state, direction));
}

function goTo(data: SceneData, store: Store, sample: number | null): void {
  if (sample === null) return;
  const { window } = store.state;
  const now = data.time[sample] ?? 0;
  const seen = window[0] <= now && now <= window[1];
  const next = seen ? window : moved(window, now - (window[0] + window[1]) / 2, data.span);
  store.set({ sample, playing: false, window: next });
}

function stretch(data: SceneData, store: Store, factor: number): void {
  const { window, sample } = store.state;
  const now = data.time[sample] ?? 0;
  const about = window[0] <= now && now <= window[1] ? now : (window[0] + window[1]) / 2;
  store.set({ window: zoomed(window, factor, about, data.span, data.samples) });
}

function shift(data: SceneData, store: Store, share: number): void {
  const { window } = store.state;
  store.set({ window: moved(window, share * (window[1] - window[0]), data.span) });
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
