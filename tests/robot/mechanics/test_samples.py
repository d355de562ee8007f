# SPDX-License-Identifier: BSD-3-Clause
"""Readings meet the wrenches that mechanics demands at the same instants, and nothing is made up where data lack."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import RecordingError, ShapeError
from forcetorque.recording.alignment import seconds_since
from forcetorque.recording.recording import Interval, Recording, Support, Use
from forcetorque.recording.smoothing import SavitzkyGolay
from forcetorque.recording.stream import Stream
from forcetorque.robot.dynamics import expected_wrenches
from forcetorque.robot.mechanics.measured_and_expected_wrench import Processing, SensorSamples, sensor_samples
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.motions.joint_motions import random_smooth_motion
from forcetorque.simulation.robots import ARM_URDF
from forcetorque.simulation.simulated_sensor import SimulatedSensor, y_shaped_matrix
from forcetorque.simulation.trace import simulate_recording
from tests.recording.recordings import EPOCH_NS, recording, refused, signal, stream

JOINTS = ("shoulder_yaw", "shoulder_pitch", "shoulder_roll", "elbow", "wrist")
RANGES = dict.fromkeys(JOINTS, (-1.0, 1.5))
DOWN = np.array([0.0, 0.6, -0.8])
SLOWEST_HZ = 0.1
FASTEST = 2 * np.pi * SLOWEST_HZ * 4.3
"""Largest angular frequency of the simulated motions; rad/s."""

FILTER_LOSS = (0.15 * FASTEST) ** 2 / 14
"""Part that a cubic over a = 0.15 s to either side loses of a second derivative, a^2 / 14: t^4 on Legendre's P2."""

LOGGED = Processing(logged_derivatives=True)
SMOOTHED = replace(LOGGED, smoothing=SavitzkyGolay(window_s=0.1, order=2))


@cache
def _arm() -> RobotModel:
    return read_urdf(ARM_URDF)


def _motion(stamps: IntArray) -> JointMotion:
    seconds = seconds_since(stamps, EPOCH_NS)
    return random_smooth_motion(RANGES, seconds, slowest_hz=SLOWEST_HZ, rng=np.random.default_rng(1))


def _truth(motion: JointMotion) -> FloatArray:
    return expected_wrenches(build_tree(_arm(), "base"), motion, RootMotion.fixed(DOWN), ["arm_ft"])["arm_ft"]


def _joints(stamps: IntArray, joints: tuple[str, ...] = JOINTS, **where: str) -> Stream:
    """Exact positions, velocities and accelerations of some joints."""
    motion = _motion(stamps)
    columns = [JOINTS.index(joint) for joint in joints]
    signals = [
        signal(key, getattr(motion, key)[:, columns], joints) for key in ("position", "velocity", "acceleration")
    ]
    return stream(stamps, *signals, **({"name": "joints"} | where))


def _stamps(period_ms: int = 10, *, late_us: int = 0) -> IntArray:
    """Even stamps over ten seconds; ns."""
    return EPOCH_NS + late_us * 1000 + np.arange(0, 10_000 + (late_us == 0), period_ms, dtype=np.int64) * 1_000_000


LATE = _stamps(late_us=3700)
"""Stamps of the sensor: 1000 samples, 3.7 ms after those of the joints."""


def _sensor(stamps: IntArray, values: Any = None) -> Stream:
    """What an ideal sensor reads, or given values."""
    return stream(stamps, signal("wrench", _truth(_motion(stamps)) if values is None else values), name="ft")


@cache
def _exact() -> Recording:
    """Ten seconds without noise: joints at 100 Hz and the sensor 3.7 ms behind them."""
    return recording(_joints(_stamps()), _sensor(LATE))


def _span(start_s: float, end_s: float, *, support: str | None = "base", use: Use = Use.CALIBRATION) -> Interval:
    start, end = (EPOCH_NS + round(t * 1e9) for t in (start_s, end_s))
    held = None if support is None else Support(frame=support, gravity_direction=DOWN)
    return Interval(label=f"{use} {start_s}", start_ns=start, end_ns=end, use=use, support=held)


