# SPDX-License-Identifier: BSD-3-Clause
"""Delay and drift between two clocks that were planted, and motion that cannot tell them."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import pytest
from scipy.signal import lfilter

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import RecordingError
from forcetorque.recording.clock_offset import Delay, estimate_delay

READING_HZ, REFERENCE_HZ, SECONDS = 97.0, 61.0, 40.0


class Motion:
    """A band of sines of random phase, three columns."""

    def __init__(self, rng: np.random.Generator, *, highest_hz: float = 1.5) -> None:
        self.frequency = rng.uniform(0.05, highest_hz, size=(24, 3))
        self.phase = rng.uniform(0.0, 2.0 * np.pi, size=(24, 3))

    def at(self, time_s: FloatArray) -> FloatArray:
        """Columns at instants; shape (n, 3)."""
        angle = 2.0 * np.pi * self.frequency * time_s[:, None, None] + self.phase
        columns: FloatArray = np.sin(angle).sum(axis=1)
        return columns


class Setting(NamedTuple):
    """Rates, length and motion of a log, and how long its noise lasts."""

    reading_hz: float
    reference_hz: float
    seconds: float
    highest_hz: float
    noise_kept: float
    moving: float
    stops: bool = False


SETTINGS = {
    "slow": Setting(100.0, 100.0, 60.0, 0.3, 0.0, 1.0),
    "noise that lasts": Setting(200.0, 100.0, 60.0, 1.0, 0.98, 1.0),
    "stop and go": Setting(100.0, 100.0, 60.0, 1.0, 0.8, 0.5, stops=True),
    "ten seconds": Setting(500.0, 100.0, 10.0, 2.0, 0.8, 0.5),
    "fast reference": Setting(50.0, 1000.0, 40.0, 1.0, 0.5, 0.5),
}
"""Logs that were not looked at when the interval was built."""


def logged(seed: int, setting: Setting) -> tuple[float, Delay]:
    """Delay that was planted in a setting, and what is estimated."""
    rng = np.random.default_rng(seed)
    motion, matrix, delay_s = (
        Motion(rng, highest_hz=setting.highest_hz),
        rng.normal(size=(3, 6)),
        rng.uniform(-0.2, 0.2),
    )

    def moved(time_s: FloatArray) -> FloatArray:
        going = (
            0.5 * (1.0 + np.tanh(6.0 * np.sin(2.0 * np.pi * time_s / 7.0))) if setting.stops else np.ones_like(time_s)
        )
        columns: FloatArray = setting.moving * motion.at(time_s) * going[:, None]
        return columns

    time = np.arange(0.0, setting.seconds, 1.0 / setting.reading_hz)
    reference_time = np.arange(0.007, setting.seconds, 1.0 / setting.reference_hz)
    kept = setting.noise_kept
    noise = lfilter([np.sqrt(1.0 - kept**2)], [1.0, -kept], rng.normal(size=(len(time), 6)), axis=0)
    reference = moved(reference_time) + rng.normal(0.0, 0.02 * setting.moving, (len(reference_time), 3))
    return delay_s, estimate_delay(time, moved(time - delay_s) @ matrix + noise, reference_time, reference)


def planted(seed: int, *, delay_s: float, drift: float = 0.0, moving: float = 1.0, **asked: Any) -> Delay:
    """Estimate from six channels whose noise lasts, against a reference with noise."""
    rng = np.random.default_rng(seed)
    motion, matrix = Motion(rng), rng.normal(size=(3, 6))
    time = np.sort(np.arange(0.0, SECONDS, 1.0 / READING_HZ) + rng.normal(0.0, 5e-4, int(SECONDS * READING_HZ)))
    reference_time = np.arange(0.013, SECONDS, 1.0 / REFERENCE_HZ)
    middle = 0.5 * (time[0] + time[-1])
    noise = lfilter([0.3], [1.0, -0.8], rng.normal(size=(len(time), 6)), axis=0)
    reading = moving * motion.at(time - delay_s - drift * (time - middle)) @ matrix + noise + np.arange(6)
    reference = moving * motion.at(reference_time) + rng.normal(0.0, 0.05, (len(reference_time), 3))
    return estimate_delay(time, reading, reference_time, reference, **asked)


@pytest.mark.parametrize("delay_s", [0.0432, -0.2187])
def test_a_planted_delay_is_within_its_interval(delay_s: float) -> None:
    """To a small part of a sample, of either sign, and no drift is seen in it."""
    delay = planted(1, delay_s=delay_s)
    assert abs(delay.delay_s - delay_s) < 2.0 * delay.delay_half_width_s < 0.005
    assert not delay.drifts
    assert delay.drift == 0.0
    assert delay.explained > 0.9


@pytest.mark.long
def test_a_drift_is_estimated_with_the_delay_or_said_to_be_there() -> None:
    """The delay is that in the middle of the reading."""
    delay = planted(2, delay_s=0.05, drift=1e-3, with_drift=True)
    assert abs(delay.delay_s - 0.05) < 2.0 * delay.delay_half_width_s
    assert abs(delay.drift - 1e-3) < 2.0 * delay.drift_half_width < 1e-3
    assert planted(2, delay_s=0.05, drift=1e-3).drifts


@pytest.mark.long
def test_a_far_delay_is_found_where_it_is_looked_for() -> None:
    """Beyond the search it is refused, not taken from its end."""
    assert planted(3, delay_s=1.3, around_s=1.2).delay_s == pytest.approx(1.3, abs=0.005)
    with pytest.raises(RecordingError, match=r"the delay is not identifiable|lies at the end of what was looked"):
        planted(3, delay_s=1.3)


@pytest.mark.long
def test_no_motion_tells_no_delay() -> None:
    """Negative control: noise beside noise, refused whatever its seed."""
    for seed in range(4):
        with pytest.raises(RecordingError, match="the delay is not identifiable|lies at the end"):
            planted(seed, delay_s=0.05, moving=0.0)


def test_motion_that_repeats_itself_tells_no_delay() -> None:
    """One sine a third of a second long: periods later it explains as much."""
    time = np.arange(0.0, 30.0, 0.01)
    rng = np.random.default_rng(5)
    sine = np.column_stack([np.sin(2.0 * np.pi * 3.0 * (time - 0.02)), np.cos(2.0 * np.pi * 3.0 * (time - 0.02))])
    reading = sine + 0.1 * rng.normal(size=sine.shape)
    with pytest.raises(RecordingError, match="the delay is not identifiable"):
        estimate_delay(time, reading, time, np.sin(2.0 * np.pi * 3.0 * time)[:, None])


@pytest.mark.parametrize("seed", range(4))
def test_a_sine_of_any_period_tells_no_delay(seed: int) -> None:
    """Negative control off the steps of time: one that lies nearer to a step is no surer than others."""
    rng = np.random.default_rng(seed)
    time, reference_time = np.arange(0.0, 20.0, 0.01), np.arange(-1.0, 21.0, 0.01)
    turn, delay_s = 2.0 * np.pi * rng.uniform(2.2, 4.0), rng.uniform(-0.2, 0.2)
    sine = np.sin(turn * (time - delay_s))[:, None] * rng.normal(size=3)
    reading = sine + 0.1 * rng.normal(size=sine.shape)
    with pytest.raises(RecordingError, match="the delay is not identifiable|lies at the end"):
        estimate_delay(time, reading, reference_time, np.sin(turn * reference_time)[:, None])


def test_a_pause_of_days_costs_no_memory() -> None:
    """Two stretches three days apart are two stretches, and not the samples that lie between."""
    rng = np.random.default_rng(6)
    motion, matrix = Motion(rng), rng.normal(size=(3, 6))
    stretch = np.arange(0.0, 20.0, 0.01)
    time = np.concatenate([stretch, stretch + 3.0 * 86400.0])
    reading = motion.at(time - 0.03) @ matrix + rng.normal(size=(len(time), 6))
    assert estimate_delay(time, reading, time, motion.at(time)).delay_s == pytest.approx(0.03, abs=0.002)


@pytest.mark.parametrize(
    ("seconds", "within_s", "message"),
    [(3.0, 0.5, "without a gap that both saw"), (30.0, 0.01, "within_s of at least two steps")],
)
def test_what_cannot_be_looked_through_is_refused(seconds: float, within_s: float, message: str) -> None:
    """Too short a log, and a search of no step."""
    time = np.arange(0.0, seconds, 0.01)
    values = np.random.default_rng(7).normal(size=(len(time), 3))
    with pytest.raises(RecordingError, match=message):
        estimate_delay(time, values, time, values, within_s=within_s)


@pytest.mark.long
def test_intervals_hold_what_was_planted() -> None:
    """Of 200 draws 95 % intervals of delay and drift hold 90 to 98 %.

    At a true coverage of 95 % the count falls outside with probability 0.003 each; at 85 % it stays inside with 0.03.
    """
    rng = np.random.default_rng(20)
    inside, refused = [], 0
    for seed in range(1000, 1200):
        delay_s, drift = rng.uniform(-0.3, 0.3), rng.uniform(-5e-4, 5e-4)
        try:
            delay = planted(seed, delay_s=delay_s, drift=drift, moving=0.3, with_drift=True)
        except RecordingError:
            refused += 1
            continue
        inside.append(
            (
                abs(delay.delay_s - delay_s) <= delay.delay_half_width_s,
                abs(delay.drift - drift) <= delay.drift_half_width,
            )
        )
    shares = np.mean(inside, axis=0)
    assert refused <= 10
    assert ((shares >= 0.9) & (shares <= 0.98)).all(), shares


@pytest.mark.long
def test_intervals_hold_on_other_logs() -> None:
    """Of 100 draws of each of five settings pooled 90 to 98 % are inside, of none less than 86 %; nothing is refused.

    At a true coverage of 95 % one setting in a thousand falls below 87 of 100.
    """
    inside = {
        name: np.mean([abs(one.delay_s - truth) <= one.delay_half_width_s for truth, one in draws])
        for name, draws in (
            (name, [logged(seed, setting) for seed in range(5000, 5100)]) for name, setting in SETTINGS.items()
        )
    }
    assert 0.9 <= np.mean(list(inside.values())) <= 0.98, inside
    assert min(inside.values()) >= 0.86, inside


@pytest.mark.long
def test_noise_is_hardly_ever_taken_for_a_delay() -> None:
    """Negative control: of 200 logs without motion at most 4 have a delay (2 %)."""
    answers = 0
    for seed in range(2000, 2200):
        try:
            planted(seed, delay_s=0.1, moving=0.0)
        except RecordingError:
            continue
        answers += 1
    assert answers <= 4
