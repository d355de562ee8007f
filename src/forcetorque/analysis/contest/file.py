# SPDX-License-Identifier: BSD-3-Clause
"""The file of a contest: which sensors and methods meet, on which runs of one motion."""

from __future__ import annotations

from collections import Counter
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from forcetorque.evaluation import Offset
from forcetorque.experiment.tables.six_axes import SixPositive
from forcetorque.toml_table import Finite, NotNegative, Table, Text

PHASES = 120
"""Phases of a motion, if the file says nothing."""


class Method(StrEnum):
    """How a contestant is read."""

    MAKER = "maker"
    """As it is logged, or by the prior matrix of the experiment: what it was bought with."""
    WORKBENCH = "workbench"
    """Known loads on a workbench: `bench` names its file."""
    IN_SITU = "in-situ"
    """Fitted on the calibration intervals of the runs, from the prior matrix on."""
    IN_SITU_WITHOUT_PRIOR = "in-situ-without-prior"
    """The same without a prior matrix."""
    KNOWN_MASSES = "known-masses"
    """Fitted on runs with `[load]`: known masses were added, an accelerometer said where gravity points."""
    REFERENCE_SENSOR = "reference-sensor"
    """Fitted on runs with `applied` of `[load]`: another sensor said what this one must read."""
    CALIBRATION = "calibration"
    """A calibration that exists: `calibration` names its file."""


_FILE_OF = {Method.WORKBENCH: "bench", Method.CALIBRATION: "calibration"}
"""Key that a method may have, and no other."""


class RunTable(Table):
    """One recording of the motion: its calibration intervals are fitted, its validation intervals judge."""

    experiment: Path
    """Experiment file."""
    load_kg: NotNegative
    """Mass that hung there, such as 5, 10, 15; the same load has the same number in all runs."""
    started_h: Finite | None = None
    """When it began; h on a clock that all runs share; needed for drift."""


class ContestantTable(Table):
    """A sensor with a method."""

    name: Text
    """Name."""
    sensor: Text
    """Sensor of the experiment files."""
    serial: Text | None = None
    """Its serial number; needed where several sensors took their turns under one name."""
    method: Method
    """How it is read."""
    bench: Path | None = None
    """Workbench file, for the method `workbench`."""
    calibration: Path | None = None
    """Calibration file, for the method `calibration`."""
    fitted_on: Annotated[tuple[Path, ...], Field(min_length=1)] | None = None
    """Experiment files of the runs that it is fitted on; all that suit the method if left out."""
    fitted_loads_kg: tuple[NotNegative, ...] = ()
    """Loads that a calibration file was fitted on: none of them may judge."""
    catalogue: Text | None = None
    """Name in the catalogue of sensors, for its full scale."""
    range: Annotated[int, Field(ge=1, strict=True)] | None = None
    """Which of its ranges there, from 1; needed where it has several."""
    full_scale: SixPositive | None = None
    """Full scale of fx, fy, fz, tx, ty, tz in place of the catalogue's; N, N m."""

    @model_validator(mode="after")
    def _file_belongs_to_method(self) -> ContestantTable:
        for method, key in _FILE_OF.items():
            if getattr(self, key) is not None and self.method is not method:
                raise PydanticCustomError(
                    "file_of_method", "{key} belongs to method = {method}", {"key": key, "method": f'"{method}"'}
                )
        if self.catalogue is not None and self.full_scale is not None:
            raise PydanticCustomError("full_scale_twice", "expected catalogue or full_scale, got both")
        return self


class ContestFile(Table):
    """The whole file."""

    schema_name: Literal["forcetorque/contestants/1"] = Field(alias="schema")
    """Form of the file."""
    name: Text
    """Name of the contest."""
    offset: Literal[Offset.JUDGED_MEAN, Offset.FIRST_SECOND, Offset.FITTED] = Offset.JUDGED_MEAN
    """Which offset all are judged with: the mean of each run, that of its first second, or their own."""
    phases: Annotated[int, Field(ge=10, strict=True)] = PHASES
    """Number of phases that the motion is divided into."""
    run: Annotated[tuple[RunTable, ...], Field(min_length=1)]
    """Runs."""
    contestant: Annotated[tuple[ContestantTable, ...], Field(min_length=2)]
    """Contestants."""

    @model_validator(mode="after")
    def _names_differ(self) -> ContestFile:
        for what, names in (
            ("contestant", [entry.name for entry in self.contestant]),
            ("run", [entry.experiment.as_posix() for entry in self.run]),
        ):
            (name, count), *_ = Counter(names).most_common(1)
            if count > 1:
                raise PydanticCustomError(
                    "twice", "{what}: expected each once, got {name} again", {"what": what, "name": repr(name)}
                )
        return self
