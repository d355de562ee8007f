# SPDX-License-Identifier: BSD-3-Clause
"""Expected wrenches against Newton's law for the points of a moving arm, differentiated numerically."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.robot.dynamics import expected_wrenches
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree
from tests.robot.kinematics import link_poses
from tests.scenes.robots import joint_xml, link_xml, read_text, robot_xml, sensor_xml

STEP = 1e-3
"""s: between the instants of the difference quotients."""

AGREEMENT = 1e-6
"""N, N m: quotients of fourth order err by STEP^4 / 90 times a sixth derivative of some 1e4 m/s6, 1e-10,
and by rounding of 10 eps / STEP^2 = 2e-9 m/s2; times 5 kg, with a margin of 50 for lever arms and sums."""

VISIBLE = 0.1
"""N, N m: what a negative control must exceed."""

GRAVITY = np.array([1.5, -2.0, -9.0])
"""m/s2, in the base; its direction is general on purpose."""

JOINTS = ("turn", "slide", "roll")
AMPLITUDE, RATE, PHASE = np.array([0.8, 0.3, 1.1]), np.array([2.0, 1.5, 2.5]), np.array([0.3, 1.0, -0.7])
"""Joint j moves as A sin(w t + p): rad or m, rad/s, rad."""

FAR_SIDE = {"base": ("wrist", "tip"), "tip": ("base", "upper", "fore")}
"""Links beyond the sensor, seen from each root."""


def _points() -> dict[str, tuple[FloatArray, FloatArray]]:
    """Every link is five point masses: masses of shape (5,) and positions of shape (5, 3) in the link."""
    rng = np.random.default_rng(1)
    return {
        link: (rng.uniform(0.1, 0.5, 5), rng.uniform(-0.2, 0.2, (5, 3)))
        for link in ("base", "upper", "fore", "wrist", "tip")
    }


def _link(name: str, masses: FloatArray, positions: FloatArray) -> str:
    """The rigid body of those point masses."""
    mass, centre = masses.sum(), masses @ positions / masses.sum()
    arms = positions - centre
    tensor = sum(m * (r @ r * np.eye(3) - np.outer(r, r)) for m, r in zip(masses, arms, strict=True))
    moments = np.asarray(tensor)[np.triu_indices(3)]
    return link_xml(
        name,
        mass=float(mass),
        xyz=" ".join(repr(float(x)) for x in centre),
        moments=" ".join(repr(float(x)) for x in moments),
    )


def _arm(folder: Path) -> RobotModel:
    return read_text(
        robot_xml(
            *(_link(name, *points) for name, points in _points().items()),
            joint_xml("turn", "base", "upper", type="revolute", xyz="0.1 0 0.2", rpy="0.3 0.1 -0.4", axis="1 2 -1"),
            joint_xml("slide", "upper", "fore", type="prismatic", xyz="0 0.2 0.1", rpy="0 0.5 0", axis="0 1 1"),
            joint_xml("mount", "fore", "wrist", xyz="0.05 0 0.1", rpy="0 0 0.7"),
            joint_xml("roll", "wrist", "tip", type="continuous", xyz="0.1 0.1 0", rpy="-0.6 0 0.2", axis="0 -3 1"),
            sensor_xml("ft", "mount", frame="sensor", inside="<origin xyz='0.01 0.02 0.03' rpy='0.2 -0.3 0.4'/>"),
        ),
        folder,
    )


def _joints(t: float) -> JointMotion:
    angle = RATE * t + PHASE
    return JointMotion(
        names=JOINTS,
        position=(AMPLITUDE * np.sin(angle))[None],
        velocity=(AMPLITUDE * RATE * np.cos(angle))[None],
        acceleration=(-AMPLITUDE * RATE**2 * np.sin(angle))[None],
    )


def _derivatives(values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """First and second derivative at the middle of five instants, along the first axis, to fourth order."""
    first = np.tensordot([1.0, -8.0, 0.0, 8.0, -1.0], values, 1) / (12 * STEP)
    second = np.tensordot([-1.0, 16.0, -30.0, 16.0, -1.0], values, 1) / (12 * STEP**2)
    return first, second


def _instants(model: RobotModel, t: float) -> list[dict[str, FloatArray]]:
    times = t + STEP * np.arange(-2, 3)
    return [link_poses(model, dict(zip(JOINTS, _joints(time).position[0], strict=True))) for time in times]


def _root_motion(instants: list[dict[str, FloatArray]], link: str) -> RootMotion:
    """Motion of a link's frame: `R^T R'` is the angular velocity's matrix, `R^T R''` holds the acceleration's."""
    poses = np.array([poses[link] for poses in instants])
    rotation = poses[2, :3, :3]
    first, second = _derivatives(poses)

    def vector(matrix: FloatArray) -> FloatArray:
        odd = (matrix - matrix.T) / 2
        return np.array([odd[2, 1], odd[0, 2], odd[1, 0]])

    return RootMotion(
        proper_acceleration=rotation.T @ (second[:3, 3] - GRAVITY),
        angular_velocity=vector(rotation.T @ first[:3, :3]),
        angular_acceleration=vector(rotation.T @ second[:3, :3]),
    )


def _on_far_side(model: RobotModel, instants: list[dict[str, FloatArray]], root: str) -> FloatArray:
    """Sum of m (a - g) of the points beyond the sensor, and of its moments, in the sensor's frame."""
    sensor = instants[2]["wrist"] @ model.sensors["ft"].child_H_sensor
    total = np.zeros(6)
    for link in FAR_SIDE[root]:
        masses, inside = _points()[link]
        positions = np.array([inside @ poses[link][:3, :3].T + poses[link][:3, 3] for poses in instants])
        forces = masses[:, None] * (_derivatives(positions)[1] - GRAVITY)
        arms = positions[2] - sensor[:3, 3]
        total += np.concatenate([forces.sum(axis=0), np.cross(arms, forces).sum(axis=0)])
    return np.concatenate([sensor[:3, :3].T @ total[:3], sensor[:3, :3].T @ total[3:]])


@pytest.mark.parametrize("root", FAR_SIDE)
def test_newtons_law_of_the_points(root: str, tmp_path: Path) -> None:
    """The reading is what the points beyond the sensor need to move as they do, from either end of the arm.

    The sensor reads the wrist on the forearm: minus what the wrist's side needs when the base is
    known, plus what the base's side needs when the tip is. Negative controls: the other sign, and
    joints that stand still.
    """
    model = _arm(tmp_path)
    tree = build_tree(model, root)
    sign = -1.0 if root == "base" else 1.0
    compared = 0
    for t in (0.0, 0.4, 1.7, 3.1):
        instants, joints = _instants(model, t), _joints(t)
        motion, needed = _root_motion(instants, root), _on_far_side(model, instants, root)
        found = expected_wrenches(tree, joints, motion)["ft"][0]
        np.testing.assert_allclose(found, sign * needed, rtol=0, atol=AGREEMENT)
        assert np.abs(found + sign * needed).max() > VISIBLE
        still = JointMotion.at_rest(JOINTS, joints.position)
        assert np.abs(found - expected_wrenches(tree, still, motion)["ft"][0]).max() > VISIBLE
        compared += 1
    assert compared == 4
