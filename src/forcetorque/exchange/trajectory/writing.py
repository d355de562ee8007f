# SPDX-License-Identifier: BSD-3-Clause
"""A trajectory in every form that players take."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from forcetorque.arrays import FloatArray
from forcetorque.exchange.trajectory.ros import ros_trajectory
from forcetorque.exchange.trajectory.table import trajectory_table
from forcetorque.exchange.trajectory.yarp import write_yarp_positions
from forcetorque.robot import JointMotion

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
