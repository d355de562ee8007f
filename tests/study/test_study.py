# SPDX-License-Identifier: BSD-3-Clause
"""The study of a sensor: which data are combined, and the calibrations that are made of the best candidates."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FitError
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.calibration.thesis.calibrate import CalibrationFit, calibrate
from forcetorque.evaluation.commands import evaluate
from forcetorque.experiment.calibration.artefact import read_calibration, write_calibration
from forcetorque.experiment.calibration.estimation_type import ESTIMATION_TYPES
from forcetorque.experiment.campaign_intervals import CampaignInterval
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.validation_offset import KNOWN_BEFORE, Offset
from forcetorque.study.result import Studies, studied_sensor, study_warnings
from forcetorque.study.selection import Candidate, GenerativeCandidate
from forcetorque.study.study import SensorStudy, combinations_of, study_sensor
from forcetorque.study.study_data import StudyData, read_study_data
from tests.results.showing import require_shown
from tests.scenes.experiments import PARQUET, edit
from tests.scenes.studies import CALIBRATION, FILES, SERIAL, VALIDATION, scenario

SAME = 1e-8
"""Relative: rounding of double precision times the condition of the raw readings and of the temperature, some 1e6."""

LAMBDAS = (0.0, 600.0, 6e5)
NAMES = {
    (source, by): f"{by}_offset_{source.replace('-', '_')}"
    for source in KNOWN_BEFORE
    for by in ("best", "best_by_axis")
}
BOTH = pytest.mark.parametrize("source", list(KNOWN_BEFORE))


def _study(data: StudyData, **changes: Any) -> SensorStudy:
    options: dict[str, Any] = {
        "data_sets": None,
        "kinds": list(ESTIMATION_TYPES.values()),
        "lambdas": LAMBDAS,
        "sphere": ["grid_cold"],
        "code_version": "1.2.3",
        "created": "today",
    }
    return study_sensor(data, **(options | changes))


@pytest.fixture(scope="module")
def data(recorded: Path) -> StudyData:
    """The recordings of three days."""
    (found,) = read_study_data([recorded / file for file in FILES], None)
    return found


@pytest.fixture(scope="module")
def made(data: StudyData) -> SensorStudy:
    """A study of them: three combinations, nine types, three lambdas."""
    return _study(data)


def _of_kinds(data: StudyData, kinds: Sequence[str]) -> list[CampaignInterval]:
    """An interval per kind, numbered."""
    return [replace(data.calibration[0], label=f"{k}_{kind}", kind=kind) for k, kind in enumerate(kinds)]


def test_kinds_are_combined_in_every_way(data: StudyData) -> None:
    """Fewest first, in the order of the files; all intervals of a kind go together."""
    assert combinations_of(data.calibration) == {
        "grid": ("grid_cold", "grid_warm"),
        "random": ("move_cold", "move_warm"),
        "grid + random": ("grid_cold", "grid_warm", "move_cold", "move_warm"),
    }
    assert combinations_of(_of_kinds(data, "abac")) == {
        "a": ("0_a", "2_a"),
        "b": ("1_b",),
        "c": ("3_c",),
        "a + b": ("0_a", "1_b", "2_a"),
        "a + c": ("0_a", "2_a", "3_c"),
        "b + c": ("1_b", "3_c"),
        "a + b + c": ("0_a", "1_b", "2_a", "3_c"),
    }
    assert len(combinations_of(_of_kinds(data, "abcdef"))) == 63


def test_too_many_kinds_or_none_are_refused(data: StudyData) -> None:
    """127 combinations are nobody's wish; the message says how to choose."""
    with pytest.raises(ExperimentError, match="at most 6 kinds of data .* got 7: a, b, c, d, e, f, g; name combin"):
        combinations_of(_of_kinds(data, "abcdefg"))
    with pytest.raises(ExperimentError, match='expected at least one interval with use = "calibration", got none'):
        combinations_of([])


