# SPDX-License-Identifier: BSD-3-Clause
"""Contact wrenches and joint torques with covariances, linear in the errors of measurements and known wrenches."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray, require_shape
from forcetorque.base.errors import EstimationError, ShapeError, require_known
from forcetorque.base.pose import make_pose
from forcetorque.base.wrench import transform_wrench
from forcetorque.estimation.uncertain.equations import Scene, Undetermined, posterior_of, undetermined_of
from forcetorque.estimation.uncertain.uncertainty import Uncertainty, actions_of, actors_of, wrench_covariances
from forcetorque.robot.contacts import Wrenches
from forcetorque.robot.dynamics import BodyState, net_wrench
from forcetorque.robot.mechanics.contact_wrenches_and_torques import Block, body_states
from forcetorque.robot.mechanics.estimate_arrays import column_of
from forcetorque.robot.mechanics.inputs import Inputs, checked_inputs, refuse_infinite
from forcetorque.robot.mechanics.question import Question, TorqueSum
from forcetorque.robot.motion import JointMotion, RootMotion

BY_SAMPLE: Final = (
    "contact_wrenches",
    "contact_covariance",
    "torques",
    "torque_covariance",
    "torque_lasting",
    "residual",
    "rank",
    "condition",
)
"""Fields with a row for each sample."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class UncertainEstimates:
    """Estimates of n samples; NaN in a gap, and where a number depends on what is not determined."""

    contacts: tuple[str, ...]
    """Contacts: unknown ones, then known ones, in the order of the question."""
    contact_wrenches: FloatArray
    """What the environment does to the robot, in and about the contact frame; of a known contact as readings and its
    tangents have corrected it; shape (n, contacts, 6); N, N m."""
    contact_covariance: FloatArray
    """Covariance of its error; shape (n, contacts, 6, 6)."""
    joints: tuple[str, ...]
    """Joints whose torque is estimated."""
    torques: FloatArray
    """What the motor does along +q; shape (n, joints); N m, N where prismatic."""
    torque_covariance: FloatArray
    """Covariance of their errors; shape (n, joints, joints)."""
    torque_lasting: FloatArray
    """What one standard deviation of each of p errors that last leaves them wrong by; part of that covariance; shape
    (n, joints, p)."""
    parts: tuple[str, ...]
    """Sub-models whose equations were solved, by the sensor at their base or the root link."""
    residual: FloatArray
    """What neither unknowns nor errors explain of each, along the root link's axes; shape (n, parts, 6); N, N m."""
    rank: IntArray
    """Directions of all unknowns together that the equations see; shape (n,)."""
    condition: FloatArray
    """Largest over smallest singular value of those; shape (n,); NaN for rank 0."""
    undetermined: tuple[Undetermined, ...]
    """What the equations do not see, and where."""

    def __len__(self) -> int:
        return len(self.torques)

    def of_samples(self, kept: BoolArray) -> UncertainEstimates:
        """Keep some samples.

        Args:
            kept: Which; shape (n,).

        Returns:
            Their estimates.
        """
        arrays: dict[str, Any] = {name: getattr(self, name)[kept] for name in BY_SAMPLE}
        hidden = [replace(one, samples=one.samples[kept]) for one in self.undetermined if one.samples[kept].any()]
        return replace(self, **arrays, undetermined=tuple(hidden))

    @property
    def determined(self) -> BoolArray:
        """Whether everything is determined in a sample; shape (n,)."""
        hidden = np.zeros(len(self), dtype=np.bool_)
        for one in self.undetermined:
            hidden |= one.samples
        return ~hidden

    @property
    def torque_sd(self) -> FloatArray:
        """Standard deviation of each torque; shape (n, joints)."""
        return _deviations(self.torque_covariance)

    def contact(self, name: str) -> FloatArray:
        """Give the wrenches of a contact.

        Returns:
            Wrenches in the contact frame; shape (n, 6); N, N m.
        """
        return self.contact_wrenches[:, column_of(name, self.contacts, "contact")]

    def contact_sd(self, name: str) -> FloatArray:
        """Give the standard deviations of the wrench of a contact.

        Returns:
            One for each component; shape (n, 6); N, N m.
        """
        return _deviations(self.covariance_of(name))

    def covariance_of(self, name: str) -> FloatArray:
        """Give the covariance of the wrench of a contact.

        Returns:
            Covariances; shape (n, 6, 6).
        """
        return self.contact_covariance[:, column_of(name, self.contacts, "contact")]

    def torque(self, joint: str) -> FloatArray:
        """Give the torques of a joint.

        Args:
            joint: Its name.

        Returns:
            Torques; shape (n,); N m, N where prismatic.
        """
        return self.torques[:, column_of(joint, self.joints, "torque")]


