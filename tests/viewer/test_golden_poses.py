# SPDX-License-Identifier: BSD-3-Clause
"""The scene puts every link where the library and another one put it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import assume, given, settings, strategies as st

from forcetorque.base.pose import invert_pose
from forcetorque.base.wrench import MeasureDirection
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.recording.recording import Interval, Recording, Support, Use
from forcetorque.recording.stream import Signal, Stream
from forcetorque.robot.dynamics import link_pose
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from forcetorque.viewer.posture import upright
from forcetorque.viewer.scene_builder import BuiltScene, build_scene
from tests.cases import some_cases
from tests.fuzzing import examples
from tests.robot.mechanics.random_robots import robots
from tests.scenes.experiments import PARQUET
from tests.scenes.robots import example_robot, icub
from tests.viewer.poses import link_poses

FLOAT32 = 1e-6
"""Rounding of coordinates up to 2 rad and lengths up to 2 m to 24 bits, over some ten joints; m."""
SAMPLES, DOWN = 7, np.array([0.1, -0.7, -0.5])
"""Samples of a motion, and where things fall in the support frame."""


def _experiment(small: Path, model: RobotModel, support: str, motion: JointMotion) -> Experiment:
    """The experiment of the small arm with another robot, whose joints are logged; its sensor is not the robot's."""
    loaded = load_experiment(small)
    source = loaded.recording.stream("arm_ft")
    stamps = source.stamp_ns[:SAMPLES]
    units = tuple(model.joints[name].type.unit for name in motion.names)
    raw = replace(source.signal("raw"), values=source.signal("raw").values[:SAMPLES])
    streams = [Stream(name="arm_ft", clock=source.clock, stamp_ns=stamps, signals={"raw": raw})]
    if motion.names:
        position = Signal(quantity="position", values=motion.position, columns=motion.names, units=units)
        streams += [Stream(name="joints", clock=source.clock, stamp_ns=stamps, signals={"position": position})]
    interval = Interval(
        label="all",
        start_ns=int(stamps[0]),
        end_ns=int(stamps[-1]) + 1,
        use=Use.VALIDATION,
        support=Support(frame=support, gravity_direction=DOWN),
    )
    recording = Recording(streams={stream.name: stream for stream in streams}, intervals=(interval,))
    sensor = replace(loaded.sensors[0], name=next(iter(model.sensors)))
    return replace(loaded, model=model, recording=recording, sensors=(sensor,))


def _scene(small: Path, model: RobotModel, support: str, *, seed: int) -> tuple[BuiltScene, JointMotion]:
    rng = np.random.default_rng(seed)
    # a log holds leaders only; whoever mimics one follows it
    names = tuple(joint.name for joint in model.joints.values() if joint.type.moves and joint.mimic is None)
    motion = JointMotion.at_rest(names, rng.uniform(-1.5, 1.5, (SAMPLES, len(names))))
    return build_scene(_experiment(small, model, support, motion), {}), motion


def _agree(built: BuiltScene, motion: JointMotion, model: RobotModel, support: str) -> None:
    """Every link is where the library puts it, seen from a support that stands still with gravity along -z."""
    tree = build_tree(model, support)
    expected = {link: link_pose(tree, motion, link) for link in model.links}
    standing = link_poses(built, 0)[support]
    np.testing.assert_allclose(standing[:3, :3] @ DOWN / np.linalg.norm(DOWN), [0, 0, -1], rtol=0, atol=FLOAT32)
    np.testing.assert_allclose(standing[:3, 3], 0.0, rtol=0, atol=FLOAT32)
    for sample in range(SAMPLES):
        poses = link_poses(built, sample)
        np.testing.assert_allclose(poses[support], standing, rtol=0, atol=FLOAT32)
        for link, pose in poses.items():
            np.testing.assert_allclose(pose, standing @ expected[link][sample], rtol=0, atol=FLOAT32)


