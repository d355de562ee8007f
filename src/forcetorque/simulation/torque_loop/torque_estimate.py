# SPDX-License-Identifier: BSD-3-Clause
"""Joint torques from readings of the FT sensors, for many copies of the robot at once: the library's own estimator."""

from __future__ import annotations

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.constants import STANDARD_GRAVITY
from forcetorque.estimation import Evaluator, Question, TorqueSum, estimate
from forcetorque.robot import JointMotion, RootMotion
from forcetorque.robot.wrenches import Wrenches
from forcetorque.simulation.torque_loop.biped import JOINTS, SENSORS, Biped
from forcetorque.spatial import cross


def torque_question(biped: Biped) -> Question:
    """Ask for the torques of both legs from the four sensors (thesis 2.8).

    A torque is the sum over the links between its joint and the next sensors, and what these sensors read: knees and
    ankles live by the sensors of the feet, the hip's pitch and roll by those below them.

    Args:
        biped: The robot.

    Returns:
        The question to the estimator.
    """
    return Question(tree=biped.tree, measured=SENSORS, torques=JOINTS, torque_sum=TorqueSum.SUB_MODEL, equations=())


def estimated_torques(
    question: Question, position: FloatArray, velocity: FloatArray, acceleration: FloatArray, *, readings: FloatArray
) -> FloatArray:
    """Estimate torques; model, encoders and IMU are without error, the readings are what they are.

    Args:
        question: From `torque_question`.
        position: Pelvis position, quaternion wxyz, joints; shape (n, 19); m, rad.
        velocity: Linear in world axes, angular in the pelvis's, joints; shape (n, 18).
        acceleration: The same of accelerations; shape (n, 18).
        readings: What the sensors read; shape (n, 4, 6); N, N m.

    Returns:
        Torques of `JOINTS`; shape (n, 12); N m.
    """
    joints = JointMotion(
        names=JOINTS, position=position[:, 7:], velocity=velocity[:, 6:], acceleration=acceleration[:, 6:]
    )
    measured = Wrenches(names=SENSORS, values=readings)
    root = pelvis_motion(position, velocity, acceleration)
    return estimate(question, joints, root, measured=measured, evaluator=Evaluator.COMPILED, threads=1).torques


def pelvis_motion(position: FloatArray, velocity: FloatArray, acceleration: FloatArray) -> RootMotion:
    """Give what an IMU at the pelvis feels.

    Args:
        position: As in `estimated_torques`; shape (n, 19).
        velocity: As there; shape (n, 18).
        acceleration: As there; shape (n, 18).

    Returns:
        The motion in the pelvis's axes.
    """
    world_R_pelvis = rotations(position[:, 3:7])
    proper = acceleration[:, :3] + np.array([0.0, 0.0, STANDARD_GRAVITY])
    return RootMotion(
        proper_acceleration=np.einsum("nji,nj->ni", world_R_pelvis, proper),
        angular_velocity=velocity[:, 3:6],
        angular_acceleration=acceleration[:, 3:6],
    )


def rotations(quat_wxyz: FloatArray) -> FloatArray:
    """Give rotations of unit quaternions.

    Args:
        quat_wxyz: Unit quaternions, real part first; shape (n, 4).

    Returns:
        Rotations; shape (n, 3, 3).
    """
    w, x, y, z = quat_wxyz.T
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), 2, 0)


def moved(position: FloatArray, tangent: FloatArray) -> FloatArray:
    """Move postures a little.

    Args:
        position: Pelvis position, quaternion wxyz, joints; shape (n, 19); m, rad.
        tangent: Shift in world axes, turn in the pelvis's axes, joints; shape (n, 18); m, rad; the turn is small.

    Returns:
        Postures, to the second order of the turn; shape (n, 19).
    """
    w, vector, half = position[:, 3:4], position[:, 4:7], 0.5 * tangent[:, 3:6]
    real = w - (vector * half).sum(axis=1, keepdims=True)
    quaternion = np.concatenate([real, vector + w * half + cross(vector, half)], axis=1)
    quaternion = quaternion / np.linalg.norm(quaternion, axis=1, keepdims=True)
    return np.concatenate([position[:, :3] + tangent[:, :3], quaternion, position[:, 7:] + tangent[:, 6:]], axis=1)
