// SPDX-License-Identifier: BSD-3-Clause
// Puts the page together.

import "uplot/dist/uPlot.min.css";
import "./visual_roles.css";
import "./style.css";

import { CloudMaker } from "./clouds";
import { expectedOf } from "./columns";
import { button, el } from "./dom";
import { findingsPanel, intervalsPanel, notes } from "./findings_panel";
import { Frames } from "./frames";
import { openHook } from "./hook";
import { listen, releaseAfterMouse } from "./keyboard";
import { layout, type Panels } from "./layout";
import { LiveData } from "./live_data";
import { follow, liveBar, livePanel } from "./live_follow";
import { readBlock, readHeader, readRest } from "./load";
import { marksPanel } from "./marks_panel";
import { fromFragment, keepAddress } from "./permalink";
import { PlaneView } from "./planes";
import { ComponentPlot } from "./plots";
import { worstSample } from "./points_of_interest";
import { RobotView } from "./robot_view";
import { SceneData, UNIT } from "./scene_data";
import { seriesPanel, switchPanel } from "./series_panel";
import { largestContact } from "./skin_frames";
import { skinPanel } from "./skin_panel";
import { SkinRaster } from "./skin_raster";
import { SpaceView } from "./space_view";
import { StatisticsPanel } from "./statistics_panel";
import { Store } from "./store";
import { TimeStrip } from "./time_strip";
import { player, transport } from "./transport";
import { JointsPanel, ValuesPanel } from "./values_panel";
import type { Stage } from "./video";
import { videoPanel } from "./video_panel";

window.ft = { ready: start() } as typeof window.ft;

async function start(): Promise<boolean> {
  if (document.readyState === "loading") {
    await new Promise((resume) => document.addEventListener("DOMContentLoaded", resume, { once: true }));
  }
  const bar = el("progress", { "aria-label": "Loading the data" });
  const waiting = el("div", { class: "waiting", role: "status" }, "Loading the data ", bar);
  document.body.append(waiting);
  try {
    const scene = readHeader();
    document.title ||= scene.title;
    const block = await readBlock(scene, (loaded, total) => {
      if (total > 0) [bar.max, bar.value] = [total, loaded];
    });
    performance.mark("read");
    build(scene.live ? new LiveData(scene, block) : new SceneData(scene, block));
    performance.mark("drawn");
    waiting.remove();
    document.documentElement.dataset["ready"] = "true";
    void readRest(block);
    return true;
  } catch (error) {
    waiting.replaceChildren(`This page cannot be shown. ${error instanceof Error ? error.message : String(error)}`);
    waiting.setAttribute("role", "alert");
    throw error;
  }
}

function build(data: SceneData): void {
  const first = { sensor: 0, quantity: "force", hidden: new Set<string>(), window: data.span } as const;
  const store = new Store({
    ...first,
    sample: worstSample(data, first) ?? largestContact(data) ?? 0,
    forceArrows: true,
    momentArrows: true,
    allSensors: true,
    contacts: true,
    skin: true,
    skinEvents: true,
    wireframes: true,
    hideIgnored: false,
    marks: [],
    markKind: "point",
    hover: null,
    selected: [],
    errorOnRobot: true,
    scaleByCalibrations: false,
    large: null,
    playing: data instanceof LiveData,
    speed: 1,
    ...(data instanceof LiveData ? {} : fromFragment(data, location.hash)),
  });
  const frames = new Frames();
  const say = (text: string): void => {
    panels.status.textContent = text;
  };
  window.addEventListener("error", ({ error }) => {
    if (error instanceof Error) say(error.message); // such as of a server that has ended
  });
  const bar = data instanceof LiveData ? liveBar(data, store) : null;
  const panels: Panels = layout(data, store, () => bar?.bar ?? transport(data, store, say));
  (document.getElementById("viewer") ?? document.body).append(panels.app);
  const maker = new CloudMaker(data);
  const robot = new RobotView(panels.robot, frames, data);
  const space = new SpaceView(panels.space, frames, data, maker, store);
  panels.robotTitle.prepend(
    button("⟲", () => robot.reset(), { "aria-label": "Reset the robot's view", title: "Reset the view" }),
  );
  panels.spaceTitle.prepend(
    button("⟲", () => space.reset(), { "aria-label": "Reset the space's view", title: "Reset the view" }),
  );
  const arrows = ["forceArrows", "momentArrows", "allSensors", "contacts", "errorOnRobot"] as const;
  store.on(["sample", "sensor", "quantity", "hidden", ...arrows, "skin", "skinEvents"], () => robot.update(store.state));
  store.on(["sample", "sensor", "quantity", "hidden", "wireframes", "hideIgnored", "marks", "window"], () =>
    space.update(store.state),
  );
  const plots = panels.plots.map(({ panel, shown }) => new ComponentPlot(panel, shown, frames, data, store));
  const planes = connectFlat(panels, frames, data, maker, store);
  const stage: Stage = { data, store, robot, space, flush: () => frames.flush() };
  const sensors = fillSide(panels, frames, stage, say);
  describe(panels, stage, robot);
  listen(data, store, say);
  releaseAfterMouse();
  Object.assign(window.ft, openHook(stage, space, planes, plots));
  if (data instanceof LiveData) {
    let seen = false;
    const following = follow(data, store, (state) => {
      if (!seen && data.samples > 0) {
        seen = true;
        robot.aim(); // before, it had no posture
      }
      bar?.show(state);
      sensors?.show(state);
    });
    window.ft.live = () => ({ ...following, samples: data.samples, span: data.span });
  } else {
    player(data, store);
    keepAddress(data, store);
  }
  frames.flush();
}

