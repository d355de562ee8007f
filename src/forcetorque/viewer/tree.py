# SPDX-License-Identifier: BSD-3-Clause
"""The robot's joints as the page moves them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from forcetorque.robot import Joint, JointType, RobotModel, build_tree
from forcetorque.viewer import scene
from forcetorque.viewer.geometry import flat


def scene_joints(model: RobotModel, coordinates: Sequence[str]) -> tuple[scene.Joint, ...]:
    """List joints, parents before children.

    Args:
        model: The robot.
        coordinates: Joints whose position is known, in the order of its columns.

    Returns:
        Every joint; one that mimics follows the column of its leader, one without a column stays where the
        coordinate of its leader is zero.
    """
    tree = build_tree(model, model.root_link)
    leaders = {body.joint: body.coordinate for body in tree.bodies if body.joint is not None}
    columns = {name: k for k, name in enumerate(coordinates)}
    joints = []
    for joint in _outwards(model):
        source = leaders.get(joint.name)
        joints.append(
            scene.Joint(
                name=joint.name,
                type=_kind(joint.type),
                parent=joint.parent,
                child=joint.child,
                parent_H_child=flat(joint.parent_H_child),
                axis=flat(joint.axis),
                column=None if source is None else columns.get(source.joint),
                multiplier=1.0 if source is None else source.multiplier,
                offset=0.0 if source is None else source.offset,
            )
        )
    return tuple(joints)


def _outwards(model: RobotModel) -> list[Joint]:
    """Joints in an order in which every parent link is reached before its children."""
    below: dict[str, list[Joint]] = {}
    for joint in model.joints.values():
        below.setdefault(joint.parent, []).append(joint)
    ordered: list[Joint] = []
    waiting = [model.root_link]
    while waiting:
        reached = below.get(waiting.pop(0), [])
        ordered += reached
        waiting += [joint.child for joint in reached]
    return ordered


def _kind(type: JointType) -> Literal["fixed", "rotary", "prismatic"]:
    return "fixed" if not type.moves else "prismatic" if type is JointType.PRISMATIC else "rotary"
