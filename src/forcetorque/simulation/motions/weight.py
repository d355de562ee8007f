# SPDX-License-Identifier: BSD-3-Clause
"""What the support bears when the robot holds still."""

from __future__ import annotations

from forcetorque.arrays import FloatArray
from forcetorque.estimation import Contact, Question, estimate
from forcetorque.robot import JointMotion, RootMotion
from forcetorque.simulation.motions.stand import Stand


def weight_at_support(stand: Stand, postures: FloatArray) -> FloatArray:
    """Compute what the ground does to the robot at the support, at rest.

    Args:
        stand: The robot on its support.
        postures: Postures of all free joints; shape (k, j); rad or m.

    Returns:
        The wrench that holds its weight, in the support's frame; shape (k, 6); N, N m.
    """
    question = Question(tree=stand.tree, contacts=(Contact(link=stand.support),))
    root = RootMotion.fixed(stand.gravity_direction, gravity=stand.gravity)
    return estimate(question, JointMotion.at_rest(stand.joints, postures), root).contact_wrenches[:, 0]
