# SPDX-License-Identifier: BSD-3-Clause
"""Unknowns of a sub-model that its equation does not separate."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.robot.contacts import Wrenches
from forcetorque.robot.mechanics.inputs import activity_of, checked_inputs
from forcetorque.robot.mechanics.question import Question
from forcetorque.robot.mechanics.readable_evaluator import RANK_TOLERANCE, Block, body_states, contact_columns, weighted
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import SubModel

_POSES = 64
"""Poses that are looked at, evenly over the samples: which unknowns are inseparable depends on the pose alone."""

_PART = 1e-6
"""An unknown takes part in a motion that the equation does not see if this share of it does."""


def indistinguishable(
    question: Question, joints: JointMotion, *, active: Mapping[str, Any] | None = None
) -> dict[str, tuple[tuple[str, ...], ...]]:
    """Find unknowns that can trade off against each other without any reading changing.

    Args:
        question: The question.
        joints: Poses; motion of at least the joints that it depends on; n samples.
        active: By the name of an unknown contact, whether it is there; shape (n,), bool; others always are.

    Returns:
        By sub-model with such unknowns, groups of them, each named `contact.component`; in a group every one
        depends on another in some of the poses.
    """
    activity = activity_of(question, active, len(joints))
    picked = _picked(activity, switched=bool(active))
    poses = JointMotion.at_rest(joints.names, joints.position[picked])
    still = RootMotion(proper_acceleration=np.zeros(3), angular_velocity=np.zeros(3), angular_acceleration=np.zeros(3))
    nothing = {name: np.zeros((len(picked), 6)) for name in (*question.measured, *(c.name for c in question.known))}
    wrenches = Wrenches.of(nothing) if nothing else None
    switches = {name: np.asarray(marks)[picked] for name, marks in (active or {}).items()}
    inputs = checked_inputs(question, poses, still, wrenches, wrenches, switches)
    block = Block(
        joints=poses,
        root=np.zeros((3, len(picked), 3)),
        measured=np.zeros((len(picked), 0, 6)),
        known=np.zeros((len(picked), 0, 6)),
        active=activity[picked].astype(np.float64),
    )
    states = body_states(question, inputs.needs, block)
    ambiguous = {}
    for part in question.parts:
        if question.unknown_in(part):
            columns = contact_columns(question, part, states, block.active)
            groups = _groups(_hidden(weighted(columns, question, part)[0]), _names(question, part))
            if groups:
                ambiguous[part.name] = groups
    return ambiguous


def _picked(activity: BoolArray, *, switched: bool) -> IntArray:
    """Samples to look at: some evenly over all, and one of every combination of contacts."""
    n = len(activity)
    picked = np.unique(np.linspace(0, n - 1, min(n, _POSES)).astype(np.int64)) if n else np.empty(0, dtype=np.int64)
    if switched:
        # also one that is there for a moment only
        _, first = np.unique(activity, axis=0, return_index=True)
        picked = np.union1d(picked, first)
    return picked


def _hidden(columns: FloatArray) -> BoolArray:
    """Pairs of unknowns that trade off in some pose; shape (unknowns, unknowns)."""
    count = columns.shape[2]
    pairs = np.zeros((count, count), dtype=bool)
    for matrix in columns[np.isfinite(columns).all(axis=(1, 2))]:
        there = matrix.any(axis=0)
        _, sigma, vt = np.linalg.svd(matrix[:, there])
        rank = int(np.count_nonzero(sigma > RANK_TOLERANCE * sigma[:1]))
        unseen = vt[rank:].T @ vt[rank:]  # projects on what the readings do not see
        pairs[np.ix_(there, there)] |= np.abs(unseen) > _PART
    return pairs


def _groups(pairs: BoolArray, names: list[str]) -> tuple[tuple[str, ...], ...]:
    left, groups = set(np.flatnonzero(pairs.diagonal()).tolist()), []
    while left:
        group, border = set(), {min(left)}
        while border:
            group |= border
            border = set(np.flatnonzero(pairs[sorted(border)].any(axis=0)).tolist()) - group
        groups.append(tuple(names[index] for index in sorted(group)))
        left -= group
    return tuple(groups)


def _names(question: Question, part: SubModel) -> list[str]:
    return [f"{contact.name}.{name}" for contact in question.unknown_in(part) for name in contact.type.unknowns]