WHOLE = _span(0.0, 10.0)


def _samples(
    log: Recording, interval: Interval = WHOLE, processing: Processing = LOGGED, **change: str
) -> SensorSamples:
    fields = {"sensor": "arm_ft", "stream": "ft", "quantity": "wrench"} | change
    return sensor_samples(log, _arm(), interval=interval, processing=processing, **fields)


def _rms(values: FloatArray) -> float:
    return float(np.sqrt((values**2).mean()))


def test_the_reference_is_the_true_wrench_up_to_interpolation() -> None:
    """Halving the period of an exact log quarters the error, as straight lines between samples have it."""
    errors = []
    for period_ms in (40, 20, 10):
        log = recording(_joints(_stamps(period_ms)), _sensor(_stamps(period_ms, late_us=500 * period_ms)))
        samples = _samples(log)
        assert samples.dropped == 0
        assert len(samples) == 10_000 // period_ms
        errors.append(_rms(samples.reference - samples.reading.values))
    ratios = np.array(errors[:-1]) / errors[1:]
    np.testing.assert_allclose(ratios, 4.0, rtol=0.02)  # the next term is smaller by the square of 0.04 s FASTEST
    upside_down = replace(WHOLE, support=Support(frame="base", gravity_direction=-DOWN))
    assert _rms(_samples(_exact(), upside_down).reference - _truth(_motion(LATE))) > 1e4 * errors[-1]


def test_a_simulated_sensor_reads_what_is_expected_of_it() -> None:
    """Jitter, encoders and filtered derivatives included, decoded counts are the reference as far as those allow."""
    matrix, offset = y_shaped_matrix(arm_m=0.02, counts_per_newton=1e6), np.array([1.0, 2.0, 3.0, 0.1, 0.2, 0.3])
    sensor = SimulatedSensor(matrix=matrix, offset=offset, noise_counts=0.0, limit_counts=2**40)
    log = simulate_recording(
        _arm(), {"arm_ft": sensor}, support="base", gravity_direction=DOWN, ranges=RANGES,
        duration_s=10.0, rate_hz=100.0, slowest_hz=SLOWEST_HZ, seed=3,
    )  # fmt: skip
    start, end = log.span_ns
    span = replace(WHOLE, start_ns=start + 10**9, end_ns=end - 10**9)
    samples = _samples(log, span, Processing(), stream="arm_ft", quantity="raw")
    decoded = samples.reading.values @ matrix.T + offset
    assert len(samples) > 790
    # each of three joints is off by half an encoder step of 1e-4 rad, which tilts 35 N, and by the filter's loss
    # of its fastest sine's acceleration, 1.25 rad / 4 FASTEST^2, which moves 3.5 kg at 0.3 m
    newton = 3 * (0.5e-4 * 35 + 3.5 * 0.3 * FILTER_LOSS * 1.25 / 4 * FASTEST**2)
    np.testing.assert_allclose(samples.reference[:, :3], decoded[:, :3], rtol=0.0, atol=newton)
    np.testing.assert_allclose(samples.reference[:, 3:], decoded[:, 3:], rtol=0.0, atol=0.3 * newton)  # lever of 0.3 m
    assert np.abs(samples.reference - decoded + offset).max() > 10 * newton


def test_filtered_derivatives_agree_with_logged_ones() -> None:
    """The filter loses no larger part of the accelerations' share than of the fastest sine."""
    middle = _span(0.5, 9.5)
    logged, filtered = _samples(_exact(), middle), _samples(_exact(), middle, Processing())
    zeros = {
        key: replace(held, values=0 * held.values) if key == "acceleration" else held
        for key, held in _exact().stream("joints").signals.items()
    }
    joints = replace(_exact().stream("joints"), signals=zeros)
    from_acceleration = logged.reference - _samples(recording(joints, _exact().stream("ft")), middle).reference
    bound = FILTER_LOSS * _rms(from_acceleration)
    assert 0.0 < _rms(filtered.reference - logged.reference) < bound
    assert _rms(from_acceleration) > 50 * bound


