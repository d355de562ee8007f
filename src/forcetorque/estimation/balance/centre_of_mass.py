# SPDX-License-Identifier: BSD-3-Clause
"""Centre of mass of a robot from the positions of its joints, and its mass."""

from __future__ import annotations

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import EstimationError
from forcetorque.robot import BodyTree, JointMotion
from forcetorque.robot.kinematics import body_poses


def mass_of(tree: BodyTree) -> float:
    """Add up the masses of a robot.

    Args:
        tree: The robot.

    Returns:
        Its mass; kg.
    """
    return float(sum(body.inertia.mass for body in tree.bodies))


def centre_of_mass(tree: BodyTree, joints: JointMotion) -> FloatArray:
    """Find the centre of mass.

    Args:
        tree: The robot, rooted at the link in which it is wanted.
        joints: Positions of at least the joints that carry a mass; n samples.

    Returns:
        Its position in the root link's frame; shape (n, 3); m; NaN where a joint is not known.

    Raises:
        EstimationError: If the robot has no mass.
    """
    mass = mass_of(tree)
    if not mass > 0.0:
        raise EstimationError("centre of mass: expected a robot with mass, got none; its links lack <inertial>")
    heavy = [index for index, body in enumerate(tree.bodies) if body.inertia.mass or body.inertia.first_moment.any()]
    poses = body_poses(tree, joints, heavy)
    moment = np.zeros((len(joints), 3))
    for index in heavy:
        inertia = tree.bodies[index].inertia
        moment += poses[index][:, :3, :3] @ inertia.first_moment + inertia.mass * poses[index][:, :3, 3]
    return moment / mass
