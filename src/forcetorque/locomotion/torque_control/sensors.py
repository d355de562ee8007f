# SPDX-License-Identifier: BSD-3-Clause
"""Errors of the force-torque sensors of the legs, and joint torques from their measurements."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only
from forcetorque.base.pose import cross
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.locomotion.torque_control.world import JOINTS, SENSORS, Biped
from forcetorque.robot.contacts import Wrenches
from forcetorque.robot.mechanics.estimate import Evaluator, estimate
from forcetorque.robot.mechanics.question import Question, TorqueSum
from forcetorque.robot.motion import JointMotion, RootMotion

_BODY_WEIGHT_N: Final = 324.711
"""33.1 kg at 9.81 m/s2, the load under which the errors of thesis Table 5.9 were seen."""
_WORKBENCH_N: Final = np.array(
    [[-14.0252, -6.8170, 17.8122], [-17.5327, 18.1905, 17.9740], [-28.3467, -9.4651, 18.8808]]
)
_IN_SITU_N: Final = np.array([[-5.5024, 0.4523, -0.4689], [-2.4991, -0.6910, 0.6080], [-8.3183, -0.0448, -0.8761]])

PRINTED: Final = {
    "workbench": float(np.sqrt((_WORKBENCH_N**2).mean())) / _BODY_WEIGHT_N,
    "in situ": float(np.sqrt((_IN_SITU_N**2).mean())) / _BODY_WEIGHT_N,
}
"""Root mean square force errors of thesis Table 5.9, over its three supports and axes, as shares of the weight."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SensorErrors:
    """Errors of the four sensors of B copies of the robot."""

    matrix: FloatArray
    """E of `reading = (1 + E) wrench + bias`; shape (B, 4, 6, 6)."""
    bias: FloatArray
    """Constant offsets; shape (B, 4, 6); N, N m."""
    noise: FloatArray
    """Standard deviation of white noise; shape (6,); N, N m."""
    resolution: FloatArray
    """Steps in which readings come, 0 for none; shape (6,); N, N m."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "matrix", read_only(self.matrix, name="matrix", shape=(None, len(SENSORS), 6, 6)))
        shape = (len(self.matrix), len(SENSORS), 6)
        object.__setattr__(self, "bias", read_only(self.bias, name="bias", shape=shape))
        for field in ("noise", "resolution"):
            object.__setattr__(self, field, read_only(getattr(self, field), name=field, shape=(6,)))

    @classmethod
    def none(cls, copies: int) -> SensorErrors:
        """Give sensors without errors.

        Args:
            copies: How many copies of the robot, B.

        Returns:
            No errors at all.
        """
        zero = np.zeros((copies, len(SENSORS), 6))
        return cls(matrix=np.zeros((*zero.shape, 6)), bias=zero, noise=np.zeros(6), resolution=np.zeros(6))

    def reading(self, wrenches: FloatArray, rng: np.random.Generator) -> FloatArray:
        """Give what the sensors read.

        Args:
            wrenches: True wrenches; shape (B, 4, 6); N, N m.
            rng: Source of noise.

        Returns:
            Readings; shape (B, 4, 6); N, N m.
        """
        reading: FloatArray = wrenches + np.einsum("bsij,bsj->bsi", self.matrix, wrenches) + self.bias
        if self.noise.any():
            reading = reading + self.noise * rng.standard_normal(reading.shape)
        steps = np.where(self.resolution > 0.0, self.resolution, 1.0)
        return np.where(self.resolution > 0.0, np.round(reading / steps) * steps, reading)


def drawn_matrices(size: float, length: float, rng: np.random.Generator, copies: int) -> FloatArray:
    """Draw E of four sensors for each copy; all elements are normal and independent.

    An element that makes a force of a force has the standard deviation `size`, so that weight on a sensor is read with
    errors of that share in each axis, as in thesis Table 5.9. That table says nothing of moments; they get the same
    size by a length: `size * length` for a moment of a force, `size / length` for a force of a moment.

    Args:
        size: Error of a force as a share of the load, such as `PRINTED["workbench"]`.
        length: Moment that counts as much as one newton; m.
        rng: Source of the matrices.
        copies: How many, B.

    Returns:
        E; shape (B, 4, 6, 6).
    """
    unit = np.array([1.0, 1.0, 1.0, length, length, length])
    return size * unit[:, None] / unit * rng.standard_normal((copies, len(SENSORS), 6, 6))


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
