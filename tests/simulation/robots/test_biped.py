# SPDX-License-Identifier: BSD-3-Clause
"""The humanoid that ships with the library is a plausible one."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.pose import skew
from forcetorque.base.wrench import MeasureDirection
from forcetorque.robot.dynamics import link_pose
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.tree import build_tree
from forcetorque.simulation.robots import BIPED_URDF
from tests.simulation.motions.stands import robot


def test_masses_and_inertias_are_physical() -> None:
    """Every body with mass has principal moments that meet the triangle inequality; all weigh some 30 kg."""
    masses = [link.mass for link in robot("biped").links.values()]
    assert 28.0 < sum(masses) < 33.0
    bodies = 0
    for inertia in robot("biped").links.values():
        if inertia.mass == 0.0:
            assert inertia.is_zero
            continue
        hat = skew(inertia.first_moment / inertia.mass)
        moments = np.linalg.eigvalsh(inertia.second_moment + inertia.mass * hat @ hat)
        assert moments[0] > 0.0
        assert moments[0] + moments[1] > moments[2]
        bodies += 1
    assert bodies > 20


def test_joints_and_sensors() -> None:
    """Some twenty joints, all with limits that hold zero well inside, and six sensors that read the child's push."""
    model = robot("biped")
    moving = [joint for joint in model.joints.values() if joint.type.moves]
    assert 18 <= len(moving) <= 24
    for joint in moving:
        limit = joint.limit
        assert limit is not None
        assert limit.velocity is not None
        assert limit.velocity > 0.0
        margin = 0.05 * (limit.upper - limit.lower)
        assert limit.lower + margin < 0.0 < limit.upper - margin, joint.name
    assert set(model.sensors) == {f"{side}_{limb}_ft" for side in "lr" for limb in ("arm", "leg", "foot")}
    assert {sensor.direction for sensor in model.sensors.values()} == {MeasureDirection.CHILD_TO_PARENT}


def test_it_stands_on_level_soles() -> None:
    """At zero both soles point up, side by side, and the two sides mirror each other."""
    model = robot("biped")
    names = tuple(joint.name for joint in model.joints.values() if joint.type.moves)
    still = JointMotion.at_rest(names, np.zeros((1, len(names))))
    tree = build_tree(model, "pelvis")
    left, right = (link_pose(tree, still, f"{side}_sole")[0] for side in "lr")
    for sole in (left, right):
        np.testing.assert_allclose(sole[:3, :3], np.eye(3), rtol=0, atol=1e-15)
    np.testing.assert_allclose(left[:3, 3] * [1, -1, 1], right[:3, 3], rtol=0, atol=1e-15)
    assert "imu" in model.links


def test_other_libraries_read_it() -> None:
    """Pinocchio finds the same mass and as many joints."""
    pinocchio = pytest.importorskip("pinocchio")
    theirs = pinocchio.buildModelFromUrdf(str(BIPED_URDF))
    masses = sum(link.mass for link in robot("biped").links.values())
    # the root link's inertia is the universe's there
    assert pinocchio.computeTotalMass(theirs) + theirs.inertias[0].mass == pytest.approx(masses)
    assert theirs.nv == sum(joint.type.moves for joint in robot("biped").joints.values())
