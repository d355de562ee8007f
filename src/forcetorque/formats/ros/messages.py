# SPDX-License-Identifier: BSD-3-Clause
"""The messages that are read, field by field, as geometry_msgs, nav_msgs, sensor_msgs and tf2_msgs define them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from forcetorque.base.errors import FormatError
from forcetorque.formats.ros.cursor import Cursor


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

    @property
    def frames(self) -> tuple[str, ...]:
        """Frame of the header and child of a transform, without the slashes that ROS 1 had."""
        return tuple(frame.strip("/") for frame in (self.frame, *self.names))


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
    """Find orientation x y z w, angular velocity and proper acceleration, and where each has its covariance begin."""
    counter, stamp, frame = _header(cursor)
    numbers = {}
    for name, count in (("orientation", 4), ("angular_velocity", 3), ("proper_acceleration", 3)):
        numbers[name] = (cursor.doubles(count), count)
        numbers[not_measured(name)] = (cursor.doubles(9), 1)
    return (Fields(counter=counter, stamp=stamp, frame=frame, numbers=numbers),)


def not_measured(quantity: str) -> str:
    """Name the number of an Imu that is -1 where it does not measure a quantity: the first of its covariances.

    Args:
        quantity: The quantity.

    Returns:
        Its key in `Fields.numbers`.
    """
    return f"{quantity} covariance"


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
    """Find every transform of tf."""
    return tuple(field for _ in range(cursor.count()) for field in transform_stamped(cursor))


def transform_stamped(cursor: Cursor) -> tuple[Fields, ...]:
    """Find the pose of the child in the frame of the header."""
    counter, stamp, frame = _header(cursor)
    child = cursor.text()
    return (Fields(counter=counter, stamp=stamp, frame=frame, numbers=_pose(cursor), names=(child,)),)


def odometry(cursor: Cursor) -> tuple[Fields, ...]:
    """Find the pose of the child in the frame of the header; its velocity is left out."""
    (fields,) = transform_stamped(cursor)
    cursor.doubles(36 + 6 + 36)
    return (fields,)


def pose_stamped(cursor: Cursor) -> tuple[Fields, ...]:
    """Find the pose, in the frame of the header, of something that the message does not name."""
    counter, stamp, frame = _header(cursor)
    return (Fields(counter=counter, stamp=stamp, frame=frame, numbers=_pose(cursor)),)


def quaternion_stamped(cursor: Cursor) -> tuple[Fields, ...]:
    """Find the orientation x y z w; of what, and in what, differs from driver to driver."""
    counter, stamp, frame = _header(cursor)
    return (Fields(counter=counter, stamp=stamp, frame=frame, numbers={"orientation": (cursor.doubles(4), 4)}),)


IMU_TYPE = "sensor_msgs/msg/Imu"
QUATERNION_TYPE = "geometry_msgs/msg/QuaternionStamped"
MESSAGES: dict[str, Callable[[Cursor], tuple[Fields, ...]]] = {
    "geometry_msgs/msg/WrenchStamped": wrench_stamped,
    "sensor_msgs/msg/JointState": joint_state,
    IMU_TYPE: imu,
    "sensor_msgs/msg/Temperature": temperature,
    QUATERNION_TYPE: quaternion_stamped,
    "geometry_msgs/msg/PoseStamped": pose_stamped,
    "geometry_msgs/msg/PoseWithCovarianceStamped": pose_stamped,
    "geometry_msgs/msg/TransformStamped": transform_stamped,
    "nav_msgs/msg/Odometry": odometry,
    "tf2_msgs/msg/TFMessage": transforms,
    "tf/msg/tfMessage": transforms,
}
"""How to find the fields, by the type of message."""
_POSES = (transforms, transform_stamped, odometry, pose_stamped)
POSE_TYPES = tuple(name for name, find in MESSAGES.items() if find in _POSES)
"""Types of poses of a frame: as ROS has it they turn vectors along its axes to those of the header's frame."""


def _header(cursor: Cursor) -> tuple[int | None, int, str]:
    counter = None if cursor.cdr else cursor.skip(4, align=4)
    stamp = cursor.skip(8, align=4)
    return counter, stamp, cursor.text()


def _pose(cursor: Cursor) -> dict[str, tuple[int, int]]:
    translation = (cursor.doubles(3), 3)
    return {"translation": translation, "orientation": (cursor.doubles(4), 4)}
