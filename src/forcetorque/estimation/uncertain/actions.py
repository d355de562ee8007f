# SPDX-License-Identifier: BSD-3-Clause
"""Everything that acts on a robot, each as what is given, what is unknown, and what may be wrong with it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.wrench import wrench_matrix
from forcetorque.estimation.uncertain.uncertainty import Uncertainty, square_root
from forcetorque.robot.contacts import Contact
from forcetorque.robot.mechanics.question import Question


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
    """Say what the actors do to which body: a sensor acts on what is outboard of it, and against what is inboard.

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
