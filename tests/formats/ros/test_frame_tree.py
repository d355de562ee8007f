# SPDX-License-Identifier: BSD-3-Clause
"""The tree of frames of a bag: joints place links as the dynamics do, and what is not a tree is refused."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.base.errors import FormatError
from forcetorque.robot.dynamics import link_pose
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf_text

pytest.importorskip("rosbags")
from forcetorque.formats.ros.bag import opened_bag
from forcetorque.formats.ros.frame_tree import FrameTree, read_frame_tree
from tests.formats.ros.bags import PERIOD_NS, START_NS, TF, Types, write_bag

URDF = """<robot name="slider"><link name="base"/><link name="turned"/><link name="slid"/><link name="tool"/>
<joint name="turn" type="revolute"><parent link="base"/><child link="turned"/><origin xyz="0 0 1" rpy="0.2 0 1"/>
  <axis xyz="0 1 0"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
<joint name="slide" type="prismatic"><parent link="turned"/><child link="slid"/><origin xyz="1 0 0" rpy="0 0.4 0"/>
  <axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
<joint name="follow" type="revolute"><parent link="slid"/><child link="tool"/><origin xyz="0 0.3 0" rpy="0 0 0.7"/>
  <axis xyz="1 0 0"/><mimic joint="turn" multiplier="-2" offset="0.5"/>
  <limit lower="-9" upper="9" effort="1" velocity="1"/></joint></robot>"""
NAMES, POSITIONS = ("turn", "slide"), np.column_stack([np.linspace(-1.0, 1.0, 7), np.linspace(0.0, 0.4, 7)])
STAMPS = START_NS + PERIOD_NS * np.arange(7)


def _topics(types: Types) -> dict[str, tuple[str, list[Any]]]:
    empty = np.empty(0)
    states = [types.joints(k, list(NAMES), row, empty, empty) for k, row in enumerate(POSITIONS)]
    return {
        "/joint_states": ("sensor_msgs/msg/JointState", states),
        "/robot_description": ("std_msgs/msg/String", [types.text(URDF)]),
    }


def test_joints_place_links_as_the_dynamics_do(tmp_path: Path) -> None:
    """A revolute, a prismatic and a mimic joint; between samples the pose is interpolated, outside there is none."""
    with opened_bag(write_bag(tmp_path, "mcap", _topics(Types("mcap")))) as bag:
        tree = read_frame_tree(bag, "/ft")
    assert tree.root("tool") == "base"
    np.testing.assert_array_equal(tree.stamps("tool", "base"), STAMPS)
    rotation, position = tree.poses("tool", "base", STAMPS)
    motion = JointMotion.at_rest(NAMES, POSITIONS)
    expected = link_pose(build_tree(read_urdf_text(URDF, where="test"), "base"), motion, "tool")
    np.testing.assert_allclose(rotation, expected[:, :3, :3], atol=1e-14)
    np.testing.assert_allclose(position, expected[:, :3, 3], atol=1e-14)
    assert np.abs(expected[0] - expected[-1]).max() > 0.1
    between, _ = tree.poses("tool", "base", np.append(STAMPS[:-1] + PERIOD_NS // 2, STAMPS[0] - 1))
    np.testing.assert_allclose(between[:-1] @ between[:-1].swapaxes(1, 2), np.tile(np.eye(3), (6, 1, 1)), atol=1e-13)
    assert np.isnan(between[-1]).all()


def test_what_is_no_tree_is_refused(tmp_path: Path) -> None:
    """A frame with two parents, and frames that are above each other."""
    types, turn = Types("mcap"), np.array([0.0, 0.0, 0.0, 1.0])

    def topic(*pairs: tuple[str, str]) -> tuple[str, list[Any]]:
        return TF, [types.transforms(k, dict.fromkeys(pairs, turn)) for k in range(3)]

    two = {"/tf": topic(("base", "tool")), "/tf_static": topic(("flange", "tool"))}
    refused = pytest.raises(FormatError, match="one parent of frame 'tool', got 'base' of /tf and 'flange'")
    with opened_bag(write_bag(tmp_path / "two", "mcap", two)) as bag, refused:
        read_frame_tree(bag, "/ft")
    with opened_bag(write_bag(tmp_path / "loop", "mcap", {"/tf": topic(("a", "b"), ("b", "a"))})) as bag:
        tree = read_frame_tree(bag, "/ft")
        with pytest.raises(FormatError, match="expected a tree of frames, got a loop at"):
            tree.above("a")


def test_frames_of_the_own_robot_are_taken(tmp_path: Path) -> None:
    """Robots with the same names of frames are told apart by namespaces, or refused; equal frames are one."""
    types, turn = Types("mcap"), np.array([0.0, 0.0, 0.0, 1.0])

    def tf(x: float, child: str, *rows: int) -> tuple[str, list[Any]]:
        return TF, [types.make(TF, transforms=[types.transform(k, turn, (x, 0, 0), "base", child)]) for k in rows]

    topics = {
        "/tf": tf(3.0, "tool", 0, 1, 2),
        "/left/tf": tf(1.0, "tool", 0, 1, 2),
        "/left/tf_static": tf(4.0, "camera", 0),
        "/right/tf": tf(2.0, "tool", 0, 1, 2),
        "/right/tf_static": tf(4.0, "camera", 1),
    }
    with opened_bag(write_bag(tmp_path / "all", "mcap", topics)) as bag:
        wanted = {"/left/ft": 1.0, "/right/hand/ft": 2.0, "/righter/ft": 3.0, "/ft": 3.0}
        trees = {topic: read_frame_tree(bag, topic) for topic in wanted}
    for topic, tree in trees.items():
        assert tree.poses("tool", "base", STAMPS[:3])[1][0, 0] == wanted[topic], topic
    del topics["/tf"]
    refused = pytest.raises(FormatError, match="/ft: expected frame 'tool' in one .* in /left/tf and /right/tf; record")
    with opened_bag(write_bag(tmp_path / "two", "mcap", topics)) as bag, refused:
        read_frame_tree(bag, "/ft")


def test_joints_of_the_own_robot_are_taken(tmp_path: Path) -> None:
    """Robots with the same names of joints, and different descriptions, go by namespaces too."""
    types, empty = Types("mcap"), np.empty(0)
    topics: dict[str, tuple[str, list[Any]]] = {}
    for robot, sign, text in (("left", 1.0, URDF), ("right", -1.0, URDF.replace('xyz="0 0 1"', 'xyz="0 0 3"'))):
        states = [types.joints(k, list(NAMES), sign * row, empty, empty) for k, row in enumerate(POSITIONS)]
        topics[f"/{robot}/joint_states"] = ("sensor_msgs/msg/JointState", states)
        topics[f"/{robot}/robot_description"] = ("std_msgs/msg/String", [types.text(text)])
    with opened_bag(write_bag(tmp_path / "two", "mcap", topics)) as bag:
        trees = {robot: read_frame_tree(bag, f"/{robot}/hand/ft") for robot in ("left", "right")}
        neither = read_frame_tree(bag, "/ft")
    for robot, sign, height in (("left", 1.0, 1.0), ("right", -1.0, 3.0)):
        rotation, place = trees[robot].poses("turned", "base", STAMPS)
        np.testing.assert_allclose(place, np.tile([0.0, 0.0, height], (7, 1)), atol=1e-12)
        angle = np.arccos(np.clip((np.trace(rotation[0].T @ rotation[-1]) - 1.0) / 2.0, -1.0, 1.0))
        assert angle == pytest.approx(2.0, abs=1e-6)
        assert trees[robot].transforms["turned"].topic == f"/{robot}/joint_states"
        first = read_urdf_text(URDF, where="URDF").joints["turn"].parent_H_child[:3, :3].T @ rotation[0]
        assert np.sign(first[0, 2]) == -sign
    assert not neither.frames
    one = topics | {"/right/robot_description": topics["/left/robot_description"]}
    refused = pytest.raises(
        FormatError, match="joint 'turn' in one topic, or in one of the namespace of /ft, got it in"
    )
    with opened_bag(write_bag(tmp_path / "one", "mcap", one)) as bag, refused:
        read_frame_tree(bag, "/ft")


@pytest.mark.parametrize("robots", [("/left", "/middle", "/right"), ("/a", "/b", "")])
def test_joints_of_a_third_robot_are_taken(tmp_path: Path, robots: tuple[str, ...]) -> None:
    """Whichever comes first by name: two that are as far from the topic do not matter where a nearer one has it."""
    types = Types("mcap")
    topics = {f"{robot}{name}": messages for robot in robots for name, messages in _topics(types).items()}
    with opened_bag(write_bag(tmp_path / "three", "mcap", topics)) as bag:
        for robot in robots:
            tree = read_frame_tree(bag, f"{robot}/hand/ft")
            assert {pose.topic for pose in tree.transforms.values()} == {f"{robot}/joint_states"}


def test_a_joint_without_positions_is_named(tmp_path: Path) -> None:
    """One that is not a number throughout, by bag, topic and joint; and a moving frame that is sent once."""
    types, empty, turn = Types("mcap"), np.empty(0), np.array([0.0, 0.0, 0.0, 1.0])
    lost = [types.joints(k, list(NAMES), np.array([0.1, np.nan]), empty, empty) for k in range(7)]
    topics = _topics(types) | {"/joint_states": ("sensor_msgs/msg/JointState", lost)}
    with opened_bag(write_bag(tmp_path / "lost", "mcap", topics)) as bag:
        tree = read_frame_tree(bag, "/ft")
    wanted = "lost.*: expected positions of joint 'slide', which moves 'slid', got 0 of 7 that are numbers in /joint_st"
    for ask in (lambda: tree.root("tool"), lambda: tree.poses("tool", "base", STAMPS)):
        with pytest.raises(FormatError, match=wanted):
            ask()
    assert tree.is_below("turned", "base")
    once = {"/tf": (TF, [types.transforms(0, {("base", "tool"): turn})])}
    refused = pytest.raises(FormatError, match="/tf: expected at least 2 poses of 'tool' in 'base', got 1")
    with opened_bag(write_bag(tmp_path / "once", "mcap", once)) as bag, refused:
        read_frame_tree(bag, "/ft").poses("tool", "base", STAMPS)


def test_nothing_is_asked_of_joints_that_tf_makes_needless(tmp_path: Path) -> None:
    """A joint in two topics, and a description that is cut off, matter only where tf lacks a frame."""
    types, turn = Types("mcap"), np.array([0.0, 0.0, 0.0, 1.0])
    complete = {("base", "turned"): turn, ("turned", "slid"): turn, ("slid", "tool"): turn}
    states = _topics(types)["/joint_states"]
    description = {"/robot_description": _topics(types)["/robot_description"]}
    two = description | {f"/{limb}/joint_states": states for limb in ("arm", "leg")}
    cut = {"/robot_description": ("std_msgs/msg/String", [types.text(URDF[:-30])])}

    def tree(name: str, topics: dict[str, tuple[str, list[Any]]], frames: dict[tuple[str, str], Any]) -> FrameTree:
        tf = {"/tf": (TF, [types.transforms(k, frames) for k in range(3)])} if frames else {}
        with opened_bag(write_bag(tmp_path / name, "mcap", topics | tf)) as bag:
            return read_frame_tree(bag, "/ft")

    for name, topics in {"two": two, "cut": cut}.items():
        assert tree(name, topics, complete).root("tool") == "base", name
    del complete["slid", "tool"]
    with pytest.raises(
        FormatError, match="expected joint 'turn' in one .* of /ft, got it in /arm/joint_states and /leg/joint"
    ):
        tree("two_lacking", two, complete)
    lacking = tree("cut_lacking", cut, complete)
    with pytest.raises(FormatError, match="no frame 'tool' .*; robot_description is not read: .*: /robot_description"):
        lacking.root("tool")
    with pytest.raises(FormatError, match="/robot_description"):
        tree("cut_alone", cut, {})
