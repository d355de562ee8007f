# SPDX-License-Identifier: BSD-3-Clause
"""The weight goes from foot to foot without a jump."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from forcetorque.errors import ShapeError
from forcetorque.robot import expected_wrenches
from forcetorque.simulation import Movement, contact_switching_movements
from tests.simulation.stands import POLES, ROBOTS, on_foot, require_exact_derivatives, times


def _movements(name: str, steps: int = 2) -> tuple[Movement, ...]:
    return contact_switching_movements(
        on_foot(name), "r_sole", rng=np.random.default_rng(1), steps=steps, postures=2, candidates=10
    )


@pytest.mark.parametrize("name", ROBOTS)
def test_nothing_jumps_at_the_switches(name: str) -> None:
    """Joints, readings and the place of the trunk in the world go on where the movement before has left them."""
    movements = _movements(name)
    assert [movement.support for movement in movements] == ["l_sole", "l_sole", "r_sole", "r_sole", "r_sole"]
    assert [len(movement.external) for movement in movements] == [1, 0, 1, 0, 1]
    switches = 0
    for before, after in pairwise(movements):
        end, start = before.joints([before.duration_s]), after.joints([0.0])
        for field in ("position", "velocity", "acceleration"):
            np.testing.assert_allclose(getattr(end, field), getattr(start, field), rtol=0, atol=1e-12)
        read, go_on = before.readings([before.duration_s]), after.readings([0.0])
        np.testing.assert_allclose(read.values, go_on.values, rtol=0, atol=1e-9)  # rounding of 300 N over 40 bodies
        places = (m.base_pose([t], POLES[name]) for m, t in ((before, before.duration_s), (after, 0.0)))
        np.testing.assert_allclose(*places, rtol=0, atol=1e-12)
        switches += 1
    assert switches == 4
    # negative control: without its touch the second shift would begin with a jump
    shift = movements[2]
    alone = expected_wrenches(shift.tree, shift.joints([0.0]), shift.root([0.0]), ["l_foot_ft"])["l_foot_ft"]
    assert np.abs(alone - movements[1].readings([movements[1].duration_s]).of_name("l_foot_ft")).max() > 200.0


def test_both_feet_stand_still_while_the_weight_shifts() -> None:
    """In every double support both soles keep their place, and the touch changes smoothly from share to share."""
    movements = _movements("biped")
    weight = 9.80665 * sum(link.mass for link in movements[0].model.links.values())
    shares = []
    for movement in movements[::2]:
        at = times(movement)
        for foot in ("l_sole", "r_sole"):
            assert np.ptp(movement.base_pose(at, foot), axis=0).max() == 0.0
        (touch,) = movement.external
        force = touch.wrench(at)[:, 2] / weight  # soles are level
        assert (np.diff(force) <= 0).all() or (np.diff(force) >= 0).all()
        assert np.abs(np.diff(force, 2)).max() < 1e-3  # 5.8 (T / 199)^2 / T^2
        shares.append((force[0], force[-1]))
    np.testing.assert_allclose(shares, [(0.5, 0), (1, 0), (0, 0.5)], atol=1e-12)


def test_a_foot_reads_its_share_by_hand() -> None:
    """Above a foot that bears half the weight a sensor reads that half, less the foot's own weight."""
    start = _movements("biped", steps=1)[0]
    model = start.model
    weight = 9.80665 * sum(link.mass for link in model.links.values())
    read = start.readings([0.0])
    own = 9.80665 * model.links["r_foot"].mass
    # the sensor's axes are the sole's, 0.035 m above it; at rest the legs are straight
    np.testing.assert_allclose(read.of_name("r_foot_ft")[0, :3], [0, 0, 0.5 * weight - own], rtol=0, atol=1e-9)
    np.testing.assert_allclose(read.of_name("l_foot_ft")[0, :3], [0, 0, 0.5 * weight - own], rtol=0, atol=1e-9)


def test_one_foot_stands_while_the_other_moves() -> None:
    """In single support the free foot leaves its place by far and comes back to it."""
    movements = _movements("biped")
    for movement, free in ((movements[1], "r_sole"), (movements[3], "l_sole")):
        place = movement.base_pose(times(movement), free)[:, :3, 3]
        np.testing.assert_allclose(place[0], place[-1], rtol=0, atol=1e-12)
        assert np.linalg.norm(place - place[0], axis=1).max() > 0.1
        require_exact_derivatives(movement.joints, times(movement))
    # both feet stand side by side on one level floor
    np.testing.assert_allclose(movements[3].world_H_support[:3, 3], [0.0, -0.15, 0.0], atol=1e-12)


def test_what_makes_no_sense_is_refused() -> None:
    """No step, and shifts that take no time."""
    for changes in ({"steps": 0}, {"shift_s": 0.0}):
        with pytest.raises(ShapeError, match="at least one step and a positive shift_s"):
            contact_switching_movements(on_foot("biped"), "r_sole", rng=np.random.default_rng(2), **changes)
