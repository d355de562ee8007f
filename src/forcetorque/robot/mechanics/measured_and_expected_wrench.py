# SPDX-License-Identifier: BSD-3-Clause
"""Samples of one sensor over an interval: the measured and the expected wrench, and the samples that filters need."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, IntArray, array, check_arrays, require_shape
from forcetorque.base.errors import RecordingError
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.recording.alignment import interpolate, require_overlap, usable_samples
from forcetorque.recording.frozen_and_saturated_samples import SampleQuality, UnusableCounts, repeated_samples
from forcetorque.recording.named_columns import ScalarSource
from forcetorque.recording.recording import Interval, MovingSupport, Recording, Support, Use
from forcetorque.recording.shared_filters import SharedFilters
from forcetorque.recording.smoothing import DERIVATIVE_WINDOW, EvenGrid, SavitzkyGolay, smooth
from forcetorque.recording.stream import Signal, Stream
from forcetorque.robot.mechanics.estimate import Evaluator, estimate, evaluator_of_samples
from forcetorque.robot.mechanics.estimated_quantities import Question, required_joints_of
from forcetorque.robot.mechanics.root_motion import LoggedSupport, joints_to_support
from forcetorque.robot.mechanics.shared_wrenches import SharedWrenches
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion, JointUnits, LoggedJoints, RootMotion, blocks_of
from forcetorque.robot.tree import build_tree


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PaddedSamples:
    """Samples of an interval with those around it, so that its ends are filtered as its middle is."""

    rows: IntArray
    """Indices into the stream, in the order of time; shape (n,)."""
    stamp_ns: IntArray
    """Their stamps; shape (n,); ns."""
    inside: BoolArray
    """Which of them lie in the interval; shape (n,)."""
    among: BoolArray
    """Which samples of the stream lie in the interval and are not to be ignored, also those whose stamps do not step
    forward; shape (N,)."""
    window: SavitzkyGolay | None
    """The filter; None for none, and then nothing lies around the interval."""
    grid: EvenGrid | None
    """Grid of the stream; None for a stream of a single sample."""

    def smoothed(self, values: FloatArray) -> FloatArray:
        """Filter what was computed at all instants, and keep that of the interval.

        Args:
            values: Values, NaN where one is missing; shape (n, k).

        Returns:
            Filtered values inside the interval; shape (m, k).
        """
        if self.window is not None:
            values = smooth(self.stamp_ns, values, self.window, grid=self.grid)
        return values[self.inside]

    def smoothed_together(self, columns: Mapping[str, FloatArray]) -> tuple[dict[str, FloatArray], BoolArray]:
        """Filter several quantities as `smoothed` does, as if they were columns of one.

        Args:
            columns: Quantities by name; shape (n, k) each.

        Returns:
            The same in the interval, shape (m, k) each, and which samples have all of them; shape (m,).
        """
        if self.window is None:
            inside = {name: self.smoothed(values) for name, values in columns.items()}
        else:
            ends = np.cumsum([values.shape[1] for values in columns.values()])[:-1]
            split = np.split(self.smoothed(np.hstack(list(columns.values()))), ends, axis=1)
            inside = dict(zip(columns, split, strict=True))
        complete = np.ones(int(np.count_nonzero(self.inside)), dtype=bool)
        for values in inside.values():
            complete &= np.isfinite(values).all(axis=1)
        return inside, complete


def padded_samples(
    recording: Recording,
    source: Stream,
    interval: Interval,
    window: SavitzkyGolay | None,
    *,
    apart: Collection[str] = (),
    repeated: BoolArray | None = None,
) -> PaddedSamples:
    """Find the samples of an interval that are not to be ignored, and those around it that its filter takes.

    What lies around it is taken as if the interval were longer. So nothing comes from an interval that is to be
    ignored or has another support, where what the interval says does not hold.

    Args:
        recording: The recording.
        source: One of its streams.
        interval: The interval.
        window: The filter; None for none.
        apart: Labels of further intervals that nothing is to be taken from.
        repeated: Samples of the stream that repeat a reading, which are no instants of the grid; shape (N,).

    Returns:
        The samples.

    Raises:
        RecordingError: If it lies outside the log, no sample is left, or the window holds too few samples.
    """
    picked, among = pick_samples(recording, source, interval)
    stamps, rows, grid = source.stamp_ns, picked, None
    if window is not None:
        held = np.zeros(len(stamps), dtype=bool)
        held[picked] = True
        usable = usable_samples(stamps)
        rows = usable[(held | ~_elsewhere(recording, interval, stamps, apart))[usable]]
    if window is not None and len(rows) > 1:
        read = rows if repeated is None or np.count_nonzero(~repeated[rows]) < 2 else rows[~repeated[rows]]
        grid = EvenGrid.of(stamps[read])
        # a whole window and not half of it: where the log ends, the last whole window is used
        margin = round((grid.length_of(window) + 1) * grid.period_s * 1e9) + grid.gap_ns
        rows = rows[(stamps[rows] >= stamps[picked[0]] - margin) & (stamps[rows] <= stamps[picked[-1]] + margin)]
    return PaddedSamples(
        rows=rows,
        stamp_ns=stamps[rows],
        inside=np.isin(rows, picked),
        among=among,
        window=window,
        grid=grid,
    )


def _elsewhere(recording: Recording, interval: Interval, stamps: IntArray, apart: Collection[str]) -> BoolArray:
    """Samples of intervals that nothing may come from; shape (n,)."""
    marks = np.zeros(len(stamps), dtype=bool)
    for other in recording.intervals:
        if other.use is Use.IGNORE or other.label in apart or not _same(other.support, interval.support):
            marks |= other.holds(stamps)
    return marks


def _same(first: Support | MovingSupport | None, second: Support | MovingSupport | None) -> bool:
    if isinstance(first, Support) and isinstance(second, Support):
        return first.frame == second.frame and np.array_equal(first.gravity_direction, second.gravity_direction)
    if isinstance(first, MovingSupport) and isinstance(second, MovingSupport):
        return first.frame == second.frame and first.motion_streams == second.motion_streams
    return False


def pick_samples(recording: Recording, source: Stream, interval: Interval) -> tuple[IntArray, BoolArray]:
    """Find the samples of an interval that are not to be ignored.

    Returns:
        Indices of its samples with increasing stamps, shape (k,), and which samples of the stream are its at all,
        shape (N,).

    Raises:
        RecordingError: If it lies outside the log, or no sample is left.
    """
    start, end = recording.span_ns
    if interval.start_ns < start or interval.end_ns > end + 1:
        first, last = ((t - start) * 1e-9 for t in (interval.start_ns, interval.end_ns))
        raise RecordingError(
            f"interval {interval.label!r}: expected a span inside the log, 0 to {(end - start) * 1e-9:.3f} s, "
            f"got {first:.3f} to {last:.3f} s"
        )
    stamps = source.stamp_ns
    inside = interval.holds(stamps)
    for other in recording.intervals:
        if other.use is Use.IGNORE:
            inside &= ~other.holds(stamps)
    usable = usable_samples(stamps)
    picked = usable[inside[usable]]
    if not len(picked):
        raise RecordingError(f"interval {interval.label!r}: stream {source.name!r} has no sample in it to use")
    return picked, inside


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Processing:
    """How logged samples become reading and reference."""

    derivative_window: SavitzkyGolay = DERIVATIVE_WINDOW
    """Filter that differentiates joint positions."""
    logged_derivatives: bool = False
    """Whether joint velocities and accelerations are taken from the log instead."""
    smoothing: SavitzkyGolay | None = None
    """Filter of reading and reference alike; None leaves both as they are.

    It takes samples around an interval too, as `padded_samples` has it. The same linear filter on both keeps
    `reference = matrix reading + offset` exact, and takes out vibration that joint encoders do not see.
    """
    gravity: float = STANDARD_GRAVITY
    """Magnitude of gravity; m/s2."""
    keep: frozenset[str] = frozenset()
    """What is used although it is left out by default, as `ProcessingTable` has it."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SensorSamples(ArrayRecord):
    """Reading and reference of one sensor at the same n instants."""

    label: str
    """Label of the interval."""
    stamp_ns: IntArray = field(metadata=array("n", dtype="int"))
    """Instants; shape (n,); ns."""
    reading: Signal
    """What the sensor read, `raw` or `wrench`; n samples."""
    reference: FloatArray = field(metadata=array("n", 6))
    """Expected wrench in the sensor's frame and direction; shape (n, 6); N, N m."""
    flattening: FloatArray | None = field(metadata=array("n", 6))
    """What a derivative window of twice the length would take from it; shape (n, 6); N, N m; None where no fit asks.

    The window that is used has flattened the accelerations already, by about a third of that where motions are smooth.
    """
    variables: FloatArray = field(metadata=array("n", None))
    """Linear variables, in the order asked for; shape (n, v)."""
    dropped: int
    """Samples of the interval left out: missing values, gaps in a joint, those that are unusable, and what a filter
    would make of these."""
    unusable: UnusableCounts
    """Samples of the interval that say nothing of the load."""

    def __post_init__(self) -> None:
        require_shape(self.reading.values, name="reading", shape=(len(self.stamp_ns), None))
        check_arrays(self)

    def __len__(self) -> int:
        return len(self.stamp_ns)


