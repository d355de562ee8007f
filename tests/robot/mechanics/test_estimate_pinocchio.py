# SPDX-License-Identifier: BSD-3-Clause
"""Expected readings, torques and the one contact against Pinocchio, for every kind of sensor tag."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import MeasureDirection
from forcetorque.robot.contacts import Contact
from forcetorque.robot.mechanics.estimate import Evaluator, estimate
from forcetorque.robot.mechanics.estimate_arrays import Estimates
from forcetorque.robot.mechanics.estimated_quantities import Question, moving_joints
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree
from tests.cases import some_cases
from tests.robot.mechanics.pinocchio_oracle import Pinocchio
from tests.robot.mechanics.simulated import random_pose, random_root
from tests.scenes.robots import example_robot, icub, random_motion, read_text

ROUNDING = 1e-12
"""Of the largest wrench: some 40 bodies of some 50 roundings each at eps = 2e-16 are 4e-13, added up on both sides.
The largest wrench is some 1000 N, so that this is 1e-9 N."""

VISIBLE = 0.1
"""N, N m: what a negative control must exceed."""

SAMPLES = 6

KINDS = tuple(product(("child", "parent", "sensor"), MeasureDirection))

TAGGED: dict[str, tuple[Callable[[], Path], tuple[str, ...]]] = {
    "genova02": (lambda: icub("iCubGenova02"), ("base_link", "l_sole", "head")),
    "genova03_with_massless_links": (lambda: icub("iCubGenova03"), ("root_link", "r_hand")),
    "gazebo_v2_7": (lambda: icub("iCubGazeboV2_7"), ("l_foot", "r_upper_arm")),
}

UNTAGGED: dict[str, tuple[Callable[[], Path], tuple[str, ...]]] = {
    "talos": (lambda: example_robot("talos_data/robots/talos_full_v2.urdf"), ("base_link", "left_sole_link")),
    "tiago_on_a_slide": (
        lambda: example_robot("tiago_description/robots/tiago.urdf"),
        ("base_footprint", "arm_7_link"),
    ),
}

Kind = tuple[str, MeasureDirection, FloatArray]
"""Frame, direction and pose of the frame in the child link."""


def _vary(urdf: str, shift: int) -> tuple[str, dict[str, Kind]]:
    """Give the sensors of a robot all kinds of frames and directions in turn, and general origins."""
    rng, robot, kinds = np.random.default_rng(shift), ElementTree.fromstring(urdf), {}  # noqa: S314
    joints = {joint.get("name", ""): joint for joint in robot.findall("joint")}
    for gazebo in robot.findall("gazebo"):
        for tag in gazebo.findall("sensor"):
            gazebo.remove(tag)
    for k, tag in enumerate(robot.findall("sensor[@type='force_torque']")):
        frame, direction = KINDS[(k + shift) % len(KINDS)]
        inside, (mount, beside) = tag.find("force_torque"), (random_pose(rng), random_pose(rng))
        assert inside is not None
        for name, text in (("frame", frame), ("measure_direction", direction)):
            for old in inside.findall(name):
                inside.remove(old)
            ElementTree.SubElement(inside, name).text = text
        _set_origin(joints[tag.find("parent").get("joint", "")], mount)  # type: ignore[union-attr]
        _set_origin(tag, beside)
        pose = {"child": np.eye(4), "parent": np.linalg.inv(mount), "sensor": beside}[frame]
        kinds[tag.get("name", "")] = (frame, direction, pose)
    assert len(kinds) == 6
    return ElementTree.tostring(robot, encoding="unicode"), kinds


def _set_origin(tag: ElementTree.Element, pose: FloatArray) -> None:
    for old in tag.findall("origin"):
        tag.remove(old)
    rpy = Rotation.from_matrix(pose[:3, :3]).as_euler("xyz")
    texts = {"xyz": pose[:3, 3], "rpy": rpy}
    ElementTree.SubElement(tag, "origin", {k: " ".join(repr(float(x)) for x in v) for k, v in texts.items()})


def _in_frame(kind: Kind, parent_on_child: FloatArray) -> FloatArray:
    """Reading of a sensor from the wrench of its parent on its child, in the child's frame."""
    _, direction, pose = kind
    sign = 1.0 if direction is MeasureDirection.PARENT_TO_CHILD else -1.0
    moment = parent_on_child[3:] - np.cross(pose[:3, 3], parent_on_child[:3])
    return sign * np.concatenate([parent_on_child[:3] @ pose[:3, :3], moment @ pose[:3, :3]])


def _following(model: RobotModel, motion: JointMotion) -> JointMotion:
    """Let joints that mimic move as the model says, since Pinocchio is given every coordinate by name."""
    arrays = {field: np.array(getattr(motion, field)) for field in ("position", "velocity", "acceleration")}
    for k, name in enumerate(motion.names):
        mimic = model.joints[name].mimic
        for field, values in arrays.items():
            if mimic is not None:
                leader = motion.names.index(mimic.leader)
                values[:, k] = mimic.multiplier * values[:, leader] + (mimic.offset if field == "position" else 0.0)
    return JointMotion(names=motion.names, **arrays)


