# SPDX-License-Identifier: BSD-3-Clause
"""Errors of a contestant phase by phase by the calibration of its method, and which contestants err less than others.

The ratio is that of root mean squares over all phases and loads, the one that the tables show. What a phase contributes
to it says how sure it is: contributions of neighbouring phases repeat each other, so a motion is cut into no more
stretches than they are worth. Runs with one load are pooled phase by phase first, for a wrong
matrix errs alike in each.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Annotated, Literal

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.noise.paired_comparison import (
    ALIKE,
    BLOCKS,
    CONFIDENCE,
    Conclusion,
    ErrorRatio,
    independent_segments,
    ratio_over,
)
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.calibration.generative.generative_calibration import generative_calibration
from forcetorque.calibration.reduced_recordings import recording_moments
from forcetorque.contests.contest_file import Contestant, ContestRun, Method
from forcetorque.contests.phases_and_runs_by_load import MotionPath, Trial, trial_by_phase
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.named_files import stated_in
from forcetorque.experiment.seen_and_outside_samples import require_unseen
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.validation_offset import OFFSET_S, Offset, mean_offset
from forcetorque.recording.recording import Interval, Use
from forcetorque.results.table import Row, Shown
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


FAMILY_ERROR = 0.05
"""Share of contests in which any pair may be ranked, or called no different, wrongly: shared by all pairs."""

Quantity = Literal["wrench", "force", "moment"]
QUANTITIES: tuple[Quantity, ...] = ("wrench", "force", "moment")

_LEAST = 1e-12
"""Share of the largest square below which a square counts as this share: none may divide by nothing."""


class ContestPairRow(Row):
    """Two contestants."""

    contestant: Annotated[str, Shown("contestant")]
    """One."""
    other: Annotated[str, Shown("against")]
    """The other."""
    error_of: Annotated[str, Shown("error of")]
    """`wrench` (force and moment over the loads, together), `force` or `moment`."""
    ratio: Annotated[float, Shown("ratio", digits=2)]
    """Root mean square error of the one over that of the other."""
    ratio_low: Annotated[float | None, Shown("at least", digits=2)]
    """Lower end of an interval that holds for all pairs at once with 95 %."""
    ratio_high: Annotated[float | None, Shown("at most", digits=2)]
    """Upper end."""
    segments: Annotated[int, Shown("segments")]
    """Independent stretches of the motion that the interval comes from, of all loads."""
    conclusion: Annotated[Conclusion, Shown("conclusion")]
    """What the interval says of the one."""


def mean_squares(loads: Mapping[float, Sequence[Trial]], common: BoolArray) -> FloatArray:
    """Average the squared errors of the runs with each load.

    Args:
        loads: Runs of one contestant by load.
        common: Phases that all runs of all contestants have; shape (p,).

    Returns:
        Mean squares by load and phase, q phases in common; shape (loads, q, 6); N2, N2 m2.
    """
    return np.stack([np.mean([trial.error[common] ** 2 for trial in trials], axis=0) for trials in loads.values()])


def squared_norms(squares: FloatArray, quantity: Quantity, scale: tuple[float, float]) -> FloatArray:
    """Sum squared errors over the components of a quantity.

    Args:
        squares: Squared errors by `mean_squares`; shape (loads, q, 6); N2, N2 m2.
        quantity: Of the force, of the moment, or of both over the validation loads.
        scale: Root mean square force and moment of the validation loads; N, N m.

    Returns:
        By load and phase; shape (loads, q); N2, N2 m2, or 1.
    """
    force, moment = squares[..., :3].sum(axis=-1), squares[..., 3:].sum(axis=-1)
    wrench: FloatArray = force / scale[0] ** 2 + moment / scale[1] ** 2
    return {"wrench": wrench, "force": force, "moment": moment}[quantity]


def compared_pairs(contestants: Mapping[str, FloatArray], *, scale: tuple[float, float]) -> list[ContestPairRow]:
    """Compare every contestant with every other.

    The intervals of all pairs of one quantity hold together with 95 % (Bonferroni), so that of contests without a
    difference at most 5 % rank any pair, and of contests without equals at most 5 % call any pair equal.

    Args:
        contestants: Squared errors by `mean_squares` and by name, at least two, at the same phases and loads.
        scale: Root mean square force and moment of the validation loads; N, N m.

    Returns:
        Every pair for every quantity.
    """
    confidence = 1.0 - FAMILY_ERROR / math.comb(len(contestants), 2)
    pairs = []
    for quantity in QUANTITIES:
        for one, other in combinations(contestants, 2):
            ratio = _ratio(
                squared_norms(contestants[one], quantity, scale),
                squared_norms(contestants[other], quantity, scale),
                confidence,
            )
            known = math.isfinite(ratio.high)
            pairs.append(
                ContestPairRow(
                    contestant=one,
                    other=other,
                    error_of=quantity,
                    ratio=ratio.ratio,
                    ratio_low=ratio.low if known else None,
                    ratio_high=ratio.high if known else None,
                    segments=ratio.segments,
                    # a certain difference too small for any application ranks no pair
                    conclusion=(
                        "no difference" if ALIKE[0] <= ratio.low and ratio.high <= ALIKE[1] else ratio.conclusion
                    ),
                )
            )
    return pairs


def _ratio(first: FloatArray, second: FloatArray, confidence: float) -> ErrorRatio:
    least = _LEAST * max(float(first.max()), float(second.max()))
    if least == 0.0 or np.array_equal(first, second):
        return ErrorRatio(ratio=1.0, low=1.0, high=1.0, segments=len(first), conclusion="no difference")
    one, other = np.maximum(first, least), np.maximum(second, least)
    pooled = 0.5 * math.log(one.mean() / other.mean())
    # derivative of the log ratio of root mean squares by what a phase adds to either; its mean is zero
    return _over(pooled + 0.5 * (one / one.mean() - other / other.mean()), pooled, confidence)


def _over(contributions: FloatArray, pooled: float, confidence: float) -> ErrorRatio:
    """Ratio of what phases contribute; shape (loads, q)."""
    stretches, errors = [], []
    for row in contributions:
        count, error = independent_segments(_averaged(row, BLOCKS))
        stretches.append(_averaged(row, count))
        errors.append(error)
    return ratio_over(stretches, errors, pooled=pooled, confidence=confidence)


def _averaged(row: FloatArray, count: int) -> FloatArray:
    return np.array([piece.mean() for piece in np.array_split(row, min(count, len(row)))])


def rms_intervals(squares: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give root mean squares over phases with 95 % intervals.

    Args:
        squares: Squared errors at the phases of one load; shape (q, 6).

    Returns:
        Root mean squares, lower and upper ends; shape (6,) each; infinite where there are too few segments.
    """
    rows = []
    for column in squares.T:
        mean = max(float(column.mean()), _LEAST)
        log = 0.5 * math.log(mean)
        ratio = _over(log + 0.5 * (column[None] / mean - 1.0), log, CONFIDENCE)
        rows.append((math.sqrt(mean), ratio.low, ratio.high))
    rms, low, high = np.array(rows).T
    return rms, low, high


def ranks_and_winner(
    names: Sequence[str], pairs: Sequence[ContestPairRow]
) -> tuple[dict[str, tuple[int, int, int]], str | None]:
    """Rank contestants.

    Args:
        names: The contestants.
        pairs: All pairs.

    Returns:
        Ranks from 1 by name, by wrench, force and moment: one more than the number of contestants with significantly
        smaller errors, so that several may share one; and the contestant whose wrench error is significantly smaller
        than that of every other, None without such a one.
    """
    ranked = [pair for pair in pairs if pair.conclusion in ("better", "worse")]
    lost = [(pair.error_of, pair.other if pair.conclusion == "better" else pair.contestant) for pair in ranked]
    won = [
        pair.contestant if pair.conclusion == "better" else pair.other for pair in ranked if pair.error_of == "wrench"
    ]
    wrench, force, moment = ({name: 1 + lost.count((quantity, name)) for name in names} for quantity in QUANTITIES)
    return (
        {name: (wrench[name], force[name], moment[name]) for name in names},
        next((name for name in names if won.count(name) == len(names) - 1), None),
    )
