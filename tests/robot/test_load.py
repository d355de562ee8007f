# SPDX-License-Identifier: BSD-3-Clause
"""A known mass changes readings by its weight."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.errors import RobotError
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.robot.dynamics import expected_wrenches
from forcetorque.robot.model import RobotModel
from forcetorque.robot.modified_robot import with_load
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree
from tests.simulation.motions.stands import robot

AT = np.array([0.03, -0.02, 0.05])


def _reading(model: RobotModel, sensor: str, support: str) -> np.ndarray:
    names = tuple(joint.name for joint in model.joints.values() if joint.type.moves)
    still = JointMotion.at_rest(names, np.zeros((1, len(names))))
    return expected_wrenches(build_tree(model, support), still, RootMotion.fixed([0, 0, -1]))[sensor][0]


def test_a_hanging_limb_reads_the_weight_of_its_load() -> None:
    """2 kg in a foot that hangs pull with m g, and turn about the sensor with the lever to where they are."""
    plain = robot("biped")
    heavier = with_load(plain, "l_foot", mass_kg=2.0, centre_of_mass_m=AT)
    change = _reading(heavier, "l_foot_ft", "pelvis") - _reading(plain, "l_foot_ft", "pelvis")
    force = np.array([0.0, 0.0, -2.0 * STANDARD_GRAVITY])
    np.testing.assert_allclose(change, [*force, *np.cross(AT, force)], rtol=0, atol=1e-12)
    other = _reading(heavier, "r_foot_ft", "pelvis") - _reading(plain, "r_foot_ft", "pelvis")
    np.testing.assert_array_equal(other, 0.0)


def test_a_standing_foot_does_not_read_the_load_below_it() -> None:
    """What rests on the ground below the sensor is not felt; what is above it is."""
    plain = robot("biped")
    for link, expected in (("l_foot", 0.0), ("torso", 2.0 * STANDARD_GRAVITY)):
        heavier = with_load(plain, link, mass_kg=2.0, centre_of_mass_m=AT)
        change = _reading(heavier, "l_foot_ft", "l_sole") - _reading(plain, "l_foot_ft", "l_sole")
        assert change[2] == pytest.approx(expected, abs=1e-9)


def test_the_inertia_is_added_about_the_right_point() -> None:
    """A point turns like a point, a body like a body; the robot itself is not changed."""
    plain = robot("biped")
    before = plain.links["l_foot"].second_moment
    point = with_load(plain, "l_foot", mass_kg=2.0, centre_of_mass_m=AT).links["l_foot"]
    steiner = 2.0 * (AT @ AT * np.eye(3) - np.outer(AT, AT))
    np.testing.assert_allclose(point.second_moment - before, steiner, rtol=0, atol=1e-15)
    body = with_load(plain, "l_foot", mass_kg=2.0, centre_of_mass_m=AT, second_moment=0.1 * np.eye(3)).links["l_foot"]
    np.testing.assert_allclose(body.second_moment - point.second_moment, 0.1 * np.eye(3), rtol=0, atol=1e-15)
    assert plain.links["l_foot"].mass == 0.5
    assert point.mass == 2.5


def test_what_makes_no_sense_is_refused() -> None:
    """Unknown links and masses that are none."""
    with pytest.raises(RobotError, match="load: robot 'biped' has no link 'l_fot'; did you mean"):
        with_load(robot("biped"), "l_fot", mass_kg=1.0, centre_of_mass_m=AT)
    for mass in (-1.0, np.nan, np.inf):
        with pytest.raises(RobotError, match="load on 'torso': expected a mass of at least 0 kg"):
            with_load(robot("biped"), "torso", mass_kg=mass, centre_of_mass_m=AT)
