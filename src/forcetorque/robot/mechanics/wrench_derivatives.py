# SPDX-License-Identifier: BSD-3-Clause
"""Derivatives of the wrench that moves a part, and of what the sensor at its base must read, by bodies and joints.

All is evaluated along the axes of the root link and about its origin. A joint that is elsewhere turns all that is
outboard of it, and with that the motion inboard of it is seen in other axes from there. With the motion vector s of the
joint, and the velocity v and acceleration a of the body inboard of it, the derivative of the wrench that moves the
bodies outboard of it is, in spatial vectors [1],

    I (a x s + v x (v x s)) + 2 B (v x s) + s x* wrench

with the inertia I of these bodies; B is half of the derivative of their Coriolis wrench by a common velocity, of which
the momentum and the first moment of momentum are enough. The last term is left out for a joint inboard of the sensor,
which turns with the wrench.

Arrays here are component first, (3, n), so that every operation runs along samples.

References:
    [1] S. Singh, R. P. Russell, P. M. Wensing, Efficient analytical derivatives of rigid-body dynamics using spatial
        vector algebra, IEEE Robotics and Automation Letters 7 (2022), equation 20.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.inertia import Inertia
from forcetorque.robot.dynamics import stacked_root
from forcetorque.robot.mechanics.sub_model_equations import heavy_bodies, joints_of_part
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.sub_models import SubModel
from forcetorque.robot.tree import Body, BodyTree, Connection, path_to_root


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PartDerivatives:
    """Derivatives of a wrench in n samples; shape (6, n) each; N, N m."""

    bodies: dict[int, FloatArray]
    """By the mass of a body, relative to it, and by the place of its centre (m) along the axes of a link; shape
    (1 + CENTRES, 6, n)."""
    joints: dict[str, FloatArray]
    """By the position of a joint; per rad or m."""
    acceleration: FloatArray
    """By the acceleration of the root; shape (3, 6, n); per m/s2."""


def part_derivatives(
    tree: BodyTree,
    part: SubModel,
    joints: JointMotion,
    root: RootMotion,
    *,
    bare: BodyTree,
    axes: dict[int, FloatArray],
    turned: Sequence[str],
) -> PartDerivatives:
    """Differentiate what the sensor at the base of a part must read.

    Args:
        tree: The robot.
        part: A part of it, with a sensor at its base and no other.
        joints: Motion of at least the joints that it needs (`joints_of_part`); n samples.
        root: Motion of the root link's frame; one sample or n.
        bare: The same robot with the masses and centres by which is differentiated.
        axes: Axes in the frame of the body along which its centre is moved, by the index of the body; shape (3, 3).
        turned: Joints by whose positions is differentiated.

    Returns:
        The derivatives, in the sensor's frame and direction.

    Raises:
        ValueError: If the part has no sensor at its base.
    """
    if part.sensor is None:
        raise ValueError(f"{part.name}: expected a part with a sensor at its base, got that of the root")
    cut = tree.cuts[part.sensor]
    needed = _paths(tree, [*heavy_bodies(tree, part), cut.body])
    motions = _motions(tree, needed, joints, stacked_root(root, len(joints)).transpose(0, 2, 1))
    # the sensor turns with the joints inboard of it
    found = _derivatives(tree, part, motions, bare, axes, turned, carried=frozenset(path_to_root(tree, cut.body)))
    at_sensor = _Sensor(motions[cut.body], cut.body_H_sensor, cut.sign)
    return PartDerivatives(
        bodies={k: np.stack([at_sensor.reads(one) for one in columns]) for k, columns in found.bodies.items()},
        joints={name: at_sensor.reads(column) for name, column in found.joints.items()},
        acceleration=np.stack([at_sensor.reads(column) for column in found.acceleration]),
    )


def demand_derivatives(
    tree: BodyTree, part: SubModel, joints: JointMotion, root: RootMotion, *, axes: dict[int, FloatArray]
) -> PartDerivatives:
    """Differentiate the wrench that moves the bodies of a part.

    Args:
        tree: The robot.
        part: Any part of it.
        joints: Motion of at least the joints that it needs (`joints_of_part`); n samples.
        root: Motion of the root link's frame; one sample or n.
        axes: As of `part_derivatives`, of all its bodies with a mass.

    Returns:
        The derivatives by its bodies, by all joints that it needs, and by the acceleration, along
        the axes of the root link and about its origin.
    """
    heavy, turned = heavy_bodies(tree, part), joints_of_part(tree, part)
    if not heavy:
        nothing = np.zeros((6, len(joints)))
        return PartDerivatives(bodies={}, joints=dict.fromkeys(turned, nothing), acceleration=np.stack([nothing] * 3))
    motions = _motions(tree, _paths(tree, heavy), joints, stacked_root(root, len(joints)).transpose(0, 2, 1))
    return _derivatives(tree, part, motions, tree, axes, turned, carried=frozenset())


def _paths(tree: BodyTree, bodies: Iterable[int]) -> list[int]:
    return sorted({k for body in bodies for k in path_to_root(tree, body)})


def _derivatives(
    tree: BodyTree,
    part: SubModel,
    motions: dict[int, _Motion],
    bare: BodyTree,
    axes: dict[int, FloatArray],
    turned: Sequence[str],
    *,
    carried: frozenset[int],
) -> PartDerivatives:
    """Along the axes of the root link; axes that joints of `carried` bodies turn are taken to turn with the wrench."""
    own = {k: _Bodies.of(tree.bodies[k].inertia, motions[k]) for k in heavy_bodies(tree, part)}
    outboard = _outboard(tree, own)
    whole = outboard[0]
    of_joints = {name: np.zeros_like(whole.wrench) for name in turned}
    for k in outboard:
        body = tree.bodies[k]
        if body.coordinate is None or body.coordinate.joint not in of_joints:
            continue
        change = _moved(body, motions[body.parent], motions[k], outboard[k], turns_wrench=k not in carried)
        of_joints[body.coordinate.joint] += body.coordinate.multiplier * change
    pushed = [
        np.concatenate([np.broadcast_to(whole.mass * unit, whole.moment.shape), _cross(whole.moment, unit)])
        for unit in np.eye(3)[:, :, None]
    ]
    return PartDerivatives(
        bodies={k: np.stack(_by_body(bare.bodies[k].inertia, motions[k], axes[k])) for k in axes},
        joints=of_joints,
        acceleration=np.stack(pushed),
    )


@dataclass(frozen=True, slots=True, eq=False)
class _Motion:
    """Where a body is and how it moves; its velocity is that against the origin of the root link."""

    rotation: FloatArray
    """Shape (3, 3, n)."""
    origin: FloatArray
    velocity: FloatArray
    """Of its origin."""
    angular_velocity: FloatArray
    angular_acceleration: FloatArray
    proper_acceleration: FloatArray
    """Of its origin."""

    @property
    def spatial_velocity(self) -> tuple[FloatArray, FloatArray]:
        """Linear part, of the point at the origin of the root link, and angular part."""
        return self.velocity - _cross(self.angular_velocity, self.origin), self.angular_velocity

    @property
    def spatial_acceleration(self) -> tuple[FloatArray, FloatArray]:
        """The same of the acceleration."""
        turning = _cross(self.angular_acceleration, self.origin) + _cross(self.angular_velocity, self.velocity)
        return self.proper_acceleration - turning, self.angular_acceleration


def _motions(tree: BodyTree, bodies: Iterable[int], joints: JointMotion, root: FloatArray) -> dict[int, _Motion]:
    motions: dict[int, _Motion] = {}
    for k in bodies:
        body = tree.bodies[k]
        if body.parent < 0:
            omega, alpha, proper = root
            none = np.zeros_like(omega)
            rotation = np.repeat(np.eye(3)[:, :, None], omega.shape[1], axis=2)
            motions[k] = _Motion(rotation, none, none, omega, alpha, proper)
        else:
            motions[k] = _across(body, motions[body.parent], joints)
    return motions


def _across(body: Body, inboard: _Motion, joints: JointMotion) -> _Motion:
    """Carry the motion of a body's parent across its joint."""
    if body.coordinate is None:  # a cut: the same rigid body
        return inboard
    column, factor = joints.names.index(body.coordinate.joint), body.coordinate.multiplier
    q = factor * joints.position[:, column] + body.coordinate.offset
    dq, ddq = factor * joints.velocity[:, column], factor * joints.acceleration[:, column]
    rotation = np.einsum("ijn,jk->ikn", inboard.rotation, body.parent_R_joint)
    axis, offset = rotation[:, 2], _turned(inboard.rotation, body.parent_p_joint[:, None])
    rotary = body.connection is Connection.ROTARY
    if rotary:
        cosine, sine = np.cos(q), np.sin(q)
        x, y = rotation[:, 0], rotation[:, 1]
        rotation = np.stack([cosine * x + sine * y, cosine * y - sine * x, axis], axis=1)
    else:
        offset = offset + q * axis
    omega, alpha = inboard.angular_velocity, inboard.angular_acceleration
    carried = _cross(omega, offset)
    velocity = inboard.velocity + carried
    proper = inboard.proper_acceleration + _cross(alpha, offset) + _cross(omega, carried)
    along, turning = dq * axis, _cross(omega, dq * axis)
    if rotary:
        omega, alpha = omega + along, alpha + turning + ddq * axis
    else:
        velocity, proper = velocity + along, proper + 2.0 * turning + ddq * axis
    return _Motion(rotation, inboard.origin + offset, velocity, omega, alpha, proper)


