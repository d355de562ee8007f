# SPDX-License-Identifier: BSD-3-Clause
"""Keys of an experiment file that correct a fault; wrench and motion of one table divided into two streams."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass
from typing import Any, ClassVar, Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import MeasureDirection
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.inspection.comparison_with_model import Comparison
from forcetorque.inspection.diagnosis import clock_of_division, late_and_kept, motion_name
from forcetorque.inspection.draft.toml_edits import Edit, edit_between, key_edit, table_blocks, table_edit
from forcetorque.inspection.draft.toml_lines import tables_of, toml_value
from forcetorque.inspection.plausibility.fault_hypotheses import Explanation
from forcetorque.recording.alignment import ClockShift
from forcetorque.robot.mount_estimate import rotation_by, rotation_vector, rotation_words

_JOINTS = ("position", "velocity", "acceleration", "torque", "motor_current", "pwm")
_FRAMES = ("orientation", "translation", "gravity", "proper_acceleration", "angular_velocity", "angular_acceleration")
_OF_MOTION: Final = frozenset((*_JOINTS, *_FRAMES))
"""Quantities that leave the stream of the sensor; others, which a variable or a contact names by the stream, stay."""
_REFERENCES: Final = (("load", "motion"), ("support", "imu"))
"""Tables with keys that list streams of a motion."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DividedStream:
    """The division of a stream of a table, and the clock of the sensor's part."""

    cause: ClassVar[str] = ""
    """Nothing beside the fault is wrong."""
    is_shared: ClassVar[bool] = True
    """Other sensors have the motion too."""
    stream: str
    """The stream."""
    clock: Mapping[str, Any]
    """The `[[clock]]` of one of the two streams."""
    is_first: bool
    """Whether it stands in front of others, which bring streams to the clock of this one."""

    @classmethod
    def of(
        cls, content: Mapping[str, Any], stream: str, delay_s: float, shifts: Sequence[ClockShift]
    ) -> DividedStream | None:
        """Plan the division.

        Args:
            content: Tables of the experiment file.
            stream: The stream.
            delay_s: By how much the stamps of the sensor's signals are late; s.
            shifts: What the clocks of the file did.

        Returns:
            The division; None where the file lists no signals of the stream, or of one kind alone.
        """
        clock, is_first = clock_of_division(stream, delay_s, shifts)
        division = cls(stream=stream, clock=clock, is_first=is_first)
        signals = next((one.get("signal", ()) for one in _streams(content) if one.get("name") == stream), ())
        moves = [one.get("quantity") in _OF_MOTION for one in signals]
        return division if any(moves) and not all(moves) else None

    @property
    def tried(self) -> float:
        """What is tried is what is written."""
        return float(self.clock["delay_s"])

    @property
    def by_hand(self) -> str:
        """What a person writes."""
        clock = ", ".join(f"{key} = {toml_value(value)}" for key, value in self.clock.items())
        place = ", in front of the others" if self.is_first else ""
        return (
            f"list the signals of the motion in a [[recording.stream]] of their own and write [[clock]] {clock}{place}"
        )

    def content(self, content: Mapping[str, Any], value: float) -> dict[str, Any]:
        """Change the content of a file.

        Args:
            content: Its tables.
            value: The delay; s.

        Returns:
            A copy with two streams and the clock.
        """
        changed = deepcopy(dict(content))
        streams = []
        for one in _streams(changed):
            signals = one["signal"]
            if one["name"] != self.stream:
                streams.append(one)
                continue
            own = [signal for signal in signals if signal["quantity"] not in _OF_MOTION]
            moving = [signal for signal in signals if signal["quantity"] in _OF_MOTION]
            streams += [{**one, "signal": own}, {**one, "name": motion_name(self.stream), "signal": moving}]
        changed["recording"]["stream"] = streams
        clock, others = {**self.clock, "delay_s": value}, changed.get("clock", [])
        changed["clock"] = [clock, *others] if self.is_first else [*others, clock]
        for table, _, key, names in self._references(changed):
            table[key] = names
        return changed

    def edit(self, text: str, content: Mapping[str, Any]) -> Edit | None:
        """Make the change of the text of a file.

        Args:
            text: Content of the file.
            content: Its tables.

        Returns:
            The change; None where the text has the tables in a form that is not changed.
        """
        changed = text
        for _, (name, index), key, names in self._references(content):
            edit = key_edit(changed, name, index, key, names)
            changed = changed if edit is None else edit.applied(changed)
        number = next(k for k, one in enumerate(_streams(content)) if one["name"] == self.stream)
        blocks = table_blocks(changed, "recording.stream", number)
        signals = _streams(content)[number]["signal"]
        if blocks is None or len(blocks.inner) != len(signals):
            return None
        is_own = [signal["quantity"] not in _OF_MOTION for signal in signals]
        named = key_edit("\n".join(blocks.head) + "\n", "recording.stream", 0, "name", motion_name(self.stream))
        if named is None:
            return None
        divided = [
            *blocks.head,
            *(text for own, block in zip(is_own, blocks.inner, strict=True) if own for text in block),
            *named.applied("\n".join(blocks.head) + "\n").removesuffix("\n").split("\n"),
            *(text for own, block in zip(is_own, blocks.inner, strict=True) if not own for text in block),
        ]
        changed = "\n".join([*blocks.before, *divided, *blocks.behind]) + "\n"
        clock = table_edit(changed, "clock", self.clock, before="clock" if self.is_first else "sensor")
        edit = None if clock is None else edit_between(text, clock.applied(changed))
        return edit if edit is not None and edit.results_in(self.content(content, self.tried), text) else None

    def _references(self, content: Mapping[str, Any]) -> Iterator[tuple[Any, tuple[str, int], str, list[str]]]:
        """Tables that list the stream as that of a motion, with their names, keys and new lists."""
        for name, key in _REFERENCES:
            known = content.get(name, ())
            for index, table in enumerate([known] if isinstance(known, Mapping) else known):
                streams = table.get(key)
                if isinstance(streams, list) and self.stream in streams:
                    new = [motion_name(self.stream) if one == self.stream else one for one in streams]
                    yield table, (name, index), key, new


