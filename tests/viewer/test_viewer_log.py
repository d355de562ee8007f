# SPDX-License-Identifier: BSD-3-Clause
"""A scene as frames, wrenches and events: the poses are those of the robot model, and errors are differences."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from forcetorque.base.arrays import FloatArray
from forcetorque.robot.dynamics import link_pose
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from forcetorque.viewer.scene_arrays import read_array
from forcetorque.viewer.scene_builder import BuiltScene
from forcetorque.viewer.viewer_log import POSES_HZ, ViewerLog, composed, viewer_log

SINGLE = 1e-6
"""Joint coordinates and poses of a scene have 24 bits; some ten of them in a row."""


@pytest.fixture(scope="module")
def log(built: BuiltScene) -> ViewerLog:
    """Log of the intact experiment."""
    return viewer_log(built)


def _matrices(poses: FloatArray) -> FloatArray:
    matrices = np.tile(np.eye(4), (len(poses), 1, 1))
    matrices[:, :3, :3] = Rotation.from_quat(poses[:, [4, 5, 6, 3]]).as_matrix()
    matrices[:, :3, 3] = poses[:, :3]
    return matrices


def _world_poses(log: ViewerLog) -> dict[str, FloatArray]:
    poses: dict[str, FloatArray] = {}
    for frame in log.frames:
        poses[frame.name] = composed(poses[frame.parent], frame.poses) if frame.parent in poses else frame.poses
    return poses


def test_frames_have_the_poses_of_the_robot_model(log: ViewerLog, intact: Path) -> None:
    """Of all links seen from the root, against the dynamics of the library; a joint that is read wrongly is noticed."""
    tree = build_tree(read_urdf(intact / "arm.urdf"), "base")
    motion = JointMotion.at_rest(log.joints, log.positions[log.pose_samples])
    poses = {name: _matrices(pose) for name, pose in _world_poses(log).items()}
    root = np.linalg.inv(poses["base"])
    links = [link for link in log.robot.links if link != "base"]
    assert links
    for link in links:
        np.testing.assert_allclose(root @ poses[link], link_pose(tree, motion, link), atol=SINGLE)
    turned = replace(log, frames=tuple(replace(f, poses=f.poses * [1, 1, 1, 1, -1, 1, 1]) for f in log.frames))
    assert np.abs(_matrices(_world_poses(turned)["hand"]) - poses["hand"]).max() > 0.1


def test_composed_poses_are_products_of_matrices() -> None:
    """For random ones, and one that stays."""
    rng = np.random.default_rng(2)
    a, b = (np.hstack([rng.normal(size=(9, 3)), Rotation.random(9, rng=rng).as_quat()]) for _ in range(2))
    np.testing.assert_allclose(_matrices(composed(a, b)), _matrices(a) @ _matrices(b), atol=1e-12)
    np.testing.assert_allclose(_matrices(composed(a[:1], b)), _matrices(a[:1]) @ _matrices(b), atol=1e-12)


def test_wrenches_are_those_of_the_scene(built: BuiltScene, log: ViewerLog) -> None:
    """Expected and measured with all instants, and the error between them; nothing is expected outside intervals."""
    (sensor,) = built.scene.sensors
    by_name = {wrench.name: wrench for wrench in log.wrenches}
    for series in sensor.wrenches:
        values = by_name[f"arm_ft/{series.name}"].values
        assert values.astype("<f4").tobytes() == read_array(built.block, series.values).tobytes()
    expected, prior, error = (by_name[f"arm_ft/{name}"] for name in ("expected", "prior", "prior/error"))
    assert (expected.kind, prior.kind, error.kind) == ("expected", "measured", "error")
    np.testing.assert_array_equal(error.values, prior.values - expected.values)
    assert 0 < len(expected.known) < len(prior.known) == len(log.stamp_ns)
    assert {"arm_ft", "world"} <= {expected.frame, log.world}


def test_ignored_intervals_have_no_error(built: BuiltScene) -> None:
    """The end of an interval is not in it; wrenches stay, and so do errors elsewhere."""
    held, seconds = built.scene.intervals[0], read_array(built.block, built.scene.time_s)
    before = {wrench.name: wrench.values for wrench in viewer_log(built).wrenches}
    first = int(np.flatnonzero(np.isfinite(before["arm_ft/prior/error"]).all(axis=1))[0]) + 5
    assert np.isfinite(before["arm_ft/prior/error"][first : first + 10]).any()
    span = replace(held, use="ignore", start_s=float(seconds[first]), end_s=float(seconds[first + 10]))
    ignoring = replace(built, scene=replace(built.scene, intervals=(held, span)))
    values = {wrench.name: wrench.values for wrench in viewer_log(ignoring).wrenches}
    for name, then in values.items():
        expected = before[name].copy()
        if name.endswith("/error"):
            expected[first : first + 10] = np.nan
        np.testing.assert_array_equal(then, expected)


def test_stamps_come_back_to_the_nanosecond(built: BuiltScene, log: ViewerLog) -> None:
    """Seconds of the scene are differences of stamps."""
    seconds = read_array(built.block, built.scene.time_s)
    np.testing.assert_array_equal((log.stamp_ns - int(built.scene.start_ns)) * 1e-9, seconds)
    assert (np.diff(log.stamp_ns) > 0).all()


def test_poses_are_given_at_most_at_a_rate(built: BuiltScene) -> None:
    """Of a log ten times as fast one instant in ten is taken; wrenches keep theirs."""
    seconds = read_array(built.block, built.scene.time_s)
    fast = (0.1 * seconds).astype("<f8").tobytes()
    at = built.scene.time_s.offset
    log = viewer_log(replace(built, block=built.block[:at] + fast + built.block[at + len(fast) :]))
    assert len(log.pose_samples) == pytest.approx(len(seconds) / 10.0, abs=1)
    assert len(log.pose_ns) / (1e-9 * np.ptp(log.stamp_ns)) == pytest.approx(POSES_HZ, rel=0.02)
    assert all(len(frame.poses) in (1, len(log.pose_ns)) for frame in log.frames)


def test_intervals_and_findings_are_events(built: BuiltScene, log: ViewerLog) -> None:
    """Each interval begins and ends; events are in the order of time."""
    texts = [event.text for event in log.events]
    assert built.scene.intervals
    for interval in built.scene.intervals:
        begins = [text for text in texts if text.startswith(f"interval {interval.label!r}")]
        assert [text.rsplit(" ", 1)[1] for text in begins] == ["begins", "ends"]
    stamps = [event.stamp_ns for event in log.events]
    assert stamps == sorted(stamps)
    assert sum(event.is_warning for event in log.events) == len(built.scene.findings)
    assert any("the offset over the calibration intervals is added" in text for text in texts)


def test_names_never_meet(built: BuiltScene) -> None:
    """A link with the name of the world or of the sensor keeps it, and frames are a tree."""
    robot = built.scene.robot
    renamed = {"hand": "arm_ft", robot.root_link: "world"}
    joints = tuple(
        replace(one, parent=renamed.get(one.parent, one.parent), child=renamed.get(one.child, one.child))
        for one in robot.joints
    )
    links = tuple(renamed.get(link, link) for link in robot.links)
    robot = replace(robot, root_link="world", links=links, joints=joints)
    sensors = tuple(replace(one, name="arm_ft", link=renamed.get(one.link, one.link)) for one in built.scene.sensors)
    contacts = tuple(replace(one, link=renamed.get(one.link, one.link)) for one in built.scene.contacts)
    scene = replace(built.scene, robot=robot, sensors=sensors, contacts=contacts)
    log = viewer_log(replace(built, scene=scene))
    names = [frame.name for frame in log.frames]
    assert len(set(names)) == len(names)
    assert log.world == "world_frame"
    assert log.wrenches[0].frame == "arm_ft_frame"
    assert {frame.parent for frame in log.frames} <= {*names, log.world}


def test_errors_have_plots_of_their_own_in_rerun(log: ViewerLog) -> None:
    """Every wrench is in one plot, and none with errors has another wrench."""
    plots = dict(log.plots())
    shown = [wrench.name for wrenches in plots.values() for wrench in wrenches]
    assert sorted(shown) == sorted(wrench.name for wrench in log.wrenches)
    errors = {title for title, wrenches in plots.items() if any(wrench.kind == "error" for wrench in wrenches)}
    assert errors == {title for title in plots if title.endswith(": error")} != set()
    assert all(wrench.kind == "error" for title in errors for wrench in plots[title])
