# SPDX-License-Identifier: BSD-3-Clause
"""The balancing controller above the torque loops: weight compensation, a PD on the centre of mass, a PD on posture.

    f = m (ddc_ref + g up) + K_c (c_ref - c) + D_c (dc_ref - dc)             what the ground is to do to the robot
    W_i = share_i (f at the sole, and the moment that brings f through c)    what each foot bears of it
    tau_d = h - sum_i J_i' W_i + K_q (q_ref - q) + D_q (dq_ref - dq)         torques of the joints

`h` are Coriolis forces and gravity, `J_i` the Jacobian of sole i. With the shares of the reference this is a static
solution of the robot's equation wherever the centre of mass is, so that without errors nothing leans on the PDs.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.constants import STANDARD_GRAVITY
from forcetorque.simulation.torque_loop.biped import SOLE_CENTRE
from forcetorque.simulation.torque_loop.switching import Reference
from forcetorque.simulation.torque_loop.world import Posture
from forcetorque.spatial import cross


@dataclass(frozen=True, slots=True, kw_only=True)
class Balance:
    """Gains of the balancing controller."""

    mass: float
    """Mass of the robot; kg."""
    centre_stiffness: float
    """K_c; N/m."""
    centre_damping: float
    """D_c; N s/m."""
    posture_stiffness: float
    """K_q of every joint; N m/rad."""
    posture_damping: float
    """D_q of every joint; N m s/rad."""

    def desired(self, posture: Posture, reference: Reference, k: int) -> FloatArray:
        """Give the torques that are wanted.

        Args:
            posture: What the copies do.
            reference: What they should do.
            k: Instant of the reference.

        Returns:
            tau_d; shape (B, 12); N m.
        """
        wrench = self.sole_wrenches(posture, reference, k)
        borne = np.einsum("bscv,bsc->bv", posture.sole_jacobian, wrench)[:, 6:]
        pull = self.posture_stiffness * (reference.position[k, 7:] - posture.position[:, 7:])
        pull += self.posture_damping * (reference.velocity[k] - posture.velocity[:, 6:])
        torque: FloatArray = posture.bias[:, 6:] - borne + pull
        return torque

    def sole_wrenches(self, posture: Posture, reference: Reference, k: int) -> FloatArray:
        """Give what the ground is to do to each sole.

        Args:
            posture: What the copies do.
            reference: What they should do.
            k: Instant of the reference.

        Returns:
            Wrenches along the axes of the world, about the origins of the soles; shape (B, 2, 6); N, N m.
        """
        force = self._force(posture, reference, k)
        middle = np.array([*SOLE_CENTRE, 0.0])
        share = reference.share[k]
        lever = posture.centre_of_mass - np.tensordot(posture.sole_position, share, axes=([1], [0])) - middle
        moment = cross(lever, force) + cross(np.broadcast_to(middle, force.shape), force)
        wrench: FloatArray = share[:, None] * np.concatenate([force, moment], axis=1)[:, None]
        return wrench

    def _force(self, posture: Posture, reference: Reference, k: int) -> FloatArray:
        """What the ground is to do to the robot; shape (B, 3)."""
        centre_velocity = np.einsum("bcv,bv->bc", posture.centre_jacobian, posture.velocity)
        force = np.zeros_like(posture.centre_of_mass)
        force[:, :2] = self.centre_stiffness * (reference.centre_of_mass[k] - posture.centre_of_mass[:, :2])
        force[:, :2] += self.centre_damping * (reference.centre_velocity[k] - centre_velocity[:, :2])
        force[:, :2] += self.mass * reference.centre_acceleration[k]
        force[:, 2] = self.mass * STANDARD_GRAVITY
        return force