def test_gravity_is_an_argument() -> None:
    """At rest the reference is proportional to gravity."""
    rest = stream(_stamps(), signal("position", np.full((1001, 5), 0.3), JOINTS), name="joints")
    log = recording(rest, _exact().stream("ft"))
    single, double = (_samples(log, processing=Processing(gravity=g)).reference for g in (9.8, 19.6))
    np.testing.assert_allclose(double, 2 * single, rtol=0.0, atol=1e-9)  # rounding of derivatives of a constant


def test_known_samples_are_those_that_would_be_computed() -> None:
    """Those of a part of the interval, also beside stamps that come twice; negative control: of another model."""
    stamps = LATE.copy()
    stamps[200], stamps[201] = stamps[199], stamps[150]
    log = recording(_joints(_stamps()), _sensor(stamps))
    fields = {"sensor": "arm_ft", "stream": "ft", "quantity": "wrench", "interval": WHOLE, "processing": LOGGED}
    computed, part = _samples(log), _samples(log, _span(0.0, 5.0))
    again = sensor_samples(log, _arm(), known=[part], **fields)
    np.testing.assert_array_equal(again.stamp_ns, computed.stamp_ns)
    np.testing.assert_allclose(again.reference, computed.reference, rtol=1e-12, atol=1e-12)
    other = sensor_samples(log, _arm(), known=[replace(part, reference=part.reference + 1.0)], **fields)
    assert np.flatnonzero((other.reference != computed.reference).any(axis=1)).tolist() == list(range(len(part)))


def test_ignored_spans_are_cut_out_and_not_counted() -> None:
    """By hand: 800 samples lie in eight seconds, 100 of them in the ignored one, whose end is not in it."""
    ignored = replace(_span(3.0, 4.0, support=None, use=Use.IGNORE), start_ns=int(LATE[300]), end_ns=int(LATE[400]))
    log = _exact().with_intervals([ignored, _span(5.0, 6.0, use=Use.VALIDATION)])
    samples = _samples(log, _span(1.0, 9.0))
    assert samples.stamp_ns.tolist() == [*LATE[100:300].tolist(), *LATE[400:900].tolist()]
    assert samples.dropped == 0
    assert len(_samples(_exact(), _span(1.0, 9.0))) == 800


def test_an_interval_includes_its_start_and_not_its_end() -> None:
    """Both ends at stamps of samples: the first is in, the last is not."""
    span = replace(WHOLE, start_ns=int(LATE[10]), end_ns=int(LATE[20]))
    assert _samples(_exact(), span).stamp_ns.tolist() == LATE[10:20].tolist()


@pytest.mark.parametrize("processing", [LOGGED, Processing()], ids=["logged", "filtered"])
def test_a_gap_of_the_joints_is_dropped_and_counted(processing: Processing) -> None:
    """By hand: without the joints of second 3, the 101 readings between their neighbours have no reference."""
    kept = np.delete(_stamps(), np.arange(300, 400))
    samples = _samples(recording(_joints(kept), _sensor(LATE)), processing=processing)
    assert samples.dropped == 101
    assert samples.stamp_ns.tolist() == np.delete(LATE, np.arange(299, 400)).tolist()


def test_missing_readings_and_bad_stamps_are_dropped_and_counted() -> None:
    """By hand: three NaN, one in a single component, and two stamps that do not step forward."""
    values = _truth(_motion(LATE)).copy()
    values[[100, 101], :], values[500, 5] = np.nan, np.nan
    stamps = LATE.copy()
    stamps[200], stamps[201] = stamps[199], stamps[150]
    samples = _samples(recording(_joints(_stamps()), _sensor(stamps, values)))
    assert samples.dropped == 5
    assert samples.stamp_ns.tolist() == np.delete(LATE, [100, 101, 200, 201, 500]).tolist()


