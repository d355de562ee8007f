# SPDX-License-Identifier: BSD-3-Clause
"""Lost turns, wrong rows and slips of joints: what of a stream is used, and what is said of it."""

from __future__ import annotations

import re

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.recording.joint_jumps import are_ignored, without_joint_jumps
from forcetorque.recording.recording import Finding
from forcetorque.recording.smoothing import DERIVATIVE_WINDOW
from forcetorque.recording.stream import Signal, Stream
from forcetorque.robot.motion import joint_motion_at
from tests.recording.recordings import recording

COUNT, PERIOD_NS, TURN = 1000, 10_000_000, 2.0 * np.pi
SWING = 2.0 * np.sin(np.arange(COUNT) * 0.03) + 1e-3 * np.random.default_rng(6).normal(size=COUNT)


def _stream(values: FloatArray, *, period_ns: int = PERIOD_NS, unit: str = "rad") -> Stream:
    joints = Signal(quantity="position", values=values[:, None], columns=("knee",), units=(unit,))
    return Stream(name="leg", clock="c", stamp_ns=np.arange(len(values)) * period_ns, signals={"position": joints})


def _repaired(
    values: FloatArray, *, period_ns: int = PERIOD_NS, unit: str = "rad"
) -> tuple[FloatArray, tuple[Finding, ...]]:
    stream, findings = without_joint_jumps(_stream(values, period_ns=period_ns, unit=unit), 0)
    return stream.signal("position").values[:, 0], findings


def _with(values: FloatArray, rows: slice | int, change: float) -> FloatArray:
    changed = values.copy()
    changed[rows] += change
    return changed


def test_turns_are_taken_off_and_wrong_rows_are_left_out() -> None:
    """All else stays as it is, and so do velocities and accelerations; one finding for a joint."""
    jumping = _with(_with(SWING, slice(500, None), TURN), slice(300, 303), 0.8)
    values, (finding,) = _repaired(jumping)
    expected = SWING.copy()
    expected[300:303] = np.nan
    np.testing.assert_allclose(values, expected, rtol=0.0, atol=1e-12)
    assert (finding.kind, finding.channel, finding.count, finding.unit) == ("joint_spike", "knee", 2, "rad")
    assert (finding.start_ns, finding.end_ns) == (299 * PERIOD_NS, 500 * PERIOD_NS)
    assert "jumps and comes back, or by whole turns, 2 times, by up to 6.3 rad" in finding.message
    at = np.arange(50, 950) * PERIOD_NS
    motions = [
        joint_motion_at(recording(one), ("knee",), at, window=DERIVATIVE_WINDOW)
        for one in (_stream(SWING), without_joint_jumps(_stream(jumping), 0)[0], _stream(jumping))
    ]
    away = [np.abs(motion.acceleration - motions[0].acceleration) for motion in motions[1:]]
    assert np.isnan(away[0]).sum() == 3
    assert np.nanmax(away[0]) < 1.0 < 100.0 < away[1].max()  # negative control: as logged


def test_a_posture_that_lasts_is_named_and_its_edges_are_left_out() -> None:
    """With the interval to ignore, which leaves nothing wrong; no derivative is taken across the edges."""
    slipped = _with(SWING, slice(400, 460), -0.7)
    values, (finding,) = _repaired(slipped)
    lost = np.flatnonzero(np.isnan(values))
    assert lost.tolist() == [*range(397, 403), *range(457, 463)]
    assert (finding.kind, finding.count) == ("joint_jump", 61)
    assert "back 0.61 s later" in finding.message
    assert "start_s = 3.99, end_s = 4.60" in finding.message
    shifted = _with(SWING, slice(850, None), -0.7)
    (finding,) = _repaired(shifted)[1]
    assert "not back for 1.50 s: where" in finding.message
    stamps = np.arange(COUNT) * PERIOD_NS
    assert are_ignored(stamps, finding, [(849 * PERIOD_NS, COUNT * PERIOD_NS)])
    assert are_ignored(stamps, finding, [(0, 849 * PERIOD_NS)])
    assert not are_ignored(stamps, finding, [(0, 840 * PERIOD_NS)])


