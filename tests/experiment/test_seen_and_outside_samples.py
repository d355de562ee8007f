# SPDX-License-Identifier: BSD-3-Clause
"""Every command that applies a calibration says which readings lie outside what was fitted."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest

from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.calibration.export.commands import export_calibrations
from forcetorque.estimation.estimate import estimate_experiment
from forcetorque.estimation.result import summarise_estimates
from forcetorque.evaluation.acceptance.acceptance import accept
from forcetorque.evaluation.acceptance.acceptance_file import read_acceptance
from forcetorque.evaluation.commands import evaluate, validate
from forcetorque.experiment.calibration.calibration_file import Calibration, read_calibration, write_calibration
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.offsets import corrections_of
from forcetorque.experiment.seen_and_outside_samples import SamplesOutside, sentences
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Use
from forcetorque.recording.storage import read_recording, write_recording
from forcetorque.report.sensor_assessment import assess
from tests.scenes.experiments import PARQUET, edit

NAME = "new.json"
LIMITS = 'schema = "forcetorque/acceptance/1"\nname = "arm"\n\n[evaluate]\nforce_error_mean_N = 100.0\n'
STEP_COUNTS = np.array([2000.0, -1500.0, 800.0, 400.0, -900.0, 1200.0])
"""What a power-up adds to the counts; some 40 N."""


def _fitted(folder: Path) -> Calibration:
    return calibrate_sensor(SensorRun(load_experiment(folder / PARQUET), "arm_ft"), code_version="1", created="now")


def _change_judged(folder: Path, change: Callable[[np.ndarray], np.ndarray]) -> None:
    """Change the counts of the judged half."""
    recording = read_recording(folder / "recording")
    stream = recording.stream("arm_ft")
    judged = (stream.stamp_ns - recording.start_ns) * 1e-9 > 14.2
    signal = stream.signal("raw")
    values = np.where(judged[:, None], change(signal.values), signal.values)
    changed = replace(stream, signals={"raw": replace(signal, values=values)})
    write_recording(folder / "recording", replace(recording, streams={**recording.streams, "arm_ft": changed}))


@pytest.fixture
def whole(arm: Path) -> Calibration:
    """Calibration of the arm on all of its recording, so that no reading lies outside."""
    stated = (arm / PARQUET).read_text(encoding="utf-8")
    edit(arm / PARQUET, "end_s = 14.0", "end_s = 23.6")
    edit(arm / PARQUET, "start_s = 14.5\nend_s = 23.5", "start_s = 23.7\nend_s = 23.9")
    calibration = _fitted(arm)
    (arm / PARQUET).write_text(stated, encoding="utf-8")
    # judged on what it has seen, which is refused: as if another recording had been fitted
    other = calibration.provenance.model_copy(update={"intervals": ()})
    return calibration.model_copy(update={"provenance": other})


def _row(folder: Path, calibration: Calibration) -> tuple[SamplesOutside, tuple[str, ...]]:
    result = evaluate(SensorRun(load_experiment(folder / PARQUET), "arm_ft"), {NAME: calibration})
    (row,) = result.validity
    return row, result.warnings


def test_readings_inside_give_no_word(arm: Path, whole: Calibration) -> None:
    """All of the motion was fitted: none lies outside, and no sentence is made."""
    row, warnings = _row(arm, whole)
    assert (row.outside, row.force_N, row.force_component, row.predicted_force_error_N) == (0, 0.0, None, None)
    assert row.sentences == ()
    assert warnings == ()


def test_a_power_up_gives_no_word_where_its_offset_is_known_by_the_reference(arm: Path, whole: Calibration) -> None:
    """A session that was not fitted has an offset of its own, which the reference tells; without it all are outside."""
    _change_judged(arm, lambda raw: raw + STEP_COUNTS)
    edit(arm / PARQUET, 'label = "judge"\n', 'label = "judge"\nsession = "next day"\n')
    row, _ = _row(arm, whole)
    assert row.outside == 0
    assert row.offset_known
    experiment = load_experiment(arm / PARQUET)
    corrections = corrections_of(experiment, {NAME: whole})
    summary = summarise_estimates(experiment, corrections, estimate_experiment(experiment, corrections))
    (estimated,) = summary.validity  # no reference here: it cannot tell offset from load, and says so
    assert estimated.outside > 400
    assert "their session was not fitted" in estimated.sentences[0]


def test_a_load_that_was_not_fitted_is_named_with_its_predicted_error(arm: Path, whole: Calibration) -> None:
    """Twice the load: by how much, in which component, and what error the posterior expects of it."""
    mean = np.linalg.solve(whole.matrix, -whole.offset)
    _change_judged(arm, lambda raw: mean + 2.0 * (raw - mean))
    row, warnings = _row(arm, whole)
    assert row.share > 0.3
    assert row.force_N > 20.0
    assert row.predicted_force_error_N is not None
    (words,) = warnings
    assert words == row.sentences[0]
    assert words.startswith(f"{NAME}: {100 * row.share:.3g} % of 450 readings lie outside what was fitted, by up to ")
    assert "; predicted error there " in words
    _, plain = _row(arm, whole.model_copy(update={"posterior": None}))
    assert "predicted" not in plain[0]


@pytest.mark.long
def test_every_question_gives_the_same_answer(arm: Path) -> None:
    """Evaluate, validate, accept and assess: one row each, and its sentence among the warnings once."""
    calibration = _fitted(arm)
    run = SensorRun(load_experiment(arm / PARQUET), "arm_ft")
    (arm / "limits.toml").write_text(LIMITS, encoding="utf-8")
    spec = read_acceptance(arm / "limits.toml")
    answers = {
        "evaluate": evaluate(run, {NAME: calibration}),
        "validate": validate(run, {NAME: calibration}),
        "accept": accept(run, spec, (NAME, calibration)),
        "assess": assess(run, {NAME: calibration}),
    }
    expected = answers["evaluate"].validity[0].flat()
    assert 0 < int(str(expected["outside"])) < 100
    for answer in answers.values():
        assert [row.flat() for row in answer.validity] == [expected]
        words = sentences(answer.validity)
        assert [warning for warning in answer.warnings if "outside what was fitted" in warning] == list(words)
    assert sum("outside what was fitted" in line.text for line in answers["assess"].verdict) == 1
    assert not evaluate(run, {}).validity  # a prior was fitted to nothing


@pytest.mark.long
def test_estimates_have_a_flag_per_sample(arm: Path) -> None:
    """In the table as often as the summary says; a gap has neither; without a calibration there is no column."""
    experiment, file = load_experiment(arm / PARQUET), arm / "estimates.parquet"
    for calibrations in ({NAME: _fitted(arm)}, {}):
        corrections = corrections_of(experiment, calibrations)
        spans = estimate_experiment(experiment, corrections)
        summary = summarise_estimates(experiment, corrections, spans, file=file)
        table = pq.read_table(file)
        assert ("outside.arm_ft" in table.column_names) == bool(calibrations)
        if calibrations:
            (row,) = summary.validity
            flags = table.column("outside.arm_ft").to_pylist()
            assert set(flags) == {True, False}
            assert (flags.count(True), len(flags)) == (row.outside, row.samples)
            judged = [flag for flag, label in zip(flags, table.column("interval").to_pylist(), strict=True) if flag]
            assert len(judged) == flags.count(True)
            assert summary.warnings == row.sentences


def test_a_gap_is_neither_inside_nor_outside(arm: Path) -> None:
    """Its cell is empty."""
    calibration = _fitted(arm)
    _change_judged(arm, lambda raw: np.where(np.arange(len(raw))[:, None] % 400 < 20, np.nan, raw))
    experiment, file = load_experiment(arm / PARQUET), arm / "estimates.parquet"
    corrections = corrections_of(experiment, {NAME: calibration})
    summarise_estimates(experiment, corrections, estimate_experiment(experiment, corrections), file=file)
    table = pq.read_table(file).to_pydict()
    empty = [flag is None for flag in table["outside.arm_ft"]]
    assert any(empty)
    assert empty == [value is None for value in table["measured.arm_ft.fx"]]


def test_an_export_says_which_loads_were_fitted(arm: Path) -> None:
    """Per component the range that the calibration reads over the fitted samples; of older files that they lack it."""
    calibration = _fitted(arm)
    entry = export_calibrations({NAME: calibration}, "csv").calibrations[0]
    (part,) = SensorRun(load_experiment(arm / PARQUET), "arm_ft").samples(Use.CALIBRATION)
    wrench = calibration.model.wrench(part.raw)
    assert np.allclose(entry.fitted_minimum, wrench.min(axis=0), atol=0.02 * np.abs(wrench).max())
    assert np.allclose(entry.fitted_maximum, wrench.max(axis=0), atol=0.02 * np.abs(wrench).max())
    assert "arm_ft: fitted loads, outside which it extrapolates: fx " in entry.fitted_text
    validity = calibration.validity.model_copy(update={"loads": None})
    older = export_calibrations(calibration.model_copy(update={"validity": validity}), "csv").calibrations[0]
    assert "does not hold which loads were fitted" in older.fitted_text


def test_files_of_earlier_versions_are_read_and_judged_by_their_channels(arm: Path) -> None:
    """Without the fitted loads the ranges of the channels stand for them; the schema is the same."""
    file = arm / "older.json"
    write_calibration(file, _fitted(arm))
    content = json.loads(file.read_text(encoding="utf-8"))
    del content["validity"]["loads"]
    file.write_text(json.dumps(content), encoding="utf-8")
    older = read_calibration(file)
    row, _ = _row(arm, older)
    assert 0 < row.outside < row.samples
