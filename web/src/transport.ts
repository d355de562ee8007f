// SPDX-License-Identifier: BSD-3-Clause
// Moving along the recording: slider, number, steps, play; and saving the sample that is shown.

import { button, choice, el } from "./dom";
import type { Mark } from "./marks";
import type { SceneData } from "./scene_data";
import type { Store } from "./store";

const SPEEDS = ["0.1", "0.25", "0.5", "1", "2", "5", "10", "50"];
const KINDS = ["point", "begin", "end"] as const;

/** The bar below the plots. */
export function transport(data: SceneData, store: Store, say: (text: string) => void): HTMLElement {
  const last = Math.max(0, data.samples - 1);
  const slider = el("input", {
    type: "range",
    min: 0,
    max: last,
    step: 1,
    "aria-label": "Sample slider",
    class: "slider",
  });
  slider.addEventListener("input", () => store.set({ sample: Number(slider.value), playing: false }));
  const number = el("input", { type: "number", min: 0, max: last, step: 1, "aria-label": "Sample number" });
  number.addEventListener("change", () => {
    const wanted = Math.round(number.valueAsNumber); // no number is no wish
    if (Number.isFinite(wanted)) store.set({ sample: Math.min(last, Math.max(0, wanted)), playing: false });
    number.value = String(store.state.sample);
  });
  const time = el("time"); // an output would be read aloud at every step
  const play = button("▶ Play", () => togglePlay(data, store), { class: "play" });
  const speeds = SPEEDS.map((s) => [s, `${s}×`] as const);
  const speed = choice("Speed", speeds, "1", (value) => store.set({ speed: Number(value) }));
  store.on(["sample"], () => {
    const { sample } = store.state;
    slider.value = String(sample);
    number.value = String(sample);
    const seconds = (data.time[sample] ?? 0).toFixed(3);
    slider.setAttribute("aria-valuetext", `sample ${sample}, ${seconds} s`);
    time.textContent = `${seconds} s`;
  });
  store.on(["playing"], () => {
    const { playing } = store.state;
    play.textContent = playing ? "❚❚ Pause" : "▶ Play";
    play.setAttribute("aria-label", playing ? "Pause" : "Play");
    play.setAttribute("aria-pressed", String(playing));
  });
  return el(
    "footer",
    { class: "transport" },
    play,
    speed,
    button("−1", () => step(data, store, -1), { "aria-label": "−1: one sample back" }),
    slider,
    button("+1", () => step(data, store, 1), { "aria-label": "+1: one sample on" }),
    number,
    time,
    saving(data, store, say),
  );
}

function saving(data: SceneData, store: Store, say: (text: string) => void): HTMLElement {
  const group = el("span", { class: "segments", role: "radiogroup", "aria-label": "Saved sample is" });
  for (const kind of KINDS) {
    const radio = el("input", { type: "radio", name: "mark-kind", value: kind });
    radio.addEventListener("change", () => store.set({ markKind: kind }));
    store.on(["markKind"], () => {
      radio.checked = store.state.markKind === kind;
    });
    group.append(el("label", {}, radio, el("span", {}, kind)));
  }
  return el(
    "span",
    { class: "saving" },
    group,
    button("Save sample", () => save(data, store, say), { class: "primary" }),
  );
}

/** Save the sample that is shown; after a begin an end is offered, after an end a begin. */
export function save(data: SceneData, store: Store, say: (text: string) => void): void {
  const { sample, markKind, marks } = store.state;
  if (data.samples === 0) return;
  const time_s = data.time[sample] ?? 0;
  const mark: Mark = { sample, time_s, mark: markKind, label: "", use: "ignore" };
  const next = { begin: "end", end: "begin", point: "point" } as const;
  store.set({ marks: [...marks, mark], markKind: next[markKind] });
  say(`Saved sample ${sample} at ${time_s.toFixed(3)} s as ${markKind}.`);
}

/** Go on or back by some samples. */
export function step(data: SceneData, store: Store, by: number): void {
  const sample = Math.min(Math.max(0, data.samples - 1), Math.max(0, store.state.sample + by));
  store.set({ sample, playing: false });
}

/** Whether samples come and go, so that one that is drawn cannot be chosen. */
export function goesOn(data: SceneData, store: Store): boolean {
  return data.scene.live !== null && store.state.playing;
}

/** Play or pause; from the start again if it is at its end. A stream that ended is not followed again. */
export function togglePlay(data: SceneData, store: Store): void {
  if (data.isOver) return;
  const { playing, sample } = store.state;
  if (!playing && sample >= data.samples - 1) store.set({ sample: 0 });
  store.set({ playing: !playing && (data.scene.live !== null || data.samples > 1) });
}

/** Let the recording run while `playing`: each frame shows the sample of its instant. */
export function player(data: SceneData, store: Store): void {
  let instant = 0;
  let shown = -1;
  let before = 0;
  const frame = (now: number): void => {
    const { playing, sample, speed } = store.state;
    if (!playing) return;
    if (sample !== shown) instant = data.time[sample] ?? 0;
    // a slow frame does not make the robot leap by more than half a second
    instant += Math.min(0.5, (now - before) / 1000) * speed;
    before = now;
    shown = data.sampleAt(instant);
    store.set({ sample: shown, playing: shown < data.samples - 1 });
    requestAnimationFrame(frame);
  };
  store.on(["playing"], () => {
    if (!store.state.playing) return;
    shown = -1;
    before = performance.now();
    requestAnimationFrame(frame);
  });
}
