# SPDX-License-Identifier: BSD-3-Clause
"""Sub-models of a robot: the bodies between its sensors (thesis 2.4)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from forcetorque.base.errors import RobotError
from forcetorque.robot.tree import BodyTree, cut_of


@dataclass(frozen=True, slots=True, kw_only=True)
class SubModel:
    """Bodies that no known cut separates."""

    name: str
    """Name of the sensor at its base; the root link for the part that holds the root."""
    base: int
    """Body that the sensor is at, or the root body."""
    sensor: str | None
    """Sensor at its base, between it and the part inboard; None for the part that holds the root."""
    bodies: tuple[int, ...]
    """Its bodies, parents before children; the first is the base."""
    outboard_sensors: tuple[str, ...]
    """Sensors at its other cuts, between it and the parts outboard."""


def sub_models(tree: BodyTree, sensors: Sequence[str]) -> tuple[SubModel, ...]:
    """Cut a robot at some of its sensors; at the others it stays in one piece.

    Args:
        tree: The robot.
        sensors: Sensors to cut at.

    Returns:
        The parts, inboard ones first; the first holds the root.

    Raises:
        RobotError: If a sensor is not in the tree, comes twice, or shares its joint with another.
    """
    sensor_at: dict[int, str] = {}
    for name in sensors:
        cut = cut_of(tree, name)
        if cut in sensor_at:
            raise RobotError(f"sensors {sensor_at[cut]!r} and {name!r} sit at one joint; cut there once")
        sensor_at[cut] = name
    part_of: list[int] = []
    bases: list[int] = []
    for index, body in enumerate(tree.bodies):
        if body.parent < 0 or index in sensor_at:
            part_of.append(len(bases))
            bases.append(index)
        else:
            part_of.append(part_of[body.parent])
    return tuple(
        SubModel(
            name=sensor_at.get(base, tree.root_link),
            base=base,
            sensor=sensor_at.get(base),
            bodies=tuple(index for index, owner in enumerate(part_of) if owner == part),
            outboard_sensors=tuple(
                name
                for index, name in sensor_at.items()
                if index != base and part_of[tree.bodies[index].parent] == part
            ),
        )
        for part, base in enumerate(bases)
    )