@dataclass(frozen=True, slots=True, eq=False)
class _Bodies:
    """What bodies are together."""

    mass: float
    moment: FloatArray
    """Mass times position; shape (3, n)."""
    square: FloatArray
    """Mass times position times position; shape (3, 3, n)."""
    momentum: FloatArray
    """Mass times velocity; shape (3, n)."""
    virial: FloatArray
    """Mass times position times velocity; shape (3, 3, n)."""
    wrench: FloatArray
    """What moves them; shape (6, n)."""

    def __add__(self, other: _Bodies) -> _Bodies:
        return _Bodies(*(getattr(self, name) + getattr(other, name) for name in self.__slots__))

    @classmethod
    def of(cls, inertia: Inertia, motion: _Motion) -> _Bodies:
        mass, rotation, origin = inertia.mass, motion.rotation, motion.origin
        linear, omega = motion.spatial_velocity
        arm = _turned(rotation, inertia.first_moment[:, None])
        about_body = _about_body(inertia, motion)
        crossed = arm[:, None] * origin[None]
        square = about_body + crossed + crossed.transpose(1, 0, 2) + mass * origin[:, None] * origin[None]
        moment = arm + mass * origin
        return cls(
            mass,
            moment,
            square,
            mass * linear + _cross(omega, moment),
            moment[:, None] * linear[None] + _cross(omega[:, None], square).transpose(1, 0, 2),
            _net_wrench(mass, arm, about_body, motion),
        )