@pytest.mark.long
def test_data_sets_are_named_by_labels_and_kinds(data: StudyData) -> None:
    """Together and in any order of the words; the intervals keep the order of the files."""
    named = {"mixed": ["random", "grid_warm"], "two": ["move_warm", "grid_cold"], "grid": ["grid"]}
    found = _study(data, data_sets=named, kinds=[ESTIMATION_TYPES["OwTrTO"]])
    assert {c.name: c.labels for c in found.study.fits.combinations} == {
        "mixed": ("grid_warm", "move_cold", "move_warm"),
        "two": ("grid_cold", "move_warm"),
        "grid": ("grid_cold", "grid_warm"),
    }
    assert len(found.study.fits.candidates) == 9
    with pytest.raises(
        ExperimentError, match="data set 'a': no calibration interval or kind is called 'gird'; did you"
    ):
        _study(data, data_sets={"a": ["random", "gird"]})
    with pytest.raises(ExperimentError, match=r"called 'day_1'; .*known: grid, grid_cold, grid_warm, move_cold, move_"):
        _study(data, data_sets={"a": ["day_1"]})


def test_the_study_finds_the_mounted_sensor(made: SensorStudy) -> None:
    """The matrix that is best on other days comes closer to the truth than the workbench's by far."""
    truth = scenario().specimens["arm_ft"]
    assert len(made.study.fits.candidates) == (6 + 9 + 9) * 3
    assert made.study.fits.left_out == tuple(
        f"random {kind}: sphere offset: none of grid_cold is in it" for kind in ("SnTdTO", "SwTdTO", "SwTrTO")
    )
    best = made.calibrations["best_offset_first_second"]
    off, workbench_off = (
        np.linalg.norm(matrix - truth.sensor.matrix, axis=1) for matrix in (best.matrix, truth.workbench)
    )
    assert (off[:3] < 0.1 * workbench_off[:3]).all()
    errors = made.study.errors[Offset.FIRST_SECOND].pooled().force_mean
    assert errors[made.study.choices[Offset.FIRST_SECOND].by_magnitude] < 0.05 * errors[-1]


def _again(data: StudyData, candidate: Candidate) -> CalibrationFit:
    """Fit a candidate by itself."""
    labels = candidate.data_set.split(" + ")
    intervals = [interval.data_set for interval in data.calibration if interval.kind in labels]
    if not candidate.kind.with_variables:
        intervals = [replace(one, variables=None) for one in intervals]
    return calibrate(
        intervals,
        data.sensor.prior,
        regularisation=candidate.lambda_counts2,
        kind=candidate.kind,
        variables=[v.linear for v in data.sensor.variables] if candidate.kind.with_variables else (),
        sphere=["grid_cold"] if "grid" in labels else None,
    )


def _errors_alone(data: StudyData, candidate: Candidate | GenerativeCandidate) -> tuple[FloatArray, FloatArray]:
    """Standard errors of matrix and coefficients that a candidate has by itself."""
    if isinstance(candidate, GenerativeCandidate):
        posterior, model = candidate.posterior, candidate.model
        return posterior.matrix_error(model.matrix), posterior.coefficient_error(model.coefficients)
    again = _again(data, candidate)
    assert again.standard_errors is not None
    return again.standard_errors.matrix, again.standard_errors.coefficients


def _close(one: Any, other: Any) -> bool:
    a, b = np.asarray(one), np.asarray(other)
    return a.shape == b.shape and bool(np.abs(a - b).max(initial=0.0) <= SAME * np.abs(b).max(initial=0.0))


def test_there_are_four_calibrations(made: SensorStudy) -> None:
    """By magnitude and by axis, with each offset."""
    assert list(made.calibrations) == list(NAMES.values())


