# SPDX-License-Identifier: BSD-3-Clause
"""The closed loop: balancing, torque controllers, drives, MuJoCo, sensors with errors, estimated torques."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.locomotion.torque_control.balancing import Balance, Reference
from forcetorque.locomotion.torque_control.controller import JointDrive, TorqueController, TorqueGains
from forcetorque.locomotion.torque_control.sensors import SensorErrors, estimated_torques, rotations, torque_question
from forcetorque.locomotion.torque_control.world import JOINTS, Biped, Posture, World

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

        Args:
            copies: Which.

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