@some_cases("support", ["l_sole", "root_link", "r_hand"])
def test_an_icub_stands_as_in_the_library_and_in_pinocchio(intact: Path, support: str) -> None:
    """Every link of an iCub, on whatever it stands, is where two libraries put it."""
    pinocchio = pytest.importorskip("pinocchio")
    urdf = icub("iCubGenova04")
    model = read_urdf(urdf)
    built, motion = _scene(intact / PARQUET, model, support, seed=1)
    _agree(built, motion, model, support)
    theirs = pinocchio.buildModelFromUrdf(str(urdf))
    data = theirs.createData()
    for sample, position in enumerate(motion.position):
        q = np.zeros(theirs.nq)
        for name, value in zip(motion.names, position, strict=True):
            q[theirs.joints[theirs.getJointId(name)].idx_q] = value
        pinocchio.framesForwardKinematics(theirs, data, q)
        root_H = {link: data.oMf[theirs.getFrameId(link)].homogeneous for link in model.links}
        poses = link_poses(built, sample)
        for link, pose in poses.items():
            wanted = poses[support] @ invert_pose(root_H[support]) @ root_H[link]
            np.testing.assert_allclose(pose, wanted, rtol=0, atol=FLOAT32)


def test_slides_and_followers_move(intact: Path) -> None:
    """Prismatic fingers, one of which mimics the other, are where the library puts them."""
    model = read_urdf(example_robot("panda_description/urdf/panda.urdf"))
    joint = next(joint.name for joint in model.joints.values() if not joint.type.moves)
    model = model.with_sensor("ft", joint=joint, direction=MeasureDirection.CHILD_TO_PARENT)
    built, motion = _scene(intact / PARQUET, model, "panda_link4", seed=2)
    followers = [joint for joint in built.scene.robot.joints if joint.column is not None and joint.multiplier == 1.0]
    assert len(followers) > len(motion.names)
    _agree(built, motion, model, "panda_link4")


@given(st.data())
@settings(max_examples=examples(30))
def test_any_robot_stands_as_in_the_library(intact: Path, data: st.DataObject) -> None:
    """Trees with joints of every kind, some of which mimic others, rooted wherever the support is."""
    model = data.draw(robots())
    assume(model.sensors)
    support = data.draw(st.sampled_from(list(model.links)))
    built, motion = _scene(intact / PARQUET, model, support, seed=data.draw(st.integers(0, 2**31)))
    _agree(built, motion, model, support)


@pytest.mark.long
def test_a_wrong_sign_is_noticed(intact: Path) -> None:
    """Negative control: with one axis turned round the poses differ by far more than the tolerance."""
    model = read_urdf(icub("iCubGenova04"))
    built, motion = _scene(intact / PARQUET, model, "l_sole", seed=1)
    joints = tuple(
        replace(joint, axis=tuple(-value for value in joint.axis)) if joint.name == "r_knee" else joint
        for joint in built.scene.robot.joints
    )
    wrong = replace(built, scene=replace(built.scene, robot=replace(built.scene.robot, joints=joints)))
    _agree(built, motion, model, "l_sole")
    with pytest.raises(AssertionError):
        _agree(wrong, motion, model, "l_sole")


@pytest.mark.parametrize("direction", [[0, 0, -1], [0, 0, 1], [1, 0, 0], [0.3, -0.4, 0.5], [1e-12, 0, 2.0]])
def test_upright_turns_gravity_down(direction: list[float]) -> None:
    """Whatever falls along the direction falls along -z, also upside down; level frames are not turned at all."""
    rotation = upright(np.array(direction, dtype=float))
    down = np.array(direction) / np.linalg.norm(direction)
    np.testing.assert_allclose(rotation @ down, [0, 0, -1], rtol=0, atol=1e-9)
    np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), rtol=0, atol=1e-12)
    if direction == [0, 0, -1]:
        np.testing.assert_array_equal(rotation, np.eye(3))
