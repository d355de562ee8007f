# SPDX-License-Identifier: BSD-3-Clause
"""What may be wrong with the robot model and the IMU, how far, and what that does to the equations of parts."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from forcetorque.base.arrays import FloatArray
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
from forcetorque.robot.mechanics.sub_model_equations import heavy_bodies, joints_of_cuts, joints_of_part
from forcetorque.robot.mechanics.wrench_derivatives import PartDerivatives, demand_derivatives
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.sub_models import SubModel
from forcetorque.robot.tree import BodyTree, Connection


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
    sliding = sliding_joints(tree)
    of_cuts = (joint for part in weighed for joint in joints_of_cuts(tree, part))
    for joint in dict.fromkeys((*_joints(tree, parts), *of_cuts)):
        yield ErrorTerm(
            name=f"{ZERO}{joint}",
            kind=TermKind.POSITION if joint in sliding else TermKind.ZERO,
            deviation=tolerance.joints.get(joint, tolerance.joint_zero_rad),
        )
    for axis in "xyz":
        yield ErrorTerm(name=_acceleration(axis, tree), kind=TermKind.ACCELERATION, deviation=tolerance.acceleration)


def sliding_joints(tree: BodyTree) -> set[str]:
    """Name the joints that slide.

    Args:
        tree: The robot.

    Returns:
        Their names; not that of a joint that turns and that a sliding one mimics.
    """
    return {body.joint for body in tree.bodies if body.joint is not None and body.connection is Connection.PRISMATIC}


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


def model_error_columns(tree: BodyTree, part: SubModel, joints: JointMotion, root: RootMotion) -> dict[str, FloatArray]:
    """Say what a unit of every error of the model adds to the left side of the equation of a part by what it demands.

    Centres move along the axes of the heaviest link of a body, after which it is called.

    Args:
        tree: The robot.
        part: A part of it.
        joints: Motion of at least the joints that it needs; n samples.
        root: Motion of the root link's frame; one sample or n.

    Returns:
        By the name of the term; shape (n, 6); N, N m per unit.
    """
    axes = {k: link_axes(tree, k) for k in heavy_bodies(tree, part)}
    found = demand_derivatives(tree, part, joints, root, axes=axes)
    return {name: -values.T for name, values in columns_of_terms(tree, found).items()}


def columns_of_terms(tree: BodyTree, derivatives: PartDerivatives) -> dict[str, FloatArray]:
    """Name derivatives by the terms that they belong to.

    Args:
        tree: The robot.
        derivatives: Those of a part, by centres along axes of the links that name them.

    Returns:
        By the name of the term; shape (6, n) each.
    """
    columns = {f"{ZERO}{joint}": values for joint, values in derivatives.joints.items()}
    for k, by_body in derivatives.bodies.items():
        columns |= dict(zip(terms_of_body(tree, k), by_body, strict=True))
    return columns | dict(zip(terms_of_acceleration(tree), derivatives.acceleration, strict=True))


def weight_error_columns(tree: BodyTree, part: SubModel, root: RootMotion, samples: int) -> dict[str, FloatArray]:
    """The same of a part of which only the weight is asked, whose joints add nothing.

    Args:
        tree: The robot.
        part: A part of it.
        root: Motion of the root link's frame; one sample or n.
        samples: n.

    Returns:
        By the name of the term; shape (n, 6); N, N m per unit.
    """
    masses = {_mass(tree, k): tree.bodies[k].inertia.mass for k in heavy_bodies(tree, part)}
    pushes = dict(zip(terms_of_acceleration(tree), np.eye(3), strict=True))
    forces = {name: mass * root.proper_acceleration for name, mass in masses.items()}
    forces |= {name: sum(masses.values()) * unit for name, unit in pushes.items()}
    forces |= {f"{ZERO}{joint}": np.zeros(3) for joint in joints_of_cuts(tree, part)}
    columns = {name: np.zeros((samples, 6)) for name in forces}
    for name, force in forces.items():
        columns[name][:, :3] = -force
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
