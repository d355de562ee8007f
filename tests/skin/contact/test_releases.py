# SPDX-License-Identifier: BSD-3-Clause
"""A contact that is let go: on either side of every limit, by forces over time."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from forcetorque.skin.contact.contact_tracking import ReleaseDetector, ReleaseRow

STEP_S = 0.1


def _releases(
    force: Callable[[float], float], *, limit_N: float = 1.0, end_s: float = 20.0, step_s: float = STEP_S
) -> list[ReleaseRow]:
    """What is found of one contact on two of five taxels, frame by frame."""
    detector, found = ReleaseDetector(), []
    for seconds in np.arange(0.0, end_s, step_s):
        contacts: Any = SimpleNamespace(
            contact=np.array([0, 0, -1, -1, -1]),
            wrench=np.array([[0.0, 0.6 * force(seconds), -0.8 * force(seconds), 0.0, 0.0, 0.0]]),
            drift_limit_N=np.array([limit_N]),
        )
        contacts = _Contacts(**vars(contacts))
        found += [release for release, _ in detector.released(float(seconds), contacts)]
    return found


class _Contacts(SimpleNamespace):
    """As many contacts as wrenches."""

    def __len__(self) -> int:
        return len(self.wrench)


def _step(left: float, within_s: float = 0.5) -> Callable[[float], float]:
    """10 N for 8 s, then an even fall to what is left."""
    return lambda seconds: float(np.interp(seconds, [8.0, 8.0 + within_s], [10.0, left]))


@pytest.mark.parametrize(("left", "is_release"), [(4.9, True), (5.1, False), (0.0, True)])
def test_a_release_is_a_loss_of_half_of_the_force(left: float, is_release: bool) -> None:
    """Its row has the force before and what is left; of 0 N too."""
    found = _releases(_step(left))
    assert bool(found) == is_release
    if is_release:
        assert found[0].force_N == pytest.approx(10.0)
        assert found[0].left_N == pytest.approx(left)
        # the fall has ended and a second of it is settled, but for the tenth that it may still change
        assert 9.0 < found[0].time_s < 9.7
        assert found[0].held_s == pytest.approx(found[0].time_s)


@pytest.mark.parametrize(("within_s", "is_release"), [(2.0, True), (12.0, False)])
def test_a_release_takes_less_than_four_seconds(within_s: float, is_release: bool) -> None:
    """What falls more slowly loses less than half while it is compared."""
    assert bool(_releases(_step(4.0, within_s), end_s=25.0)) == is_release


@pytest.mark.parametrize(("swing", "is_release"), [(0.9, True), (1.1, False)])
def test_a_release_has_settled_to_a_tenth_of_the_force(swing: float, is_release: bool) -> None:
    """What still goes up and down by more, from frame to frame, has not."""

    def force(seconds: float) -> float:
        return 10.0 if seconds < 8.0 else 2.0 + 0.5 * swing * (-1.0) ** round(seconds / STEP_S)

    assert bool(_releases(force, end_s=14.0)) == is_release


@pytest.mark.parametrize("step_s", [1.5, 2.0])
def test_of_frames_longer_than_a_second_the_last_two_have_settled(step_s: float) -> None:
    """The first one after the fall may be on its way; what is left is the mean of both."""
    forces = [10.0] * 5 + [2.0, 1.2] + [1.2] * 3
    found = _releases(lambda seconds: forces[round(seconds / step_s)], end_s=9.5 * step_s, step_s=step_s)
    assert found[0].time_s == pytest.approx(6.0 * step_s)
    assert (found[0].force_N, found[0].left_N) == pytest.approx((10.0, 1.6))


@pytest.mark.parametrize(("left", "limit_N", "state"), [(0.9, 1.0, "offered"), (1.1, 1.0, "no"), (0.0, 1.0, "no")])
def test_a_rest_is_offered_where_heat_explains_what_is_left(left: float, limit_N: float, state: str) -> None:
    """By the limit of its taxels."""
    (release,) = _releases(_step(left), limit_N=limit_N)[:1]
    assert (release.re_tare, release.drift_limit_N) == (state, limit_N)