function connectFlat(panels: Panels, frames: Frames, data: SceneData, maker: CloudMaker, store: Store): PlaneView[] {
  for (const panel of panels.strips) {
    const strip = new TimeStrip(panel, frames, data, store);
    store.on(["window", "marks", "selected"], () => strip.update());
  }
  for (const panel of panels.rasters) {
    const raster = new SkinRaster(panel, frames, data, store);
    store.on(["window", "sample"], () => raster.update());
  }
  return panels.planes.map((panel, k) => {
    const plane = new PlaneView(
      panel,
      (
        [
          [0, 1],
          [1, 2],
          [0, 2],
        ] as const
      )[k] ?? [0, 1],
      frames,
      data,
      maker,
      store,
    );
    const drawn = ["sensor", "quantity", "hidden", "wireframes", "hideIgnored", "marks", "window", "selected"] as const;
    store.on(["sample", ...drawn], () => plane.update());
    return plane;
  });
}

/** Fill the panels at the side; gives that of a stream, if there is one. */
function fillSide(
  panels: Panels,
  frames: Frames,
  stage: Stage,
  say: (text: string) => void,
): ReturnType<typeof livePanel> | null {
  const { data, store } = stage;
  const section = (title: string, ...content: HTMLElement[]): HTMLElement =>
    el("section", { "aria-label": title }, el("h2", {}, title), ...content);
  const values = new ValuesPanel(data, store, frames);
  const joints = new JointsPanel(data, store, frames);
  if (data instanceof LiveData) {
    const live = livePanel(data);
    const series = section("Series", seriesPanel(data, store), values.root);
    panels.side.append(...notes(data), section("Sensors", live.panel), series, section("Shown", switchPanel(data, store)), joints.root);
    return live;
  }
  const statistics = new StatisticsPanel(data, store, frames);
  const provenance = el(
    "details",
    {},
    el("summary", {}, "Origin of the data"),
    el("ul", { class: "entries", tabindex: "0" }, ...data.scene.provenance.map((line) => el("li", {}, line))),
  );
  panels.side.append(
    ...notes(data),
    ...(data.scene.sensors.length > 0 ? [section("Series", seriesPanel(data, store), values.root)] : []),
    ...(data.scene.sensors.some(expectedOf) ? [section("Error in view", statistics.root)] : []),
    section("Shown", switchPanel(data, store)),
    ...skinPanel(data, store, frames, stage.robot.skin.metresPer),
    section("Saved samples", marksPanel(data, store, say), panels.status),
    ...(data.scene.coordinates.length > 0 ? [joints.root] : []),
    findingsPanel(data, store),
    intervalsPanel(data, store),
    videoPanel(stage, say),
    provenance,
  );
  return null;
}

/** Keep the texts of the views true: how long arrows are, and what a screen reader says of the pictures. */
function describe(panels: Panels, { data, store, space }: Stage, robot: RobotView): void {
  const round = (unit: number): string => String(Number((0.1 / unit).toPrecision(2)));
  store.on(["sensor", "quantity", "hidden", "errorOnRobot", "window"], () => {
    const { quantity, errorOnRobot } = store.state;
    const { force, moment } = robot.wrenches.metresPer;
    const { metresPer, fullColour } = robot.error;
    const known = errorOnRobot && metresPer !== null && fullColour !== null;
    const limb = known ? Number(fullColour.toPrecision(2)) : 0;
    const error = known ? `; of error: ${round(metresPer)} ${UNIT[quantity]}; limb red at ${limb} ${UNIT[quantity]}` : "";
    panels.scale.textContent = `0.1 m of arrow: ${round(force)} N, ${round(moment)} N m${error}`;
  });
  store.on(["sample", "sensor", "quantity"], () => {
    const { sample, sensor, quantity } = store.state;
    const when = `sample ${sample}, ${(data.time[sample] ?? 0).toFixed(3)} s`;
    robot.canvas.setAttribute("aria-label", `Robot ${data.scene.robot.name} in its posture at ${when}`);
    const name = data.sensor(sensor)?.name ?? "no sensor";
    space.canvas.setAttribute("aria-label", `${quantity === "force" ? "Force" : "Torque"} space of ${name} at ${when}`);
  });
}
