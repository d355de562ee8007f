# SPDX-License-Identifier: BSD-3-Clause
"""Samples that say nothing of the load leave every fit and evaluation, are counted, and are what inspect names."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.calibration.calibrate import calibrate_for_file, calibrate_sensor
from forcetorque.calibration.joint.untouched_interval import joint_interval
from forcetorque.calibration.reduced_recordings import store_moments
from forcetorque.evaluation.commands import evaluate, validate
from forcetorque.experiment.calibration.calibration_file import Calibration, read_calibration
from forcetorque.experiment.calibration.stored_moments import read_moments
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.recording_notes import added_to
from forcetorque.experiment.sample_quality import sample_quality, unusable_in
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.inspection.findings import inspect_experiment
from forcetorque.payload.identify import weigh_load
from forcetorque.recording.frozen_and_saturated_samples import UnusableCounts
from forcetorque.recording.recording import Use
from forcetorque.recording.stream import QUANTITIES, Signal, Stream
from tests.scenes.experiments import JOINTS, MOUNTED, PARQUET, RATE_HZ, add
from tests.scenes.wrist_postures import write_postures

FIT, JUDGE = slice(100, 250), slice(900, 950)
"""Rows of 3 s in the calibration interval, and of 1 s in the validation interval."""


def _changed(experiment: Experiment, raw: FloatArray, *, stamp_ns: Any = None) -> Experiment:
    stream = experiment.recording.stream("arm_ft")
    signals = {"raw": replace(stream.signal("raw"), values=raw)}
    stamps = stream.stamp_ns if stamp_ns is None else stamp_ns
    streams = {**experiment.recording.streams, "arm_ft": replace(stream, signals=signals, stamp_ns=stamps)}
    return replace(experiment, recording=replace(experiment.recording, streams=streams))


def _raw(experiment: Experiment) -> FloatArray:
    return np.array(experiment.recording.stream("arm_ft").signal("raw").values)


def _fitted(experiment: Experiment, **options: Any) -> Calibration:
    return calibrate_sensor(SensorRun(experiment, "arm_ft"), code_version="test", created="test", **options)


def _damaged(experiment: Experiment) -> Experiment:
    """Frozen in either interval, at the limit in ten samples of the first, and three messages twice."""
    raw = _raw(experiment)
    raw[FIT], raw[JUDGE] = raw[FIT.start], raw[JUDGE.start]
    raw[300:310, 3] = 32767.0
    stamps = experiment.recording.stream("arm_ft").stamp_ns.copy()
    stamps[400:403] = stamps[399]
    return _changed(experiment, raw, stamp_ns=stamps)


COUNTS = UnusableCounts(frozen=150, saturated=10, repeated=3)


def test_what_says_nothing_of_the_load_is_not_fitted(arm: Path) -> None:
    """The fit is that of a log which lacks these samples; with them it would not be."""
    plain = load_experiment(arm / PARQUET)
    damaged = _damaged(plain)
    raw = _raw(damaged)
    raw[FIT] = raw[JUDGE] = raw[300:310] = np.nan
    lacking = _changed(damaged, raw, stamp_ns=damaged.recording.stream("arm_ft").stamp_ns)
    for options in ({}, {"kind": "CnTdTO"}):
        fit, without = _fitted(damaged, **options), _fitted(lacking, **options)
        assert np.array_equal(fit.matrix, without.matrix)
        assert (fit.provenance.samples, fit.provenance.dropped) == (without.provenance.samples, 163)
        assert fit.provenance.unusable == COUNTS
        assert without.provenance.unusable == UnusableCounts(repeated=3)
        assert np.abs(fit.matrix - _fitted(plain, **options).matrix).max() > 0.0


def test_the_readings_of_a_slow_sensor_are_smoothed_as_they_come(arm: Path) -> None:
    """Logged at 50 Hz, read at 6 Hz; negative control is a file that keeps what is repeated."""
    plain = load_experiment(arm / PARQUET)
    raw, matrix, stated = _raw(plain), _fitted(plain).matrix, (arm / PARQUET).read_text(encoding="utf-8")
    away = {}
    for kept in ("", 'keep = ["repeated"]'):
        file = arm / f"slow{len(kept)}.toml"
        file.write_text(
            f"{stated}\n[processing]\nsmoothing = {{ window_s = 0.5, order = 2 }}\n{kept}\n", encoding="utf-8"
        )
        fit = _fitted(_changed(load_experiment(file), raw[np.arange(len(raw)) // 8 * 8]))
        assert fit.provenance.unusable.repeated == (0 if kept else 592)
        away[kept] = np.abs(fit.matrix @ np.linalg.inv(matrix) - np.eye(6)).max()
    assert away[""] < 0.05 < 0.5 < away['keep = ["repeated"]']


@pytest.mark.parametrize(
    ("keep", "counts"),
    [
        ("saturated", UnusableCounts(frozen=150, repeated=3)),
        ("frozen", UnusableCounts(saturated=10, repeated=3)),
        ('frozen", "saturated', UnusableCounts(repeated=3)),
    ],
)
def test_what_is_to_be_kept_is_used_and_said(arm: Path, keep: str, counts: UnusableCounts) -> None:
    """Samples that the file keeps are not left out; messages that come twice have no time of their own."""
    add(arm / PARQUET, f'\n[processing]\nkeep = ["{keep}"]\n')
    damaged = _damaged(load_experiment(arm / PARQUET))
    (fit, *_) = damaged.intervals(Use.CALIBRATION)
    assert unusable_in(damaged, damaged.sensor("arm_ft"), fit) == counts
    (said,) = added_to(damaged.recording)
    assert said.endswith(f"as keep of [processing] states: {keep.replace(chr(34), '')}")


@pytest.mark.long
def test_the_counts_are_in_table_json_and_files(arm: Path, tmp_path: Path) -> None:
    """Calibration file and moments read back; the table and the JSON of results name interval and kind."""
    run = SensorRun(_damaged(load_experiment(arm / PARQUET)), "arm_ft")
    done = calibrate_for_file(run, tmp_path / "new.json", code_version="test", created="test").save()
    assert "163 left out (150 frozen, 10 saturated, 3 repeated)" in done.text(200)
    stored = read_calibration(tmp_path / "new.json")
    assert stored.provenance.unusable == COUNTS
    (moments,) = store_moments(run, tmp_path / "moments")
    assert read_moments(moments).intervals[0].unusable == COUNTS
    (row,) = json.loads(done.json_text())["unusable_samples"]
    assert (row["sensor"], row["interval"], row["use"]) == ("arm_ft", "fit", "calibration")
    for result in (evaluate(run, {"new": stored}), validate(run, {"new": stored})):
        judged = [row for row in result.unusable_samples if row.use == "validation"]
        assert [(row.interval, row.frozen, row.saturated, row.repeated) for row in judged] == [("judge", 50, 0, 0)]
        assert "unusable samples, which are left out" in result.text()
        assert json.loads(result.json_text())["unusable_samples"][1]["frozen"] == 50


@pytest.mark.long
def test_what_is_frozen_is_not_judged(arm: Path) -> None:
    """Errors are those of a log that lacks the frozen second."""
    plain = load_experiment(arm / PARQUET)
    calibrations = {"new": _fitted(plain)}
    raw = _raw(plain)
    raw[JUDGE] = raw[JUDGE.start]
    frozen = _changed(plain, raw)
    raw[JUDGE] = np.nan
    errors = [
        evaluate(SensorRun(experiment, "arm_ft"), calibrations).records()
        for experiment in (frozen, _changed(plain, raw), plain)
    ]
    assert errors[0] == errors[1] != errors[2]


def test_inspect_names_what_fits_leave_out(arm: Path) -> None:
    """Sample by sample, for frozen and saturated ones."""
    damaged = _damaged(load_experiment(arm / PARQUET))
    quality = sample_quality(damaged, damaged.sensor("arm_ft"))
    stamps = damaged.recording.stream("arm_ft").stamp_ns
    for kind, mask in (("frozen", quality.frozen), ("saturation", quality.saturated)):
        named = np.zeros(len(stamps), dtype=bool)
        for finding in inspect_experiment(damaged):
            if finding.kind == kind and finding.start_ns is not None and finding.end_ns is not None:
                named |= (stamps >= finding.start_ns) & (stamps <= finding.end_ns)
        assert np.array_equal(named, mask)


@pytest.fixture
def noise_free(arm: Path) -> Experiment:
    """What the true matrix reads of the model's wrench, without noise: the arm moves for 2 s of every 4 and rests."""
    plain = load_experiment(arm / PARQUET)
    stream = plain.recording.stream("arm_ft")
    time = (stream.stamp_ns - stream.stamp_ns[0]) * 1e-9
    done = np.clip(time % 4.0 / 2.0, 0.0, 1.0)
    turns = 1.0 + 0.3 * np.arange(len(JOINTS))
    phase = np.outer(time // 4.0 + done**3 * (10.0 - 15.0 * done + 6.0 * done**2), turns) + np.arange(len(JOINTS))
    speed = np.outer(0.5 * done**2 * (30.0 - 60.0 * done + 30.0 * done**2), turns)
    gain = np.outer(0.25 * done * (60.0 - 180.0 * done + 120.0 * done**2), turns)
    names, size = tuple(JOINTS), 1.2
    motion = {
        "position": size * np.sin(phase),
        "velocity": size * np.cos(phase) * speed,
        "acceleration": size * (np.cos(phase) * gain - np.sin(phase) * speed**2),
    }
    signals = {
        quantity: Signal(quantity=quantity, values=values, columns=names, units=(QUANTITIES[quantity].units[0],) * 5)
        for quantity, values in motion.items()
    }
    joints = Stream(name="joints", clock=stream.clock, stamp_ns=stream.stamp_ns, signals=signals)
    moved = replace(
        plain,
        recording=replace(plain.recording, streams={"arm_ft": stream, "joints": joints}),
        processing=replace(plain.processing, logged_derivatives=True),
    )
    start, end = stream.stamp_ns[[0, -1]].tolist()
    whole = replace(moved.recording.intervals[0], label="whole", start_ns=start, end_ns=end + 1)
    samples = SensorRun(moved, "arm_ft").interval_samples(whole, smoothed=False).samples
    assert len(samples) == len(stream)
    raw = samples.reference @ np.linalg.inv(MOUNTED).T
    return replace(_changed(moved, raw), processing=plain.processing)


@pytest.mark.parametrize("step", [0.0, 1.0, 100.0, 1000.0])
def test_a_resting_arm_loses_nothing(noise_free: Experiment, step: float) -> None:
    """Noise-free, and with steps of up to a thirtieth of the range: equal readings at rest are readings."""
    raw = _raw(noise_free)
    rounded = np.round(raw / step) * step if step else np.round(raw, 6)
    experiment = _changed(noise_free, rounded)
    run = SensorRun(experiment, "arm_ft")
    still = [f for f in inspect_experiment(experiment, by_model=False) if f.stream == "arm_ft" and f.kind == "stuck"]
    assert len([finding for finding in still if finding.channel == "raw"]) >= 4
    assert not sample_quality(experiment, run.sensor).frozen.any()
    assert not evaluate(run, {"new": _fitted(experiment)}).unusable_samples


def test_a_noise_free_reading_that_stays_while_the_arm_moves_is_frozen(noise_free: Experiment) -> None:
    """The noise does not say so; the model does."""
    raw = np.round(_raw(noise_free), 6)
    moving = slice(405, 495)  # of 4 s the first two move
    raw[moving] = raw[moving.start]
    experiment = _changed(noise_free, raw)
    frozen = np.flatnonzero(sample_quality(experiment, experiment.sensor("arm_ft")).frozen)
    assert (frozen[0], frozen[-1], len(frozen)) == (405, 494, 90)
    assert (frozen[-1] - frozen[0]) / RATE_HZ > 0.5
    named = [finding for finding in inspect_experiment(experiment) if finding.kind == "frozen"]
    assert [(finding.count, finding.stream) for finding in named] == [(90, "arm_ft")]


def test_a_channel_at_rest_and_a_wrong_limit_lose_nothing(arm: Path) -> None:
    """A broken gauge is named and stays; raw readings beyond the stated limit say that the limit is another's."""
    plain = load_experiment(arm / PARQUET)
    raw = _raw(plain)
    raw[:, 2] = raw[0, 2]
    run = SensorRun(_changed(plain, raw), "arm_ft")
    assert not sample_quality(run.experiment, run.sensor).unusable.any()
    wide = _changed(plain, 256.0 * _raw(plain))
    assert not sample_quality(wide, wide.sensor("arm_ft")).unusable.any()
    (limit,) = [finding for finding in inspect_experiment(wide, by_model=False) if finding.kind == "saturation"]
    assert "specify limit_counts of [[sensor]]" in limit.message


def test_a_log_that_is_frozen_all_over_says_so(arm: Path) -> None:
    """The error counts the samples that are left out."""
    plain = load_experiment(arm / PARQUET)
    with pytest.raises(Exception, match=r"say nothing of the load: \d+ frozen"):
        _fitted(_changed(plain, np.tile(_raw(plain)[:1], (len(_raw(plain)), 1))))


def test_what_is_frozen_or_stamped_again_weighs_nothing(tmp_path: Path) -> None:
    """A reading that froze while the wrist turned: the load is that of a log without it."""
    path = write_postures(tmp_path, seed=3, known=False)
    log = tmp_path / "log.csv"
    plain = log.read_text()
    lines = plain.splitlines()
    rows = [line.split(",") for line in lines[1:]]
    for row in rows[1200:1500]:  # the reading of the first posture in the second
        row[1:7] = rows[1199][1:7]
    log.write_text("\n".join([lines[0], *(",".join(row) for row in rows)]))
    frozen = weigh_load(SensorRun(load_experiment(path), "wrist"))
    log.write_text("\n".join([lines[0], *(",".join(row) for row in rows[:1199] + rows[1500:])]))
    lacking = weigh_load(SensorRun(load_experiment(path), "wrist"))
    assert [(row.frozen, row.interval) for row in frozen.unusable_samples] == [(301, "all")]
    assert not lacking.unusable_samples
    first, second = (json.loads(result.json_text()) for result in (frozen, lacking))
    assert first["loads"] == second["loads"]


@pytest.mark.real_data
def test_the_frozen_leg_of_a_real_robot_leaves_its_windows(data_dir: Path, tmp_path: Path) -> None:
    """Of 33 s on the left foot its leg's sensor repeats one reading for 9.3 s, and others for less than 0.1 s.

    The other three lose nothing.
    """
    text = (Path(__file__).parents[2] / "examples" / "23_icub_yoga_switching.toml").read_text(encoding="utf-8")
    path = tmp_path / "switching.toml"
    path.write_text(text.replace("../../shared/data", data_dir.as_posix()))
    experiment = load_experiment(path)
    names = [sensor.name for sensor in experiment.sensors]
    (left,) = [interval for interval in experiment.recording.intervals if interval.label == "left"]
    raw = joint_interval(experiment, left, names).raw
    lost = {name: windows.unusable for name, windows in raw.items() if windows.unusable}
    assert lost == {"l_leg_ft_sensor": UnusableCounts(frozen=930, repeated=12)}
    windows = raw["l_leg_ft_sensor"]
    gaps = windows.time_s[np.isnan(windows.means).any(axis=1)]
    # of what is frozen, and of eight samples that repeat a reading just before
    assert (gaps.min(), gaps.max(), len(gaps)) == (pytest.approx(25.7, abs=0.2), pytest.approx(35.2, abs=0.3), 40)
