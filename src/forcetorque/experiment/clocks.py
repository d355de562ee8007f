# SPDX-License-Identifier: BSD-3-Clause
"""The clocks of an experiment, brought to one as its file states, or by a motion that two streams both show."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import ExperimentError, RecordingError
from forcetorque.experiment import experiment_file as schema
from forcetorque.experiment.experiment_file_tables import ClockTable, processing_of
from forcetorque.experiment.named_files import stated_in
from forcetorque.recording.alignment import ClockShift, on_clock_of, seconds_since, usable_samples
from forcetorque.recording.clock_offset import estimate_delay
from forcetorque.recording.recording import Finding, Recording, Support, Use
from forcetorque.recording.smoothing import smooth_columns
from forcetorque.recording.stream import Stream
from forcetorque.robot.dynamics import motion_of_link
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.estimated_quantities import Question, required_joints_of
from forcetorque.robot.mechanics.measured_and_expected_wrench import Processing, robot_motion_at
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import BodyTree, build_tree, joints_between

_PRODUCTS = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
"""Axes of angular velocity that centrifugal and gyroscopic terms multiply."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Motion:
    """What of the robot is known before its recording is aligned."""

    model: RobotModel | None
    """The robot; None for a wrist sensor."""
    support: Support | None
    """Link that stands still while it is compared; None where none does."""
    sensors: Mapping[str, str]
    """Name of the sensor that reads a stream, by the stream."""
    loaded: frozenset[str]
    """Links that a load hangs on, of which the model knows nothing."""
    processing: Processing
    """Filters and gravity."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Shown:
    """Samples of something at rising instants."""

    time_s: FloatArray
    """Instants; shape (n,); s from the start of the recording."""
    values: FloatArray
    """Samples, finite; shape (n, k)."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SharedMotion:
    """A reading, and what it must follow linearly."""

    reading: Shown
    """The reading."""
    reference: Shown
    """What it follows."""
    read_by: str
    """Stream of the reading."""
    words: str
    """What they are."""


_Reference = Callable[[Recording, Motion, Stream, Stream], FloatArray]


def shared_motion(
    recording: Recording, motion: Motion, first: str, second: str, *, used: Callable[[IntArray], BoolArray]
) -> SharedMotion:
    """Find what two streams both show.

    Args:
        recording: Streams, on clocks as near to each other as is known.
        motion: Robot, support and sensors.
        first: A stream.
        second: Another one.
        used: Tells of stamps whether they lie in an interval that is used; shape (n,).

    Returns:
        Reading and reference.

    Raises:
        RecordingError: If they show nothing in common.
    """
    for quantities, sources in _PAIRS:
        for read_by, referred in ((first, second), (second, first)):
            reading, reference = recording.stream(read_by), recording.stream(referred)
            quantity = next((one for one in quantities if one in reading.signals), None)
            source = next((one for one in sources if one in reference.signals), None)
            if quantity is None or source is None or not _is_modelled(quantity, source, motion, reading):
                continue
            values = np.where(reading.held[:, None], np.nan, reading.signals[quantity].values)
            kept = used(reading.stamp_ns)
            return SharedMotion(
                reading=_shown(recording, reading, np.where(kept[:, None], values, np.nan)),
                reference=_shown(recording, reference, _REFERENCES[source](recording, motion, reading, reference)),
                read_by=read_by,
                words=f"{quantity} of {read_by!r} and {_WORDS[source]} of {referred!r}",
            )
    held = (", ".join(recording.stream(name).signals) for name in (first, second))
    raise RecordingError(
        f"{first!r} and {second!r} show nothing in common by which their clocks could be told: they hold "
        f"{' and '.join(held)}; expected a reading or an IMU beside joints of a robot on a support at rest, or beside "
        "an orientation, gravity or acceleration; specify delay_s"
    )


