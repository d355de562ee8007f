# SPDX-License-Identifier: BSD-3-Clause
"""From runs of a motion to the errors of a contestant, phase by phase."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from forcetorque.analysis.contest.entries import ContestRun
from forcetorque.analysis.contest.methods import Reader
from forcetorque.analysis.runs.sensor_run import SensorRun
from forcetorque.arrays import FloatArray, IntArray
from forcetorque.errors import ExperimentError
from forcetorque.evaluation import Offset, mean_offset
from forcetorque.evaluation.contest import MotionPath, Trial, trial_of
from forcetorque.experiment.inputs import stated_in
from forcetorque.recording import Interval, Use
from forcetorque.study import OFFSET_S


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
        phase: FloatArray = np.interp(samples - stamps[0], stamps - stamps[0], self.paths[name].phase)
        return phase


def _motion(run: SensorRun, interval: Interval) -> tuple[IntArray, Sequence[str], FloatArray]:
    """Instants, names and positions of what moves: joints, the direction of gravity, or the wrench that is applied."""
    experiment = run.experiment
    if experiment.wrist is not None and experiment.wrist.table.applied is not None:
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
        raise ExperimentError(f"interval {interval.label!r}: expected a motion to tell phases by, got gaps only")
    return at_ns[inside][whole], joints, positions[whole]


_GRAVITY = ("gravity x", "gravity y", "gravity z")
_WRENCH = ("applied fx", "applied fy", "applied fz", "applied tx", "applied ty", "applied tz")


def trials_of(reader: Reader, phases: Phases, offset: Offset) -> list[Trial]:
    """Judge a contestant in all its runs.

    Args:
        reader: The contestant.
        phases: Phases of the runs.
        offset: Which offset it is judged with.

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
    return trial_of(
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
