# SPDX-License-Identifier: BSD-3-Clause
"""The file of a contest: sensors, methods, and runs of one motion."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.toml_file import Finite, NotNegative, Table, Text, read_toml
from forcetorque.experiment.calibration.artefact import Calibration, read_calibration
from forcetorque.experiment.core_tables import FullScale
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.input_files import stated_in
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.validation_offset import Offset
from forcetorque.sensor.catalogue import CatalogueSensor, catalogue_with, find_sensor
from forcetorque.workbench.recording import BenchRecording, read_bench

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
    """One recording of the motion: its calibration intervals are fitted, its validation intervals are evaluated."""

    experiment: Path
    """Experiment file."""
    load_kg: NotNegative
    """Mass of the carried load, such as 5, 10, 15; the same load has the same number in all runs."""
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
    """Loads that a calibration file was fitted on: they are not evaluated."""
    catalogue: Text | None = None
    """Name in the catalogue of sensors, of the library or of `catalogue_file`, for its full scale."""
    range: Annotated[int, Field(ge=1, strict=True)] | None = None
    """Which of its ranges there, from 1; needed where it has several."""
    full_scale: FullScale | None = None
    """Full scale of fx, fy, fz, tx, ty, tz in place of the catalogue's; N, N m."""

    @model_validator(mode="after")
    def _file_belongs_to_method(self) -> ContestantTable:
        for method, key in _FILE_OF.items():
            if getattr(self, key) is not None and self.method is not method:
                raise ValueError(f'{key} belongs to method = "{method}"')
        if self.catalogue is not None and self.full_scale is not None:
            raise ValueError("expected catalogue or full_scale, got both")
        return self


class ContestFile(Table):
    """The whole file."""

    schema_name: Literal["forcetorque/contestants/1"] = Field(alias="schema")
    """Form of the file."""
    name: Text
    """Name of the contest."""
    offset: Literal[Offset.JUDGED_MEAN, Offset.FIRST_SECOND, Offset.FITTED] = Offset.JUDGED_MEAN
    """Which offset all are evaluated with: the mean of each run, that of its first second, or their own."""
    phases: Annotated[int, Field(ge=10, strict=True)] = PHASES
    """Number of phases that the motion is divided into."""
    catalogue_file: Path | None = None
    """Catalogue of further sensors, as `forcetorque bench sensor` takes it."""
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
                raise ValueError(f"{what}: expected each once, got {name!r} again")
        return self


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ContestRun:
    """One recording of the motion."""

    name: str
    """Name, unique in the contest."""
    experiment: Experiment
    """The recording; calibration intervals are fitted, validation intervals are evaluated."""
    load_kg: float
    """Mass of the carried load; kg."""
    started_h: float = np.nan
    """When it began; h on a clock that all runs share; NaN where it is not stated."""
    _known: dict[str, SensorRun] = field(default_factory=dict, repr=False)

    def sensor_run(self, sensor: str, serial: str | None) -> SensorRun | None:
        """Give one of its sensors.

        Args:
            sensor: Name of the sensor.
            serial: Its serial number; any if None.

        Returns:
            The sensor; None where it has none of that name and number.
        """
        if all(one.name != sensor for one in self.experiment.sensors):
            return None
        # contestants with one sensor share what is computed of it
        run = self._known.setdefault(sensor, SensorRun(self.experiment, sensor))
        return run if serial in (None, run.sensor.serial) else None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Contestant:
    """A sensor with a method."""

    name: str
    """Name, unique in the contest."""
    sensor: str
    """Sensor of the experiments."""
    method: Method
    """How it is read."""
    serial: str | None = None
    """Its serial number, where several sensors have its name."""
    bench: BenchRecording | None = None
    """What it read on a workbench."""
    calibration: Calibration | None = None
    """A calibration that exists."""
    fitted_on: tuple[str, ...] | None = None
    """Names of the runs that it is fitted on; all that suit the method if None."""
    fitted_loads_kg: tuple[float, ...] = ()
    """Loads that the calibration was fitted on; kg."""
    full_scale: FloatArray | None = None
    """Full scale; shape (6,); N, N m."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Entries:
    """All that meet, and the runs they meet on."""

    name: str
    """Name of the contest."""
    runs: tuple[ContestRun, ...]
    """Runs of the motion."""
    contestants: tuple[Contestant, ...]
    """Contestants, at least two."""
    offset: Offset = Offset.JUDGED_MEAN
    """Which offset all are evaluated with."""
    phases: int = PHASES
    """Number of phases."""


def read_entries(path: Path | str) -> Entries:
    """Read the file of a contest and all that it points to.

    Args:
        path: TOML file; paths in it are relative to it.

    Returns:
        The entries.

    Raises:
        ExperimentError: If a contestant is fitted on a run that is not in the file.
    """
    stated, folder = read_toml(path, ContestFile, what="a file of a contest"), Path(path).parent
    with stated_in(str(path)):
        runs = tuple(
            ContestRun(
                name=run.experiment.as_posix(),
                experiment=load_experiment(folder / run.experiment),
                load_kg=run.load_kg,
                started_h=np.nan if run.started_h is None else run.started_h,
            )
            for run in stated.run
        )
        known = {run.name for run in runs}
        for entry in stated.contestant:
            for name in entry.fitted_on or ():
                if name.as_posix() not in known:
                    raise ExperimentError(
                        f"contestant {entry.name!r}: fitted_on: expected the experiment of a [[run]], got {name}; "
                        f"known: {', '.join(sorted(known))}"
                    )
        catalogue = catalogue_with(None if stated.catalogue_file is None else folder / stated.catalogue_file)
        contestants = tuple(_contestant(entry, folder, catalogue) for entry in stated.contestant)
    return Entries(name=stated.name, runs=runs, contestants=contestants, offset=stated.offset, phases=stated.phases)


def _contestant(entry: ContestantTable, folder: Path, catalogue: Sequence[CatalogueSensor]) -> Contestant:
    return Contestant(
        name=entry.name,
        sensor=entry.sensor,
        serial=entry.serial,
        method=entry.method,
        bench=None if entry.bench is None else read_bench(folder / entry.bench),
        calibration=None if entry.calibration is None else read_calibration(folder / entry.calibration),
        fitted_on=None if entry.fitted_on is None else tuple(path.as_posix() for path in entry.fitted_on),
        fitted_loads_kg=entry.fitted_loads_kg,
        full_scale=_full_scale(entry, catalogue),
    )


def _full_scale(entry: ContestantTable, catalogue: Sequence[CatalogueSensor]) -> FloatArray | None:
    if entry.catalogue is None:
        return None if entry.full_scale is None else np.array(entry.full_scale)
    sensor = find_sensor(entry.catalogue, catalogue)
    ranges = sensor.calibrations
    if not ranges or (len(ranges) > 1 and entry.range is None) or (entry.range or 1) > len(ranges):
        raise ExperimentError(
            f"contestant {entry.name!r}: expected range, one of the {len(ranges)} that the catalogue has of "
            f"{sensor.name}, from 1, got {entry.range}; or state full_scale"
        )
    return ranges[(entry.range or 1) - 1].range.components()
