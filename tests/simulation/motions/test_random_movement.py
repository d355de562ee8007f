# SPDX-License-Identifier: BSD-3-Clause
"""Random motions over the ranges of a robot's joints."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from forcetorque.base.errors import RobotError, ShapeError
from forcetorque.simulation.motions.joint_motions import random_movement
from tests.fuzzing import examples
from tests.simulation.motions.stands import arm, on_pole, require_inside_limits, times


@settings(max_examples=examples(15), deadline=None)
@given(seed=st.integers(0, 2**32 - 1), slowest_hz=st.floats(1e-3, 100.0))
def test_no_joint_is_too_fast_or_too_far(seed: int, slowest_hz: float) -> None:
    """Frequencies are lowered until every joint keeps its speed."""
    stand = arm()
    movement = random_movement(stand, rng=np.random.default_rng(seed), duration_s=30.0, slowest_hz=slowest_hz)
    require_inside_limits(stand, movement.joints(times(movement, 400)))


def test_slow_frequencies_are_left_alone() -> None:
    """The motion is the plain sum of sines where that is slow enough, and slower than that where not."""
    stand = arm()
    slow, slower = (
        random_movement(stand, rng=np.random.default_rng(1), duration_s=1.0, slowest_hz=hz).trajectory.omega
        for hz in (1e-3, 5e-4)
    )
    np.testing.assert_allclose(slow, 2.0 * slower, rtol=1e-12)
    fast = random_movement(stand, rng=np.random.default_rng(1), duration_s=1.0, slowest_hz=1.0).trajectory.omega
    assert (fast < 1e3 * 0.5 * slow).all()


def test_joints_that_are_not_named_rest() -> None:
    """Only what is named moves."""
    stand = on_pole("biped")
    movement = random_movement(stand, rng=np.random.default_rng(2), duration_s=10.0, joints=("l_knee", "waist_yaw"))
    moved = np.ptp(movement.joints(times(movement)).position, axis=0) > 0
    assert {name for name, moves in zip(stand.joints, moved, strict=True) if moves} == {"l_knee", "waist_yaw"}
    with pytest.raises(RobotError, match="no free joint 'l_knie'; did you mean"):
        random_movement(stand, rng=np.random.default_rng(2), duration_s=1.0, joints=("l_knie",))
    with pytest.raises(ShapeError, match="slowest_hz: expected a positive frequency"):
        random_movement(stand, rng=np.random.default_rng(2), duration_s=1.0, slowest_hz=0.0)