def _is_modelled(quantity: str, source: str, motion: Motion, reading: Stream) -> bool:
    """Whether the model says what the reading must follow."""
    if source != "position":
        return quantity != "wrench" or motion.model is None
    if motion.model is None or motion.support is None:
        return False
    if quantity in ("wrench", "raw"):
        return reading.name in motion.sensors
    return reading.signals[quantity].frame in motion.model.links


def _shown(recording: Recording, stream: Stream, values: FloatArray) -> Shown:
    rows = usable_samples(stream.stamp_ns)
    rows = rows[np.isfinite(values[rows]).all(axis=1)]
    if len(rows) < 2:
        raise RecordingError(f"stream {stream.name!r}: expected samples that can be compared, got {len(rows)}")
    return Shown(time_s=seconds_since(stream.stamp_ns[rows], recording.start_ns), values=values[rows])


def _gravity(recording: Recording, motion: Motion, reading: Stream, reference: Stream) -> FloatArray:
    """Gravity, and what turning adds to it where an orientation tells that: an arm moves what it turns."""
    gravity = reference.signals["gravity"].values
    if "orientation" not in reference.signals:
        return gravity
    # a point of a body that turns about another one feels what is linear in these; left out it would pass for noise,
    # which it is not: it comes again with the motion
    speed = _turning(recording, motion, reading, reference)
    turned = smooth_columns(reference.stamp_ns, speed, motion.processing.derivative_window, derivative=1)
    return np.column_stack([gravity, turned, *_products(speed)])


def _acceleration(recording: Recording, motion: Motion, reading: Stream, reference: Stream) -> FloatArray:
    return reference.signals["proper_acceleration"].values


def _turning(recording: Recording, motion: Motion, reading: Stream, reference: Stream) -> FloatArray:
    """Angular velocity along the axes of the frame: `R^T dR/dt` is that of its skew."""
    rows = reference.signals["orientation"].values
    speed = smooth_columns(reference.stamp_ns, rows, motion.processing.derivative_window, derivative=1).reshape(
        -1, 3, 3
    )
    skew = rows.reshape(-1, 3, 3).transpose(0, 2, 1) @ speed
    return np.column_stack([skew[:, 2, 1], skew[:, 0, 2], skew[:, 1, 0]])


def _by_joints(recording: Recording, motion: Motion, reading: Stream, reference: Stream) -> FloatArray:
    """Expected wrench of a sensor, or angular velocity or acceleration of an IMU, at the stamps of the joints."""
    model, support = motion.model, motion.support
    if model is None or support is None:
        raise RecordingError(f"stream {reading.name!r}: expected a robot on a support at rest")
    tree = build_tree(model, support.frame)

    def moved(joints: Sequence[str]) -> tuple[JointMotion, RootMotion]:
        stamps = reference.stamp_ns
        return robot_motion_at(recording, model, support, joints, reference, stamps, processing=motion.processing)

    if reading.name in motion.sensors:
        name = model.sensor(motion.sensors[reading.name]).name
        question = Question(tree=tree, expected=(name,), equations=())
        demanded = estimate(question, *moved(required_joints_of(question))).expected_of(name)
        link = _loaded_link(tree, name, motion.loaded, beyond_is_massless=not np.nan_to_num(demanded).any())
        if link is None:
            return demanded
        return np.hstack([demanded, _of_any_load(motion_of_link(tree, *moved(joints_between(tree, link)), link))])
    (frame,) = {str(signal.frame) for signal in reading.signals.values() if signal.frame is not None}
    imu = motion_of_link(tree, *moved(joints_between(tree, frame)), frame)
    return imu.angular_velocity if "angular_velocity" in reading.signals else imu.proper_acceleration


def _loaded_link(tree: BodyTree, sensor: str, loaded: frozenset[str], *, beyond_is_massless: bool) -> str | None:
    """Link that moves with the outboard side of a sensor and carries what the model does not know, if there is one."""
    if sensor not in tree.cuts:
        return None
    links = [link for link, (body, _) in tree.frames.items() if body == tree.cuts[sensor].body]
    return next((link for link in links if link in loaded or beyond_is_massless), None)