def _about_body(inertia: Inertia, motion: _Motion) -> FloatArray:
    """Mass times position times position about the origin of the body; shape (3, 3, n)."""
    # of the inertia tensor, which is the sum of m (r.r - r r^T)
    square = 0.5 * np.trace(inertia.second_moment) * np.eye(3) - inertia.second_moment
    return np.asarray(np.einsum("ijn,kjn->ikn", np.einsum("ijn,jk->ikn", motion.rotation, square), motion.rotation))


def _net_wrench(mass: float, arm: FloatArray, about_body: FloatArray, motion: _Motion) -> FloatArray:
    """What makes a body move as it does; shape (6, n)."""
    omega, alpha, proper = motion.angular_velocity, motion.angular_acceleration, motion.proper_acceleration
    trace = np.trace(about_body)
    force = mass * proper + _cross(alpha, arm) + _cross(omega, _cross(omega, arm))
    spin = trace * omega - _turned(about_body, omega)
    couple = trace * alpha - _turned(about_body, alpha) + _cross(omega, spin) + _cross(arm, proper)
    return np.concatenate([force, couple + _cross(motion.origin, force)])


def _outboard(tree: BodyTree, own: dict[int, _Bodies]) -> dict[int, _Bodies]:
    """All bodies outboard of every body, itself included."""
    sums = dict(own)
    for k in sorted({index for body in own for index in path_to_root(tree, body)}, reverse=True):
        parent = tree.bodies[k].parent
        if parent >= 0:
            sums[parent] = sums[parent] + sums[k] if parent in sums else sums[k]
    return sums


