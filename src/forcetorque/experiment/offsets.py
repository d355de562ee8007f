# SPDX-License-Identifier: BSD-3-Clause
"""Offsets of sensors by every policy, and the sensor models of an experiment that follow from them.

An offset is the expected wrench over an interval, less what is read while static.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import ExperimentError, FitError, known_names
from forcetorque.experiment.applicability import one_per_sensor
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.contacts import contacts_in
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.interval_samples import IntervalSamples
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.validation_offset import OFFSET_S, Offset, OffsetEstimate, OffsetPolicy
from forcetorque.recording.alignment import seconds_since
from forcetorque.recording.recording import Interval, MovingSupport, Recording, Support, Use
from forcetorque.recording.stream import Signal, Stream
from forcetorque.robot.mechanics.estimated_quantities import Question, required_joints_of
from forcetorque.robot.mechanics.root_motion import imu_frame, imu_streams
from forcetorque.robot.tree import build_tree

STILL_RAD = 0.02
"""How far a joint may move in a second that counts as still; rad, m where it is prismatic. The weight of a robot turns
by as much in the axes of its sensors: about a degree."""

_SECOND_NS, _STEP_NS = 1_000_000_000, 250_000_000
"""Length of a second, and how far apart seconds begin."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class StillSeconds:
    """Seconds of an interval, also ones that overlap, in which no logged joint moves."""

    start_ns: IntArray
    """When they begin; shape (k,); ns."""

    @property
    def count(self) -> int:
        """How many there are."""
        return len(self.start_ns)

    def hold(self, stamp_ns: IntArray) -> BoolArray:
        """Tell which instants lie in them.

        Args:
            stamp_ns: Instants; shape (n,); ns.

        Returns:
            Whether each does; shape (n,).
        """
        if not self.count:
            return np.zeros(len(stamp_ns), dtype=bool)
        place = np.searchsorted(self.start_ns, stamp_ns, side="right") - 1
        return (place >= 0) & (stamp_ns - self.start_ns[place] < _SECOND_NS)


