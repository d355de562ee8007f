# SPDX-License-Identifier: BSD-3-Clause
"""The URDF of a device in iDynTree and Pinocchio: three stacked sensors and all joint torques."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.device.components import AttachedLoad, Device, device_load
from forcetorque.device.device_file import read_device
from forcetorque.device.expected_wrench import device_response
from forcetorque.device.motion import DeviceTrajectory, twelve_steps
from forcetorque.device.robot_model import BASE, device_model, device_root
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.urdf import read_urdf
from forcetorque.robot.urdf_and_mjcf_text import urdf_text, write_urdf
from tests.robot.mechanics.idyntree_oracle import IDynTree
from tests.robot.mechanics.pinocchio_oracle import Pinocchio
from tests.scenes.robots import random_motion

AGREEMENT = 1e-9
"""N, N m: some 350 N with ten bodies of some 50 roundings each at eps = 2e-16 are 4e-11, with a margin."""
VISIBLE = 1e-3
"""N, N m: what a gram on the load changes."""

DEVICE = read_device().with_sensors(3)
DEVICES = {"pitch first": DEVICE, "yaw first": DEVICE.changed(yaw_first=True)}


def _motions(device: Device, load: AttachedLoad) -> dict[str, JointMotion]:
    """Poses at rest, instants of the 12 steps, and motions as fast as they come."""
    trajectory = DeviceTrajectory(device=device, load=load, sequence=twelve_steps(device))
    return {
        "static": twelve_steps(device).still_poses(device, load, spacing_deg=60.0),
        "12 steps": trajectory(np.linspace(0.0, trajectory.duration_s, 60)),
        "dynamic": random_motion(device_model(device, load), samples=20, seed=1),
    }


def _idyntree(file: Path, device: Device, motion: JointMotion) -> tuple[FloatArray, FloatArray]:
    oracle, wrenches, torques = IDynTree(file, motion), [], []
    for k in range(len(motion)):
        oracle.fix(k, BASE, np.array([0.0, 0.0, -device.gravity]))
        readings, torque = oracle.expected(BASE)
        wrenches.append([readings[name] for name in device.sensor_names])
        torques.append(torque)
    return np.array(wrenches), np.array(torques)


def _pinocchio(file: Path, device: Device, motion: JointMotion) -> tuple[FloatArray, FloatArray]:
    oracle, wrenches, torques = Pinocchio(file.read_text(encoding="utf-8"), read_urdf(file), motion), [], []
    root = device_root(device)
    still = np.zeros((len(motion), 3))
    base = RootMotion(
        proper_acceleration=still + root.proper_acceleration, angular_velocity=still, angular_acceleration=still
    )
    for k in range(len(motion)):
        oracle.state(k, base)
        on_child, torque, _ = oracle.held_at(BASE)
        wrenches.append([-on_child[name] for name in device.sensor_names])  # they read what the child does
        torques.append([torque[name] for name in motion.names])
    return np.array(wrenches), np.array(torques)


@pytest.mark.parametrize("order", DEVICES)
@pytest.mark.parametrize("oracle", [_idyntree, _pinocchio])
def test_wrenches_and_torques_are_those_of_others(oracle, order: str, tmp_path: Path) -> None:  # type: ignore[no-untyped-def]
    """Static and dynamic motions of the URDF alone give others the same readings and torques."""
    device = DEVICES[order]
    load = device_load(device, 35.0)
    write_urdf(tmp_path / "device.urdf", device_model(device, load))
    for motion in _motions(device, load).values():
        ours = device_response(device, load, motion)
        columns = [ours.joints.index(name) for name in motion.names]
        wrenches, torques = oracle(tmp_path / "device.urdf", device, motion)
        assert wrenches.shape == (len(motion), 3, 6)
        np.testing.assert_allclose(ours.wrenches.values, wrenches, rtol=0, atol=AGREEMENT)
        np.testing.assert_allclose(ours.torques[:, columns], torques, rtol=0, atol=AGREEMENT)


def test_a_gram_is_noticed(tmp_path: Path) -> None:
    """Negative control: the oracle sees a load that is another by a gram."""
    load = AttachedLoad.point(35.0, 0.115)
    (tmp_path / "device.urdf").write_text(urdf_text(device_model(DEVICE, AttachedLoad.point(35.001, 0.115))))
    motion = _motions(DEVICE, load)["static"]
    wrenches, _ = _idyntree(tmp_path / "device.urdf", DEVICE, motion)
    assert np.abs(wrenches - device_response(DEVICE, load, motion).wrenches.values).max() > VISIBLE
