# SPDX-License-Identifier: BSD-3-Clause
"""The readable evaluator: the equations of thesis 2.4, one after the other, over all samples at once.

    net wrench of a body                phi                                                    (2.3)
    equation of a sub-model             C x = sum of X phi - X f_known + readings at its cuts  (2.5, 2.6, 7.8)
    wrench across a joint               sum of X (phi - f_known - f_x) over the outboard side  (2.8, corrected)

The compiled evaluator gives the same numbers and is tested against this one.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.pose import invert_pose
from forcetorque.base.wrench import transform_wrench
from forcetorque.robot.contacts import Contact, Wrenches
from forcetorque.robot.dynamics import BodyState, in_body, in_parent, move_to, net_wrench, root_state
from forcetorque.robot.mechanics.estimate_arrays import Estimates
from forcetorque.robot.mechanics.estimate_inputs import activity_of, checked_inputs
from forcetorque.robot.mechanics.estimated_quantities import Needs, Question
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.sub_models import SubModel
from forcetorque.robot.tree import Connection, path_to_root

RANK_TOLERANCE = 1e-9
"""Singular values below this part of the largest are rounding: geometry comes from numbers of some 1e-16."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Block:
    """Input of some samples."""

    joints: JointMotion
    """Motion of the joints; n samples."""
    root: FloatArray
    """Angular velocity, angular acceleration, proper acceleration of the root link; shape (3, n, 3)."""
    measured: FloatArray
    """Readings of the measured sensors; shape (n, sensors, 6); N, N m."""
    known: FloatArray
    """Known contact wrenches; shape (n, known contacts, 6); N, N m."""
    active: FloatArray
    """1 where an unknown contact is there, else 0; shape (n, unknown contacts)."""


class BlockEvaluation:
    """Wrenches of all bodies for one block; lists are indexed by the body, each wrench is in that body's frame."""

    def __init__(
        self, question: Question, needs: Needs, block: Block, states: Mapping[int, BodyState], out: Estimates
    ) -> None:
        """Take what the equations are made of.

        Args:
            question: What to estimate.
            needs: Bodies and sub-models that it depends on.
            block: Its input.
            states: Motion of the bodies, as `body_states` carries it outwards from the root.
            out: Receives the results; as many samples.
        """
        self.question, self.needs, self.block, self.out = question, needs, block, out
        self.tree, self.bodies, self.states = question.tree, question.tree.bodies, states
        self.readings = {sensor: self._reading(k, sensor) for k, sensor in enumerate(question.measured)}

    def run(self) -> None:
        """Compute the results and write them to `out`."""
        for k, link in enumerate(self.question.net_wrenches):
            self.out.net_wrenches[:, k] = self._link_wrench(link)
        demand = self._demand()
        if self.question.expected:
            self._expect(demand)
        self._torques(self._solve(demand))

    def _link_wrench(self, link: str) -> FloatArray:
        body, body_H_link = self.tree.frames[link]
        inertia = self.tree.inertias[link].expressed_in(body_H_link)
        return transform_wrench(invert_pose(body_H_link), net_wrench(inertia, self.states[body]))

    def _demand(self) -> list[FloatArray]:
        """What neighbours and unknown contacts together must do to each body."""
        demand = [np.zeros((len(self.out), 6)) for _ in self.bodies]
        for index in np.flatnonzero(self.needs.carrying).tolist():
            if not self.bodies[index].inertia.is_zero:  # nothing is needed there, whatever gap the motion has
                demand[index] = net_wrench(self.bodies[index].inertia, self.states[index])
        for k, contact in enumerate(self.question.known):
            demand[self.question.body_of(contact)] -= on_body(self.question, contact, self.block.known[:, k])
        return demand

    def _expect(self, demand: list[FloatArray]) -> None:
        """Let one contact take up what the whole robot demands; a sensor transmits what is left outboard of it."""
        path = self.question.expected_path()
        left = list(demand)
        if len(path) > 1:
            taken = self._sums(demand, {})[0]
            for index in reversed(path[:-1]):
                taken = in_body(self.states[index], taken)
            left[path[0]] = left[path[0]] - taken
        sums = self._sums(left, {})
        for k, sensor in enumerate(self.question.expected):
            cut = self.tree.cuts[sensor]
            self.out.expected[:, k] = cut.sign * transform_wrench(invert_pose(cut.body_H_sensor), sums[cut.body])

    def _solve(self, demand: list[FloatArray]) -> list[FloatArray]:
        """Solve the equation of every sub-model; give what is left on each body beside its contacts."""
        left = list(demand)
        sums = self._sums(demand, {self.tree.cuts[sensor].body: reading for sensor, reading in self.readings.items()})
        for part in self.needs.solved:
            right = sums[part.base] if part.sensor is None else sums[part.base] - self.readings[part.sensor]
            contacts = self.question.unknown_in(part)
            columns = contact_columns(self.question, part, self.states, self.block.active)
            solution, rank, condition = _least_norm(columns, right, self.question, part)
            first = 0
            for contact in contacts:
                count = len(contact.type.unknowns)
                wrench = solution[:, first : first + count] @ contact.unknown_map().T
                first += count
                self.out.contact_wrenches[:, self.question.unknown.index(contact)] = wrench
                body = self.question.body_of(contact)
                left[body] = left[body] - on_body(self.question, contact, wrench)
            if part.name in self.question.layout.parts:
                k = self.question.layout.parts.index(part.name)
                self.out.rank[:, k], self.out.condition[:, k] = rank, condition
                residual = right - np.einsum("nij,nj->ni", columns, solution)
                self.out.residual[:, k] = self._at_sensor(part, residual)
        return left

    def _torques(self, left: list[FloatArray]) -> None:
        leaving = {part.name for part in self.needs.leaving}
        # where nothing is left outboard of a sensor, the sum over it is its reading
        transmitted = {
            self.tree.cuts[name].body: reading for name, reading in self.readings.items() if name not in leaving
        }
        sums = self._sums(left, transmitted)
        for index, body in enumerate(self.bodies):
            if body.joint is not None and body.joint in self.question.torques:
                component = 2 if body.connection is Connection.PRISMATIC else 5
                self.out.torques[:, self.question.torques.index(body.joint)] = sums[index][:, component]

    def _sums(self, wrenches: Sequence[FloatArray], transmitted: Mapping[int, FloatArray]) -> list[FloatArray]:
        """Sum up over everything outboard of each body; some cuts transmit a given wrench instead."""
        sums = list(wrenches)
        for index in reversed(range(1, len(self.bodies))):
            parent = self.bodies[index].parent
            if index in transmitted:  # both sides of a cut share their frame
                sums[parent] = sums[parent] + transmitted[index]
            elif self.needs.carrying[index]:
                sums[parent] = sums[parent] + in_parent(self.states[index], sums[index])
        return sums

    def _reading(self, column: int, sensor: str) -> FloatArray:
        """Wrench of the inboard on the outboard part at a sensor, in the frame of the cut."""
        cut = self.tree.cuts[sensor]
        return cut.sign * transform_wrench(cut.body_H_sensor, self.block.measured[:, column])

    def _at_sensor(self, part: SubModel, wrench: FloatArray) -> FloatArray:
        if part.sensor is None:
            return wrench
        return transform_wrench(invert_pose(self.tree.cuts[part.sensor].body_H_sensor), wrench)