def sensor_samples(
    recording: Recording,
    model: RobotModel,
    *,
    sensor: str,
    stream: str,
    quantity: str,
    interval: Interval,
    processing: Processing,
    variables: Sequence[ScalarSource] = (),
    apart: Collection[str] = (),
    evaluator: Evaluator | None = None,
    applied: str | None = None,
    quality: SampleQuality | None = None,
    with_flattening: bool = True,
    known: Sequence[SensorSamples] = (),
    shared: SharedWrenches | None = None,
) -> SensorSamples:
    """Pair the readings of a sensor in an interval with the wrenches expected from the robot model.

    The support frame is taken to be fixed and the only link that touches the world.

    Args:
        recording: Streams of the sensor and of the joints, on one clock.
        model: The robot.
        sensor: Name of the sensor.
        stream: Stream that holds its reading.
        quantity: `raw` or `wrench`.
        interval: Interval with a support frame.
        processing: Filters and gravity.
        variables: Where linear variables, such as the temperature, come from.
        apart: Labels of intervals in which other links touch: the filter takes nothing from them.
        evaluator: Who computes the reference; by the number of samples of the interval if None.
        applied: Stream with the `applied_wrench`, which is the reference in place of the model's; none if None.
        quality: What is wrong with each sample of the stream; what the board and the stamps say if None.
        with_flattening: Whether the flattening is evaluated, for a fit.
        known: Samples on the same support, by the same processing without `smoothing`, whose reference holds here too.
        shared: Expected wrenches of other sensors of the recording, computed with those of this one; None for it alone.

    Returns:
        Samples of the interval that lie in no ignored interval and have a finite reading, reference and variables.

    Raises:
        RecordingError: If the interval has no support or lies outside the log, a needed joint is in no
            stream, streams do not overlap, or no sample is left.
    """
    support = interval.required_support(RecordingError)
    source = recording.stream(stream)
    if quality is None:
        nothing = np.zeros(len(source), dtype=bool)
        quality = SampleQuality(frozen=nothing, saturated=source.held, repeated=repeated_samples(source.stamp_ns))
    padded = padded_samples(recording, source, interval, processing.smoothing, apart=apart, repeated=quality.repeated)
    at_ns = padded.stamp_ns
    columns = {}
    if applied is None:
        robot = (recording, model, sensor, source, support, at_ns)
        columns["reference"] = _known(at_ns, known)
        new = np.isnan(columns["reference"]).any(axis=1)
        joints: tuple[str, ...] = ()
        if new.any():
            columns["reference"][new], joints = _expected(*robot[:-1], at_ns[new], processing, evaluator, shared)
        if with_flattening and not processing.logged_derivatives:
            longer = replace(processing, derivative_window=processing.derivative_window.doubled())
            # near the end of a log there may be no room for the longer window
            flattening = np.nan_to_num(columns["reference"] - _expected(*robot, longer, evaluator, shared)[0])
            columns["flattening"] = flattening
    else:
        columns["reference"], joints = _applied(recording, source, applied, at_ns), ()
    reading = source.signal(quantity)
    columns["reading"] = np.where(quality.unusable[padded.rows, None], np.nan, reading.values[padded.rows])
    if variables:
        columns["variables"] = _variables(recording, source, variables, at_ns)
    # together, because a sample that only one of them lacks would give them different filters
    columns, complete = padded.smoothed_together(columns)
    unusable = quality.counted(padded.among)
    if not complete.any():
        needed = ", ".join((*joints, *(f"{v.stream} {v.column}" for v in variables))) or "motion of the support"
        raise RecordingError(
            f"interval {interval.label!r}: none of {len(complete)} samples of {stream!r} has both a reading and the "
            f"joint(s) {needed}; the streams have gaps or missing values all over it, or samples that say nothing "
            f"of the load: {unusable}"
        )
    kept = {name: values[complete] for name, values in columns.items()}
    if with_flattening and "flattening" not in kept:
        kept["flattening"] = np.zeros_like(kept["reference"])  # no filter has flattened it
    return SensorSamples(
        label=interval.label,
        stamp_ns=at_ns[padded.inside][complete],
        reading=replace(reading, values=kept["reading"]),
        reference=kept["reference"],
        flattening=kept.get("flattening"),
        variables=kept.get("variables", np.empty((len(kept["reference"]), 0))),
        dropped=int(np.count_nonzero(padded.among)) - int(np.count_nonzero(complete)),
        unusable=unusable,
    )


