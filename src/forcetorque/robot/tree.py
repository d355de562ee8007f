# SPDX-License-Identifier: BSD-3-Clause
"""Body trees, with fixed joints lumped and cuts at the sensors (thesis 2.4), and the way from the root to a link."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum
from functools import lru_cache
from typing import Final

import numpy as np

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, mapping
from forcetorque.base.errors import RobotError, require_known
from forcetorque.base.inertia import Inertia
from forcetorque.base.pose import invert_pose, make_pose, rotation_with_z_along, split_pose
from forcetorque.base.wrench import reading_sign
from forcetorque.robot.model import ForceTorqueSensor, Joint, JointType, RobotModel, SensorFrame

_TREES: Final = 32
"""Trees that are cached: one robot is computed over and over, from a few of its links."""


class Connection(StrEnum):
    """How a body is attached to its parent."""

    ROOT = "root"
    CUT = "cut"
    ROTARY = "rotary"
    PRISMATIC = "prismatic"


@dataclass(frozen=True, slots=True, kw_only=True)
class Coordinate:
    """Where a body's joint coordinate comes from: `multiplier * q[joint] + offset`."""

    joint: str
    """Joint whose measured position is used; the leader where the body's joint mimics."""
    multiplier: float = 1.0
    """Ratio to the measured position."""
    offset: float = 0.0
    """Value where the measured position is zero; rad or m."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Body:
    """Links lumped to one rigid body."""

    parent: int
    """Index of the parent body, smaller than its own; -1 for the root."""
    connection: Connection
    """How it is attached to its parent."""
    joint: str | None
    """Joint to its parent; None for the root and for a cut."""
    coordinate: Coordinate | None
    """Coordinate of its joint; None for the root and for a cut."""
    parent_R_joint: FloatArray
    """Joint frame's axes in the parent body; shape (3, 3)."""
    parent_p_joint: FloatArray
    """Joint frame's origin in the parent body at coordinate zero; shape (3,); m."""
    inertia: Inertia
    """Inertia in and about the body's frame."""
    links: tuple[str, ...]
    """Links that it is made of."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SensorCut:
    """Where a force-torque sensor cuts the tree."""

    body: int
    """Body just outboard of the sensor."""
    body_H_sensor: FloatArray
    """Frame of the reading in that body; shape (4, 4); m."""
    sign: float
    """Factor from `S` (inboard on outboard) to the reading."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BodyTree(ArrayRecord):
    """A robot's bodies, parents before children."""

    root_link: str
    """Link whose frame is the root body's frame."""
    bodies: tuple[Body, ...]
    """Bodies, every parent before its children."""
    frames: Mapping[str, tuple[int, FloatArray]] = field(metadata=mapping())
    """Body of every link, and `body_H_link`, its pose in that; shape (4, 4); m."""
    inertias: Mapping[str, Inertia] = field(metadata=mapping())
    """Inertia of every link, in and about the link's frame."""
    cuts: Mapping[str, SensorCut] = field(metadata=mapping())
    """Cut of every sensor in a fixed joint, by the sensor's name."""


def build_tree(model: RobotModel, root_link: str) -> BodyTree:
    """Lump a robot to bodies as seen from one link.

    Args:
        model: The robot.
        root_link: Link to start from.

    Returns:
        The tree, cut at every sensor that sits in a fixed joint.

    Raises:
        RobotError: If the robot has no such link, or joints mimic each other in a circle.
    """
    require_known(root_link, model.links, RobotError, f"robot {model.name!r} has no link {root_link!r}")
    return _tree(model, root_link)


@lru_cache(maxsize=_TREES)
def _tree(model: RobotModel, root_link: str) -> BodyTree:
    builder = _Builder(model)
    builder.add_root(root_link)
    neighbours: dict[str, list[Joint]] = {link: [] for link in model.links}
    for joint in model.joints.values():
        neighbours[joint.parent].append(joint)
        neighbours[joint.child].append(joint)
    waiting = [root_link]
    while waiting:
        link = waiting.pop()
        for joint in neighbours[link]:
            other = joint.child if joint.parent == link else joint.parent
            if other not in builder.frames:
                builder.cross(joint, downwards=joint.parent == link)
                waiting.append(other)
    return builder.finish(root_link)


