# SPDX-License-Identifier: BSD-3-Clause
"""One joint under torque control, by the controller itself and by transfer functions that share no code with it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy import signal

from forcetorque.base.arrays import FloatArray
from forcetorque.locomotion.torque_control.joint_torque_controller import TorqueController, TorqueGains
from forcetorque.locomotion.torque_control.stability import LinearPlant

PERIOD_S = 0.001
LAG_S = 0.01
DUTY_TORQUE = 80.0
GAINS = TorqueGains.of(
    ["knee"],
    duty_torque=DUTY_TORQUE,
    proportional=0.02,
    integral=0.3,
    derivative=5e-5,
    derivative_time_s=0.003,
    limit=1.0,
)


def closed_loop(
    gains: TorqueGains,
    plant: LinearPlant,
    desired: FloatArray,
    *,
    reading: Callable[[int, float], float] = lambda _, torque: torque,
    delay: int = 0,
    hold: int = 1,
) -> tuple[FloatArray, FloatArray, TorqueController]:
    """Run the controller of one joint on a plant.

    Args:
        gains: Of one joint.
        plant: Of one joint.
        desired: Desired torque; shape (n,); N m.
        reading: From the step and the true torque, N m, to the estimate of it.
        delay: Steps by which estimates come late.
        hold: Steps for which an estimate is used.

    Returns:
        True torques right before every step, duty cycles from it on, both of shape (n,), and the controller.
    """
    controller = TorqueController(gains, PERIOD_S)
    by_state, by_duty = plant.sampled(PERIOD_S)
    state, duty = np.zeros(len(plant.a)), np.zeros(1)
    torques, duties = np.zeros(len(desired)), np.zeros(len(desired))
    for k, wanted in enumerate(desired):
        torques[k] = (plant.c @ state + plant.d @ duty)[0]
        if k % hold == 0:
            estimate = reading(k, torques[k - delay] if k >= delay else 0.0)
        duty = controller.step(np.array([wanted]), np.array([estimate]), plant.velocity @ state)
        duties[k] = duty[0]
        state = by_state @ state + by_duty @ duty
    return torques, duties, controller


def transfer(*, gains: TorqueGains = GAINS, lag_s: float = LAG_S, delay: int = 0) -> signal.TransferFunction:
    """From desired to true torque of a held joint, by polynomials in z."""
    plant = signal.cont2discrete(([float(gains.duty_torque[0])], [lag_s, 1.0]), PERIOD_S, method="zoh")
    number, below = np.trim_zeros(np.ravel(plant[0]), "f"), np.ravel(plant[1])
    kept = np.exp(-PERIOD_S / gains.derivative_time_s)
    one, late, filtered = np.array([1.0, 0.0]), np.array([1.0, -1.0]), np.array([1.0, -kept])
    # K_p + K_i T z / (z - 1) + K_d (1 - a) / T (z - 1) / (z - a), over one denominator
    pid = np.polyadd(
        gains.proportional[0] * np.polymul(late, filtered),
        np.polyadd(
            gains.integral[0] * PERIOD_S * np.polymul(one, filtered),
            gains.derivative[0] * (1.0 - kept) / PERIOD_S * np.polymul(late, late),
        ),
    )
    pid_below = np.polymul(late, filtered)
    forward = np.polyadd(pid_below / gains.duty_torque[0], pid)  # the desired torque goes in directly as well
    delayed = np.concatenate([[1.0], np.zeros(delay)])
    closed = np.polyadd(np.polymul(np.polymul(below, pid_below), delayed), np.polymul(number, pid))
    return signal.TransferFunction(np.polymul(np.polymul(number, forward), delayed), closed, dt=PERIOD_S)
