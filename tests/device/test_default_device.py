# SPDX-License-Identifier: BSD-3-Clause
"""The device that comes with the library has the figures that the thesis prints."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.errors import SensorError
from forcetorque.device.components import device_load
from forcetorque.device.device_file import read_device
from forcetorque.device.expected_wrench import device_response
from forcetorque.device.motion import twelve_steps
from forcetorque.device.robot_model import device_model
from forcetorque.robot.dynamics import link_pose
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.tree import build_tree

PRINTED_PEAK_NM = {"pitch": 131.3495, "yaw": 39.45}
"""Peaks of the motors with three sensors (thesis 6.4.2)."""
PRINTED = 0.05
"""How well a geometry that is stated to a tenth of a millimetre can meet them: 345 N over 0.1 mm; N m."""
LEVER_M = 0.245
"""From the innermost of three sensors to the load; m."""


def test_peaks_are_those_of_the_thesis() -> None:
    """With 35 kg and three sensors the motors hold what is printed, at rest in the 12 steps."""
    device = read_device().with_sensors(3)
    load = device_load(device, 35.0)
    answer = device_response(device, load, twelve_steps(device).still_poses(device, load))
    for joint, peak in PRINTED_PEAK_NM.items():
        assert np.abs(answer.torque(joint)).max() == pytest.approx(peak, abs=PRINTED)


@pytest.mark.parametrize(("sensors", "lever_m"), [(3, LEVER_M), (1, 0.165)])
def test_the_lever_of_the_innermost_sensor(sensors: int, lever_m: float) -> None:
    """The load hangs as far from the sensor as the file says, with three sensors and with one."""
    device = read_device().with_sensors(sensors)
    level = JointMotion.at_rest(device.joint_names, np.zeros((1, 3)))
    hinge = link_pose(build_tree(device_model(device, device_load(device, 35.0)), "ft_1_outboard"), level, "carrier")
    assert hinge[0, 2, 3] + device_load(device, 35.0).centre_of_mass_m[2] == pytest.approx(lever_m, abs=1e-3)


def test_loads_go_in_steps() -> None:
    """A load weighs what it is called, carrier included; the empty carrier weighs 2 kg."""
    device = read_device()
    assert device.loads_kg == (0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0)
    masses = [device_load(device, load).mass_kg for load in device.loads_kg]
    np.testing.assert_allclose(masses, [2.0, *device.loads_kg[1:]], rtol=1e-12)


@pytest.mark.parametrize("load_kg", [-5.0, 7.0, 40.0, float("nan")])
def test_other_loads_are_refused(load_kg: float) -> None:
    """There is no plate for them, and the message lists those that there are."""
    with pytest.raises(SensorError, match="takes 0, 5, 10, .* 35 kg, carrier included"):
        device_load(read_device(), load_kg)
