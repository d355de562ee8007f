# SPDX-License-Identifier: BSD-3-Clause
"""Whose joints the cables across a sensor belong to: those near it, beyond it of its own limb alone."""

from __future__ import annotations

from pathlib import Path

import pytest

from forcetorque.calibration.model_error_derivatives import UncertainPart
from forcetorque.experiment.calibration.robot_model_error import ModelTolerance, TermKind
from forcetorque.robot.model import RobotModel
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.robots import named_robot
from tests.scenes.robots import joint_xml, link_xml, read_text, robot_xml, sensor_xml

LEG = ("hip_pitch", "hip_roll", "hip_yaw", "knee", "ankle_pitch", "ankle_roll")
ARM = ("shoulder_pitch", "shoulder_roll", "shoulder_yaw", "elbow", "wrist_prosup", "wrist_pitch", "wrist_yaw")
LIMBS = {"leg": LEG, "foot": LEG, "arm": ARM}
"""Joints of the limb that a sensor is in, as far as the robot has them."""
ICUBS = ("icub_genova02_yoga/robots/iCubGenova02.urdf", "icub_genova04_walking_ramadoss/model.urdf")


def _cable_joints(model: RobotModel, root: str, sensor: str) -> list[str]:
    """Joints of the pulls along x, in the order of the terms."""
    tree = build_tree(model, root)
    uncertain = UncertainPart.of(tree, tree, sensor, ModelTolerance())
    assert uncertain is not None
    pulls = [term.name for term in uncertain.terms if term.kind is TermKind.PULL and term.name.startswith("x")]
    twists = [term for term in uncertain.terms if term.kind is TermKind.TWIST]
    assert len(twists) == 3 * len(pulls)
    return [name.rpartition(" ")[2] for name in pulls]


def _require_own_limb(model: RobotModel, pelvis: str, chest: str, suffix: str) -> None:
    """In the air, and of legs on the ground too, the cables of a sensor are those of all joints of its limb."""
    for limb in ("l_leg", "r_leg", "l_foot", "r_foot", "l_arm", "r_arm"):
        side, _, kind = limb.partition("_")
        own = {f"{side}_{joint}" for joint in LIMBS[kind]} & model.joints.keys()
        assert len(own) >= 4
        for root in [chest] if kind == "arm" else [pelvis, f"{side}_sole"]:
            joints = _cable_joints(model, root, f"{limb}{suffix}")
            assert set(joints) == own
            assert len(joints) == len(own)


def test_cables_beyond_a_sensor_are_of_its_limb() -> None:
    """A leg that stands and carries the robot has none of waist, arms and the other leg."""
    _require_own_limb(read_urdf(named_robot(["biped"])), "pelvis", "torso", "_ft")


@pytest.mark.real_data
@pytest.mark.parametrize("file", ICUBS)
def test_cables_beyond_a_sensor_of_an_icub_are_of_its_limb(data_dir: Path, file: str) -> None:
    """Of both models in the data; the forearm of the second turns and bends."""
    _require_own_limb(read_urdf(data_dir / file), "root_link", "chest", "_ft_sensor")


def _chain(folder: Path, *, fingers: int = 0, ft_between: bool = False) -> RobotModel:
    """Nine links in a chain by joints j1 to j8, a sensor after j7, and fingers on the last link."""
    elements = [link_xml("link0")]
    for k in range(1, 9):
        elements += [link_xml(f"link{k}", mass=1.0), joint_xml(f"j{k}", f"link{k - 1}", f"near{k}", type="revolute")]
        elements += [link_xml(f"near{k}"), joint_xml(f"mount{k}", f"near{k}", f"link{k}")]
    elements += [sensor_xml("ft", "mount7"), *([sensor_xml("other", "mount5")] if ft_between else [])]
    for k in range(fingers):
        finger = link_xml(f"finger{k}", mass=0.1)
        elements += [finger, joint_xml(f"finger_joint{k}", "link8", f"finger{k}", type="revolute")]
    return read_text(robot_xml(*elements), folder)


@pytest.mark.parametrize("ft_between", [False, True])
def test_cables_come_from_the_nearest_joints(tmp_path: Path, *, ft_between: bool) -> None:
    """Six on either side of the sensor, those farther away left out; another sensor divides no limb."""
    model = _chain(tmp_path, ft_between=ft_between)
    assert _cable_joints(model, "link0", "ft") == ["j2", "j3", "j4", "j5", "j6", "j7", "j8"]
    assert _cable_joints(model, "link8", "ft") == ["j8", "j7", "j6", "j5", "j4", "j3", "j2"]


@pytest.mark.parametrize(("fingers", "of_fingers"), [(1, ["finger_joint0"]), (2, [])])
def test_a_limb_ends_where_it_branches(tmp_path: Path, fingers: int, of_fingers: list[str]) -> None:
    """Beyond a palm of several fingers there is no limb that the cables across the wrist belong to."""
    joints = _cable_joints(_chain(tmp_path, fingers=fingers), "link0", "ft")
    assert [name for name in joints if "finger" in name] == of_fingers
    assert "j8" in joints
