# SPDX-License-Identifier: BSD-3-Clause
"""The fault of the experiment file, URDF or log that best explains why a sensor disagrees with the robot model.

Nothing is compared where the expected wrench does not move. A fault counts if it explains the measurements far better
than the errors of a mounted sensor and what the model usually has wrong; faults that explain them nearly as well are
named with it, since the log does not separate them.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Final

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, IntArray, array
from forcetorque.base.errors import ExperimentError, FitError, ForceTorqueError
from forcetorque.base.noise.means import WINDOW_ROUNDING
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.experiment.calibration.moments import Moments
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.sensor_samples import IntervalSamples
from forcetorque.inspection.plausibility.evidence import Evidence, Fit
from forcetorque.inspection.plausibility.hypotheses import Changes, Explanation, Robot, explanations, senses
from forcetorque.inspection.plausibility.reversed_sense_and_gain import require_moving_load
from forcetorque.recording.recording import Finding, Interval, Support, Use
from forcetorque.robot.mechanics.estimate import Evaluator, estimate
from forcetorque.robot.mechanics.question import Question, required_joints_of
from forcetorque.robot.mechanics.samples import robot_motion_at
from forcetorque.robot.model import JointType
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree

_WINDOW_S, _WINDOWS = 0.1, 600
"""Length of the means that are compared, and how many of them at most, evenly over the log."""
_FEWEST = 20
"""Fewest means that are compared."""
_LONGEST_DELAY_S, _EDGE_INTERVAL_S = 0.5, 5.0
"""Largest delay that is looked for, and length of an interval whose ends are left out for it."""
_GRID_S = 0.01
"""Step at which the motion of joints is sampled for delays of their streams; s."""
_ROUNDS = 3
"""How often weights and deviation follow the best explanation."""
GAIN: Final = 12.0
"""Logarithm of the ratio of likelihoods from which on a fault explains measurements far better than none: a heuristic,
chosen on simulated logs without faults."""
_WORTH_A_REFIT = GAIN / 2.0
"""Gain of the best explanation below which none is fitted again: no fault comes near to what counts."""
_REFITTED = 6
"""How many of the best explanations are fitted again with the weights that they give."""
_PARAMETER = 2.0
"""Evidence that a fitted parameter costs."""
_LEAST_EXPLAINED = 0.5
"""Share of the residual of force or of moment that a fault explains at least: less has other causes too."""
_MOST_WORSE = 1.2
"""Factor by which a fault may increase the residual of force or moment."""
_STABILITY: Final = 1e-3
"""Drift of a good sensor in a log, relative to its full scale."""
_AS_GOOD = 4.0
"""Difference in evidence below which two faults explain measurements alike."""
_LEAST: Final = {"mass": 0.1, "mount": 0.035, "gravity": 0.035, "joint_offset": 0.026, "delay": 0.015}
"""Parameters below which a fault is within what robots and mounts have: share, rad, s."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Comparison(ArrayRecord):
    """Measured and expected wrenches of a sensor, as means over short windows."""

    run: SensorRun
    """The sensor."""
    parts: tuple[IntervalSamples, ...]
    """Samples of the intervals."""
    measured: FloatArray = field(metadata=array("n", 6))
    """Measured wrenches, offset not removed; shape (n, 6); N, N m."""
    expected: FloatArray = field(metadata=array("n", 6))
    """Expected wrenches by the model as it is; shape (n, 6); N, N m."""
    at_ns: IntArray = field(metadata=array("n", dtype="int"))
    """Middle of each window; shape (n,); ns."""
    part_of: IntArray = field(metadata=array("n", dtype="int"))
    """Index in `parts` of the interval that each is of; shape (n,)."""
    is_timed: bool
    """Whether delays can be looked for."""


