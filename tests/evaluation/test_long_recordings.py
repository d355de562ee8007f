# SPDX-License-Identifier: BSD-3-Clause
"""An evaluation of a long recording, whose segments are read one after the other, is that of the recording."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError, RecordingError
from forcetorque.evaluation.acceptance.acceptance import accept
from forcetorque.evaluation.acceptance.acceptance_file import AcceptanceFile
from forcetorque.evaluation.commands import evaluate
from forcetorque.evaluation.evaluation import Evaluation
from forcetorque.evaluation.sphere.sphere import spheres
from forcetorque.evaluation.trials.comparison import Comparison
from forcetorque.evaluation.trials.trials import read_trials
from forcetorque.evaluation.validation.validation import validation
from forcetorque.experiment.free_sub_model import SubModelChoice
from forcetorque.experiment.interval_samples import IntervalSamples
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.long_recording import is_long
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.validation_offset import Offset
from forcetorque.recording.fingerprint import window_hashes
from tests.scenes.campaigns import FITTED, by_day, run_of, two_days
from tests.scenes.experiments import PARQUET, write_experiments
from tests.scenes.segments import SEGMENT_S, short_segments, within

_ROUNDING = 1e-9
"""Sums over blocks against sums over all samples."""
_OF_LOAD = 1e-5
"""The grid on which joints are differentiated begins elsewhere in a segment."""
_OF_LOAD_ONCE = 1e-4
"""The same of a single sample."""


def _numbers(evaluation: Evaluation) -> list[tuple[str, object]]:
    """Every number and text of an evaluation, with its name."""

    def of(name: str, value: object) -> list[tuple[str, object]]:
        if isinstance(value, dict):
            return [one for key, item in value.items() for one in of(f"{name}.{key}", item)]
        if isinstance(value, list | tuple):
            return [one for item in value for one in of(name, item)]
        return [(name, value)]

    return of("", evaluation.model_dump())


@pytest.fixture(name="in_blocks")
def small_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Blocks of a hundred rows, mapped from files."""
    for name, size in (("BLOCK_ROWS", 100), ("IN_MEMORY", 4096), ("_WITHOUT_FILE", 0)):
        monkeypatch.setattr(f"forcetorque.base.rows_on_disk.{name}", size)


@pytest.mark.parametrize("sessions", [2, 1])
def test_an_evaluation_in_blocks_is_that_of_all_samples(
    recorded: Path, request: pytest.FixtureRequest, sessions: int
) -> None:
    """Every number and text; with the offset of a session, and where it was not fitted."""
    calibration = by_day(recorded)
    calibration = calibration.model_copy(update={"sessions": calibration.sessions[:sessions]})
    one = _numbers(evaluate(two_days(recorded), {"new": calibration}))
    request.getfixturevalue("in_blocks")
    other = _numbers(evaluate(two_days(recorded), {"new": calibration}))
    assert [name for name, _ in one] == [name for name, _ in other]
    for (name, value), (_, again) in zip(one, other, strict=True):
        expected = pytest.approx(value, rel=_ROUNDING, abs=1e-12) if isinstance(value, float) else value
        assert again == expected, name


