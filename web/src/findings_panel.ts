// SPDX-License-Identifier: BSD-3-Clause
// What is wrong with the recording, what its intervals are, and what the page lacks.

import { USES } from "./colours";
import { button, el } from "./dom";
import type { SceneData } from "./scene_data";
import type { Store } from "./store";

const LONGEST = 200;

/** What is absent and why. */
export function notes(data: SceneData): HTMLElement[] {
  const texts = [...data.scene.notes];
  if (data.samples === 0 && !data.scene.live) texts.push("The scene has no samples.");
  if (texts.length === 0) return [];
  const list = el("ul", { tabindex: "0" }, ...texts.map((text) => el("li", {}, text)));
  const count = texts.length === 1 ? "1 note" : `${texts.length} notes`;
  return [
    el(
      "section",
      { class: "notes", "aria-label": "Notes" },
      el("details", { open: true }, el("summary", {}, count), list),
    ),
  ];
}

/** Intervals of the experiment; each one is a button that goes to its start. */
export function intervalsPanel(data: SceneData, store: Store): HTMLElement {
  const rows = data.scene.intervals.map((interval) => {
    const chip = el("span", { class: "chip" });
    chip.style.background = USES[interval.use];
    const go = button(interval.label, () => jump(data, store, interval.start_s), { class: "link" });
    const span = `${interval.start_s.toFixed(1)}–${interval.end_s.toFixed(1)} s, ${interval.use}`;
    const support = interval.support === null ? "" : `, on ${interval.support}`;
    return el("li", {}, chip, go, el("span", { class: "muted" }, span + support));
  });
  return folded(`Intervals (${rows.length})`, rows, rows.length > 0 ? "" : "The experiment names none.");
}

/** Findings; each one with an instant is a button that goes there. */
export function findingsPanel(data: SceneData, store: Store): HTMLElement {
  const { findings } = data.scene;
  const rows = findings.slice(0, LONGEST).map((finding) => {
    const { start_s } = finding;
    const name = `${finding.kind}${start_s === null ? "" : ` at ${start_s.toFixed(2)} s`}`;
    const head =
      start_s === null ? el("b", {}, name) : button(name, () => jump(data, store, start_s), { class: "link" });
    return el("li", {}, head, el("span", { class: "muted" }, `${finding.stream}: ${finding.message}`));
  });
  if (findings.length > LONGEST) rows.push(el("li", {}, `and ${findings.length - LONGEST} more`));
  return folded(`Findings (${findings.length})`, rows, findings.length > 0 ? "" : "None.");
}

function jump(data: SceneData, store: Store, seconds: number): void {
  store.set({ sample: data.nearestSample(seconds), playing: false });
}

function folded(title: string, rows: HTMLLIElement[], empty: string): HTMLElement {
  return el(
    "details",
    {},
    el("summary", {}, title),
    el("ul", { class: "entries", tabindex: "0" }, ...rows),
    el("p", { class: "absent" }, empty),
  );
}
