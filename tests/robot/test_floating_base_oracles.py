# SPDX-License-Identifier: BSD-3-Clause
"""Expected wrenches from an IMU at any frame, against iDynTree and Pinocchio in floating base."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import RobotError
from forcetorque.robot.dynamics import expected_wrenches, motion_of_link
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree, joints_between
from forcetorque.robot.urdf import read_urdf
from tests.scenes.robots import PENDULUM_URDF, example_robot, icub, random_motion, read_text

AGREEMENT = 1e-9
"""N, N m: rounding of some 40 bodies with wrenches of some 1e4 N at eps = 2e-16, with a margin of 100."""

SAMPLES = 15

ROBOTS: dict[str, tuple[Callable[[], Path], str, str]] = {
    "imu_in_the_head_foot_stands": (lambda: icub("iCubGazeboV2_7"), "head_imu_0", "l_sole"),
    "imu_in_the_head_other_foot": (lambda: icub("iCubGenova02"), "imu_frame", "r_sole"),
    "imu_is_the_root_hangs_from_a_hand": (lambda: icub("iCubGenova03"), "root_link", "l_hand"),
    "reduced": (lambda: example_robot("icub_description/robots/icub_reduced.urdf"), "chest", "l_sole"),
}


def _imu_motion(seed: int) -> RootMotion:
    rng = np.random.default_rng(seed)
    return RootMotion(
        proper_acceleration=rng.normal(size=(SAMPLES, 3)) * 5.0,
        angular_velocity=rng.normal(size=(SAMPLES, 3)),
        angular_acceleration=rng.normal(size=(SAMPLES, 3)) * 4.0,
    )


def _ours(model: RobotModel, imu: str, contact: str, joints: JointMotion, motion: RootMotion) -> dict[str, np.ndarray]:
    """Carry the IMU's motion to the contact, then sum outboard of the sensors as seen from there."""
    at_contact = motion_of_link(build_tree(model, imu), joints, motion, contact)
    return expected_wrenches(build_tree(model, contact), joints, at_contact)


def _from_idyntree(
    urdf: Path, imu: str, contact: str, joints: JointMotion, motion: RootMotion
) -> dict[str, np.ndarray]:
    idyn = pytest.importorskip("idyntree.bindings")
    estimator = idyn.ExtWrenchesAndJointTorquesEstimator()
    names = idyn.StringVector()
    for name in joints.names:
        names.push_back(name)
    assert estimator.loadModelAndSensorsFromFileWithSpecifiedDOFs(str(urdf), names)
    model, sensors = estimator.model(), estimator.sensors()
    unknowns = idyn.LinkUnknownWrenchContacts(model)
    unknowns.clear()
    full = idyn.UnknownWrenchContact(idyn.FULL_WRENCH, idyn.Position.Zero())
    assert unknowns.addNewContactInFrame(model, model.getFrameIndex(contact), full)
    readings = idyn.SensorsMeasurements(sensors)
    contacts, torques = idyn.LinkContactWrenches(model), idyn.JointDOFsDoubleArray(model)
    ids = range(sensors.getNrOfSensors(idyn.SIX_AXIS_FORCE_TORQUE))
    found = {sensors.getSensor(idyn.SIX_AXIS_FORCE_TORQUE, i).getName(): np.empty((SAMPLES, 6)) for i in ids}
    array, vector = idyn.JointPosDoubleArray.FromPython, idyn.Vector3.FromPython
    for k in range(SAMPLES):
        state = (array(a[k]) for a in (joints.position, joints.velocity, joints.acceleration))
        base = (motion.proper_acceleration[k], motion.angular_velocity[k], motion.angular_acceleration[k])
        assert estimator.updateKinematicsFromFloatingBase(*state, model.getFrameIndex(imu), *map(vector, base))
        assert estimator.computeExpectedFTSensorsMeasurements(unknowns, readings, contacts, torques)
        for i, values in zip(ids, found.values(), strict=True):
            wrench = idyn.Wrench()
            readings.getMeasurement(idyn.SIX_AXIS_FORCE_TORQUE, i, wrench)
            values[k] = wrench.asVector().toNumPy()
    return found


@pytest.mark.parametrize("case", ROBOTS)
def test_equals_idyntree_in_floating_base(case: str) -> None:
    """Every sensor agrees with iDynTree for any IMU frame and any single contact, sides swapped or not."""
    find, imu, contact = ROBOTS[case]
    urdf = find()
    model = read_urdf(urdf)
    joints, motion = random_motion(model, samples=SAMPLES, seed=1), _imu_motion(2)
    ours, theirs = _ours(model, imu, contact, joints, motion), _from_idyntree(urdf, imu, contact, joints, motion)
    assert set(ours) == set(theirs)
    for name, expected in theirs.items():
        np.testing.assert_allclose(ours[name], expected, atol=AGREEMENT, rtol=0)


