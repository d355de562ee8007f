// SPDX-License-Identifier: BSD-3-Clause
// The list of saved samples and the intervals between them, and what can be done with them.

import { button, choice, download, el, fileName } from "./dom";
import { toAnnotations, toCsv, toToml } from "./exports";
import { inOrder, markedIntervals, unpaired, type Mark, type Use } from "./marks";
import type { SceneData } from "./scene_data";
import { asMarks } from "./selection";
import type { Store } from "./store";

const USES: readonly (readonly [Use, string])[] = [
  ["ignore", "ignore"],
  ["calibration", "calibration"],
  ["validation", "validation"],
];

const LONGEST_LABEL = 180; // the server takes 200, and a number may be added

/** Saved samples, intervals, and their exports. */
export function marksPanel(data: SceneData, store: Store, say: (text: string) => void): HTMLElement {
  const list = el("ul", { class: "marks", "aria-label": "Saved samples" });
  const intervals = el("ul", { class: "marks", "aria-label": "Marked intervals" });
  store.on(["marks"], () => {
    const { marks } = store.state;
    if (!list.contains(document.activeElement) || list.children.length !== marks.length) {
      list.replaceChildren(...inOrder(marks).map((mark) => markRow(mark, store)));
    }
    if (marks.length === 0)
      list.replaceChildren(el("li", { class: "absent" }, "None yet: “Save sample” keeps the one shown."));
    intervals.replaceChildren(...intervalRows(data, store));
  });
  const kept = new Set<readonly Mark[]>(); // lists that were exported
  addEventListener("beforeunload", (event) => {
    const { marks } = store.state;
    if (marks.length > 0 && !kept.has(marks)) event.preventDefault(); // the browser asks before they are lost
  });
  const keep = (marks: readonly Mark[]): void => void kept.add(marks);
  return el("div", {}, list, intervals, selectionButtons(data, store, say), exportButtons(data, store, say, keep));
}

/** What was encircled in a plane may become intervals. */
function selectionButtons(data: SceneData, store: Store, say: (text: string) => void): HTMLElement {
  const row = el("div", { class: "row" });
  store.on(["selected"], () => {
    const { selected } = store.state;
    row.hidden = selected.length === 0;
    const total = selected.reduce((sum, { start_s, end_s }) => sum + end_s - start_s, 0);
    row.replaceChildren(
      el("span", { class: "muted" }, `Selected: ${total.toFixed(2)} s in ${selected.length} interval(s)`),
      button("Save as intervals", () => {
        store.set({ marks: asMarks(data, selected, store.state.marks), selected: [] });
        say(`Saved ${selected.length} interval(s).`);
      }),
      button("Forget", () => store.set({ selected: [] })),
    );
  });
  return row;
}

function markRow(mark: Mark, store: Store): HTMLLIElement {
  let current = mark;
  const name = `sample ${mark.sample}`;
  const text = el("input", { type: "text", maxlength: LONGEST_LABEL, value: mark.label, placeholder: "label", "aria-label": `Label of ${name}` });
  text.addEventListener("change", () => {
    const next = { ...current, label: text.value.trim() };
    const marks = store.state.marks.map((other) => (other === current ? next : other));
    current = next;
    store.set({ marks });
  });
  const remove = (): void => store.set({ marks: store.state.marks.filter((other) => other !== current) });
  return el(
    "li",
    {},
    button(`${mark.sample}`, () => store.set({ sample: mark.sample, playing: false }), {
      class: "link",
      "aria-label": `Go to ${name}`,
    }),
    el("span", { class: "muted" }, `${mark.time_s.toFixed(2)} s ${mark.mark}`),
    text,
    button("✕", remove, { "aria-label": `Delete ${name}` }),
  );
}

function intervalRows(data: SceneData, store: Store): HTMLLIElement[] {
  const rows = markedIntervals(data, store.state.marks).map((interval) => {
    const use = choice(`Use of ${interval.label}`, USES, interval.use, (value) => {
      const marks = store.state.marks.map((mark) => (mark === interval.begin ? { ...mark, use: value as Use } : mark));
      store.set({ marks });
    });
    const span = `${interval.label}: ${interval.start_s.toFixed(2)}–${interval.end_s.toFixed(2)} s`;
    const others = interval.overlaps.join(", ");
    const clash = others ? [el("span", { class: "muted clash" }, `overlaps ${others}: shorten it there`)] : [];
    return el("li", {}, el("span", { class: "grow" }, span), use, ...clash);
  });
  const lone = unpaired(store.state.marks).map(({ mark, sample }) =>
    el("li", { class: "absent" }, mark === "begin" ? `begin at ${sample} has no end` : `end at ${sample} has no begin`),
  );
  return [...rows, ...lone];
}

function exportButtons(data: SceneData, store: Store, say: (text: string) => void, keep: (marks: readonly Mark[]) => void): HTMLElement {
  const { title, annotations_url } = data.scene;
  const offer = (ending: string, text: string, type: string): void => {
    download(fileName(title, ending), text, type);
    keep(store.state.marks);
  };
  const row = el(
    "div",
    { class: "row" },
    button("Samples as CSV", () => offer("_samples.csv", toCsv(data, store.state.marks), "text/csv")),
    button("Intervals as TOML", () => offer("_intervals.toml", toToml(data, store.state.marks), "application/toml")),
  );
  if (annotations_url !== null) {
    row.append(
      button(
        "Write beside the experiment",
        () => {
          const { marks } = store.state; // others may be saved before the answer comes
          void send(annotations_url, data, marks, say).then((sent) => {
            if (sent) keep(marks);
          });
        },
        { class: "primary" },
      ),
    );
  }
  return row;
}

async function send(
  url: string,
  data: SceneData,
  marks: readonly Mark[],
  say: (text: string) => void,
): Promise<boolean> {
  try {
    const body = JSON.stringify(toAnnotations(data, marks));
    const answer = await fetch(url, { method: "POST", headers: { "Content-Type": "application/json" }, body });
    const text = await answer.text();
    if (!answer.ok) throw new Error(`${answer.status} ${answer.statusText}: ${text.slice(0, 300)}`);
    const { files } = JSON.parse(text) as { files: string[] };
    say(`Written beside the experiment: ${files.join(", ")}`);
    return true;
  } catch (error) {
    say(`Not written. ${error instanceof Error ? error.message : String(error)}`);
    return false;
  }
}
