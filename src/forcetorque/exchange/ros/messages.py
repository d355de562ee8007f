# SPDX-License-Identifier: BSD-3-Clause
"""The messages that are read, field by field, as geometry_msgs, sensor_msgs and tf2_msgs define them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from forcetorque.errors import FormatError
from forcetorque.exchange.ros.cursor import Cursor


@dataclass(frozen=True, slots=True, kw_only=True)
class Fields:
    """Where one stamped set of numbers lies in a message."""

    counter: int | None
    """First byte of the counter that ROS 1 has."""
    stamp: int
    """First byte of the stamp: seconds, then nanoseconds, of four bytes each."""
    frame: str
    """Frame of the header."""
    numbers: dict[str, tuple[int, int]]
    """First byte and count of float64 numbers, by name."""
    names: tuple[str, ...] = ()
    """Joints of a JointState, or the child of a transform."""


def wrench_stamped(cursor: Cursor) -> tuple[Fields, ...]:
    """Find force and torque."""
    counter, stamp, frame = _header(cursor)
    return (Fields(counter=counter, stamp=stamp, frame=frame, numbers={"wrench": (cursor.doubles(6), 6)}),)


def temperature(cursor: Cursor) -> tuple[Fields, ...]:
    """Find the temperature; its variance is left out."""
    counter, stamp, frame = _header(cursor)
    start = cursor.doubles(2)
    return (Fields(counter=counter, stamp=stamp, frame=frame, numbers={"temperature": (start, 1)}),)


def imu(cursor: Cursor) -> tuple[Fields, ...]:
    """Find angular velocity and proper acceleration, and the first numbers of their covariances: -1 is not measured."""
    counter, stamp, frame = _header(cursor)
    numbers = {}
    cursor.doubles(4 + 9)  # the orientation, whose world no message names
    for name in ("angular_velocity", "proper_acceleration"):
        numbers[name] = (cursor.doubles(3), 3)
        numbers[f"{name} covariance"] = (cursor.doubles(9), 1)
    return (Fields(counter=counter, stamp=stamp, frame=frame, numbers=numbers),)


def joint_state(cursor: Cursor) -> tuple[Fields, ...]:
    """Find names, positions, velocities and efforts, of which each may be absent."""
    counter, stamp, frame = _header(cursor)
    names = tuple(cursor.text() for _ in range(cursor.count()))
    if len(set(names)) != len(names):
        raise FormatError(f"expected every joint once, got {', '.join(map(repr, names[:20]))}")
    numbers = {}
    for quantity in ("position", "velocity", "torque"):
        count = cursor.count()
        if count not in (0, len(names)):
            raise FormatError(f"expected a {quantity} of none or of all {len(names)} joints, got {count}")
        start = cursor.doubles(count)
        if count:
            numbers[quantity] = (start, count)
    return (Fields(counter=counter, stamp=stamp, frame=frame, numbers=numbers, names=names),)


def transforms(cursor: Cursor) -> tuple[Fields, ...]:
    """Find the rotation of every transform, from child to frame, x y z w; translations are left out."""
    fields = []
    for _ in range(cursor.count()):
        counter, stamp, frame = _header(cursor)
        child = cursor.text()
        cursor.doubles(3)
        rotation = (cursor.doubles(4), 4)
        fields.append(
            Fields(counter=counter, stamp=stamp, frame=frame, numbers={"orientation": rotation}, names=(child,))
        )
    return tuple(fields)


MESSAGES: dict[str, Callable[[Cursor], tuple[Fields, ...]]] = {
    "geometry_msgs/msg/WrenchStamped": wrench_stamped,
    "sensor_msgs/msg/JointState": joint_state,
    "sensor_msgs/msg/Imu": imu,
    "sensor_msgs/msg/Temperature": temperature,
    "tf2_msgs/msg/TFMessage": transforms,
    "tf/msg/tfMessage": transforms,
}
"""How to find the fields, by the type of message."""
TF_TYPES = ("tf2_msgs/msg/TFMessage", "tf/msg/tfMessage")
"""Types of tf, of which one topic has many transforms."""


def _header(cursor: Cursor) -> tuple[int | None, int, str]:
    counter = None if cursor.cdr else cursor.skip(4, align=4)
    stamp = cursor.skip(8, align=4)
    return counter, stamp, cursor.text()
