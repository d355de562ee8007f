# SPDX-License-Identifier: BSD-3-Clause
"""Robots that tests share: those of installed packages, and small ones written by hand."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.urdf import read_urdf

PENDULUM_URDF = """
<robot name="pendulum">
  <link name="base"/>
  <link name="arm"><inertial><mass value="0.5"/><origin xyz="0 0 -0.1"/>
    <inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial></link>
  <link name="bob"><inertial><mass value="2"/><origin xyz="0 0 -0.3"/>
    <inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial></link>
  <joint name="swing" type="continuous"><parent link="base"/><child link="arm"/><axis xyz="0 1 0"/></joint>
  <joint name="mount" type="fixed"><parent link="arm"/><child link="bob"/><origin xyz="0 0 -0.2"/></joint>
  <sensor name="ft" type="force_torque"><parent joint="mount"/>
    <force_torque><frame>child</frame><measure_direction>child_to_parent</measure_direction></force_torque></sensor>
</robot>
"""
"""A bob of 2 kg, 0.5 m below a hinge about y, with a sensor 0.2 m below the hinge."""


def robot_xml(*elements: str) -> str:
    """URDF text of a robot of these elements."""
    return "\n".join(["<robot name='robot'>", *elements, "</robot>"])


def link_xml(
    name: str, *, mass: float = 0.0, xyz: str = "0 0 0", rpy: str = "0 0 0", moments: str = "0 0 0 0 0 0"
) -> str:
    """URDF text of a link; the moments about the centre of mass are ixx ixy ixz iyy iyz izz."""
    keys = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
    tensor = " ".join(f"{key}='{value}'" for key, value in zip(keys, moments.split(), strict=True))
    return (
        f"<link name='{name}'><inertial><origin xyz='{xyz}' rpy='{rpy}'/>"
        f"<mass value='{mass!r}'/><inertia {tensor}/></inertial></link>"
    )


def joint_xml(
    name: str,
    parent: str,
    child: str,
    *,
    type: str = "fixed",
    xyz: str = "0 0 0",
    rpy: str = "0 0 0",
    axis: str = "0 0 1",
    inside: str = "",
) -> str:
    """URDF text of a joint."""
    return (
        f"<joint name='{name}' type='{type}'><parent link='{parent}'/><child link='{child}'/>"
        f"<origin xyz='{xyz}' rpy='{rpy}'/><axis xyz='{axis}'/>{inside}</joint>"
    )


def sensor_xml(
    name: str, joint: str, *, frame: str = "child", direction: str = "child_to_parent", inside: str = ""
) -> str:
    """URDF text of a force-torque sensor in its plain form."""
    return (
        f"<sensor name='{name}' type='force_torque'><parent joint='{joint}'/>{inside}<force_torque>"
        f"<frame>{frame}</frame><measure_direction>{direction}</measure_direction></force_torque></sensor>"
    )


def read_text(urdf: str, folder: Path) -> RobotModel:
    """Read a robot from URDF text, by way of a file in a folder."""
    file = folder / "robot.urdf"
    file.write_text(urdf, encoding="utf-8")
    return read_urdf(file)


def icub(name: str) -> Path:
    """URDF of an iCub of the package icub-models; skips where it is not installed."""
    icub_models = pytest.importorskip("icub_models")
    return Path(icub_models.get_model_file(name))


def example_robot(path: str) -> Path:
    """URDF of a robot of the package example-robot-data; skips where it is not installed."""
    for entry in sys.path:
        file = Path(entry) / "cmeel.prefix" / "share" / "example-robot-data" / "robots" / path
        if file.is_file():
            return file
    pytest.skip("example-robot-data is not installed")


def random_motion(model: RobotModel, *, samples: int, seed: int) -> JointMotion:
    """Random positions, velocities and accelerations of every moving joint of a robot."""
    rng = np.random.default_rng(seed)
    names = tuple(joint.name for joint in model.joints.values() if joint.type.moves)
    assert names
    position, velocity, acceleration = rng.uniform(-1.5, 1.5, size=(3, samples, len(names)))
    return JointMotion(names=names, position=position, velocity=2 * velocity, acceleration=5 * acceleration)
