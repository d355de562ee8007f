# SPDX-License-Identifier: BSD-3-Clause
"""Simulated motions, sensors and recordings: their truth is what they say."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.recording.alignment import seconds_since
from forcetorque.recording.recording import Recording
from forcetorque.robot.dynamics import expected_wrenches
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.motions.joint_motions import random_smooth_motion
from forcetorque.simulation.robots import ARM_URDF
from forcetorque.simulation.simulated_sensor import SimulatedSensor, distorted_by_mounting, y_shaped_matrix
from forcetorque.simulation.trace import simulate_recording

RANGES = {"a": (-1.0, 2.0), "b": (0.0, 0.1)}


def test_derivatives_are_exact() -> None:
    """Velocity and acceleration are the derivatives of the position, by central differences."""
    step = 1e-4
    at = np.arange(0.0, 5.0, 0.01)
    before, here, after = (
        random_smooth_motion(RANGES, at + shift, slowest_hz=0.3, rng=np.random.default_rng(1))
        for shift in (-step, 0.0, step)
    )
    # central differences err by step^2 / 6 of the third derivative, and by eps / step^2 of rounding
    np.testing.assert_allclose((after.position - before.position) / (2 * step), here.velocity, atol=1e-5)
    np.testing.assert_allclose(
        (after.position - 2 * here.position + before.position) / step**2, here.acceleration, atol=1e-4
    )


def test_positions_stay_in_their_ranges() -> None:
    """No joint leaves its range over a long time, and each uses most of it."""
    motion = random_smooth_motion(RANGES, np.arange(0, 500, 0.1), slowest_hz=0.2, rng=np.random.default_rng(2))
    for k, (low, high) in enumerate(RANGES.values()):
        position = motion.position[:, k]
        assert low <= position.min()
        assert position.max() <= high
        assert np.ptp(position) > 0.7 * (high - low)


def test_counts_decode_to_the_true_wrench() -> None:
    """The true matrix and offset turn readings back to the wrench within rounding and noise."""
    rng = np.random.default_rng(3)
    matrix = y_shaped_matrix(arm_m=0.02, counts_per_newton=60.0)
    sensor = SimulatedSensor(matrix=matrix, offset=np.array([1.0, 2, 3, 0.1, 0.2, 0.3]), noise_counts=0.0)
    wrench = rng.normal(size=(200, 6)) * [10, 10, 10, 1, 1, 1]
    raw = sensor.read(wrench, rng, rate_hz=100.0).counts
    assert np.array_equal(raw, np.rint(raw))
    half_count = 0.5 * np.abs(matrix).sum(axis=1)
    assert (np.abs(raw @ matrix.T + sensor.offset - wrench) <= half_count + 1e-9).all()


def test_a_saturated_board_holds_its_last_valid_sample() -> None:
    """While a channel is beyond its limit all channels stay as they were, and the status says so; no other time."""
    sensor = SimulatedSensor(matrix=np.eye(6) * 0.01, offset=np.zeros(6), noise_counts=0.0)
    wrench = np.outer([1.0, 2.0, 400.0, 400.0, 3.0], [1.0, 0.5, 0.1, 0.1, 0.1, 0.1])
    held = sensor.read(wrench, np.random.default_rng(4), rate_hz=100.0)
    np.testing.assert_array_equal(held.saturated, [False, False, True, True, False])
    np.testing.assert_array_equal(held.counts[2:4], held.counts[[1, 1]])
    np.testing.assert_array_equal(held.counts[[0, 1, 4], 0], [100.0, 200.0, 300.0])


def test_an_ideal_sensor_has_no_couplings_between_plane_and_axis() -> None:
    """The Y-shaped element separates fz, tx, ty from fx, fy, tz."""
    matrix = y_shaped_matrix(arm_m=0.02, counts_per_newton=60.0)
    assert np.abs(matrix[[0, 1, 5]][:, 1::2]).max() < 1e-15
    assert np.abs(matrix[[2, 3, 4]][:, ::2]).max() < 1e-15
    assert np.linalg.matrix_rank(matrix) == 6
    assert not np.allclose(distorted_by_mounting(matrix, relative=0.05, rng=np.random.default_rng(5)), matrix)


def _recording(model: RobotModel, seed: int) -> tuple[Recording, SimulatedSensor]:
    sensor = SimulatedSensor(
        matrix=y_shaped_matrix(arm_m=0.02, counts_per_newton=60.0), offset=np.zeros(6), noise_counts=0.0
    )
    ranges = {joint.name: (-1.0, 1.0) for joint in model.joints.values() if joint.type.moves}
    recording = simulate_recording(
        model,
        {"arm_ft": sensor},
        support="base",
        gravity_direction=[0, 0, -1],
        ranges=ranges,
        duration_s=5.0,
        rate_hz=100.0,
        slowest_hz=0.1,
        seed=seed,
    )
    return recording, sensor


def test_a_recording_holds_the_true_wrench() -> None:
    """The decoded stream is what mechanics demands of the recorded positions, up to velocity terms."""
    model = read_urdf(ARM_URDF)
    recording, sensor = _recording(model, 6)
    joints, stream = recording.stream("joints"), recording.stream("arm_ft")
    position = joints.signal("position")
    at = seconds_since(stream.stamp_ns, recording.start_ns)
    own = seconds_since(joints.stamp_ns, recording.start_ns)
    inside = (at > own[0]) & (at < own[-1])
    interpolated = np.column_stack([np.interp(at[inside], own, column) for column in position.values.T])
    motion = JointMotion.at_rest(position.columns, interpolated)
    static = expected_wrenches(build_tree(model, "base"), motion, RootMotion.fixed([0, 0, -1]))["arm_ft"]
    decoded = (stream.signal("raw").values @ sensor.matrix.T)[inside]
    # moves of 1 rad at 0.1 to 0.4 Hz accelerate 3 kg at 0.3 m by some m/s2; the weight is 34 N
    assert np.abs(decoded - static)[:, :3].max() < 8.0
    assert np.abs(decoded + static)[:, :3].max() > 20.0  # negative control: the sign matters


def test_the_seed_decides_everything() -> None:
    """The same seed gives the same recording, another seed another."""
    model = read_urdf(ARM_URDF)
    first, again, other = (_recording(model, seed)[0] for seed in (7, 7, 8))
    a, b, c = (r.stream("arm_ft").signal("raw").values for r in (first, again, other))
    np.testing.assert_array_equal(a, b)
    assert not np.array_equal(a, c)


def test_streams_have_their_own_clocks_steps() -> None:
    """Joints and sensors are stamped at different, jittering instants of one clock."""
    recording, _ = _recording(read_urdf(ARM_URDF), 9)
    joints, sensor = recording.stream("joints"), recording.stream("arm_ft")
    assert joints.clock == sensor.clock
    assert not set(joints.stamp_ns) & set(sensor.stamp_ns)
    assert np.diff(sensor.stamp_ns).min() > 0
    assert np.diff(sensor.stamp_ns).std() > 0


def test_a_joint_that_is_needed_must_move_or_be_given() -> None:
    """A motion that lacks a joint below the sensor is refused by name."""
    model = read_urdf(ARM_URDF)
    with pytest.raises(ValueError, match="elbow"):
        simulate_recording(
            model,
            {"arm_ft": SimulatedSensor(matrix=np.eye(6), offset=np.zeros(6), noise_counts=0.0)},
            support="base",
            gravity_direction=[0, 0, -1],
            ranges=dict.fromkeys(("shoulder_yaw", "shoulder_pitch", "shoulder_roll", "wrist"), (-1.0, 1.0)),
            duration_s=1.0,
            rate_hz=50.0,
            slowest_hz=0.1,
            seed=1,
        )