@BOTH
def test_the_best_is_written_as_the_candidate_that_was_judged(
    data: StudyData, made: SensorStudy, source: Offset
) -> None:
    """The same model, with the standard errors and the residual that the fit by itself has."""
    calibration = made.calibrations[NAMES[source, "best"]]
    candidate = made.study.fits.candidates[made.study.choices[source].by_magnitude]
    assert _close(calibration.matrix, candidate.model.matrix)
    assert _close(calibration.offset, candidate.model.offset)
    assert _close(calibration.model.coefficients, candidate.model.coefficients)
    assert np.array_equal(calibration.model.reference_values, candidate.model.reference_values)
    assert calibration.estimation_type == candidate.kind.name
    assert calibration.lambda_counts2 == candidate.lambda_counts2
    again = _again(data, candidate)
    assert again.standard_errors is not None
    assert _close(calibration.matrix_standard_error, again.standard_errors.matrix)
    assert _close(calibration.offset_standard_error, again.standard_errors.offset)
    assert _close(calibration.residual_rms, again.fit.residual)
    assert (calibration.raw_offset_counts is None) == (candidate.kind.name[0] != "S")
    for k, variable in enumerate(calibration.variables):
        assert _close(variable.standard_error, again.standard_errors.coefficients[:, k])
    assert len(calibration.variables) == int(candidate.kind.with_variables)


@BOTH
def test_the_best_says_what_it_was_made_from_and_chosen_on(data: StudyData, made: SensorStudy, source: Offset) -> None:
    """Intervals, samples and inputs; the rule names the candidate; the judged intervals are kept apart."""
    calibration = made.calibrations[NAMES[source, "best"]]
    best = made.study.choices[source].by_magnitude
    candidate = made.study.fits.candidates[best]
    value = made.study.errors[source].pooled().force_mean[best]
    assert calibration.selection.rule == (
        f"smallest mean contact force, offset {source}: {value:.4g} N by {candidate.name}"
    )
    expected = [(i.label, i.part.interval.start_ns, i.part.interval.end_ns) for i in data.validation]
    assert [(i.label, i.start_ns, i.end_ns) for i in calibration.selection.chosen_on] == expected
    assert [label for label, _, _ in expected] == ["day_1", "day_2"]
    fitted = [i for i in data.calibration if i.kind in candidate.data_set.split(" + ")]
    assert [i.label for i in calibration.provenance.intervals] == [i.label for i in fitted]
    assert calibration.provenance.samples == sum(len(i.part.samples) for i in fitted)
    assert calibration.provenance.experiment == "; ".join(f"arm {file.removesuffix('.toml')}" for file in FILES)
    assert calibration.provenance.inputs_sha256 == data.inputs_sha256
    assert (calibration.provenance.code_version, calibration.provenance.created) == ("1.2.3", "today")
    assert calibration.sensor.serial == SERIAL
    assert calibration.prior is not None
    assert np.array_equal(calibration.prior.matrix, data.sensor.prior)


@BOTH
def test_every_row_of_the_best_by_axis_is_that_of_its_candidate(
    data: StudyData, made: SensorStudy, source: Offset
) -> None:
    """Matrix, standard errors and residual; and on any samples the component reads as the candidate's does."""
    calibration = made.calibrations[NAMES[source, "best_by_axis"]]
    rows = made.study.choices[source].by_axis
    assert len(set(rows)) > 1
    (judged,) = [i.data_set for i in data.validation if i.label == "day_2"]
    read = calibration.model.wrench(judged.raw, judged.variables if calibration.variables else None)
    candidates = [made.study.candidates[index] for index in rows]
    for axis, candidate in enumerate(candidates):
        errors, fitted = _errors_alone(data, candidate), bool(candidate.model.coefficients.shape[1])
        assert _close(calibration.matrix[axis], candidate.model.matrix[axis])
        assert calibration.matrix_standard_error is not None
        assert _close(calibration.matrix_standard_error[axis], errors[0][axis])
        alone = candidate.model.wrench(judged.raw, judged.variables if fitted else None)
        assert _close(read[:, axis], alone[:, axis])
        for variable in calibration.variables:
            expected = errors[1][axis, 0] if fitted else 0.0
            assert variable.standard_error is not None
            assert _close(variable.standard_error[axis], expected)
        if isinstance(candidate, Candidate):
            assert _close(calibration.residual_rms[axis], _again(data, candidate).fit.residual[axis])
    named = "; ".join(f"{c} by {k.name}" for c, k in zip(WRENCH_COMPONENTS, candidates, strict=True))
    assert calibration.selection.rule == f"smallest mean absolute value of every axis, offset {source}: {named}"
    assert calibration.estimation_type == "by axis"
    assert calibration.lambda_counts2 is None
    assert calibration.raw_offset_counts is None
    assert [i.label for i in calibration.selection.chosen_on] == ["day_1", "day_2"]


