# SPDX-License-Identifier: BSD-3-Clause
"""Joints that a sensor's expected wrench needs: exactly those, by hand and by disturbing each one."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import RobotError
from forcetorque.robot.dynamics import expected_wrenches
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree, required_joints
from forcetorque.robot.urdf import read_urdf
from tests.scenes.robots import icub, joint_xml, link_xml, random_motion, read_text, robot_xml, sensor_xml

UPRIGHT = RootMotion.fixed([0.0, 0.0, -1.0])


def _tree_by_hand(folder: Path) -> RobotModel:
    """Build torso -shoulder- upper -[ft]- fore -wrist- hand -tip- finger, torso -neck- head, torso -waist- pelvis.

    The finger and the pelvis are massless; the wrist follows the thumb, which hangs massless on the hand.
    """
    return read_text(
        robot_xml(
            link_xml("torso", mass=5.0),
            link_xml("upper", mass=1.0),
            link_xml("fore", mass=0.5, xyz="0.1 0 0"),
            link_xml("hand", mass=0.3, xyz="0.1 0 0"),
            link_xml("finger"),
            link_xml("nail"),
            link_xml("head", mass=2.0, xyz="0 0.1 0"),
            link_xml("pelvis"),
            joint_xml("shoulder", "torso", "upper", type="revolute", xyz="0.1 0 0", axis="0 1 0"),
            joint_xml("mount", "upper", "fore", xyz="0.2 0 0"),
            joint_xml(
                "wrist", "fore", "hand", type="revolute", xyz="0.2 0 0", inside="<mimic joint='thumb' multiplier='2'/>"
            ),
            joint_xml("thumb", "hand", "finger", type="revolute"),
            joint_xml("tip", "finger", "nail", type="revolute"),
            joint_xml("neck", "torso", "head", type="revolute", axis="1 0 0"),
            joint_xml("waist", "torso", "pelvis", type="prismatic"),
            sensor_xml("ft", "mount"),
        ),
        folder,
    )


@pytest.mark.parametrize(
    ("root", "joints"),
    [
        ("torso", ("shoulder", "thumb")),  # not tip, neck or waist; the wrist's leader in the wrist's place
        ("upper", ("thumb",)),
        ("head", ("neck", "shoulder", "thumb")),
        ("pelvis", ("waist", "shoulder", "thumb")),
        ("fore", ("shoulder", "neck")),  # the torso's side is outboard now; the pelvis weighs nothing
        ("nail", ("tip", "thumb", "shoulder", "neck")),
    ],
)
def test_exact_joints_of_a_tree_by_hand(root: str, joints: tuple[str, ...], tmp_path: Path) -> None:
    """Joints between root and sensor, and those beyond it that carry weight; nothing else, each once."""
    found = required_joints(build_tree(_tree_by_hand(tmp_path), root), "ft")
    assert set(found) == set(joints)
    assert len(found) == len(joints)


def test_joints_come_from_the_root_outwards(tmp_path: Path) -> None:
    """The order is that of the way from the root."""
    model = _tree_by_hand(tmp_path)
    assert required_joints(build_tree(model, "head"), "ft") == ("neck", "shoulder", "thumb")


def test_nothing_outboard_needs_nothing(tmp_path: Path) -> None:
    """A sensor that carries no weight reads zero and needs no joint."""
    urdf = robot_xml(
        link_xml("a", mass=1.0),
        link_xml("b"),
        link_xml("c"),
        joint_xml("j", "a", "b", type="revolute"),
        joint_xml("mount", "b", "c"),
        sensor_xml("ft", "mount"),
    )
    tree = build_tree(read_text(urdf, tmp_path), "a")
    assert required_joints(tree, "ft") == ()
    nothing = JointMotion.at_rest([], np.zeros((2, 0)))
    np.testing.assert_array_equal(expected_wrenches(tree, nothing, UPRIGHT)["ft"], np.zeros((2, 6)))


def test_a_massless_link_with_inertia_needs_its_joint(tmp_path: Path) -> None:
    """Inertia without mass still takes a moment to turn, so its joint counts."""
    needed = {}
    for moments in ("0 0 0 0 0 0", "0.1 0 0 0.1 0 0.1"):
        urdf = robot_xml(
            link_xml("a"),
            link_xml("b", mass=1.0),
            link_xml("c", moments=moments),
            joint_xml("mount", "a", "b"),
            joint_xml("spin", "b", "c", type="continuous"),
            sensor_xml("ft", "mount"),
        )
        needed[moments] = required_joints(build_tree(read_text(urdf, tmp_path), "a"), "ft")
    assert list(needed.values()) == [(), ("spin",)]


LEG = ("hip_pitch", "hip_roll", "hip_yaw", "knee", "ankle_pitch", "ankle_roll")


def test_the_far_leg_of_a_standing_icub_needs_both_legs() -> None:
    """From the left sole, the right leg's sensor needs the twelve joints of the legs and no other."""
    tree = build_tree(read_urdf(icub("iCubGenova02")), "l_sole")
    found = required_joints(tree, "r_leg_ft")
    assert set(found) == {f"{side}_{joint}" for side in "lr" for joint in LEG}
    assert len(found) == 12
    assert set(required_joints(tree, "l_foot_ft")) > set(found)  # all of the robot but the foot hangs on it


