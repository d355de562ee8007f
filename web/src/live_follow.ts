// SPDX-License-Identifier: BSD-3-Clause
// Following a stream: the page asks for what came since it asked last, and draws it before it asks again.

import { button, el, say } from "./dom";
import type { LiveData } from "./live_data";
import type { LiveSensorState, LiveUpdate } from "./scene_types";
import type { Store } from "./store";
import { togglePlay } from "./transport";

const PERIOD_MS = 100;
const ONLY_STATE = -1;
const SILENT_S = 1; // a shorter silence is no news
const LINE_END = 10;

/** What the page knows of the stream. */
export interface Following {
  /** Samples that came and went before the page asked for them. */
  skipped: number;
  /** The last state; null before the first. */
  update: LiveUpdate | null;
  /** Why no more comes; null while the stream lasts. */
  ended: string | null;
}

/** Follow the stream while `playing`; what came meanwhile is asked for when it goes on. */
export function follow(data: LiveData, store: Store, show: (state: Following) => void): Following {
  const state: Following = { skipped: 0, update: null, ended: null };
  let next = 0;
  const step = async (): Promise<void> => {
    const begun = performance.now();
    const { playing } = store.state;
    try {
      const answer = await fetch(`${data.feed.url}?after=${playing ? next : ONLY_STATE}`, { cache: "no-store" });
      if (!answer.ok) throw new Error(`the server answered ${answer.status}`);
      const bytes = new Uint8Array(await answer.arrayBuffer());
      const end = bytes.indexOf(LINE_END);
      const update = JSON.parse(new TextDecoder().decode(bytes.subarray(0, end))) as LiveUpdate;
      state.update = update;
      if (playing) {
        if (next > 0) state.skipped += update.first - next;
        next = update.first + update.rows;
        data.add(update, bytes.subarray(end + 1));
        if (update.rows > 0 && store.state.playing) {
          store.renew({ sample: data.samples - 1, window: data.span });
          await new Promise(requestAnimationFrame); // a page that nobody sees waits
        }
      }
      if (update.ended_by !== null && (!playing || next >= update.total)) state.ended = update.ended_by;
    } catch (error) {
      state.ended = `the server of the run does not answer (${error instanceof Error ? error.message : String(error)})`;
    }
    show(state);
    if (state.ended !== null) {
      data.isOver = true;
      store.set({ playing: false });
      return;
    }
    const more = playing && next < (state.update?.total ?? 0);
    const took = performance.now() - begun;
    setTimeout(() => void step(), more ? 0 : Math.max(took, PERIOD_MS - took)); // half of the time is left to the user
  };
  void step();
  return state;
}

/** The bar below the plots: stop and go on, and what became of packets. */
export function liveBar(data: LiveData, store: Store): { bar: HTMLElement; show: (state: Following) => void } {
  const play = button("", () => togglePlay(data, store), { class: "play" });
  const time = el("time");
  const packets = el("span", { class: "grow" });
  const silence = el("span", { class: "status" });
  store.on(["playing"], () => {
    play.textContent = store.state.playing ? "❚❚ Hold" : "▶ Follow";
    play.setAttribute("aria-pressed", String(store.state.playing));
  });
  store.on(["sample"], () => {
    time.textContent = `${(data.time[store.state.sample] ?? 0).toFixed(3)} s`;
  });
  const show = ({ update, skipped, ended }: Following): void => {
    if (update) {
      const { received, lost, late, repeated } = update;
      const unseen = skipped > 0 ? `; ${skipped} samples not shown: the page was too slow, or held` : "";
      const [first, last] = data.span;
      const room = data.isFull ? `; shown are ${(last - first).toFixed(0)} s, not ${data.feed.window_s} s: ${data.time.length} samples at most` : "";
      const text = `Packets: ${received} received, ${lost ?? "not countable"} lost, ${late} late, ${repeated} repeated${unseen}${room}`;
      say(packets, text);
    }
    play.disabled = ended !== null;
    const seconds = update?.silent_s ?? 0;
    const quiet = seconds > SILENT_S ? `No packet for ${seconds.toFixed(0)} s` : "";
    say(silence, ended !== null ? `The run ended: ${ended}. What came last stays here.` : quiet);
  };
  return { bar: el("footer", { class: "transport" }, play, time, packets, silence), show };
}

/** Table of the sensors: status, drift since the tare, samples with faults. */
export function livePanel(data: LiveData): { panel: HTMLElement; show: (state: Following) => void } {
  const body = el("tbody");
  const heads = ["status", "drift [N]", "faults"].map((text) => el("th", { scope: "col" }, text));
  const table = el(
    "table",
    {},
    el("caption", {}, "Drift of the bias since the tare, largest component; faults of all samples"),
    el("thead", {}, el("tr", {}, el("th", { scope: "col" }, "sensor"), ...heads)),
    body,
  );
  const show = ({ update }: Following): void => {
    (update?.sensors ?? []).forEach((sensor, k) => {
      const cells = [sensor.status, drift(sensor), `${sensor.faulty} of ${sensor.samples}`];
      const row = body.rows[k] ?? body.appendChild(emptyRow(data.sensor(k)?.name ?? "", cells.length));
      cells.forEach((text, c) => say(row.cells[c + 1]!, text));
    });
  };
  return { panel: table, show };
}

function emptyRow(name: string, cells: number): HTMLTableRowElement {
  return el("tr", {}, el("th", { scope: "row" }, name), ...Array.from({ length: cells }, () => el("td")));
}

function drift({ drift }: LiveSensorState): string {
  return drift ? Math.max(...drift.slice(0, 3).map(Math.abs)).toFixed(2) : "–";
}
