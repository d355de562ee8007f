# SPDX-License-Identifier: BSD-3-Clause
"""Questions to a sensor over several recordings: errors are pooled before they are averaged, each day by its offset."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError
from forcetorque.evaluation.acceptance.acceptance import accept
from forcetorque.evaluation.acceptance.acceptance_file import AcceptanceFile
from forcetorque.evaluation.commands import evaluate, validate
from forcetorque.evaluation.load_cases.validation_evidence import compare_with_prior
from forcetorque.evaluation.validation.contact_force_errors import contact_forces
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.validation_offset import Offset
from forcetorque.recording.recording import Use
from tests.scenes.campaigns import FITTED, by_day, run_of, two_days
from tests.scenes.experiments import edit
from tests.scenes.studies import VALIDATION

NAME = "arm.json"
ROUNDING = 1e-9
"""N, N m: sums of counts up to 2e4 and coefficients up to 0.03, in another order."""


@pytest.fixture(scope="module")
def fitted(recorded: Path) -> Calibration:
    """Calibration with an offset for each of the two days."""
    return by_day(recorded)


def _errors(folder: Path, calibration: Calibration) -> dict[str, FloatArray]:
    """Errors by hand, each day with its offset, by recording."""
    campaign = two_days(folder)
    offsets = {session.name: session.offset for session in calibration.sessions}
    return {
        interval.recording: interval.part.raw @ calibration.matrix.T
        + offsets[interval.session]
        - interval.part.samples.reference
        for interval in campaign.samples(Use.VALIDATION)
    }


def test_errors_are_pooled_before_they_are_averaged(recorded: Path, fitted: Calibration) -> None:
    """The pooled root mean square is that of all samples, not the mean of those of the days, which differ in length."""
    errors = _errors(recorded, fitted)
    evaluation = evaluate(two_days(recorded), {NAME: fitted})
    (pooled,) = [row for row in evaluation.verdicts if (row.calibration, row.offset) == (NAME, Offset.FITTED)]
    every = np.concatenate(list(errors.values()))
    assert pooled.samples == len(every)
    assert np.allclose(pooled.rmse, np.sqrt((every**2).mean(axis=0)), rtol=0.0, atol=ROUNDING)
    assert pooled.force_error_mean_N == pytest.approx(np.linalg.norm(every[:, :3], axis=1).mean(), abs=ROUNDING)
    apart = [row for row in evaluation.recordings if (row.calibration, row.offset) == (NAME, Offset.FITTED)]
    assert [row.recording for row in apart] == list(errors)
    for row in apart:
        assert np.allclose(row.rmse, np.sqrt((errors[row.recording] ** 2).mean(axis=0)), rtol=0.0, atol=ROUNDING)
    assert np.abs(np.mean([row.rmse for row in apart], axis=0) - pooled.rmse).max() > ROUNDING


def test_one_offset_for_all_days_is_worse(recorded: Path, fitted: Calibration) -> None:
    """The control: power-ups are 60 counts apart, so without sessions the days err by their offsets."""
    blind = fitted.model_copy(update={"sessions": ()})
    with_days, without = (
        next(row for row in evaluate(two_days(recorded), {NAME: one}).verdicts if row.offset == "fitted" and row.prior)
        for one in (fitted, blind)
    )
    assert with_days.force_error_mean_N < 0.7 * without.force_error_mean_N


def test_each_recording_has_the_errors_that_it_has_alone(recorded: Path, fitted: Calibration) -> None:
    """Also with the mean of its own samples removed; one recording by itself says nothing about recordings."""
    evaluation = evaluate(two_days(recorded), {NAME: fitted})
    for file in VALIDATION:
        run = run_of(recorded, file)
        alone = evaluate(run, {NAME: fitted})
        assert alone.recordings == ()
        apart = [row for row in evaluation.recordings if row.recording == run.experiment.name]
        assert [(row.calibration, row.offset) for row in apart] == [(r.calibration, r.offset) for r in alone.verdicts]
        for row, same in zip(apart, alone.verdicts, strict=True):
            assert np.array_equal(row.rmse, same.rmse)
            assert row.force_error_standard_error_N == same.force_error_standard_error_N
    removed = [row for row in evaluation.verdicts if row.offset is Offset.JUDGED_MEAN]
    assert removed
    assert all(np.abs(row.bias).max() < ROUNDING for row in removed)


@pytest.mark.long
def test_calibrations_are_compared_with_their_priors_over_all_recordings(recorded: Path, fitted: Calibration) -> None:
    """Each is cut by itself: stretches add up; contact forces are compared over both too."""
    pooled = evaluate(two_days(recorded), {NAME: fitted}).comparisons
    days = [evaluate(run_of(recorded, file), {NAME: fitted}).comparisons for file in VALIDATION]
    assert pooled == compare_with_prior(two_days(recorded), {NAME: fitted})
    assert [(row.quantity, row.offset) for row in pooled] == [(row.quantity, row.offset) for row in days[0]]
    for row, *apart in zip(pooled, *days, strict=True):
        assert row.samples == sum(day.samples for day in apart)
        assert row.segments == sum(day.segments for day in apart)
        log = np.average(np.log([day.ratio for day in apart]), weights=[day.segments for day in apart])
        assert np.log(row.ratio) == pytest.approx(log, abs=ROUNDING)
    for best in validate(two_days(recorded), {NAME: fitted}).best:
        (row,) = best.comparisons
        assert (best.best, row.conclusion) == (NAME, "better")
        assert row.segments > 2


def test_contact_forces_and_torques_are_pooled(recorded: Path, fitted: Calibration) -> None:
    """Means over all samples are the means of the days, weighted by their samples."""
    validation = validate(two_days(recorded), {NAME: fitted})
    assert len(validation.recordings) == 2 * len(validation.contact_forces)
    for row in validation.contact_forces:
        days = [r for r in validation.recordings if (r.calibration, r.offset) == (row.calibration, row.offset)]
        assert row.samples == sum(r.samples for r in days)
        mean = np.average([r.force_mean_N for r in days], weights=[r.samples for r in days])
        assert row.force_mean_N == pytest.approx(mean, abs=ROUNDING)
    assert validation.joint_torques
    assert len(validation.recording_torques) == 2 * len(validation.joint_torques)
    for torque in validation.joint_torques:
        key = (torque.calibration, torque.offset, torque.joint)
        squares = [
            (r.samples, r.rmse**2) for r in validation.recording_torques if (r.calibration, r.offset, r.joint) == key
        ]
        counts, values = zip(*squares, strict=True)
        assert torque.rmse == pytest.approx(np.sqrt(np.average(values, weights=counts)), abs=ROUNDING)
    forces = contact_forces(two_days(recorded), {NAME: fitted})
    assert [row.force_mean_N for row in forces.verdicts] == [row.force_mean_N for row in validation.contact_forces]
    alone = validate(run_of(recorded, VALIDATION[0]), {NAME: fitted})
    assert (alone.recordings, alone.recording_torques) == ((), ())


def _limits(**tables: object) -> AcceptanceFile:
    stated = {"schema": "forcetorque/acceptance/1", "name": "limits", **tables}
    return AcceptanceFile.model_validate(stated)


def test_errors_are_accepted_together_and_recordings_by_the_worst(recorded: Path, fitted: Calibration) -> None:
    """A mean that holds over both days is accepted though one of them exceeds it; a share of lost samples is not."""
    evaluation = evaluate(two_days(recorded), {NAME: fitted})
    key = (NAME, Offset.FITTED)
    apart = [row.force_error_mean_N for row in evaluation.recordings if (row.calibration, row.offset) == key]
    (pooled,) = [row.force_error_mean_N for row in evaluation.verdicts if (row.calibration, row.offset) == key]
    assert min(apart) < pooled < max(apart)
    limit = 0.5 * (pooled + max(apart))
    spec = _limits(
        evaluate={"force_error_mean_N": limit},
        recording={"missing_share": 1.0, "saturated_share": 1.0},
        excitation={"directions": 1},
    )
    acceptance = accept(two_days(recorded), spec, (NAME, fitted))
    assert all(row.passed for row in acceptance.criteria)
    assert [row.criterion for row in acceptance.criteria] == [
        "evaluate.force_error_mean_N", "recording.saturated_share", "recording.missing_share", "excitation.directions",
    ]  # fmt: skip
    assert acceptance.criteria[0].measured == pooled
    by_day = [row for row in acceptance.recordings if row.criterion == "evaluate.force_error_mean_N"]
    assert [row.measured for row in by_day] == apart
    assert [row.passed for row in by_day].count(False) == 1
    assert "excitation.directions" not in {row.criterion for row in acceptance.recordings}
    assert acceptance.measured == ()
    assert [row.recording_name for row in acceptance.recordings_measured] == ["arm day_1", "arm day_2"]


def test_the_worst_recording_is_named(recorded: Path, fitted: Calibration) -> None:
    """What is measured in each recording by itself counts where it is worst: the smaller full scale of a prior."""
    bare = fitted.model_copy(update={"sessions": ()})
    campaign = two_days(recorded)
    spec = _limits(matrix={"full_scale": [0.0] * 6})
    of_prior = accept(campaign, spec).criteria
    alone = [accept(run, spec).criteria for run in campaign.runs]
    for row, several in zip(of_prior, zip(*alone, strict=True), strict=True):
        values = [one.measured for one in several]
        assert row.measured == min(values)
        assert row.note == campaign.recordings[values.index(min(values))]
    of_matrix = [row for row in accept(campaign, spec, (NAME, bare)).criteria if row.criterion.startswith("matrix.")]
    assert [row.note for row in of_matrix] == [""] * len(of_prior)


def test_a_recording_without_data_to_judge_is_passed_over(recorded: Path, fitted: Calibration) -> None:
    """It counts for nothing but what is measured of it; where all lack them it is refused as with one."""
    campaign = [run_of(recorded, file) for file in ("grid_warm.toml", VALIDATION[0])]
    evaluation = evaluate(campaign, {NAME: fitted})
    assert {row.recording for row in evaluation.recordings} == {"arm day_1"}
    with pytest.raises(ExperimentError, match='expected an interval with use = "validation", it has none'):
        evaluate([run_of(recorded, file) for file in ("grid_warm.toml", "grid_cold.toml")], {NAME: fitted})


def test_errors_name_the_file(days: Path, fitted: Calibration) -> None:
    """Of several files, in which one the fitted interval is judged."""
    edit(days / FITTED, 'use = "calibration"', 'use = "validation"')
    with pytest.raises(ExperimentError, match=r"move_cold\.toml: calibration 'arm.json' was fitted on the interval"):
        evaluate([run_of(days, file) for file in (VALIDATION[0], FITTED)], {NAME: fitted})
