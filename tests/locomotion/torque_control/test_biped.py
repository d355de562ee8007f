# SPDX-License-Identifier: BSD-3-Clause
"""The robot of the closed loop: MuJoCo, URDF and our dynamics are one robot."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from forcetorque.base.errors import RobotError
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.locomotion.standing.centre_of_mass_and_pressure import centre_of_mass
from forcetorque.locomotion.torque_control.biped_in_mujoco import JOINTS, LEGS, SENSORS, SOLES, Biped
from forcetorque.locomotion.torque_control.closed_loop import (
    estimated_torques,
    pelvis_motion,
    rotations,
    torque_question,
)
from forcetorque.locomotion.torque_control.joint_torque_controller import JointDrive
from forcetorque.robot.dynamics import expected_wrenches
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.urdf_and_mjcf_text import write_urdf

mujoco = pytest.importorskip("mujoco")
from forcetorque.locomotion.torque_control.biped_in_mujoco import World  # noqa: E402

EQUAL = 1e-9
"""N m, kg m2: what the issue asks; rounding of sums of some hundred N m is 1e-13."""
VISIBLE = 1e-3
POSTURES = 6
FREE = JointDrive(torque_per_duty=1.0, lag_s=0.0, rotor_inertia=0.0, coulomb=0.0, viscous=0.0)


@pytest.fixture(scope="module")
def states() -> tuple[np.ndarray, np.ndarray]:
    """Random places, turns, postures and velocities, high above the ground; (n, 19), (n, 18)."""
    rng = np.random.default_rng(7)
    position = rng.uniform(-0.6, 0.6, (POSTURES, 19))
    position[:, 2] += 3.0
    position[:, 3:7] /= np.linalg.norm(position[:, 3:7], axis=1, keepdims=True)
    return position, rng.normal(size=(POSTURES, 18))


@pytest.fixture(scope="module")
def pinocchio(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """The URDF of the tilted robot in Pinocchio."""
    pin = pytest.importorskip("pinocchio")
    file = tmp_path_factory.mktemp("biped") / "biped.urdf"
    write_urdf(file, Biped.on_soles(10.0).model)
    return pin.buildModelFromUrdf(str(file), pin.JointModelFreeFlyer())


def _mass_matrices(model: Any, position: np.ndarray, velocity: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Mass matrices and bias of Pinocchio, in the coordinates of MuJoCo."""
    import pinocchio as pin

    data = model.createData()
    order = [6 + JOINTS.index(name) for name in model.names[2:]]
    masses, biases = [], []
    for q, v in zip(position, velocity, strict=True):
        turn = rotations(q[None, 3:7])[0]
        into = np.eye(18)  # from the world's axes to the pelvis's, as Pinocchio has linear velocities
        into[:3, :3] = turn.T
        theirs = np.concatenate([q[:3], q[4:7], q[3:4], np.zeros(12)])
        theirs[7:] = [q[7 + k - 6] for k in order]
        shuffle = np.zeros((18, 18))
        shuffle[:6, :6] = np.eye(6)
        shuffle[range(6, 18), order] = 1.0
        shuffle = shuffle @ into
        rates = shuffle @ v
        mass = pin.crba(model, data, theirs)
        mass = np.triu(mass) + np.triu(mass, 1).T
        # dv/dt of the pelvis's axes lacks omega x v, which is no acceleration of MuJoCo's coordinates
        still = np.zeros(18)
        still[:3] = -np.cross(rates[3:6], rates[:3])
        bias = pin.rnea(model, data, theirs, rates, still)
        masses.append(shuffle.T @ mass @ shuffle)
        biases.append(shuffle.T @ bias)
    return np.array(masses), np.array(biases)


def _mass_matrices_of_mujoco(world: World) -> np.ndarray:
    """Mass matrices of the postures that were looked at, row by row, as every version of MuJoCo multiplies by them."""
    matrices = np.zeros((POSTURES, 18, 18))
    for matrix, data in zip(matrices, world.copies, strict=True):
        for row, unit in zip(matrix, np.eye(18), strict=True):
            mujoco.mj_mulM(world.model, data, row, unit)
    order = np.concatenate([np.arange(6), world.dofs])
    return matrices[:, order[:, None], order]


