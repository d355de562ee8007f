// SPDX-License-Identifier: BSD-3-Clause
// Colours by their role, for the ground that the page opened on.

import type { Sensor, WrenchSeries } from "./scene_types";
import { ROLES, SURFACES } from "./visual_roles";

/** Whether the page has a dark ground, as the system asks for when it opens. */
export const DARK = matchMedia("(prefers-color-scheme: dark)").matches;

document.documentElement.dataset["ground"] = DARK ? "dark" : "light";

const role = (name: keyof typeof ROLES): string => ROLES[name].colours[DARK ? 1 : 0];
const surface = (name: keyof typeof SURFACES): string => SURFACES[name][DARK ? 1 : 0];

/** Ink of text and axes. */
export const INK = surface("ink");
/** Text and lines of less weight. */
export const MUTED = surface("muted");
/** Lines that only guide the eye. */
export const FAINT = surface("guide");
/** Lines of a grid behind a plot. */
export const PALE = surface("grid");
/** Ground of views. */
export const PAPER = surface("panel");
/** Light from above and from below. */
export const [SKY, EARTH] = [surface("sky"), surface("earth")];
/** Current sample and chosen things. */
export const ACCENT = surface("accent");
/** Findings. */
export const ALARM = role("finding");
/** Error of a wrench on the robot. */
export const ERROR = role("limit");
/** Expected wrench. */
export const EXPECTED = role("expected");
/** Axes x, y, z of frames. */
export const AXES = [role("axis-x"), role("axis-y"), role("axis-z")] as const;
/** Wrenches of the world on the robot. */
export const CONTACT = role("contact");
/** Contacts on skin, and their uncertainty. */
export const SKIN = role("skin");
/** Contacts whose force is a heuristic. */
export const HEURISTIC = role("heuristic");
/** Tints of intervals by their use. */
export const USES = {
  calibration: role("use-calibration"),
  validation: role("use-validation"),
  ignore: role("use-ignore"),
} as const;

const CALIBRATIONS = [
  "calibration-1",
  "calibration-2",
  "calibration-3",
  "calibration-4",
  "calibration-5",
  "calibration-6",
] as const;

/** Role of a sensor's series: expected, prior where no calibration gives it, else by its place among calibrations. */
function roleOf(sensor: Sensor, series: WrenchSeries): keyof typeof ROLES {
  if (series.role === "expected") return "expected";
  if (!series.calibrated) return "prior";
  const place = sensor.wrenches.filter((one) => one.calibrated).indexOf(series);
  return CALIBRATIONS[place % CALIBRATIONS.length] ?? CALIBRATIONS[0];
}

/** Colour of a sensor's series. */
export function seriesColour(sensor: Sensor, series: WrenchSeries): string {
  return role(roleOf(sensor, series));
}

/** Strokes and gaps of its line, in widths of the line. */
export function seriesDash(sensor: Sensor, series: WrenchSeries): readonly number[] {
  return ROLES[roleOf(sensor, series)].dash;
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
