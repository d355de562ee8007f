# SPDX-License-Identifier: BSD-3-Clause
"""A simulated Panda with a tool, as libfranka writes its states: held, by its joint torques; moved, by its wrench."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from forcetorque.base.arrays import FloatArray
from forcetorque.base.pose import make_pose
from forcetorque.formats.arm_log import holding_torques
from forcetorque.formats.franka.kinematics import joint_frames
from tests.payload.simulated_ur5 import RATE_HZ, held_and_moved, load_on_flange

GRAVITY = 9.80665
SAMPLES = 3
"""Samples of each posture."""
_LOWEST = np.array([-2.8, -1.7, -2.8, -3.0, -2.8, 0.0, -2.8])
_HIGHEST = np.array([2.8, 1.7, 2.8, -0.1, 2.8, 3.7, 2.8])
"""Range of each joint; rad."""
_ERROR_NM = np.array([0.1, 0.12, 0.1, 0.1, 0.05, 0.05, 0.03])
"""Error of the torque of each joint that a posture keeps; N m."""
_NOISE_NM = 0.02
"""Noise of a sample; N m."""


def holding(position: FloatArray, mass: float, centre: FloatArray) -> FloatArray:
    """Torques that hold a load at rest; angles and torques of shape (n, 7); rad, N m."""
    frames, flange = joint_frames(position)
    gravity = np.array([0.0, 0.0, -GRAVITY])
    return holding_torques(frames[:, :, :3, 2], frames[:, :, :3, 3], flange, gravity) @ np.append(mass, mass * centre)


@dataclass(frozen=True, kw_only=True)
class Held:
    """Postures, and the truth of the tool."""

    position: FloatArray
    """Angles of each posture; shape (k, 7); rad."""
    torque: FloatArray
    """Logged torques of each sample; shape (k SAMPLES, 7); N m."""
    bias: FloatArray
    """Torque without a load; shape (7,); N m."""
    mass: float
    """kg."""
    centre: FloatArray
    """In the flange; shape (3,); m."""

    def states(self, *, sense: float = 1.0) -> list[dict[str, Any]]:
        """Give the states without a wrench."""
        angles = np.repeat(self.position, SAMPLES, axis=0)
        return [
            {
                "time": 1000 + 2000 * (k // SAMPLES) + k % SAMPLES,
                "q": angles[k].tolist(),
                "dq": [0.0] * 7,
                "tau_J": [1.0] * 7,
                "tau_ext_hat_filtered": (sense * self.torque[k]).tolist(),
                "O_T_EE": [0.0] * 16,
            }
            for k in range(len(angles))
        ]


def held(seed: int, *, postures: int = 12, moves: Sequence[int] = range(7)) -> Held:
    """Draw a tool, biases and errors of the joints, and postures that differ in some joints."""
    rng = np.random.default_rng(seed)
    position = np.tile(rng.uniform(_LOWEST, _HIGHEST), (postures, 1))
    chosen = list(moves)
    position[:, chosen] = rng.uniform(_LOWEST, _HIGHEST, (postures, 7))[:, chosen]
    mass, centre = float(rng.uniform(0.3, 3.0)), np.append(rng.uniform(-0.03, 0.03, 2), rng.uniform(0.03, 0.12))
    bias = 0.3 * rng.normal(size=7)
    torque = holding(position, mass, centre) + bias + _ERROR_NM * rng.normal(size=(postures, 7))
    samples = np.repeat(torque, SAMPLES, axis=0)
    return Held(
        position=position,
        torque=samples + _NOISE_NM * rng.normal(size=samples.shape),
        bias=bias,
        mass=mass,
        centre=centre,
    )


@dataclass(frozen=True, kw_only=True)
class Moved:
    """Motions between postures, and the truth of the tool."""

    base_H_flange: FloatArray
    """Shape (n, 4, 4); m."""
    flange_H_k: FloatArray
    """Pose of the stiffness frame, which is that of the end effector; shape (4, 4); m."""
    wrench: FloatArray
    """Of the tool on the flange, less what the controller knows; shape (n, 6); N, N m."""
    declared: float
    """Mass that the controller knows, at the origin of the flange; kg."""
    mass: float
    """kg."""
    centre: FloatArray
    """In the flange; shape (3,); m."""

    def states(
        self,
        *,
        sense: float = -1.0,
        along_flange: bool = False,
        about_flange: bool = False,
        pose_unit: float = 1.0,
        moment_unit: float = 1.0,
    ) -> list[dict[str, Any]]:
        """Give the states, with `O_F_ext_hat_K` as libfranka has it or with a mistake.

        Args:
            sense: -1 for the wrench of the robot on its environment, 1 for that of the environment on the robot.
            along_flange: Whether it is along the axes of the flange, not of the base.
            about_flange: Whether its moment is about the flange, not about the stiffness frame.
            pose_unit: Lengths of `O_T_EE` and `F_T_EE` are times this; 1000 for mm.
            moment_unit: Moments are times this; 1000 for N mm.

        Returns:
            A state for each sample.
        """
        force, moment = self.wrench[:, :3], self.wrench[:, 3:]
        if not about_flange:
            moment = moment - np.cross(self.flange_H_k[:3, 3], force)
        turn = np.eye(3)[None] if along_flange else self.base_H_flange[:, :3, :3]
        logged = [
            sense * np.einsum("nij,nj->ni", np.broadcast_to(turn, (len(force), 3, 3)), part)
            for part in (force, moment_unit * moment)
        ]
        base_H_ee, flange_H_k = self.base_H_flange @ self.flange_H_k, self.flange_H_k.copy()
        base_H_ee[:, :3, 3] *= pose_unit
        flange_H_k[:3, 3] *= pose_unit
        return [
            {
                "time": round(1000 * k / RATE_HZ),
                "O_T_EE": pose.T.ravel().tolist(),
                "F_T_EE": flange_H_k.T.ravel().tolist(),
                "EE_T_K": np.eye(4).ravel().tolist(),
                "m_load": self.declared,
                "F_x_Cload": [0.0, 0.0, 0.0],
                "O_F_ext_hat_K": wrench.tolist(),
                "tau_J": [0.0] * 7,
            }
            for k, (pose, wrench) in enumerate(zip(base_H_ee, np.hstack(logged), strict=True))
        ]


def moved(seed: int, *, postures: int = 12, declared_shares: Sequence[float] = (0.0, 0.5)) -> Moved:
    """Draw a tool, an end effector frame, a zero, a declared load, and motions between postures."""
    rng = np.random.default_rng(seed)
    mass, centre = float(rng.uniform(0.3, 3.0)), np.append(rng.uniform(-0.03, 0.03, 2), rng.uniform(0.03, 0.12))
    zero = rng.normal(size=6) * np.repeat([1.0, 0.1], 3)
    flange_H_k = make_pose(Rotation.random(random_state=seed).as_matrix(), [0.0, 0.01, rng.uniform(0.05, 0.2)])
    declared = mass * float(rng.choice(declared_shares))
    _, pose = joint_frames(held_and_moved(rng.uniform(_LOWEST, _HIGHEST, (postures, 7))))
    known = declared * np.einsum("nji,j->ni", pose[:, :3, :3], [0.0, 0.0, -GRAVITY])
    wrench = load_on_flange(rng, pose, mass, centre) + zero
    wrench[:, :3] -= known
    return Moved(base_H_flange=pose, flange_H_k=flange_H_k, wrench=wrench, declared=declared, mass=mass, centre=centre)
