# SPDX-License-Identifier: BSD-3-Clause
"""What may be wrong with the robot model and the IMU, how far, and what that does to the equations of parts."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.pose import cross
from forcetorque.base.wrench import transform_wrench
from forcetorque.experiment.calibration.robot_model_error import (
    ACCELERATION,
    CENTRE,
    DELAY,
    MASS,
    ZERO,
    ErrorTerm,
    ModelTolerance,
    TermKind,
)
from forcetorque.robot.dynamics import net_wrench
from forcetorque.robot.mechanics.sub_model_equations import (
    PartEquation,
    heavy_bodies,
    joints_of_cuts,
    joints_of_part,
    part_equations,
)
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import BodyTree, Connection, SubModel

_STEP: Final = 1e-6
"""Step of numerical derivatives by joint positions; rad or m."""


def error_terms(
    tree: BodyTree, parts: Sequence[SubModel], tolerance: ModelTolerance, *, weighed: Sequence[SubModel] = ()
) -> tuple[ErrorTerm, ...]:
    """List what the equations of parts depend on and may be wrong.

    Args:
        tree: The robot.
        parts: Its parts.
        tolerance: How far it may be.
        weighed: Parts of which only the weight is asked.

    Returns:
        Terms of bodies, then of joints, then of the acceleration of the root; none that cannot be wrong.
    """
    terms = (
        term.model_copy(update={"deviation": tolerance.found.get(term.name, term.deviation)})
        for term in _terms(tree, parts, weighed, tolerance)
    )
    return tuple(term for term in terms if term.deviation > 0.0)


def _terms(
    tree: BodyTree, parts: Sequence[SubModel], weighed: Sequence[SubModel], tolerance: ModelTolerance
) -> Iterator[ErrorTerm]:
    for part in weighed:
        for k in heavy_bodies(tree, part):
            yield _mass_term(tree, k, tolerance)
    for part in parts:
        for k in heavy_bodies(tree, part):
            name, mass = _name(tree, k), tree.bodies[k].inertia.mass
            yield _mass_term(tree, k, tolerance)
            for axis in "xyz":
                yield ErrorTerm(
                    name=f"{axis}{CENTRE}{name}", kind=TermKind.CENTRE, deviation=tolerance.centre_m, nominal=mass
                )
    sliding = {
        body.coordinate.joint
        for body in tree.bodies
        if body.coordinate is not None and body.connection is Connection.PRISMATIC
    }
    of_cuts = (joint for part in weighed for joint in joints_of_cuts(tree, part))
    for joint in dict.fromkeys((*_joints(tree, parts), *of_cuts)):
        yield ErrorTerm(
            name=f"{ZERO}{joint}",
            kind=TermKind.POSITION if joint in sliding else TermKind.ZERO,
            deviation=tolerance.joints.get(joint, tolerance.joint_zero_rad),
        )
    for axis in "xyz":
        yield ErrorTerm(name=_acceleration(axis, tree), kind=TermKind.ACCELERATION, deviation=tolerance.acceleration)


def _mass_term(tree: BodyTree, k: int, tolerance: ModelTolerance) -> ErrorTerm:
    body = tree.bodies[k]
    deviation, total = tolerance.mass, body.inertia.mass
    if not tolerance.links.keys().isdisjoint(body.links):
        # of links at fixed joints, each by its own tolerance
        errors = [tree.inertias[link].mass * tolerance.links.get(link, tolerance.mass) for link in body.links]
        deviation = float(np.linalg.norm(errors)) / total
    return ErrorTerm(name=_mass(tree, k), kind=TermKind.MASS, deviation=deviation, nominal=total)


def delay_terms(recordings: Sequence[str], tolerance: ModelTolerance) -> tuple[ErrorTerm, ...]:
    """List the delays of recordings.

    Args:
        recordings: Their names.
        tolerance: How long a delay may be.

    Returns:
        A term per recording; none where there can be no delay.
    """
    terms = (
        ErrorTerm(name=DELAY + name, kind=TermKind.DELAY, deviation=tolerance.delay_s)
        for name in dict.fromkeys(recordings)
    )
    return tuple(term for term in terms if term.deviation > 0.0)


def body_columns(tree: BodyTree, equation: PartEquation) -> dict[str, FloatArray]:
    """Say what a unit of every error of bodies, and of the acceleration of the root, adds to the left side.

    Centres move along the axes of the heaviest link of a body, after which it is called.

    Args:
        tree: The robot.
        equation: Equation of a part; n samples.

    Returns:
        By the name of the term; shape (n, 6); N, N m per unit.
    """
    columns: dict[str, FloatArray] = {}
    for k, state in equation.states.items():
        inertia, pose = tree.bodies[k].inertia, equation.poses[k]
        omega, alpha, proper = state.angular_velocity, state.angular_acceleration, state.proper_acceleration
        wrenches = [net_wrench(inertia, state)]
        for unit in inertia.mass * link_axes(tree, k).T:
            force = cross(alpha, unit) + cross(omega, cross(omega, unit))
            wrenches.append(np.concatenate([force, cross(unit, proper)], axis=1))
        at_root = -transform_wrench(pose[:, None], np.stack(wrenches, axis=1))
        columns |= {own: equation.rows * at_root[:, place] for place, own in enumerate(terms_of_body(tree, k))}
    return columns | acceleration_columns(tree, equation)


def acceleration_columns(tree: BodyTree, equation: PartEquation) -> dict[str, FloatArray]:
    """Say what a unit of every error of the acceleration of the root adds to the left side.

    Args:
        tree: The robot.
        equation: Equation of a part; n samples.

    Returns:
        By the name of the term; shape (n, 6); N, N m per m/s2.
    """
    columns: dict[str, FloatArray] = {}
    mass, moment = 0.0, np.zeros((len(equation.demand), 3))
    for k in equation.states:
        inertia, pose = tree.bodies[k].inertia, equation.poses[k]
        mass += inertia.mass
        moment = moment + pose[:, :3, :3] @ inertia.first_moment + inertia.mass * pose[:, :3, 3]
    for axis, unit in zip("xyz", np.eye(3), strict=True):
        force = np.broadcast_to(mass * unit, moment.shape)
        columns[_acceleration(axis, tree)] = -np.concatenate([force, cross(moment, unit)], axis=1)
    return {name: equation.rows * values for name, values in columns.items()}


def demand_columns(
    tree: BodyTree, parts: Sequence[SubModel], joints: JointMotion, root: RootMotion
) -> list[dict[str, FloatArray]]:
    """Say what the zeros of joints add to the left side by way of what the bodies demand.

    Args:
        tree: The robot.
        parts: Parts of it.
        joints: Motion of the joints; n samples.
        root: Motion of the root.

    Returns:
        For every part, by the name of the term; shape (n, 6); N, N m per rad or m.
    """
    columns: list[dict[str, FloatArray]] = [{} for _ in parts]
    before = [equation.demand for equation in part_equations(tree, parts, joints, root)]
    for joint in _joints(tree, parts):
        affected = [k for k, part in enumerate(parts) if joint in joints_of_part(tree, part)]
        again = part_equations(tree, [parts[k] for k in affected], joints.shifted({joint: _STEP}), root)
        for k, equation in zip(affected, again, strict=True):
            columns[k][f"{ZERO}{joint}"] = (before[k] - equation.demand) / _STEP
    return columns


def terms_of_body(tree: BodyTree, k: int) -> tuple[str, ...]:
    """Name the errors of a body: of its mass, then of its centre along three axes.

    Args:
        tree: The robot.
        k: Index of the body.

    Returns:
        Four names.
    """
    return _mass(tree, k), *(f"{axis}{CENTRE}{_name(tree, k)}" for axis in "xyz")


def link_axes(tree: BodyTree, k: int) -> FloatArray:
    """Give the axes along which the centre of a body is moved, those of its heaviest link.

    Args:
        tree: The robot.
        k: Index of the body.

    Returns:
        Axes in the frame of the body, one per column; shape (3, 3).
    """
    return np.asarray(tree.frames[_name(tree, k)][1][:3, :3])


def terms_of_acceleration(tree: BodyTree) -> tuple[str, ...]:
    """Name the errors of the acceleration of the root along three axes.

    Args:
        tree: The robot.

    Returns:
        Three names.
    """
    return tuple(_acceleration(axis, tree) for axis in "xyz")


def _mass(tree: BodyTree, k: int) -> str:
    return f"{MASS}{_name(tree, k)}"


def _acceleration(axis: str, tree: BodyTree) -> str:
    return f"{axis}{ACCELERATION}{tree.root_link}"


def _name(tree: BodyTree, k: int) -> str:
    """Name a body by the heaviest of its links."""
    return max(tree.bodies[k].links, key=lambda link: tree.inertias[link].mass)


def _joints(tree: BodyTree, parts: Sequence[SubModel]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(joint for part in parts for joint in joints_of_part(tree, part)))