def compared(run: SensorRun, correction: Correction, *, whole: IntervalSamples | None = None) -> Comparison | None:
    """Compare a sensor with the robot model over the intervals in which only the support touches.

    Args:
        run: The sensor.
        correction: How it is read.
        whole: Samples of the whole log, not smoothed and with the variables of the correction, if all intervals have
            one support; evaluated interval by interval if None.

    Returns:
        Means; None where there are too few.

    Raises:
        ExperimentError: If it is unknown in every interval what the sensor must read.
        RecordingError: If a needed joint is in no stream, or streams do not overlap.
    """
    supported = [
        one for one in run.experiment.recording.intervals if one.support is not None and one.use is not Use.IGNORE
    ]
    if not supported:
        return None
    known = run.known(supported)
    alone = tuple(one for one in known if not run.possibly_touched(one)) or known
    if whole is None:
        parts = tuple(run.interval_samples(one, variables=correction.variables, smoothed=False) for one in alone)
    else:
        parts = tuple(part for one in alone if len((part := _within(whole, one)).samples))
    total = sum(len(part.samples) for part in parts)
    measured, expected, at_ns, part_of = [], [], [], []
    timed = True
    for number, part in enumerate(parts):
        stamps = part.samples.stamp_ns
        starts, ends = _windows(stamps)
        timed &= len(starts) < len(stamps)
        most = max(_FEWEST, round(_WINDOWS * len(stamps) / total))
        chosen = np.unique(np.linspace(0, len(starts) - 1, min(most, len(starts))).round().astype(np.int64))
        wrench = part.readings.wrench(correction)
        sums = np.cumsum(np.vstack([np.zeros(12), np.hstack([wrench, part.samples.reference])]), axis=0)
        mean = (sums[ends[chosen]] - sums[starts[chosen]]) / (ends - starts)[chosen, None]
        measured.append(mean[:, :6])
        expected.append(mean[:, 6:])
        at_ns.append((stamps[starts[chosen]] + stamps[ends[chosen] - 1]) // 2)
        part_of.append(np.full(len(chosen), number))
    if sum(map(len, at_ns)) < _FEWEST:
        return None
    return Comparison(
        run=run,
        parts=parts,
        measured=np.concatenate(measured),
        expected=np.concatenate(expected),
        at_ns=np.concatenate(at_ns),
        part_of=np.concatenate(part_of),
        is_timed=timed,
    )


def _within(whole: IntervalSamples, interval: Interval) -> IntervalSamples:
    """Samples of an interval among those of the whole log."""
    samples, rows = whole.samples, interval.holds(whole.samples.stamp_ns)
    own = replace(
        samples,
        label=interval.label,
        stamp_ns=samples.stamp_ns[rows],
        reading=replace(samples.reading, values=samples.reading.values[rows]),
        reference=samples.reference[rows],
        flattening=samples.flattening[rows],
        variables=samples.variables[rows],
    )
    return IntervalSamples(interval=interval, samples=own, readings=whole.readings.at(rows))


def _windows(stamps: IntArray) -> tuple[IntArray, IntArray]:
    """First index, and first index after, of windows; those at the ends of a long interval are left out."""
    seconds = (stamps - stamps[0]) * 1e-9
    number = np.floor(seconds / _WINDOW_S + WINDOW_ROUNDING)
    starts = np.flatnonzero(np.diff(number, prepend=-1.0))
    ends = np.append(starts[1:], len(stamps))
    if seconds[-1] > _EDGE_INTERVAL_S:
        inside = (seconds[starts] > _LONGEST_DELAY_S) & (seconds[ends - 1] < seconds[-1] - _LONGEST_DELAY_S)
        starts, ends = starts[inside], ends[inside]
    return starts, ends


def robot_of(comparison: Comparison) -> Robot | None:
    """Prepare what the robot model expects where something of it is changed.

    Args:
        comparison: The compared samples.

    Returns:
        The robot; None where known wrenches or a load stand in for it.
    """
    run, loads = comparison.run, comparison.run.experiment.loads
    if loads is not None and (loads.applied is not None or loads.in_place_of_robot):
        return None
    limbs = _limbs(comparison)
    model, holders = run.experiment.model, run.experiment.recording.joint_signals("position")
    needed = tuple(dict.fromkeys(joint for limb in limbs for joint in limb.joints.names if joint in holders))
    turning = tuple(joint for joint in needed if model.joints[joint].type is not JointType.PRISMATIC)
    directions = [limb.down for limb in limbs]
    first = directions[0]
    same = first is not None and all(one is not None and np.allclose(one, first) for one in directions)
    unchanged = _of_limbs(comparison, limbs, 1, lambda limb: limb.expected([limb.joints]))[0]

    def relative(changed: FloatArray) -> FloatArray:
        """Means stay what they are; changes are those in the middle of the windows."""
        return comparison.expected + np.nan_to_num(changed - unchanged)

    def with_joints(changes: Sequence[Changes]) -> FloatArray:
        return relative(_of_limbs(comparison, limbs, len(changes), lambda limb: limb.with_joints(changes)))

    def with_gravity(directions: FloatArray) -> FloatArray:
        return relative(_of_limbs(comparison, limbs, len(directions), lambda limb: limb.with_gravity(directions)))

    def with_delay(stream: str | None, delays_s: Sequence[float]) -> FloatArray:
        if stream is None:
            on_time = _shift(comparison, 0.0)
            return np.stack([comparison.expected + _shift(comparison, delay) - on_time for delay in delays_s])
        return relative(_of_limbs(comparison, limbs, len(delays_s), lambda limb: limb.with_delays(stream, delays_s)))

    periods = [
        float(np.median(np.diff(part.samples.stamp_ns))) * 1e-9 for part in comparison.parts if len(part.samples) > 1
    ]
    return Robot(
        joints=turning,
        with_joints=with_joints,
        gravity_direction=first if same else None,
        with_gravity=with_gravity,
        joint_streams=tuple(dict.fromkeys(holders[joint][0].name for joint in needed)),
        with_delay=with_delay,
        longest_delay_s=_LONGEST_DELAY_S if comparison.is_timed else 0.0,
        shortest_delay_s=2.0 * max(periods, default=0.0),
    )


def _shift(comparison: Comparison, delay_s: float) -> FloatArray:
    """Expected wrenches a delay before the middle of each window; shape (n, 6)."""
    shifted = np.empty_like(comparison.expected)
    for number, part in enumerate(comparison.parts):
        own, stamps = comparison.part_of == number, part.samples.stamp_ns
        seconds = (stamps - stamps[0]) * 1e-9
        at_s = (comparison.at_ns[own] - stamps[0]) * 1e-9 - delay_s
        shifted[own] = np.column_stack([np.interp(at_s, seconds, column) for column in part.samples.reference.T])
    return shifted


@dataclass(frozen=True, kw_only=True, eq=False)
class _Limb:
    """What the model expects of the sensor at the compared instants of intervals with one support."""

    run: SensorRun
    interval: Interval
    rows: IntArray
    """Numbers of the compared samples; shape (m,)."""
    at_ns: IntArray
    question: Question
    joints: JointMotion
    root: RootMotion

    @classmethod
    def of(cls, run: SensorRun, interval: Interval, rows: IntArray, at_ns: IntArray) -> _Limb:
        support = interval.support
        if support is None:
            raise ExperimentError(f"interval {interval.label!r}: expected a support frame, got none")
        tree = build_tree(run.experiment.model_on(support), support.frame)
        question = Question(tree=tree, expected=(run.sensor.name,), equations=())
        joints, root = _motion(run, interval, required_joints_of(question), at_ns)
        return cls(run=run, interval=interval, rows=rows, at_ns=at_ns, question=question, joints=joints, root=root)

    @property
    def down(self) -> FloatArray | None:
        support = self.interval.support
        return support.gravity_direction if isinstance(support, Support) else None

    def expected(self, motions: Sequence[JointMotion], root: RootMotion | None = None) -> FloatArray:
        """Expected wrenches by each of k motions; shape (k, m, 6); the root moves as logged, or in k m samples."""
        k, m = len(motions), len(self.at_ns)
        if root is None:
            root = self.root.samples(np.tile(np.arange(m), k))
        joints = JointMotion(
            names=self.joints.names,
            position=np.concatenate([one.position for one in motions]),
            velocity=np.concatenate([one.velocity for one in motions]),
            acceleration=np.concatenate([one.acceleration for one in motions]),
        )
        # the compiled evaluator takes longer to load
        estimates = estimate(self.question, joints, root, evaluator=Evaluator.READABLE)
        return np.reshape(estimates.expected_of(self.run.sensor.name), (k, m, 6))

    def with_joints(self, changes: Sequence[Changes]) -> FloatArray:
        return self.expected([self._changed(change) for change in changes])

    def with_gravity(self, directions: FloatArray) -> FloatArray:
        upwards = -self.run.experiment.processing.gravity * np.repeat(directions, len(self.at_ns), axis=0)
        none = np.zeros_like(upwards)
        root = RootMotion(proper_acceleration=upwards, angular_velocity=none, angular_acceleration=none)
        return self.expected([self.joints] * len(directions), root)

    def _changed(self, change: Changes) -> JointMotion:
        factor, shift = np.array([change.get(name, (1.0, 0.0)) for name in self.joints.names]).T
        return replace(
            self.joints,
            position=factor * self.joints.position + shift,
            velocity=factor * self.joints.velocity,
            acceleration=factor * self.joints.acceleration,
        )

    def with_delays(self, stream: str, delays_s: Sequence[float]) -> FloatArray:
        """What is expected if the stamps of a stream of joints are late, so that later samples hold."""
        holders = self.run.experiment.recording.joint_signals("position")
        late = [k for k, name in enumerate(self.joints.names) if name in holders and holders[name][0].name == stream]
        return self.expected([self._delayed(late, delay) for delay in delays_s])

    def _delayed(self, late: list[int], delay_s: float) -> JointMotion:
        grid_ns, motion = self._resampled
        at_s = (self.at_ns - grid_ns[0]) * 1e-9 + delay_s
        columns = {}
        for name in ("position", "velocity", "acceleration"):
            values, delayed = getattr(motion, name), np.array(getattr(self.joints, name))
            for k in late:
                delayed[:, k] = np.interp(at_s, (grid_ns - grid_ns[0]) * 1e-9, values[:, k])
            columns[name] = delayed
        return JointMotion(names=self.joints.names, **columns)

    @cached_property
    def _resampled(self) -> tuple[IntArray, JointMotion]:
        """The motion of the joints on a grid, from which delayed ones are interpolated."""
        reach = round(_LONGEST_DELAY_S * 1e9)
        grid_ns = np.arange(self.at_ns.min() - reach, self.at_ns.max() + reach, round(_GRID_S * 1e9))
        return grid_ns, _motion(self.run, self.interval, self.joints.names, grid_ns)[0]


def _limbs(comparison: Comparison) -> tuple[_Limb, ...]:
    """One per support, since every evaluation of the robot model costs more than its samples."""
    numbers: dict[int, list[int]] = {}
    for number, part in enumerate(comparison.parts):
        numbers.setdefault(id(part.interval.support), []).append(number)
    limbs = []
    for own in numbers.values():
        rows = np.flatnonzero(np.isin(comparison.part_of, own))
        limbs.append(_Limb.of(comparison.run, comparison.parts[own[0]].interval, rows, comparison.at_ns[rows]))
    return tuple(limbs)


def _of_limbs(
    comparison: Comparison, limbs: Sequence[_Limb], count: int, expected_of: Callable[[_Limb], FloatArray]
) -> FloatArray:
    """Expected wrenches of all limbs in the order of the compared samples; shape (count, n, 6)."""
    expected = np.empty((count, len(comparison.at_ns), 6))
    for limb in limbs:
        expected[:, limb.rows] = expected_of(limb)
    return expected


def _motion(
    run: SensorRun, interval: Interval, joints: Collection[str], at_ns: IntArray
) -> tuple[JointMotion, RootMotion]:
    experiment = run.experiment
    if interval.support is None:
        raise ExperimentError(f"interval {interval.label!r}: expected a support frame, got none")
    return robot_motion_at(
        experiment.recording,
        experiment.model,
        interval.support,
        tuple(joints),
        run.stream,
        at_ns,
        processing=experiment.processing,
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Diagnosis:
    """What explains the measurements of a sensor."""

    nothing: Fit
    """How well the model as it is does."""
    evidence: Evidence
    """The measurements, with the weights of the best explanation."""
    faults: tuple[Explanation, ...]
    """Faults that explain them far better, alike, the best first; none where nothing is wrong."""


def diagnosed(comparison: Comparison, *, only_sense: bool = False) -> Diagnosis | None:
    """Find the faults that best explain the measurements of a sensor.

    Args:
        comparison: Measured and expected wrenches.
        only_sense: Whether only reversed senses are looked for, which takes no evaluation of the robot model.

    Returns:
        The diagnosis; None where the expected wrench does not move.
    """
    sensor, expected = comparison.run.sensor, comparison.expected
    try:
        require_moving_load(Moments.of(comparison.measured, expected))
    except FitError:
        return None
    seconds = (comparison.at_ns - comparison.at_ns[0]) * 1e-9
    prior = None if sensor.prior_source == "identity" else sensor.prior
    evidence = Evidence.of(comparison.measured, expected, seconds, prior)
    robot = None if only_sense else robot_of(comparison)
    found: Sequence[Explanation] = ()
    nothing = evidence.fit(expected)
    for _ in range(_ROUNDS):
        nothing = evidence.fit(expected)
        if only_sense:
            found = tuple(senses(evidence, expected))
        elif not found:
            found = tuple(explanations(evidence, expected, robot, is_raw=sensor.quantity == "raw"))
        else:
            found = tuple(_again(evidence, one) for one in found)
        best = max((one.fit for one in found), key=lambda fit: fit.evidence)
        evidence = evidence.reweighted(best if best.evidence > nothing.evidence + GAIN else nothing)
    nothing = evidence.fit(expected)
    if max(map(_worth, found)) < nothing.evidence + _WORTH_A_REFIT:
        return Diagnosis(nothing=nothing, evidence=evidence, faults=())
    if not only_sense:
        top = sorted(found, key=lambda one: -_worth(one))[:_REFITTED]
        again = {(one.kind, one.about) for one in top}
        found = tuple(explanations(evidence, expected, robot, is_raw=sensor.quantity == "raw", only=again))
    nothing = evidence.fit(expected)
    ranked = sorted(found, key=lambda one: -_worth(one))
    shortest = 0.0 if robot is None else robot.shortest_delay_s
    stability = stability_of(sensor)
    counted = [
        one
        for one in ranked
        if _counts(evidence, nothing, one, shortest) and _shown(evidence, nothing, one, stability) is not None
    ]
    faults = [one for one in counted if _worth(one) > _worth(counted[0]) - _AS_GOOD]
    return Diagnosis(nothing=nothing, evidence=evidence, faults=tuple(faults))


def _again(evidence: Evidence, explanation: Explanation) -> Explanation:
    return replace(explanation, fit=evidence.fit(explanation.expected, explanation.turn))


def _worth(explanation: Explanation) -> float:
    return explanation.fit.evidence - _PARAMETER * explanation.parameters


_OF_LOG: Final = ("reversed", "component_reversed", "columns", "moment_unit", "mass", "joint_unit")
"""Faults so large that they show beside any error of a matrix."""


def _counts(evidence: Evidence, nothing: Fit, one: Explanation, shortest_delay_s: float) -> bool:
    """Whether a fault explains the measurements far better than none, and is beyond what robots have."""
    if _worth(one) < nothing.evidence + GAIN or not evidence.follows(one.fit):
        return False
    if one.value is None or one.half_width is None:
        return True
    off = abs(one.value - 1.0) if one.kind == "mass" else abs(one.value)
    return off - one.half_width > _LEAST.get(one.kind, 0.0) and (one.kind != "delay" or off >= shortest_delay_s)


def _shown(
    evidence: Evidence, nothing: Fit, one: Explanation, stability: FloatArray | None
) -> tuple[bool, FloatArray, FloatArray] | None:
    """What a fault leaves of the residual, where it explains most of that of force or moment and worsens neither.

    What it removes is more than the sensor drifts by itself; of a delay, which no drift looks like, more than noise.

    Returns:
        Whether errors of the matrix are taken out, and the residuals without the fault and with it; shape (2,); N, N m;
        None where the fault does not show.
    """
    noise = np.array([np.linalg.norm(evidence.deviation[own]) for own in FORCE_AND_MOMENT])
    least = noise
    if stability is not None and one.kind != "delay":
        least = np.maximum(noise, [np.linalg.norm(stability[own]) for own in FORCE_AND_MOMENT])
    for beside_matrix in (False,) if one.kind in _OF_LOG else (False, True):
        before, after = (evidence.left(fit, beside_matrix=beside_matrix) for fit in (nothing, one.fit))
        is_worse = after > _MOST_WORSE * np.maximum(before, noise)
        explains = (after < (1.0 - _LEAST_EXPLAINED) * before) & (before**2 - after**2 > least**2)
        if explains.any() and not is_worse.any():
            return beside_matrix, before, after
    return None


def stability_of(sensor: ExperimentSensor) -> FloatArray | None:
    """Give the drift in a log that any sensor of its range has.

    Args:
        sensor: The sensor; its range is what the file specifies, else by the limit of the counts.

    Returns:
        Per component; shape (6,); N, N m; None where neither is known.
    """
    full_scale = sensor.full_scale
    if full_scale is None:
        if sensor.prior is None or sensor.prior_source == "identity":
            return None
        full_scale = sensor.limit_counts * np.linalg.norm(sensor.prior, axis=1)
    return np.asarray(_STABILITY * full_scale)


def fault_finding(comparison: Comparison, diagnosis: Diagnosis) -> Finding:
    """Make the finding of a diagnosis that has faults.

    Args:
        comparison: Measured and expected wrenches.
        diagnosis: The diagnosis.

    Returns:
        The best fault, what to change, and those that the log does not separate from it.

    Raises:
        ValueError: If there is no fault that the measurements show.
    """
    best, others = diagnosis.faults[0], diagnosis.faults[1:]
    stability = stability_of(comparison.run.sensor)
    shown = _shown(diagnosis.evidence, diagnosis.nothing, best, stability)
    if shown is None:
        raise ValueError(f"expected a fault that the measurements show, got {best.kind}")
    beside_matrix, before, after = shown
    beside = " beside errors of the matrix" if beside_matrix else ""
    message = (
        f"{_what(comparison, best)}: residual{beside} {before[0]:.2g} -> {after[0]:.2g} N, "
        f"{before[1]:.2g} -> {after[1]:.2g} N m; {_remedy(comparison, best)}"
    )
    if others:
        listed = "; or ".join(f"{_what(comparison, one)} ({_remedy(comparison, one)})" for one in others)
        message += f"; this log does not separate it from: {listed}"
    if not best.changes_every_instant_alike:
        message += "; steps, contacts and drift are looked for once that is put right"
    size, unit = _size(best)
    return Finding(
        stream=comparison.run.sensor.stream,
        kind=best.kind,
        message=message,
        count=sum(len(part.samples) for part in comparison.parts),
        channel=best.about if best.kind in ("joint_sign", "joint_offset") else None,
        size=size,
        unit=unit,
    )


def reversed_sensors(experiment: Experiment, corrections: Mapping[str, Correction]) -> Iterator[str]:
    """Warn of sensors, or components, that measure the opposite of the expected wrench.

    Args:
        experiment: The experiment.
        corrections: How its sensors are read, by name.

    Yields:
        A sentence per sensor; none where nothing moves, or something touches the robot beyond the sensor.
    """
    for name, correction in corrections.items():
        run = SensorRun(experiment, name)
        try:
            comparison = compared(run, correction.bare)
        except ForceTorqueError:
            continue  # what the model lacks is no news of the sense
        diagnosis = None if comparison is None else diagnosed(comparison, only_sense=True)
        if comparison is not None and diagnosis is not None and diagnosis.faults:
            best = diagnosis.faults[0]
            yield f"{name}: {_what(comparison, best)}; {_remedy(comparison, best)}; see `forcetorque inspect`"


def _size(one: Explanation) -> tuple[float | None, str | None]:
    if one.value is None:
        return None, None
    if one.kind in ("mount", "gravity", "joint_offset"):
        return float(np.rad2deg(one.value)), "deg"
    return (one.value, "s") if one.kind == "delay" else (one.value, "times")


def _interval(one: Explanation, factor: float = 1.0, digits: str = ".3g") -> str:
    """Value with its 95 % interval."""
    value = (one.value or 0.0) * factor
    if one.half_width is None:
        return f"{value:{digits}}"
    half = one.half_width * abs(factor)
    return f"{value:{digits}} (95 %: {value - half:{digits}} to {value + half:{digits}})"


def _what(comparison: Comparison, one: Explanation) -> str:
    """What is wrong, with its size."""
    degrees = float(np.rad2deg(1.0))
    if one.kind == "reversed":
        return "the sensor measures the opposite of the expected wrench"
    if one.kind == "component_reversed":
        return f"{one.about} has the opposite sign, the rest of the wrench has not"
    if one.kind == "gravity":
        return f"gravity is off the specified direction by {_interval(one, degrees)} deg"
    if one.kind == "mass":
        return f"the sensor measures {_interval(one)} times the expected wrench"
    if one.kind == "joint_sign":
        return f"joint {one.about!r} turns the other way"
    if one.kind == "joint_offset":
        return f"the zero of joint {one.about!r} is off by {_interval(one, degrees)} deg"
    if one.kind == "joint_unit":
        return f"positions of the joints are in {one.about}"
    if one.kind == "columns":
        return one.about
    if one.kind == "moment_unit":
        return f"moments are in {one.about}, read as N m"
    if one.kind == "delay":
        return _delay_text(comparison, one)
    vector = np.zeros(3) if one.vector is None else one.vector
    return f"the sensor is turned by {_interval(one, degrees)} deg about {_axis_text(vector)} against the URDF"


def _delay_text(comparison: Comparison, one: Explanation) -> str:
    later = (one.value or 0.0) > 0.0
    amount = f"{_interval(one, 1e3 if later else -1e3, '.0f')} ms {'later' if later else 'earlier'}"
    if one.about:
        return f"stream {one.about!r} of joints comes {amount} than the others"
    return f"stream {comparison.run.sensor.stream!r} comes {amount} than the joints"


def _axis_text(vector: FloatArray) -> str:
    largest = int(np.argmax(np.abs(vector)))
    if abs(vector[largest]) > 0.97:
        return "xyz"[largest]
    return f"({', '.join(f'{value:.2f}' for value in vector)})"


def _remedy(comparison: Comparison, one: Explanation) -> str:
    """Line of the experiment file or URDF to change."""
    run = comparison.run
    name, support = run.sensor.name, comparison.parts[0].interval.support
    frame = "" if support is None else support.frame
    if one.kind == "reversed":
        return (
            f"turn <measure_direction> of the sensor tag {name!r} in the URDF, or measure_direction of [[sensor]], or "
            "gravity_direction of [[support]], the other way round"
        )
    if one.kind == "component_reversed":
        return (
            f"check the sign of {one.about} in columns of [[recording.stream]] {run.sensor.stream!r} and in prior of "
            f"[[sensor]] {name!r}"
        )
    if one.kind == "gravity":
        vector = np.zeros(3) if one.vector is None else one.vector
        listed = ", ".join(f"{value:.3g}" for value in np.round(vector, 3) + 0.0)
        return f'write gravity_direction = [{listed}] of [[support]] frame = "{frame}"'
    if one.kind == "mass":
        return (
            f"check the mass of the links beyond {name!r} in the file that urdf of [robot] names, mass_kg of [load], "
            f"and prior of [[sensor]] {name!r}, at the amplifier gains of the recording"
        )
    if one.kind == "joint_sign":
        return f"turn the sign of its column in [[recording.stream]], or <axis> of joint {one.about!r} in the URDF"
    if one.kind == "joint_offset":
        return (
            f"add it to the column of {one.about!r} in [[recording.stream]], or turn <origin rpy> of the joint in the "
            "URDF about its axis by it"
        )
    if one.kind == "joint_unit":
        unit = "deg" if one.about.startswith("degrees") else "rad"
        return f'write "{unit}" in units of [[recording.stream]] for the joints'
    if one.kind == "columns":
        return (
            f"put columns of [[recording.stream]] {run.sensor.stream!r} in the order fx, fy, fz, mx, my, mz, raw "
            "channels in that of the prior"
        )
    if one.kind == "moment_unit":
        return (
            f'write "{one.about}" in units of [[recording.stream]] {run.sensor.stream!r}, or check prior of [[sensor]] '
            f"{name!r}"
        )
    if one.kind == "delay":
        holders = run.experiment.recording.joint_signals("position")
        joints = dict.fromkeys(stream.name for stream, _ in holders.values())
        late, other = (one.about, run.sensor.stream) if one.about else (run.sensor.stream, next(iter(joints), "joints"))
        return f'write [[clock]] stream = "{late}", to = "{other}", delay_s = {one.value or 0.0:.3f}'
    return f"turn <origin rpy> of the fixed joint of {name!r} in the URDF, or mount the sensor as the URDF has it"