class _Builder:
    """Collects bodies while the links are walked; inertias are added up as links come in."""

    def __init__(self, model: RobotModel) -> None:
        self.model = model
        self.cut_joints = {sensor.joint for sensor in model.sensors.values()}
        self.frames: dict[str, tuple[int, FloatArray]] = {}
        self.shells: list[Body] = []
        self.inertias: list[Inertia] = []
        self.links: list[list[str]] = []

    def add_root(self, link: str) -> None:
        self._place(link, self._new_body(-1, Connection.ROOT, None, None, np.eye(4)), np.eye(4))

    def cross(self, joint: Joint, *, downwards: bool) -> None:
        """Add the link on the other side of a joint."""
        here, there = (joint.parent, joint.child) if downwards else (joint.child, joint.parent)
        body, body_H_here = self.frames[here]
        here_H_there = joint.parent_H_child if downwards else invert_pose(joint.parent_H_child)
        if not joint.type.moves:
            if joint.name in self.cut_joints:
                body = self._new_body(body, Connection.CUT, None, None, np.eye(4))
            self._place(there, body, body_H_here @ here_H_there)
            return
        # seen from the child the parent turns the other way, about the child frame's own origin
        axis = joint.axis if downwards else -joint.axis
        child_H_joint = make_pose(rotation_with_z_along(axis), np.zeros(3))
        here_H_child = joint.parent_H_child if downwards else np.eye(4)
        child_H_there = np.eye(4) if downwards else here_H_there
        connection = Connection.PRISMATIC if joint.type is JointType.PRISMATIC else Connection.ROTARY
        body_H_joint = body_H_here @ here_H_child @ child_H_joint
        moved = self._new_body(body, connection, joint.name, self._coordinate(joint), body_H_joint)
        self._place(there, moved, invert_pose(child_H_joint) @ child_H_there)

    def finish(self, root_link: str) -> BodyTree:
        bodies = tuple(
            replace(shell, inertia=inertia, links=tuple(links))
            for shell, inertia, links in zip(self.shells, self.inertias, self.links, strict=True)
        )
        fixed = (s for s in self.model.sensors.values() if not self.model.joints[s.joint].type.moves)
        cuts = {sensor.name: self._cut(sensor) for sensor in fixed}
        return BodyTree(root_link=root_link, bodies=bodies, frames=self.frames, inertias=self.model.links, cuts=cuts)

    def _new_body(
        self,
        parent: int,
        connection: Connection,
        joint: str | None,
        coordinate: Coordinate | None,
        parent_H_joint: FloatArray,
    ) -> int:
        rotation, position = split_pose(_shared(parent_H_joint))
        self.shells.append(
            Body(
                parent=parent,
                connection=connection,
                joint=joint,
                coordinate=coordinate,
                parent_R_joint=rotation,
                parent_p_joint=position,
                inertia=Inertia.zero(),
                links=(),
            )
        )
        self.inertias.append(Inertia.zero())
        self.links.append([])
        return len(self.shells) - 1

    def _place(self, link: str, body: int, body_H_link: FloatArray) -> None:
        self.frames[link] = (body, _shared(body_H_link))
        self.inertias[body] += self.model.links[link].expressed_in(body_H_link)
        self.links[body].append(link)

    def _coordinate(self, joint: Joint) -> Coordinate:
        multiplier, offset, seen = 1.0, 0.0, [joint.name]
        while joint.mimic is not None:
            mimic = joint.mimic
            offset += multiplier * mimic.offset
            multiplier *= mimic.multiplier
            if mimic.leader in seen:
                raise RobotError(
                    f"joint {seen[0]!r}: expected it to mimic a free joint, got {' -> '.join(seen)} -> "
                    f"{mimic.leader}, a circle"
                )
            if mimic.leader not in self.model.joints:
                # a dangling leader is an error only where the coordinate is asked for
                return Coordinate(joint=mimic.leader, multiplier=multiplier, offset=offset)
            seen.append(mimic.leader)
            joint = self.model.joints[mimic.leader]
        return Coordinate(joint=joint.name, multiplier=multiplier, offset=offset)

    def _cut(self, sensor: ForceTorqueSensor) -> SensorCut:
        joint = self.model.joints[sensor.joint]
        child_body, body_H_child = self.frames[joint.child]
        parent_body, body_H_parent = self.frames[joint.parent]
        child_is_outboard = self.shells[child_body].parent == parent_body
        frames = {
            SensorFrame.CHILD: body_H_child,
            SensorFrame.PARENT: body_H_parent,
            SensorFrame.SENSOR: body_H_child @ sensor.child_H_sensor,
        }
        return SensorCut(
            body=child_body if child_is_outboard else parent_body,
            body_H_sensor=frames[sensor.frame],  # both halves of a cut share the body's frame
            sign=reading_sign(sensor.direction, child_is_outboard=child_is_outboard),
        )


def _shared(pose: FloatArray) -> FloatArray:
    """A pose of a tree that is shared and so read-only."""
    pose.setflags(write=False)
    return pose