@pytest.mark.parametrize("size", [0.16, 0.25, 0.29, -0.2])
def test_slips_below_a_tenth_of_a_turn_are_no_turns(size: float) -> None:
    """Lasting ones are named, brief ones are left out; where a third of one is left, the joint is not back."""
    values, (finding,) = _repaired(_with(SWING, slice(500, None), size), period_ns=PERIOD_NS // 2)
    assert (finding.kind, np.flatnonzero(np.isnan(values)).tolist()) == ("joint_jump", [*range(497, 503)])
    values, (finding,) = _repaired(_with(SWING, slice(500, 503), size), period_ns=PERIOD_NS // 2)
    assert (finding.kind, np.flatnonzero(np.isnan(values)).tolist()) == ("joint_spike", [500, 501, 502])
    _, findings = _repaired(_with(_with(SWING, slice(300, None), 0.5), slice(500, None), size - 0.5))
    assert [one.kind for one in findings] == ["joint_jump", "joint_jump"]


@pytest.mark.parametrize("size", [6.0, -6.1, 6.5])
def test_a_slip_of_nearly_a_turn_is_named(size: float) -> None:
    """Of 16 degrees and less beside it; at rest, and where the speed changes, a turn is one."""
    for values in (np.zeros(COUNT), 0.3 * np.sin(np.arange(COUNT) * 0.01)):
        repaired, (finding,) = _repaired(_with(values, slice(500, None), size))
        assert (finding.kind, np.flatnonzero(np.isnan(repaired)).tolist()) == ("joint_jump", [*range(497, 503)])
        assert f"jumps by {abs(size):.2g} rad" in finding.message
        turned, (finding,) = _repaired(_with(values, slice(500, None), TURN))
        np.testing.assert_allclose(turned, values, rtol=0.0, atol=1e-12)
        assert finding.kind == "joint_spike"


@pytest.mark.parametrize("rows", [1, 3, 60])
@pytest.mark.parametrize("between", [0.5 * TURN, 1.0])
def test_a_turn_that_takes_several_rows_is_taken_off_behind_them(rows: int, between: float) -> None:
    """As where a wrapping joint is interpolated, or slips and wraps before it is back."""
    turned = _with(_with(SWING, slice(500, 500 + rows), between), slice(500 + rows, None), TURN)
    values, (finding,) = _repaired(turned)
    kept = np.isfinite(values)
    kept[500 : 500 + rows] = False
    np.testing.assert_allclose(values[kept], SWING[kept], rtol=0.0, atol=1e-12)
    assert np.isnan(values[500 : 500 + rows]).all() == (finding.kind == "joint_spike") == (rows <= 5)
    assert ("s later, a turn off, which is taken off: where" in finding.message) == (rows > 5)


@pytest.mark.parametrize("rows", [slice(0, 1), slice(0, 5), slice(-1, None), slice(-5, None)])
def test_wrong_rows_at_an_end_of_the_log_are_left_out(rows: slice) -> None:
    """And not all that lies on the other side; six of them are too many."""
    values, (finding,) = _repaired(_with(SWING, rows, 1.0))
    expected = SWING.copy()
    expected[rows] = np.nan
    np.testing.assert_array_equal(values, expected)
    assert (finding.kind, finding.count) == ("joint_spike", 1)
    assert not are_ignored(np.arange(COUNT) * PERIOD_NS, finding, [(400 * PERIOD_NS, 500 * PERIOD_NS)])
    six = slice(0, 6) if rows.start == 0 else slice(-6, None)
    (finding,) = _repaired(_with(SWING, six, 1.0))[1]
    assert finding.kind == "joint_jump"


def test_a_command_that_steps_is_no_joint() -> None:
    """Of a robot whose joints are known only these are looked at."""
    logged = _stream(_with(SWING, slice(500, None), 0.7))
    assert without_joint_jumps(logged, 0, ("hip",)) == (logged, ())
    assert len(without_joint_jumps(logged, 0, ("hip", "knee"))[1]) == 1


def test_no_end_is_stated_behind_the_log() -> None:
    """A span of the experiment file may not go on behind it."""
    for wrong in (slice(850, None), slice(850, COUNT - 1)):
        (finding,) = _repaired(_with(SWING, wrong, 0.7), period_ns=PERIOD_NS + 1000)[1]
        assert 'start_s = 8.49, no end_s, use = "ignore"' in finding.message


def test_a_turn_is_ignored_only_where_it_is() -> None:
    """It has no sample of its own."""
    (finding,) = _repaired(_with(SWING, slice(500, None), TURN))[1]
    stamps = np.arange(COUNT) * PERIOD_NS
    assert are_ignored(stamps, finding, [(499 * PERIOD_NS, 501 * PERIOD_NS)])
    assert not are_ignored(stamps, finding, [(300 * PERIOD_NS, 400 * PERIOD_NS)])


@pytest.mark.parametrize("rate_hz", [50, 100, 250, 1000])
def test_the_interval_that_is_stated_holds_what_is_wrong(rate_hz: int) -> None:
    """Printed to 0.01 s and typed again: at any rate of the log no wrong sample is left, and nothing is named."""
    time = np.arange(20 * rate_hz) / rate_hz
    wrong = (time > 12.3465) & (time < 15.0014)
    stream = _stream(0.5 * np.sin(time) + wrong, period_ns=10**9 // rate_hz)
    (finding,) = without_joint_jumps(stream, 0)[1]
    start_s, end_s = map(float, re.findall(r"_s = ([0-9.]+)", finding.message))
    ignored = (round(start_s * 1e9), round(end_s * 1e9))
    assert are_ignored(stream.stamp_ns, finding, [ignored])
    assert ((time[wrong] >= start_s) & (time[wrong] < end_s)).all()
    assert not are_ignored(stream.stamp_ns, finding, [(ignored[0], ignored[1] - 10**8 - 10**9 // rate_hz)])


@pytest.mark.parametrize("rate_hz", [2, 5, 10, 50, 100])
@pytest.mark.parametrize("speed", [0.3, 1.6, 3.0])
@pytest.mark.parametrize("held", [1, 10])
def test_joints_that_wrap_turn_on(rate_hz: int, speed: float, held: int) -> None:
    """At any rate and speed of a robot, also where each reading is held in a faster log."""
    rows = np.arange(60 * rate_hz * held)
    angle = speed * (rows // held) / rate_hz
    wrapped = angle % TURN
    values, findings = _repaired(wrapped, period_ns=10**9 // (rate_hz * held))
    np.testing.assert_allclose(values, angle, rtol=0.0, atol=1e-9)
    turns = int(np.count_nonzero(np.diff(wrapped) < -1.0))
    assert [(one.kind, one.count) for one in findings] == [("joint_spike", turns)] * int(turns > 0)


@pytest.mark.parametrize(
    "values",
    [
        SWING,
        np.repeat(3.0 * np.sin(np.arange(600) * 0.2), 10),  # a slow source in a fast table
        np.repeat(3.0 * np.sin(np.arange(600) * 1.0), 50),
        # readings that stop for 0.16 s and catch up
        np.where(np.abs(np.arange(COUNT) - 408) < 8, SWING[400], SWING),
        np.where(np.arange(COUNT) % 50 < 17, SWING[np.arange(COUNT) // 50 * 50], SWING),
        0.3 * np.random.default_rng(3).normal(size=COUNT),  # no jump stands out of such noise
        np.random.default_rng(4).uniform(-np.pi, np.pi, size=COUNT),  # nor out of postures in any order
        np.full(COUNT, np.nan),
    ],
)
def test_nothing_is_taken_from_joints_that_do_not_jump(values: FloatArray) -> None:
    """Also fast, held and noisy ones, and those whose log stops for a moment."""
    repaired, findings = _repaired(values)
    np.testing.assert_array_equal(repaired, values)
    assert findings == ()


def test_a_row_without_a_value_hides_no_jump() -> None:
    """A lost turn beside it, and wherever every other row is empty."""
    for gaps in (slice(499, 500), slice(0, None, 2)):
        turned = _with(SWING, slice(500, None), TURN)
        turned[gaps] = np.nan
        values, (finding,) = _repaired(turned)
        assert (finding.kind, finding.count) == ("joint_spike", 1)
        kept = np.isfinite(turned)
        np.testing.assert_allclose(values[kept], SWING[kept], rtol=0.0, atol=1e-12)
        assert np.isnan(values[~kept]).all()


def test_a_wrong_row_at_rest_is_left_out_and_metres_have_no_turns() -> None:
    """A joint that rests moves by nothing beside its jump; 6.3 m of a sliding joint are a slip."""
    values, (finding,) = _repaired(_with(np.zeros(COUNT), 300, 0.8))
    assert (np.flatnonzero(np.isnan(values)).tolist(), finding.kind) == ([300], "joint_spike")
    (finding,) = _repaired(_with(0.2 * SWING, slice(500, None), TURN), unit="m")[1]
    assert (finding.kind, finding.unit) == ("joint_jump", "m")


def test_a_joint_that_lies_where_its_reading_wraps_stays_there() -> None:
    """Turns beside turns, and noise between them; a turn for all samples is the same posture."""
    angles = np.pi + 0.002 * SWING + 1e-3 * np.random.default_rng(8).normal(size=COUNT)
    values, (finding,) = _repaired((angles + np.pi) % TURN - np.pi)
    off = (values - angles) / TURN
    np.testing.assert_allclose(off, np.rint(off[0]), rtol=0.0, atol=1e-12)
    assert finding.kind == "joint_spike"
    assert finding.count > 20


@pytest.mark.parametrize("rate_hz", [50, 100, 1000])
@pytest.mark.parametrize("step", [0.0, 1e-3, 0.0175, 0.05])
def test_a_joint_that_rests_where_its_reading_wraps_moves_off_without_a_slip(rate_hz: int, step: float) -> None:
    """Turns of moves from and to rest are taken off, at any written step; a slip of 6 rad at rest is named."""
    part = np.linspace(0.0, 1.0, rate_hz)
    move, rest = part**3 * (10.0 - 15.0 * part + 6.0 * part**2), np.zeros(2 * rate_hz)
    angle = np.concatenate([rest, *(s * np.r_[move, rest + 1.0, move[::-1], rest] for s in (-0.6, 0.5, -0.3, 0.8))])
    read = np.rint(angle / step) * step if step else angle
    values, (finding,) = _repaired(read % TURN, period_ns=10**9 // rate_hz)
    np.testing.assert_allclose(values, read, rtol=0.0, atol=1e-9)
    assert finding.kind == "joint_spike"
    if step < 0.01:  # coarser ones scatter too much to tell 6 rad from a turn
        slipped = _with(read, slice(4 * rate_hz, None), 6.0)
        assert {one.kind for one in _repaired(slipped, period_ns=10**9 // rate_hz)[1]} == {"joint_jump"}
