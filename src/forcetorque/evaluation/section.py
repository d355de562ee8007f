# SPDX-License-Identifier: BSD-3-Clause
"""The `[[load_case]]` and `[trial]` sections of an experiment file: loads to come, and which trial it is."""

from __future__ import annotations

from collections.abc import Sequence
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Final

import numpy as np
from pydantic import Field, model_validator

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.errors import ExperimentError, known_names
from forcetorque.base.toml_file import NotNegative, Positive, Table, Text
from forcetorque.experiment.section import Loading, Section, require_link
from forcetorque.robot.model import RobotModel


class LoadCaseOffset(StrEnum):
    """What offset the readings of a use are taken with."""

    FITTED = "fitted"
    """That of the calibration: the sensor is used without being switched off."""
    TARED = "tared"
    """One that is taken anew just before use, under the load of the fitted data; readings are changes from there."""


_KINDS: Final = {
    "force_N": {"frame", "radius_m", "direction"},
    "weight_on": {"radius_m"},
    "mass_kg": {"frame", "centre_of_mass_m"},
    "full_scale_share": frozenset[str](),
}
"""What says which loads there are, and what may be said of each kind."""


class LoadCaseTable(Table):
    """Loads to come, and the error that is allowed there."""

    name: Text
    """Name, unique in the file."""
    sensor: Text | None = None
    """Sensor that is used so; every one that the loads pass if left out."""
    force_N: Positive | None = None
    """Force of pushes; N; with frame, or radius_m alone for anywhere around the sensor."""
    weight_on: Text | None = None
    """Frame, such as a sole, on whose origin the whole robot stands, against gravity along its z axis."""
    mass_kg: Positive | None = None
    """Mass of a tool, in any orientation; kg; with centre_of_mass_m."""
    full_scale_share: Annotated[float, Field(gt=0.0, le=1.0, strict=True)] | None = None
    """Share of its full scale that every component may reach, all at once."""
    frame: Text | None = None
    """Link that is pushed or that carries the tool, outboard of the sensor; any posture between them."""
    radius_m: NotNegative | None = None
    """How far from the origin of the frame, or from the sensor, a force may act; m; 0 if left out with a frame."""
    direction: Annotated[FloatArray, ArrayField((3,))] | None = None
    """Direction of the pushes, in the axes of the frame; any if left out."""
    centre_of_mass_m: Annotated[FloatArray, ArrayField((3,))] | None = None
    """Centre of mass of the tool, in the frame, or in that of the sensor."""
    offset: LoadCaseOffset = LoadCaseOffset.FITTED
    """`fitted`: used without being switched off; `tared`: the offset is taken anew before use."""
    changes: dict[Text, NotNegative] = Field(default_factory=dict)
    """How far variables such as temperature go from where the offset holds, root mean square."""
    force_error_N: Positive | None = None
    """Root mean square force error that is allowed; a twentieth of the loads if neither error is stated."""
    moment_error_Nm: Positive | None = None
    """Root mean square moment error that is allowed."""

    @model_validator(mode="after")
    def _says_which_loads(self) -> LoadCaseTable:
        kinds = [key for key in _KINDS if getattr(self, key) is not None]
        if len(kinds) != 1:
            raise ValueError(f"expected one of {', '.join(_KINDS)}, got {', '.join(kinds) or 'none'}")
        (kind,) = kinds
        known = set().union(*_KINDS.values())
        for key in sorted(known - _KINDS[kind]):
            if getattr(self, key) is not None:
                raise ValueError(f"{key} does not belong to {kind}; leave it out")
        self._require_place(kind)
        return self

    def _require_place(self, kind: str) -> None:
        if kind == "force_N" and self.frame is None and self.radius_m is None:
            raise ValueError("force_N needs a frame, or radius_m around the sensor")
        if kind == "mass_kg" and self.centre_of_mass_m is None:
            raise ValueError("mass_kg needs centre_of_mass_m")
        if self.direction is not None and (self.frame is None or not np.any(self.direction)):
            raise ValueError("direction needs a frame, and may not be zero")


def _checked_load_cases(tables: tuple[LoadCaseTable, ...], loading: Loading) -> tuple[LoadCaseTable, ...]:
    return require_load_cases(tables, loading.file, loading.model)


def require_load_cases(tables: Sequence[LoadCaseTable], file: Path, model: RobotModel) -> tuple[LoadCaseTable, ...]:
    """Check load cases against the robot.

    Args:
        tables: The tables.
        file: Their file, for messages.
        model: The robot.

    Returns:
        The same tables.

    Raises:
        ExperimentError: If two have one name, or a frame or sensor does not exist.
    """
    names = [table.name for table in tables]
    for number, table in enumerate(tables):
        where = f"{file}: load_case[{number}]"
        if table.name in names[:number]:
            raise ExperimentError(f"{where}: two load cases are called {table.name!r}; expected one of each name")
        for key in ("frame", "weight_on"):
            link = getattr(table, key)
            if link is not None:
                require_link(model, link, f"{where}: {key}")
        sensors = {name for sensor in model.sensors.values() for name in (sensor.name, *sensor.aliases)}
        if table.sensor is not None and table.sensor not in sensors:
            raise ExperimentError(
                f"{where}: sensor: robot {model.name!r} has no sensor {table.sensor!r}; "
                f"{known_names(table.sensor, sensors)}"
            )
    return tuple(tables)


LOAD_CASES: Section[tuple[LoadCaseTable, ...], tuple[LoadCaseTable, ...]] = Section(
    key="load_case",
    type=tuple[LoadCaseTable, ...],
    default=(),
    description="What the sensors are to be used for.",
    read=_checked_load_cases,
    empty=(),
    of_robot=False,
    of_plan=True,
)


class Trial(Table):
    """What the recording is to a comparison with others of the same sensor."""

    condition: Text | None = None
    """What was done to the sensor, in any words, such as the torque of its screws."""
    number: Annotated[int, Field(ge=1, strict=True)] | None = None
    """Which trial of its condition it is, from 1; by the order of the files if left out."""


def _unchanged_trial(table: Trial, loading: Loading) -> Trial:
    return table


TRIAL: Section[Trial, Trial] = Section(
    key="trial",
    type=Trial,
    default=Trial(),
    description="Condition and number, for `forcetorque study compare`.",
    read=_unchanged_trial,
    empty=Trial(),
    of_robot=False,
)
