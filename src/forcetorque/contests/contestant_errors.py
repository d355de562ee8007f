# SPDX-License-Identifier: BSD-3-Clause
"""What a contestant makes of measurements by the calibration of its method, and its errors phase by phase."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import ExperimentError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.calibration.generative.generative_calibration import generative_calibration
from forcetorque.calibration.reduced_recordings import recording_moments
from forcetorque.contests.contest_file import Contestant, ContestRun, Method
from forcetorque.contests.phases import MotionPath, Trial, trial_by_phase
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.named_files import stated_in
from forcetorque.experiment.seen_and_outside_samples import require_unseen
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.validation_offset import OFFSET_S, Offset, mean_offset
from forcetorque.recording.recording import Interval, Use
from forcetorque.workbench.matrix_fit import fit_bench
from forcetorque.workbench.sensor_fit import bench_calibration

_FITTED = (Method.IN_SITU, Method.IN_SITU_WITHOUT_PRIOR, Method.KNOWN_MASSES, Method.REFERENCE_SENSOR)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Reader:
    """A contestant that can be evaluated."""

    entry: Contestant
    """The contestant."""
    correction: Correction
    """How it is read."""
    judged: tuple[tuple[ContestRun, SensorRun], ...]
    """Validation runs, with its sensor in them."""
    fitted_loads_kg: tuple[float, ...]
    """Loads that it was fitted on; kg."""


def contestant_reader(entry: Contestant, runs: Sequence[ContestRun], *, code_version: str, created: str) -> Reader:
    """Prepare a contestant for evaluation.

    Args:
        entry: The contestant.
        runs: All runs of the contest.
        code_version: Version of this library, for the record of what is fitted.
        created: Date and time, ISO 8601, for the same.

    Returns:
        How its samples are read, and its validation runs.

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
    loads = experiment.loads
    wrist = loads if loads is not None and loads.in_place_of_robot else None
    if method is Method.REFERENCE_SENSOR:
        return wrist is not None and wrist.applied is not None
    if method is Method.KNOWN_MASSES:
        return wrist is not None and wrist.applied is None and wrist.are_stated
    return wrist is None


_NEEDED = {
    Method.IN_SITU: "on a robot that a URDF describes",
    Method.IN_SITU_WITHOUT_PRIOR: "on a robot that a URDF describes",
    Method.KNOWN_MASSES: "under a [load] of stated mass whose motion an accelerometer measures",
    Method.REFERENCE_SENSOR: "under a [load] whose wrench another sensor measures, applied",
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


class Phases:
    """Paths of the runs, each followed once however many sensors were stacked in it."""

    def __init__(self, count: int) -> None:
        """Divide a motion.

        Args:
            count: Number of phases.
        """
        self.count = count
        self.paths: dict[str, MotionPath] = {}
        """Path of every run, interval and sensor that was followed, by a name for messages."""
        self._stamps: dict[str, IntArray] = {}

    def of(self, contest_run: ContestRun, run: SensorRun, interval: Interval) -> FloatArray:
        """Give the phases of the samples of a sensor.

        Args:
            contest_run: The run.
            run: The sensor in it.
            interval: A validation interval.

        Returns:
            Phases from 0 to 1; shape (n,).
        """
        name = f"{contest_run.name}, {interval.label!r}, {run.sensor.name}"
        if name not in self.paths:
            self._stamps[name], names, positions = _motion(run, interval)
            with stated_in(contest_run.name):
                self.paths[name] = MotionPath.of(names, positions)
        stamps = self._stamps[name]
        samples = run.interval_samples(interval).samples.stamp_ns
        return np.interp(samples - stamps[0], stamps - stamps[0], self.paths[name].phase)


def _motion(run: SensorRun, interval: Interval) -> tuple[IntArray, Sequence[str], FloatArray]:
    """Instants, names and positions of what moves: joints, the direction of gravity, or the wrench that is applied."""
    experiment = run.experiment
    if experiment.loads is not None and experiment.loads.applied is not None:
        samples = run.interval_samples(interval).samples
        force, moment = samples.reference[:, :3], samples.reference[:, 3:]
        sizes = [max(float(np.sqrt((part**2).mean())), 1e-9) for part in (force, moment)]
        return samples.stamp_ns, _WRENCH, np.hstack([force / sizes[0], moment / sizes[1]])
    holders = experiment.recording.joint_signals("position")
    joints = [joint for joint in experiment.model.joints if joint in holders]
    motion, root = run.motion(interval, joints)
    at_ns = run.instants(interval).at_ns
    inside = interval.holds(at_ns)
    if joints:
        positions = np.stack([motion.position[inside, motion.names.index(joint)] for joint in joints], axis=1)
    else:
        up = np.broadcast_to(root.proper_acceleration, (len(at_ns), 3))[inside]
        joints, positions = list(_GRAVITY), up / np.linalg.norm(up, axis=1, keepdims=True)
    whole = np.isfinite(positions).all(axis=1)
    if not whole.any():
        raise ExperimentError(f"interval {interval.label!r}: expected a motion that defines phases, got gaps only")
    return at_ns[inside][whole], joints, positions[whole]


_GRAVITY = ("gravity x", "gravity y", "gravity z")
_WRENCH = ("applied fx", "applied fy", "applied fz", "applied tx", "applied ty", "applied tz")


def contestant_trials(reader: Reader, phases: Phases, offset: Offset) -> list[Trial]:
    """Compute the errors of a contestant in all its runs.

    Args:
        reader: The contestant.
        phases: Phases of the runs.
        offset: Which offset it is evaluated with.

    Returns:
        Its runs, one for every validation interval.
    """
    return [
        _trial(reader, run, sensor, interval, phases, offset)
        for run, sensor in reader.judged
        for interval in sensor.intervals(Use.VALIDATION)
    ]


def _trial(
    reader: Reader, run: ContestRun, sensor: SensorRun, interval: Interval, phases: Phases, offset: Offset
) -> Trial:
    correction = reader.correction
    samples = sensor.interval_samples(interval, variables=correction.variables)
    stamps, reference = samples.samples.stamp_ns, samples.samples.reference
    error = samples.readings.wrench(correction.bare) - reference
    phase = np.interp(stamps, sensor.interval_samples(interval).samples.stamp_ns, phases.of(run, sensor, interval))
    kept, removed = np.ones(len(stamps), dtype=np.bool_), None
    if offset is Offset.FITTED:
        names = sensor.experiment.session_names(interval.label)
        removed = -correction.in_session(names).model.offset
    elif offset is Offset.FIRST_SECOND:
        kept = stamps >= stamps[0] + round(OFFSET_S * 1e9)
        removed = -mean_offset(-error[~kept])
    return trial_by_phase(
        phase[kept],
        error[kept],
        reference[kept],
        removed,
        phases=phases.count,
        load_kg=run.load_kg,
        time_s=3600.0 * run.started_h + 0.5e-9 * float(stamps[-1] - sensor.experiment.recording.start_ns),
        temperature_degC=_temperature(sensor, interval),
    )


def _temperature(run: SensorRun, interval: Interval) -> float:
    thermometers = [v.linear.name for v in run.sensor.variables if v.linear.unit == "degC"]
    if len(thermometers) != 1:
        return np.nan
    return float(run.interval_samples(interval, variables=thermometers).samples.variables.mean())
