# SPDX-License-Identifier: BSD-3-Clause
"""A study beside the generative model, and judged at loads that were not fitted."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import FormatError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.experiment.calibration.calibration_file import read_calibration, write_calibration
from forcetorque.experiment.calibration.estimation_type import ESTIMATION_TYPES
from forcetorque.experiment.campaign import Campaign
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.validation_offset import Offset
from forcetorque.simulation.recordings import true_matrix
from forcetorque.study import thesis_tables as tables
from forcetorque.study.candidate_errors import push_error
from forcetorque.study.candidate_selection import FAR_SD, Candidate
from forcetorque.study.result import studied_sensor, study_warnings
from forcetorque.study.study import SensorStudy, study_sensor
from forcetorque.study.study_data import StudyData, read_study_data
from tests.scenes.experiments import edit
from tests.scenes.studies import CALIBRATION, FILES, SENSOR, SERIAL, VALIDATION, scenario

SAME = 1e-9
"""Relative rounding of double precision times the condition of the fit."""
_OPTIONS = {"sphere": None, "code_version": "1", "created": "now", "lambdas": (0.0, 600.0)}


def _write_truth(folder: Path, *, serial: str = SERIAL) -> None:
    matrix = scenario().specimens[SENSOR].sensor.matrix.tolist()
    text = {"schema": "forcetorque/truth/1", "sensors": {SENSOR: {"serial": serial, "matrix": matrix}}}
    (folder / "truth.json").write_text(json.dumps(text), encoding="utf-8")


def _data(folder: Path) -> StudyData:
    (data,) = read_study_data([folder / file for file in FILES], None)
    return data


def _study(data: StudyData, *kinds: str) -> SensorStudy:
    types = [ESTIMATION_TYPES[kind] for kind in kinds or ("OnTdTO", "OwTrTO")]
    return study_sensor(data, data_sets=None, kinds=types, **_OPTIONS)


@pytest.fixture
def short(days: Path) -> Path:
    """The same days, of which only three seconds of one joint's motion are fitted, with the truth beside them."""
    edit(days / "grid_cold.toml", "end_s = 19.75", "end_s = 3.0")
    _write_truth(days)
    return days


def _short(folder: Path) -> SensorStudy:
    (data,) = read_study_data([folder / file for file in ("grid_cold.toml", *VALIDATION)], None)
    return _study(data, "OnTdTO")


@pytest.mark.long
def test_the_generative_fit_of_a_data_set_is_that_of_calibrate(recorded: Path) -> None:
    """Matrix, offsets of the sessions and posterior, for every combination."""
    data = _data(recorded)
    study = _study(data).study
    assert [fit.name for fit in study.generative] == [f"{c.name} generative" for c in study.fits.combinations]
    runs = [SensorRun(load_experiment(recorded / file), SENSOR) for file in CALIBRATION]
    alone = calibrate_sensor(Campaign(runs), kind="generative", code_version="1", created="now")
    every = study.generative[-1]
    np.testing.assert_allclose(every.model.matrix, alone.matrix, rtol=SAME, atol=SAME * np.abs(alone.matrix).max())
    assert {name: offset.tolist() for name, offset in every.offsets.items()} == {
        session.name: session.offset.tolist() for session in alone.sessions
    }
    assert alone.posterior is not None
    assert np.array_equal(every.posterior.covariance, alone.posterior.covariance)
    errors = np.concatenate(
        [
            replace(every.model, offset=every.offsets[one.session]).wrench(one.raw, one.variables) - one.reference
            for one in (interval.data_set for interval in data.calibration)
        ]
    )
    np.testing.assert_allclose(every.squared_error, (errors**2).mean(axis=0), rtol=1e-6)


@pytest.mark.long
def test_a_generative_fit_that_is_best_is_written_with_its_posterior(recorded: Path, tmp_path: Path) -> None:
    """Where a lambda leaves all types far behind, the choice and each of its rows is the generative fit."""
    study = study_sensor(
        _data(recorded),
        data_sets={"all": ["grid", "random"]},
        kinds=[ESTIMATION_TYPES["OnTdTO"]],
        **(_OPTIONS | {"lambdas": (6e12,)}),
    )
    for name, calibration in study.calibrations.items():
        assert calibration.estimation_type == "generative"
        assert calibration.posterior is not None
        assert calibration.lambda_counts2 is None
        assert "all generative" in calibration.selection.rule
        assert [interval.label for interval in calibration.selection.chosen_on] == ["day_1", "day_2"]
        write_calibration(tmp_path / f"{name}.json", calibration)
        assert read_calibration(tmp_path / f"{name}.json").posterior is not None
    best = studied_sensor(study).modes[0].best
    assert (best.name, best.lambda_counts2, best.table_lambda_counts2, best.relative_lambda) == (
        "all generative", None, None, None,
    )  # fmt: skip


