# SPDX-License-Identifier: BSD-3-Clause
"""The limb that a sensor sits in, as seen from the support: found in the tree, not by names."""

from __future__ import annotations

from dataclasses import dataclass

from forcetorque.robot import BodyTree
from forcetorque.robot.sub_model import cut_of, outboard_bodies, path_to_root
from forcetorque.simulation.motions.stand import Stand


@dataclass(frozen=True, slots=True, kw_only=True)
class Limb:
    """Free joints around a sensor, from the support outwards."""

    sensor: str
    """Name of the sensor."""
    between: tuple[str, ...]
    """All joints between the support and the sensor."""
    own: tuple[str, ...]
    """Those of them that carry this limb alone: after the last place where other joints branch off."""
    outboard: tuple[str, ...]
    """Joints beyond the sensor."""


def limb_of(stand: Stand, sensor: str) -> Limb:
    """Find the limb that a sensor sits in.

    Args:
        stand: The robot on its support.
        sensor: Name of the sensor, or an alias.

    Returns:
        Its joints.

    Raises:
        RobotError: If the robot has no such sensor at a fixed joint.
    """
    tree = stand.tree
    name = stand.model.sensor(sensor).name
    cut = cut_of(tree, name)
    path = tuple(reversed(path_to_root(tree, cut)))
    between = _joints(tree, path)
    branching = [k for k, body in enumerate(path[:-1]) if _branches_off(tree, body, path[k + 1], between)]
    own = _joints(tree, path[branching[-1] + 1 :]) if branching else between
    beyond = outboard_bodies(tree, cut)
    outboard = _joints(tree, tuple(index for index in range(len(tree.bodies)) if beyond[index] and index != cut))
    return Limb(
        sensor=name,
        between=between,
        own=own,
        outboard=tuple(joint for joint in outboard if joint not in between),
    )


def _joints(tree: BodyTree, bodies: tuple[int, ...]) -> tuple[str, ...]:
    coordinates = (tree.bodies[index].coordinate for index in bodies)
    return tuple(dict.fromkeys(coordinate.joint for coordinate in coordinates if coordinate is not None))


def _branches_off(tree: BodyTree, body: int, onwards: int, path_joints: tuple[str, ...]) -> bool:
    """Whether joints hang on a body beside the path; those that follow joints of the path do not count."""
    away = outboard_bodies(tree, body) & ~outboard_bodies(tree, onwards)
    away[body] = False
    beside = _joints(tree, tuple(index for index in range(len(tree.bodies)) if away[index]))
    return any(joint not in path_joints for joint in beside)
