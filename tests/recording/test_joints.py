# SPDX-License-Identifier: BSD-3-Clause
"""Joints are found in whatever stream holds them and moved to the instants that were asked for."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from forcetorque.base.errors import RecordingError
from forcetorque.recording.alignment import seconds_since
from forcetorque.recording.recording import Recording
from forcetorque.recording.smoothing import DERIVATIVE_WINDOW, SavitzkyGolay
from forcetorque.recording.stream import ROW_CLOCK, Stream
from forcetorque.robot.motion import joint_motion_at
from tests.recording.recordings import EPOCH_NS, even_stamps, jittered_stamps, recording, refused, signal, stream

WINDOW = SavitzkyGolay(window_s=0.2, order=2)

POSITION = 1e-12
"""Rounding of positions of order 10 between two samples."""
VELOCITY = 1e-10
"""The same, divided by a window of 0.2 s with 21 samples."""
ACCELERATION = 1e-8
"""The same, divided by the square of the window."""

SLOPES = {"hip": 2.0, "knee": -3.0, "elbow": 0.5}
"""Constant velocities: straight lines suffer nothing from alignment and filter."""


def _moving(name: str, stamps: Any, joints: tuple[str, ...]) -> Stream:
    seconds = seconds_since(stamps, EPOCH_NS)
    values = np.column_stack([1.0 + SLOPES[joint] * seconds for joint in joints])
    return stream(stamps, signal("position", values, joints), name=name)


def _two_streams() -> Recording:
    """Legs and arms, at different rates and out of step."""
    legs = _moving("legs", jittered_stamps(500, rate_hz=100.0, seed=1), ("hip", "knee"))
    arms = _moving("arms", jittered_stamps(250, rate_hz=50.0, seed=2), ("elbow",))
    return recording(legs, arms)


def test_joints_of_several_streams_meet_at_the_instants() -> None:
    """Every joint is interpolated on the stamps of its own stream, in the order in which joints were asked for."""
    at = even_stamps(300, rate_hz=80.0) + 500_000_000
    motion = joint_motion_at(_two_streams(), ("elbow", "hip", "knee"), at, window=WINDOW)
    assert motion.names == ("elbow", "hip", "knee")
    slopes = np.array([SLOPES[joint] for joint in motion.names])
    expected = 1.0 + seconds_since(at, EPOCH_NS)[:, None] * slopes
    np.testing.assert_allclose(motion.position, expected, rtol=0.0, atol=POSITION)
    np.testing.assert_allclose(motion.velocity, np.broadcast_to(slopes, (300, 3)), rtol=0.0, atol=VELOCITY)
    np.testing.assert_allclose(motion.acceleration, 0.0, atol=ACCELERATION)
    swapped = joint_motion_at(_two_streams(), ("hip", "elbow", "knee"), at, window=WINDOW)
    assert np.abs(swapped.position - expected).max() > 1.0


def test_samples_without_times_are_poses_at_rest() -> None:
    """Row k is stamped k seconds, which is no motion; the same stamps of a clock are one."""
    stamps = np.arange(12, dtype=np.int64) * 1_000_000_000
    values = signal("position", np.random.default_rng(3).normal(size=(12, 2)), ("hip", "knee"))
    poses = replace(stream(stamps, values, name="poses"), clock=ROW_CLOCK)
    motion = joint_motion_at(recording(poses), ("hip", "knee"), stamps, window=DERIVATIVE_WINDOW)
    np.testing.assert_array_equal(motion.position, values.values)
    assert not motion.velocity.any()
    assert not motion.acceleration.any()
    with refused(RecordingError, "cannot carry order 3"):
        joint_motion_at(recording(replace(poses, clock="log")), ("hip",), stamps, window=DERIVATIVE_WINDOW)


def test_a_parabola_has_its_acceleration() -> None:
    """On even stamps a filter of order two is exact for a constant acceleration, also at the samples between."""
    stamps = even_stamps(101)
    fallen = -4.9 * seconds_since(stamps, EPOCH_NS) ** 2
    held = recording(stream(stamps, signal("position", fallen[:, None], ("fall",))))
    at = stamps[:-1] + 5_000_000
    motion = joint_motion_at(held, ("fall",), at, window=WINDOW)
    np.testing.assert_allclose(motion.acceleration, -9.8, rtol=0.0, atol=ACCELERATION)
    np.testing.assert_allclose(motion.velocity[:, 0], -9.8 * seconds_since(at, EPOCH_NS), rtol=0.0, atol=VELOCITY)
    # between two samples the straight line is off by the acceleration times period squared over eight, no more
    error = motion.position[:, 0] + 4.9 * seconds_since(at, EPOCH_NS) ** 2
    np.testing.assert_allclose(error, -9.8 * 0.01**2 / 8, rtol=0.0, atol=POSITION)


def _with_logged(**logged: Any) -> Recording:
    """Two samples of joint a at rest, and what the log says of its derivatives, each in a stream of its own."""
    streams = [stream([0, 100], signal("position", [[1.0], [1.0]]), name="position")]
    streams += [stream([0, 100], signal(key, values), name=key) for key, values in logged.items()]
    return recording(*streams)


def test_logged_derivatives_are_taken_as_they_are() -> None:
    """By hand: a log that claims a velocity at rest is believed, and no window is needed."""
    log = _with_logged(velocity=[[5.0], [7.0]], acceleration=[[-1.0], [-2.0]])
    motion = joint_motion_at(log, ("a",), np.array([50]), window=WINDOW, logged_derivatives=True)
    assert (motion.position[0, 0], motion.velocity[0, 0], motion.acceleration[0, 0]) == (1.0, 6.0, -1.5)


def test_missing_derivatives_are_refused() -> None:
    """Where the log has no accelerations the error says so, and what else there is."""
    log = _with_logged(velocity=[[5.0], [7.0]])
    with refused(RecordingError, "no stream holds the acceleration of joint 'a'; take derivatives from the positions"):
        joint_motion_at(log, ("a",), np.array([50]), window=WINDOW, logged_derivatives=True)


def test_a_missing_joint_is_named_with_the_likeliest_one() -> None:
    """A misspelt joint brings the one that was meant and all others."""
    known = "known: elbow, hip, knee; if it stood still all along, specify where in fixed of"
    with refused(RecordingError, f"the position of joint 'knees'; did you mean \"knee\".*{known}"):
        joint_motion_at(_two_streams(), ("hip", "knees"), even_stamps(2), window=WINDOW)


def test_a_joint_in_two_streams_is_refused() -> None:
    """Nobody can know which of the two is right."""
    legs = _moving("legs", even_stamps(50), ("hip", "knee"))
    again = _moving("again", even_stamps(50), ("knee",))
    with refused(RecordingError, "joint 'knee' is in the streams 'legs' and 'again'; keep one"):
        joint_motion_at(recording(legs, again), ("hip",), even_stamps(2), window=WINDOW)


def test_gaps_are_not_bridged() -> None:
    """Inside a pause of one stream its joints are NaN, and so are positions as much as derivatives; others are not."""
    stamps = even_stamps(500)
    kept = (np.arange(500) < 200) | (np.arange(500) >= 300)
    log = recording(_moving("legs", stamps[kept], ("hip",)), _moving("arms", stamps, ("elbow",)))
    at = stamps + 1_000_000
    motion = joint_motion_at(log, ("hip", "elbow"), at, window=WINDOW)
    inside = np.flatnonzero((at > stamps[199]) & (at < stamps[300]))
    assert len(inside) == 101
    missing = sorted({*inside.tolist(), 499})  # the last instant lies behind the last sample
    for field in (motion.position, motion.velocity, motion.acceleration):
        assert np.flatnonzero(np.isnan(field[:, 0])).tolist() == missing
        assert np.flatnonzero(np.isnan(field[:, 1])).tolist() == [499]


def test_no_joints_have_no_motion() -> None:
    """A sensor that depends on no joint needs none in the log."""
    motion = joint_motion_at(
        recording(stream([1, 2], signal("raw", np.zeros((2, 6))))), (), even_stamps(7), window=WINDOW
    )
    assert motion.position.shape == (7, 0)