def _deviations(covariance: FloatArray) -> FloatArray:
    variance = np.einsum("...ii->...i", covariance)
    return np.sqrt(np.maximum(variance, 0.0))


_BLOCK: Final = 256
"""Samples at once: matrices of all sub-models, for each of them, stay in the processor's cache."""


def estimate_with_covariance(
    question: Question,
    joints: JointMotion,
    root: RootMotion,
    *,
    measured: Wrenches | None = None,
    known: Wrenches | None = None,
    active: Mapping[str, Any] | None = None,
    uncertainty: Uncertainty | None = None,
    must_be_determined: bool = True,
) -> UncertainEstimates:
    """Estimate contact wrenches and torques, and how far off they may be.

    Readings and known wrenches are as uncertain as is said; model and motion are exact. Where there are more equations
    than unknowns, what is surplus corrects readings and known wrenches, each as far as its covariance allows.

    Args:
        question: What is estimated; its torques are summed up inside sub-models (`TorqueSum.SUB_MODEL`).
        joints: Motion of at least the joints that it depends on (`required_joints_of`); n samples.
        root: Motion of the root link's frame; one sample or n.
        measured: Readings of at least the sensors that the tree is cut at, in their frames and directions.
        known: Wrenches of at least the known contacts, in their contact frames.
        active: By the name of an unknown contact, whether it is there; shape (n,), bool; others always are.
        uncertainty: What is not known of these; all is exact if None.
        must_be_determined: Whether what is determined in no sample is refused.

    Returns:
        The estimates; NaN where one is not determined.

    Raises:
        EstimationError: If a covariance is not one, inputs are missing, the question sums torques up otherwise, or
            something that must be is determined in no sample; the message says along which forces.
    """
    if question.torques and question.torque_sum is not TorqueSum.SUB_MODEL:
        raise EstimationError(
            f"torque_sum: expected {TorqueSum.SUB_MODEL}, got {question.torque_sum}; sums over the whole tree would "
            "need the motion of joints beyond sensors for nothing, as errors explain what sub-models leave"
        )
    inputs = checked_inputs(question, joints, root, measured, known, active)
    checked = _checked(question, uncertainty or Uncertainty(), len(joints))
    uncertain = _joined([_answer(question, inputs, checked, block) for block in _blocks(len(joints))])
    if must_be_determined:
        _refuse_undetermined(uncertain)
    return uncertain


def _answer(question: Question, inputs: Inputs, uncertainty: Uncertainty, block: slice) -> UncertainEstimates:
    refuse_infinite(inputs, block)
    scene = _scene(question, inputs, uncertainty, block)
    parts = inputs.needs.solved
    posterior = posterior_of(scene.equations(parts))
    n = len(posterior.rank)
    wrenches, wrong = posterior.linear(scene.contact_rows())
    torques, torques_wrong = posterior.linear(scene.torque_rows())
    contacts = tuple(contact.name for contact in (*question.unknown, *question.known))
    wrong = wrong.reshape(n, len(contacts), 6, wrong.shape[2])
    return UncertainEstimates(
        contacts=contacts,
        contact_wrenches=wrenches.reshape(n, len(contacts), 6),
        contact_covariance=wrong @ wrong.swapaxes(2, 3),
        joints=question.torques,
        torques=torques,
        torque_covariance=torques_wrong @ torques_wrong.swapaxes(1, 2),
        torque_lasting=torques_wrong[:, :, scene.lasting],
        parts=tuple(part.name for part in parts),
        residual=posterior.residual.reshape(n, len(parts), 6),
        rank=posterior.rank,
        condition=posterior.condition,
        undetermined=undetermined_of(scene.actors, posterior.hidden),
    )


def _scene(question: Question, inputs: Inputs, uncertainty: Uncertainty, block: slice) -> Scene:
    n, samples = block.stop - block.start, inputs.joints.samples(block)
    measured = inputs.measured.values[block][:, inputs.measured_columns]
    known = inputs.known.values[block][:, inputs.known_columns]
    root = np.stack([np.broadcast_to(v if len(v) == 1 else v[block], (n, 3)) for v in inputs.root])
    active = np.array(inputs.active[block])
    given = Block(joints=samples, root=root, measured=measured, known=known, active=active.astype(np.float64))
    states = body_states(question, inputs.needs, given)
    poses = _poses(question, states, n)
    tree = question.tree
    return Scene(
        question=question,
        actors=actors_of(question, measured, known, active, _cut(uncertainty, block)),
        actions=list(actions_of(question, poses)),
        needs={
            index: transform_wrench(pose, net_wrench(tree.bodies[index].inertia, states[index]))
            for index, pose in poses.items()
            if inputs.needs.carrying[index] and not tree.bodies[index].inertia.is_zero
        },
        poses=poses,
    )


