// SPDX-License-Identifier: BSD-3-Clause
// What the page shows as the fragment of its address, so that a link shows it again.

import type { SceneData } from "./scene_data";
import { LARGE, type State, type Store } from "./store";
import { zoomed } from "./time_window";

const PATIENCE_MS = 250; // browsers refuse to take many addresses in a row
const DIGITS = 4; // of seconds

/** Write the state as a fragment, without the sign that begins it. */
export function toFragment(data: SceneData, state: State): string {
  const { sensor, quantity, window, hidden, large } = state;
  const parts = new URLSearchParams({ sample: String(state.sample) });
  const name = data.sensor(sensor)?.name;
  if (name !== undefined) parts.set("sensor", name);
  parts.set("quantity", quantity);
  const [start, end] = data.span;
  if (window[0] > start || window[1] < end) parts.set("window", window.map((s) => s.toFixed(DIGITS)).join(","));
  for (const series of hidden) parts.append("hide", series);
  if (large) parts.set("large", large);
  return parts.toString();
}

/** Read a fragment; what the scene does not have is left as it is. */
export function fromFragment(data: SceneData, fragment: string): Partial<State> {
  const parts = new URLSearchParams(fragment.replace(/^#/, ""));
  const state: { -readonly [K in keyof State]?: State[K] } = {};
  const sample = parts.get("sample");
  if (sample !== null && /^\d+$/.test(sample)) state.sample = Math.min(Number(sample), Math.max(0, data.samples - 1));
  const sensor = data.scene.sensors.findIndex(({ name }) => name === parts.get("sensor"));
  if (sensor >= 0) state.sensor = sensor;
  const quantity = parts.get("quantity");
  if (quantity === "force" || quantity === "moment") state.quantity = quantity;
  const [start = NaN, end = NaN] = (parts.get("window") ?? "").split(",").map(Number);
  if (end > start) state.window = zoomed([start, end], 1, start, data.span, data.samples);
  if (parts.has("hide")) state.hidden = new Set(parts.getAll("hide"));
  const large = LARGE.find((one) => one === parts.get("large"));
  if (large) state.large = large;
  return state;
}

/** Keep the fragment of the address as the state is, and the state as a fragment that is typed. */
export function keepAddress(data: SceneData, store: Store): void {
  let waiting = 0;
  let known = location.hash;
  let first = true;
  store.on(["sample", "sensor", "quantity", "window", "hidden", "large"], () => {
    if (first) {
      first = false; // the address of a page that was only opened stays as it is
      return;
    }
    clearTimeout(waiting);
    waiting = setTimeout(() => {
      if (location.hash !== known) return; // one that was just typed is about to be shown
      known = `#${toFragment(data, store.state)}`;
      if (location.protocol === "about:") return; // inside a notebook it has no address of its own
      history.replaceState(null, "", known);
      known = location.hash; // as the browser writes it
    }, PATIENCE_MS);
  });
  addEventListener("hashchange", () => {
    if (location.hash === known) return;
    known = location.hash;
    // what an address does not name is as in a page that it opens
    store.set({ window: data.span, hidden: new Set(), large: null, ...fromFragment(data, known), playing: false });
  });
}
