# SPDX-License-Identifier: BSD-3-Clause
"""The closed loop: balancing, torque controllers, drives, MuJoCo, sensors with errors, estimated torques."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Final

import numpy as np

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, IntArray, array
from forcetorque.base.pose import cross
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.locomotion.torque_control.balancing_controller import Balance, Reference
from forcetorque.locomotion.torque_control.biped_in_mujoco import JOINTS, SENSORS, Biped, Posture, World
from forcetorque.locomotion.torque_control.joint_torque_controller import JointDrive, TorqueController, TorqueGains
from forcetorque.robot.contacts import Wrenches
from forcetorque.robot.mechanics.estimate import Evaluator, estimate
from forcetorque.robot.mechanics.estimated_quantities import Question, TorqueSum
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
class SensorErrors(ArrayRecord):
    """Errors of the four sensors of B copies of the robot."""

    matrix: FloatArray = field(metadata=array("copies", len(SENSORS), 6, 6))
    """E of `reading = (1 + E) wrench + bias`; shape (B, 4, 6, 6)."""
    bias: FloatArray = field(metadata=array("copies", len(SENSORS), 6))
    """Constant offsets; shape (B, 4, 6); N, N m."""
    noise: FloatArray = field(metadata=array(6))
    """Standard deviation of white noise; shape (6,); N, N m."""
    resolution: FloatArray = field(metadata=array(6))
    """Steps in which readings come, 0 for none; shape (6,); N, N m."""

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
    """Set up the estimation of the torques of both legs from the four sensors (thesis 2.8).

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


_FALLEN_M: Final = 0.1
"""A pelvis that is so much lower than it should be has fallen; m."""
_PUSH_S: Final = 0.01
"""How long a push on the pelvis lasts; s."""
_FALLEN_UPRIGHT: Final = 0.85
"""Or one whose vertical axis is turned by more than the angle with this cosine, 32 degrees."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LoopSetting:
    """All that is frozen before errors are drawn."""

    drive: JointDrive
    """Drive of every joint."""
    gains: TorqueGains
    """Gains of the torque controllers of `JOINTS`."""
    balance: Balance
    """The balancing controller."""
    period_s: float
    """Time between steps of controllers and simulation; s."""
    hold_steps: int = 1
    """Steps for which an estimate is used; 1 for a new one in every step."""
    delay_steps: int = 0
    """Steps by which an estimate comes late, beside the one in which it is computed."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LoopRun:
    """What B copies did in n steps; after its fall a copy is NaN."""

    reference: Reference
    """What they should have done."""
    period_s: float
    """Time between steps; s."""
    torque_error: FloatArray
    """True minus desired torques of `JOINTS`; shape (B, n, 12); N m."""
    centre_error: FloatArray
    """Horizontal place of the centre of mass minus the wanted one; shape (B, n, 2); m."""
    joints: FloatArray
    """Positions of joints; shape (B, n, 12); rad."""
    fallen: IntArray
    """Step in which a copy fell, n if it did not; shape (B,)."""

    def of(self, copies: slice) -> LoopRun:
        """Give some of the copies.

        Returns:
            What they did.
        """
        return replace(
            self,
            torque_error=self.torque_error[copies],
            centre_error=self.centre_error[copies],
            joints=self.joints[copies],
            fallen=self.fallen[copies],
        )

    @property
    def tracking_rms(self) -> FloatArray:
        """Root mean square of torque errors over joints and the time before a fall; shape (B,); N m."""
        return np.sqrt(np.nanmean(self.torque_error**2, axis=(1, 2)))


def run_loop(
    biped: Biped,
    setting: LoopSetting,
    reference: Reference,
    errors: SensorErrors,
    *,
    rng: np.random.Generator,
    push_N: float = 0.0,
    progress: Callable[[int], None] = lambda _: None,
) -> LoopRun:
    """Let copies of a robot that differ in the errors of their sensors do the same motion.

    The controllers begin as they end at rest: with the torques of the posture, and no integral.

    Args:
        biped: The robot.
        setting: Drives, gains, rates.
        reference: The motion; one instant per step.
        errors: Errors of the sensors of B copies.
        rng: Source of noise.
        push_N: Sideways force on the pelvis in the first 10 ms, to see whether what it excites dies away; N.
        progress: Called with the number of steps done so far.

    Returns:
        What they did.
    """
    copies, steps, joints = len(errors.matrix), len(reference), len(JOINTS)
    world = World(biped, setting.drive, copies=copies, step_s=setting.period_s)
    world.place(reference.position[0])
    controller = TorqueController(_tiled(setting.gains, copies), setting.period_s)
    question = torque_question(biped)
    kept = setting.drive.kept(setting.period_s)
    torque_error = np.full((copies, steps, joints), np.nan)
    centre_error, positions = np.full((copies, steps, 2), np.nan), np.full((copies, steps, joints), np.nan)
    fallen = np.full(copies, steps)
    awake = np.ones(copies, dtype=bool)
    late: deque[FloatArray] = deque()
    for k in range(steps):
        progress(k)
        posture = world.look(awake)
        desired = setting.balance.desired(posture, reference, k)
        if k == 0:
            torque = desired
            late.extend([desired] * (1 + setting.delay_steps))
        newest = late.popleft()
        if k % setting.hold_steps == 0:
            estimate = newest
        velocity = posture.velocity[:, 6:]
        duty = controller.step(desired.ravel(), estimate.ravel(), velocity.ravel()).reshape(copies, joints)
        acceleration, wrenches = world.advance(
            torque, awake, pelvis_N=push_N if k * setting.period_s < _PUSH_S else 0.0
        )
        both = np.concatenate([errors.reading(wrenches, rng), wrenches])
        twice = (np.concatenate([rows, rows]) for rows in (posture.position, posture.velocity, acceleration))
        measured, true = np.split(estimated_torques(question, *twice, readings=both), 2)
        late.append(measured)
        torque_error[awake, k] = (true - desired)[awake]
        centre_error[awake, k] = (posture.centre_of_mass[:, :2] - reference.centre_of_mass[k])[awake]
        positions[awake, k] = posture.position[awake, 7:]
        torque = kept * torque + (1.0 - kept) * setting.drive.torque_per_duty * duty
        fallen[awake & _down(posture, reference, k)] = k
        awake = fallen == steps
    return LoopRun(
        reference=reference,
        period_s=setting.period_s,
        torque_error=torque_error,
        centre_error=centre_error,
        joints=positions,
        fallen=fallen,
    )


def _tiled(gains: TorqueGains, copies: int) -> TorqueGains:
    """Gains of all copies in a row: one controller then steps all of them."""
    return TorqueGains(
        joints=tuple(f"{joint} of {k}" for k in range(copies) for joint in gains.joints),
        duty_torque=np.tile(gains.duty_torque, copies),
        proportional=np.tile(gains.proportional, copies),
        integral=np.tile(gains.integral, copies),
        derivative=np.tile(gains.derivative, copies),
        bemf=np.tile(gains.bemf, copies),
        coulomb=np.tile(gains.coulomb, copies),
        standstill=np.tile(gains.standstill, copies),
        limit=np.tile(gains.limit, copies),
        derivative_time_s=gains.derivative_time_s,
        blend_s=gains.blend_s,
    )


def _down(posture: Posture, reference: Reference, k: int) -> BoolArray:
    low = posture.position[:, 2] < reference.position[k, 2] - _FALLEN_M
    upright = rotations(posture.position[:, 3:7])[:, 2, 2]
    return low | (upright < _FALLEN_UPRIGHT)