@pytest.mark.usefixtures("in_blocks")
def test_an_evaluation_of_segments_is_that_of_the_recordings(recorded: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The same samples, errors and readings outside, though no sample of a whole recording is computed."""
    calibration = by_day(recorded)
    whole = evaluate(two_days(recorded), {"new": calibration})
    lengths: list[float] = []
    samples = SensorRun.interval_samples

    def measured(run: SensorRun, *args: Any, **options: Any) -> IntervalSamples:
        result = samples(run, *args, **options)
        lengths.append(float(np.ptp(result.samples.stamp_ns)) * 1e-9)
        return result

    monkeypatch.setattr(SensorRun, "interval_samples", measured)
    with short_segments():
        segmented = evaluate(two_days(recorded), {"new": calibration})
    assert 0.0 < max(lengths) < SEGMENT_S + 1.5
    for row, same in zip(whole.verdicts, segmented.verdicts, strict=True):
        assert (row.samples, row.offset, row.calibration) == (same.samples, same.offset, same.calibration)
        for name, of_load in (("rmse", _OF_LOAD), ("bias", _OF_LOAD), ("largest", _OF_LOAD_ONCE)):
            changes = np.abs(np.subtract(getattr(row, name), getattr(same, name)))
            assert (changes[:3] < of_load * row.load_N).all()
            assert (changes[3:] < of_load * row.load_Nm).all()
    for outside, same_outside in zip(whole.validity, segmented.validity, strict=True):
        assert (outside.samples, outside.outside) == (same_outside.samples, same_outside.outside)
    assert [case.decision for case in whole.load_cases] == [case.decision for case in segmented.load_cases]


@pytest.mark.usefixtures("in_blocks")
def test_a_validation_of_segments_is_that_of_the_recordings(recorded: Path) -> None:
    """Contact forces and joint torques with the offset of the first second of intervals, whose parts are many."""
    calibration, choice = by_day(recorded), SubModelChoice()
    whole = validation(two_days(recorded), {"new": calibration}, choice)
    with short_segments(3.0):
        campaign = two_days(recorded)
        assert all(is_long(run) for run in campaign.runs)
        segmented = validation(campaign, {"new": calibration}, choice)
    assert {row.offset for row in whole.contact_forces} == {Offset.FIRST_SECOND, Offset.FITTED}
    for row, same in zip(whole.contact_forces, segmented.contact_forces, strict=True):
        assert (row.samples, row.offset, row.calibration) == (same.samples, same.offset, same.calibration)
        np.testing.assert_allclose(same.mean_absolute[:3], row.mean_absolute[:3], atol=_OF_LOAD * row.excitation_N)
        np.testing.assert_allclose(same.bias[3:], row.bias[3:], atol=_OF_LOAD * row.excitation_Nm)
    assert len(whole.joint_torques) > 0
    for torque, same_torque in zip(whole.joint_torques, segmented.joint_torques, strict=True):
        assert (torque.samples, torque.joint) == (same_torque.samples, same_torque.joint)
        assert same_torque.rmse == pytest.approx(torque.rmse, abs=_OF_LOAD * row.excitation_Nm)
    assert (whole.left_out, whole.warnings) == (segmented.left_out, segmented.warnings)


def test_an_acceptance_of_segments_is_that_of_the_recordings(recorded: Path) -> None:
    """Every criterion with its number; offsets of intervals, and what the log lacks."""
    limits = {"force_mean_N": 5.0, "mean_absolute": {"fz": 5.0}}
    tables = {"evaluate": {"rmse": [9.0] * 6}, "validate": limits}
    spec = AcceptanceFile(schema="forcetorque/acceptance/1", name="limits", **tables, recording={"missing_share": 0.1})
    calibration = by_day(recorded)
    whole = accept(two_days(recorded), spec, ("new", calibration))
    with short_segments():
        segmented = accept(two_days(recorded), spec, ("new", calibration))
    assert len(whole.criteria) == 9
    for one, same in zip(whole.criteria, segmented.criteria, strict=True):
        assert (one.criterion, one.count, one.note) == (same.criterion, same.count, same.note)
        assert same.measured == pytest.approx(one.measured, rel=_OF_LOAD_ONCE, abs=1e-3)
    for checks, same_checks in zip(whole.recordings_measured, segmented.recordings_measured, strict=True):
        assert checks.recording == same_checks.recording
        for offset, same_offset in zip(checks.offsets, same_checks.offsets, strict=True):
            assert (offset.label, offset.samples) == (same_offset.label, same_offset.samples)
            assert same_offset.temperature_degC == pytest.approx(offset.temperature_degC, abs=1e-9)


def test_a_sphere_of_segments_is_that_of_the_recording(recorded: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """By all samples where they are few; by some of them where they are many, which is said."""
    (whole,) = spheres(run_of(recorded, FITTED)).analyses
    with short_segments(3.0):
        (segmented,) = spheres(run_of(recorded, FITTED)).analyses
        monkeypatch.setattr("forcetorque.evaluation.sphere.sensor_sphere._MOST", 200)
        thinned = spheres(run_of(recorded, FITTED))
        trials, failures = read_trials([recorded / FITTED])
    assert whole.reference is not None
    assert segmented.reference is not None
    scale = np.abs(whole.reference).max()
    np.testing.assert_array_equal(whole.force, segmented.force)
    assert np.abs(whole.reference - segmented.reference).max() < 3.0 * _OF_LOAD_ONCE * scale
    assert [words for words in Comparison.of(trials, failures, lambda _: None).warnings if "one of" in words] == [
        f"{trials[0].file}: {words}" for words in thinned.warnings
    ]
    (some,) = thinned.analyses
    assert some.every == -(-len(whole.force) // 200) > 1
    assert 150 < len(some.force) < 250
    assert f"one of {some.every} samples" in " ".join(thinned.warnings)


@pytest.mark.parametrize(
    ("stream", "lost"), [("arm_ft", "stream 'arm_ft' has no sample in it"), ("joints", "none of .* the joint")]
)
def test_a_sphere_of_segments_has_samples_of_every_interval(tmp_path: Path, stream: str, lost: str) -> None:
    """One of which none can be used is refused, as in the whole recording."""
    write_experiments(tmp_path)
    experiment = within(load_experiment(tmp_path / PARQUET), stream, 0.0, 14.2)
    with pytest.raises(RecordingError, match=f"interval 'judge': {lost}"):
        spheres(SensorRun(experiment, "arm_ft"))
    with short_segments(3.0), pytest.raises(RecordingError, match="interval 'judge': "):
        spheres(SensorRun(experiment, "arm_ft"))


def test_hashes_of_blocks_are_those_of_all_samples(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every window once, also those that reach across blocks."""
    values = np.random.default_rng(3).normal(size=(500, 6))
    values[100:130] = values[100]
    expected = window_hashes(values)
    monkeypatch.setattr("forcetorque.recording.fingerprint.BLOCK_ROWS", 37)
    np.testing.assert_array_equal(window_hashes(values), expected)
    assert len(expected) > 400


def test_a_long_recording_without_validation_interval_is_refused_in_words(recorded: Path) -> None:
    """As a short one is."""
    with short_segments(), pytest.raises(ExperimentError, match='expected an interval with use = "validation"'):
        evaluate(run_of(recorded, FITTED))
