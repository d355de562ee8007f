# SPDX-License-Identifier: BSD-3-Clause
"""Keys of an experiment file that correct a fault."""

from __future__ import annotations

from collections.abc import Mapping
from copy import deepcopy
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import MeasureDirection
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.inspection.comparison import Comparison
from forcetorque.inspection.draft.divided_stream import DividedStream
from forcetorque.inspection.draft.edits import Edit, key_edit, table_edit
from forcetorque.inspection.draft.toml_lines import tables_of, toml_value
from forcetorque.inspection.fault_messages import late_and_kept
from forcetorque.inspection.plausibility.fault_hypotheses import Explanation
from forcetorque.robot.mounting import rotation_by, rotation_vector, rotation_words

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
