// SPDX-License-Identifier: BSD-3-Clause
// The instants between which the time plots show.

const SHORTEST_SAMPLES = 4; // a window holds at least as many periods

/** Start and end; s. */
export type Window = readonly [number, number];

/** Stretch a window by a factor about an instant, inside the whole. */
export function zoomed(window: Window, factor: number, about: number, whole: Window, samples: number): Window {
  const shortest = (SHORTEST_SAMPLES * (whole[1] - whole[0])) / Math.max(1, samples - 1);
  const length = Math.min(whole[1] - whole[0], Math.max(shortest, factor * (window[1] - window[0])));
  const share = (about - window[0]) / (window[1] - window[0] || 1);
  return inside(about - share * length, length, whole);
}

/** Move a window on by some seconds, inside the whole. */
export function moved(window: Window, seconds: number, whole: Window): Window {
  return inside(window[0] + seconds, window[1] - window[0], whole);
}

function inside(start: number, length: number, [first, last]: Window): Window {
  const from = Math.max(first, Math.min(last - length, start));
  return [from, Math.min(last, from + length)];
}