def needed_bodies(tree: BodyTree, sensors: Sequence[str]) -> tuple[BoolArray, BoolArray]:
    """Find the bodies that the expected wrenches of some sensors depend on.

    Outboard bodies without inertia that carry none further out are left out, so their joints may
    be absent from a log.

    Args:
        tree: The robot.
        sensors: Names of the sensors.

    Returns:
        Bodies whose motion is needed, and among them those whose net wrench is; each of shape (bodies,).

    Raises:
        RobotError: If a sensor is not in the tree.
    """
    count = len(tree.bodies)
    outboard = np.zeros(count, dtype=bool)
    for name in sensors:
        require_known(name, tree.cuts, RobotError, f"no force-torque sensor {name!r} at a fixed joint")
        outboard[tree.cuts[name].body] = True
    has_weight = np.array([not body.inertia.is_zero for body in tree.bodies])
    for index, body in enumerate(tree.bodies):
        outboard[index] |= body.parent >= 0 and outboard[body.parent]
    for index in reversed(range(1, count)):
        has_weight[tree.bodies[index].parent] |= has_weight[index]
    weighing = outboard & has_weight
    moving = weighing.copy()
    for index in reversed(range(1, count)):
        moving[tree.bodies[index].parent] |= moving[index]
    return moving, weighing


def required_joints(tree: BodyTree, sensor: str) -> tuple[str, ...]:
    """Name the joints whose motion a sensor's expected wrench depends on.

    Args:
        tree: The robot, rooted where the motion is known.
        sensor: Name of the sensor.

    Returns:
        Joints, each once, from the root outwards; leaders instead of joints that mimic.

    Raises:
        RobotError: If the sensor is not in the tree.
    """
    moving, _ = needed_bodies(tree, [sensor])
    needed = (body.coordinate for body, moves in zip(tree.bodies, moving, strict=True) if moves)
    return tuple(dict.fromkeys(coordinate.joint for coordinate in needed if coordinate is not None))


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
    require_known(sensor, tree.cuts, RobotError, f"no force-torque sensor {sensor!r} at a fixed joint")
    return tree.cuts[sensor].body


def outboard_bodies(tree: BodyTree, body: int) -> BoolArray:
    """Mark a body and its distal bodies.

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


def joint_range(model: RobotModel, tree: BodyTree, joint: str, *, margin: float) -> tuple[float, float]:
    """Give the range of a free joint inside its limits.

    A joint that turns further than half a turn from zero, or without end, is kept to half a turn: all
    orientations lie in it. Joints that mimic it stay in their limits too.

    Args:
        model: The robot.
        tree: The same robot, rooted anywhere.
        joint: The joint.
        margin: Share of the range that is left out at either end.

    Returns:
        Lowest and highest position; rad or m.

    Raises:
        RobotError: If the limits are missing, or no position is inside all of them.
    """
    low, high = _position_limits(model, joint)
    for body in tree.bodies:
        follows = body.coordinate is not None and body.coordinate.joint == joint and body.joint != joint
        if not follows or body.joint is None or body.coordinate is None or body.coordinate.multiplier == 0.0:
            continue
        bounds = (
            (bound - body.coordinate.offset) / body.coordinate.multiplier
            for bound in _position_limits(model, body.joint)
        )
        lowest, highest = sorted(bounds)
        low, high = max(low, lowest), min(high, highest)
    if not low <= high:
        raise RobotError(
            f"joint {joint!r}: expected a lower limit below the upper one, also by the joints that mimic it, got "
            f"{low:g} to {high:g}; name the range: ranges={{{joint!r}: (low, high)}}"
        )
    left_out = margin * (high - low)
    return low + left_out, high - left_out


def _position_limits(model: RobotModel, name: str) -> tuple[float, float]:
    joint = model.joints[name]
    if joint.type is JointType.CONTINUOUS:
        return -math.pi, math.pi
    limit = joint.limit
    if limit is None or limit.lower is None or limit.upper is None:
        raise RobotError(
            f"joint {name!r}: expected limits of its position in the URDF, it has none; "
            f"name the range: ranges={{{name!r}: (low, high)}}"
        )
    if joint.type is JointType.REVOLUTE and limit.lower < math.pi and limit.upper > -math.pi:
        return max(limit.lower, -math.pi), min(limit.upper, math.pi)
    return limit.lower, limit.upper


def joints_between(tree: BodyTree, link: str) -> tuple[str, ...]:
    """Name the joints between the root link and another.

    Args:
        tree: The robot.
        link: The other link.

    Returns:
        Joints from the root outwards; leaders instead of joints that mimic.

    Raises:
        RobotError: If the robot has no such link.
    """
    coordinates = (tree.bodies[index].coordinate for index in path_from_root(tree, link))
    return tuple(dict.fromkeys(coordinate.joint for coordinate in coordinates if coordinate is not None))


def path_from_root(tree: BodyTree, link: str) -> list[int]:
    """List the bodies from the root to that of a link.

    Args:
        tree: The robot.
        link: The link.

    Returns:
        Their indices, outwards.

    Raises:
        RobotError: If the robot has no such link.
    """
    require_known(link, tree.frames, RobotError, f"the robot has no link {link!r}")
    return list(reversed(path_to_root(tree, tree.frames[link][0])))
