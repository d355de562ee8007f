# SPDX-License-Identifier: BSD-3-Clause
"""A simulated IMU reads its link, with the bias and noise that it has."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.errors import RobotError
from forcetorque.recording.alignment import seconds_since
from forcetorque.simulation.trace import SimulatedImu, trace_movement
from tests.simulation.motions.stances import on_both_feet


def test_it_reads_what_its_link_goes_through() -> None:
    """Without errors the stream is the link's motion at its stamps; bias and noise are as large as stated."""
    movement = on_both_feet("biped", "sway")
    trace = trace_movement(movement, [], rate_hz=100.0, rng=np.random.default_rng(1), imu_link="imu")
    perfect = trace.recorded({}, rng=np.random.default_rng(2), imu=SimulatedImu(link="imu")).stream("imu")
    motion = movement.link_motion(seconds_since(perfect.stamp_ns, trace.start_ns), "imu")
    np.testing.assert_array_equal(perfect.signal("proper_acceleration").values, motion.proper_acceleration)
    np.testing.assert_array_equal(perfect.signal("angular_velocity").values, motion.angular_velocity)
    assert {signal.frame for signal in perfect.signals.values()} == {"imu"}
    imu = SimulatedImu(
        link="imu",
        accelerometer_bias=np.array([0.1, -0.2, 0.3]),
        gyroscope_bias=np.array([0.01, 0.0, -0.02]),
        accelerometer_noise=0.05,
        gyroscope_noise=0.005,
    )
    real = trace.recorded({}, rng=np.random.default_rng(2), imu=imu).stream("imu")
    for quantity, bias, noise in (
        ("proper_acceleration", imu.accelerometer_bias, 0.05),
        ("angular_velocity", imu.gyroscope_bias, 0.005),
    ):
        error = real.signal(quantity).values - perfect.signal(quantity).values
        np.testing.assert_allclose(error.mean(axis=0), bias, rtol=0, atol=4 * noise / np.sqrt(len(error)))
        np.testing.assert_allclose(error.std(axis=0), noise, rtol=0.1)  # of 1000 samples, 2 % for one sd


def test_an_imu_changes_no_other_stream() -> None:
    """Stamps of joints and sensors are those of the same seed without it."""
    movement = on_both_feet("biped", "sway")
    without, with_imu = (
        trace_movement(movement, ["l_leg_ft"], rate_hz=50.0, rng=np.random.default_rng(3), imu_link=link)
        for link in (None, "torso")
    )
    np.testing.assert_array_equal(without.joints.stamp_ns, with_imu.joints.stamp_ns)
    np.testing.assert_array_equal(without.loads["l_leg_ft"], with_imu.loads["l_leg_ft"])
    with pytest.raises(RobotError, match="expected a trace with an IMU at 'imu', it has one at 'torso'"):
        with_imu.recorded({}, rng=np.random.default_rng(1), imu=SimulatedImu(link="imu"))
    with pytest.raises(RobotError, match="expected a trace with an IMU at 'imu', it has no IMU"):
        without.recorded({}, rng=np.random.default_rng(1), imu=SimulatedImu(link="imu"))


def test_negative_noise_is_refused() -> None:
    """It names link and quantity."""
    with pytest.raises(RobotError, match="IMU at 'imu': gyroscope_noise: expected at least 0, got -1"):
        SimulatedImu(link="imu", gyroscope_noise=-1.0)
