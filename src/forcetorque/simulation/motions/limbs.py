# SPDX-License-Identifier: BSD-3-Clause
"""Limbs and legs of a robot, found in its tree."""

from __future__ import annotations

from dataclasses import dataclass

from forcetorque.base.errors import RobotError, known_names
from forcetorque.robot.kinematics import joints_between
from forcetorque.robot.sub_model import cut_of, outboard_bodies, path_to_root
from forcetorque.robot.tree import BodyTree, build_tree
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


@dataclass(frozen=True, slots=True, kw_only=True)
class Legs:
    """Free joints of a robot that stands on one foot."""

    trunk: str
    """Link that both legs hang on."""
    support: tuple[str, ...]
    """Joints between the trunk and the foot that stands."""
    swing: tuple[str, ...]
    """Joints between the trunk and the other foot."""
    others: tuple[str, ...]
    """All other free joints: of the trunk, arms and head."""


def legs_of(stand: Stand, swing: str, *, trunk: str | None = None) -> Legs:
    """Tell the legs apart.

    Args:
        stand: The robot on one foot.
        swing: A link of the other foot.
        trunk: Link that both legs hang on; the last link that both feet hang on in the URDF if None.

    Returns:
        The joints of both legs, and the others.

    Raises:
        RobotError: If there is no such link, or a leg has no joints of its own.
    """
    for link in (swing, *(() if trunk is None else (trunk,))):
        if link not in stand.model.links:
            raise RobotError(f"robot {stand.model.name!r} has no link {link!r}; {known_names(link, stand.model.links)}")
    middle = _common_ancestor(stand, swing) if trunk is None else trunk
    tree = build_tree(stand.model, middle)
    standing, swinging = (joints_between(tree, foot) for foot in (stand.support, swing))
    shared = set(standing) & set(swinging)
    for foot, joints in ((stand.support, standing), (swing, swinging)):
        if not joints or shared:
            raise RobotError(
                f"legs from {middle!r} to {stand.support!r} and {swing!r}: expected joints of their own, {foot!r} has "
                f"{', '.join(joints) or 'none'}; name the trunk between the legs"
            )
    legs = {*standing, *swinging}
    return Legs(trunk=middle, support=standing, swing=swinging, others=tuple(j for j in stand.joints if j not in legs))


def _common_ancestor(stand: Stand, swing: str) -> str:
    parents = {joint.child: joint.parent for joint in stand.model.joints.values()}
    above = [stand.support]
    while above[-1] in parents:
        above.append(parents[above[-1]])
    link = swing
    while link not in above:
        link = parents[link]
    return link