def test_mujoco_and_urdf_have_one_mass_matrix_and_one_gravity(states: Any, pinocchio: Any) -> None:
    """MJCF and URDF, both written from one model, agree in M and in gravity and Coriolis forces at random states."""
    position, velocity = states
    world = World(Biped.on_soles(10.0), FREE, copies=POSTURES, step_s=1e-3)
    pinocchio.gravity.linear = np.array([0.0, 0.0, -STANDARD_GRAVITY])
    masses, biases = _mass_matrices(pinocchio, position, velocity)
    world.place(position, velocity)
    posture = world.look(np.ones(POSTURES, dtype=bool))
    theirs = _mass_matrices_of_mujoco(world)
    np.testing.assert_allclose(theirs, masses, rtol=0, atol=EQUAL)
    np.testing.assert_allclose(posture.bias, biases, rtol=0, atol=EQUAL)
    heavier = Biped.on_soles(0.0)  # negative control: another sole is another robot only if something hangs on it
    assert heavier.mass == pytest.approx(30.9)
    assert np.abs(theirs[0] - masses[1]).max() > VISIBLE


def test_sensors_and_torques_of_mujoco_are_those_of_our_estimator(states: Any) -> None:
    """In the air MuJoCo's sensors read what our dynamics expect, and the estimated torques are those that act."""
    position, velocity = states
    biped = Biped.on_soles(10.0)
    world = World(biped, FREE, copies=POSTURES, step_s=1e-3)
    world.place(position, velocity)
    awake = np.ones(POSTURES, dtype=bool)
    posture = world.look(awake)
    torque = np.random.default_rng(8).normal(size=(POSTURES, 12))
    acceleration, wrenches = world.advance(torque, awake)
    joints = JointMotion(
        names=JOINTS, position=position[:, 7:], velocity=velocity[:, 6:], acceleration=acceleration[:, 6:]
    )
    expected = expected_wrenches(biped.tree, joints, pelvis_motion(position, velocity, acceleration), SENSORS)
    for k, sensor in enumerate(SENSORS):
        np.testing.assert_allclose(wrenches[:, k], expected[sensor], rtol=0, atol=EQUAL)
    estimated = estimated_torques(torque_question(biped), posture.position, velocity, acceleration, readings=wrenches)
    np.testing.assert_allclose(estimated, torque, rtol=0, atol=EQUAL)
    off = estimated_torques(torque_question(biped), posture.position, velocity, acceleration, readings=1.01 * wrenches)
    assert np.abs(off - torque).max() > VISIBLE


def test_centre_of_mass_is_that_of_mujoco(states: Any) -> None:
    """The centre of mass of the reference is that of the simulation."""
    position, _ = states
    biped = Biped.on_soles(-5.0)
    world = World(biped, FREE, copies=POSTURES, step_s=1e-3)
    world.place(position)
    posture = world.look(np.ones(POSTURES, dtype=bool))
    in_pelvis = centre_of_mass(biped.tree, JointMotion.at_rest(JOINTS, position[:, 7:]))
    turned = np.einsum("nij,nj->ni", rotations(position[:, 3:7]), in_pelvis)
    np.testing.assert_allclose(posture.centre_of_mass, position[:, :3] + turned, rtol=0, atol=EQUAL)


def test_a_tilted_sole_turns_the_foot_and_its_sensor_alone() -> None:
    """Only the frames of the soles move, by the angle that is asked for."""
    straight, tilted = Biped.on_soles(), Biped.on_soles(15.0)
    changed = [
        name
        for name, joint in tilted.model.joints.items()
        if not np.array_equal(joint.parent_H_child, straight.model.joints[name].parent_H_child)
    ]
    assert changed == [f"{sole}_joint" for sole in SOLES]
    for name in changed:
        turn = tilted.model.joints[name].parent_H_child[:3, :3]
        assert np.rad2deg(np.arctan2(turn[0, 2], turn[0, 0])) == pytest.approx(15.0)
    assert [joint for leg in LEGS for joint in leg] == list(JOINTS)


def test_a_steep_sole_is_refused() -> None:
    """Ankles do not go on soles that are too steep."""
    with pytest.raises(RobotError, match="at most 20 degrees"):
        Biped.on_soles(30.0)
