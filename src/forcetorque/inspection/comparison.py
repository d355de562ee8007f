# SPDX-License-Identifier: BSD-3-Clause
"""Measured and expected wrenches of a sensor, and what the robot model expects where something of it is changed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, IntArray, array
from forcetorque.base.errors import ExperimentError
from forcetorque.base.noise.means import WINDOW_ROUNDING
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.sensor_samples import IntervalSamples
from forcetorque.inspection.plausibility.fault_hypotheses import Changes, Robot
from forcetorque.recording.recording import Interval, Support, Use
from forcetorque.robot.mechanics.estimate import Evaluator, estimate
from forcetorque.robot.mechanics.question import Question, required_joints_of
from forcetorque.robot.model import JointType
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree

_WINDOW_S, _WINDOWS = 0.1, 600
"""Length of the means that are compared, and how many of them at most, evenly over the log."""
_FEWEST = 20
"""Fewest means that are compared."""
_LONGEST_DELAY_S, _EDGE_INTERVAL_S = 0.5, 5.0
"""Largest delay that is looked for, and length of an interval whose ends are left out for it."""
_FEWEST_PERIODS = 1.5
"""Sampling periods from which on a delay is not that of the logging itself: those that round to two."""
_GRID_S = 0.01
"""Step at which the motion of joints is sampled for delays of their streams; s."""


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
        parts = tuple(
            run.interval_samples(one, variables=correction.variables, smoothed=False, with_flattening=False)
            for one in alone
        )
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
        flattening=None if samples.flattening is None else samples.flattening[rows],
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
        The robot; of a load on a wrist, whose pose is logged, only what a delay changes; None where known wrenches
        stand in for it.
    """
    run, loads = comparison.run, comparison.run.experiment.loads
    if loads is not None and loads.applied is not None:
        return None
    periods = [
        float(np.median(np.diff(part.samples.stamp_ns))) * 1e-9 for part in comparison.parts if len(part.samples) > 1
    ]
    shortest_delay_s = _FEWEST_PERIODS * max(periods, default=0.0)

    def of_sensor(delays_s: Sequence[float]) -> FloatArray:
        on_time = _shift(comparison, 0.0)
        return np.stack([comparison.expected + _shift(comparison, delay) - on_time for delay in delays_s])

    def unmoved(changes: Sequence[object] | FloatArray) -> FloatArray:
        return np.repeat(comparison.expected[None], len(changes), axis=0)

    if loads is not None and loads.in_place_of_robot:
        return Robot(
            joints=(),
            with_joints=unmoved,
            gravity_direction=None,
            with_gravity=unmoved,
            joint_streams=(),
            with_delay=lambda _, delays_s: of_sensor(delays_s),
            longest_delay_s=_LONGEST_DELAY_S if comparison.is_timed else 0.0,
            shortest_delay_s=shortest_delay_s,
        )
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
            return of_sensor(delays_s)
        return relative(_of_limbs(comparison, limbs, len(delays_s), lambda limb: limb.with_delays(stream, delays_s)))

    return Robot(
        joints=turning,
        with_joints=with_joints,
        gravity_direction=first if same else None,
        with_gravity=with_gravity,
        joint_streams=tuple(dict.fromkeys(holders[joint][0].name for joint in needed)),
        with_delay=with_delay,
        longest_delay_s=_LONGEST_DELAY_S if comparison.is_timed else 0.0,
        shortest_delay_s=shortest_delay_s,
    )


def _shift(comparison: Comparison, delay_s: float) -> FloatArray:
    """Expected wrenches a delay before the middle of each window; shape (n, 6)."""
    shifted = np.empty_like(comparison.expected)
    for number, part in enumerate(comparison.parts):
        own, stamps = comparison.part_of == number, part.samples.stamp_ns
        seconds = (stamps - stamps[0]) * 1e-9
        at_s = (comparison.at_ns[own] - stamps[0]) * 1e-9 - delay_s
        # of a long log only the samples beside the compared instants
        before = np.clip(np.searchsorted(seconds, at_s, side="right") - 1, 0, max(len(stamps) - 2, 0))
        rows = np.unique(np.concatenate([before, np.minimum(before + 1, len(stamps) - 1)]))
        reference = part.samples.reference[rows]
        shifted[own] = np.column_stack([np.interp(at_s, seconds[rows], column) for column in reference.T])
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
        support = interval.required_support(ExperimentError)
        tree = build_tree(run.experiment.model_on(support), support.frame)
        question = Question(tree=tree, expected=(run.sensor.name,), equations=())
        joints, root = run.motion_at(support, required_joints_of(question), at_ns)
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
        support = self.interval.required_support(ExperimentError)
        return grid_ns, self.run.motion_at(support, self.joints.names, grid_ns)[0]


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
