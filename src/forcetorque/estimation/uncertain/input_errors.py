# SPDX-License-Identifier: BSD-3-Clause
"""Errors of the inputs of an estimation, and everything that acts on a robot: given, unknown or uncertain."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Final

import numpy as np

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, array, check_arrays, require_shape
from forcetorque.base.errors import EstimationError, ShapeError
from forcetorque.base.wrench import wrench_matrix
from forcetorque.robot.contacts import Contact
from forcetorque.robot.mechanics.estimated_quantities import Question

SLIPPING: Final = 1.0 / np.sqrt(2.0)
"""Standard deviation of each tangential component, over friction coefficient times normal force, of a contact that
slips in an unknown direction: the most that friction allows, so a contact that holds is covered too."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Tangents(ArrayRecord):
    """The tangential force at a known contact, which is not part of its wrench."""

    maps: FloatArray = field(metadata=array("n", 6, 2))
    """Wrench in the contact frame of 1 N along either tangent, 0 where nothing touches; shape (n, 6, 2); N/N, N m/N."""
    sd_N: FloatArray | None = field(default=None, metadata=array("n"))
    """Standard deviation about zero of each component; None where nothing is known of it; shape (n,); N."""

    def __post_init__(self) -> None:
        check_arrays(self)
        if self.sd_N is not None and ((self.sd_N < 0.0).any() or np.isinf(self.sd_N).any()):
            raise ShapeError("tangents: sd_N: expected finite numbers of at least 0, or None where nothing is known")

    def of_samples(self, kept: slice | BoolArray) -> Tangents:
        """Keep some samples.

        Returns:
            The same in those.
        """
        return Tangents(maps=self.maps[kept], sd_N=None if self.sd_N is None else self.sd_N[kept])


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Uncertainty:
    """What is not known of inputs; what is not named is exact."""

    measured: Mapping[str, FloatArray] = field(default_factory=dict)
    """Covariance of readings, by sensor; shape (6, 6) or (n, 6, 6); N², N² m, N² m²."""
    known: Mapping[str, FloatArray] = field(default_factory=dict)
    """Covariance of known wrenches, by contact; shape (6, 6) or (n, 6, 6)."""
    lasting: Mapping[str, FloatArray] = field(default_factory=dict)
    """What one standard deviation of each of p further errors adds, by sensor or known contact: errors that stay the
    same from sample to sample, as an offset does; shape (6, p) or (n, 6, p); N, N m."""
    tangents: Mapping[str, Tangents] = field(default_factory=dict)
    """Tangential forces, by known contact; without it there is none."""


def tangent_maps(points: FloatArray, normals: FloatArray) -> FloatArray:
    """Compute the effect of tangential forces at points.

    Args:
        points: Where they act; NaN where nothing touches; shape (n, 3); m.
        normals: Unit normals there; shape (n, 3).

    Returns:
        Wrench of 1 N along two tangents at right angles, about the origin; 0 where nothing touches; shape (n, 6, 2).
    """
    there: BoolArray = np.all(np.isfinite(np.concatenate([points, normals], axis=1)), axis=1)
    unit = np.where(there[:, None], normals, [0.0, 0.0, 1.0])
    # the axis that is furthest from the normal
    axis = np.eye(3)[np.abs(unit).argmin(axis=1)]
    first = np.cross(unit, axis)
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    forces = np.stack([first, np.cross(unit, first)], axis=2)  # (n, 3, 2)
    moments = np.cross(np.where(there[:, None], points, 0.0)[:, :, None], forces, axis=1)
    return np.where(there[:, None, None], np.concatenate([forces, moments], axis=1), 0.0)


_ROUNDING: Final = 1e-9
"""Asymmetry and negative eigenvalues up to this share of the largest element are rounding: sums of products of doubles
err by some 1e-15."""


def wrench_covariances(values: Any, *, name: str, samples: int) -> FloatArray:
    """Check covariances of wrenches.

    Args:
        values: One for all samples, shape (6, 6), or one each, shape (n, 6, 6); NaN for a gap; N², N² m, N² m².
        name: What they are of, for messages.
        samples: Number of samples, n.

    Returns:
        One for each sample; shape (n, 6, 6).

    Raises:
        EstimationError: If one is infinite, not symmetric, or has a negative eigenvalue: then no error has it.
    """
    covariances = np.asarray(values, dtype=np.float64)
    if covariances.ndim == 2:
        covariances = covariances[None]
    if len(covariances) == 1:
        covariances = np.broadcast_to(covariances, (samples, *covariances.shape[1:]))
    require_shape(covariances, name=f"covariance of {name!r}", shape=(samples, 6, 6))
    largest = np.abs(covariances).max(axis=(1, 2), initial=0.0)
    _refuse(np.isinf(largest), name, "finite numbers, or NaN for a gap", largest)
    whole: BoolArray = np.all(np.isfinite(covariances), axis=(1, 2))
    safe = np.where(whole[:, None, None], covariances, 0.0)
    asymmetry = np.abs(safe - safe.transpose(0, 2, 1)).max(axis=(1, 2))
    _refuse(asymmetry > _ROUNDING * largest, name, "a symmetric matrix", asymmetry)
    smallest = np.linalg.eigvalsh(safe)[:, 0]
    _refuse(smallest < -_ROUNDING * largest, name, "no negative eigenvalue", smallest)
    return covariances


