# SPDX-License-Identifier: BSD-3-Clause
"""A URDF file is written again with other inertias and joint zeros, and all else as it was."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import FormatError
from forcetorque.robot.model import JointType
from forcetorque.robot.modified_robot import RobotErrors
from forcetorque.robot.urdf import read_urdf
from forcetorque.robot.urdf_and_mjcf_text import corrected_urdf_text

URDF = """<?xml version="1.0"?>
<robot name="slider">
  <!-- weighed on a scale -->
  <link name="base"/>
  <link name="arm">
    <inertial>
      <origin xyz="0.1 0 0.2" rpy="0.3 -0.2 0.1"/>
      <mass value="2"/>
      <inertia ixx="0.03" ixy="0.001" ixz="0" iyy="0.02" iyz="0.002" izz="0.01"/>
    </inertial>
    <visual><geometry><mesh filename="arm.stl"/></geometry></visual>
  </link>
  <link name="finger"><inertial><mass value="0.2"/><inertia ixx="1e-4" iyy="1e-4" izz="1e-4" ixy="0" ixz="0" iyz="0"/>
  </inertial></link>
  <link name="other"/>
  <joint name="lift" type="prismatic">
    <parent link="base"/><child link="arm"/><origin xyz="0 0 1" rpy="0 0.5 0"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="1" effort="1" velocity="1"/>
  </joint>
  <joint name="curl" type="revolute">
    <parent link="arm"/><child link="finger"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
  <joint name="follow" type="revolute">
    <parent link="arm"/><child link="other"/><axis xyz="1 0 0"/><mimic joint="curl" multiplier="-2" offset="0.1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
</robot>
"""


def test_the_text_is_read_as_the_corrected_robot(tmp_path: Path) -> None:
    """Masses, tensors, centres and zeros of turning, sliding and mimicking joints; meshes and comments stay."""
    file = tmp_path / "robot.urdf"
    file.write_text(URDF, encoding="utf-8")
    errors = RobotErrors(
        mass={"arm": 0.1, "finger": -0.2},
        centre_m={"arm": np.array([0.01, -0.02, 0.03])},
        joint_zero_rad={"lift": 0.05, "curl": 0.02},
    )
    wanted = errors.applied_to(read_urdf(file))
    text = corrected_urdf_text(file, wanted)
    (tmp_path / "new.urdf").write_text(text, encoding="utf-8")
    got = read_urdf(tmp_path / "new.urdf")
    for name, link in wanted.links.items():
        np.testing.assert_allclose(got.links[name].matrix(), link.matrix(), rtol=1e-12, atol=1e-15)
    for name, joint in wanted.joints.items():
        np.testing.assert_allclose(got.joints[name].parent_H_child, joint.parent_H_child, atol=1e-15)
    assert {joint.type for joint in got.joints.values()} == {JointType.PRISMATIC, JointType.REVOLUTE}
    # the slider moves along its axis, and the joint that mimics turns by -2 times as much as its leader
    before = read_urdf(file)
    moved = np.linalg.inv(before.joints["lift"].parent_H_child) @ wanted.joints["lift"].parent_H_child
    np.testing.assert_allclose(moved[:3, 3], [0.0, 0.0, 0.05], atol=1e-15)
    turned = np.linalg.inv(before.joints["follow"].parent_H_child) @ wanted.joints["follow"].parent_H_child
    assert np.arctan2(turned[2, 1], turned[1, 1]) == pytest.approx(-0.04)
    assert "<!-- weighed on a scale -->" in text
    assert 'filename="arm.stl"' in text
    assert text.replace(" ", "").count('ixy="0.0011"') == 1


def test_without_a_change_all_numbers_stay(tmp_path: Path) -> None:
    """Negative control: not one attribute is written anew."""
    file = tmp_path / "robot.urdf"
    file.write_text(URDF, encoding="utf-8")
    text = corrected_urdf_text(file, read_urdf(file))
    assert [line.replace(" />", "/>") for line in text.split("\n")] == URDF.split("\n")


def test_a_file_that_is_no_urdf_is_refused(tmp_path: Path) -> None:
    """As where it is read."""
    (tmp_path / "robot.urdf").write_text("<mesh/>", encoding="utf-8")
    with pytest.raises(FormatError, match="root element <robot>"):
        corrected_urdf_text(tmp_path / "robot.urdf", read_urdf(tmp_path / "robot.urdf"))