def _of_any_load(motion: RootMotion) -> FloatArray:
    """What the wrench of any rigid load on a link is linear in, by Newton and Euler; shape (n, 12)."""
    return np.column_stack(
        [motion.proper_acceleration, motion.angular_acceleration, *_products(motion.angular_velocity)]
    )


def _products(speed: FloatArray) -> list[FloatArray]:
    return [speed[:, i] * speed[:, j] for i, j in _PRODUCTS]


_PAIRS: Sequence[tuple[tuple[str, ...], tuple[str, ...]]] = (
    (("raw", "wrench"), ("position",)),
    (("angular_velocity", "proper_acceleration"), ("position",)),
    (("angular_velocity",), ("orientation",)),
    (("raw", "wrench"), ("gravity",)),
    (("proper_acceleration",), ("gravity",)),
    (("raw", "wrench"), ("proper_acceleration",)),
)
"""What is read, and what it follows by some matrix that nobody need know; the surest first."""
_REFERENCES: dict[str, _Reference] = {
    "position": _by_joints,
    "orientation": _turning,
    "gravity": _gravity,
    "proper_acceleration": _acceleration,
}
_WORDS = {
    "position": "joints",
    "orientation": "orientation",
    "gravity": "gravity",
    "proper_acceleration": "proper_acceleration",
}


_WITHIN_S = 0.5


def aligned_clocks(
    parsed: schema.ExperimentFile,
    file: Path,
    recording: Recording,
    model: RobotModel | None,
    *,
    must_tell: bool = True,
) -> Recording:
    """Bring the streams that `[[clock]]` names to the clocks of others.

    Args:
        parsed: Content of the experiment file.
        file: The experiment file, for messages.
        recording: The streams.
        model: The robot; None for a wrist sensor.
        must_tell: Whether a delay that the recording does not tell is refused; else the one around which it is looked
            for is taken, and the reason stands in the recording's clocks.

    Returns:
        The recording, with a finding for every clock.

    Raises:
        ExperimentError: If a stream is brought to two clocks, or to one that is moved itself later on.
        RecordingError: If a delay is to be estimated and the recording does not determine it.
    """
    _require_order(parsed.clock, file)
    shifts = []
    for index, entry in enumerate(parsed.clock):
        with stated_in(f"{file}: clock[{index}]"):
            for name in (*entry.streams, entry.to):
                recording.stream(name)
            _require_one_clock(entry, recording)
            near, shift = _shifted(recording, entry, _stated_shift(entry)), _stated_shift(entry)
            if entry.delay_s == "estimate":
                try:
                    shift = _estimated(entry, near, parsed, model)
                except RecordingError as error:
                    if must_tell:
                        raise
                    shift = replace(shift, undetermined=str(error))
            recording = _shifted(recording, entry, shift)
        shifts.append(shift)
    return replace(recording, findings=(*recording.findings, *map(_finding, shifts)), clocks=tuple(shifts))


def _require_order(entries: Sequence[ClockTable], file: Path) -> None:
    moved: set[str] = set()
    used: set[str] = set()
    for index, entry in enumerate(entries):
        for name in entry.streams:
            if name in moved | used:
                raise ExperimentError(
                    f"{file}: clock[{index}]: {name!r} is brought to a clock, or others were brought to its, above; "
                    "specify every stream once, and first those whose clock others are brought to"
                )
        moved |= set(entry.streams)
        used.add(entry.to)


def _require_one_clock(entry: ClockTable, recording: Recording) -> None:
    clocks = {recording.stream(name).clock for name in entry.streams}
    if len(clocks) > 1:
        raise ExperimentError(
            f"stream: expected streams of one clock, got {', '.join(sorted(clocks))}; list them apart"
        )


