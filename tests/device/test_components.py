# SPDX-License-Identifier: BSD-3-Clause
"""What a device may be made of, and what not."""

from __future__ import annotations

import numpy as np
import pytest
from pydantic import ValidationError

from forcetorque.base.errors import SensorError
from forcetorque.device.components import AttachedLoad, Hinge, Turn, device_load, part_inertia
from forcetorque.device.device_file import read_device
from forcetorque.device.robot_model import BASE, device_model
from forcetorque.robot.dynamics import link_pose
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.tree import build_tree

DEVICE = read_device()


def test_sensors_are_stacked() -> None:
    """Each makes the stack higher by its height, and has a name and a serial number of its own."""
    heights = []
    for count in (1, 2, 3):
        device = DEVICE.with_sensors(count)
        assert len(set(device.sensor_names)) == count
        level = JointMotion.at_rest(device.joint_names, np.zeros((1, len(device.joint_names))))
        tree = build_tree(device_model(device, device_load(device, 35.0)), BASE)
        heights.append(link_pose(tree, level, "carrier")[0, 0, 3])
    np.testing.assert_allclose(np.diff(heights), DEVICE.sensor[0].height_m, rtol=1e-9)


@pytest.mark.parametrize("load_kg", [5.0, 35.0])
def test_plates_are_a_solid_cylinder_beyond_the_foot_beside_the_carrier(load_kg: float) -> None:
    """Against a sum over small rings: mass, first moment and second moments about the carrier's frame."""
    weights, carrier = DEVICE.weights, part_inertia(DEVICE.carrier)
    whole = device_load(DEVICE, load_kg).inertia
    first, second = whole.first_moment - carrier.first_moment, whole.second_moment - carrier.second_moment
    height = weights.height_m * load_kg / weights.step_kg
    radii, places = (np.arange(400) + 0.5) / 400.0 * weights.radius_m, (np.arange(400) + 0.5) / 400.0 * height
    share, up = radii / radii.sum(), weights.foot_m + places
    mass, square = load_kg - DEVICE.carrier.mass_kg, float(share @ radii**2)
    across = mass * (square / 2.0 + float((up**2).mean()))
    assert whole.mass == pytest.approx(load_kg)
    np.testing.assert_allclose(first, [0.0, 0.0, mass * up.mean()], rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(second, np.diag([across, across, mass * square]), rtol=1e-4, atol=1e-12)


def test_a_hinge_of_a_file_that_states_no_more_is_that_of_the_thesis() -> None:
    """It locks by itself at 0 and at 90 degrees, and its stops are those of the default device."""
    hinge = Hinge(bracket=DEVICE.hinge.bracket)
    assert hinge.locks_deg == (0.0, 90.0)
    assert hinge.range_deg == DEVICE.hinge.range_deg


def test_a_turn_is_a_joint_before_the_hinge() -> None:
    """Its joint is there only if the device has one."""
    assert DEVICE.joint_names == ("pitch", "yaw", "hinge")
    turned = DEVICE.changed(turn=Turn())
    assert turned.joint_names == ("pitch", "yaw", "turn", "hinge")
    assert device_model(turned, device_load(turned, 5.0)).joints["hinge"].parent == "bracket"


def test_axes_are_unit_vectors() -> None:
    """As a joint of a robot model has them, of every kind of device."""
    for device in (DEVICE, DEVICE.changed(turn=Turn(), yaw_first=True)):
        axes = [joint.axis for joint in device_model(device, device_load(device, 5.0)).joints.values()]
        assert len(axes) > len(device.joint_names)
        np.testing.assert_allclose(np.linalg.norm(axes, axis=1), 1.0, rtol=1e-12)


@pytest.mark.parametrize(
    ("count", "words"), [(0, "at least 1 item"), (4, "at most 3 items")], ids=["without a sensor", "too many"]
)
def test_a_stack_has_one_to_three_sensors(count: int, words: str) -> None:
    """None and four are refused."""
    with pytest.raises(ValidationError, match=words):
        DEVICE.with_sensors(count)


def test_two_sensors_of_one_name_are_refused() -> None:
    """Names tell them apart in every file."""
    with pytest.raises(ValidationError, match="expected each name once, got ft_1, ft_1"):
        DEVICE.changed(sensor=DEVICE.sensor * 2)


def test_a_lock_beyond_the_stops_is_refused() -> None:
    """The hinge cannot go there."""
    with pytest.raises(ValidationError, match="lock at 120 deg: expected one within range_deg"):
        DEVICE.with_locks(0.0, 120.0)


@pytest.mark.parametrize(("field", "value"), [("step_kg", 0.0), ("most_kg", 0.0), ("step_kg", 40.0), ("step_kg", 1.0)])
def test_weights_that_are_none_are_refused(field: str, value: float) -> None:
    """A plate weighs more than the carrier, and no more than all plates."""
    with pytest.raises(ValidationError, match=r"greater than 0|0 kg < carrier < weights.step_kg"):
        DEVICE.changed(weights=DEVICE.weights.model_copy(update={field: value}))


def test_loads_are_stated_once() -> None:
    """A load to calibrate with is none to judge with."""
    simulation = DEVICE.simulation.model_copy(update={"validation_kg": (35.0,)})
    with pytest.raises(ValidationError, match="expected each load once in loads_kg and validation_kg"):
        DEVICE.changed(simulation=simulation)


@pytest.mark.parametrize(
    ("mass_kg", "distance_m"),
    [(0.0, 0.1), (-1.0, 0.1), (np.inf, 0.1), (np.nan, 0.1), (1.0, 0.0), (1.0, -0.1), (1.0, np.inf), (1.0, np.nan)],
)
def test_a_point_mass_is_in_front_of_the_hinge(mass_kg: float, distance_m: float) -> None:
    """At the hinge it would hang at no position; the lightest and nearest one does."""
    with pytest.raises(SensorError, match="expected a mass of more than 0 kg in front of the hinge, got"):
        AttachedLoad.point(mass_kg, distance_m)
    load = AttachedLoad.point(1e-3, 1e-3)
    assert (load.mass_kg, load.centre_of_mass_m.tolist()) == (1e-3, [0.0, 0.0, 1e-3])
