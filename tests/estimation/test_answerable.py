# SPDX-License-Identifier: BSD-3-Clause
"""What of a question is left where the log holds the joints of one leg alone."""

from __future__ import annotations

import pytest

from forcetorque.base.errors import ExperimentError
from forcetorque.estimation.estimate import narrowed
from forcetorque.robot.contacts import Contact, ContactType
from forcetorque.robot.mechanics.estimated_quantities import Question, TorqueSum
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.robots import BIPED_URDF

LEG = ("r_hip_pitch", "r_hip_roll", "r_hip_yaw", "r_knee", "r_ankle_pitch", "r_ankle_roll")


def question(*contacts: Contact) -> Question:
    """Torques of knee and elbow of a robot without a sensor, which is one sub-model."""
    return Question(
        tree=build_tree(read_urdf(BIPED_URDF), "pelvis"),
        contacts=(Contact(link="pelvis"), *contacts),
        torques=("r_knee", "r_elbow"),
        torque_sum=TorqueSum.SUB_MODEL,
    )


def test_a_known_contact_needs_no_equation() -> None:
    """It stays where its sub-model cannot be solved, and so does the torque that is told from it."""
    skin = Contact(link="r_shin", name="shin 1", type=ContactType.KNOWN)
    answerable, left_out = narrowed(question(skin), LEG, required=())
    assert answerable.contacts == (skin,)
    assert answerable.torques == ("r_knee",)
    assert answerable.equations == ()
    assert left_out[0].startswith("sub-model pelvis with its contacts (pelvis): no stream holds the joint(s) ")
    # negative control: with every joint nothing is left out
    asked = question(skin)
    whole, nothing = narrowed(asked, [*LEG, *_others()], required=())
    assert nothing == []
    assert (whole.contacts, whole.torques) == (asked.contacts, asked.torques)


def test_an_unknown_contact_goes_with_its_equation() -> None:
    """With the torques that it acts on; one that was asked for by name is an error."""
    touched = Contact(link="r_shin", name="shin")
    answerable, left_out = narrowed(question(touched), LEG, required=())
    assert answerable.contacts == answerable.torques == ()
    assert "(pelvis, shin)" in left_out[0]
    with pytest.raises(ExperimentError, match="contact 'shin': its sub-model 'pelvis' cannot be solved"):
        narrowed(question(touched), LEG, required=("shin",))


def _others() -> list[str]:
    return [name for name, joint in read_urdf(BIPED_URDF).joints.items() if joint.type.moves and name not in LEG]
