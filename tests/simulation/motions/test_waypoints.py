# SPDX-License-Identifier: BSD-3-Clause
"""Moves between postures: exact, gentle, and within their speeds."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from forcetorque.base.errors import ShapeError
from forcetorque.simulation.motions.trajectories import Waypoints
from tests.fuzzing import examples
from tests.simulation.motions.stands import require_exact_derivatives

NAMES = ("a", "b")
POSTURES = np.array([[0.0, 0.0], [1.0, -0.2], [1.0, -0.2], [-0.5, 0.3]])


def test_derivatives_are_exact() -> None:
    """Velocity and acceleration are the derivatives, also where moves meet and where nothing moves."""
    moves = Waypoints.at_speed(NAMES, POSTURES, [0.5, 0.3], hold_s=0.2)
    require_exact_derivatives(moves, np.linspace(-0.5, moves.duration_s + 0.5, 997))


def test_a_move_by_hand() -> None:
    """1 rad at up to 0.5 rad/s takes 1.875 / 0.5 s; half-way it is fastest; a rest of 1 s comes before and after."""
    moves = Waypoints.at_speed(("a",), [[0.0], [1.0]], [0.5], hold_s=1.0)
    assert moves.duration_s == pytest.approx(2.0 + 3.75)
    motion = moves(np.array([-1.0, 0.5, 1.0, 1.0 + 3.75 / 2, 4.75, 5.0, 99.0]))
    np.testing.assert_allclose(motion.position[:, 0], [0, 0, 0, 0.5, 1, 1, 1], rtol=0, atol=1e-15)
    np.testing.assert_allclose(motion.velocity[:, 0], [0, 0, 0, 0.5, 0, 0, 0], rtol=0, atol=1e-15)
    # largest acceleration of a minimum-jerk move: 10 / sqrt(3) d / T^2
    dense = moves(np.linspace(1.0, 4.75, 10001)).acceleration
    assert np.abs(dense).max() == pytest.approx(10 / np.sqrt(3) / 3.75**2, rel=1e-6)


@settings(max_examples=examples(30), deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    count=st.integers(1, 6),
    speed=st.floats(1e-3, 1e3),
    hold=st.sampled_from([0.0, 0.3]),
)
def test_every_move_keeps_its_speed_and_visits_its_postures(seed: int, count: int, speed: float, hold: float) -> None:
    """No joint is too fast or leaves the hull of the postures, one of each move is as fast as it may be."""
    rng = np.random.default_rng(seed)
    postures, speeds = rng.uniform(-2, 2, (count, 2)), speed * rng.uniform(0.5, 1.0, 2)
    moves = Waypoints.at_speed(NAMES, postures, speeds, hold_s=hold)
    motion = moves(np.linspace(0.0, moves.duration_s, 300))
    assert (np.abs(motion.velocity) <= speeds * (1 + 1e-9)).all()
    assert (motion.position >= postures.min(axis=0) - 1e-12).all()
    assert (motion.position <= postures.max(axis=0) + 1e-12).all()
    at_postures = moves(np.append(moves.departures_s, moves.duration_s))
    np.testing.assert_allclose(at_postures.position, postures, rtol=0, atol=1e-12)
    np.testing.assert_allclose(at_postures.velocity, 0.0, rtol=0, atol=1e-9 * speed)
    half_way = moves(moves.departures_s + 0.5 * moves.durations_s).velocity
    np.testing.assert_allclose((np.abs(half_way) / speeds).max(axis=1, initial=0.0), 1.0, rtol=1e-6)


def test_what_makes_no_sense_is_refused() -> None:
    """A joint that cannot move, a negative rest and no posture at all are named."""
    with pytest.raises(ShapeError, match="expected positive ones in rad/s or m/s, got 'b' 0"):
        Waypoints.at_speed(NAMES, POSTURES, [1.0, 0.0])
    with pytest.raises(ShapeError, match="hold_s: expected a time of at least 0 s, got -1"):
        Waypoints.at_speed(NAMES, POSTURES, [1.0, 1.0], hold_s=-1.0)
    with pytest.raises(ShapeError, match="postures: expected at least one"):
        Waypoints.at_speed(NAMES, np.empty((0, 2)), [1.0, 1.0])
