# SPDX-License-Identifier: BSD-3-Clause
"""Who meets in a contest and on what, from a file or from Python."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from forcetorque.analysis.contest.file import PHASES, ContestantTable, ContestFile, Method
from forcetorque.analysis.runs.sensor_run import SensorRun
from forcetorque.analysis.workbench.bench_recording import BenchRecording, read_bench
from forcetorque.arrays import FloatArray
from forcetorque.calibration import Calibration, read_calibration
from forcetorque.errors import ExperimentError
from forcetorque.evaluation import Offset
from forcetorque.experiment import Experiment, load_experiment
from forcetorque.experiment.inputs import stated_in
from forcetorque.sensor.catalogue import find_sensor
from forcetorque.toml_table import read_toml


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ContestRun:
    """One recording of the motion."""

    name: str
    """Name, unique in the contest."""
    experiment: Experiment
    """The recording; calibration intervals are fitted, validation intervals judge."""
    load_kg: float
    """Mass that hung there; kg."""
    started_h: float = np.nan
    """When it began; h on a clock that all runs share; NaN where nobody says."""
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
    """Which offset all are judged with."""
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
        contestants = tuple(_contestant(entry, folder) for entry in stated.contestant)
    return Entries(name=stated.name, runs=runs, contestants=contestants, offset=stated.offset, phases=stated.phases)


def _contestant(entry: ContestantTable, folder: Path) -> Contestant:
    return Contestant(
        name=entry.name,
        sensor=entry.sensor,
        serial=entry.serial,
        method=entry.method,
        bench=None if entry.bench is None else read_bench(folder / entry.bench),
        calibration=None if entry.calibration is None else read_calibration(folder / entry.calibration),
        fitted_on=None if entry.fitted_on is None else tuple(path.as_posix() for path in entry.fitted_on),
        fitted_loads_kg=entry.fitted_loads_kg,
        full_scale=_full_scale(entry),
    )


def _full_scale(entry: ContestantTable) -> FloatArray | None:
    if entry.catalogue is None:
        return None if entry.full_scale is None else np.array(entry.full_scale)
    sensor = find_sensor(entry.catalogue)
    ranges = sensor.calibrations
    if not ranges or (len(ranges) > 1 and entry.range is None) or (entry.range or 1) > len(ranges):
        raise ExperimentError(
            f"contestant {entry.name!r}: expected range, one of the {len(ranges)} that the catalogue has of "
            f"{sensor.name}, from 1, got {entry.range}; or state full_scale"
        )
    axes = ranges[(entry.range or 1) - 1].range
    return np.array([axes.fxy, axes.fxy, axes.fz, axes.txy, axes.txy, axes.tz])
