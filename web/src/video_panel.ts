// SPDX-License-Identifier: BSD-3-Clause
// Making a film from the page.

import { button, choice, download, el, fileName } from "./dom";
import { makeVideo, type Codec, type Stage } from "./video";

/** Film of the window of time that the plots show. */
export function videoPanel(stage: Stage, say: (text: string) => void): HTMLElement {
  const field = (label: string, value: number, min: number, step: number): HTMLInputElement =>
    el("input", { type: "number", "aria-label": label, value, min, step });
  const [start, end] = [field("Video start in seconds", 0, 0, 0.1), field("Video end in seconds", 0, 0, 0.1)];
  const [fps, speed] = [field("Video frames per second", 20, 1, 1), field("Video speed", 1, 0.1, 0.1)];
  const codec = choice(
    "Video codec",
    [
      ["h264", "H.264: plays everywhere"],
      ["vp9", "VP9: same file every time"],
    ],
    "h264",
    () => undefined,
  );
  const bar = el("progress", { max: 1, value: 0, "aria-label": "Video progress" });
  bar.hidden = true;
  stage.store.on(["window"], () => {
    start.value = stage.store.state.window[0].toFixed(3);
    end.value = stage.store.state.window[1].toFixed(3);
  });
  const record = button("Record video", () => void make(), {});
  async function make(): Promise<void> {
    record.disabled = true;
    bar.hidden = false;
    try {
      const [a, b, f, s] = [start, end, fps, speed].map((input) => input.valueAsNumber);
      const [first, last] = [a ?? 0, b ?? 0].map((seconds) => stage.data.nearestSample(seconds));
      const options = { start: first ?? 0, end: last ?? 0, fps: f ?? 20, speed: s ?? 1, codec: codec.value as Codec };
      const film = await makeVideo(stage, options, (share) => {
        bar.value = share;
      });
      download(fileName(stage.data.scene.title, ".mp4"), film, "video/mp4");
      say("The video is made.");
    } catch (error) {
      say(String(error));
    } finally {
      record.disabled = false;
      bar.hidden = true;
    }
  }
  return el(
    "details",
    {},
    el("summary", {}, "Video"),
    el(
      "div",
      { class: "row video" },
      el("label", {}, "from", start),
      el("label", {}, "to", end),
      el("label", {}, "frames/s", fps),
      el("label", {}, "speed", speed),
    ),
    el("div", { class: "row" }, codec, record, bar),
  );
}