@pytest.mark.parametrize("ignored", [(), (_span(1.5, 2.0, support=None, use=Use.IGNORE),)])
def test_smoothing_sees_half_a_window_around_the_interval_that_is_not_ignored(ignored: tuple[Interval, ...]) -> None:
    """By hand: a window holds 11 samples of 10 ms. Those further outside, or ignored, change nothing, bit by bit."""
    span = _span(2.0, 8.0)
    inside = np.array([span.start_ns <= t < span.end_ns for t in LATE])
    near = np.array([span.start_ns - 60_000_000 <= t < span.end_ns + 60_000_000 for t in LATE])
    for cut in ignored:
        near &= (cut.start_ns > LATE) | (cut.end_ns <= LATE)
    clean = _truth(_motion(LATE))
    results = []
    for change in (np.zeros(1000), 1e3 * ~near, 1e3 * (near & ~inside)):
        log = recording(_joints(_stamps()), _sensor(LATE, clean + change[:, None]), intervals=ignored)
        results.append(_samples(log, span, SMOOTHED).reading.values)
    assert len(results[0]) == np.count_nonzero(inside)
    assert results[0].tobytes() == results[1].tobytes()
    moved = np.abs(results[2] - results[0]).max(axis=1) > 1.0
    assert np.flatnonzero(moved).tolist() == [*(() if ignored else range(5)), *range(595, 600)]
    assert _rms(results[0] - clean[inside]) > 1e-6  # the filter did something


@pytest.mark.parametrize("processing", [Processing(), SMOOTHED, replace(SMOOTHED, logged_derivatives=False)])
def test_an_interval_reads_as_a_longer_one_does(processing: Processing) -> None:
    """Readings, references and their derivatives come from the log on either side; a log that ends there has others."""
    noisy = _truth(_motion(LATE)) + np.random.default_rng(2).normal(size=(1000, 6))
    log = recording(_joints(_stamps()), _sensor(LATE, noisy))
    short, long = (_samples(log, span, processing) for span in (_span(3.0, 6.0), _span(1.0, 9.0)))
    kept = np.isin(long.stamp_ns, short.stamp_ns)
    np.testing.assert_allclose(short.reading.values, long.reading.values[kept], rtol=0.0, atol=1e-10)  # 50 N
    np.testing.assert_allclose(short.reference, long.reference[kept], rtol=0.0, atol=1e-10)
    rows, middle = np.isin(LATE, short.stamp_ns), slice(300, 602)
    ended = recording(_joints(_stamps()[middle]), _sensor(LATE[rows], noisy[rows]))
    other = _samples(ended, replace(_span(3.01, 6.0), start_ns=int(LATE[301])), processing)
    assert np.abs(other.reference - short.reference[1:]).max() > 1e-6  # one-sided derivatives, or smoothing


def test_smoothing_keeps_the_relation_of_reading_and_reference() -> None:
    """One linear filter for both: counts that obey matrix and offset exactly still do, gaps of either included."""
    matrix = y_shaped_matrix(arm_m=0.02, counts_per_newton=60.0)
    joints = _joints(np.delete(_stamps(), np.arange(300, 400)))
    plain = _samples(recording(joints, _sensor(LATE)))
    counts = np.full((1000, 6), 7.0)
    counts[np.isin(LATE, plain.stamp_ns)] = np.linalg.solve(matrix, plain.reference.T).T
    counts[[0, 1, 50, 600]] = np.nan
    ft = stream(LATE, signal("raw", counts), name="ft")
    samples = _samples(recording(joints, ft), processing=SMOOTHED, quantity="raw")
    assert samples.dropped == 101 + 4
    decoded = samples.reading.values @ matrix.T
    np.testing.assert_allclose(decoded, samples.reference, rtol=0.0, atol=1e-10)  # rounding of 50 N over a window
    unfiltered = plain.reference[np.isin(plain.stamp_ns, samples.stamp_ns)]
    assert np.abs(decoded - unfiltered).max() > 1e-6