def _poses(question: Question, states: Mapping[int, BodyState], n: int) -> dict[int, FloatArray]:
    """`root_H_body` of all bodies whose motion is needed."""
    poses: dict[int, FloatArray] = {}
    for index, state in states.items():
        parent = question.tree.bodies[index].parent
        if parent < 0:
            poses[index] = np.broadcast_to(np.eye(4), (n, 4, 4))
            continue
        rotation, position = (
            np.broadcast_to(state.parent_R_body, (n, 3, 3)),
            np.broadcast_to(state.parent_p_body, (n, 3)),
        )
        poses[index] = poses[parent] @ make_pose(rotation, position)
    return poses


def _checked(question: Question, uncertainty: Uncertainty, n: int) -> Uncertainty:
    """Covariances of what the question names, one for each sample."""
    known = [contact.name for contact in question.known]
    for what, given, names in (
        ("measured", uncertainty.measured, question.measured),
        ("known", uncertainty.known, known),
        ("lasting", uncertainty.lasting, (*question.measured, *known)),
        ("tangents", uncertainty.tangents, known),
    ):
        for name in given:
            require_known(name, names, EstimationError, f"uncertainty.{what}: the question has none of {name!r}")
    for name, tangents in uncertainty.tangents.items():
        if len(tangents.maps) != n:
            raise ShapeError(f"tangents of {name!r}: expected {n} samples, got {len(tangents.maps)}")
    return Uncertainty(
        measured={k: wrench_covariances(v, name=k, samples=n) for k, v in uncertainty.measured.items()},
        known={k: wrench_covariances(v, name=k, samples=n) for k, v in uncertainty.known.items()},
        lasting={k: _lasting(v, name=k, samples=n) for k, v in uncertainty.lasting.items()},
        tangents=dict(uncertainty.tangents),
    )


def _lasting(values: FloatArray, *, name: str, samples: int) -> FloatArray:
    """Columns of lasting errors, for each sample."""
    errors = np.asarray(values, dtype=np.float64)
    if errors.ndim == 2:
        errors = np.broadcast_to(errors, (samples, *errors.shape))
    require_shape(errors, name=f"lasting errors of {name!r}", shape=(samples, 6, None))
    return errors


def _cut(uncertainty: Uncertainty, block: slice) -> Uncertainty:
    tangents = {name: one.of_samples(block) for name, one in uncertainty.tangents.items()}
    measured, known, lasting = (
        {name: values[block] for name, values in given.items()}
        for given in (uncertainty.measured, uncertainty.known, uncertainty.lasting)
    )
    return Uncertainty(measured=measured, known=known, lasting=lasting, tangents=tangents)


def _blocks(n: int) -> Iterator[slice]:
    for start in range(0, max(n, 1), _BLOCK):
        yield slice(start, min(start + _BLOCK, n))


def _joined(blocks: list[UncertainEstimates]) -> UncertainEstimates:
    """One after the other."""
    arrays: dict[str, Any] = {name: np.concatenate([getattr(block, name) for block in blocks]) for name in BY_SAMPLE}
    first = blocks[0]
    return UncertainEstimates(
        contacts=first.contacts,
        joints=first.joints,
        parts=first.parts,
        undetermined=tuple(_hidden_over(blocks)),
        **arrays,
    )


def _hidden_over(blocks: list[UncertainEstimates]) -> Iterator[Undetermined]:
    sets = dict.fromkeys(one.contacts for block in blocks for one in block.undetermined)
    for contacts in sets:
        marks, directions = [], None
        for block in blocks:
            here = next((one for one in block.undetermined if one.contacts == contacts), None)
            marks.append(np.zeros(len(block), dtype=np.bool_) if here is None else here.samples)
            directions = directions or (None if here is None else here.directions)
        yield Undetermined(contacts=contacts, samples=np.concatenate(marks), directions=directions or ())


def _refuse_undetermined(uncertain: UncertainEstimates) -> None:
    """Refuse where no sample is determined; where some are, the others are NaN."""
    if len(uncertain) and not uncertain.determined.any():
        words = "; ".join(one.sentence for one in uncertain.undetermined)
        raise EstimationError(
            f"{words}; take a contact away or make it a pure force, state the friction of skin contacts, or measure "
            "with one more sensor in between"
        )