def _moved(body: Body, inboard: _Motion, own: _Motion, bodies: _Bodies, *, turns_wrench: bool) -> FloatArray:
    """Derivative of the wrench that moves bodies outboard of a joint, by its coordinate; shape (6, n)."""
    axis = own.rotation[:, 2]
    rotary = body.connection is Connection.ROTARY
    joint = (_cross(own.origin, axis), axis) if rotary else (axis, np.zeros_like(axis))
    velocity = inboard.spatial_velocity
    rate = _motion_cross(velocity, joint)
    linear, angular = (
        first + second
        for first, second in zip(
            _motion_cross(inboard.spatial_acceleration, joint), _motion_cross(velocity, rate), strict=True
        )
    )
    turning = rate[1]
    force = bodies.mass * linear + _cross(angular, bodies.moment) + 2.0 * _cross(turning, bodies.momentum)
    couple = _cross(bodies.moment, linear) + np.trace(bodies.square) * angular - _turned(bodies.square, angular)
    couple += 2.0 * (np.trace(bodies.virial) * turning - _turned(bodies.virial.transpose(1, 0, 2), turning))
    if turns_wrench:
        force += _cross(joint[1], bodies.wrench[:3])
        couple += _cross(joint[1], bodies.wrench[3:]) + _cross(joint[0], bodies.wrench[:3])
    return np.concatenate([force, couple])


def _by_body(inertia: Inertia, motion: _Motion, axes: FloatArray) -> list[FloatArray]:
    """Derivatives of what moves a body by its mass and centre; shape (6, n) each."""
    omega, alpha, proper = motion.angular_velocity, motion.angular_acceleration, motion.proper_acceleration
    mass = inertia.mass
    arm = _turned(motion.rotation, inertia.first_moment[:, None])
    columns = [_net_wrench(mass, arm, _about_body(inertia, motion), motion)]
    for unit in mass * axes.T:
        arm = _turned(motion.rotation, unit[:, None])
        force = _cross(alpha, arm) + _cross(omega, _cross(omega, arm))
        columns.append(np.concatenate([force, _cross(arm, proper) + _cross(motion.origin, force)]))
    return columns


class _Sensor:
    """What a sensor reads of wrenches on what is outboard of it."""

    def __init__(self, motion: _Motion, body_H_sensor: FloatArray, sign: float) -> None:
        self._origin = motion.origin + _turned(motion.rotation, body_H_sensor[:3, 3:])
        self._into = sign * np.einsum("ijn,jk->kin", motion.rotation, body_H_sensor[:3, :3])

    def reads(self, wrench: FloatArray) -> FloatArray:
        force, couple = wrench[:3], wrench[3:] - _cross(self._origin, wrench[:3])
        return np.concatenate([_turned(self._into, force), _turned(self._into, couple)])


def _cross(first: FloatArray, second: FloatArray) -> FloatArray:
    """Cross products of vectors; shape (3, ..., n)."""
    (x, y, z), (u, v, w) = first, second
    # the shapes are the same in most calls, and `broadcast_shapes` takes as long as the product
    product = np.empty(first.shape if first.shape == second.shape else np.broadcast_shapes(first.shape, second.shape))
    for out, plus, minus in zip(product, ((y, w), (z, u), (x, v)), ((z, v), (x, w), (y, u)), strict=True):
        np.multiply(*plus, out=out)
        out -= minus[0] * minus[1]
    return product


def _turned(matrices: FloatArray, vectors: FloatArray) -> FloatArray:
    """Products of matrices, shape (3, 3, n), and vectors; shape (3, n)."""
    return np.asarray((matrices * vectors[None]).sum(axis=1), dtype=np.float64)


def _motion_cross(
    first: tuple[FloatArray, FloatArray], second: tuple[FloatArray, FloatArray]
) -> tuple[FloatArray, FloatArray]:
    """Cross products of motion vectors, each a linear and an angular part."""
    linear = _cross(first[1], second[0]) + _cross(first[0], second[1])
    return linear, _cross(first[1], second[1])
