// SPDX-License-Identifier: BSD-3-Clause
// What programs may ask of the page: a browser driven by a command, or a test.

import { linkPoses } from "./kinematics";
import type { Following } from "./live_follow";
import type { PlaneView } from "./planes";
import type { ComponentPlot, PlotRange } from "./plots";
import type { SkinShown } from "./skin_view";
import type { SpaceView } from "./space_view";
import { makeVideo, type Stage, type VideoOptions } from "./video";

/** The page for programs. */
export interface Hook {
  /** Resolves when everything is drawn; rejects if the scene cannot be shown. */
  ready: Promise<boolean>;
  /** Show a sample; it is drawn when this returns. */
  show(sample: number): void;
  /** Show what was shown first; saved samples are lost. */
  reset(): void;
  /** The sample that is shown. */
  sample(): number;
  /** Poses of all links in the world, row by row. */
  linkPoses(sample: number): Record<string, number[]>;
  /** Where a sample of a series is on the screen, in the force or moment space; CSS pixels. */
  spacePoint(series: number, sample: number): { x: number; y: number } | null;
  /** The same in a plane: 0 is x-y, 1 is y-z, 2 is x-z. */
  planePoint(plane: number, series: number, sample: number): { x: number; y: number } | null;
  /** What the drawn time plots show, with the ends of their axes. */
  plots(): readonly PlotRange[];
  /** Samples whose points are in the clouds. */
  cloudSamples(): number[];
  /** Rectangles of the names and letters at the robot; CSS pixels of its canvas. */
  labels(): { left: number; top: number; right: number; bottom: number }[];
  /** The same of the names and numbers at the axes of the force or moment space. */
  spaceLabels(): { left: number; top: number; right: number; bottom: number }[];
  /** What is drawn of skin: pressed taxels of each patch, and arrows of contacts, tip by tip in the world. */
  skin(): SkinShown;
  /** What is known of the stream, of a page that follows one: samples that are shown, and their time; s. */
  live?: () => Following & { samples: number; span: readonly [number, number] };
  /** Make a film; base64 of an MP4 file. */
  video(options?: VideoOptions): Promise<string>;
}

declare global {
  interface Window {
    ft: Hook;
  }
}

/** Fill the hook. */
export function openHook(
  stage: Stage,
  space: SpaceView,
  planes: readonly PlaneView[],
  plots: readonly ComponentPlot[],
): Omit<Hook, "ready" | "live"> {
  const first = stage.store.state;
  return {
    reset() {
      stage.store.set(first);
      for (const view of [stage.robot, stage.space]) view.reset();
      stage.flush();
    },
    show(sample) {
      const last = Math.max(0, stage.data.samples - 1);
      stage.store.set({ sample: Math.min(last, Math.max(0, sample)), playing: false });
      stage.flush();
    },
    sample: () => stage.store.state.sample,
    linkPoses: (sample) =>
      Object.fromEntries([...linkPoses(stage.data, sample)].map(([link, pose]) => [link, [...pose]])),
    spacePoint(series, sample) {
      const at = space.sampleOnCanvas(series, sample);
      const box = space.canvas.getBoundingClientRect();
      return at && { x: box.left + at.x, y: box.top + at.y };
    },
    planePoint: (plane, series, sample) => planes[plane]?.sampleOnScreen(series, sample) ?? null,
    plots: () => plots.flatMap((plot) => plot.range() ?? []),
    cloudSamples: () => [...space.samples()],
    labels: () => stage.robot.labels(),
    spaceLabels: () => space.labels(),
    skin: () => stage.robot.skin.shown(),
    video: async (options = {}) => base64(await makeVideo(stage, options, () => undefined)),
  };
}

function base64(bytes: Uint8Array): string {
  let text = "";
  for (let k = 0; k < bytes.length; k += 32_768) text += String.fromCharCode(...bytes.subarray(k, k + 32_768));
  return btoa(text);
}
