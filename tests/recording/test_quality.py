# SPDX-License-Identifier: BSD-3-Clause
"""Findings about a stream by itself: each fault is found where it was put, a clean stream gives none."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import Signal, Stream
from forcetorque.recording.stream_faults import (
    FAILED_TEMPERATURES,
    glitched_values,
    saturation_findings,
    stream_findings,
)

PERIOD_NS = 10_000_000
COUNT = 1000


def _stream(
    *, stamps: np.ndarray | None = None, values: np.ndarray | None = None, sequence: np.ndarray | None = None
) -> Stream:
    stamp_ns = np.arange(COUNT) * PERIOD_NS if stamps is None else stamps
    noise = np.random.default_rng(1).normal(size=(len(stamp_ns), 6))
    wrench = Signal(
        quantity="wrench",
        values=noise if values is None else values,
        columns=WRENCH_COMPONENTS,
        units=WRENCH_UNITS,
        frame="ft",
    )
    return Stream(name="ft", clock="c", stamp_ns=stamp_ns, signals={"wrench": wrench}, sequence=sequence)


def _only(findings: tuple[Finding, ...]) -> Finding:
    assert len(findings) == 1
    return findings[0]


def test_a_clean_stream_has_no_findings() -> None:
    """Jittering stamps, noise and a counter that wraps are normal."""
    rng = np.random.default_rng(2)
    stamps = np.arange(COUNT) * PERIOD_NS + rng.integers(-PERIOD_NS // 4, PERIOD_NS // 4, COUNT)
    sequence = (np.arange(COUNT) + 32768 - 300) % 32768
    assert stream_findings(_stream(stamps=stamps, sequence=sequence)) == ()


def test_a_gap_is_found_with_time_and_length() -> None:
    """A pause of 0.5 s in a 100 Hz stream is one gap, between the two samples around it."""
    stamps = np.arange(COUNT) * PERIOD_NS
    stamps[400:] += 500_000_000
    finding = _only(stream_findings(_stream(stamps=stamps)))
    assert (finding.kind, finding.start_ns, finding.end_ns) == ("gap", stamps[399], stamps[400])
    assert finding.size == pytest.approx(0.51)


def test_repeated_and_backward_stamps_are_told_apart() -> None:
    """A repeated stamp and a step back are counted each by its kind."""
    stamps = np.arange(COUNT) * PERIOD_NS
    stamps[100] = stamps[99]
    stamps[200] = stamps[197]
    kinds = {finding.kind: finding for finding in stream_findings(_stream(stamps=stamps))}
    assert kinds["repeated_stamp"].count == 1
    assert kinds["repeated_stamp"].start_ns == stamps[100]
    assert kinds["backward_stamp"].count == 1
    assert kinds["backward_stamp"].size == pytest.approx(0.02)


@pytest.mark.parametrize("start", [0, 32760, 65530, 10**6])
def test_lost_messages_are_counted_across_a_wrap(start: int) -> None:
    """Three lost messages are three, also where a 15- or 16-bit counter starts again."""
    wrap = {32760: 32768, 65530: 65536}.get(start, 1 << 40)
    sequence = (start + np.concatenate([np.arange(5), np.arange(8, COUNT + 3)])) % wrap
    finding = _only(stream_findings(_stream(sequence=sequence)))
    assert (finding.kind, finding.size, finding.start_ns) == ("lost_messages", 3.0, 4 * PERIOD_NS)


def test_a_counter_that_starts_again_is_no_loss() -> None:
    """A sender that was restarted begins to count anew."""
    sequence = np.concatenate([np.arange(5000, 5500), np.arange(500)])
    assert _only(stream_findings(_stream(sequence=sequence))).kind == "sequence_restart"


def test_a_stuck_channel_is_named() -> None:
    """One channel that repeats a value for 3 s while the others go on."""
    values = np.random.default_rng(3).normal(size=(COUNT, 6))
    values[200:500, 2] = 7.5
    finding = _only(stream_findings(_stream(values=values)))
    assert (finding.kind, finding.channel, finding.size) == ("stuck", "fz", pytest.approx(2.99))
    assert (finding.start_ns, finding.end_ns) == (200 * PERIOD_NS, 499 * PERIOD_NS)


def test_a_channel_that_is_stuck_for_a_moment_is_named_where_noise_forbids_it() -> None:
    """0.4 s in noise; where the converter steps by four times the noise, such runs are usual and none is named."""
    values = np.random.default_rng(3).normal(size=(COUNT, 6))
    values[200:240, 2] = values[200, 2]
    finding = _only(stream_findings(_stream(values=values)))
    assert (finding.kind, finding.channel, finding.size) == ("stuck", "fz", pytest.approx(0.39))
    coarse = 4.0 * np.round(np.random.default_rng(3).normal(size=(COUNT, 6)) / 4.0)
    assert stream_findings(_stream(values=coarse)) == ()


def test_a_frozen_reading_is_one_finding() -> None:
    """All channels that repeat their values for 3 s are one finding, not six."""
    values = np.random.default_rng(5).normal(size=(COUNT, 6))
    values[200:500] = values[200]
    finding = _only(stream_findings(_stream(values=values)))
    assert (finding.kind, finding.channel, finding.size) == ("frozen", "wrench", pytest.approx(2.99))


def test_a_resting_joint_is_not_stuck() -> None:
    """Encoders repeat a value while the joint rests."""
    joints = Signal(quantity="position", values=np.zeros((COUNT, 1)), columns=("knee",), units=("rad",))
    stream = Stream(name="leg", clock="c", stamp_ns=np.arange(COUNT) * PERIOD_NS, signals={"position": joints})
    assert stream_findings(stream) == ()


def test_missing_values_are_found_by_stretch() -> None:
    """Two stretches of NaN are two findings with their numbers of samples."""
    values = np.random.default_rng(4).normal(size=(COUNT, 6))
    values[10:13, 1] = np.nan
    values[700] = np.nan
    found = stream_findings(_stream(values=values))
    assert [(f.kind, f.count, f.start_ns) for f in found] == [
        ("missing", 3, 10 * PERIOD_NS),
        ("missing", 1, 700 * PERIOD_NS),
    ]


def test_an_empty_stream_is_a_finding() -> None:
    """A stream without samples is reported instead of failing."""
    assert _only(stream_findings(_stream(stamps=np.empty(0, dtype=np.int64)))).kind == "empty"


@pytest.mark.parametrize(("recovered", "value"), [(False, 32767.0), (True, -32700.3)])
def test_saturation_is_found_within_half_a_percent(recovered: bool, value: float) -> None:
    """Counts at the limit, of either sign, are found; counts just below are not; recovered ones are marked."""
    counts = np.zeros((COUNT, 6))
    counts[50:60, 3] = value
    counts[70, 3] = 0.99 * 32767
    finding = _only(saturation_findings(_stream(), counts, limit_counts=32767, recovered=recovered))
    assert (finding.channel, finding.count, finding.size) == ("ch3", 10, abs(value))
    assert ("recovered" in finding.message) is recovered


_WARMING = 25.0 + 10.0 * (1.0 - np.exp(-np.arange(400) / 100.0))


def _with(base: FloatArray, first: int, last: int, value: float) -> FloatArray:
    values = base.copy()
    values[first:last] = value
    return values


@pytest.mark.parametrize(
    ("values", "glitched"),
    [
        (_with(_WARMING, 200, 201, 1e4), {200}),
        (_with(_WARMING, 200, 204, -273.15), {200, 201, 202, 203}),
        (_with(_WARMING, 0, 1, 1e4), {0}),
        (_with(np.full(400, 25.0), 50, 52, 85.0), {50, 51}),
        (_with(_WARMING, 100, 101, np.inf), {100}),
        (_with(_WARMING, 100, 101, np.nan), set()),
        (_WARMING, set()),
        (_with(_WARMING, 200, 201, 50.0), set()),  # within ten times the range: the noise of another thermometer
        (_with(np.full(400, 25.0), 390, 400, 30.0), set()),  # a step before the log ends
        (np.r_[np.full(390, 25.0), 25.0 + 0.5 * np.arange(10)], set()),  # it warms up at the end
        (_with(np.full(400, 25.0), 100, 140, 60.0), set()),  # too long for a glitch
        (_with(np.full(400, 25.0), 100, 104, 27.0), set()),  # warmer by two steps of a thermometer
        (_with(np.zeros(400), 100, 104, 1.0), set()),  # a switch that is on for a moment
        (np.array([25.0, 1e4, 25.0]), set()),  # too few to tell
        (_with(np.repeat(_WARMING, 25), 1000, 1025, 85.0), set(range(1000, 1025))),  # one value that the log holds
        (_with(np.repeat(_WARMING, 25), 9925, 10_000, -273.15), set(range(9925, 10_000))),  # three, at the end
        (_with(np.repeat(_WARMING, 25), 1000, 1275, 85.0), set()),  # eleven
        (np.where(np.arange(400) % 5 == 2, 1e4, _WARMING), set(range(2, 400, 5))),  # every fifth
        (np.where(np.arange(400) % 3 == 2, 1e4, _WARMING), set()),  # every third
    ],
)
def test_values_nowhere_near_the_others_are_glitches(values: FloatArray, glitched: set[int]) -> None:
    """Those that come and go by a jump; not steps, drifts or what lasts."""
    assert set(np.flatnonzero(glitched_values(values)[0]).tolist()) == glitched


@pytest.mark.parametrize("value", [0.0, -1.0, -127.0])
@pytest.mark.parametrize("rows", [slice(100, 180), slice(0, 60), slice(340, None)])
def test_a_thermometer_that_fails_for_long_is_left_out(value: float, rows: slice) -> None:
    """Also at the ends of the log; controls: another value or quantity, a temperature that stays there, 40 %."""
    failing = _WARMING.copy()
    failing[rows] = value
    assert set(np.flatnonzero(glitched_values(failing, FAILED_TEMPERATURES)[0])) == set(np.arange(400)[rows])
    assert not glitched_values(failing)[0].any()
    failing[rows] = value + 0.5
    assert not glitched_values(failing, FAILED_TEMPERATURES)[0].any()
    near = np.clip(np.linspace(value - 3.0, value + 3.0, 400), None, value)
    assert not glitched_values(near, FAILED_TEMPERATURES)[0].any()
    assert glitched_values(np.where(np.arange(400) < 160, value, _WARMING), FAILED_TEMPERATURES)[1] == 160


@pytest.mark.parametrize(
    ("gives", "wrong"),
    [
        ((0.0, -1.0), (True, True)),
        ((-127.0, 85.0), (True, True)),  # and what it gives after a reset
        ((85.0, -127.0), (True, True)),
        ((-127.0, 85.0, -127.0), (True, True, True)),
        ((-127.0, 27.0, -127.0), (True, False, True)),  # it measures for a while
        ((0.0, -127.0, 0.0), (True, True, True)),
        ((60.0, 85.0), (False, False)),  # no value that stands for a failure is beside them
    ],
)
def test_a_thermometer_that_fails_in_several_ways_is_left_out(
    gives: tuple[float, ...], wrong: tuple[bool, ...]
) -> None:
    """Each for 20 samples, one after the other."""
    failing, expected = _WARMING.copy(), np.zeros(400, dtype=bool)
    rows = slice(100, 100 + 20 * len(gives))
    failing[rows], expected[rows] = np.repeat(gives, 20), np.repeat(wrong, 20)
    np.testing.assert_array_equal(glitched_values(failing, FAILED_TEMPERATURES)[0], expected)


@pytest.mark.parametrize("levels", [(1.0, 0.0), (0.1, 0.0), (-0.0625, 0.0), (2.0, 0.0, -1.0, 0.0), (-2.0, -1.0)])
def test_temperatures_near_zero_are_no_failures(levels: tuple[float, ...]) -> None:
    """Which change by the resolution of the thermometer; control: it fails among them."""
    values = np.repeat(np.tile(levels, 3), 100)
    assert not glitched_values(values, FAILED_TEMPERATURES)[0].any()
    values[20:60] = -127.0
    assert set(np.flatnonzero(glitched_values(values, FAILED_TEMPERATURES)[0])) == set(range(20, 60))


def test_glitches_that_are_too_many_to_tell_are_counted() -> None:
    """Every third value; not every fifth, which are found, nor steps of a reading that rests."""
    rows = np.arange(400)
    counts = [
        glitched_values(values)[1]
        for values in (
            np.where(rows % 3 == 2, 1e4, _WARMING),
            np.where(rows % 5 == 2, 1e4, _WARMING),
            np.where(rows % 3 == 2, 1.0, 0.5),
            _WARMING,
        )
    ]
    assert counts == [133, 0, 0, 0]


def test_a_variable_that_comes_in_bursts_has_no_glitches() -> None:
    """Bursts in 8 and 20 % of the rows, none of one value; control: failed conversions as often are glitches."""
    rng = np.random.default_rng(4)
    for every in (100, 40):
        bursts = (np.arange(4000) + 20) % every < 8
        values = 0.01 * rng.normal(size=4000) + 2.0 * bursts
        assert not glitched_values(values)[0].any()
        assert set(np.flatnonzero(glitched_values(np.where(bursts, 85.0, values))[0])) == set(np.flatnonzero(bursts))
