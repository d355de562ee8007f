# SPDX-License-Identifier: BSD-3-Clause
"""Equations of the parts of a robot between its sensors, linear in what the sensors read (thesis 2.4).

    sum over sensors of X reading = demand            for every part that nothing touches

X carries a reading to the axes of the root link, about its origin, with the sign by which it acts on the part: what
the sensor at its base transmits comes in, what those at its other cuts transmit goes out. Demand is what moves the
bodies of the part as they move. Which link touches the world, and how, does not matter, as long as it is of another
part.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import EstimationError, RobotError, known_names, require_known
from forcetorque.base.pose import cross, make_pose
from forcetorque.base.wrench import transform_wrench, wrench_matrix
from forcetorque.robot.dynamics import BodyState, move_to, net_wrench, root_state, stacked_root
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.sub_models import SubModel, sub_models
from forcetorque.robot.tree import Body, BodyTree, Connection, path_to_root


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PartEquation:
    """The equation of one part in n samples, along the axes of the root link and about its origin."""

    part: SubModel
    """The part."""
    sensors: tuple[str, ...]
    """Its k sensors: that at its base, then those at its other cuts."""
    transmission: FloatArray
    """X of every sensor; shape (n, k, 6, 6)."""
    demand: FloatArray
    """What moves its bodies as they move; shape (n, 6); N, N m."""
    poses: dict[int, FloatArray]
    """`root_H_body` of all bodies between the root and it, and of its own; shape (n, 4, 4); m."""
    rows: FloatArray = field(default_factory=lambda: np.ones(6))
    """1 for a row that the equation has, 0 for one that is left out; shape (6,)."""

    def turned(self, tree: BodyTree, joint: str, readings: FloatArray) -> FloatArray:
        """Say how what the sensors transmit changes where a joint is elsewhere.

        Args:
            tree: The robot.
            joint: The joint.
            readings: What the sensors read; shape (n, k, 6); N, N m.

        Returns:
            Derivative of the sum of X reading by the position of the joint; shape (n, 6); N, N m per rad or m.
        """
        derivative = np.zeros_like(self.demand)
        wrenches = np.einsum("nkij,nkj->nki", self.transmission, readings)
        for k, sensor in enumerate(self.sensors):
            for index in path_to_root(tree, tree.cuts[sensor].body):
                body = tree.bodies[index]
                if body.coordinate is not None and body.coordinate.joint == joint:
                    derivative += body.coordinate.multiplier * _moved(body, self.poses[index], wrenches[:, k])
        return self.rows * derivative


def untouched_parts(tree: BodyTree, sensors: Sequence[str], touched: Sequence[str]) -> tuple[SubModel, ...]:
    """Cut a robot at its sensors and keep the parts that nothing touches.

    Args:
        tree: The robot, rooted at the link whose motion is known.
        sensors: Sensors that are read.
        touched: Links that touch, or may touch, the world.

    Returns:
        Parts with at least one sensor, inboard ones first.

    Raises:
        RobotError: If the robot has no such sensor or link.
        EstimationError: If every part is touched, or none has a sensor.
    """
    for link in touched:
        require_known(link, tree.frames, RobotError, f"touched: the robot has no link {link!r}")
    bodies = {tree.frames[link][0] for link in touched}
    parts = tuple(
        part for part in sub_models(tree, sensors) if sensors_of(part) and not bodies.intersection(part.bodies)
    )
    if not parts:
        raise EstimationError(
            f"no part of the robot between the sensors {', '.join(sensors)} is free of touch where "
            f"{', '.join(touched) or 'nothing'} touches; calibrate sensors that have an untouched part beside them"
        )
    return parts


def sensors_of(part: SubModel) -> tuple[str, ...]:
    """Name the sensors of a part.

    Returns:
        The sensor at its base, then those at its other cuts.
    """
    return ((part.sensor,) if part.sensor is not None else ()) + part.outboard_sensors


def heavy_bodies(tree: BodyTree, part: SubModel) -> list[int]:
    """List the bodies of a part that have inertia.

    Args:
        tree: The robot.
        part: The part.

    Returns:
        Their indices, parents before children.
    """
    return [k for k in part.bodies if not tree.bodies[k].inertia.is_zero]


def joints_of_part(tree: BodyTree, part: SubModel) -> tuple[str, ...]:
    """Name the joints whose motion the equation of a part needs.

    Args:
        tree: The robot.
        part: The part.

    Returns:
        Joints from the root outwards, each once; leaders instead of joints that mimic.
    """
    return joints_of_bodies(tree, _bodies(tree, part))


def joints_of_cuts(tree: BodyTree, part: SubModel) -> tuple[str, ...]:
    """Name the joints that tell where the sensors of a part are, which is all that its weight needs.

    Args:
        tree: The robot.
        part: The part.

    Returns:
        Joints from the root outwards, each once; leaders instead of joints that mimic.
    """
    return joints_of_bodies(tree, _paths(tree, _cuts(tree, part)))


def weight_equations(
    tree: BodyTree, parts: Sequence[SubModel], joints: JointMotion, root: RootMotion
) -> Iterator[PartEquation]:
    """Set up the force rows of the equations of parts at rest: what their sensors transmit is their weight.

    Where the bodies of a part are does not matter, so that their joints need not be known.

    Args:
        tree: The robot, rooted at the link whose motion is known.
        parts: Some of its parts.
        joints: Motion of at least the joints between its sensors (`joints_of_cuts`); n samples.
        root: Motion of the root link's frame; one sample or n.

    Yields:
        The equation of every part; moments are all 0.
    """
    forces = np.repeat([1.0, 0.0], 3)
    _, poses = _motion(tree, _paths(tree, [cut for part in parts for cut in _cuts(tree, part)]), joints, root)
    for part in parts:
        mass = sum(tree.bodies[k].inertia.mass for k in heavy_bodies(tree, part))
        demand = np.zeros((len(joints), 6))
        demand[:, :3] = mass * root.proper_acceleration
        names = sensors_of(part)
        transmission = np.stack([_transmission(tree, part, name, poses) for name in names], axis=1)
        yield PartEquation(
            part=part,
            sensors=names,
            transmission=forces[:, None] * transmission,
            demand=demand,
            poses=poses,
            rows=forces,
        )


def part_equations(
    tree: BodyTree, parts: Sequence[SubModel], joints: JointMotion, root: RootMotion
) -> Iterator[PartEquation]:
    """Set up the equations of parts.

    Args:
        tree: The robot, rooted at the link whose motion is known.
        parts: Some of its parts.
        joints: Motion of at least the joints that they need (`joints_of_part`); n samples.
        root: Motion of the root link's frame; one sample or n.

    Yields:
        The equation of every part.

    Raises:
        RobotError: If a joint that is needed is not in `joints`.
    """
    states, poses = _motion(tree, {k for part in parts for k in _bodies(tree, part)}, joints, root)
    for part in parts:
        names = sensors_of(part)
        heavy = heavy_bodies(tree, part)
        demand = np.zeros((len(joints), 6))
        for k in heavy:
            demand += transform_wrench(poses[k], net_wrench(tree.bodies[k].inertia, states[k]))
        yield PartEquation(
            part=part,
            sensors=names,
            transmission=np.stack([_transmission(tree, part, name, poses) for name in names], axis=1),
            demand=demand,
            poses={k: poses[k] for k in _bodies(tree, part)},
        )


def _moved(body: Body, root_H_body: FloatArray, wrench: FloatArray) -> FloatArray:
    """Derivative of wrenches that move with a body, by its joint; in the root frame, about its origin."""
    axis, origin = root_H_body[:, :3, 2], root_H_body[:, :3, 3]
    force = wrench[:, :3]
    if body.connection is Connection.PRISMATIC:
        return np.concatenate([np.zeros_like(force), cross(axis, force)], axis=1)
    turned = cross(axis, force)
    about_joint = wrench[:, 3:] - cross(origin, force)
    return np.concatenate([turned, cross(axis, about_joint) + cross(origin, turned)], axis=1)


def _transmission(tree: BodyTree, part: SubModel, sensor: str, poses: dict[int, FloatArray]) -> FloatArray:
    cut = tree.cuts[sensor]
    inwards = cut.sign if sensor == part.sensor else -cut.sign
    return inwards * wrench_matrix(poses[cut.body] @ cut.body_H_sensor)


def _bodies(tree: BodyTree, part: SubModel) -> list[int]:
    """Bodies whose motion a part needs, parents before children."""
    return _paths(tree, [*heavy_bodies(tree, part), *_cuts(tree, part)])


def joints_of_bodies(tree: BodyTree, bodies: Iterable[int]) -> tuple[str, ...]:
    """Name the joints that move some bodies, in their order.

    Args:
        tree: The robot.
        bodies: Indices of bodies.

    Returns:
        Each joint once.
    """
    coordinates = (tree.bodies[k].coordinate for k in bodies)
    return tuple(dict.fromkeys(coordinate.joint for coordinate in coordinates if coordinate is not None))


def _cuts(tree: BodyTree, part: SubModel) -> list[int]:
    return [tree.cuts[sensor].body for sensor in sensors_of(part)]


def _paths(tree: BodyTree, bodies: Iterable[int]) -> list[int]:
    """Bodies from the root to others, parents before children."""
    return sorted({k for body in bodies for k in path_to_root(tree, body)})


def _motion(
    tree: BodyTree, bodies: Iterable[int], joints: JointMotion, root: RootMotion
) -> tuple[dict[int, BodyState], dict[int, FloatArray]]:
    n = len(joints)
    base = stacked_root(root, n)
    states: dict[int, BodyState] = {}
    poses: dict[int, FloatArray] = {}
    for k in sorted(bodies):
        body = tree.bodies[k]
        if body.parent < 0:
            states[k], poses[k] = root_state(base), np.broadcast_to(np.eye(4), (n, 4, 4))
            continue
        if body.coordinate is not None and body.coordinate.joint not in joints.names:
            joint = body.coordinate.joint
            raise RobotError(
                f"the part that holds {body.links[0] if body.links else body.joint!r} needs joint {joint!r}, seen from "
                f"{tree.root_link!r}, which the motion lacks; {known_names(joint, joints.names)}"
            )
        states[k] = move_to(body, states[body.parent], joints, slice(None))
        rotation = np.broadcast_to(states[k].parent_R_body, (n, 3, 3))
        position = np.broadcast_to(states[k].parent_p_body, (n, 3))
        poses[k] = poses[body.parent] @ make_pose(rotation, position)
    return states, poses
