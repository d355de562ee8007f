# SPDX-License-Identifier: BSD-3-Clause
"""What a contestant makes of readings: by the calibration that its method gives, from runs that do not judge."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.analysis.calibration.calibrate import calibrate_sensor
from forcetorque.analysis.calibration.generative import generative_calibration
from forcetorque.analysis.calibration.recording_moments import recording_moments
from forcetorque.analysis.contest.entries import Contestant, ContestRun
from forcetorque.analysis.contest.file import Method
from forcetorque.analysis.runs.reading import Correction
from forcetorque.analysis.runs.sensor_run import SensorRun
from forcetorque.analysis.runs.unseen import require_unseen
from forcetorque.analysis.workbench.bench_calibration import bench_calibration
from forcetorque.calibration import Calibration
from forcetorque.errors import ExperimentError
from forcetorque.experiment import Experiment
from forcetorque.exsitu import fit_bench
from forcetorque.recording import Use

_FITTED = (Method.IN_SITU, Method.IN_SITU_WITHOUT_PRIOR, Method.KNOWN_MASSES, Method.REFERENCE_SENSOR)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Reader:
    """A contestant that can be judged."""

    entry: Contestant
    """The contestant."""
    correction: Correction
    """How it is read."""
    judged: tuple[tuple[ContestRun, SensorRun], ...]
    """Runs that judge it, with its sensor in them."""
    fitted_loads_kg: tuple[float, ...]
    """Loads that it was fitted on; kg."""


def reader_of(entry: Contestant, runs: Sequence[ContestRun], *, code_version: str, created: str) -> Reader:
    """Make a contestant ready to be judged.

    Args:
        entry: The contestant.
        runs: All runs of the contest.
        code_version: Version of this library, for the record of what is fitted.
        created: Date and time, ISO 8601, for the same.

    Returns:
        How it is read, and where it is judged.

    Raises:
        ExperimentError: If no run has its sensor, several sensors go by its name, or its method lacks what it needs.
    """
    pairs = [(run, sensor) for run in runs if (sensor := run.sensor_run(entry.sensor, entry.serial)) is not None]
    serials = sorted({sensor.sensor.serial for _, sensor in pairs})
    if len(serials) > 1:
        raise ExperimentError(f"expected serial, one of {', '.join(serials)}: they took turns as {entry.sensor!r}")
    judged = tuple((run, sensor) for run, sensor in pairs if sensor.has(Use.VALIDATION))
    if not judged:
        named = entry.sensor if entry.serial is None else f"{entry.sensor} ({entry.serial})"
        raise ExperimentError(f"no run with a validation interval has the sensor {named}")
    fitted = _fitted_runs(entry, pairs) if entry.method in _FITTED else []
    if entry.method is Method.MAKER:
        correction = Correction.without_offset(judged[0][1].sensor)
    else:
        calibration = _calibration(entry, [run for _, run in fitted], code_version=code_version, created=created)
        for _, run in judged:
            require_unseen(entry.name, calibration, run)
        correction = Correction.of(entry.name, calibration)
    loads = {run.load_kg for run, _ in fitted} | set(entry.fitted_loads_kg) | _bench_loads(entry)
    return Reader(entry=entry, correction=correction, judged=judged, fitted_loads_kg=tuple(sorted(loads)))


def _fitted_runs(
    entry: Contestant, pairs: Sequence[tuple[ContestRun, SensorRun]]
) -> list[tuple[ContestRun, SensorRun]]:
    suitable = [
        (run, sensor)
        for run, sensor in pairs
        if sensor.has(Use.CALIBRATION)
        and (entry.fitted_on is None or run.name in entry.fitted_on)
        and _suits(entry.method, run.experiment)
    ]
    if not suitable:
        raise ExperimentError(f"it needs a run with a calibration interval of {entry.sensor!r} {_NEEDED[entry.method]}")
    return suitable


def _suits(method: Method, experiment: Experiment) -> bool:
    """Whether what says the reference of an experiment is what a method goes by."""
    wrist = experiment.wrist
    if method is Method.REFERENCE_SENSOR:
        return wrist is not None and wrist.table.applied is not None
    if method is Method.KNOWN_MASSES:
        return wrist is not None and wrist.table.applied is None and wrist.are_stated
    return wrist is None


_NEEDED = {
    Method.IN_SITU: "on a robot that a URDF describes",
    Method.IN_SITU_WITHOUT_PRIOR: "on a robot that a URDF describes",
    Method.KNOWN_MASSES: "under a [load] of stated mass whose motion an accelerometer tells",
    Method.REFERENCE_SENSOR: "under a [load] whose wrench another sensor says, applied",
}


def _calibration(entry: Contestant, fitted: Sequence[SensorRun], *, code_version: str, created: str) -> Calibration:
    if entry.method is Method.CALIBRATION:
        if entry.calibration is None:
            raise ExperimentError("it needs calibration, a calibration file")
        return entry.calibration
    if entry.method is Method.WORKBENCH:
        if entry.bench is None or entry.bench.bench is None:
            raise ExperimentError("it needs bench, a workbench file with readings of known loads")
        return bench_calibration(entry.bench, fit_bench(entry.bench.bench), code_version=code_version, created=created)
    if entry.method is Method.IN_SITU_WITHOUT_PRIOR:
        if fitted[0].sensor.quantity != "raw":
            raise ExperimentError(f"it needs raw counts of {entry.sensor!r}, only wrenches were logged")
        bare = {"prior": None, "prior_source": None}
        moments = [recording.model_copy(update=bare) for recording in recording_moments(fitted)]
        return generative_calibration(moments, code_version=code_version, created=created)
    if entry.method is Method.IN_SITU and fitted[0].sensor.prior is None:
        raise ExperimentError(f"it needs a prior matrix of {entry.sensor!r}, or the method in-situ-without-prior")
    return calibrate_sensor(fitted, code_version=code_version, created=created)


def _bench_loads(entry: Contestant) -> set[float]:
    weights = None if entry.bench is None else entry.bench.loads.weights
    return set() if weights is None else set(np.unique(weights.mass_kg).tolist())
