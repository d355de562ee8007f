# SPDX-License-Identifier: BSD-3-Clause
"""Sub-models: the parts of a robot between its force-torque sensors (thesis 2.4).

The tree is cut at sensors whose readings are known. Every part is one equation: the net wrenches of
its bodies are what the contacts and the parts beyond the cuts do to it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import BoolArray
from forcetorque.base.errors import RobotError, known_names
from forcetorque.robot.tree import BodyTree


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


def cut_of(tree: BodyTree, sensor: str) -> int:
    """Find the body just outboard of a sensor.

    Args:
        tree: The robot.
        sensor: Name of the sensor.

    Returns:
        Index of the body.

    Raises:
        RobotError: If the sensor is not in the tree.
    """
    if sensor not in tree.cuts:
        raise RobotError(f"no force-torque sensor {sensor!r} at a fixed joint; {known_names(sensor, tree.cuts)}")
    return tree.cuts[sensor].body


def outboard_bodies(tree: BodyTree, body: int) -> BoolArray:
    """Mark a body and everything that hangs on it.

    Args:
        tree: The robot.
        body: Index of the body.

    Returns:
        Marks; shape (bodies,).
    """
    marked = np.zeros(len(tree.bodies), dtype=bool)
    marked[body] = True
    for index, other in enumerate(tree.bodies):
        marked[index] |= other.parent >= 0 and marked[other.parent]
    return marked


def path_to_root(tree: BodyTree, body: int) -> tuple[int, ...]:
    """List the bodies from one inwards to the root.

    Args:
        tree: The robot.
        body: Index of the body.

    Returns:
        Indices, the body first and the root last.
    """
    path = [body]
    while tree.bodies[path[-1]].parent >= 0:
        path.append(tree.bodies[path[-1]].parent)
    return tuple(path)
