# SPDX-License-Identifier: BSD-3-Clause
"""What two streams both show of one motion, so that their clocks can be told apart."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import RecordingError
from forcetorque.recording.alignment import seconds_since, usable_samples
from forcetorque.recording.recording import Recording, Support
from forcetorque.recording.smoothing import SavitzkyGolay, smooth_columns
from forcetorque.recording.stream import Stream
from forcetorque.robot.kinematics import joints_between, motion_of_link
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.question import Question, required_joints_of
from forcetorque.robot.mechanics.samples import Processing, robot_motion_at
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import BodyTree, build_tree

_TURN_WINDOW = SavitzkyGolay(window_s=0.3, order=3)
"""Filter that differentiates an orientation, as that of joints."""
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
        "an orientation, gravity or acceleration; state delay_s"
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
    turned = smooth_columns(reference.stamp_ns, speed, _TURN_WINDOW, derivative=1)
    return np.column_stack([gravity, turned, *_products(speed)])


def _acceleration(recording: Recording, motion: Motion, reading: Stream, reference: Stream) -> FloatArray:
    return reference.signals["proper_acceleration"].values


def _turning(recording: Recording, motion: Motion, reading: Stream, reference: Stream) -> FloatArray:
    """Angular velocity along the axes of the frame: `R^T dR/dt` is that of its skew."""
    rows = reference.signals["orientation"].values
    speed = smooth_columns(reference.stamp_ns, rows, _TURN_WINDOW, derivative=1).reshape(-1, 3, 3)
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
