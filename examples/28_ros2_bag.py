# SPDX-License-Identifier: BSD-3-Clause
"""Write the log of the tutorial as a ROS 2 bag (MCAP): topics /joint_states and /wrist_ft/wrench.

Usage: python examples/28_ros2_bag.py [BAG]

BAG is a folder that does not exist yet. docs/guides/ros2_bag.md reads it; it needs the extra `ros`.
"""

from __future__ import annotations

import argparse
import csv
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

LOG = Path(__file__).resolve().parents[1] / "docs" / "tutorial" / "log.csv"
START_NS = 1_700_000_000_000_000_000
TYPES = get_typestore(Stores.ROS2_HUMBLE)
JOINTS, WRENCH = "sensor_msgs/msg/JointState", "geometry_msgs/msg/WrenchStamped"


def message(kind: str, **fields: Any) -> Any:
    """Make a message or a part of one."""
    return TYPES.types[kind](**fields)


def header(stamp_ns: int, frame: str) -> Any:
    """Make the header of a message."""
    stamp = message("builtin_interfaces/msg/Time", sec=stamp_ns // 10**9, nanosec=stamp_ns % 10**9)
    return message("std_msgs/msg/Header", stamp=stamp, frame_id=frame)


def wrench(stamp_ns: int, row: Mapping[str, str]) -> Any:
    """Make the message of the sensor from a row of the log."""
    force = message("geometry_msgs/msg/Vector3", **{axis: float(row[f"f{axis}_N"]) for axis in "xyz"})
    torque = message("geometry_msgs/msg/Vector3", **{axis: float(row[f"t{axis}_Nm"]) for axis in "xyz"})
    value = message("geometry_msgs/msg/Wrench", force=force, torque=torque)
    return message(WRENCH, header=header(stamp_ns, "arm_ft"), wrench=value)


def joints(stamp_ns: int, row: Mapping[str, str]) -> Any:
    """Make the message of the joints from a row of the log."""
    names = [name for name in row if name.endswith("_rad")]
    return message(
        JOINTS,
        header=header(stamp_ns, ""),
        name=[name.removesuffix("_rad") for name in names],
        position=np.array([float(row[name]) for name in names]),
        velocity=np.empty(0),
        effort=np.empty(0),
    )


def write_bag(bag: Path) -> None:
    """Write the bag.

    Args:
        bag: Folder to make.
    """
    with LOG.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    with Writer(bag, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        for topic, kind, build in (("/joint_states", JOINTS, joints), ("/wrist_ft/wrench", WRENCH, wrench)):
            connection = writer.add_connection(topic, kind, typestore=TYPES)
            for row in rows:
                stamp_ns = START_NS + round(float(row["time_s"]) * 1e9)
                writer.write(connection, stamp_ns, TYPES.serialize_cdr(build(stamp_ns, row), kind))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Write the log of the tutorial as a ROS 2 bag (MCAP).")
    parser.add_argument("bag", nargs="?", type=Path, default=Path("bag"), help="folder to make; it must not exist")
    write_bag(parser.parse_args().bag)
