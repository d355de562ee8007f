// SPDX-License-Identifier: BSD-3-Clause
// What the colours of skin mean, and the numbers of its contacts at the current sample.

import { HEURISTIC, SKIN } from "./colours";
import { PRESSURES } from "./visual_roles";
import { el } from "./dom";
import type { Drawable, Frames } from "./frames";
import type { SceneData } from "./scene_data";
import type { SkinContactFrames } from "./scene_types";
import { contactsOf, deviation, frameAt, largestForce } from "./skin_frames";
import type { Store } from "./store";

/** Section on skin; none where the scene has no skin. */
export function skinPanel(data: SceneData, store: Store, frames: Frames, metresPer: number): HTMLElement[] {
  const { skin, skin_events: events } = data.scene;
  if (skin.length + events.length === 0) return [];
  const legend = skin.map(({ name, largest_Pa }) => {
    const bar = el("span", { class: "pressures", role: "img", "aria-label": `Colours from 0 to ${kPa(largest_Pa)} kPa` });
    bar.style.background = `linear-gradient(to right, ${PRESSURES.join(", ")})`;
    return el("p", { class: "pressure-legend" }, `${name}: 0 `, bar, ` ${kPa(largest_Pa)} kPa`);
  });
  const scale = Number((0.1 / metresPer).toPrecision(2));
  const arrows = skin.length ? [el("p", {}, `0.1 m of arrow on skin: ${scale} N, ellipsoid: one standard deviation`)] : [];
  const largest = [
    ...strongest(data, skin, "N"),
    ...strongest(data, events, "of the heuristic"),
  ];
  const raster = largest.length ? [el("p", {}, `Time axis: strongest colour at ${largest.join(" and ")}`)] : [];
  const values = new ContactsTable(data, store, frames);
  return [el("section", { "aria-label": "Skin" }, el("h2", {}, "Skin"), ...legend, ...arrows, ...raster, values.root)];
}

/** Largest force of a contact, which the raster over time shows by its strongest colour; none without any. */
function strongest(data: SceneData, all: readonly { readonly contacts: SkinContactFrames }[], unit: string): string[] {
  const largest = Math.max(0, ...all.map(({ contacts }) => largestForce(data, contacts)));
  return largest > 0 ? [`${largest.toPrecision(3)} ${unit}`] : [];
}

/** Table of the contacts of the current sample. */
class ContactsTable implements Drawable {
  readonly root = el("div", { class: "values" });

  constructor(
    private readonly data: SceneData,
    private readonly store: Store,
    frames: Frames,
  ) {
    store.on(["sample"], () => frames.later(this));
  }

  draw(): void {
    const { skin, skin_events: events } = this.data.scene;
    const rows = [
      ...skin.flatMap(({ name, contacts }) => this.rows(name, contacts, SKIN, "N")),
      ...events.flatMap(({ name, contacts }) => this.rows(name, contacts, HEURISTIC, "heuristic")),
    ];
    const none = el("p", { class: "absent" }, "No contact on skin at this sample.");
    this.root.replaceChildren(rows.length ? el("table", {}, el("tbody", {}, ...rows)) : none);
  }

  private rows(name: string, frames: SkinContactFrames, colour: string, unit: string): HTMLElement[] {
    const seconds = this.data.time[this.store.state.sample] ?? Number.NaN;
    const contacts = contactsOf(this.data, frames, frameAt(this.data, frames, seconds));
    return contacts.map((contact) => {
      const chip = el("span", { class: "chip" });
      chip.style.background = colour;
      const error = deviation(contact);
      const size = Math.hypot(...contact.force).toFixed(2) + (Number.isFinite(error) ? ` ± ${error.toFixed(2)}` : "");
      return el("tr", {}, el("th", { scope: "row" }, chip, `${name}: contact ${contact.identity}`), el("td", {}, `${size} ${unit}`));
    });
  }
}

function kPa(pascal: number): string {
  return (1e-3 * pascal).toFixed(1);
}
