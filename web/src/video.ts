// SPDX-License-Identifier: BSD-3-Clause
// A film of the robot and its force space. Each frame is drawn for its own instant, however long that takes, so the
// same scene gives the same frames. The H.264 encoders of browsers pack the same frames into different bytes each
// time; VP9 with a fixed quantizer does not.

import { ArrayBufferTarget, Muxer } from "mp4-muxer";

import { INK, PAPER, seriesColour } from "./colours";
import type { RobotView } from "./robot_view";
import type { SceneData } from "./scene_data";
import type { Store } from "./store";
import { clearDates } from "./mp4_dates";
import type { View3D } from "./view3d";

const CAPTION = 44; // pixels below the views
const KEY_FRAME_S = 2;
const WAITING = 4; // frames that the encoder may be behind
const CODECS = {
  h264: ["avc1.640028", "avc1.42002a"],
  vp9: ["vp09.00.40.08"],
} as const;
const ROUNDING_S = 1e-9; // a frame for the very instant of a sample shows it, not the one before
const QUANTIZER = 24; // of 0 to 63: no difference to be seen

/** How frames are packed: H.264 plays everywhere, VP9 gives the same bytes every time. */
export type Codec = keyof typeof CODECS;

/** Which part of the recording, how fast, and how large. */
export interface VideoOptions {
  /** First sample; that of the recording if left out. */
  readonly start?: number;
  /** Last sample; that of the recording if left out. */
  readonly end?: number;
  /** Frames per second of the film; 20 if left out. */
  readonly fps?: number;
  /** Even number of pixels; 960 if left out. */
  readonly width?: number;
  /** Even number of pixels; 480 if left out. */
  readonly height?: number;
  /** Seconds of the recording per second of the film; 1 if left out. */
  readonly speed?: number;
  /** H.264, or VP9 where the browser has no H.264, if left out. */
  readonly codec?: Codec;
}

interface Format {
  readonly config: VideoEncoderConfig;
  readonly codec: Codec;
}

/** What the types of the standard library lack. */
type EncodeOptions = VideoEncoderEncodeOptions & { vp9?: { quantizer: number } };

/** What a film needs of the page. */
export interface Stage {
  readonly data: SceneData;
  readonly store: Store;
  readonly robot: RobotView;
  readonly space: View3D;
  /** Draws everything that waits. */
  readonly flush: () => void;
}

/** Instants of the frames: each is shown as the last sample at or before it. */
export function frameTimes(data: SceneData, options: VideoOptions): number[] {
  const { fps = 20, speed = 1, start = 0, end = data.samples - 1 } = options;
  const [from, to] = [data.time[start], data.time[end]];
  if (!(fps > 0 && speed > 0) || from === undefined || to === undefined || to < from) {
    const got = `fps ${fps}, speed ${speed}, samples ${start} to ${end} of ${data.samples}`;
    throw new Error(`video: expected fps and speed above 0, and a last sample after the first one, got ${got}`);
  }
  const count = Math.floor(((to - from) * fps) / speed + ROUNDING_S) + 1;
  return Array.from({ length: count }, (_, k) => from + (k * speed) / fps + ROUNDING_S);
}

