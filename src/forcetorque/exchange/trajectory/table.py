# SPDX-License-Identifier: BSD-3-Clause
"""A trajectory as a table: time and a column per joint, which the reader of tables takes."""

from __future__ import annotations

from forcetorque.arrays import FloatArray
from forcetorque.robot import JointMotion

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