def test_only_the_needed_joints_have_to_be_logged() -> None:
    """Seen from the upper arm, only what hangs on the other side of the sensor counts: pitch and roll."""
    span = _span(0.0, 10.0, support="upper_arm")
    few = _samples(recording(_joints(_stamps(), ("shoulder_roll", "shoulder_pitch")), _sensor(LATE)), span)
    assert few.reference.tobytes() == _samples(_exact(), span).reference.tobytes()
    log = recording(_joints(_stamps(), tuple(joint for joint in JOINTS if joint != "elbow")), _sensor(LATE))
    with refused(RecordingError, "no stream holds the position of joint 'elbow'; "):
        _samples(log)


def _apart() -> Recording:
    return recording(_joints(_stamps() + 100 * 10**9), _sensor(LATE))


def _on_two_clocks() -> Recording:
    """Positions on the sensor's clock; velocities and accelerations on another."""
    whole = _joints(_stamps())
    rates = {key: held for key, held in whole.signals.items() if key != "position"}
    positions = replace(whole, signals={"position": whole.signals["position"]})
    return recording(positions, replace(whole, name="rates", clock="board", signals=rates), _sensor(LATE))


@pytest.mark.parametrize(
    ("log", "span", "match"),
    [
        (_exact, _span(0.0, 1.0, support=None, use=Use.IGNORE), "expected a support frame, got none"),
        (_exact, _span(-0.001, 1.0), r"expected a span inside the log, 0 to 10\.000 s, got -0\.001 to 1\.000 s"),
        (_exact, _span(9.0, 10.001), r"expected a span inside the log, 0 to 10\.000 s, got 9\.000 to 10\.001 s"),
        (_exact, _span(1.0, 1.003), "stream 'ft' has no sample in it to use"),
        (_apart, _span(0.1, 1.0), "streams 'ft' and 'joints' do not overlap in time: 90.006 s lie between them"),
        (_on_two_clocks, WHOLE, "'ft' and 'rates' were stamped by the clocks 'robot' and 'board'"),
        (lambda: recording(_joints(_stamps()), _sensor(LATE, np.full((1000, 6), np.nan))), WHOLE, "none of 1000 sam"),
    ],
)
def test_what_cannot_be_paired_is_refused(log: Any, span: Interval, match: str) -> None:
    """No support, no sample, no common time or clock, no complete sample: the error says which."""
    with refused(RecordingError, match):
        _samples(log(), span)


def test_an_interval_may_reach_the_last_sample() -> None:
    """The end is not included, so it lies one nanosecond behind the last stamp of the log."""
    log = recording(_joints(_stamps()), _sensor(_stamps()))
    assert len(_samples(log, replace(WHOLE, end_ns=log.span_ns[1] + 1))) == 1001
    assert len(_samples(log, WHOLE)) == 1000


def test_derivatives_on_another_clock_do_not_matter_unless_taken() -> None:
    """Where positions are differentiated, the log's own derivatives are not looked at."""
    assert len(_samples(_on_two_clocks(), processing=Processing())) == 1000


def test_samples_belong_together_and_stay() -> None:
    """Arrays of another length are refused, and nobody can change those that are held."""
    samples = _samples(_exact(), _span(1.0, 2.0))
    assert len(samples) == len(samples.reading.values) == 100
    with refused(ShapeError, r"reference: expected an array of shape \(100, 6\), got \(99, 6\)"):
        replace(samples, reference=samples.reference[1:])
    with refused(ShapeError, r"reading: expected an array of shape \(99, n\), got \(100, 6\)"):
        shorter = {"reference": samples.reference[1:], "flattening": samples.flattening[1:]}
        replace(samples, stamp_ns=samples.stamp_ns[1:], **shorter)
    for held in (samples.stamp_ns, samples.reference, samples.reading.values):
        with pytest.raises(ValueError, match="read-only"):
            held[0] = 0