def expected_wrench(
    recording: Recording,
    model: RobotModel,
    *,
    sensor: str,
    stream: str,
    interval: Interval,
    at_ns: IntArray,
    processing: Processing,
    applied: str | None = None,
) -> FloatArray:
    """Give the expected wrench of a sensor, which does not depend on its readings.

    Args:
        recording: As of `sensor_samples`.
        model: As of `sensor_samples`.
        sensor: As of `sensor_samples`.
        stream: As of `sensor_samples`.
        interval: As of `sensor_samples`.
        at_ns: Instants; shape (n,); ns.
        processing: As of `sensor_samples`.
        applied: As of `sensor_samples`.

    Returns:
        Wrenches in the sensor's frame and direction; shape (n, 6); N, N m; NaN in gaps.

    Raises:
        RecordingError: If the interval has no support, a needed joint is in no stream, or streams do not overlap.
    """
    source = recording.stream(stream)
    if applied is not None:
        return _applied(recording, source, applied, at_ns)
    support = interval.required_support(RecordingError)
    return _expected(recording, model, sensor, source, support, at_ns, processing, None)[0]


def _variables(recording: Recording, source: Stream, variables: Sequence[ScalarSource], at_ns: IntArray) -> FloatArray:
    for variable in variables:
        require_overlap(source, recording.stream(variable.stream))
    return np.column_stack([np.empty((len(at_ns), 0)), *(variable.at(recording, at_ns) for variable in variables)])


