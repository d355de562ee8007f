# SPDX-License-Identifier: BSD-3-Clause
"""The loop of the zero moment point: sway alone, a simulation in time, what a foot's sensor measures."""

from __future__ import annotations

import math
from collections import deque

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.pose import invert_pose
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.base.wrench import transform_wrench
from forcetorque.locomotion.torque_control.biped_in_mujoco import Biped
from forcetorque.locomotion.torque_control.torque_loop_file import TorqueLoopFile
from forcetorque.locomotion.torque_control.walking_loop import WalkingController, zmp_sensitivity

CONTROLLER = TorqueLoopFile().walking
TRUE = np.eye(2, 4)
"""What a sensor without errors measures."""


def test_without_feedback_of_the_point_the_body_sways() -> None:
    """By its natural frequency and damping, which is the slowest mode there."""
    alone = CONTROLLER.model_copy(update={"zmp_gain": 0.0}).stability(TRUE, 30.0)
    natural = 2.0 * math.pi * CONTROLLER.sway_hz
    assert alone.growth == pytest.approx(-CONTROLLER.damping * natural, rel=1e-6)
    assert alone.frequency_hz == pytest.approx(CONTROLLER.sway_hz * math.sqrt(1.0 - CONTROLLER.damping**2), rel=1e-6)


def _simulated(controller: WalkingController, sensitivity: FloatArray, mass: float, seconds: float) -> FloatArray:
    """Place of the centre of mass at each millisecond, by Euler steps of 20 us; both axes; (n, 2)."""
    omega = math.sqrt(STANDARD_GRAVITY / controller.height_m)
    natural = 2.0 * math.pi * controller.sway_hz
    kappa, delta = 1.0 + (natural / omega) ** 2, 2.0 * controller.damping * natural / omega**2
    x, v, c, command = np.array([1e-3, -2e-3]), np.zeros(2), np.zeros(2), np.zeros(2)
    late: deque[FloatArray] = deque([np.zeros(2)] * round(controller.delay_s / 1e-3))
    places = []
    for k in range(round(seconds / 1e-3)):
        rate = (command - c) / controller.lag_s
        zmp = kappa * (x - c) + delta * (v - rate)
        late.append(sensitivity @ np.concatenate([zmp, mass * omega**2 * (x - zmp)]))
        measured = late.popleft()
        if k % round(controller.period_s / 1e-3) == 0:
            wanted = controller.dcm_gain * (c + rate / omega)
            command = command + controller.period_s * (
                -controller.centre_gain * c - controller.zmp_gain * (wanted - measured)
            )
        for _ in range(50):
            rate = (command - c) / controller.lag_s
            zmp = kappa * (x - c) + delta * (v - rate)
            x, v, c = x + 2e-5 * v, v + 2e-5 * omega**2 * (x - zmp), c + 2e-5 * rate
        places.append(x)
    return np.array(places)


@pytest.mark.parametrize(("sway_hz", "grows"), [(4.0, False), (5.5, True)])
def test_a_simulation_in_time_grows_or_dies_as_predicted(sway_hz: float, grows: bool) -> None:
    """At the rate of the mode, with a sensor that mixes the axes."""
    controller = CONTROLLER.model_copy(update={"sway_hz": sway_hz})
    sensitivity = np.array([[1.05, 0.04, 1e-4, 0.0], [-0.06, 0.97, 0.0, -1e-4]])
    predicted = controller.stability(sensitivity, 30.0)
    assert predicted.stable is not grows
    places = np.linalg.norm(_simulated(controller, sensitivity, 30.0, 2.0), axis=1)
    growth = math.log(places[1500:2000].max() / places[1000:1500].max()) / 0.5
    assert growth == pytest.approx(predicted.growth, abs=0.5)


@pytest.mark.parametrize("tilt_deg", [0.0, 10.0])
def test_a_true_sensor_measures_the_point_whatever_the_tilt(tilt_deg: float) -> None:
    """The tilt is known to the model."""
    assert zmp_sensitivity(Biped.on_soles(tilt_deg), np.zeros((6, 6))) == pytest.approx(TRUE, abs=1e-12)


@pytest.mark.parametrize("tilt_deg", [0.0, 10.0])
def test_errors_change_the_measured_point_as_differences_say(tilt_deg: float) -> None:
    """Of the point that a wrong reading gives."""
    biped = Biped.on_soles(tilt_deg)
    matrix = 0.05 * np.random.default_rng(3).standard_normal((6, 6))
    foot_H_sole = biped.model.joints["l_sole_joint"].parent_H_child
    centre = invert_pose(foot_H_sole)[:2, 3]
    weight = biped.mass * STANDARD_GRAVITY

    def measured(change: FloatArray) -> FloatArray:
        x, y = centre + change[:2]
        sole_wrench = np.array([change[2], change[3], weight, y * weight, -x * weight, 0.0])
        reading = (np.eye(6) + matrix) @ transform_wrench(foot_H_sole, sole_wrench)
        read = transform_wrench(invert_pose(foot_H_sole), reading)
        return np.array([-read[4], read[3]]) / read[2]

    steps = 1e-5 * np.eye(4)
    slope = np.array([(measured(step) - measured(-step)) / 2e-5 for step in steps]).T
    assert zmp_sensitivity(biped, matrix) == pytest.approx(slope, abs=1e-7)
    assert np.abs(slope[:, :2] - np.eye(2)).max() > 0.01
