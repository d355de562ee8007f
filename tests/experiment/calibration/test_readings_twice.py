# SPDX-License-Identifier: BSD-3-Clause
"""Recordings that share readings: the longest counts, and what is lost with another one is stated."""

from itertools import permutations

import numpy as np
import pytest

from forcetorque.experiment.calibration.provenance import Content, readings_twice
from forcetorque.recording.fingerprint import fingerprint

RATE_HZ = 100
LOG = np.random.default_rng(7).normal(size=(120 * RATE_HZ, 6))


def _part(name: str, start_s: float, end_s: float) -> tuple[str, float, Content]:
    values = LOG[round(start_s * RATE_HZ) : round(end_s * RATE_HZ)]
    return name, len(values), Content(quantity="raw", windows=fingerprint(values))


@pytest.mark.parametrize(
    ("parts", "left_out"),
    [
        ({"long": (1, 59), "short": (1, 12.5)}, {"short": 1.0}),
        ({"long": (1, 59), "short": (20, 30), "other": (70, 80)}, {"short": 1.0}),
        ({"log": (1, 59), "half": (40, 100)}, {"log": 19.0 / 58.0}),
        ({"log": (0, 60), "next": (50, 100)}, {"next": 0.2}),
        ({"log": (0, 60), "next": (60, 110)}, {}),
    ],
)
def test_the_longest_counts(parts: dict[str, tuple[float, float]], left_out: dict[str, float]) -> None:
    """Whatever the order; the share is of at least 40 hashes, so that 0.22 is 2.8 standard deviations or more."""
    for names in permutations(parts):
        shared = readings_twice(_part(name, *parts[name]) for name in names)
        assert shared.keys() == left_out.keys()
        for name, share in left_out.items():
            assert shared[name].share == pytest.approx(share, abs=0.0 if share == 1.0 else 0.22)


def test_of_two_copies_the_first_counts() -> None:
    """They have equally many samples."""
    for names in (("one", "two"), ("two", "one")):
        (copy,) = readings_twice(_part(name, 0, 60) for name in names).values()
        assert (copy.recording, copy.other) == (names[1], names[0])
        assert (
            copy.left_out == f"{names[1]!r} has readings of {names[0]!r} again, and readings count once; it is left out"
        )


def test_a_sensor_that_rests_on_a_bench_is_no_copy() -> None:
    """Two recordings of coarse counts, of which one channel goes back and forth."""
    rng = np.random.default_rng(5)
    parts = []
    for name in ("one", "two"):
        values = np.rint([1500.3, -20.0, 7.0, 0.0, 3.0, 81.0] + 0.4 * rng.normal(size=(60_000, 1)) * np.eye(1, 6))
        parts.append((name, len(values), Content.model_construct(quantity="raw", windows=fingerprint(values))))
    assert not readings_twice(parts)


def test_what_is_lost_is_stated() -> None:
    """With a recording that is no copy: samples that are in no other one, of all its intervals."""
    parts = [_part("log", 0, 60), _part("half", 40, 80), _part("half", 100, 110)]
    shared = readings_twice(parts)["half"]
    assert shared.samples == 50 * RATE_HZ
    assert shared.share == pytest.approx(0.4, abs=0.22)
    lost = round((1.0 - shared.share) * shared.samples)
    assert shared.left_out.endswith(f"; it is left out, with about {lost} of 5000 samples that are in no other")
    assert "% of its readings in common with 'log'" in str(shared)


def test_of_recordings_that_share_equally_much_the_first_is_named() -> None:
    """Whatever their names are: by the order of a set each is right by chance in one of two, all eight in 0.4 %."""
    for number in range(8):
        first, second = f"first {number}", f"second {number}"
        logs = [_part(first, 0, 40), _part(second, 60, 100)]
        (half,) = readings_twice([*logs, _part("half", 20, 39), _part("half", 61, 80)]).values()
        assert (half.other, half.share) == (first, 1.0)