def _known(at_ns: IntArray, known: Sequence[SensorSamples]) -> FloatArray:
    """Expected wrenches of samples at the same instants; shape (n, 6); NaN where there are none."""
    expected = np.full((len(at_ns), 6), np.nan)
    for samples in known:
        _, here, there = np.intersect1d(at_ns, samples.stamp_ns, assume_unique=True, return_indices=True)
        expected[here] = samples.reference[there]
    return expected


def _applied(recording: Recording, source: Stream, applied: str, at_ns: IntArray) -> FloatArray:
    """Known wrench at given instants."""
    stream = recording.stream(applied)
    require_overlap(source, stream)
    return interpolate(stream, stream.signal("applied_wrench").values, at_ns)


def _expected(
    recording: Recording,
    model: RobotModel,
    sensor: str,
    source: Stream,
    support: Support | MovingSupport,
    at_ns: IntArray,
    processing: Processing,
    evaluator: Evaluator | None,
    shared: SharedWrenches | None = None,
) -> tuple[FloatArray, tuple[str, ...]]:
    """Expected wrench of a sensor at given instants, and the joints it needed."""
    tree = build_tree(model, support.frame)

    def question_of(names: Sequence[str]) -> Question:
        return Question(tree=tree, expected=tuple(model.sensor(name).name for name in names), equations=())

    def compute(names: Sequence[str]) -> dict[str, FloatArray]:
        question = question_of(names)
        joints, filters = required_joints_of(question), None if shared is None else shared.filters
        robot = LoggedRobot(recording, model, support, joints, source, processing=processing, filters=filters)
        by = evaluator_of_samples(len(at_ns), expected_only=True) if evaluator is None else evaluator
        expected = {name: np.empty((len(at_ns), 6)) for name in names}
        for block in blocks_of(len(at_ns)):
            estimates = estimate(question, *robot.at(at_ns[block]), evaluator=by)
            for name, wrenches in expected.items():
                wrenches[block] = estimates.expected_of(model.sensor(name).name)
        robot.require_radians()
        return expected

    if shared is None:
        wrenches = compute([sensor])[sensor]
    else:
        key = (id(support), processing.derivative_window, processing.logged_derivatives, processing.gravity)
        wrenches = shared.of(sensor, key, at_ns, compute)
    needed = required_joints_of(question_of([sensor]))
    return wrenches, tuple(dict.fromkeys((*needed, *joints_to_support(model, recording, support))))