/** Make the film; the bytes of an MP4 file. */
export async function makeVideo(
  stage: Stage,
  options: VideoOptions,
  progress: (share: number) => void,
): Promise<Uint8Array<ArrayBuffer>> {
  const { fps = 20, width = 960, height = 480 } = options;
  if (width % 2 !== 0 || height % 2 !== 0 || width < 64 || height < 64) {
    throw new Error(`video: expected an even width and height of at least 64 x 64, got ${width} x ${height}`);
  }
  const times = frameTimes(stage.data, options);
  const { config, codec } = await supported(options.codec ? [options.codec] : ["h264", "vp9"], width, height, fps);
  const target = new ArrayBufferTarget();
  const muxer = new Muxer({
    target,
    video: { codec: codec === "h264" ? "avc" : "vp9", width, height, frameRate: fps },
    fastStart: "in-memory",
  });
  let failure: Error | null = null;
  const encoder = new VideoEncoder({
    output: (chunk, meta) => muxer.addVideoChunk(chunk, meta),
    error: (error) => {
      failure = error;
    },
  });
  encoder.configure(config);
  const canvas = new OffscreenCanvas(width, height);
  const before = stage.store.state;
  stage.store.set({ playing: false });
  for (const view of [stage.robot, stage.space]) view.hold(width / 2, height - CAPTION);
  try {
    for (const [k, time] of times.entries()) {
      drawFrame(stage, canvas, stage.data.sampleAt(time));
      const frame = new VideoFrame(canvas, { timestamp: Math.round((k * 1e6) / fps), duration: Math.round(1e6 / fps) });
      const wanted: EncodeOptions = {
        keyFrame: k % Math.max(1, Math.round(KEY_FRAME_S * fps)) === 0,
        vp9: { quantizer: QUANTIZER },
      };
      encoder.encode(frame, wanted);
      frame.close();
      progress((k + 1) / times.length);
      do
        await new Promise((resume) => setTimeout(resume, 0)); // lets the encoder and the page work
      while (encoder.encodeQueueSize > WAITING && failure === null);
      if (failure !== null) throw failure;
    }
    await encoder.flush();
  } finally {
    if (encoder.state !== "closed") encoder.close();
    for (const view of [stage.robot, stage.space]) view.release();
    stage.store.set({ sample: before.sample });
  }
  muxer.finalize();
  return clearDates(new Uint8Array(target.buffer));
}

async function supported(codecs: readonly Codec[], width: number, height: number, framerate: number): Promise<Format> {
  if (typeof VideoEncoder === "undefined") throw new Error("video: this browser has no WebCodecs; Chromium has");
  for (const codec of codecs) {
    const rate =
      codec === "h264"
        ? { bitrate: 4_000_000, avc: { format: "avc" as const } }
        : { bitrateMode: "quantizer" as const };
    for (const name of CODECS[codec]) {
      const config: VideoEncoderConfig = {
        codec: name,
        width,
        height,
        framerate,
        latencyMode: "quality",
        hardwareAcceleration: "prefer-software",
        ...rate,
      };
      const answer = await VideoEncoder.isConfigSupported(config).catch(() => null);
      if (answer?.supported) return { config, codec };
    }
  }
  throw new Error(`video: this browser does not encode ${codecs.join(" or ")} at ${width} x ${height}`);
}

function drawFrame(stage: Stage, canvas: OffscreenCanvas, sample: number): void {
  const { data, store, robot, space } = stage;
  store.set({ sample });
  stage.flush();
  robot.draw();
  space.draw();
  const pen = canvas.getContext("2d");
  if (!pen) throw new Error("video: this browser draws nothing on a canvas");
  const { width, height } = canvas;
  pen.fillStyle = PAPER;
  pen.fillRect(0, 0, width, height);
  pen.drawImage(robot.canvas, 0, 0);
  pen.drawImage(space.canvas, width / 2, 0);
  pen.fillStyle = INK;
  pen.font = "14px system-ui, 'DejaVu Sans', sans-serif";
  const sensor = data.sensor(store.state.sensor);
  const quantity = store.state.quantity === "force" ? "force" : "torque";
  pen.fillText(`${data.scene.title} · ${sensor?.name ?? ""} · ${quantity}`, 12, height - 26, width / 2);
  pen.fillText(`sample ${sample} · ${(data.time[sample] ?? 0).toFixed(3)} s`, 12, height - 8);
  let x = width / 2 + 12;
  for (const series of sensor?.wrenches ?? []) {
    if (store.state.hidden.has(series.name)) continue;
    pen.fillStyle = sensor ? seriesColour(sensor, series) : INK;
    pen.fillRect(x, height - 22, 10, 10);
    pen.fillText(series.name, x + 14, height - 12);
    x += 30 + pen.measureText(series.name).width;
  }
}