def body_states(question: Question, needs: Needs, block: Block) -> dict[int, BodyState]:
    """Carry the motion of the root outwards to every body that matters.

    Args:
        question: The question.
        needs: What it depends on.
        block: Its input; n samples.

    Returns:
        States by the index of the body.
    """
    states: dict[int, BodyState] = {}
    for index, body in enumerate(question.tree.bodies):
        if body.parent < 0:
            states[index] = root_state(block.root)
        elif needs.moving[index]:
            states[index] = move_to(body, states[body.parent], block.joints, slice(None))
    return states


def contact_columns(
    question: Question, part: SubModel, states: Mapping[int, BodyState], active: FloatArray
) -> FloatArray:
    """Build the matrix C of a sub-model in the frame of its base.

    Args:
        question: The question.
        part: One of its sub-models.
        states: States of the bodies.
        active: 1 where an unknown contact is there, else 0; shape (n, unknown contacts).

    Returns:
        A column for every unknown of its contacts, zero where the contact is not there; shape (n, 6, unknowns).
    """
    columns = [np.zeros((len(active), 6, 0))]
    for contact in question.unknown_in(part):
        there = active[:, question.unknown.index(contact), None]
        for unit in contact.unknown_map().T:
            column = on_body(question, contact, there * unit)
            for index in path_to_root(question.tree, question.body_of(contact)):
                if index == part.base:
                    break
                column = in_parent(states[index], column)
            columns.append(column[:, :, None])
    return np.concatenate(columns, axis=2)


def on_body(question: Question, contact: Contact, wrench: FloatArray) -> FloatArray:
    """Express wrenches in a contact frame in the frame of the touched body.

    Args:
        question: The question.
        contact: One of its contacts.
        wrench: Wrenches in the contact frame; shape (n, 6); N, N m.

    Returns:
        The same in the body's frame; shape (n, 6); N, N m.
    """
    return transform_wrench(question.tree.frames[contact.link][1] @ contact.link_H_contact, wrench)


def weighted(columns: FloatArray, question: Question, part: SubModel) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Express an equation in newtons: moments are divided by the length scale, on both sides.

    Args:
        columns: Matrix C of the sub-model; shape (n, 6, unknowns).
        question: The question.
        part: The sub-model.

    Returns:
        The matrix in newtons, shape (n, 6, unknowns); the length of every row, shape (6,); that of every unknown,
        shape (unknowns,).
    """
    length = question.length_scale
    names = [name for contact in question.unknown_in(part) for name in contact.type.unknowns]
    rows = np.array([1.0, 1.0, 1.0, length, length, length])
    unknowns = np.array([length if name.startswith("t") else 1.0 for name in names])
    return columns / rows[:, None] * unknowns, rows, unknowns


def _least_norm(
    columns: FloatArray, right: FloatArray, question: Question, part: SubModel
) -> tuple[FloatArray, IntArray, FloatArray]:
    """Solve in the least squares; gives the smallest x (n, u), the rank (n,) and the condition (n,)."""
    scaled, rows, unknowns = weighted(columns, question, part)
    solution = np.full((len(scaled), len(unknowns)), np.nan)
    rank, condition = np.zeros(len(scaled), dtype=np.int64), np.full(len(scaled), np.nan)
    whole = np.isfinite(scaled).all(axis=(1, 2)) & np.isfinite(right).all(axis=1)
    if not len(unknowns) or not whole.any():
        return solution, rank, condition
    u, sigma, vt = np.linalg.svd(scaled[whole], full_matrices=False)
    kept = sigma > RANK_TOLERANCE * sigma[:, :1]
    inverse = np.where(kept, 1.0 / np.where(kept, sigma, 1.0), 0.0)
    along = np.einsum("nij,ni->nj", u, right[whole] / rows)
    solution[whole] = np.einsum("nji,nj->ni", vt, inverse * along) * unknowns
    rank[whole] = kept.sum(axis=1)
    smallest = np.where(kept, sigma, np.inf).min(axis=1)
    condition[whole] = np.where(rank[whole] > 0, sigma[:, 0] / smallest, np.nan)
    return solution, rank, condition


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
