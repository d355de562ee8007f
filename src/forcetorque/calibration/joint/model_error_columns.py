# SPDX-License-Identifier: BSD-3-Clause
"""What may be wrong with the robot model and the IMU, how far, and what that does to the equations of parts."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.pose import cross
from forcetorque.base.wrench import transform_wrench
from forcetorque.robot.dynamics import net_wrench
from forcetorque.robot.mechanics.sub_model_equations import (
    PartEquation,
    heavy_bodies,
    joints_of_cuts,
    joints_of_part,
    part_equations,
)
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import BodyTree, SubModel

ZERO: Final = "zero of "
"""How the name of the error of a joint begins."""
DELAY: Final = "delay of the readings of "
"""How the name of the delay of a recording begins."""
_STEP: Final = 1e-6
"""Step of numerical derivatives by joint positions; rad or m."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ModelTolerance:
    """How far a robot model may be from the robot, as standard deviations."""

    mass: float = 0.03
    """Of the mass of every body, relative."""
    centre_m: float = 0.003
    """Of every coordinate of its centre of mass; m."""
    joint_zero_rad: float = float(np.radians(0.5))
    """Of the zero of every joint; rad, or m for one that slides."""
    acceleration: float = 0.05
    """Of every component of what an accelerometer reads at rest, or of gravity in a still frame; m/s2."""
    delay_s: float = 0.005
    """Of the time by which the readings of a recording come later than the joints; s."""


EXACT: Final = ModelTolerance(mass=0.0, centre_m=0.0, joint_zero_rad=0.0, acceleration=0.0, delay_s=0.0)
"""A model that is taken to be exact."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ErrorTerm:
    """One number that the model may have wrong."""

    name: str
    """What it is, such as `mass of l_upper_leg`."""
    unit: str
    """Its unit; empty for a relative one."""
    deviation: float
    """Standard deviation before any data."""


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
    return tuple(term for term in _terms(tree, parts, weighed, tolerance) if term.deviation > 0.0)


def _terms(
    tree: BodyTree, parts: Sequence[SubModel], weighed: Sequence[SubModel], tolerance: ModelTolerance
) -> Iterator[ErrorTerm]:
    for part in weighed:
        for k in heavy_bodies(tree, part):
            yield ErrorTerm(name=_mass(tree, k), unit="", deviation=tolerance.mass)
    for part in parts:
        for k in heavy_bodies(tree, part):
            name = _name(tree, k)
            yield ErrorTerm(name=_mass(tree, k), unit="", deviation=tolerance.mass)
            for axis in "xyz":
                yield ErrorTerm(name=f"{axis} of centre of {name}", unit="m", deviation=tolerance.centre_m)
    of_cuts = (joint for part in weighed for joint in joints_of_cuts(tree, part))
    for joint in dict.fromkeys((*_joints(tree, parts), *of_cuts)):
        yield ErrorTerm(name=f"{ZERO}{joint}", unit="rad", deviation=tolerance.joint_zero_rad)
    for axis in "xyz":
        yield ErrorTerm(name=_acceleration(axis, tree), unit="m/s2", deviation=tolerance.acceleration)


def delay_terms(recordings: Sequence[str], tolerance: ModelTolerance) -> tuple[ErrorTerm, ...]:
    """List the delays of recordings.

    Args:
        recordings: Their names.
        tolerance: How long a delay may be.

    Returns:
        A term per recording; none where there can be no delay.
    """
    terms = (ErrorTerm(name=DELAY + name, unit="s", deviation=tolerance.delay_s) for name in dict.fromkeys(recordings))
    return tuple(term for term in terms if term.deviation > 0.0)


def body_columns(tree: BodyTree, equation: PartEquation) -> dict[str, FloatArray]:
    """Say what a unit of every error of bodies, and of the acceleration of the root, adds to the left side.

    Args:
        tree: The robot.
        equation: Equation of a part; n samples.

    Returns:
        By the name of the term; shape (n, 6); N, N m per unit.
    """
    columns: dict[str, FloatArray] = {}
    mass, moment = 0.0, np.zeros((len(equation.demand), 3))
    for k, state in equation.states.items():
        inertia, pose, name = tree.bodies[k].inertia, equation.poses[k], _name(tree, k)
        columns[_mass(tree, k)] = -transform_wrench(pose, net_wrench(inertia, state))
        omega, alpha, proper = state.angular_velocity, state.angular_acceleration, state.proper_acceleration
        for axis, unit in zip("xyz", inertia.mass * np.eye(3), strict=True):
            force = cross(alpha, unit) + cross(omega, cross(omega, unit))
            columns[f"{axis} of centre of {name}"] = -transform_wrench(
                pose, np.concatenate([force, cross(unit, proper)], axis=1)
            )
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


def mass_shares(tree: BodyTree, part: SubModel, terms: Sequence[ErrorTerm]) -> FloatArray:
    """Say which share of the mass of a part every error scales.

    Args:
        tree: The robot.
        part: The part.
        terms: Errors of the model.

    Returns:
        Shares, of errors of masses of its bodies; zero for all others; shape (terms,).
    """
    masses = {_mass(tree, k): tree.bodies[k].inertia.mass for k in heavy_bodies(tree, part)}
    total = sum(masses.values())
    return np.array([masses.get(term.name, 0.0) / total if total else 0.0 for term in terms])


def _mass(tree: BodyTree, k: int) -> str:
    return f"mass of {_name(tree, k)}"


def _acceleration(axis: str, tree: BodyTree) -> str:
    return f"{axis} of acceleration of {tree.root_link}"


def _name(tree: BodyTree, k: int) -> str:
    """Name a body by the heaviest of its links."""
    return max(tree.bodies[k].links, key=lambda link: tree.inertias[link].mass)


def _joints(tree: BodyTree, parts: Sequence[SubModel]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(joint for part in parts for joint in joints_of_part(tree, part)))
