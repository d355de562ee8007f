# SPDX-License-Identifier: BSD-3-Clause
"""A known weight shows a cover that reads too much, one that loses load, and pads that lag."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import t

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.errors import SkinError
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.skin.answers import _weight
from forcetorque.skin.wrench.known_weight import Agreement, KnownWeight, agreement_of, known_weight

MASS_KG, FRAME_S, REST_S, HOLD_S = 0.8, 0.2, 2.0, 8.0
SCATTER = 0.04
"""Standard deviation of what a placement reads over the weight: that of contacts of finite elements is 3 to 4 %."""


def _frames(shares: FloatArray, lag_s: float = 0.0) -> tuple[FloatArray, FloatArray, BoolArray]:
    """Times, forces and contacts of placements that each read a share of the weight, by pads of a first-order lag."""
    hold, rest = round(HOLD_S / FRAME_S), round(REST_S / FRAME_S)
    rise = np.ones(hold) if lag_s == 0.0 else 1.0 - np.exp(-FRAME_S * (np.arange(hold) + 1.0) / lag_s)
    one = [np.concatenate([np.zeros(rest), share * rise]) for share in shares]
    force = MASS_KG * STANDARD_GRAVITY * np.concatenate([*one, np.zeros(rest)])
    return FRAME_S * np.arange(len(force)), force, force > 0.0


def _of(shares: FloatArray, lag_s: float = 0.0) -> KnownWeight:
    return known_weight(MASS_KG, *_frames(shares, lag_s))


@pytest.mark.parametrize(
    ("share", "agreement", "least"), [(1.31, "too much", 1.0), (0.7, "too little", 1.0), (1.0, "agrees", 0.85)]
)
def test_what_is_off_is_named(share: float, agreement: Agreement, least: float) -> None:
    """Of 200 patches with five placements, whose scatter is that of contacts; seeds are fixed."""
    rng = np.random.default_rng(7)
    results = [_of(share + SCATTER * rng.normal(size=5)).agreement for _ in range(200)]
    assert np.mean([result == agreement for result in results]) >= least
    # a patch that agrees is never accused
    if agreement == "agrees":
        assert set(results) <= {"agrees", "inconclusive"}


def test_few_placements_are_inconclusive() -> None:
    """Two have no interval, whatever they read."""
    result = _of(np.array([1.3, 1.32]))
    assert (result.agreement, result.share_half_width_95) == ("inconclusive", None)
    assert result.share == pytest.approx(1.31)
    assert [row.share for row in result.placements] == pytest.approx([1.3, 1.32])


def test_pads_that_lag_settle_late() -> None:
    """A lag of a second is within 5 % after three; without one at once. The force at the end is hardly less."""
    late, prompt = (_of(np.ones(3), lag_s) for lag_s in (1.0, 0.0))
    assert [row.settled_s for row in late.placements] == pytest.approx([3.0] * 3, abs=2 * FRAME_S)
    assert [row.settled_s for row in prompt.placements] == [0.0] * 3
    assert late.share == pytest.approx(1.0, abs=0.02)


def test_frames_without_a_contact_part_no_placement() -> None:
    """One in seven is lost, and forces of the others are the same as with all; two seconds part placements."""
    whole = _of(np.array([1.0, 1.02, 0.98]))
    seconds, force, touched = _frames(np.array([1.0, 1.02, 0.98]))
    lost = touched & (np.arange(len(touched)) % 7 == 0)
    result = known_weight(MASS_KG, seconds, np.where(lost, 0.0, force), touched & ~lost)
    assert [row.share for row in result.placements] == pytest.approx([row.share for row in whole.placements])
    assert [row.settled_s for row in result.placements] == [0.0] * 3
    assert (result.agreement, result.left_out) == (whole.agreement, ())


def test_a_light_touch_is_no_placement() -> None:
    """A hand with a fifth of the weight is left out and named; a patch that reads 60 % of it is not."""
    result = _of(np.array([1.0, 0.2, 1.02, 0.98, 0.99]))
    assert [row.share for row in result.left_out] == pytest.approx([0.2])
    assert (len(result.placements), result.agreement) == (4, "agrees")
    assert "left out: 12.0-19.8 s, less than half of the median" in _weight(result)
    assert _of(np.array([0.6, 1.0, 0.61])).left_out == ()


@pytest.mark.parametrize(
    ("middle", "spread", "agreement"),
    [
        (1.05, 0.049, "agrees"),
        (1.05, 0.051, "inconclusive"),
        (0.95, 0.049, "agrees"),
        (0.95, 0.051, "inconclusive"),
        (1.151, 0.05, "too much"),
        (1.149, 0.05, "inconclusive"),
        (0.849, 0.05, "too little"),
        (0.851, 0.05, "inconclusive"),
    ],
)
def test_a_weight_agrees_within_a_tenth_by_its_interval(middle: float, spread: float, agreement: Agreement) -> None:
    """Of four placements whose interval by Student's t has a given half-width, on either side of each limit."""
    quantile = float(t.ppf(0.975, 3))
    shares = np.array([-1.0, -1.0, 1.0, 1.0])
    shares = middle + spread / quantile * shares / (shares.std(ddof=1) / 2.0)
    mean, half, said = agreement_of(shares)
    assert (mean, half) == (pytest.approx(middle), pytest.approx(spread, rel=1e-9))
    assert said == agreement


def test_times_of_a_placement_are_those_of_its_frames() -> None:
    """From first to last contact; the force is the median of the middle half, whatever the ends read."""
    seconds, force, touched = _frames(np.array([1.0, 1.0]))
    start, end = (int(k) for k in np.flatnonzero(np.diff(touched.astype(int)))[:2])
    quarter = (end - start) // 4
    force = force.copy()
    force[start + 1 : start + 1 + quarter] *= 3.0
    force[end + 1 - quarter : end + 1] *= 0.3
    first, second = known_weight(MASS_KG, seconds, force, touched).placements
    assert (first.from_s, first.to_s) == (seconds[start + 1], seconds[end])
    assert (first.share, second.share) == (pytest.approx(1.0), pytest.approx(1.0))
    assert first.force_N == pytest.approx(MASS_KG * STANDARD_GRAVITY)
    assert (first.settled_s, second.settled_s) == (pytest.approx(quarter * FRAME_S), 0.0)


def test_placements_are_parted_by_a_second() -> None:
    """Nine tenths of it are a contact that was lost, eleven are not."""
    for gap_s, count in ((0.9, 1), (1.1, 2)):
        touched = np.ones(200, dtype=bool)
        touched[100 : 100 + round(gap_s / 0.05) - 1] = False
        found = known_weight(MASS_KG, 0.05 * np.arange(200), np.full(200, 10.0), touched)
        assert len(found.placements) == count


def test_what_is_no_weight_is_refused() -> None:
    """A mass that is none, and one that was never left on the patch."""
    frames = _frames(np.ones(3))
    with pytest.raises(SkinError, match="expected a mass above 0 kg, got -1"):
        known_weight(-1.0, *frames)
    touched = frames[2] & (np.arange(len(frames[2])) % 12 < 5)
    with pytest.raises(SkinError, match=r"on the patch for 8 frames or more at a time, got \d+ with a contact"):
        known_weight(MASS_KG, frames[0], frames[1], touched)
