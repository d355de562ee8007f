// SPDX-License-Identifier: BSD-3-Clause
// Which series and parts are shown; the colours are the legend of every view.

import { seriesColour } from "./colours";
import { expectedOf } from "./columns";
import { checkBox, el } from "./dom";
import type { SceneData } from "./scene_data";
import type { State, Store } from "./store";

type Switch = "errorOnRobot" | "scaleByCalibrations" | "forceArrows" | "momentArrows" | "allSensors" | "contacts" | "skin" | "skinEvents" | "wireframes" | "hideIgnored";

const SWITCHES: readonly (readonly [key: Switch, text: string])[] = [
  ["errorOnRobot", "Error as an arrow and as the colour of the limb"],
  ["scaleByCalibrations", "Scale of errors by calibrations alone"],
  ["forceArrows", "Force arrows"],
  ["momentArrows", "Moment arrows (two heads)"],
  ["allSensors", "Arrows of all sensors"],
  ["contacts", "Contact wrenches (world on robot)"],
  ["skin", "Pressure and contacts on skin"],
  ["skinEvents", "Contacts of the skinManager (heuristic, not newtons)"],
  ["wireframes", "Ellipsoids and reference sphere"],
  ["hideIgnored", "Hide ignored intervals in the clouds"],
];

/** Check boxes of the series of the chosen sensor. */
export function seriesPanel(data: SceneData, store: Store): HTMLElement {
  const list = el("div", { role: "group", "aria-label": "Series" });
  store.on(["sensor", "hidden"], () => {
    const sensor = data.sensor(store.state.sensor);
    const focused = list.contains(document.activeElement) ? document.activeElement?.getAttribute("aria-label") : null;
    list.replaceChildren();
    for (const series of sensor?.wrenches ?? []) {
      const chip = el("span", { class: "chip" });
      chip.style.background = sensor ? seriesColour(sensor, series) : "";
      const { row, box } = checkBox(
        [chip, series.name],
        !store.state.hidden.has(series.name),
        (shown) => {
          const hidden = new Set(store.state.hidden);
          if (shown) hidden.delete(series.name);
          else hidden.add(series.name);
          store.set({ hidden });
        },
        series.name,
      );
      list.append(row);
      if (series.name === focused) box.focus();
    }
    if (!sensor?.wrenches.length) list.append(el("p", { class: "absent" }, "No wrenches of this sensor."));
  });
  return list;
}

/** Check boxes of what else is drawn. */
export function switchPanel(data: SceneData, store: Store): HTMLElement {
  const group = el("div", { role: "group", "aria-label": "Shown" });
  for (const [key, text] of SWITCHES) {
    if (absent(data, key)) continue;
    const { row, box } = checkBox([text], store.state[key], (on) => store.set({ [key]: on } as Partial<State>));
    store.on([key], () => {
      box.checked = store.state[key];
    });
    group.append(row);
  }
  return group;
}

/** Whether a scene has nothing that a switch would show. */
function absent({ scene }: SceneData, key: Switch): boolean {
  if (scene.sensors.length === 0 && !scene.live && !key.startsWith("skin")) return true;
  if (!scene.sensors.some(expectedOf) && ["errorOnRobot", "scaleByCalibrations"].includes(key)) return true;
  if (scene.live && ["errorOnRobot", "scaleByCalibrations", "wireframes", "hideIgnored"].includes(key)) return true;
  const parts = { contacts: scene.contacts, skin: scene.skin, skinEvents: scene.skin_events };
  return key in parts && parts[key as keyof typeof parts].length === 0;
}
