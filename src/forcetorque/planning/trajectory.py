# SPDX-License-Identifier: BSD-3-Clause
"""Joint trajectories as the players of robots take them: ROS, a table, a folder of yarpdatadumper."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.formats.yarp.discover import PortKind
from forcetorque.formats.yarp.writing import StreamPort, write_ports
from forcetorque.recording.recording import Recording
from forcetorque.recording.stream import Signal, Stream
from forcetorque.robot.motion import JointMotion


def ros_trajectory(time_s: FloatArray, motion: JointMotion) -> str:
    """Write a trajectory with positions and velocities.

    Args:
        time_s: Instants from the start; shape (n,); s.
        motion: The motion at them; rad or m.

    Returns:
        YAML.
    """
    names = ", ".join(json.dumps(name) for name in motion.names)
    lines = [
        "header:",
        "  stamp: {sec: 0, nanosec: 0}",
        '  frame_id: ""',
        f"joint_names: [{names}]",
        "points:",
    ]
    for time, position, velocity in zip(time_s.tolist(), motion.position, motion.velocity, strict=True):
        total = round(time * 1e9)
        lines += [
            f"- positions: {_list(position)}",
            f"  velocities: {_list(velocity)}",
            f"  time_from_start: {{sec: {total // 10**9}, nanosec: {total % 10**9}}}",
        ]
    return "\n".join(lines) + "\n"


def _list(values: FloatArray) -> str:
    # plain decimals: YAML 1.1 takes 1e-05 for a text
    return "[" + ", ".join(f"{value:.9f}" for value in values) + "]"


TIME_COLUMN = "time_s"
"""Heading of the time."""


def trajectory_table(time_s: FloatArray, motion: JointMotion) -> str:
    """Write a trajectory as CSV.

    Args:
        time_s: Instants from the start; shape (n,); s.
        motion: Positions at them; rad or m.

    Returns:
        A line of headings, and a line per instant.
    """
    lines = [",".join((TIME_COLUMN, *motion.names))]
    lines += [
        ",".join((f"{time:.3f}", *(f"{value:.9g}" for value in row)))
        for time, row in zip(time_s.tolist(), motion.position.tolist(), strict=True)
    ]
    return "\n".join(lines) + "\n"


PORT = "plan/state:o"
"""Folder of the port below the folder of logs."""
_START_NS = 1_000_000_000
"""First stamp: yarp takes one of 0 for none."""


def write_yarp_positions(folder: Path, time_s: FloatArray, motion: JointMotion, units: tuple[str, ...]) -> None:
    """Write positions of joints, in deg for those that turn.

    Args:
        folder: Folder of logs to make.
        time_s: Instants from the start; shape (n,); s.
        motion: Positions at them; rad or m.
        units: Unit of every joint.
    """
    signal = Signal(quantity="position", values=motion.position, columns=motion.names, units=units)
    stamps = _START_NS + np.rint(time_s * 1e9).astype(np.int64)
    stream = Stream(name="positions", clock="plan", stamp_ns=stamps, signals={"position": signal})
    port = StreamPort(path=PORT, kind=PortKind.STATE, stream="positions")
    write_ports(folder, Recording(streams={"positions": stream}), [port])


_DENSE_HZ, _SPARSE_HZ = 50.0, 10.0
"""Rates of what is played sample by sample, and of what controllers interpolate."""


def write_trajectory(
    folder: Path, stem: str, sampled: Callable[[float], tuple[FloatArray, JointMotion]], units: tuple[str, ...]
) -> None:
    """Write a trajectory as a table, for ROS, and for YARP.

    Args:
        folder: Folder that is there.
        stem: How the names of the files begin.
        sampled: From a rate in Hz to instants, shape (n,), in s, and the motion at them.
        units: Unit of every joint.
    """
    dense, motion = sampled(_DENSE_HZ)
    (folder / f"{stem}.csv").write_text(trajectory_table(dense, motion), encoding="utf-8")
    sparse, coarse = sampled(_SPARSE_HZ)
    (folder / f"{stem}_ros.yaml").write_text(ros_trajectory(sparse, coarse), encoding="utf-8")
    write_yarp_positions(folder / f"{stem}_yarp", dense, motion, units)
