# SPDX-License-Identifier: BSD-3-Clause
"""A question as arrays: what the compiled evaluator walks through, decided once for all samples."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.inertia import Inertia
from forcetorque.base.pose import split_pose
from forcetorque.robot.contacts import Contact
from forcetorque.robot.mechanics.estimated_quantities import QUESTIONS, Needs, Question, closed_form
from forcetorque.robot.sub_models import SubModel
from forcetorque.robot.tree import Connection, Coordinate, path_to_root


class Bodies(NamedTuple):
    """The tree; arrays of shape (bodies, ...)."""

    parent: IntArray
    motion: IntArray  # row set that holds its motion; both sides of a cut share one
    coordinate: IntArray  # -1 where it has no joint
    slides: BoolArray
    R: FloatArray
    p: FloatArray
    mass: FloatArray
    first_moment: FloatArray
    second_moment: FloatArray
    weighed: BoolArray  # whether it has an inertia and its wrench is needed
    blank: IntArray  # bodies whose wrench is needed and starts at zero
    multiplier: FloatArray  # per coordinate
    offset: FloatArray
    mimics: BoolArray


class Frames(NamedTuple):
    """Frames on bodies; arrays of shape (frames, ...)."""

    body: IntArray
    R: FloatArray
    p: FloatArray
    sign: FloatArray


class Sums(NamedTuple):
    """Which wrenches are added up, outermost bodies first."""

    expected: IntArray  # bodies, for expected readings
    expected_path: IntArray  # bodies from the root, itself excluded, to the one contact
    parts: IntArray  # bodies, inside sub-models
    residue: IntArray  # bodies that carry on what a sub-model leaves
    residue_part: IntArray  # per body of `residue` the sub-model that it is the base of, or -1


class Parts(NamedTuple):
    """Sub-models that are solved; arrays of shape (parts, ...)."""

    base: IntArray
    reading: IntArray  # index of the measured sensor at its base, -1 at the root
    closed: BoolArray  # one full wrench
    first: IntArray  # its contacts are `members[first:last]`
    last: IntArray
    column: IntArray  # of rank, condition and residual; -1 where not wanted
    members: IntArray  # indices of unknown contacts


class Contacts(NamedTuple):
    """Unknown contacts; arrays of shape (contacts, ...)."""

    unknowns: IntArray
    switched: BoolArray  # whether it is not there in every sample
    direction: FloatArray
    path: IntArray  # bodies from the touched one to below the base of its sub-model, -1 behind


class Links(NamedTuple):
    """Links with a net wrench; inertia in the frame of the body; arrays of shape (links, ...)."""

    mass: FloatArray
    first_moment: FloatArray
    second_moment: FloatArray


class Torques(NamedTuple):
    """Joints with a torque; arrays of shape (joints,)."""

    body: IntArray
    component: IntArray  # of the wrench across the joint
    inboard: BoolArray  # whether what a sub-model leaves passes through it


class Plan(NamedTuple):
    """Everything that the evaluator needs to know of a question."""

    bodies: Bodies
    sums: Sums
    parts: Parts
    contacts: Contacts
    torques: Torques
    links: Links
    contact_frames: Frames
    known_frames: Frames
    link_frames: Frames
    expected_frames: Frames
    measured_frames: Frames
    length_scale: float


@lru_cache(maxsize=QUESTIONS)
def plan_of(question: Question, needs: Needs, switched: frozenset[str]) -> tuple[Plan, tuple[str, ...]]:
    """Lay a question out as arrays.

    Args:
        question: The question.
        needs: What it depends on.
        switched: Contacts that are not there in every sample.

    Returns:
        The arrays, and the joint of every coordinate.
    """
    bodies, joints = _bodies(question, needs)
    sums, cuts = _sums(question, needs), question.tree.cuts
    plan = Plan(
        bodies=bodies,
        sums=sums,
        parts=_parts(question, needs),
        contacts=_contacts(question, switched),
        torques=_torques(question, sums),
        links=_links(question),
        contact_frames=_contact_frames(question, question.unknown),
        known_frames=_contact_frames(question, question.known),
        link_frames=_frames((*question.tree.frames[link], 1.0) for link in question.net_wrenches),
        expected_frames=_frames((cuts[s].body, cuts[s].body_H_sensor, cuts[s].sign) for s in question.expected),
        measured_frames=_frames((cuts[s].body, cuts[s].body_H_sensor, cuts[s].sign) for s in question.measured),
        length_scale=question.length_scale,
    )
    return plan, joints


def _bodies(question: Question, needs: Needs) -> tuple[Bodies, tuple[str, ...]]:
    bodies = question.tree.bodies
    motion, coordinate = np.zeros(len(bodies), dtype=np.int64), np.full(len(bodies), -1)
    coordinates: list[Coordinate] = []
    rows = 1
    for index, body in enumerate(bodies):
        if body.coordinate is None:
            motion[index] = motion[body.parent] if body.parent >= 0 else 0
        elif needs.moving[index]:
            motion[index], rows = rows, rows + 1
            coordinate[index] = len(coordinates)
            coordinates.append(body.coordinate)
    weighed = needs.carrying & np.array([not body.inertia.is_zero for body in bodies])
    layout = Bodies(
        parent=_integers(body.parent for body in bodies),
        motion=motion,
        coordinate=_integers(coordinate),
        slides=np.array([body.connection is Connection.PRISMATIC for body in bodies]),
        R=np.array([body.parent_R_joint for body in bodies]),
        p=np.array([body.parent_p_joint for body in bodies]),
        **_inertias([body.inertia for body in bodies]),
        weighed=weighed,
        blank=_integers(np.flatnonzero(needs.carrying & ~weighed)),
        multiplier=np.array([c.multiplier for c in coordinates], dtype=np.float64),
        offset=np.array([c.offset for c in coordinates], dtype=np.float64),
        mimics=np.array([(c.multiplier, c.offset) != (1.0, 0.0) for c in coordinates], dtype=bool),
    )
    return layout, tuple(c.joint for c in coordinates)


def _sums(question: Question, needs: Needs) -> Sums:
    tree = question.tree
    outermost_first = [int(i) for i in reversed(np.flatnonzero(needs.carrying)) if i > 0]
    cut_bodies = {tree.cuts[sensor].body for sensor in question.measured}
    bases = {part.base: index for index, part in enumerate(needs.solved) if part in needs.leaving}
    residue: set[int] = set()
    for base in bases:
        residue |= set(path_to_root(tree, base)) - {0}
    ordered = sorted(residue, reverse=True)
    return Sums(
        expected=_integers(outermost_first if question.expected else ()),
        expected_path=_integers(reversed(question.expected_path()[:-1])),
        parts=_integers(i for i in outermost_first if i not in cut_bodies),
        residue=_integers(ordered),
        residue_part=_integers(bases.get(i, -1) for i in ordered),
    )


def _parts(question: Question, needs: Needs) -> Parts:
    members: list[int] = []
    first, last = [], []
    for part in needs.solved:
        first.append(len(members))
        members += [question.unknown.index(contact) for contact in question.unknown_in(part)]
        last.append(len(members))
    wanted = question.layout.parts
    return Parts(
        base=_integers(part.base for part in needs.solved),
        reading=_integers(-1 if p.sensor is None else question.measured.index(p.sensor) for p in needs.solved),
        closed=np.array([closed_form(question, part) for part in needs.solved], dtype=bool),
        first=_integers(first),
        last=_integers(last),
        column=_integers(wanted.index(part.name) if part.name in wanted else -1 for part in needs.solved),
        members=_integers(members),
    )


def _contacts(question: Question, switched: frozenset[str]) -> Contacts:
    paths = [
        _path(question, part, contact)
        for contact in question.unknown
        for part in question.parts
        if contact in question.unknown_in(part)
    ]
    path = np.full((len(paths), max(map(len, paths), default=0) + 1), -1)
    for row, bodies in zip(path, paths, strict=True):
        row[: len(bodies)] = bodies
    directions = [np.zeros(3) if c.direction is None else c.direction for c in question.unknown]
    return Contacts(
        unknowns=_integers(len(contact.type.unknowns) for contact in question.unknown),
        switched=np.array([contact.name in switched for contact in question.unknown], dtype=bool),
        direction=np.array(directions, dtype=np.float64).reshape(-1, 3),
        path=np.ascontiguousarray(path, dtype=np.int64),
    )


def _path(question: Question, part: SubModel, contact: Contact) -> list[int]:
    path = path_to_root(question.tree, question.body_of(contact))
    return list(path[: path.index(part.base)])


def _torques(question: Question, sums: Sums) -> Torques:
    body_of = {body.joint: index for index, body in enumerate(question.tree.bodies) if body.joint is not None}
    bodies = [body_of[joint] for joint in question.torques]
    slides = [question.tree.bodies[index].connection is Connection.PRISMATIC for index in bodies]
    return Torques(
        body=_integers(bodies),
        component=_integers(2 if s else 5 for s in slides),
        inboard=np.isin(bodies, sums.residue),
    )


def _links(question: Question) -> Links:
    tree = question.tree
    return Links(
        **_inertias([tree.inertias[link].expressed_in(tree.frames[link][1]) for link in question.net_wrenches])
    )


def _inertias(inertias: Sequence[Inertia]) -> dict[str, FloatArray]:
    return {
        "mass": np.array([inertia.mass for inertia in inertias], dtype=np.float64),
        "first_moment": np.array([inertia.first_moment for inertia in inertias]).reshape(-1, 3),
        "second_moment": np.array([inertia.second_moment for inertia in inertias]).reshape(-1, 3, 3),
    }


def _contact_frames(question: Question, contacts: Sequence[Contact]) -> Frames:
    frames = question.tree.frames
    return _frames((frames[c.link][0], frames[c.link][1] @ c.link_H_contact, 1.0) for c in contacts)


def _frames(frames: Iterable[tuple[int, FloatArray, float]]) -> Frames:
    listed = list(frames)
    poses = np.array([pose for _, pose, _ in listed]).reshape(-1, 4, 4)
    rotation, position = split_pose(poses)
    return Frames(
        body=_integers(body for body, _, _ in listed),
        R=np.array(rotation, order="C"),
        p=np.array(position, order="C"),
        sign=np.array([sign for _, _, sign in listed], dtype=np.float64),
    )


def _integers(values: Iterable[Any]) -> IntArray:
    return np.array(list(values), dtype=np.int64)
