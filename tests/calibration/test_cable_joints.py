# SPDX-License-Identifier: BSD-3-Clause
"""Whose joints the cables across a sensor belong to: those near it, beyond it of its own limb alone."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.calibration.model_error_derivatives import UncertainPart
from forcetorque.experiment.calibration.robot_model_error import CABLE_LEVER_M, ModelTolerance, TermKind
from forcetorque.robot.dynamics import expected_wrenches
from forcetorque.robot.model import RobotModel
from forcetorque.robot.modified_robot import RobotErrors
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.robots import named_robot
from tests.scenes.robots import joint_xml, link_xml, read_text, robot_xml, sensor_xml

LEG = ("hip_pitch", "hip_roll", "hip_yaw", "knee", "ankle_pitch", "ankle_roll")
ARM = ("shoulder_pitch", "shoulder_roll", "shoulder_yaw", "elbow", "wrist_prosup", "wrist_pitch", "wrist_yaw")
LIMBS = {"leg": LEG, "foot": LEG, "arm": ARM}
"""Joints of the limb that a sensor is in, as far as the robot has them."""
UPRIGHT = RootMotion.fixed([0.0, 0.0, -1.0])
ICUBS = ("icub_genova02_yoga/robots/iCubGenova02.urdf", "icub_genova04_walking_ramadoss/model.urdf")


def _part(model: RobotModel, root: str, sensor: str) -> UncertainPart:
    tree = build_tree(model, root)
    uncertain = UncertainPart.of(tree, tree, sensor, ModelTolerance())
    assert uncertain is not None
    return uncertain


def _cable_joints(model: RobotModel, root: str, sensor: str) -> list[str]:
    """Joints of the pulls along x, in the order of the terms."""
    uncertain = _part(model, root, sensor)
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


def _chain(
    folder: Path,
    *,
    fingers: int = 0,
    ft_between: bool = False,
    mimics: Mapping[int, str] = {},
    sliding: Collection[int] = (),
) -> RobotModel:
    """Nine links in a chain by joints j1 to j8, a sensor after j7, and fingers on the last link."""
    elements = [link_xml("link0")]
    for k in range(1, 9):
        inside = f"<mimic {mimics[k]}/>" if k in mimics else ""
        joint = joint_xml(
            f"j{k}",
            f"link{k - 1}",
            f"near{k}",
            type="prismatic" if k in sliding else "revolute",
            xyz="0.1 0 0.2",
            axis="0 1 0" if k % 2 else "1 0 0",
            inside=inside,
        )
        elements += [link_xml(f"link{k}", mass=1.0, xyz="0.1 0.05 0"), joint]
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


def test_a_leader_has_the_cables_of_joints_that_mimic(tmp_path: Path) -> None:
    """It counts as near as the nearest joint that it moves, and one unknown has the pulls of all of these."""
    near = _part(_chain(tmp_path, mimics={7: "joint='j1' multiplier='-0.5'"}), "link0", "ft")
    assert _cable_joints(_chain(tmp_path, mimics={7: "joint='j1'"}), "link0", "ft") == [
        "j2",
        "j3",
        "j4",
        "j5",
        "j6",
        "j1",
        "j8",
    ]
    pulls = {term.name: term.deviation for term in near.terms if term.kind in (TermKind.PULL, TermKind.TWIST)}
    assert not [name for name in pulls if name.endswith("j7")]
    assert pulls["y pull of cables at j1"] == pytest.approx(0.5 * ModelTolerance().cable_N_rad)
    assert pulls["y pull of cables at j2"] == ModelTolerance().cable_N_rad
    both = _part(_chain(tmp_path, mimics={8: "joint='j6' multiplier='2'"}), "link0", "ft")
    (deviation,) = (term.deviation for term in both.terms if term.name == "z twist of cables at j6")
    assert deviation == pytest.approx(np.sqrt(5.0) * CABLE_LEVER_M * ModelTolerance().cable_N_rad)


def test_columns_of_a_leader(tmp_path: Path) -> None:
    """Cables pull by its position, and its zero moves the joints that mimic too; an order of joints changes nothing."""
    model = _chain(tmp_path, mimics={2: "joint='j4' multiplier='-0.5' offset='0.3'", 8: "joint='j3' multiplier='2'"})
    part, rng = _part(model, "link0", "ft"), np.random.default_rng(5)
    names = [term.name for term in part.terms_in("day")]
    assert [name for name in names if name.startswith("zero of")] == [f"zero of j{k}" for k in (1, 4, 3, 5, 6, 7)]
    motion = JointMotion.at_rest(part.joints[::-1], rng.uniform(-1.0, 1.0, (4, len(part.joints))))
    columns = dict(zip(names, part.derivatives(motion, UPRIGHT, np.zeros((4, 6))).transpose(2, 0, 1), strict=True))
    for joint in ("j3", "j4"):
        position = motion.position[:, motion.names.index(joint)]
        for component, name in enumerate((*(f"{axis} pull" for axis in "xyz"), *(f"{axis} twist" for axis in "xyz"))):
            column = columns[f"{name} of cables at {joint}"]
            np.testing.assert_array_equal(column[:, component], position)
            assert not np.delete(column, component, axis=1).any()
        by_zero, alone = (_by_zero(robot, motion, joint) for robot in (model, _chain(tmp_path)))
        np.testing.assert_allclose(columns[f"zero of {joint}"], by_zero, atol=1e-6 * np.abs(by_zero).max())
        assert np.abs(by_zero - alone).max() > 0.1 * np.abs(by_zero).max()


def _by_zero(model: RobotModel, motion: JointMotion, joint: str) -> FloatArray:
    """Difference of expected wrenches by the zero of a joint; joints without a position of their own are at 0."""
    missing = [f"j{k}" for k in range(1, 9) if f"j{k}" not in motion.names]
    position = np.hstack([motion.position, np.zeros((len(motion), len(missing)))])
    everywhere = JointMotion.at_rest((*motion.names, *missing), position)
    read = []
    for step in (1e-5, -1e-5):
        robot = RobotErrors(mass={}, centre_m={}, joint_zero_rad={joint: step}).applied_to(model)
        read.append(expected_wrenches(build_tree(robot, "link0"), everywhere, UPRIGHT)["ft"])
    return (read[0] - read[1]) / 2e-5


@pytest.mark.parametrize(
    ("sliding", "kind", "pulls"),
    [((8,), TermKind.ZERO, True), ((6,), TermKind.POSITION, False), ((), TermKind.ZERO, True)],
)
def test_a_leader_slides_or_turns_by_itself(
    tmp_path: Path, sliding: tuple[int, ...], kind: TermKind, pulls: bool
) -> None:
    """A joint that turns stays one where a sliding joint mimics it; one that slides has no cables per rad."""
    model = _chain(tmp_path, mimics={8: "joint='j6' multiplier='0.02'"}, sliding=sliding)
    (zero,) = (term for term in _part(model, "link0", "ft").terms if term.name == "zero of j6")
    assert zero.kind is kind
    assert ("j6" in _cable_joints(model, "link0", "ft")) is pulls
