# SPDX-License-Identifier: BSD-3-Clause
"""A simulated Panda that is held in postures with a tool, as libfranka writes its states."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.formats.franka.kinematics import joint_frames
from forcetorque.formats.logged_torques import holding_torques

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