def require_motion_overlap(
    recording: Recording,
    support: Support | MovingSupport,
    joints: Sequence[str],
    source: Stream,
    *,
    processing: Processing,
) -> None:
    """Check that the streams of joints and of an IMU can be aligned with another.

    Args:
        recording: The streams.
        support: The support.
        joints: Joints whose motion is wanted; those in no stream are left out.
        source: The other stream.
        processing: Where velocities and accelerations come from.

    Raises:
        RecordingError: As of `require_overlap`.
    """
    for used in ("position", "velocity", "acceleration") if processing.logged_derivatives else ("position",):
        holders = recording.joint_signals(used)
        for holder in dict.fromkeys(holders[joint][0].name for joint in joints if joint in holders):
            require_overlap(source, recording.stream(holder))
    if isinstance(support, MovingSupport):
        for stream in support.motion_streams:
            require_overlap(source, recording.stream(stream))


class LoggedRobot:
    """Joints and support of a recording, whose motion can be had at any instants of a stream."""

    def __init__(
        self,
        recording: Recording,
        model: RobotModel,
        support: Support | MovingSupport,
        joints: Sequence[str],
        source: Stream,
        *,
        processing: Processing,
        filters: SharedFilters | None = None,
        overlap_checked: bool = False,
    ) -> None:
        """Find the streams of the joints and of the IMU.

        Args:
            recording: Streams of the joints and of the IMU, on the clock of `source`.
            model: The robot.
            support: The support.
            joints: Joints whose motion is wanted.
            source: Stream that the instants are of.
            processing: Filters and gravity.
            filters: As of `LoggedJoints`.
            overlap_checked: Whether the whole recording passed `require_motion_overlap`; motion is NaN in a segment
                in which a stream has no sample.
        """
        self.joints = tuple(dict.fromkeys((*joints, *joints_to_support(model, recording, support))))
        """Joints whose motion is given: those that are wanted, and those between an IMU and the support."""
        if not overlap_checked:
            require_motion_overlap(recording, support, self.joints, source, processing=processing)
        window = processing.derivative_window
        self._joints = LoggedJoints(
            recording,
            self.joints,
            window=window,
            logged_derivatives=processing.logged_derivatives,
            filters=filters,
        )
        self._support = LoggedSupport(model, recording, support, window=window, gravity=processing.gravity)
        self._units = JointUnits(model, self.joints)

    def at(self, at_ns: IntArray) -> tuple[JointMotion, RootMotion]:
        """Give the motion at instants.

        Args:
            at_ns: Instants; shape (n,); ns.

        Returns:
            Motion of `joints`; motion of the support frame.
        """
        motion = self._joints.at(at_ns)
        self._units.add(motion)
        return motion, self._support.at(motion, at_ns)

    def require_radians(self) -> None:
        """Refuse positions, of all instants so far, far beyond the limits of the robot, and within them as degrees."""
        self._units.require_radians()


def robot_motion_at(
    recording: Recording,
    model: RobotModel,
    support: Support | MovingSupport,
    joints: Sequence[str],
    source: Stream,
    at_ns: IntArray,
    *,
    processing: Processing,
    filters: SharedFilters | None = None,
    overlap_checked: bool = False,
) -> tuple[JointMotion, RootMotion]:
    """Give the motion of joints and support at instants of a stream.

    Args:
        recording: Streams of the joints and of the IMU, on the clock of `source`.
        model: The robot.
        support: The support.
        joints: Joints whose motion is wanted.
        source: Stream that the instants are of.
        at_ns: Instants; shape (n,); ns.
        processing: Filters and gravity.
        filters: As of `LoggedJoints`.
        overlap_checked: As of `LoggedRobot`.

    Returns:
        Motion of the joints, and of those between an IMU and the support; motion of the support frame.
    """
    robot = LoggedRobot(
        recording,
        model,
        support,
        joints,
        source,
        processing=processing,
        filters=filters,
        overlap_checked=overlap_checked,
    )
    motion = robot.at(at_ns)
    robot.require_radians()
    return motion
