# SPDX-License-Identifier: BSD-3-Clause
"""The loop of a walking controller that feeds the measured zero moment point back, linear, on one foot.

Joints are controlled in position. Each period the controller moves the commanded centre of mass by

    dc/dt = -K_com c - K_zmp (p_wanted - p_measured),   p_wanted = K_dcm (c + (dc/dt) / omega)

all as deviations from the plan, as in Romualdi et al., "A Benchmarking of DCM Based Architectures for Position and
Velocity Controlled Walking of Humanoid Robots", 2018, the controller [111] of the thesis. The centre of mass of the
joints follows with a lag, the true one stands on a spring, the compliance of ankles, gears and soles:

    d2x/dt2 = omega^2 (x - p),   p = kappa (x - c) + delta d(x - c)/dt
"""

from __future__ import annotations

from typing import Annotated, Final

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import FloatArray
from forcetorque.base.pose import invert_pose
from forcetorque.base.toml_file import NotNegative, Positive, Table
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.base.wrench import wrench_matrix
from forcetorque.locomotion.torque_control.biped_in_mujoco import Biped
from forcetorque.locomotion.torque_control.stability import Stability

_STEP_S: Final = 0.001
"""Step in which delays are counted; s."""
_SOLE: Final = "l_sole_joint"


class WalkingController(Table):
    """A walking controller that feeds the measured zero moment point back.

    Gains, period and height are those that its authors publish for iCubGenova04 (robotology/walking-controllers).
    """

    zmp_gain: NotNegative = 3.5
    """K_zmp, while walking; 1/s."""
    centre_gain: NotNegative = 10.0
    """K_com, while walking; 1/s."""
    dcm_gain: NotNegative = 1.1
    """K_dcm."""
    period_s: Annotated[float, Field(ge=_STEP_S, le=0.1)] = 0.01
    """Period; whole milliseconds; s."""
    delay_s: Annotated[float, Field(ge=0.0, le=0.5)] = 0.01
    """How late the measured point is; whole milliseconds; s. Assumed."""
    height_m: Positive = 0.53
    """Height of the centre of mass; m."""
    lag_s: Positive = 0.02
    """Time constant of the position control of the joints; s. Assumed."""
    sway_hz: Positive = 3.0
    """Natural frequency of the body on the compliance of ankles, gears and soles; Hz. Assumed."""
    damping: Annotated[float, Field(ge=0.0, lt=1.0)] = 0.05
    """Its damping ratio. Assumed."""

    def transition(self, sensitivity: FloatArray, mass: float) -> FloatArray:
        """Give what one period does to all states.

        Args:
            sensitivity: Measured zero moment point by the true one and by the horizontal force; shape (2, 4).
            mass: Mass of the robot; kg.

        Returns:
            Shape (s, s); per axis x, its rate, c of the joints, commanded c; then late measurements.
        """
        from scipy.linalg import expm  # here because importing it takes longer than most commands

        omega = float(np.sqrt(STANDARD_GRAVITY / self.height_m))
        natural = 2.0 * np.pi * self.sway_hz
        kappa, delta = 1.0 + (natural / omega) ** 2, 2.0 * self.damping * natural / omega**2
        x, v, c, command = np.eye(4)
        rate = (command - c) / self.lag_s
        zmp = kappa * (x - c) + delta * (v - rate)
        moved = expm(_STEP_S * np.vstack([v, omega**2 * (x - zmp), rate, np.zeros(4)]))
        both = np.eye(2)
        true = np.vstack([np.kron(both, zmp), mass * omega**2 * np.kron(both, x - zmp)])
        late = round(self.delay_s / _STEP_S)
        whole = np.eye(8 + 2 * late)
        states = whole[:8]
        line = [whole[k : k + 2] for k in range(8, len(whole), 2)] + [sensitivity @ true @ states]  # oldest first
        wanted = self.dcm_gain * np.kron(both, c + rate / omega) @ states
        demand = -self.centre_gain * np.kron(both, c) @ states - self.zmp_gain * (wanted - line[0])
        commanded = states + self.period_s * np.kron(both, command[:, None]) @ demand

        def step(before: FloatArray) -> FloatArray:
            return np.vstack([np.kron(both, moved) @ before, *line[1:]])

        held = np.linalg.matrix_power(step(states), round(self.period_s / _STEP_S) - 1)
        return np.asarray(held @ step(commanded))

    def stability(self, sensitivity: FloatArray, mass: float) -> Stability:
        """Check whether the robot stands.

        Args:
            sensitivity: As in `transition`.
            mass: As there; kg.

        Returns:
            The mode that grows fastest.
        """
        values = np.linalg.eigvals(self.transition(sensitivity, mass))
        k = int(np.abs(values).argmax())
        frequency_hz = float(abs(np.angle(values[k]))) / (2.0 * np.pi * self.period_s)
        return Stability(growth=float(np.log(abs(values[k]))) / self.period_s, frequency_hz=frequency_hz)


def zmp_sensitivity(biped: Biped, matrix: FloatArray) -> FloatArray:
    """Give what the foot's sensor makes of changes of the zero moment point and of horizontal forces.

    The weight is on the left foot, the zero moment point below the sensor. The tilt of the sole is known.

    Args:
        biped: The robot.
        matrix: E of the sensor; shape (6, 6).

    Returns:
        Measured point by the true one (m/m) and by the horizontal force (m/N); shape (2, 4).
    """
    foot_H_sole = biped.model.joints[_SOLE].parent_H_child
    sole_H_foot = invert_pose(foot_H_sole)
    weight = biped.mass * STANDARD_GRAVITY
    sole_read = wrench_matrix(sole_H_foot) @ (np.eye(6) + matrix) @ wrench_matrix(foot_H_sole)
    px, py = sole_H_foot[:2, 3]
    load = np.array([0.0, 0.0, weight, py * weight, -px * weight, 0.0])
    by_point = weight * np.array([[0, 0, 0, 0, -1, 0], [0, 0, 0, 1, 0, 0]], dtype=np.float64).T
    by_force = np.eye(6)[:, :2]
    read, change = sole_read @ load, sole_read @ np.hstack([by_point, by_force])
    # x = -tau_y / f_z, y = tau_x / f_z
    point = np.array([-read[4], read[3]]) / read[2]
    return np.array((np.stack([-change[4], change[3]]) - point[:, None] * change[2]) / read[2])
