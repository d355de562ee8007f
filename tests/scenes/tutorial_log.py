# SPDX-License-Identifier: BSD-3-Clause
"""The log of the tutorial: the demonstration's arm for a minute, its sensor 3 % off, and a hand that pushes it.

`python -m tests.scenes.tutorial_log` writes the files that the tutorial has.
"""

from __future__ import annotations

import csv
import io
import re
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.robot.dynamics import expected_wrenches
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.robots import ARM_URDF

FOLDER = Path(__file__).resolve().parents[2] / "docs" / "tutorial"
SENSOR, JOINT = "arm_ft", "arm_ft_joint"
RATE_HZ, SECONDS = 25.0, 64.0
PUSH_S = (24.0, 31.0)
"""While a hand pushes."""
FULL_SCALE = (200.0, 200.0, 200.0, 20.0, 20.0, 20.0)
_NOISE = np.repeat([0.05, 0.002], 3)
_OFFSET = np.array([4.0, -7.5, 12.0, 0.3, -0.2, 0.1])


def robot() -> RobotModel:
    """The arm."""
    return read_urdf(ARM_URDF)


def robot_text() -> str:
    """Its URDF without the tag of the sensor, as most robots have none."""
    text = re.sub(r"\s*<sensor.*?</sensor>", "", ARM_URDF.read_text(encoding="utf-8"), flags=re.DOTALL)
    return text.replace("made up for demonstrations", "made up for the tutorial")


def distortion() -> FloatArray:
    """Matrix that the sensor's maker should have multiplied by: off by 3 % of full scale here and there."""
    rng = np.random.default_rng(28)
    scale = np.array(FULL_SCALE)
    shares: FloatArray = np.eye(6) + 0.03 * rng.normal(size=(6, 6))
    return scale[:, None] * shares / scale


def motion() -> tuple[FloatArray, JointMotion]:
    """Times and joints."""
    rng = np.random.default_rng(7)
    names = tuple(name for name, joint in robot().joints.items() if joint.type.moves)
    time = np.arange(0.0, SECONDS, 1.0 / RATE_HZ)
    size = rng.uniform(0.35, 0.7, (2, len(names)))
    rate = rng.uniform(0.25, 0.9, (2, len(names)))
    phase = rng.uniform(0.0, 2.0 * np.pi, (2, len(names)))
    angle = time[:, None, None] * rate + phase
    return time, JointMotion(
        names=names,
        position=(size * np.sin(angle)).sum(axis=1),
        velocity=(size * rate * np.cos(angle)).sum(axis=1),
        acceleration=-(size * rate**2 * np.sin(angle)).sum(axis=1),
    )


def truth() -> FloatArray:
    """What an exact sensor without offset reads, the push included; shape (n, 6); N, N m."""
    time, joints = motion()
    still = RootMotion(
        proper_acceleration=np.array([0.0, 0.0, STANDARD_GRAVITY]),
        angular_velocity=np.zeros(3),
        angular_acceleration=np.zeros(3),
    )
    wrench = np.array(expected_wrenches(build_tree(robot(), "base"), joints, still)[SENSOR])
    pushed = (time >= PUSH_S[0]) & (time < PUSH_S[1])
    share = np.where(pushed, np.sin(np.pi * (time - PUSH_S[0]) / (PUSH_S[1] - PUSH_S[0])), 0.0)
    return wrench + share[:, None] * np.array([9.0, -4.0, 6.0, 0.8, 1.6, -0.3])


def reading() -> FloatArray:
    """What this sensor reads; shape (n, 6); N, N m."""
    wrench = truth()
    noise = _NOISE * np.random.default_rng(3).normal(size=wrench.shape)
    read: FloatArray = (wrench + noise) @ np.linalg.inv(distortion()).T + _OFFSET
    return read


def log_text() -> str:
    """The log as CSV, whose headings state units."""
    time, joints = motion()
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    wrench = [
        f"{name}_{unit}"
        for name, unit in zip(("fx", "fy", "fz", "tx", "ty", "tz"), 3 * ["N"] + 3 * ["Nm"], strict=True)
    ]
    writer.writerow(["time_s", *(f"{name}_rad" for name in joints.names), *wrench])
    for k, row in enumerate(reading()):
        angles = [f"{value:.4f}" for value in joints.position[k]]
        writer.writerow([f"{time[k]:.2f}", *angles, *(f"{v:.2f}" for v in row[:3]), *(f"{v:.4f}" for v in row[3:])])
    return text.getvalue()


if __name__ == "__main__":
    FOLDER.mkdir(exist_ok=True)
    (FOLDER / "robot.urdf").write_text(robot_text(), encoding="utf-8")
    (FOLDER / "log.csv").write_text(log_text(), encoding="utf-8")