class _Case:
    """A robot, its motion as given by that of a base, and the same as given by that of another link."""

    def __init__(self, urdf: str, model: RobotModel, root_link: str) -> None:
        self.model, self.root_link = model, root_link
        self.joints = _following(model, random_motion(model, samples=SAMPLES, seed=1))
        self.base = random_root(SAMPLES, 2)
        self.oracle = Pinocchio(urdf, model, self.joints)
        motions = []
        for k in range(SAMPLES):
            self.oracle.state(k, self.base)
            motions.append(self.oracle.motion_of(root_link))
        proper, omega, alpha = (np.array(values) for values in zip(*motions, strict=True))
        self.root = RootMotion(proper_acceleration=proper, angular_velocity=omega, angular_acceleration=alpha)

    def answer(self, contact: Contact, evaluator: Evaluator) -> Estimates:
        """Everything that the library says of a robot that is held at one contact."""
        tree = build_tree(self.model, self.root_link)
        question = Question(
            tree=tree,
            contacts=(contact,),
            torques=moving_joints(tree),
            expected=tuple(tree.cuts),
            expected_contact=contact.link,
        )
        return estimate(question, self.joints, self.root, evaluator=evaluator)

    def compare(self, kinds: dict[str, Kind], evaluator: Evaluator) -> None:
        """Hold the robot at its root, then at some other link, by the library and by Pinocchio."""
        other = next(link for link in self.oracle.sensor_children if link != self.root_link)
        compared = 0
        for link in (self.root_link, other):
            found = self.answer(Contact(link=link), evaluator)
            for k in range(SAMPLES):
                self.oracle.state(k, self.base)
                readings, torques, wrench = self.oracle.held_at(link)
                atol = ROUNDING * float(np.abs(wrench).max())
                np.testing.assert_allclose(found.contact(link)[k], wrench, rtol=0, atol=atol)
                for name, kind in kinds.items():
                    wanted = _in_frame(kind, readings[name])
                    np.testing.assert_allclose(found.expected_of(name)[k], wanted, rtol=0, atol=atol)
                    assert np.abs(found.expected_of(name)[k] + wanted).max() > VISIBLE  # negative control
                for name, torque in torques.items():
                    np.testing.assert_allclose(found.torque(name)[k], torque, rtol=0, atol=atol)
                    compared += 1
        assert compared >= 2 * SAMPLES * 10


def _tagged(robot: str, root_link: str, shift: int, folder: Path) -> tuple[_Case, dict[str, Kind]]:
    find, _ = TAGGED[robot]
    urdf, kinds = _vary(find().read_text(encoding="utf-8"), shift)
    model = read_text(urdf, folder)
    assert {name: (s.frame, s.direction) for name, s in model.sensors.items()} == {k: v[:2] for k, v in kinds.items()}
    return _Case(urdf, model, root_link), kinds


@pytest.mark.parametrize("evaluator", Evaluator)
@pytest.mark.parametrize(("robot", "root_link"), [(robot, link) for robot in TAGGED for link in TAGGED[robot][1]])
def test_every_kind_of_tag_equals_pinocchio(robot: str, root_link: str, evaluator: Evaluator, tmp_path: Path) -> None:
    """From any root and contact, sensors of every frame, direction and origin read as in Pinocchio."""
    seen = set()
    for shift in (0, 1):
        case, kinds = _tagged(robot, root_link, shift, tmp_path)
        case.compare(kinds, evaluator)
        seen |= {kind[:2] for kind in kinds.values()}
    assert seen == set(KINDS)


@pytest.mark.parametrize("evaluator", Evaluator)
@some_cases(("robot", "root_link"), [(robot, link) for robot in UNTAGGED for link in UNTAGGED[robot][1]])
def test_declared_sensors_equal_pinocchio(robot: str, root_link: str, evaluator: Evaluator, tmp_path: Path) -> None:
    """Wrist sensors that are declared by their fixed joint read as in Pinocchio; so do torques of slides."""
    find, _ = UNTAGGED[robot]
    urdf = find().read_text(encoding="utf-8")
    plain = read_text(urdf, tmp_path)
    wrists = [joint for joint in plain.joints if joint.startswith("wrist_") and joint.endswith("ft_joint")]
    assert wrists
    for frame, direction in product(("child", "parent"), MeasureDirection):
        model, kinds = plain, {}
        for joint in wrists:
            model = model.with_sensor(joint, joint=joint, direction=direction, frame=frame)
            child_H_parent = np.linalg.inv(plain.joints[joint].parent_H_child)
            kinds[joint] = (frame, direction, np.eye(4) if frame == "child" else child_H_parent)
        _Case(urdf, model, root_link).compare(kinds, evaluator)


@pytest.mark.parametrize("spoilt", ["frame", "direction", "origin"])
def test_a_mistaken_tag_disagrees_with_pinocchio(spoilt: str, tmp_path: Path) -> None:
    """Negative control: a wrong frame, direction or origin shows in the comparison."""
    case, kinds = _tagged("gazebo_v2_7", "l_foot", 0, tmp_path)
    name = next(name for name, kind in kinds.items() if kind[0] == "sensor")
    _, direction, pose = kinds[name]
    mistaken = {
        "frame": (direction, np.eye(4)),
        "direction": (next(d for d in MeasureDirection if d is not direction), pose),
        "origin": (direction, np.linalg.inv(pose)),
    }[spoilt]
    found = case.answer(Contact(link="l_foot"), Evaluator.READABLE)
    case.oracle.state(0, case.base)
    readings, _, _ = case.oracle.held_at("l_foot")
    assert np.abs(found.expected_of(name)[0] - _in_frame(("sensor", *mistaken), readings[name])).max() > VISIBLE