@pytest.mark.long
def test_a_judged_session_that_was_fitted_is_read_with_its_offset(days: Path) -> None:
    """By the generative fit, which has one per session; the offset of another session is worse."""
    text = (days / "day_1.toml").read_text(encoding="utf-8")
    fitted = '[[interval]]\nlabel = "begin"\nstart_s = 0.5\nend_s = 4.0\nuse = "calibration"\nsupport = "base"\n'
    session = next(line for line in text.splitlines() if line.startswith("session"))
    text = text.replace("start_s = 0.5", "start_s = 5.0") + f'\n{fitted}kind = "random"\n{session}\n'
    (days / "day_1.toml").write_text(text, encoding="utf-8")
    (data,) = read_study_data([days / file for file in ("day_1.toml", *CALIBRATION, VALIDATION[1])], None)
    study = study_sensor(data, data_sets={"all": ["grid", "random"]}, kinds=[ESTIMATION_TYPES["OnTdTO"]], **_OPTIONS)
    (fit,) = study.study.generative
    assert list(fit.offsets) == ["power-up 1", "power-up 0"]
    index = len(study.study.fits.candidates)
    force = study.study.errors[Offset.FITTED].pooled(["power-up 1"]).force_mean[index]
    elsewhere = study.study.errors[Offset.FITTED].pooled(["power-up 2"]).force_mean[index]
    assert force < 0.3 * elsewhere


@pytest.mark.long
def test_the_truth_beside_simulated_files_gives_the_error_of_every_candidate(days: Path) -> None:
    """In the table and in the choice; without it, or that of another serial number, there are no such columns."""
    _write_truth(days)
    data = _data(days)
    truth = scenario().specimens[SENSOR].sensor.matrix
    assert data.truth is not None
    np.testing.assert_array_equal(data.truth, truth)
    study = _study(data)
    rows = tables.candidate_rows(study.study)
    for row, model in zip(rows, study.study.models, strict=True):
        error = push_error(model.matrix, truth)
        assert (row["push_force_N"], row["push_moment_Nm"]) == (error.force_N, error.moment_Nm)
    mode = studied_sensor(study).modes[0]
    assert (
        mode.best.unfitted.push_force_N == rows[study.study.choices[Offset.FIRST_SECOND].by_magnitude]["push_force_N"]
    )
    # the artefact is fitted again
    written = push_error(study.calibrations["best_by_axis_offset_first_second"].matrix, truth)
    assert mode.by_axis_unfitted.push_force_N == pytest.approx(written.force_N, rel=1e-6)
    _write_truth(days, serial="SIM999")
    assert _data(days).truth is None


def test_no_truth_is_no_error_and_a_broken_one_is(days: Path) -> None:
    """One line that names the file."""
    file = days / FILES[0]
    assert true_matrix(file, sensor=SENSOR, serial=SERIAL) is None
    for content in ("{", '{"schema": "other"}', '{"schema": "forcetorque/truth/1", "sensors": {"arm_ft": {}}}'):
        (days / "truth.json").write_text(content, encoding="utf-8")
        with pytest.raises(FormatError, match="truth.json"):
            true_matrix(file, sensor=SENSOR, serial=SERIAL)
    _write_truth(days)
    assert true_matrix(file, sensor="leg_ft", serial=SERIAL) is None


def test_a_choice_that_makes_pushes_worse_is_a_warning(short: Path) -> None:
    """A type that lets noise replace the prior where no load speaks; the generative fit of the same data does not."""
    study = _short(short)
    core = study.study
    before = core.push_error(len(core.models) - 1)
    assert before is not None
    harmful = [k for k, candidate in enumerate(core.candidates) if core.push_error(k).over(before) > 1.05]  # type: ignore[union-attr]
    assert harmful
    assert all(isinstance(core.candidates[k], Candidate) for k in harmful)
    # of those that may be chosen, what the generative fit predicts finds them without the truth
    far = core.push_deviations.max(axis=1) > FAR_SD
    assert all(far[k] for k in harmful if core.push_error(k).over(before) > 2.0)  # type: ignore[union-attr]
    assert not far[len(core.fits.candidates) :].any()


def test_every_choice_that_is_far_or_harmful_is_named(short: Path) -> None:
    """Whatever is recommended, a warning stands beside it unless it is near the default and no worse than the prior."""
    study = _short(short)
    sentences = study_warnings(study)
    core = study.study
    before = core.push_error(len(core.models) - 1)
    assert before is not None
    for mode in studied_sensor(study).modes:
        for name, load in (("best", mode.best.unfitted), ("best by axis", mode.by_axis_unfitted)):
            said = [s for s in sentences if s.startswith(f"{SENSOR}: {name}, offset {mode.offset}: ")]
            assert load.push_force_N is not None
            assert load.push_moment_Nm is not None
            assert load.deviation_sd is not None
            worse = load.push_force_N > 1.05 * before.force_N or load.push_moment_Nm > 1.05 * before.moment_Nm
            assert len(said) == worse + (load.deviation_sd > FAR_SD)
