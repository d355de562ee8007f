# SPDX-License-Identifier: BSD-3-Clause
"""Offsets and gains by session of simulated sensors, at stated rates of both errors."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import lfilter
from scipy.spatial.transform import Rotation

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError
from forcetorque.base.noise.slow_noise import Timeline
from forcetorque.sensor.sessions.session_change_tests import Change, SessionMeans, fit_sessions, holm
from tests.sensor.sessions.drawn_figures import draw_session

UNIT = np.repeat([1.0, 0.05], 3)
"""Deviations of noise and drifts of moments beside those of forces."""
WHITE, SLOW, FORGETS_S = 0.1, 0.1, 10.0
"""Deviations of the noise, in `UNIT`, and how long its slow part lasts; s."""


def sessions(
    rng: np.random.Generator, offsets: FloatArray, gains: FloatArray, *, seconds: int = 120, still: bool = False
) -> SessionMeans:
    """Means of 1 s of a tool of 3 kg that turns slowly in every session; offsets in `UNIT`, shapes (s, 6)."""
    count = len(offsets)
    time = np.arange(seconds, dtype=np.float64)
    measured, expected = [], []
    for k in range(count):
        swing = rng.uniform(0.4, 1.2, 3) * np.sin(np.outer(time, rng.uniform(0.02, 0.2, 3)) + rng.uniform(0.0, 6.0, 3))
        turned = Rotation.from_rotvec(np.zeros((seconds, 3)) if still else swing)
        force = turned.inv().apply([0.0, 0.0, -29.4])
        load = np.hstack([force, np.cross([0.02, -0.01, 0.08], force)])
        keep = np.exp(-1.0 / FORGETS_S)
        wander = lfilter([np.sqrt(1.0 - keep**2)], [1.0, -keep], rng.normal(size=(seconds + 100, 6)), axis=0)[100:]
        noise = UNIT * (WHITE * rng.normal(size=(seconds, 6)) + SLOW * wander)
        matrix = np.diag(gains[k]) + 0.02 * UNIT[:, None] / UNIT * CROSS
        expected.append(load)
        measured.append(load @ matrix.T + 5.0 * UNIT + offsets[k] * UNIT + noise)
    line = Timeline.of(np.tile(time, count), recording=np.repeat(np.arange(count), seconds))
    number = np.repeat(np.arange(count), seconds)
    return SessionMeans(line=line, session=number, measured=np.concatenate(measured), expected=np.concatenate(expected))


CROSS = np.random.default_rng(5).uniform(-1.0, 1.0, (6, 6)) * (1.0 - np.eye(6))
"""Cross-talk that no reading was corrected for, in parts of 2 %."""


def changes_beyond_noise(means: SessionMeans) -> set[tuple[int, int, bool]]:
    """Component, earlier session and kind of every change that is reported between neighbours."""
    changes = {
        (k, first, of_gain): change.p_value
        for k in range(6)
        for first in range(means.sessions - 1)
        for of_gain in (False, True)
        if (change := fit_sessions(means, k).change(first, first + 1, of_gain=of_gain)) is not None
    }
    return {key for key, chosen in zip(changes, holm(list(changes.values())), strict=True) if chosen}


def test_a_changed_offset_and_gain_are_found_and_nothing_else() -> None:
    """1 N of fz from the first session to the second, and 5 % of the gain of fy to the third."""
    offsets, gains = np.zeros((3, 6)), np.ones((3, 6))
    offsets[1:, 2], gains[2, 1] = 1.0, 1.05
    assert changes_beyond_noise(sessions(np.random.default_rng(2), offsets, gains)) == {(2, 0, False), (1, 1, True)}


@pytest.mark.parametrize(("step_N", "p_value"), [(1.0, 0.0), (0.0, 1.0)])
def test_without_noise_a_change_is_certain(step_N: float, p_value: float) -> None:
    """And none is none."""
    change = Change(size=step_N, standard_error=0.0, degrees_of_freedom=100.0)
    assert change.p_value == p_value


def test_a_load_that_stays_determines_no_gain() -> None:
    """Gains are 1, of no session; the change of the offset is found."""
    offsets = np.zeros((2, 6))
    offsets[1, 0] = 1.0
    means = sessions(np.random.default_rng(3), offsets, np.ones((2, 6)), still=True)
    fit = fit_sessions(means, 0)
    assert (fit.gain.tolist(), fit.gain_session.tolist()) == ([1.0, 1.0], [-1, -1])
    assert fit.change(0, 1, of_gain=True) is None
    change = fit.change(0, 1, of_gain=False)
    assert change is not None
    assert abs(change.size - 1.0) < change.half_width < 0.3


def test_too_few_means_are_refused() -> None:
    """With the number that is needed."""
    with pytest.raises(FitError, match="expected more than"):
        fit_sessions(sessions(np.random.default_rng(4), np.zeros((2, 6)), np.ones((2, 6)), seconds=4), 0)


def test_holm_chooses_stepwise() -> None:
    """The second smallest is held against half the others' rate; nothing behind the first that fails is chosen."""
    assert holm([0.012, 0.5, 0.016, 0.024], 0.05).tolist() == [True, False, True, True]
    assert holm([0.013, 0.5, 0.016, 0.024], 0.05).tolist() == [False, False, False, False]


@pytest.mark.long
def test_rates_of_both_errors() -> None:
    """200 sensors: intervals hold what is true, few false changes, and changes of stated size are found."""
    runs = 200
    held: list[bool] = []
    false, seen = 0, np.zeros(2)
    for seed in range(runs):
        rng = np.random.default_rng(1000 + seed)
        means = sessions(rng, np.zeros((2, 6)), np.ones((2, 6)))
        false += bool(changes_beyond_noise(means))
        for k in range(6):
            for of_gain in (False, True):
                change = fit_sessions(means, k).change(0, 1, of_gain=of_gain)
                if change is not None:
                    held.append(abs(change.size) <= change.half_width)
        offsets, gains = np.zeros((2, 6)), np.ones((2, 6))
        offsets[1, 0], gains[1, 1] = 0.5, 1.05
        found = changes_beyond_noise(sessions(rng, offsets, gains))
        seen += [(0, 0, False) in found, (1, 0, True) in found]
    assert np.mean(held) > 0.9
    assert false / runs < 0.1
    assert (seen / runs > [0.6, 0.95]).all()


def test_the_headline_counts_what_two_sessions_determine() -> None:
    """Of 20 panels two show a gain that no session determines; in either sensor one offset changed."""
    headline = draw_session(np.random.default_rng(1)).get_suptitle()
    assert headline == "2 of 18 offsets and gains changed beyond noise; 2 not determined in two sessions"