@BOTH
def test_the_best_by_axis_counts_the_samples_of_all_its_rows(
    data: StudyData, made: SensorStudy, source: Offset
) -> None:
    """Intervals and samples are those that any row was fitted to, each once."""
    provenance = made.calibrations[NAMES[source, "best_by_axis"]].provenance
    rows = made.study.choices[source].by_axis
    kinds = {kind for index in rows for kind in made.study.candidates[index].data_set.split(" + ")}
    fitted = [i for i in data.calibration if i.kind in kinds]
    assert {i.label for i in provenance.intervals} == {i.label for i in fitted}
    assert len(provenance.intervals) == len(fitted)
    assert provenance.samples == sum(len(i.part.samples) for i in fitted)


def test_every_calibration_is_read_back_as_it_was(made: SensorStudy, tmp_path: Path) -> None:
    """Also those that have no lambda of their own."""
    for name, calibration in made.calibrations.items():
        write_calibration(tmp_path / f"{name}.json", calibration)
        again = read_calibration(tmp_path / f"{name}.json")
        assert again.model_dump(mode="json") == calibration.model_dump(mode="json")
    assert len(list(tmp_path.iterdir())) == 4


def test_every_calibration_can_be_evaluated(days: Path, made: SensorStudy) -> None:
    """All give verdicts on a day that was not fitted, where the best beat the prior; a fitted day is refused."""
    experiment = load_experiment(days / VALIDATION[0])
    verdicts = evaluate(SensorRun(experiment, experiment.sensors[0]), made.calibrations).verdicts
    force = {(row.calibration, row.offset): row.force_error_mean_N for row in verdicts}
    assert all((name, offset) in force for name in made.calibrations for offset in ("fitted", "judged-mean"))
    prior = min(value for (name, offset), value in force.items() if "prior" in name and offset == "judged-mean")
    for by in ("best", "best_by_axis"):
        assert force[NAMES[Offset.FIRST_SECOND, by], Offset.JUDGED_MEAN] < 0.1 * prior
    fitted = load_experiment(edit(days / "grid_cold.toml", '"calibration"', '"validation"'))
    with pytest.raises(ExperimentError, match="was fitted on the interval 'grid_cold', which overlaps"):
        evaluate(SensorRun(fitted, fitted.sensors[0]), {"best": made.calibrations["best_by_axis_offset_fitted"]})


def test_what_a_study_comes_to_shows_itself(made: SensorStudy) -> None:
    """Numbers stay whole, CSV has every candidate and the workbench, JSON none of them, and no folder is named."""
    row = studied_sensor(made)
    studies = Studies(experiments=("days",), folder=None, sensors=(row,))
    require_shown(studies)
    assert "are in" not in studies.text()
    assert len(studies.records()) == row.candidates + row.generative + 1
    assert "candidate_rows" not in studies.json_text()
    assert [mode.offset for mode in row.modes] == ["first-second", "fitted"]
    chosen = made.study.choices[Offset.FIRST_SECOND].by_magnitude
    assert row.modes[0].best.force_mean_N == made.study.errors[Offset.FIRST_SECOND].pooled().force_mean[chosen]


