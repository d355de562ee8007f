// SPDX-License-Identifier: BSD-3-Clause
// Colours that are told apart without colour vision: Okabe and Ito, "Color universal design", 2008.

import type { Sensor, WrenchSeries } from "./scene_types";

/** Ink of text, axes and the expected wrench. */
export const INK = "#1f2430";
/** Text and lines of less weight. */
export const MUTED = "#59606c";
/** Lines that only guide the eye. */
export const FAINT = "#c9ced6";
/** Lines of a grid behind a plot. */
export const PALE = "#eceff3";
/** Error of a wrench on the robot. */
export const ERROR = "#D62246";
/** Current sample and chosen things. */
export const ACCENT = "#0072B2";
/** Findings. */
export const ALARM = "#D55E00";
/** Axes x, y, z of frames. */
export const AXES = ["#D55E00", "#009E73", "#0072B2"] as const;
/** Wrenches of the world on the robot. */
export const CONTACT = "#7a4a00";
/** Contacts on skin, and their uncertainty. */
export const SKIN = "#882255";
/** Contacts whose force is a heuristic. */
export const HEURISTIC = "#5b6472";
/** Pressure from none to the largest: lightness alone tells it. */
export const PRESSURES = ["#f3efe6", "#f2c14e", "#d1495b", "#3b0f70"] as const;
/** Tints of intervals by their use. */
export const USES = { calibration: "#56B4E9", validation: "#009E73", ignore: "#8a8f98" } as const;

const EXPECTED = "#000000";
const MEASURED = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"] as const;

/** Colour of a sensor's series: black if expected, else by its place among the measured ones. */
export function seriesColour(sensor: Sensor, series: WrenchSeries): string {
  if (series.role === "expected") return EXPECTED;
  const place = sensor.wrenches.filter((w) => w.role === "measured").indexOf(series);
  return MEASURED[place % MEASURED.length] ?? MEASURED[0];
}

/** The same colour with an opacity from 0 to 1. */
export function faded(colour: string, opacity: number): string {
  return (
    colour +
    Math.round(opacity * 255)
      .toString(16)
      .padStart(2, "0")
  );
}
