# SPDX-License-Identifier: BSD-3-Clause
"""Samples and intervals that were saved in the page, as files beside the experiment."""

from __future__ import annotations

import csv
import io
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, FiniteFloat

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ForceTorqueError
from forcetorque.base.output_file import write_bytes_atomically
from forcetorque.recording.recording import Use
from forcetorque.viewer.scene import SceneInterval
from forcetorque.viewer.scene_arrays import read_array
from forcetorque.viewer.scene_builder import BuiltScene

_NANOSECOND = 1e-9
"""Instants are whole nanoseconds; s."""

Label = Annotated[str, Field(max_length=200)]


class _Sent(BaseModel):
    model_config = ConfigDict(defer_build=True, extra="forbid", frozen=True)


class SavedSample(_Sent):
    """A sample that was saved in the page."""

    sample: Annotated[int, Field(ge=0)]
    """Its number."""
    time_s: FiniteFloat
    """Its time; s."""
    mark: Literal["begin", "end", "point"]
    """Whether something begins or ends there."""
    label: Label
    """What was written to it."""
    use: Use
    """Use of the interval that begins there."""


class SavedInterval(_Sent):
    """An interval that was marked in the page."""

    label: Label
    """Its label."""
    start_s: FiniteFloat
    """Start; s."""
    end_s: FiniteFloat
    """End, itself excluded; s."""
    use: Use
    """What its samples are for."""


class Annotations(_Sent):
    """Everything that was saved in a page."""

    samples: tuple[SavedSample, ...]
    """Saved samples."""
    intervals: tuple[SavedInterval, ...]
    """Marked intervals."""


def samples_csv(annotations: Annotations, built: BuiltScene) -> str:
    """Write saved samples with their joint configurations (thesis Table 4.2).

    Args:
        annotations: What was saved.
        built: The scene in which it was saved.

    Returns:
        Comma-separated text; joints in degrees, or m where prismatic.

    Raises:
        ForceTorqueError: If a sample is not in the scene.
    """
    scene = built.scene
    positions, times = read_array(built.block, scene.positions), read_array(built.block, scene.time_s)
    slides = {joint.name for joint in scene.robot.joints if joint.type == "prismatic"}
    is_slide = [name in slides for name in scene.coordinates]
    names = [f"{name}_{'m' if slide else 'deg'}" for name, slide in zip(scene.coordinates, is_slide, strict=True)]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["sample", "time_s", "mark", "label", *names])
    for saved in annotations.samples:
        if saved.sample >= scene.samples:
            raise ForceTorqueError(f"sample {saved.sample}: expected a number below {scene.samples}")
        row = np.asarray(positions[saved.sample], dtype=np.float64)
        time = _seconds(float(times[saved.sample]))
        writer.writerow([saved.sample, time, saved.mark, saved.label, *_configuration(row, is_slide)])
    return text.getvalue()


def intervals_toml(annotations: Annotations, built: BuiltScene) -> str:
    """Write marked intervals as an experiment file has them.

    Args:
        annotations: What was saved.
        built: The scene in which it was saved.

    Returns:
        `[[interval]]` tables, cut off at the end of the log; the support is that of the experiment's interval which
        holds them. Comments say what the experiment file would refuse.

    Raises:
        ForceTorqueError: If an interval ends before it begins, or begins after the log.
    """
    tables = ["# intervals marked in the viewer; copy them into the experiment file\n"]
    for interval in annotations.intervals:
        start_s, end_s = interval.start_s, min(interval.end_s, built.scene.end_s)
        if not start_s < end_s:
            raise ForceTorqueError(
                f"interval {interval.label!r}: expected an end after its start and a start inside the log"
            )
        lines = [
            "[[interval]]",
            f"label = {_quoted(interval.label)}",
            f"start_s = {_seconds(start_s)}",
            f"end_s = {_seconds(end_s)}",
            f'use = "{interval.use.value}"',
            *_support_lines(start_s, end_s, interval.use, built.scene.intervals),
            *_overlap_lines(start_s, end_s, interval.use, built.scene.intervals),
        ]
        tables.append("\n".join(lines) + "\n")
    return "\n".join(tables)


def save_annotations(annotations: Annotations, built: BuiltScene, experiment: Path) -> tuple[Path, Path]:
    """Write both files beside an experiment file, in place of those of the same names.

    Args:
        annotations: What was saved.
        built: The scene in which it was saved.
        experiment: The experiment file, `NAME.toml`.

    Returns:
        `NAME.samples.csv` and `NAME.intervals.toml`.
    """
    samples, intervals = saved_files(experiment)
    table, tables = samples_csv(annotations, built), intervals_toml(annotations, built)  # both or none
    write_bytes_atomically(samples, table.encode())
    write_bytes_atomically(intervals, tables.encode())
    return samples, intervals


def saved_files(experiment: Path) -> tuple[Path, Path]:
    """Name the files of saved samples and intervals.

    Args:
        experiment: The experiment file, `NAME.toml`.

    Returns:
        `NAME.samples.csv` and `NAME.intervals.toml` beside it.
    """
    return experiment.with_suffix(".samples.csv"), experiment.with_suffix(".intervals.toml")


def _configuration(row: FloatArray, is_slide: list[bool]) -> list[str]:
    return [f"{value:.6f}" if slide else f"{np.rad2deg(value):.4f}" for value, slide in zip(row, is_slide, strict=True)]


def _support_lines(start_s: float, end_s: float, use: Use, intervals: tuple[SceneInterval, ...]) -> list[str]:
    """The support of an interval of the experiment that holds a span; a comment that asks for it if none does."""
    if not all(interval.states_support for interval in intervals):
        return []
    for interval in intervals:
        if interval.support is not None and interval.start_s <= start_s and end_s <= interval.end_s + _NANOSECOND:
            return [f"support = {_quoted(interval.support)}"]
    return [] if use is Use.IGNORE else ['# support = "..."  # state the link that stands still']


def _overlap_lines(start_s: float, end_s: float, use: Use, intervals: tuple[SceneInterval, ...]) -> list[str]:
    """A comment that names the intervals of the experiment in which samples would be used twice."""
    if use is Use.IGNORE:
        return []
    overlapping = [
        _quoted(interval.label)
        for interval in intervals
        if interval.use != Use.IGNORE.value
        and interval.start_s < end_s - _NANOSECOND
        and start_s < interval.end_s - _NANOSECOND
    ]
    return (
        [f"# overlaps {', '.join(overlapping)}: shorten those, as a sample is fitted or judged once"]
        if overlapping
        else []
    )


def _seconds(value: float) -> str:
    """Seconds to the nanosecond, as a float of TOML."""
    whole, _, fraction = f"{value:.9f}".partition(".")
    return f"{whole}.{fraction.rstrip('0') or '0'}"


def _quoted(text: str) -> str:
    """A basic string of TOML."""
    escaped = (
        f"\\{character}"
        if character in '"\\'
        else character
        if character.isprintable()
        else "".join(f"\\u{ord(character):04x}" if ord(character) < 0x10000 else f"\\U{ord(character):08x}")
        for character in text
    )
    return f'"{"".join(escaped)}"'