def test_a_session_that_is_fitted_and_judged_is_a_warning(data: StudyData, made: SensorStudy) -> None:
    """By its name; sessions that are only judged are none."""
    assert not [sentence for sentence in study_warnings(made) if "is fitted and validated" in sentence]
    session = data.validation[0].session
    both = replace(data, calibration=tuple(replace(interval, session=session) for interval in data.calibration))
    (sentence,) = [s for s in study_warnings(replace(made, data=both)) if "is fitted and validated" in s]
    assert sentence == f"session {session!r} is fitted and validated: its score is not that of another session"


def test_a_sensor_without_variables_is_studied_without_the_types_that_need_them(intact: Path) -> None:
    """Three types are left; asking for another alone is refused and says what is missing."""
    (data,) = read_study_data([intact / PARQUET], None)
    found = _study(data, sphere=None)
    assert list(dict.fromkeys(c.kind.name for c in found.study.fits.candidates)) == ["SnTdTO", "CnTdTO", "OnTdTO"]
    assert found.study.fits.left_out == ()
    assert all(c.variables == () for c in found.calibrations.values())
    assert all(choice.across_sessions == () for choice in found.study.choices.values())
    with pytest.raises(ExperimentError, match="OwTrTO need a linear variable such as temperature, and the"):
        _study(data, kinds=[ESTIMATION_TYPES["OwTrTO"]])


@pytest.mark.long
def test_a_sensor_without_a_prior_is_studied_at_lambda_zero(days: Path) -> None:
    """There is nothing to pull towards and no workbench; the calibrations say so."""
    for file in FILES:
        edit(days / file, f'prior = "matrix_{SERIAL}.txt"\n', "")
    (data,) = read_study_data([days / file for file in FILES], None)
    found = _study(data)
    assert {c.table_lambda for c in found.study.fits.candidates} == {0.0}
    assert found.study.workbench is None
    assert all(c.prior is None for c in found.calibrations.values())
    assert all(found.study.candidates[k].determined for c in found.study.choices.values() for k in c.by_axis)


@pytest.mark.long
def test_the_sphere_of_the_files_is_taken_unless_another_is_named(days: Path) -> None:
    """And one that is no calibration interval is refused."""
    edit(days / "grid_warm.toml", "[recording]", '[calibration]\nsphere_intervals = ["grid_warm"]\n\n[recording]')
    (data,) = read_study_data([days / file for file in FILES], None)
    only = {"kinds": [ESTIMATION_TYPES["SwTrTO"]], "lambdas": [0.0], "data_sets": {"all": ["grid", "random"]}}
    of_file, warm, cold = (_study(data, sphere=sphere, **only) for sphere in (None, ["grid_warm"], ["grid_cold"]))
    offsets = [found.study.fits.candidates[0].model.offset for found in (of_file, warm, cold)]
    assert np.array_equal(offsets[0], offsets[1])
    assert np.abs(offsets[0] - offsets[2]).max() > 0.01
    with pytest.raises(FitError, match="sphere: no calibration interval is called 'day_1'"):
        _study(data, sphere=["day_1"])


def test_without_validation_or_calibration_there_is_no_study(recorded: Path) -> None:
    """The message says which use is missing."""
    (fitted,) = read_study_data([recorded / CALIBRATION[2]], None)
    with pytest.raises(FitError, match='expected at least one interval with use = "validation", got none'):
        _study(fitted, sphere=None)
    (judged,) = read_study_data([recorded / VALIDATION[0]], None)
    with pytest.raises(ExperimentError, match='expected at least one interval with use = "calibration", got none'):
        _study(judged)


@pytest.mark.long
def test_progress_tells_every_step(data: StudyData) -> None:
    """Each way to fit once, evaluating in each mode; no line of an interval where all are evaluated at once."""
    said: list[str] = []
    _study(data, kinds=[ESTIMATION_TYPES["OwTrTO"]], progress=said.append)
    assert said == [
        "fitting 3 combinations of data sets by the generative model",
        "fitting 3 combinations of data sets, 1 types, 3 lambdas",
        "evaluating 13 matrices on 2 intervals, offset first-second",
        "evaluating 13 matrices on 2 intervals, offset fitted",
    ]
