// SPDX-License-Identifier: BSD-3-Clause
// The one state that every part of the page shows, and changes.

import type { Mark } from "./marks";
import type { Quantity } from "./scene_data";
import type { Window } from "./time_window";

/** A part of the time, its end excluded; s. */
export interface Span {
  readonly start_s: number;
  readonly end_s: number;
}

/** Panels that can be enlarged. */
export const LARGE = ["robot", "space", "planes", "times"] as const;

/** A panel that can be enlarged. */
export type Large = (typeof LARGE)[number];

/** What the page shows. */
export interface State {
  readonly sample: number;
  /** Place of the sensor in the scene. */
  readonly sensor: number;
  readonly quantity: Quantity;
  /** Names of series that are switched off. */
  readonly hidden: ReadonlySet<string>;
  readonly forceArrows: boolean;
  readonly momentArrows: boolean;
  readonly allSensors: boolean;
  readonly contacts: boolean;
  /** Whether pressures and contacts on skin are drawn. */
  readonly skin: boolean;
  /** Whether contacts of a skinManager are drawn, whose force is a heuristic. */
  readonly skinEvents: boolean;
  readonly wireframes: boolean;
  /** Whether samples of ignored intervals are left out of the clouds. */
  readonly hideIgnored: boolean;
  readonly marks: readonly Mark[];
  /** What the next saved sample is. */
  readonly markKind: Mark["mark"];
  /** Instants between which the time plots show; s. */
  readonly window: Window;
  /** Sample under the pointer in a time plot. */
  readonly hover: number | null;
  /** Time in which the wrenches lie in what was encircled in a plane. */
  readonly selected: readonly Span[];
  /** Whether the error of the chosen sensor is drawn on the robot. */
  readonly errorOnRobot: boolean;
  /** Whether the scale of the plots of errors leaves out what no calibration gives. */
  readonly scaleByCalibrations: boolean;
  /** The panel that takes the place of all views. */
  readonly large: Large | null;
  readonly playing: boolean;
  /** Seconds of the recording per second. */
  readonly speed: number;
}

type Key = keyof State;

/** Holds the state and tells those who asked what changed. */
export class Store {
  private readonly listeners: { keys: ReadonlySet<Key>; call: () => void }[] = [];

  constructor(private current: State) {}

  /** The state now. */
  get state(): State {
    return this.current;
  }

  /** Change parts of the state, and call everybody who shows one of them. */
  set(patch: Partial<State>): void {
    const changed = (Object.keys(patch) as Key[]).filter((key) => patch[key] !== this.current[key]);
    if (changed.length > 0) this.change(patch, changed);
  }

  /** The same, also where a part is as before, because what it points to changed. */
  renew(patch: Partial<State>): void {
    this.change(patch, Object.keys(patch) as Key[]);
  }

  private change(patch: Partial<State>, changed: readonly Key[]): void {
    this.current = { ...this.current, ...patch };
    for (const { keys, call } of this.listeners) if (changed.some((key) => keys.has(key))) call();
  }

  /** Call now, and whenever one of these parts changes. */
  on(keys: readonly Key[], call: () => void): void {
    this.listeners.push({ keys: new Set(keys), call });
    call();
  }
}