@pytest.mark.parametrize("field", ["proper_acceleration", "angular_velocity", "angular_acceleration"])
def test_every_part_of_the_imus_motion_matters(field: str) -> None:
    """Negative control: leaving out any part of the motion disagrees with iDynTree."""
    find, imu, contact = ROBOTS["imu_in_the_head_other_foot"]
    urdf = find()
    model = read_urdf(urdf)
    joints, motion = random_motion(model, samples=SAMPLES, seed=1), _imu_motion(2)
    parts = {
        name: getattr(motion, name) for name in ("proper_acceleration", "angular_velocity", "angular_acceleration")
    }
    lame = RootMotion(**(parts | {field: np.zeros((SAMPLES, 3))}))
    theirs = _from_idyntree(urdf, imu, contact, joints, motion)
    ours = _ours(model, imu, contact, joints, lame)
    assert max(np.abs(ours[name] - theirs[name]).max() for name in ours) > 1.0


def test_equals_pinocchio_accelerations() -> None:
    """The carried motion of a foot equals Pinocchio's frame velocity and classical acceleration."""
    pin = pytest.importorskip("pinocchio")
    urdf = icub("iCubGenova02")
    model = read_urdf(urdf)
    joints, motion = random_motion(model, samples=SAMPLES, seed=3), _imu_motion(4)
    robot = pin.buildModelFromUrdf(str(urdf), pin.JointModelFreeFlyer())
    data, foot = robot.createData(), robot.getFrameId("l_sole")
    carried = motion_of_link(build_tree(model, "base_link"), joints, motion, "l_sole")
    columns = {name: k for k, name in enumerate(joints.names)}
    compared = 0
    for k in range(SAMPLES):
        q, dq, ddq = pin.neutral(robot), np.zeros(robot.nv), np.zeros(robot.nv)
        dq[3:6] = motion.angular_velocity[k]
        # at the identity pose and zero linear velocity, the spatial acceleration of the base is the classical one
        ddq[:3], ddq[3:6] = motion.proper_acceleration[k], motion.angular_acceleration[k]
        for index in range(2, robot.njoints):
            column, joint = columns[robot.names[index]], robot.joints[index]
            q[joint.idx_q] = joints.position[k, column]
            dq[joint.idx_v], ddq[joint.idx_v] = joints.velocity[k, column], joints.acceleration[k, column]
        pin.forwardKinematics(robot, data, q, dq, ddq)
        pin.updateFramePlacements(robot, data)
        velocity = pin.getFrameVelocity(robot, data, foot, pin.LOCAL)
        acceleration = pin.getFrameClassicalAcceleration(robot, data, foot, pin.LOCAL)
        np.testing.assert_allclose(carried.angular_velocity[k], velocity.angular, atol=AGREEMENT)
        np.testing.assert_allclose(carried.angular_acceleration[k], acceleration.angular, atol=AGREEMENT)
        np.testing.assert_allclose(carried.proper_acceleration[k], acceleration.linear, atol=AGREEMENT)
        compared += 1
    assert compared == SAMPLES


def test_a_link_at_rest_carries_gravity(tmp_path: Path) -> None:
    """By hand: a pendulum's bob at rest feels gravity along its own turned axes."""
    tree = build_tree(read_text(PENDULUM_URDF, tmp_path), "base")
    joints = JointMotion.at_rest(["swing"], [[0.3]])
    carried = motion_of_link(tree, joints, RootMotion.fixed([0, 0, -1], gravity=10.0), "bob")
    by_hand = [-10.0 * np.sin(0.3), 0.0, 10.0 * np.cos(0.3)]  # world z in axes turned by 0.3 rad about y
    np.testing.assert_allclose(carried.proper_acceleration[0], by_hand, atol=1e-14)


def test_centripetal_acceleration_of_a_turning_link(tmp_path: Path) -> None:
    """By hand: 0.2 m below a hinge that turns at 3 rad/s and 2 rad/s2, without gravity."""
    tree = build_tree(read_text(PENDULUM_URDF, tmp_path), "base")
    joints = JointMotion(names=("swing",), position=[[0.3]], velocity=[[3.0]], acceleration=[[2.0]])
    still = RootMotion(proper_acceleration=np.zeros(3), angular_velocity=np.zeros(3), angular_acceleration=np.zeros(3))
    carried = motion_of_link(tree, joints, still, "bob")
    # towards the hinge: 0.2 w^2 along z; tangential: alpha about y at -0.2 z gives -0.4 along x
    np.testing.assert_allclose(carried.proper_acceleration[0], [-0.2 * 2.0, 0.0, 0.2 * 9.0], atol=1e-14)
    np.testing.assert_allclose(carried.angular_velocity[0], [0.0, 3.0, 0.0], atol=1e-14)


def test_a_missing_joint_on_the_way_is_named() -> None:
    """Carrying motion from head to foot needs the joints between, and says which is missing."""
    model = read_urdf(icub("iCubGenova02"))
    tree = build_tree(model, "head")
    needed = joints_between(tree, "l_sole")
    assert {"l_knee", "torso_pitch", "neck_pitch"} <= set(needed)
    assert "r_knee" not in needed
    joints = JointMotion.at_rest(needed[1:], np.zeros((1, len(needed) - 1)))
    with pytest.raises(RobotError, match=needed[0]):
        motion_of_link(tree, joints, RootMotion.fixed([0, 0, -1]), "l_sole")
    with pytest.raises(RobotError, match="did you mean"):
        motion_of_link(tree, joints, RootMotion.fixed([0, 0, -1]), "l_soles")
