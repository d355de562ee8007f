# SPDX-License-Identifier: BSD-3-Clause
"""Bags that rosbags writes, in all three forms, of messages that are given as numbers."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer as Writer2
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

FORMS = ("bag", "sqlite3", "mcap")
START_NS = 1_706_000_000_000_000_001
PERIOD_NS = 10_000_000
TF = "tf2_msgs/msg/TFMessage"


class Types:
    """Messages of one form of bag."""

    def __init__(self, form: str) -> None:
        self.ros1 = form == "bag"
        self.store = get_typestore(Stores.ROS1_NOETIC if self.ros1 else Stores.ROS2_HUMBLE)
        if self.ros1:
            self.store.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms", TF))

    def make(self, kind: str, **fields: Any) -> Any:
        """Make a message or a part of one."""
        return self.store.types[kind](**fields)

    def header(self, k: int, frame: str, *, stamped: bool = True) -> Any:
        """Header of message number k."""
        stamp = START_NS + k * PERIOD_NS if stamped else 0
        time = self.make("builtin_interfaces/msg/Time", sec=stamp // 10**9, nanosec=stamp % 10**9)
        counter = {"seq": k + 1} if self.ros1 else {}
        return self.make("std_msgs/msg/Header", stamp=time, frame_id=frame, **counter)

    def text(self, value: str) -> Any:
        """A text."""
        return self.make("std_msgs/msg/String", data=value)

    def vector(self, values: Iterable[float]) -> Any:
        """Three numbers."""
        x, y, z = map(float, values)
        return self.make("geometry_msgs/msg/Vector3", x=x, y=y, z=z)

    def quaternion(self, values: Iterable[float]) -> Any:
        """Four numbers, the scalar last."""
        x, y, z, w = map(float, values)
        return self.make("geometry_msgs/msg/Quaternion", x=x, y=y, z=z, w=w)

    def wrench(self, k: int, values: np.ndarray, frame: str = "tool", *, stamped: bool = True) -> Any:
        """A reading of a force-torque sensor."""
        wrench = self.make("geometry_msgs/msg/Wrench", force=self.vector(values[:3]), torque=self.vector(values[3:]))
        header = self.header(k, frame, stamped=stamped)
        return self.make("geometry_msgs/msg/WrenchStamped", header=header, wrench=wrench)

    def joints(self, k: int, names: list[str], position: np.ndarray, velocity: np.ndarray, effort: np.ndarray) -> Any:
        """Joints; any array may be empty."""
        arrays = {"position": position, "velocity": velocity, "effort": effort}
        return self.make("sensor_msgs/msg/JointState", header=self.header(k, ""), name=names, **arrays)

    def imu(
        self,
        k: int,
        values: np.ndarray,
        covariance: float = 0.0,
        *,
        turn: Iterable[float] = (0.0, 0.0, 0.0, 1.0),
        turn_covariance: float = 0.0,
    ) -> Any:
        """Angular velocity, acceleration; the covariance of the former; an orientation."""
        zeros = np.zeros(9)
        return self.make(
            "sensor_msgs/msg/Imu",
            header=self.header(k, "imu"),
            orientation=self.quaternion(turn),
            orientation_covariance=zeros + turn_covariance,
            angular_velocity=self.vector(values[:3]),
            angular_velocity_covariance=zeros + covariance,
            linear_acceleration=self.vector(values[3:6]),
            linear_acceleration_covariance=zeros,
        )

    def temperature(self, k: int, value: float) -> Any:
        """A temperature."""
        header = self.header(k, "tool")
        return self.make("sensor_msgs/msg/Temperature", header=header, temperature=float(value), variance=0.0)

    def pose(self, turn: np.ndarray, place: Iterable[float]) -> Any:
        """Where a frame is in another."""
        x, y, z = map(float, place)
        point = self.make("geometry_msgs/msg/Point", x=x, y=y, z=z)
        return self.make("geometry_msgs/msg/Pose", position=point, orientation=self.quaternion(turn))

    def posed(self, kind: str, k: int, turn: np.ndarray, place: Iterable[float], parent: str, child: str) -> Any:
        """A message of any type with the pose of one frame, of which some do not name the child."""
        header = self.header(k, parent)
        if kind == "geometry_msgs/msg/QuaternionStamped":
            return self.make(kind, header=header, quaternion=self.quaternion(turn))
        if kind == "geometry_msgs/msg/TransformStamped":
            return self.transform(k, turn, place, parent, child)
        pose = self.pose(turn, place)
        if kind == "geometry_msgs/msg/PoseStamped":
            return self.make(kind, header=header, pose=pose)
        uncertain = self.make("geometry_msgs/msg/PoseWithCovariance", pose=pose, covariance=np.zeros(36))
        if kind == "geometry_msgs/msg/PoseWithCovarianceStamped":
            return self.make(kind, header=header, pose=uncertain)
        speed = self.make("geometry_msgs/msg/Twist", linear=self.vector((1, 2, 3)), angular=self.vector((4, 5, 6)))
        twist = self.make("geometry_msgs/msg/TwistWithCovariance", twist=speed, covariance=np.ones(36))
        return self.make("nav_msgs/msg/Odometry", header=header, child_frame_id=child, pose=uncertain, twist=twist)

    def transform(self, k: int, turn: np.ndarray, place: Iterable[float], parent: str, child: str) -> Any:
        """A child in its parent."""
        return self.make(
            "geometry_msgs/msg/TransformStamped",
            header=self.header(k, parent),
            child_frame_id=child,
            transform=self.make(
                "geometry_msgs/msg/Transform", translation=self.vector(place), rotation=self.quaternion(turn)
            ),
        )

    def transforms(self, k: int, rotations: Mapping[tuple[str, str], np.ndarray]) -> Any:
        """Rotations of children in parents, x y z w."""
        message = [
            self.transform(k, rotation, (1, 2, 3), parent, child) for (parent, child), rotation in rotations.items()
        ]
        return self.make(TF, transforms=message)


def write_bag(folder: Path, form: str, topics: Mapping[str, tuple[str, list[Any]]], packed: str = "") -> Path:
    """Write topics, each with its type and messages, packed by a method of the form, and give the path of the bag."""
    types = Types(form)
    path = folder / ("log.bag" if form == "bag" else form)
    writer: Any
    if form == "bag":
        writer, serialize = Writer1(path), types.store.serialize_ros1
    else:
        plugin = StoragePlugin.SQLITE3 if form == "sqlite3" else StoragePlugin.MCAP
        writer, serialize = Writer2(path, version=9, storage_plugin=plugin), types.store.serialize_cdr
    if packed and form == "bag":
        writer.set_compression(Writer1.CompressionFormat[packed])
    elif packed:
        writer.set_compression(CompressionMode[packed], CompressionFormat.ZSTD)
    with writer:
        for topic, (kind, messages) in topics.items():
            connection = writer.add_connection(topic, kind, typestore=types.store)
            for k, message in enumerate(messages):
                writer.write(connection, START_NS + k * PERIOD_NS + 5, bytes(serialize(message, kind)))
    return path
