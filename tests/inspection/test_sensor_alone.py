# SPDX-License-Identifier: BSD-3-Clause
"""`inspect` of the log of a sensor by itself: rate, losses, repeats, noise, drift, tares and clipping, answer first."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.inspection.inspect import Inspection, inspect_log
from forcetorque.inspection.sensor_alone import SensorAlone, sensor_alone
from forcetorque.recording.recording import Recording
from forcetorque.recording.stream import Signal, Stream
from tests.app.outcome import Run

RATE_HZ, SECONDS = 200.0, 30.0
NOISE = np.array([0.02, 0.02, 0.03, 1e-3, 1e-3, 1e-3])
LEVEL = np.array([1.0, 2.0, -5.0, 0.1, 0.2, 0.3])
SPREAD = 0.2
"""Spread of an estimate of noise from the quietest quarter of 94 blocks of 64 samples: 0.07, and less than three."""
STATED = "time_s,Fx [N],Fy [N],Fz [N],Mx [Nm],My [Nm],Mz [Nm]"
BARE = "t,fx,fy,fz,tx,ty,tz"


def _clean() -> tuple[FloatArray, FloatArray]:
    time = np.arange(int(RATE_HZ * SECONDS)) / RATE_HZ
    return time, LEVEL + NOISE * np.random.default_rng(7).normal(size=(len(time), 6))


def _inspected(folder: Path, time: FloatArray, wrench: FloatArray, head: str = STATED) -> Inspection:
    rows = np.column_stack([time, wrench])
    lines = (",".join(f"{value:.7g}" for value in row) for row in rows)
    (folder / "ft.csv").write_text("\n".join([head, *lines]) + "\n")
    return inspect_log(folder / "ft.csv")


def _sensor(inspection: Inspection) -> SensorAlone:
    assert inspection.sensor is not None
    return inspection.sensor


def _kinds(inspection: Inspection) -> set[str]:
    return {row.kind for row in inspection.findings}


def test_a_clean_log_has_its_rate_and_noise_and_nothing_else(tmp_path: Path) -> None:
    """Negative control of all below: a drift below its interval is not stated as one."""
    inspection = _inspected(tmp_path, *_clean())
    sensor = _sensor(inspection)
    assert inspection.findings == ()
    assert sensor.rate_hz == pytest.approx(RATE_HZ, rel=1e-6)
    assert (sensor.lost_samples, sensor.repeated_stamps, sensor.clipped_samples, sensor.tares_s) == (0, 0, 0, ())
    np.testing.assert_allclose(sensor.noise, NOISE, rtol=SPREAD)
    assert sensor.drift_per_hour is not None
    assert sensor.drift_half_width_95_per_hour is not None
    assert np.all(np.abs(sensor.drift_per_hour) < 2.0 * np.array(sensor.drift_half_width_95_per_hour))
    assert next(inspection.answers()).verdict == "200 Hz, NOTHING LOST"
    assert sensor.assumed == ()


def test_a_tare_a_drift_and_a_tap_that_clips_are_told_apart(tmp_path: Path) -> None:
    """The drift goes on behind the tare; the tap moves neither, and stays at the end of the range."""
    time, wrench = _clean()
    wrench[:, 2] += 36.0 / 3600.0 * time
    wrench[2000:2040, 2] = np.minimum(wrench[2000:2040, 2] + 60.0 * np.exp(-np.arange(40) / 10.0), 20.0)
    wrench[4000:] -= wrench[3800:4000].mean(axis=0)
    inspection = _inspected(tmp_path, time, wrench)
    sensor = _sensor(inspection)
    assert sensor.tares_s == pytest.approx((20.0,), abs=0.011)
    assert sensor.drift_per_hour is not None
    assert sensor.drift_half_width_95_per_hour is not None
    assert abs(sensor.drift_per_hour[2] - 36.0) < 2.0 * sensor.drift_half_width_95_per_hour[2] < 10.0
    assert _kinds(inspection) == {"tare", "clipped"}
    (clipped,) = (row for row in inspection.findings if row.kind == "clipped")
    assert (clipped.channel, clipped.size) == ("fz", 20.0)
    assert clipped.count == sensor.clipped_samples > 3


def test_samples_without_a_value_are_counted_and_not_clipped(tmp_path: Path, run: Run) -> None:
    """The verdict names them; the table and JSON hold no NaN."""
    time, wrench = _clean()
    wrench[2000:2020] = np.nan
    inspection = _inspected(tmp_path, time, wrench)
    sensor = _sensor(inspection)
    assert (sensor.missing_samples, sensor.clipped_samples, sensor.stuck) == (20, 0, ())
    assert sensor.drift_per_hour is not None
    assert next(inspection.answers()).verdict == "200 Hz, 20 samples without a value"
    result = run("inspect", tmp_path / "ft.csv", "--format", "json").result()
    assert [finding["kind"] for finding in result["findings"]] == ["missing"]


@pytest.mark.parametrize(("value", "verdict"), [(5.0, "fx stuck"), (np.nan, "6000 samples without a value")])
def test_a_dead_channel_is_named_and_leaves_the_others_theirs(tmp_path: Path, value: float, verdict: str) -> None:
    """Noise and drift of the other components are those of a log without it."""
    time, wrench = _clean()
    wrench[:, 0] = value
    inspection = _inspected(tmp_path, time, wrench)
    sensor = _sensor(inspection)
    np.testing.assert_allclose(sensor.noise, [0.0, *NOISE[1:]], rtol=SPREAD)
    assert sensor.drift_per_hour is not None
    assert sensor.drift_half_width_95_per_hour is not None
    assert sensor.drift_half_width_95_per_hour[0] == 0.0
    assert min(sensor.drift_half_width_95_per_hour[1:]) > 0.0
    assert next(inspection.answers()).verdict == f"200 Hz, {verdict}"


@pytest.mark.long
def test_white_noise_has_a_drift_in_one_of_twenty_logs_at_most() -> None:
    """The half-widths are those of all six components at once: 95 % of 200 logs have none beyond its own."""
    stamps = np.arange(220, dtype=np.int64) * 50_000_000
    drifting = 0
    for seed in range(200):
        values = NOISE * np.random.default_rng(seed).normal(size=(len(stamps), 6))
        stream = Stream(
            name="ft",
            clock="log",
            stamp_ns=stamps,
            signals={"wrench": Signal.of_fixed("wrench", values, frame="ft")},
        )
        summary = sensor_alone(Recording(streams={"ft": stream}), ())
        assert summary is not None
        drift, half_width = summary[0].drift_per_hour, summary[0].drift_half_width_95_per_hour
        assert drift is not None
        assert half_width is not None
        drifting += any(abs(value) > width for value, width in zip(drift, half_width, strict=True))
    assert 0 < drifting <= 10


def test_packets_that_come_in_bursts_lose_nothing(tmp_path: Path) -> None:
    """Jitter is no gap: stamps of eight samples are those of their packet, and a late packet is made up for."""
    time, wrench = _clean()
    number = np.arange(len(time))
    burst = (number // 8 * 8) / RATE_HZ + 1e-5 * (number % 8)
    burst[800:816] = burst[815] + 0.02 + 1e-5 * np.arange(16)
    sensor = _sensor(_inspected(tmp_path, burst, wrench))
    assert (sensor.lost_samples, sensor.repeated_stamps) == (0, 0)
    assert sensor.rate_hz == pytest.approx(RATE_HZ, rel=1e-3)
    assert sensor.jitter_ms > 5.0


def test_lost_samples_and_repeated_stamps_are_counted(tmp_path: Path) -> None:
    """By time, also where a message comes twice."""
    time, wrench = _clean()
    kept = np.ones(len(time), dtype=bool)
    kept[3000:3020] = kept[5000] = False
    rows = np.sort(np.concatenate([np.flatnonzero(kept), [100, 101, 102]]))
    inspection = _inspected(tmp_path, time[rows], wrench[rows])
    sensor = _sensor(inspection)
    assert (sensor.lost_samples, sensor.repeated_stamps) == (21, 3)
    assert [row.count for row in inspection.findings if row.kind == "lost_samples"] == [20, 1]
    assert "gap" not in _kinds(inspection)


def test_a_sensor_that_is_slower_than_its_log_is_told_by_its_repeats(tmp_path: Path) -> None:
    """Every reading comes twice, with stamps of its own; the noise is that of the readings."""
    time, wrench = _clean()
    inspection = _inspected(tmp_path, time, wrench[np.arange(len(time)) // 2 * 2])
    sensor = _sensor(inspection)
    assert sensor.repeated_samples == len(time) // 2
    np.testing.assert_allclose(sensor.noise, NOISE, rtol=SPREAD)
    assert "50 % of samples repeat the one before: 100 Hz" in next(inspection.answers()).verdict


def test_what_the_headings_do_not_state_is_assumed_aloud(tmp_path: Path) -> None:
    """As lines of an experiment file; a log in milliseconds has the rate that is usual."""
    time, wrench = _clean()
    inspection = _inspected(tmp_path, 1e3 * time, wrench, BARE)
    sensor = _sensor(inspection)
    assert sensor.rate_hz == pytest.approx(RATE_HZ, rel=1e-6)
    assert 'stamp = { column = "t", unit = "ms" }' in sensor.assumed
    assert any("assumed, as the file does not state it: stamp" in text for text in next(inspection.answers()).why)


def test_a_log_of_a_robot_is_no_sensor_by_itself(tmp_path: Path) -> None:
    """Its columns are listed, and it waits for its experiment file."""
    time, wrench = _clean()
    head = f"{STATED},j1 [rad],j2 [rad],j3 [rad],qx,qy,qz,qw"
    inspection = _inspected(
        tmp_path, time, np.hstack([wrench, np.zeros((len(time), 6)), np.ones((len(time), 1))]), head
    )
    assert inspection.sensor is None
    assert inspection.streams == {}
    assert [answer.verdict for answer in inspection.answers()] == ["NEEDS A FILE"]


def test_a_table_that_is_too_long_to_be_read_at_once_is_listed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its columns are, some rows at a time."""
    monkeypatch.setattr("forcetorque.inspection.draft.recording_table.MOST_ROWS", 1000)
    inspection = _inspected(tmp_path, *_clean())
    assert inspection.sensor is None
    assert len(inspection.unread) == 7


def test_the_answer_comes_first_in_few_lines(tmp_path: Path, run: Run) -> None:
    """Twelve at most; JSON has the numbers."""
    time, wrench = _clean()
    _inspected(tmp_path, time, wrench)
    lines = run("inspect", tmp_path / "ft.csv").out.splitlines()
    assert len(lines) <= 12
    assert "200 Hz, NOTHING LOST" in lines[0]
    assert run("inspect", tmp_path / "ft.csv", "--format", "json").result()["sensor"]["samples"] == len(time)
