# SPDX-License-Identifier: BSD-3-Clause
"""The `[plan]` table of a file, checked against the robot."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from forcetorque.errors import ExperimentError, known_names
from forcetorque.experiment.tables.plan import PlanTable
from forcetorque.recording import MovingSupport, Support
from forcetorque.robot import RobotModel


def read_plan(
    table: PlanTable | None, file: Path, model: RobotModel, supports: Iterable[Support | MovingSupport]
) -> PlanTable | None:
    """Check what can be recorded against the robot.

    Args:
        table: The table; None where the file has none.
        file: Its file, for messages.
        model: The robot.
        supports: Supports of the file.

    Returns:
        The same table.

    Raises:
        ExperimentError: If a joint, link or support does not exist.
    """
    if table is None:
        return None
    free = [joint.name for joint in model.joints.values() if joint.type.moves and joint.mimic is None]
    for joint in table.ranges:
        if joint not in free:
            raise ExperimentError(
                f"{file}: plan: ranges: robot {model.name!r} has no free joint {joint!r}; {known_names(joint, free)}"
            )
    for tool in table.tool:
        if tool.frame not in model.links:
            raise ExperimentError(
                f"{file}: plan: tool {tool.name!r}: robot {model.name!r} has no link {tool.frame!r}; "
                f"{known_names(tool.frame, model.links)}"
            )
    still = [support.frame for support in supports if isinstance(support, Support)]
    for frame in table.support:
        if frame not in still:
            raise ExperimentError(
                f"{file}: plan: support: no [[support]] at rest has the frame {frame!r}; {known_names(frame, still)}; "
                "add one with its gravity_direction"
            )
    return table