def _streams(content: Mapping[str, Any]) -> Sequence[Any]:
    recording = content.get("recording")
    return tables_of(recording, "stream") if isinstance(recording, dict) else ()


_QUARTER_TURNS_DEG: Final = 3.0
"""Angle to a turn by multiples of 90 degrees within which a mount is taken as that turn: a screw pattern, and an
estimate over the whole log with its contacts."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Correction:
    """A key of a table, or a table, that corrects a fault."""

    table: str
    """Table, or list of tables."""
    index: int | None
    """Which of the list, from 0; None for a table that is not in a list, or is added to it."""
    key: str
    """The key; empty for a table that is added."""
    value: Any
    """Value to write; keys of a table that is added."""
    tried: Any
    """Value that stands for it where it is tried."""
    owner: str = ""
    """Name of the table in the list; empty for none."""
    cause: str = ""
    """What is wrong with the value that is stated; empty where the fault has all of it."""
    is_first: bool = False
    """Whether a table that is added stands in front of those that the list has."""

    @property
    def is_shared(self) -> bool:
        """Whether other sensors have the table too."""
        return self.table != "sensor"

    def content(self, content: Mapping[str, Any], value: Any) -> dict[str, Any]:
        """Change the content of a file.

        Args:
            content: Its tables.
            value: Value of the key.

        Returns:
            A copy with the value.
        """
        changed = deepcopy(dict(content))
        if not self.key:
            others = changed.get(self.table, [])
            changed[self.table] = [value, *others] if self.is_first else [*others, value]
        else:
            table = changed[self.table] if self.index is None else changed[self.table][self.index]
            table[self.key] = value
        return changed

    def edit(self, text: str, content: Mapping[str, Any]) -> Edit | None:
        """Make the change of the text of a file.

        Args:
            text: Content of the file.
            content: Its tables.

        Returns:
            The change; None where the text has the key in a form that is not changed.
        """
        if self.key:
            edit = key_edit(text, self.table, self.index or 0, self.key, self.value)
        else:
            edit = table_edit(text, self.table, self.value, before=self.table if self.is_first else "sensor")
        return edit if edit is not None and edit.results_in(self.content(content, self.value), text) else None

    @property
    def by_hand(self) -> str:
        """What a person writes."""
        header = f"[{self.table}]" if self.index is None and self.key else f"[[{self.table}]]"
        if not self.key:
            keys = ", ".join(f"{key} = {toml_value(value)}" for key, value in self.value.items())
            return f"write {header} {keys}{', in front of the others' if self.is_first else ''}"
        return f"write {self.key} = {toml_value(self.value)} in {header}{f' {self.owner!r}' if self.owner else ''}"


def correction_of(
    content: Mapping[str, Any], comparison: Comparison, fault: Explanation
) -> Correction | DividedStream | None:
    """Find the key that corrects a fault.

    Args:
        content: Tables of the experiment file.
        comparison: Measured and expected wrenches of a sensor.
        fault: What is wrong.

    Returns:
        The correction; None where the file does not state what is wrong.
    """
    run = comparison.run
    index = _index(content, "sensor", "name", run.sensor.name)
    if fault.kind == "gravity" and fault.vector is not None:
        return _of_gravity(content, comparison, fault.vector)
    if fault.kind == "delay" and fault.value is not None:
        return _of_delay(content, comparison, fault, fault.value)
    if index is None:
        return None
    if fault.kind == "reversed":
        return _of_sense(content, run, index)
    return _of_mount(run, index, fault.turn[:3, :3]) if fault.kind == "mount" else None


def _index(content: Mapping[str, Any], table: str, key: str, value: str) -> int | None:
    values = [one.get(key) for one in tables_of(content, table)]
    return values.index(value) if value in values else None


def _of_gravity(content: Mapping[str, Any], comparison: Comparison, down: FloatArray) -> Correction | None:
    support = comparison.parts[0].interval.support
    index = None if support is None else _index(content, "support", "frame", support.frame)
    if support is None or index is None:
        return None
    rounded = [float(value) for value in np.round(down, 4) + 0.0]
    return Correction(
        table="support", index=index, key="gravity_direction", value=rounded, tried=rounded, owner=support.frame
    )


def _of_sense(content: Mapping[str, Any], run: SensorRun, index: int) -> Correction | None:
    key, load = "measure_direction", content.get("load")
    of_sensor = tables_of(content, "sensor")[index].get(key)
    of_load = load.get(key) if isinstance(load, dict) else None
    stated = of_load if of_sensor is None else of_sensor
    if stated is None:
        return None
    other = str(next(one for one in MeasureDirection if one != stated))
    if of_sensor is None:
        return Correction(table="load", index=None, key=key, value=other, tried=other)
    return Correction(table="sensor", index=index, key=key, value=other, tried=other, owner=run.sensor.name)


def _of_mount(run: SensorRun, index: int, turn: FloatArray) -> Correction:
    # `turn` takes components along the stated axes to those along the axes of the sensor: the inverse of its pose
    stated = run.experiment.mounts.get(run.sensor.name)
    rotation = np.eye(3) if stated is None else rotation_by(np.deg2rad(stated.rotation_deg))
    shift = np.zeros(3) if stated is None else stated.shift_mm
    quarter = np.round(turn) + 0.0
    angle = np.rad2deg(np.linalg.norm(rotation_vector(turn @ quarter.T))) if _is_rotation(quarter) else np.inf
    is_quarter = bool(angle <= _QUARTER_TURNS_DEG) and not np.array_equal(quarter, np.eye(3))
    vector = rotation_vector(rotation @ (quarter if is_quarter else turn).T)
    rotation_deg = np.rad2deg(vector)
    tried = {
        key: [round(float(value), 2) + 0.0 for value in values]
        for key, values in (("rotation_deg", rotation_deg), ("shift_mm", shift))
    }
    is_stated = is_quarter or run.sensor.prior is None  # without a prior matrix calibrate estimates no mount
    words, by = rotation_words(rotation_vector(turn.T)), "" if is_stated else ", which calibrate estimates"
    return Correction(
        table="sensor",
        index=index,
        key="mount",
        value=tried if is_stated else "unknown",
        tried=tried,
        owner=run.sensor.name,
        cause=f"the sensor is turned by {words} against its stated mount{by}",
    )


def _is_rotation(matrix: FloatArray) -> bool:
    """Whether a matrix of whole numbers turns axes onto axes."""
    return np.array_equal(matrix @ matrix.T, np.eye(3)) and bool(np.linalg.det(matrix) > 0.0)


def _of_delay(
    content: Mapping[str, Any], comparison: Comparison, fault: Explanation, delay_s: float
) -> Correction | DividedStream | None:
    late, other = late_and_kept(comparison, fault)
    shifts = comparison.run.experiment.recording.clocks
    if other == late:
        return DividedStream.of(content, late, delay_s, shifts)
    for number, clock in enumerate(tables_of(content, "clock")):
        if late in (clock["stream"] if isinstance(clock["stream"], list) else [clock["stream"]]):
            known = clock["delay_s"]
            if isinstance(known, str):
                return None
            total = round(float(known) + delay_s, 4)
            return Correction(table="clock", index=number, key="delay_s", value=total, tried=total, owner=late)
    clock = {"stream": late, "to": other, "delay_s": round(delay_s, 4)}
    is_first = any(one.to == late for one in shifts)
    return Correction(table="clock", index=None, key="", value=clock, tried=clock, is_first=is_first)
