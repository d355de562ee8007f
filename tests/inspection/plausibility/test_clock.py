# SPDX-License-Identifier: BSD-3-Clause
"""A clock or a counter among the channels is refused before a matrix without a prior takes it for a gauge."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError
from forcetorque.experiment.calibration.moments import DataSet
from forcetorque.inspection.plausibility.gate import examine

SAMPLES = 1200
TIME_S = 0.01 * np.arange(SAMPLES)
GAIN = 50.0 * (np.eye(6) + 0.1 * np.random.default_rng(3).normal(size=(6, 6)))
"""Counts per N and N m."""


def _data(*columns: FloatArray, place: int = 6, turns: float = 3.0, noise_counts: float = 2.0) -> DataSet:
    """A tool that is turned about two axes, read by six gauges with other columns put among them."""
    pitch, roll = 1.1 * np.sin(turns * TIME_S), 0.8 * np.sin(0.7 * turns * TIME_S + 1.0)
    force = -20.0 * np.column_stack([np.sin(pitch), -np.cos(pitch) * np.sin(roll), np.cos(pitch) * np.cos(roll)])
    reference = np.hstack([force, np.cross([0.01, 0.02, 0.1], force)])
    raw = reference @ GAIN.T + noise_counts * np.random.default_rng(4).normal(size=(SAMPLES, 6))
    channels = [*raw.T[:place], *columns, *raw.T[place:]]
    return DataSet(label="a", raw=np.column_stack(channels), reference=reference, time_s=TIME_S)


@pytest.mark.parametrize(
    ("column", "way"),
    [
        (TIME_S, "rises"),
        (1.7e9 + TIME_S, "rises"),
        (np.floor(1e3 * TIME_S), "rises"),
        (np.floor(4.0 * TIME_S), "rises"),
        (np.arange(SAMPLES) % 256.0, "rises"),
        (30.0 - TIME_S, "falls"),
    ],
    ids=["seconds", "since 1970", "milliseconds", "quarters", "8 bits", "down"],
)
@pytest.mark.parametrize("place", [0, 6])
def test_a_clock_among_the_channels_is_named(column: FloatArray, way: str, place: int) -> None:
    """First or last, in any unit, also where it starts again."""
    with pytest.raises(FitError, match=f"channel ch{place}, column {place + 1} of 7 of the raw reading, {way} from"):
        examine([_data(column, place=place)], None)


@pytest.mark.parametrize("turns", [0.08, 0.15])
def test_a_clock_beside_a_slow_sweep_is_named(turns: float) -> None:
    """Six components that go one way explain a clock, as over the first half of a yoga log; it is straighter than they.

    Where instants are not known the samples are counted.
    """
    data = _data(TIME_S, turns=turns)
    for one in (data, replace(data, time_s=None)):
        with pytest.raises(FitError, match="channel ch6"):
            examine([one], None)


def test_gauges_are_no_clocks() -> None:
    """Under noise or none, over swings or a part of one; nor is a channel that stands still, or a thermometer."""
    warming = 25.0 - 3.0 * np.expm1(-TIME_S / 8.0) + 0.02 * np.random.default_rng(5).normal(size=SAMPLES)
    for data in (
        _data(),
        _data(noise_counts=0.0),
        _data(turns=0.08, noise_counts=0.0),
        _data(turns=0.15, noise_counts=0.0),
        _data(turns=1e-3, noise_counts=0.0),
        _data(np.full(SAMPLES, 7.0)),
        _data(warming),
    ):
        assert "scale" not in {doubt.kind for doubt in examine([data], None)}  # a clock would be refused


def test_a_clock_over_several_spans_is_one() -> None:
    """It rises in each, however they lie."""
    data = _data(TIME_S)
    parts = [
        replace(data, raw=data.raw[one], reference=data.reference[one], time_s=TIME_S[one], variables=None)
        for one in (slice(700, 1200), slice(0, 500))
    ]
    with pytest.raises(FitError, match="as a clock or a counter"):
        examine(parts, None)