def test_only_the_required_joints_move_a_reading() -> None:
    """Disturbing a required joint changes the reading; disturbing all others changes no bit of it."""
    model = read_urdf(icub("iCubGenova02"))
    tree = build_tree(model, "l_sole")
    motion = random_motion(model, samples=2, seed=1)
    needed = required_joints(tree, "r_leg_ft")

    def reading(disturbed: set[str]) -> np.ndarray:
        step = np.array([0.1 if name in disturbed else 0.0 for name in motion.names])
        joints = JointMotion(
            names=motion.names,
            position=motion.position + step,
            velocity=motion.velocity + step,
            acceleration=motion.acceleration + step,
        )
        return expected_wrenches(tree, joints, UPRIGHT, ["r_leg_ft"])["r_leg_ft"]

    undisturbed = reading(set())
    np.testing.assert_array_equal(reading(set(motion.names) - set(needed)), undisturbed)
    changes = [np.abs(reading({name}) - undisturbed).max() for name in needed]
    assert len(changes) == 12
    assert min(changes) > 1e-6


def test_a_missing_required_joint_is_named_and_others_may_be_absent() -> None:
    """The twelve joints of the legs suffice; without one of them the message names sensor, joint and root."""
    model = read_urdf(icub("iCubGenova02"))
    tree = build_tree(model, "l_sole")
    motion = random_motion(model, samples=2, seed=2)
    needed = required_joints(tree, "r_leg_ft")

    def keep(names: tuple[str, ...]) -> JointMotion:
        columns = [motion.names.index(name) for name in names]
        return JointMotion(
            names=names,
            position=motion.position[:, columns],
            velocity=motion.velocity[:, columns],
            acceleration=motion.acceleration[:, columns],
        )

    np.testing.assert_array_equal(
        expected_wrenches(tree, keep(needed), UPRIGHT, ["r_leg_ft"])["r_leg_ft"],
        expected_wrenches(tree, motion, UPRIGHT, ["r_leg_ft"])["r_leg_ft"],
    )
    refused = 0
    for name in needed:
        others = tuple(other for other in needed if other != name)
        with pytest.raises(
            RobotError,
            match=rf"sensor 'r_leg_ft' seen from 'l_sole' needs the joint\(s\) {name}, which the motion lacks",
        ):
            expected_wrenches(tree, keep(others), UPRIGHT, ["r_leg_ft"])
        refused += 1
    assert refused == 12


def test_a_missing_leader_is_named(tmp_path: Path) -> None:
    """A joint that mimics one that does not exist is refused where its coordinate is needed, by the leader's name."""
    urdf = robot_xml(
        link_xml("a"),
        link_xml("b"),
        link_xml("c", mass=1.0),
        joint_xml("j", "a", "b", type="revolute", inside="<mimic joint='gone'/>"),
        joint_xml("mount", "b", "c"),
        sensor_xml("ft", "mount"),
    )
    tree = build_tree(read_text(urdf, tmp_path), "a")
    assert required_joints(tree, "ft") == ("gone",)
    with pytest.raises(RobotError, match=r"sensor 'ft' seen from 'a' needs the joint\(s\) gone, .* known: j"):
        expected_wrenches(tree, JointMotion.at_rest(["j"], [[0.0]]), UPRIGHT)


def test_an_unknown_sensor_is_refused(tmp_path: Path) -> None:
    """The message lists the sensors of the tree."""
    with pytest.raises(RobotError, match="no force-torque sensor 'tf' at a fixed joint; .*known: ft"):
        required_joints(build_tree(_tree_by_hand(tmp_path), "torso"), "tf")