def square_root(covariance: FloatArray) -> FloatArray:
    """Give the symmetric matrix whose square is a covariance; also of one that has no inverse.

    Of all roots it alone changes no faster than the covariance, so that its columns may be errors that last.

    Args:
        covariance: Covariances; NaN for a gap; shape (..., k, k).

    Returns:
        Square roots, NaN where the covariance has one; shape (..., k, k).
    """
    whole = np.isfinite(covariance).all(axis=(-2, -1), keepdims=True)
    values, vectors = np.linalg.eigh(np.where(whole, covariance, 0.0))
    root: FloatArray = (vectors * np.sqrt(np.maximum(values, 0.0))[..., None, :]) @ np.swapaxes(vectors, -2, -1)
    return np.where(whole, root, np.nan)


def _refuse(bad: BoolArray, name: str, expected: str, values: FloatArray) -> None:
    if bad.any():
        sample = int(np.flatnonzero(bad)[0])
        raise EstimationError(
            f"covariance of {name!r}, sample {sample}: expected {expected}, got {values[sample]:.3g} "
            f"({np.count_nonzero(bad)} such samples); a covariance is the mean of products of errors with each other"
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Actor:
    """A contact or sensor, whose wrench in its own frame is `given + free x + errors e`, with e of unit variance."""

    name: str
    """Its name."""
    unknowns: tuple[str, ...]
    """Names of the components of x."""
    given: FloatArray
    """What is known; shape (n, 6); N, N m."""
    free: FloatArray
    """What the unknowns do, each in N or N m; shape (n, 6, u)."""
    errors: FloatArray
    """What errors do; shape (n, 6, m)."""
    lasting: int = 0
    """How many of the errors, the last ones, stay the same from sample to sample."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Action:
    """What an actor does to a body."""

    actor: int
    """Which one."""
    body: int
    """The body."""
    root_X_actor: FloatArray
    """Its wrench as what is done to the body, along the axes of the root link and about its origin; shape
    (n, 6, 6)."""


def actors_of(
    question: Question, measured: FloatArray, known: FloatArray, active: BoolArray, uncertainty: Uncertainty
) -> list[Actor]:
    """List what acts: unknown contacts, known ones, then sensors, each in the order of the question.

    Args:
        question: The question.
        measured: Readings; shape (n, sensors, 6); N, N m.
        known: Known wrenches; shape (n, known contacts, 6); N, N m.
        active: Whether each unknown contact is there; shape (n, unknown contacts).
        uncertainty: Checked covariances, one for each sample.

    Returns:
        The actors.
    """
    unknown = [_unknown(contact, active[:, k]) for k, contact in enumerate(question.unknown)]
    pushes = [_known(contact, known[:, k], uncertainty) for k, contact in enumerate(question.known)]
    sensors = [
        _actor(name, measured[:, k], _root_of(uncertainty.measured, name, len(measured)), uncertainty)
        for k, name in enumerate(question.measured)
    ]
    return [*unknown, *pushes, *sensors]


def actions_of(question: Question, poses: Mapping[int, FloatArray]) -> Iterator[Action]:
    """Give the actions of the actors on bodies: a sensor acts on its outboard side, and against its inboard side.

    Args:
        question: The question.
        poses: `root_H_body` of bodies that matter, by their index; shape (n, 4, 4); m.

    Yields:
        Actions on those bodies.
    """
    contacts = (*question.unknown, *question.known)
    for k, contact in enumerate(contacts):
        body, body_H_link = question.tree.frames[contact.link]
        if body in poses:
            matrix = wrench_matrix(poses[body] @ (body_H_link @ contact.link_H_contact))
            yield Action(actor=k, body=body, root_X_actor=matrix)
    for k, sensor in enumerate(question.measured):
        cut = question.tree.cuts[sensor]
        if cut.body in poses:
            matrix = cut.sign * wrench_matrix(poses[cut.body] @ cut.body_H_sensor)
            yield Action(actor=len(contacts) + k, body=cut.body, root_X_actor=matrix)
            yield Action(actor=len(contacts) + k, body=question.tree.bodies[cut.body].parent, root_X_actor=-matrix)


def _unknown(contact: Contact, active: BoolArray) -> Actor:
    n = len(active)
    free = np.where(active[:, None, None], contact.unknown_map(), 0.0)
    nothing, exact = np.zeros((n, 6)), np.zeros((n, 6, 0))
    return Actor(name=contact.name, unknowns=contact.type.unknowns, given=nothing, free=free, errors=exact)


def _known(contact: Contact, wrench: FloatArray, uncertainty: Uncertainty) -> Actor:
    errors = _root_of(uncertainty.known, contact.name, len(wrench))
    tangents = uncertainty.tangents.get(contact.name)
    if tangents is None:
        return _actor(contact.name, wrench, errors, uncertainty)
    if tangents.sd_N is None:
        pressed = _actor(contact.name, wrench, errors, uncertainty)
        return replace(pressed, unknowns=("s", "t"), free=tangents.maps)
    slanted = tangents.maps * tangents.sd_N[:, None, None]
    return _actor(contact.name, wrench, np.concatenate([errors, slanted], axis=2), uncertainty)


def _actor(name: str, given: FloatArray, errors: FloatArray, uncertainty: Uncertainty) -> Actor:
    n = len(given)
    lasting = uncertainty.lasting.get(name, np.zeros((n, 6, 0)))
    return Actor(
        name=name,
        unknowns=(),
        given=given,
        free=np.zeros((n, 6, 0)),
        errors=np.concatenate([errors, lasting], axis=2),
        lasting=lasting.shape[2],
    )


def _root_of(covariances: Mapping[str, FloatArray], name: str, n: int) -> FloatArray:
    return square_root(covariances[name]) if name in covariances else np.zeros((n, 6, 0))
