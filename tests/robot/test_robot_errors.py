# SPDX-License-Identifier: BSD-3-Clause
"""A robot that differs from its model does so by what is stated, and in nothing else."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.errors import RobotError
from forcetorque.base.pose import skew
from forcetorque.robot.dynamics import expected_wrenches, link_pose
from forcetorque.robot.model import RobotModel
from forcetorque.robot.modified_robot import RobotErrors
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree
from forcetorque.simulation.motions.on_both_feet import sway_movement
from tests.simulation.motions.stances import stance
from tests.simulation.motions.stands import ROBOTS, robot

SIZES = {"mass": 0.02, "centre_m": 0.002, "joint_zero_rad": float(np.deg2rad(0.5))}


def _errors(model: RobotModel, seed: int = 1) -> RobotErrors:
    return RobotErrors.draw(model, **SIZES, rng=np.random.default_rng(seed))


@pytest.mark.parametrize("name", ROBOTS)
def test_joints_are_turned_where_they_read_zero(name: str) -> None:
    """Every link is where the model puts it with the errors added to the joints' coordinates."""
    model = robot(name)
    errors = _errors(model)
    names = tuple(errors.joint_zero_rad)
    assert set(names) == {joint.name for joint in model.joints.values() if joint.type.moves}
    read = np.random.default_rng(2).uniform(-0.3, 0.3, (3, len(names)))
    real = build_tree(errors.applied_to(model), model.root_link)
    nominal = build_tree(model, model.root_link)
    turned = JointMotion.at_rest(names, read + np.array(list(errors.joint_zero_rad.values())))
    away = 0.0
    for link in ("l_sole", "r_sole", "l_forearm"):
        pose = link_pose(real, JointMotion.at_rest(names, read), link)
        np.testing.assert_allclose(pose, link_pose(nominal, turned, link), rtol=0, atol=1e-12)
        away = max(away, float(np.abs(pose - link_pose(nominal, JointMotion.at_rest(names, read), link)).max()))
    assert away > 1e-3


def test_masses_and_centres_by_hand() -> None:
    """Masses are scaled, centres shifted, and the second moment about the centre goes with the mass."""
    model = robot("biped")
    errors = RobotErrors(mass={"l_foot": 0.1}, centre_m={"l_foot": np.array([0.01, 0, -0.02])}, joint_zero_rad={})
    real = errors.applied_to(model)
    before, after = model.links["l_foot"], real.links["l_foot"]
    assert after.mass == pytest.approx(1.1 * before.mass)
    shift = after.first_moment / after.mass - before.first_moment / before.mass
    np.testing.assert_allclose(shift, [0.01, 0, -0.02], atol=1e-15)
    about = []
    for inertia in (before, after):
        hat = skew(inertia.first_moment / inertia.mass)
        about.append(inertia.second_moment + inertia.mass * hat @ hat)
    np.testing.assert_allclose(about[1], 1.1 * about[0], atol=1e-15)
    assert all(real.links[link] is model.links[link] for link in model.links if link != "l_foot")
    assert real.joints == model.joints


def test_errors_scatter_as_stated() -> None:
    """Over many robots the standard deviations are those that were asked for."""
    model = robot("biped")
    drawn = [_errors(model, seed) for seed in range(40)]
    for values, size in (
        ([list(errors.mass.values()) for errors in drawn], 0.02),
        ([np.ravel(list(errors.centre_m.values())) for errors in drawn], 0.002),
        ([list(errors.joint_zero_rad.values()) for errors in drawn], SIZES["joint_zero_rad"]),
    ):
        assert np.std(values) == pytest.approx(size, rel=0.1)
        assert np.mean(values) == pytest.approx(0.0, abs=0.1 * size)


def test_the_model_errs_on_loads_of_the_robot() -> None:
    """Feet of the real robot stand, and what hangs on a sensor weighs another few percent than the model says."""
    real = _errors(robot("biped")).applied_to(robot("biped"))
    movement = sway_movement(stance("biped", model=real), rng=np.random.default_rng(4), duration_s=4.0)
    at = np.linspace(0.0, 4.0, 50)
    assert np.abs(movement.support_wrench(at)).max() < 1e-9
    for foot in ("l_sole", "r_sole"):
        pose = movement.base_pose(at, foot)
        assert np.ptp(pose, axis=0).max() < 1e-4
        np.testing.assert_allclose(pose[:, 2, :3], np.tile([0.0, 0, 1], (50, 1)), rtol=0, atol=1e-4)
    read = movement.readings(at, ["l_arm_ft"]).of_name("l_arm_ft")
    nominal = build_tree(robot("biped"), "pelvis")
    thought = expected_wrenches(nominal, movement.joints(at), movement.root(at), ["l_arm_ft"])["l_arm_ft"]
    assert 0.1 < np.abs(read - thought)[:, :3].max() < 3.0


def test_no_errors_change_nothing() -> None:
    """Zero is exact to rounding, and no errors at all are the model."""
    model = robot("biped")
    none = RobotErrors.draw(model, mass=0.0, centre_m=0.0, joint_zero_rad=0.0, rng=np.random.default_rng(1))
    names = tuple(none.joint_zero_rad)
    motion = JointMotion.at_rest(names, np.random.default_rng(2).uniform(-0.3, 0.3, (2, len(names))))
    down = RootMotion.fixed([0, 0, -1])
    same, before = (
        expected_wrenches(build_tree(other, "pelvis"), motion, down) for other in (none.applied_to(model), model)
    )
    for name, values in before.items():
        np.testing.assert_allclose(same[name], values, rtol=0, atol=1e-12)


def test_errors_that_no_robot_has_are_refused() -> None:
    """Unknown links and joints, links without mass, and masses that would vanish."""
    model = robot("biped")
    for changes, match in (
        ({"mass": {"foot": 0.1}}, "errors: robot 'biped' has no link 'foot'"),
        ({"mass": {"l_sole": 0.1}}, "errors of link 'l_sole': expected a mass that stays positive, got 0 kg"),
        ({"mass": {"l_foot": -1.0}}, "errors of link 'l_foot': expected a mass that stays positive"),
        ({"joint_zero_rad": {"knee": 0.1}}, "errors: robot 'biped' has no joint 'knee'"),
    ):
        errors = RobotErrors(**{"mass": {}, "centre_m": {}, "joint_zero_rad": {}, **changes})
        with pytest.raises(RobotError, match=match):
            errors.applied_to(model)
