# SPDX-License-Identifier: BSD-3-Clause
"""Expected wrenches by hand: pendulum, slider, mimic, massless links, and a limb that hangs."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import RobotError
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.robot.dynamics import expected_wrenches
from forcetorque.robot.model import RobotModel, SensorFrame
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from tests.robot.kinematics import link_poses, links_below
from tests.scenes.robots import (
    PENDULUM_URDF,
    icub,
    joint_xml,
    link_xml,
    random_motion,
    read_text,
    robot_xml,
    sensor_xml,
)

ROUNDING = 1e-12
"""N, N m: a few dozen roundings of terms up to 100."""

LIMB_ROUNDING = 1e-11
"""N, N m: some 20 links of wrenches up to 100, turned through a dozen joints each way."""

VISIBLE = 0.1
"""N, N m: what a negative control must exceed."""

G = STANDARD_GRAVITY
Z = np.array([0.0, 0.0, 1.0])
UPRIGHT = RootMotion.fixed([0.0, 0.0, -1.0])
Q, DQ, DDQ = np.array([0.0, 0.3, -1.2, np.pi / 2]), np.array([0.0, 2.0, -3.0, 1.0]), np.array([0.0, 5.0, 7.0, -4.0])
"""Angle, rate and acceleration of a hinge or slide in four samples."""


def _motion(name: str, *, dq: FloatArray = DQ, ddq: FloatArray = DDQ) -> JointMotion:
    return JointMotion(names=(name,), position=Q[:, None], velocity=dq[:, None], acceleration=ddq[:, None])


def _bob(dq: FloatArray, ddq: FloatArray, about: float) -> FloatArray:
    """Wrench of the arm on the bob, in the arm's axes, about a point `about` metres below the hinge.

    A point mass m at r = (0, 0, -l) needs f = m (alpha x r + omega x (omega x r) - g) with
    alpha = (0, ddq, 0) and omega = (0, dq, 0); upwards is (-sin q, 0, cos q) in the arm.
    """
    mass, length = 2.0, 0.5
    fx = mass * (-ddq * length - G * np.sin(Q))
    fz = mass * (dq**2 * length + G * np.cos(Q))
    zero = np.zeros_like(Q)
    return np.stack([fx, zero, fz, zero, -(length - about) * fx, zero], axis=1)


@pytest.mark.parametrize("direction", ["child_to_parent", "parent_to_child"])
@pytest.mark.parametrize(("frame", "about"), [("child", 0.2), ("parent", 0.0)])
def test_pendulum_by_hand(frame: str, about: float, direction: str, tmp_path: Path) -> None:
    """At rest and swinging, the sensor reads the hand formula in its frame and direction."""
    urdf = PENDULUM_URDF.replace(">child<", f">{frame}<").replace(">child_to_parent<", f">{direction}<")
    tree = build_tree(read_text(urdf, tmp_path), "base")
    sign = -1.0 if direction == "child_to_parent" else 1.0
    for dq, ddq in ((0 * DQ, 0 * DDQ), (DQ, DDQ)):
        found = expected_wrenches(tree, _motion("swing", dq=dq, ddq=ddq), UPRIGHT)["ft"]
        np.testing.assert_allclose(found, sign * _bob(dq, ddq, about), rtol=0, atol=ROUNDING)


def test_pendulum_without_its_motion_disagrees(tmp_path: Path) -> None:
    """Negative control: rate, acceleration, sign and frame each show in the reading."""
    found = expected_wrenches(build_tree(read_text(PENDULUM_URDF, tmp_path), "base"), _motion("swing"), UPRIGHT)["ft"]
    wrong = {
        "no rate": -_bob(0 * DQ, DDQ, 0.2),
        "no acceleration": -_bob(DQ, 0 * DDQ, 0.2),
        "sign": _bob(DQ, DDQ, 0.2),
        "frame": -_bob(DQ, DDQ, 0.0),
    }
    for name, values in wrong.items():
        assert np.abs(found - values).max() > VISIBLE, name


@pytest.mark.parametrize(("direction", "sign"), [("child_to_parent", 1.0), ("parent_to_child", -1.0)])
def test_pendulum_held_at_the_bob(direction: str, sign: float, tmp_path: Path) -> None:
    """Rooted at the bob, the sensor carries the arm of 0.5 kg 0.1 m above it, not the bob.

    The bob must push the arm with -0.5 g down, and it is the child: child_to_parent reads that push.
    """
    urdf = PENDULUM_URDF.replace(">child_to_parent<", f">{direction}<")
    down = np.array([0.6, 0.0, -0.8])
    tree = build_tree(read_text(urdf, tmp_path), "bob")
    found = expected_wrenches(tree, _motion("swing"), RootMotion.fixed(down))["ft"]
    push = -0.5 * G * down
    by_hand = sign * np.concatenate([push, np.cross([0.0, 0.0, 0.1], push)])
    np.testing.assert_allclose(found, np.tile(by_hand, (4, 1)), rtol=0, atol=ROUNDING)


def test_slider_on_a_turning_root_by_hand(tmp_path: Path) -> None:
    """A point mass that slides along x of a root spinning about z feels Coriolis, Euler and centrifugal force."""
    urdf = robot_xml(
        link_xml("hub"),
        link_xml("slide"),
        link_xml("load", mass=2.0),
        joint_xml("rail", "hub", "slide", type="prismatic", axis="1 0 0"),
        joint_xml("grip", "slide", "load"),
        sensor_xml("ft", "grip", direction="parent_to_child"),
    )
    omega, alpha = 3.0, -2.0
    root = RootMotion(proper_acceleration=G * Z, angular_velocity=omega * Z, angular_acceleration=alpha * Z)
    found = expected_wrenches(build_tree(read_text(urdf, tmp_path), "hub"), _motion("rail"), root)["ft"]
    coriolis = 2 * omega * DQ
    force = 2.0 * np.stack([DDQ - omega**2 * Q, coriolis + alpha * Q, np.full_like(Q, G)], axis=1)
    np.testing.assert_allclose(found[:, :3], force, rtol=0, atol=ROUNDING)
    np.testing.assert_allclose(found[:, 3:], 0.0, rtol=0, atol=ROUNDING)
    assert np.abs(coriolis).max() > VISIBLE


def test_a_massless_link_resists_angular_acceleration(tmp_path: Path) -> None:
    """Mass 0 with inertia I: no force, but the moment I alpha + omega x (I omega)."""
    urdf = robot_xml(
        link_xml("hub"), link_xml("wheel", moments="1 0 0 2 0 4"), joint_xml("grip", "hub", "wheel", xyz="0.3 0 0"),
        sensor_xml("ft", "grip", direction="parent_to_child"),
    )  # fmt: skip
    omega, alpha = np.array([1.0, 2.0, 3.0]), np.array([0.5, -1.0, 0.25])
    root = RootMotion(proper_acceleration=G * Z, angular_velocity=omega, angular_acceleration=alpha)
    nothing = JointMotion.at_rest([], np.zeros((1, 0)))
    found = expected_wrenches(build_tree(read_text(urdf, tmp_path), "hub"), nothing, root)["ft"]
    # omega x I omega = (1, 2, 3) x (1, 4, 12) = (12, -9, 2)
    np.testing.assert_allclose(found, [[0, 0, 0, 0.5 + 12, -2.0 - 9, 1.0 + 2]], rtol=0, atol=ROUNDING)


def _two_hinges(folder: Path, mimic: str) -> RobotModel:
    return read_text(
        robot_xml(
            link_xml("base"),
            link_xml("upper", mass=1.0, xyz="0.1 0 0"),
            link_xml("wrist"),
            link_xml("lower", mass=0.5, xyz="0.2 0 0", moments="0.01 0 0 0.02 0 0.03"),
            joint_xml("lead", "base", "upper", type="revolute", axis="0 1 0"),
            joint_xml("follow", "upper", "wrist", type="revolute", xyz="0.3 0 0", axis="0 0 1", inside=mimic),
            joint_xml("grip", "wrist", "lower"),
            sensor_xml("ft", "grip"),
        ),
        folder,
    )


@pytest.mark.parametrize("root", ["base", "lower"])
def test_a_mimic_moves_as_if_its_coordinate_were_given(root: str, tmp_path: Path) -> None:
    """A joint that follows -0.5 q + 0.3 reads as a free one with that motion, from either end of the arm."""
    followed = _two_hinges(tmp_path, "<mimic joint='lead' multiplier='-0.5' offset='0.3'/>")
    free = _two_hinges(tmp_path, "")
    lead = _motion("lead")
    both = JointMotion(
        names=("lead", "follow"),
        position=np.stack([Q, -0.5 * Q + 0.3], axis=1),
        velocity=np.stack([DQ, -0.5 * DQ], axis=1),
        acceleration=np.stack([DDQ, -0.5 * DDQ], axis=1),
    )
    found, expected = (
        expected_wrenches(build_tree(model, root), motion, UPRIGHT)["ft"]
        for model, motion in ((followed, lead), (free, both))
    )
    np.testing.assert_allclose(found, expected, rtol=0, atol=ROUNDING)
    unfollowed = expected_wrenches(build_tree(free, root), JointMotion.at_rest(both.names, both.position), UPRIGHT)
    assert np.abs(found - unfollowed["ft"]).max() > VISIBLE


def test_a_chain_of_mimics(tmp_path: Path) -> None:
    """What follows a follower follows the leader: -2 (0.5 q + 0.1) + 0.3 = -q + 0.1."""
    urdf = robot_xml(
        *(link_xml(name) for name in "xyzw"),
        joint_xml("a", "x", "y", type="revolute"),
        joint_xml("b", "y", "z", type="revolute", inside="<mimic joint='a' multiplier='0.5' offset='0.1'/>"),
        joint_xml("c", "z", "w", type="revolute", inside="<mimic joint='b' multiplier='-2' offset='0.3'/>"),
    )
    coordinate = build_tree(read_text(urdf, tmp_path), "x").bodies[-1].coordinate
    assert coordinate is not None
    assert (coordinate.joint, coordinate.multiplier) == ("a", -1.0)
    assert coordinate.offset == pytest.approx(0.1, rel=0, abs=ROUNDING)


@pytest.mark.parametrize("robot", ["iCubGenova02", "iCubGenova03"])
def test_a_hanging_limb_pulls_with_its_weight_at_its_centre_of_mass(robot: str) -> None:
    """With the root upright and at rest, every reading in world axes is (0, 0, -m g) at the centre of mass below."""
    model = read_urdf(icub(robot))
    motion = random_motion(model, samples=3, seed=5)
    still = JointMotion.at_rest(motion.names, motion.position)
    found = expected_wrenches(build_tree(model, "root_link"), still, UPRIGHT)
    assert {"l_leg_ft", "r_leg_ft", "l_arm_ft", "r_arm_ft"} <= set(found)
    for k in range(3):
        poses = link_poses(model, dict(zip(still.names, still.position[k], strict=True)))
        for name, values in found.items():
            sensor = model.sensors[name]
            below = {link: model.links[link] for link in links_below(model, sensor.joint)}
            mass = sum(inertia.mass for inertia in below.values())
            moment = sum(
                poses[link][:3, :3] @ inertia.first_moment + inertia.mass * poses[link][:3, 3]
                for link, inertia in below.items()
            )
            pose = poses[model.joints[sensor.joint].child]
            if sensor.frame is SensorFrame.SENSOR:
                pose = pose @ sensor.child_H_sensor
            rotation, weight = pose[:3, :3], np.array([0.0, 0.0, -mass * G])
            about_sensor = np.cross(moment / mass - pose[:3, 3], weight)
            assert mass > 0.1
            np.testing.assert_allclose(rotation @ values[k, :3], weight, rtol=0, atol=LIMB_ROUNDING)
            np.testing.assert_allclose(rotation @ values[k, 3:], about_sensor, rtol=0, atol=LIMB_ROUNDING)


def test_unknown_links_and_sensors_are_refused(tmp_path: Path) -> None:
    """A root link or a sensor that is not there suggests those that are."""
    model = read_text(PENDULUM_URDF, tmp_path)
    with pytest.raises(RobotError, match=r"robot 'pendulum' has no link 'bop'; did you mean \"bob\"\?"):
        build_tree(model, "bop")
    with pytest.raises(RobotError, match=r"no force-torque sensor 'gt' at a fixed joint; .*known: ft"):
        expected_wrenches(build_tree(model, "base"), _motion("swing"), UPRIGHT, ["gt"])
