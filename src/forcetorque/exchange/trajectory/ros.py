# SPDX-License-Identifier: BSD-3-Clause
"""A trajectory as the ROS message `trajectory_msgs/JointTrajectory`, in the YAML that its tools read."""

from __future__ import annotations

import json

from forcetorque.arrays import FloatArray
from forcetorque.robot import JointMotion


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
