# SPDX-License-Identifier: BSD-3-Clause
"""Expected wrenches against independent libraries, on random states of real robot models."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.base.wrench import MeasureDirection
from forcetorque.robot.dynamics import expected_wrenches
from forcetorque.robot.model import RobotModel, SensorFrame
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from tests.scenes.robots import example_robot, icub, random_motion

AGREEMENT = 1e-10
"""N, N m: rounding of some 40 bodies with wrenches of some 1e3 N at eps = 2e-16, with a margin of 100."""

SAMPLES = 20

ROBOTS = {
    "genova02": (lambda: icub("iCubGenova02"), "l_sole"),
    "gazebo_v2_7": (lambda: icub("iCubGazeboV2_7"), "r_sole"),
    "genova03_massless_links": (lambda: icub("iCubGenova03"), "root_link"),
    "gazebo_v2_5_from_the_head": (lambda: icub("iCubGazeboV2_5"), "head"),
    "reduced": (lambda: example_robot("icub_description/robots/icub_reduced.urdf"), "r_sole"),
}


def _gravity_direction(seed: int) -> np.ndarray:
    direction = np.random.default_rng(seed).normal(size=3)
    return direction / np.linalg.norm(direction)


def _ours(model: RobotModel, support: str, motion: JointMotion, down: np.ndarray) -> dict[str, np.ndarray]:
    return expected_wrenches(build_tree(model, support), motion, RootMotion.fixed(down))


def _from_idyntree(urdf: Path, support: str, motion: JointMotion, down: np.ndarray) -> dict[str, np.ndarray]:
    idyn = pytest.importorskip("idyntree.bindings")
    estimator = idyn.ExtWrenchesAndJointTorquesEstimator()
    names = idyn.StringVector()
    for name in motion.names:
        names.push_back(name)
    assert estimator.loadModelAndSensorsFromFileWithSpecifiedDOFs(str(urdf), names)
    model = estimator.model()
    unknowns = idyn.LinkUnknownWrenchContacts(model)
    unknowns.clear()
    contact = idyn.UnknownWrenchContact(idyn.FULL_WRENCH, idyn.Position.Zero())
    assert unknowns.addNewContactInFrame(model, model.getFrameIndex(support), contact)
    readings = idyn.SensorsMeasurements(estimator.sensors())
    contacts, torques = idyn.LinkContactWrenches(model), idyn.JointDOFsDoubleArray(model)
    count = estimator.sensors().getNrOfSensors(idyn.SIX_AXIS_FORCE_TORQUE)
    sensor_names = [estimator.sensors().getSensor(idyn.SIX_AXIS_FORCE_TORQUE, i).getName() for i in range(count)]
    found = {name: np.empty((len(motion), 6)) for name in sensor_names}
    vector = idyn.JointPosDoubleArray.FromPython
    for k in range(len(motion)):
        state = (vector(a[k]) for a in (motion.position, motion.velocity, motion.acceleration))
        frame = model.getFrameIndex(support)
        gravity = idyn.Vector3.FromPython(STANDARD_GRAVITY * down)
        assert estimator.updateKinematicsFromFixedBase(*state, frame, gravity)
        assert estimator.computeExpectedFTSensorsMeasurements(unknowns, readings, contacts, torques)
        for i, name in enumerate(sensor_names):
            wrench = idyn.Wrench()
            readings.getMeasurement(idyn.SIX_AXIS_FORCE_TORQUE, i, wrench)
            found[name][k] = wrench.asVector().toNumPy()
    return found


@pytest.mark.parametrize("robot", ROBOTS)
def test_equals_idyntree(robot: str) -> None:
    """Every sensor of every robot agrees with iDynTree for a fixed support frame and tilted gravity."""
    find, support = ROBOTS[robot]
    urdf = find()
    model = read_urdf(urdf)
    motion, down = random_motion(model, samples=SAMPLES, seed=1), _gravity_direction(2)
    ours, theirs = _ours(model, support, motion, down), _from_idyntree(urdf, support, motion, down)
    assert set(ours) == set(theirs)
    assert len(ours) >= 4
    for name, expected in theirs.items():
        np.testing.assert_allclose(ours[name], expected, atol=AGREEMENT, rtol=0)


def test_a_flipped_gravity_disagrees_with_idyntree() -> None:
    """Negative control: the oracle notices a sign."""
    urdf = icub("iCubGenova02")
    model = read_urdf(urdf)
    motion, down = random_motion(model, samples=2, seed=1), _gravity_direction(2)
    ours, theirs = _ours(model, "l_sole", motion, -down), _from_idyntree(urdf, "l_sole", motion, down)
    assert np.abs(ours["r_leg_ft"] - theirs["r_leg_ft"]).max() > 1.0


def _movable_sensor_joints(urdf: Path, joints: set[str], folder: Path) -> Path:
    """Copy a URDF with the sensors' fixed joints made movable, so that Pinocchio keeps their wrenches."""
    root = ElementTree.parse(urdf).getroot()  # noqa: S314 - a file of an installed package
    for joint in root.findall("joint"):
        if joint.get("name") in joints:
            joint.set("type", "continuous")
            for axis in joint.findall("axis"):
                joint.remove(axis)
            ElementTree.SubElement(joint, "axis", xyz="0 0 1")
        for mimic in joint.findall("mimic"):
            joint.remove(mimic)  # every coordinate is given by name
    copy = folder / "movable.urdf"
    ElementTree.ElementTree(root).write(copy)
    return copy


