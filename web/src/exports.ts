// SPDX-License-Identifier: BSD-3-Clause
// Saved samples as a table and as lines of an experiment file.

import { inOrder, markedIntervals, tomlText, type Mark } from "./marks";
import type { SceneData } from "./scene_data";

const DEGREES = 180 / Math.PI;

/** Write saved samples with their joint configuration, one row each (Table 4.2 of the thesis). */
export function toCsv(data: SceneData, marks: readonly Mark[]): string {
  const names = data.scene.coordinates.map((name, k) => `${name}${data.isLength(k) ? "_m" : "_deg"}`);
  const rows = inOrder(marks).map((mark) => [
    String(mark.sample),
    seconds(mark.time_s),
    mark.mark,
    mark.label,
    ...data.scene.coordinates.map((_, k) => coordinate(data, mark.sample, k)),
  ]);
  return [["sample", "time_s", "mark", "label", ...names], ...rows]
    .map((row) => `${row.map(quoted).join(",")}\n`)
    .join("");
}

/** Write intervals as tables of an experiment file; comments say what such a file would refuse. */
export function toToml(data: SceneData, marks: readonly Mark[]): string {
  const tables = markedIntervals(data, marks).map((interval) => {
    const lines = [
      "[[interval]]",
      `label = ${tomlText(interval.label)}`,
      `start_s = ${number(interval.start_s)}`,
      `end_s = ${number(interval.end_s)}`,
      `use = ${tomlText(interval.use)}`,
      ...interval.supportLines,
    ];
    const others = interval.overlaps.map(tomlText).join(", ");
    if (others) lines.push(`# overlaps ${others}: shorten those, as a sample is fitted or judged once`);
    return `${lines.join("\n")}\n`;
  });
  return ["# intervals marked in the viewer; copy them into the experiment file\n", ...tables].join("\n");
}

/** Make what is sent to the server to be written beside the experiment. */
export function toAnnotations(data: SceneData, marks: readonly Mark[]): object {
  return {
    samples: inOrder(marks),
    intervals: markedIntervals(data, marks).map(({ label, start_s, end_s, use }) => ({ label, start_s, end_s, use })),
  };
}

function coordinate(data: SceneData, sample: number, column: number): string {
  const value = data.position(sample, column);
  if (Number.isNaN(value)) return "";
  return data.isLength(column) ? value.toFixed(6) : (value * DEGREES).toFixed(4);
}

// the recording counts whole nanoseconds
function seconds(value: number): string {
  return value.toFixed(9).replace(/0+$/, "").replace(/\.$/, "");
}

function number(value: number): string {
  const text = seconds(value);
  return text.includes(".") ? text : `${text}.0`;
}

function quoted(cell: string): string {
  return /[",\r\n]/.test(cell) ? `"${cell.replaceAll('"', '""')}"` : cell;
}
