# SPDX-License-Identifier: BSD-3-Clause
"""What an estimate is computed from: motion, readings and known wrenches, matched to the question."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray, require_shape
from forcetorque.base.errors import EstimationError, RobotError, ShapeError, known_names, require_known
from forcetorque.robot.contacts import Wrenches
from forcetorque.robot.dynamics import root_vectors
from forcetorque.robot.mechanics.estimated_quantities import Needs, Question, needs_of
from forcetorque.robot.motion import JointMotion, RootMotion

MOST_UNKNOWNS = 6
"""A sub-model has six equations."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Inputs:
    """Everything that a question is answered from."""

    joints: JointMotion
    """Motion of at least the joints that it depends on; n samples."""
    root: tuple[FloatArray, FloatArray, FloatArray]
    """Angular velocity, angular acceleration, proper acceleration of the root link; shape (1 or n, 3) each."""
    measured: Wrenches
    """Readings of at least the measured sensors."""
    known: Wrenches
    """Wrenches of at least the known contacts."""
    active: BoolArray
    """Whether each unknown contact is there; shape (n, unknown contacts)."""
    switched: frozenset[str]
    """Contacts that are not there in every sample."""
    needs: Needs
    """What the answer depends on."""
    joint_columns: IntArray
    """Columns of `joints` that matter; shape (j,)."""
    measured_columns: IntArray
    """Columns of `measured`, in the order of the question's sensors; shape (sensors,)."""
    known_columns: IntArray
    """Columns of `known`, in the order of the question's known contacts; shape (contacts,)."""


def checked_inputs(
    question: Question,
    joints: JointMotion,
    root: RootMotion,
    measured: Wrenches | None,
    known: Wrenches | None,
    active: Mapping[str, Any] | None,
) -> Inputs:
    """Match inputs to a question.

    Args:
        question: The question.
        joints: Motion of joints.
        root: Motion of the root link.
        measured: Readings of sensors.
        known: Wrenches of known contacts.
        active: By the name of an unknown contact, whether it is there; shape (n,).

    Returns:
        The inputs.

    Raises:
        RobotError: If a joint that is needed is not in `joints`.
    """
    n, switched = len(joints), frozenset(active or ())
    needs = needs_of(question, switched=switched)
    needed = needs.joints(question.tree)
    for joint in needed:
        if joint not in joints.names:
            raise RobotError(
                f"the estimate needs joint {joint!r}, seen from {question.tree.root_link!r}, which the motion lacks; "
                f"{known_names(joint, joints.names)}"
            )
    activity = activity_of(question, active, n)
    _require_determined(question, activity if switched else activity[:1])
    touched = [contact.name for contact in question.known]
    readings = _wrenches(measured, question.measured, "measured: reading of sensor", n)
    given = _wrenches(known, touched, "known: wrench of contact", n)
    return Inputs(
        joints=joints,
        root=root_vectors(root, n),
        measured=readings,
        known=given,
        active=activity,
        switched=switched,
        needs=needs,
        joint_columns=_columns(joints.names, needed),
        measured_columns=_columns(readings.names, question.measured),
        known_columns=_columns(given.names, touched),
    )


def refuse_infinite(inputs: Inputs, block: slice) -> None:
    """Refuse infinite numbers in what the question depends on; NaN is a gap and is not refused.

    Args:
        inputs: The inputs.
        block: Samples to look at.

    Raises:
        EstimationError: If there is one, with its place.
    """
    for name, columns, values in _arrays(inputs, block):
        places = np.argwhere(np.isinf(values))
        if len(places):
            sample = block.start + int(places[0][0])
            raise EstimationError(
                f"{name}: expected finite numbers, or NaN for a gap; {columns[places[0][1]]} is "
                f"{values[tuple(places[0])]} in sample {sample}"
            )


def _arrays(inputs: Inputs, block: slice) -> Iterator[tuple[str, Sequence[str], FloatArray]]:
    joints = [inputs.joints.names[column] for column in inputs.joint_columns]
    for name in ("position", "velocity", "acceleration"):
        yield f"joint {name}", joints, getattr(inputs.joints, name)[block][:, inputs.joint_columns]
    words = ("angular velocity", "angular acceleration", "proper acceleration")
    for name, values in zip(words, inputs.root, strict=True):
        yield f"root motion, {name}", "xyz", values if len(values) == 1 else values[block]
    for name, wrenches, columns in (
        ("measured", inputs.measured, inputs.measured_columns),
        ("known", inputs.known, inputs.known_columns),
    ):
        yield name, [wrenches.names[column] for column in columns], wrenches.values[block][:, columns]


def _columns(names: Sequence[str], wanted: Sequence[str]) -> IntArray:
    return np.array([names.index(name) for name in wanted], dtype=np.int64)


def _wrenches(given: Wrenches | None, wanted: Sequence[str], what: str, n: int) -> Wrenches:
    names = () if given is None else given.names
    for name in wanted:
        require_known(name, names, EstimationError, f"{what} {name!r} is missing")
    if given is None or not wanted:
        return Wrenches(names=(), values=np.empty((n, 0, 6)))
    if len(given) != n:
        raise ShapeError(f"{what}s: expected {n} samples, as many as of the joints, got {len(given)}")
    return given


def activity_of(question: Question, active: Mapping[str, Any] | None, n: int) -> BoolArray:
    """Tell which unknown contacts are there, sample by sample.

    Args:
        question: The question.
        active: By the name of an unknown contact, whether it is there; shape (n,).
        n: Number of samples.

    Returns:
        Whether each unknown contact is there; shape (n, unknown contacts).

    Raises:
        EstimationError: If the question has no such unknown contact.
        ShapeError: If what is given is not bool.
    """
    switches = dict(active or {})
    unknown = [contact.name for contact in question.unknown]
    for name in switches:
        require_known(name, unknown, EstimationError, f"active: the question has no unknown contact {name!r}")
    if not switches:
        return np.broadcast_to(True, (n, len(unknown)))
    activity = np.ones((n, len(unknown)), dtype=bool)
    for name, values in switches.items():
        marks = np.asarray(values)
        require_shape(marks, name=f"active[{name!r}]", shape=(n,))
        if marks.dtype != bool:
            raise ShapeError(f"active[{name!r}]: expected bool, got {marks.dtype}")
        activity[:, unknown.index(name)] = marks
    return activity


def _require_determined(question: Question, activity: BoolArray) -> None:
    """Refuse more unknowns than equations without `minimum_norm`."""
    if question.minimum_norm is not None:
        return
    for part in question.parts:
        contacts = question.unknown_in(part)
        counts = np.array([len(contact.type.unknowns) for contact in contacts])
        columns = [question.unknown.index(contact) for contact in contacts]
        most = int((activity[:, columns] @ counts).max(initial=0)) if columns else 0
        if most > MOST_UNKNOWNS:
            raise EstimationError(
                f"sub-model {part.name!r} has {most} unknowns in {', '.join(repr(c.name) for c in contacts)} and six "
                "equations; make contacts pure forces, or specify minimum_norm with a length_scale in m, which "
                "weighs moments against forces"
            )