def _from_pinocchio(
    urdf: Path, model: RobotModel, support: str, motion: JointMotion, down: np.ndarray, folder: Path
) -> dict[str, np.ndarray]:
    """Wrench of the parent on the child at each sensor; the support is a state of the floating base."""
    pin = pytest.importorskip("pinocchio")
    sensor_joints = {sensor.joint for sensor in model.sensors.values()}
    robot = pin.buildModelFromUrdf(str(_movable_sensor_joints(urdf, sensor_joints, folder)))
    data = robot.createData()
    columns = {name: k for k, name in enumerate(motion.names)}
    found = {name: np.empty((len(motion), 6)) for name in model.sensors}
    for k in range(len(motion)):
        q, dq, ddq = pin.neutral(robot), np.zeros(robot.nv), np.zeros(robot.nv)
        for index in range(1, robot.njoints):
            name, joint = robot.names[index], robot.joints[index]
            if name not in columns:
                continue
            position = motion.position[k, columns[name]]
            q[joint.idx_q : joint.idx_q + joint.nq] = (
                position if joint.nq == 1 else (np.cos(position), np.sin(position))
            )
            dq[joint.idx_v], ddq[joint.idx_v] = motion.velocity[k, columns[name]], motion.acceleration[k, columns[name]]
        robot.gravity = pin.Motion(STANDARD_GRAVITY * down, np.zeros(3))
        pin.rnea(robot, data, q, dq, ddq)
        for name, sensor in model.sensors.items():
            found[name][k] = data.f[robot.getJointId(sensor.joint)].vector
    return found


PINOCCHIO_ROBOTS = {
    "genova02": lambda: icub("iCubGenova02"),
    "genova03_massless_links": lambda: icub("iCubGenova03"),
    "gazebo_v2_7": lambda: icub("iCubGazeboV2_7"),
    "talos_wrists_without_tags": lambda: example_robot("talos_data/robots/talos_full_v2.urdf"),
    "tiago_wrist_with_prismatic_torso": lambda: example_robot("tiago_description/robots/tiago.urdf"),
}


@pytest.mark.parametrize("robot", PINOCCHIO_ROBOTS)
def test_equals_pinocchio(robot: str, tmp_path: Path) -> None:
    """Readings with the root link at rest agree with the joint wrenches of Pinocchio, up to the sign rule."""
    urdf = PINOCCHIO_ROBOTS[robot]()
    model = read_urdf(urdf)
    for joint in model.joints.values():
        if joint.name.startswith("wrist_") and joint.name.endswith("ft_joint"):
            model = model.with_sensor(joint.name, joint=joint.name, direction=MeasureDirection.PARENT_TO_CHILD)
    assert model.sensors
    motion, down = random_motion(model, samples=SAMPLES, seed=3), _gravity_direction(4)
    motion = _without_mimics(model, motion)
    root = model.root_link
    ours = _ours(model, root, motion, down)
    theirs = _from_pinocchio(urdf, model, root, motion, down, tmp_path)
    assert set(ours) == set(theirs)
    for name, on_child in theirs.items():
        sensor = model.sensors[name]
        if sensor.frame is SensorFrame.SENSOR:
            # the origins of these models are identities to 1e-15
            np.testing.assert_allclose(sensor.child_H_sensor, np.eye(4), atol=1e-12)
        sign = 1.0 if sensor.direction is MeasureDirection.PARENT_TO_CHILD else -1.0
        np.testing.assert_allclose(ours[name], sign * on_child, atol=AGREEMENT, rtol=0)


def _without_mimics(model: RobotModel, motion: JointMotion) -> JointMotion:
    """Let joints that mimic move as the model says, since Pinocchio is given every coordinate by name."""
    arrays = {field: np.array(getattr(motion, field)) for field in ("position", "velocity", "acceleration")}
    for k, name in enumerate(motion.names):
        mimic = model.joints[name].mimic
        if mimic is not None and mimic.leader in motion.names:
            leader = motion.names.index(mimic.leader)
            for field, values in arrays.items():
                values[:, k] = mimic.multiplier * values[:, leader] + (mimic.offset if field == "position" else 0.0)
    return JointMotion(names=motion.names, **arrays)