def _shifted(recording: Recording, entry: ClockTable, shift: ClockShift) -> Recording:
    """Bring the streams of a table to the clock; drift counts from the middle of the first one."""
    other, first = recording.stream(entry.to), recording.stream(entry.streams[0])
    moved = {name: on_clock_of(recording.stream(name), other, shift, of=first) for name in entry.streams}
    return replace(recording, streams={**recording.streams, **moved})


def _stated_shift(entry: ClockTable) -> ClockShift:
    drift = 0.0 if isinstance(entry.drift, str) else entry.drift
    return ClockShift(stream=entry.streams[0], to=entry.to, delay_s=entry.near_s, drift=drift)


def _estimated(
    entry: ClockTable, near: Recording, parsed: schema.ExperimentFile, model: RobotModel | None
) -> ClockShift:
    """Estimate what is left of the delay once the recording is near to it."""
    name = entry.streams[0]
    spans = _used_spans(near, parsed.interval)
    shared = shared_motion(near, _motion(parsed, model), name, entry.to, used=partial(_lie_in, spans))
    later = 1.0 if shared.read_by == name else -1.0
    delay = estimate_delay(
        shared.reading.time_s,
        shared.reading.values,
        shared.reference.time_s,
        shared.reference.values,
        within_s=_WITHIN_S if entry.within_s is None else entry.within_s,
        with_drift=entry.drift == "estimate",
        middle_s=_middle_s(near, name),
    )
    asked = entry.drift == "estimate"
    return ClockShift(
        stream=name,
        to=entry.to,
        delay_s=entry.near_s + later * delay.delay_s,
        drift=later * delay.drift if asked else 0.0,
        delay_half_width_s=delay.delay_half_width_s,
        drift_half_width=delay.drift_half_width if asked else None,
        shown_by=shared.words,
        explained=delay.explained,
        drift_not_requested=later * delay.drift_not_requested if delay.drifts and not asked else None,
    )


def _motion(parsed: schema.ExperimentFile, model: RobotModel | None) -> Motion:
    at_rest = [one for one in parsed.support if one.gravity_direction is not None]
    used = {one.support for one in parsed.interval if one.use is not Use.IGNORE}
    supports = [
        Support(frame=one.frame, gravity_direction=one.gravity_direction)
        for one in at_rest
        if one.gravity_direction is not None and {one.frame} == used
    ]
    gravity = Processing().gravity if parsed.robot is None else parsed.robot.gravity
    return Motion(
        model=model,
        support=supports[0] if supports else None,
        sensors={entry.stream: entry.name for entry in parsed.sensor},
        loaded=frozenset() if parsed.robot is None else parsed.loaded_links,
        processing=replace(processing_of(parsed.processing, gravity=gravity), logged_derivatives=False),
    )


def _used_spans(recording: Recording, intervals: Iterable[schema.Interval]) -> list[tuple[int, int]]:
    start, end = recording.span_ns
    return [
        (start + round(one.start_s * 1e9), end + 1 if one.end_s is None else start + round(one.end_s * 1e9))
        for one in intervals
        if one.use is not Use.IGNORE
    ]


def _lie_in(spans: Iterable[tuple[int, int]], stamp_ns: IntArray) -> BoolArray:
    inside = np.zeros(len(stamp_ns), dtype=bool)
    for begin, end in spans:
        inside |= (stamp_ns >= begin) & (stamp_ns < end)
    return inside


def _middle_s(recording: Recording, name: str) -> float:
    stamps = recording.stream(name).stamp_ns
    first, last = int(stamps.min()), int(stamps.max())
    return (first + (last - first) // 2 - recording.start_ns) * 1e-9


def _finding(shift: ClockShift) -> Finding:
    if shift.undetermined is not None:
        return Finding(stream=shift.stream, kind="untold_clock", message=shift.undetermined, count=0)
    return Finding(stream=shift.stream, kind="clock", message=shift.words, count=0, size=shift.delay_s, unit="s")
