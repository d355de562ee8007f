# SPDX-License-Identifier: BSD-3-Clause
"""Events and the decays behind them, and records that cannot tell any."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError, RecordingError
from forcetorque.recording.frozen_and_saturated_samples import flat_tops
from forcetorque.sensor.bandwidth.excited_records import EvenRecord, even_record, refuse_clipped
from forcetorque.sensor.bandwidth.pooled_decays import pool
from forcetorque.sensor.bandwidth.ring_down import RingDown, find_events, gains, ring_downs, step_direction
from tests.scenes.excited_sensors import GRAVITY, MASS_KG, RELEASES, Spring, released, tapped

SPRING = Spring(rate_hz=500.0)
ENOUGH = 4.0
"""Half-widths of 95 % intervals within which all of some numbers lie."""


def _record(time: FloatArray, reading: FloatArray) -> EvenRecord:
    return even_record(time, reading[:, None], name="log")


@pytest.fixture(scope="module")
def taps() -> EvenRecord:
    """Four taps."""
    rng = np.random.default_rng(5)
    time, _, reading = SPRING.read(rng, tapped(rng, SPRING, taps=4, apart_s=1.5))
    return _record(time, reading)


def test_taps_are_found_and_ring_as_the_sensor_does(taps: EvenRecord) -> None:
    """One event per tap at its time, and natural frequency and damping within their intervals."""
    events = find_events(taps, name="log")
    np.testing.assert_allclose([taps.time_s[one.onset] for one in events], 0.55 + 1.5 * np.arange(4), atol=0.07)
    for decay in ring_downs(taps, events, name="log"):
        assert isinstance(decay, RingDown)
        error = np.abs([decay.frequency_hz - SPRING.natural_hz, decay.damping - SPRING.damping])
        assert (error < ENOUGH * 2.0 * decay.error).all()
        assert decay.error[0] < 0.01 * SPRING.natural_hz


def test_released_weights_tell_the_gain() -> None:
    """The step over the weight, along its direction; with half of the mass it would be twice that."""
    rng = np.random.default_rng(6)
    time, _, reading = SPRING.read(rng, released(rng, SPRING))
    wrench = np.zeros((len(time), 6))
    wrench[:, 1], wrench[:, 2] = 0.6 * reading, 0.8 * reading
    record = even_record(time, wrench, name="log")
    events = find_events(record, name="log")
    assert len(events) == RELEASES
    direction = step_direction(record, events)
    np.testing.assert_allclose(direction, [0.0, 0.6, 0.8, 0.0, 0.0, 0.0], atol=0.01)
    along = _record(time, wrench @ direction)
    decays = [one for one in ring_downs(along, events, name="log") if isinstance(one, RingDown)]
    gain = pool(*gains(along, events, decays, MASS_KG * GRAVITY))
    assert abs(gain.mean - SPRING.gain) < ENOUGH * gain.half_width
    assert gain.half_width < 0.02


def test_two_modes_are_told_apart() -> None:
    """A record with two vibrations has both; the stronger is named."""
    time = np.arange(0.0, 3.0, 0.002)
    behind = np.maximum(time - 1.0, 0.0)
    rings = np.exp(-8.0 * behind) * np.sin(2.0 * np.pi * 25.0 * behind)
    rings += 0.5 * np.exp(-12.0 * behind) * np.sin(2.0 * np.pi * 70.0 * behind)
    reading = 10.0 * rings * (time >= 1.0) + 0.02 * np.random.default_rng(7).normal(size=len(time))
    record = _record(time, reading)
    (decay,) = ring_downs(record, find_events(record, name="log"), name="log")
    assert isinstance(decay, RingDown)
    assert decay.modes == 2
    assert decay.frequency_hz == pytest.approx(25.0, abs=0.1)


def test_what_does_not_decay_is_no_decay() -> None:
    """A bump on a hum that was there before tells no vibration of its own."""
    time = np.arange(0.0, 3.0, 0.002)
    hum = 0.3 * np.sin(2.0 * np.pi * 40.0 * time)
    reading = hum + 20.0 * np.exp(-(((time - 1.5) / 0.004) ** 2)) + 0.02 * np.random.default_rng(8).normal(size=1500)
    record = _record(time, reading)
    decays = ring_downs(record, find_events(record, name="log"), name="log")
    assert any(isinstance(one, FitError) and "event at 1.5" in str(one) for one in decays)


def test_a_record_without_an_impact_is_refused() -> None:
    """Noise and slow motion alone are none; how far they are from one is said."""
    rng = np.random.default_rng(9)
    time = np.arange(0.0, 6.0, 0.002)
    reading = 10.0 * np.sin(time) + 0.1 * rng.normal(size=len(time))
    with pytest.raises(
        RecordingError, match=r"log: expected an impact or a release, got none: .* stands out by [3-6]\."
    ):
        find_events(_record(time, reading), name="log")
    with pytest.raises(RecordingError, match=r"expected a record of at least 0.4 s"):
        find_events(_record(time[:50], reading[:50]), name="log")


def test_uneven_samples_are_refused_where_they_are() -> None:
    """A lost sample, a jittering clock, and a missing value, each with its time."""
    time = np.arange(0.0, 2.0, 0.01)
    flat = np.zeros((200, 1))
    with pytest.raises(RecordingError, match=r"uneven sampling: 1 of 198 steps .* the first at 0.4900 s \(sample 50\)"):
        even_record(np.delete(time, 50), flat[1:], name="log")
    jitter = time + 0.002 * np.random.default_rng(1).uniform(-1.0, 1.0, size=200)
    with pytest.raises(RecordingError, match=r"uneven sampling: steps scatter by 1\d %"):
        even_record(jitter, flat, name="log")
    flat[70] = np.nan
    with pytest.raises(RecordingError, match=r"1 samples have no value, the first at 0.7000 s \(sample 71\)"):
        even_record(time, flat, name="log")
    assert even_record(time, np.zeros((200, 1)), name="log").rate_hz == pytest.approx(100.0)


def test_a_rate_that_changes_is_refused() -> None:
    """By 9 % half way, though no step is odd; half a percent, which crystals have, is none."""
    for change, steady in ((0.09, False), (0.005, True)):
        time = np.concatenate([[0.0], np.cumsum(np.repeat([1e-3, 1e-3 * (1.0 + change)], 2500))])
        if steady:
            assert even_record(time, np.zeros((5001, 1)), name="log").rate_hz == pytest.approx(1000.0, rel=3e-3)
        else:
            with pytest.raises(RecordingError, match=r"from 2\.5000 s to 3\.0450 s steps are \+4\.3 % off the mean"):
                even_record(time, np.zeros((5001, 1)), name="log")
    with pytest.raises(RecordingError, match="expected instants that increase, got a usual step of 0 ms"):
        even_record(np.zeros(200), np.zeros((200, 1)), name="log")


def test_a_weight_that_hangs_still_is_not_clipped() -> None:
    """Readings without noise stay at the largest value until it is let go; a top that is jumped to is one."""
    time = np.arange(300) * 1e-3
    ringing = 20.0 * np.exp(-8.0 * time) * np.cos(200.0 * time)
    hung = np.round(np.concatenate([np.linspace(0.0, 20.0, 400), np.full(300, 20.0), ringing[1:]]), 1)
    assert not flat_tops(hung).any()
    struck = np.concatenate([np.round(np.linspace(0.0, 1.0, 400), 1), np.full(5, 20.0), ringing[1:]])
    assert np.flatnonzero(flat_tops(struck)).tolist() == list(range(400, 405))


def test_a_clipped_impact_is_refused_where_it_is(taps: EvenRecord) -> None:
    """A top that is cut off, or a reading at its limit; a whole one, and one that is rounded, are none."""
    refuse_clipped(taps, ("fz",), where="log")
    assert not flat_tops(np.round(10.0 * np.sin(np.linspace(0.0, 20.0, 400)))).any()
    cut = np.minimum(taps.signals, 0.6 * taps.signals.max())
    clipped = EvenRecord(start_s=0.0, rate_hz=taps.rate_hz, signals=cut)
    with pytest.raises(RecordingError, match=r"log: fz is clipped at \d\.\d+ s \(sample \d+\)"):
        refuse_clipped(clipped, ("fz",), where="log")
    with pytest.raises(RecordingError, match="fz is clipped"):
        refuse_clipped(taps, ("fz",), where="log", limits=np.array([0.9 * np.abs(taps.signals).max()]))


def test_events_that_differ_widen_their_mean() -> None:
    """By the scatter; of one event the interval is its own."""
    same = pool(np.array([10.0, 10.1, 9.9]), np.full(3, 0.1))
    apart = pool(np.array([8.0, 10.0, 12.0]), np.full(3, 0.1))
    assert apart.half_width > 5.0 * same.half_width
    assert apart.scatter == pytest.approx(2.0)
    one = pool(np.array([10.0]), np.array([0.1]))
    assert (one.scatter, one.half_width) == (None, pytest.approx(0.196, abs=1e-3))