def still_seconds(recording: Recording, interval: Interval) -> StillSeconds:
    """Find the seconds of an interval in which the robot is still.

    Args:
        recording: The recording; joints that it does not hold are taken to be at rest.
        interval: The interval.

    Returns:
        Its still seconds, at least one.

    Raises:
        ExperimentError: If there is none: where nothing is still, matrix and inertia speak with the offset.
    """
    span = interval.end_ns - interval.start_ns
    starts = interval.start_ns + _STEP_NS * np.arange(max(0, (span - _SECOND_NS) // _STEP_NS + 1))
    moved, joint = np.zeros(len(starts)), np.full(len(starts), "", dtype=object)
    for name, stamps, position in _logged(recording):
        travel = np.array([_travel(position[(stamps >= t) & (stamps < t + _SECOND_NS)]) for t in starts])
        joint[travel > moved] = name
        moved = np.maximum(moved, travel)
    still: IntArray = starts[moved <= STILL_RAD].astype(np.int64)
    if len(still):
        return StillSeconds(start_ns=still)
    words = (
        f"it lasts {span * 1e-9:g} s"
        if not len(starts)
        else f"in the stillest {joint[moved.argmin()]!r} moves by {moved.min():.3f}"
    )
    raise ExperimentError(
        f"interval {interval.label!r}: expected a second in which no joint moves by more than {STILL_RAD:g} rad or m, "
        f"but {words}; name an interval in which the robot holds still"
    )


def _logged(recording: Recording) -> Iterator[tuple[str, IntArray, FloatArray]]:
    for joint, (stream, signal) in recording.joint_signals("position").items():
        yield joint, stream.stamp_ns, signal.values[:, signal.columns.index(joint)]


def _travel(position: FloatArray) -> float:
    """Distance of the extreme positions; infinite where there is none."""
    known = position[np.isfinite(position)]
    return float(np.ptp(known)) if len(known) else np.inf


FEWEST = 10
"""Samples; fewer hardly tell how much they scatter."""

_AT_REST = "joints at rest"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SensorOffset:
    """Offset of one sensor from one stretch."""

    sensor: str
    """The sensor."""
    policy: OffsetPolicy
    """Where the offset is from."""
    interval: Interval
    """The interval, with the support by which mechanics was asked."""
    estimate: OffsetEstimate
    """The offset."""
    load: FloatArray
    """What mechanics demands of the reading in the mean; shape (6,); N, N m."""
    load_moves_N: float
    """How far the force that it demands is from its mean at most."""
    time_s: FloatArray
    """Instants of its samples after the start of the recording; shape (n,); s."""
    lacking: FloatArray
    """Expected wrench less the one that is measured without an offset; shape (n, 6); N, N m."""
    not_logged: tuple[str, ...] = ()
    """Joints that no stream holds and that the demanded moments depend on: they are taken to be at rest anywhere, so
    that forces are known and moments are not."""

    @property
    def wrench(self) -> FloatArray:
        """What is to be added, moments that are not known left out; shape (6,); N, N m."""
        known = np.repeat([1.0, 0.0 if self.not_logged else 1.0], 3)
        return known * self.estimate.value

    @property
    def reading(self) -> FloatArray:
        """Mean of the readings that it is of, it added; shape (6,); N, N m."""
        return self.load - self.estimate.value + self.wrench


def offset_policies(words: Collection[OffsetPolicy | str]) -> tuple[OffsetPolicy, ...]:
    """Understand policies, each once.

    Args:
        words: Policies, or as the command line has them.

    Returns:
        The policies in this order.
    """
    return tuple(dict.fromkeys(OffsetPolicy.of(one) if isinstance(one, str) else one for one in words))


def sensor_offset(run: SensorRun, correction: Correction, policy: OffsetPolicy) -> SensorOffset:
    """Find the offset of a sensor from the interval that a policy names.

    Args:
        run: The sensor.
        correction: How it is read; its own offset does not count.
        policy: The policy, one that names an interval.

    Returns:
        The offset with its interval.

    Raises:
        ExperimentError: If there is no such interval; if it is not known there what the sensor must read: something
            else touches, no IMU tells gravity, the file does not specify it, or nothing is still.
        FitError: If there are too few samples to tell an error.
    """
    interval = labelled(run.experiment, policy.interval)
    if policy.offset is Offset.TARE:
        refuse_touched(run, interval)
        samples = run.interval_samples(interval, variables=correction.variables)
        return _offset(run, correction, policy, interval, samples, np.ones(len(samples.samples), dtype=bool))
    interval = one_link_interval(run.experiment, policy)
    not_logged = _not_logged(run, interval)
    there = _with_joints_at_rest(run, interval, not_logged)
    samples = SensorRun(replace(run.experiment, recording=there), run.sensor).interval_samples(
        interval, variables=correction.variables
    )
    still = still_seconds(run.experiment.recording, interval).hold(samples.samples.stamp_ns)
    return _offset(run, correction, policy, interval, samples, still, not_logged)


def with_policy(
    run: SensorRun, correction: Correction, policy: OffsetPolicy
) -> tuple[Correction, tuple[SensorOffset, ...]]:
    """Read a sensor with the offset of a policy.

    Args:
        run: The sensor.
        correction: How it is read, with the offset of the data that were fitted.
        policy: The policy.

    Returns:
        The correction with its offset, and where the recording gave that: once, or once per interval.

    Raises:
        ExperimentError: As of `sensor_offset`.
        FitError: If there are too few samples to tell an error.
    """
    if policy.offset is Offset.FITTED:
        return correction, ()
    if policy.offset is Offset.NONE:
        return correction.bare, ()
    if policy.interval is not None:
        offset = sensor_offset(run, correction, policy)
        return correction.with_offset(offset.wrench, f"{policy}"), (offset,)
    offsets = tuple(_of_every_interval(run, correction, policy))
    by_label = {offset.interval.label: offset.wrench for offset in offsets}
    bare = correction.with_offset(np.zeros(6), f"{policy} of every interval", intervals=by_label)
    return bare, offsets


def intervals_in_use(experiment: Experiment) -> list[Interval]:
    """Give the intervals that are not to be ignored.

    Returns:
        At least one, in the order of the file.

    Raises:
        ExperimentError: If there is none.
    """
    intervals = [interval for interval in experiment.recording.intervals if interval.use is not Use.IGNORE]
    if not intervals:
        raise ExperimentError(f"experiment {experiment.name!r}: expected an interval that is not to be ignored")
    return intervals


def labelled(experiment: Experiment, label: str | None) -> Interval:
    """Find an interval by its label.

    Returns:
        The interval.

    Raises:
        ExperimentError: If there is none.
    """
    intervals = {interval.label: interval for interval in experiment.recording.intervals}
    if label not in intervals:
        raise ExperimentError(f"no interval is labelled {label!r}; {known_names(str(label), intervals)}")
    return intervals[label]


def refuse_touched(run: SensorRun, interval: Interval) -> None:
    """Refuse an interval in which nobody knows what a sensor must read.

    Raises:
        ExperimentError: If something touches beyond the sensor.
    """
    if touching := run.touched_beyond(interval):
        raise ExperimentError(
            f"interval {interval.label!r}: expected one in which nothing touches beyond {run.sensor.name!r}, but "
            f"{', '.join(touching)} may, so that nobody knows what the sensor must read"
        )


def one_link_interval(experiment: Experiment, policy: OffsetPolicy) -> Interval:
    """Give the interval of a policy for which one link alone is touched, with gravity from where the policy has it.

    Args:
        experiment: The experiment.
        policy: One of `OF_ONE_LINK`.

    Returns:
        The interval with its support, which an IMU moves or which is at rest.

    Raises:
        ExperimentError: If there is no such interval, other links are touched in it, or gravity is not known.
    """
    interval = labelled(experiment, policy.interval)
    others = [entry.contact.link for entry in contacts_in(interval, experiment.contacts)]
    support = interval.support
    if support is None or others:
        touched = "no link" if support is None else ", ".join([support.frame, *others])
        raise ExperimentError(
            f"offset {policy}: expected an interval in which one link alone touches the world, but {touched} may; of "
            "[[contact]] say with intervals where it does"
        )
    return replace(interval, support=_support(experiment, policy, support))


def _support(experiment: Experiment, policy: OffsetPolicy, support: Support | MovingSupport) -> Support | MovingSupport:
    if policy.offset is Offset.ONE_LINK_FIXED_FRAME:
        specified = [support] if isinstance(support, Support) else experiment.supports
        fixed = next((one for one in specified if one.frame == support.frame), None)
        if fixed is None:
            raise ExperimentError(
                f"offset {policy}: expected [[support]] {support.frame!r} with gravity_direction, in its axes; it has "
                f"an IMU: take {Offset.ONE_LINK_IMU}:{policy.interval}, or specify the direction"
            )
        return fixed
    if isinstance(support, MovingSupport):
        return support
    streams = imu_streams(experiment.recording)
    if not streams:
        raise ExperimentError(
            f"offset {policy}: expected an IMU in the recording, which tells gravity, there is none; take "
            f"{Offset.ONE_LINK_FIXED_FRAME}:{policy.interval}"
        )
    moving = MovingSupport(frame=support.frame, motion_streams=streams)
    imu_frame(experiment.model, experiment.recording, moving)  # of several IMUs the file must name one
    return moving


def _not_logged(run: SensorRun, interval: Interval) -> tuple[str, ...]:
    """Joints that the expected reading depends on and no stream holds."""
    experiment, support = run.experiment, interval.support
    if support is None:
        return ()
    tree = build_tree(experiment.model_on(support), support.frame)
    question = Question(tree=tree, expected=(run.sensor.name,), equations=())
    logged = experiment.recording.joint_signals("position")
    return tuple(joint for joint in required_joints_of(question) if joint not in logged)


def _with_joints_at_rest(run: SensorRun, interval: Interval, joints: Collection[str]) -> Recording:
    # at rest a sensor bears the same force wherever a joint is, and another moment
    recording, stream = run.experiment.recording, run.stream
    streams = dict(recording.streams)
    if joints:
        zero = Signal(
            quantity="position",
            values=np.zeros((len(stream), len(joints))),
            columns=tuple(joints),
            units=tuple(run.experiment.model.joints[joint].type.unit for joint in joints),
        )
        streams[_AT_REST] = Stream(
            name=_AT_REST, clock=stream.clock, stamp_ns=stream.stamp_ns, signals={"position": zero}
        )
    intervals = tuple(interval if one.label == interval.label else one for one in recording.intervals)
    return replace(recording, streams=streams, intervals=intervals)


def _of_every_interval(run: SensorRun, correction: Correction, policy: OffsetPolicy) -> Iterator[SensorOffset]:
    for interval in run.experiment.recording.intervals:
        if interval.use is Use.IGNORE:
            continue
        refuse_touched(run, interval)
        if others := [one for one in contacts_in(interval, run.experiment.contacts) if one.intervals is not None]:
            raise ExperimentError(
                f"offset {policy}: expected intervals in which one link alone touches the world, but "
                f"{others[0].contact.name} does in {interval.label!r} too; take one from an interval, such as "
                f"{Offset.ONE_LINK_FIXED_FRAME}:LABEL"
            )
        samples = run.interval_samples(interval, variables=correction.variables)
        stamps = samples.samples.stamp_ns
        chosen = np.ones(len(stamps), dtype=bool)
        if policy.offset is Offset.FIRST_SECOND:
            chosen = stamps < stamps[0] + round(OFFSET_S * 1e9)
        yield _offset(run, correction, policy, interval, samples, chosen)


def _offset(
    run: SensorRun,
    correction: Correction,
    policy: OffsetPolicy,
    interval: Interval,
    samples: IntervalSamples,
    chosen: BoolArray,
    not_logged: tuple[str, ...] = (),
) -> SensorOffset:
    count = int(chosen.sum())
    if count < FEWEST:
        raise FitError(
            f"interval {interval.label!r}: expected at least {FEWEST} samples to determine an offset, got {count}"
        )
    expected = samples.samples.reference[chosen]
    lacking = run.sensor.expected_reading(expected) - samples.readings.at(chosen).wrench(correction.bare)
    time_s = seconds_since(samples.samples.stamp_ns[chosen], run.experiment.recording.start_ns)
    force = expected[:, :3]
    return SensorOffset(
        sensor=run.sensor.name,
        policy=policy,
        interval=interval,
        estimate=OffsetEstimate.of(lacking, time_s),
        load=expected.mean(axis=0),
        load_moves_N=float(np.linalg.norm(force - force.mean(axis=0), axis=1).max()),
        time_s=time_s,
        lacking=lacking,
        not_logged=not_logged,
    )


FITTED = OffsetPolicy(Offset.FITTED)


def corrections_of(
    experiment: Experiment,
    calibrations: Mapping[str, Calibration],
    *,
    offset: OffsetPolicy | str = FITTED,
) -> dict[str, Correction]:
    """Decide how every sensor of an experiment is read.

    A calibration is used where one is given. Else the prior is, or the logged wrench, with the
    offset that makes its mean that of the model over the calibration intervals. Another offset can be asked for.

    Args:
        experiment: The experiment.
        calibrations: Calibrations by name of their file.
        offset: Where the offsets come from, such as `one-link-imu:hanging`; from the data that were fitted if left out.

    Returns:
        Corrections by sensor.

    Raises:
        ExperimentError: If a calibration may not be applied, or raw counts have neither calibration nor prior, or
            an offset cannot be told.
        FitError: If an offset has too few samples.
    """
    chosen = one_per_sensor(experiment, calibrations)
    (policy,) = offset_policies([offset])
    corrections = {}
    for sensor in experiment.sensors:
        sensor.require_six_components("what the sensors of a robot give together")
        run = SensorRun(experiment, sensor)
        calibrated = sensor.name in chosen
        correction = run.read_by(*chosen[sensor.name]) if calibrated else without_calibration(run, policy)
        corrections[sensor.name], _ = with_policy(run, correction, policy)
    return corrections


def without_calibration(run: SensorRun, policy: OffsetPolicy) -> Correction:
    """Read a sensor by the prior of the experiment, or as logged.

    Args:
        run: The sensor.
        policy: Where the offset is to come from; the model is asked for one only where the fitted offset is wanted.

    Returns:
        The correction, before the policy gives it another offset.
    """
    return run.uncalibrated() if policy.offset is Offset.FITTED else Correction.without_offset(run.sensor)
