# SPDX-License-Identifier: BSD-3-Clause
"""Calibrating a sensor of an experiment: what is fitted, and what the artefact says about it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Literal

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FitError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.experiment.calibration.calibration_file import GENERATIVE, Calibration
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.payload.loads_on_robot_links import link_loads
from forcetorque.recording.recording import Use
from forcetorque.recording.storage import read_recording, write_recording
from tests.cases import some_cases
from tests.scenes.experiments import FACTORY, MOUNTED, PARQUET, TWO, YARP, add, edit

FORCE_ROWS = 0.02
"""Largest relative error of a force row: accelerations from 50 Hz leave 0.1 N; the prior is off by 3 % and more."""
DIGITS = 1e-9
"""Relative; twelve digits in the log, times the condition number 60 of the matrix with its rows at one scale."""


def _calibrated(experiment: Experiment, *, regularisation: float | Literal["held-out"] | None = None) -> Calibration:
    return calibrate_sensor(
        SensorRun(experiment, experiment.sensors[0]),
        code_version="1.2.3",
        created="today",
        regularisation=regularisation,
    )


def _row_errors(matrix: FloatArray) -> FloatArray:
    errors: FloatArray = np.linalg.norm(matrix - MOUNTED, axis=1) / np.linalg.norm(MOUNTED, axis=1)
    return errors


def test_the_true_matrix_is_found(intact: Path) -> None:
    """Force rows come close to what the sensor was made with, which the prior does not."""
    fitted = _calibrated(load_experiment(intact / PARQUET), regularisation=0.0)
    assert _row_errors(fitted.matrix)[:3].max() < FORCE_ROWS
    assert _row_errors(FACTORY)[:3].min() > FORCE_ROWS


def test_both_forms_give_the_same_calibration(intact: Path) -> None:
    """Counts recovered through the prior from a calibrated stream fit like those that were logged."""
    own, yarp = (_calibrated(load_experiment(intact / form), regularisation=100.0) for form in (PARQUET, YARP))
    assert np.abs(own.matrix - yarp.matrix).max() < DIGITS * np.abs(own.matrix).max()
    assert np.abs(own.offset - yarp.offset).max() < DIGITS * np.abs(own.offset).max()


@some_cases("form", [PARQUET, YARP])
def test_the_artefact_says_what_it_was_made_from(intact: Path, form: str) -> None:
    """Sensor, robot, intervals, number of samples and inputs are those of the experiment."""
    experiment = load_experiment(intact / form)
    made = _calibrated(experiment)
    (fit,) = experiment.intervals(Use.CALIBRATION)
    stamps = experiment.recording.stream("arm_ft").stamp_ns
    assert (made.sensor.name, made.sensor.serial, made.sensor.robot) == ("arm_ft", "SIM001", "arm")
    assert (made.sensor.frame, made.sensor.measure_direction) == ("child", "child_to_parent")
    assert (made.provenance.code_version, made.provenance.created) == ("1.2.3", "today")
    assert made.provenance.experiment == "small arm"
    assert [(i.label, i.start_ns, i.end_ns) for i in made.provenance.intervals] == [("fit", fit.start_ns, fit.end_ns)]
    assert made.provenance.samples == np.count_nonzero((stamps >= fit.start_ns) & (stamps < fit.end_ns)) > 600
    assert made.provenance.dropped == 0
    assert made.provenance.inputs_sha256 == experiment.inputs_sha256
    assert made.prior is not None
    assert made.prior.source == "matrix_SIM001.txt"


def test_the_priors_offset_is_the_mean_on_the_fitted_data(intact: Path) -> None:
    """The prior gets the offset that leaves no mean error where the new matrix was fitted."""
    experiment = load_experiment(intact / PARQUET)
    (part,) = SensorRun(experiment, experiment.sensors[0]).samples(Use.CALIBRATION)
    made = _calibrated(experiment)
    assert made.prior is not None
    by_hand = np.mean(part.samples.reference - part.raw @ made.prior.matrix.T, axis=0)
    rounding = 1e-12 * np.abs(part.raw @ made.prior.matrix.T).max()
    assert np.abs(made.prior.offset - by_hand).max() < rounding
    (judged,) = SensorRun(experiment, experiment.sensors[0]).samples(Use.VALIDATION)
    elsewhere = np.mean(judged.samples.reference - judged.raw @ made.prior.matrix.T, axis=0)
    assert np.abs(made.prior.offset - elsewhere).max() > 1e6 * rounding


@pytest.mark.long
def test_how_lambda_came_about_is_recorded(intact: Path) -> None:
    """A given lambda is called so; a chosen one comes with its candidates, itself among them."""
    experiment = load_experiment(intact / PARQUET)
    given, chosen = _calibrated(experiment, regularisation=5.0), _calibrated(experiment, regularisation="held-out")
    assert (given.lambda_counts2, given.selection.rule, given.selection.lambda_counts2) == (5.0, "given", ())
    assert chosen.lambda_counts2 in chosen.selection.lambda_counts2
    assert len(chosen.selection.held_out_rmse) == len(chosen.selection.lambda_counts2) > 10
    assert "held-out" in chosen.selection.rule
    default = _calibrated(experiment)
    assert (default.estimation_type, default.lambda_counts2, default.selection.lambda_counts2) == (GENERATIVE, None, ())
    assert default.posterior is not None


def test_raw_readings_are_those_of_the_log(intact: Path) -> None:
    """Samples of a raw stream are the logged counts, those of a calibrated one the same up to its digits."""
    own, yarp = (load_experiment(intact / form) for form in (PARQUET, YARP))
    (counts,), (recovered,) = (SensorRun(e, e.sensors[0]).samples(Use.VALIDATION) for e in (own, yarp))
    logged = own.recording.stream("arm_ft")
    inside = np.isin(logged.stamp_ns, counts.samples.stamp_ns)
    assert np.array_equal(counts.raw, logged.signal("raw").values[inside])
    assert np.abs(recovered.raw - counts.raw).max() < DIGITS * np.abs(counts.raw).max()


@pytest.mark.long
def test_samples_that_cannot_be_used_are_left_out_and_counted(arm: Path) -> None:
    """A gap of the sensor, marked by NaN, and an ignored interval take samples out; only the gap counts as loss."""
    recording = read_recording(arm / "recording")
    stream = recording.stream("arm_ft")
    values = stream.signal("raw").values.copy()
    values[100] = np.nan
    values[101, 3] = np.nan
    signals = {"raw": replace(stream.signal("raw"), values=values)}
    write_recording(
        arm / "recording",
        replace(recording, streams={**recording.streams, "arm_ft": replace(stream, signals=signals)}),
    )
    add(arm / PARQUET, '[[interval]]\nlabel = "bump"\nstart_s = 8.0\nend_s = 10.0\nuse = "ignore"\n')
    experiment = load_experiment(arm / PARQUET)
    (fit,), (bump,) = experiment.intervals(Use.CALIBRATION), experiment.intervals(Use.IGNORE)
    in_fit = int(np.count_nonzero((stream.stamp_ns >= fit.start_ns) & (stream.stamp_ns < fit.end_ns)))
    in_bump = int(np.count_nonzero((stream.stamp_ns >= bump.start_ns) & (stream.stamp_ns < bump.end_ns)))
    provenance = _calibrated(experiment).provenance
    assert (provenance.samples, provenance.dropped) == (in_fit - in_bump - 2, 2)
    assert in_bump > 90


def test_the_other_direction_turns_the_sign(arm: Path) -> None:
    """Who acts on whom decides the sign of the reference, and nothing else."""
    one, other = load_experiment(arm / TWO), load_experiment(edit(arm / TWO, "parent_to_child", "child_to_parent"))
    references = [SensorRun(e, e.sensors[1]).samples(Use.CALIBRATION)[0].samples.reference for e in (one, other)]
    assert np.abs(references[0] + references[1]).max() < 1e-12  # N, N m; rounding
    assert np.abs(references[0]).max() > 1.0


def test_a_first_calibration_has_no_prior(arm: Path) -> None:
    """Without a prior lambda 0 is the only one of a thesis' type, and there is no secondary matrix."""
    experiment = load_experiment(edit(arm / PARQUET, 'prior = "matrix_SIM001.txt"\n', ""))
    made = _calibrated(experiment, regularisation=0.0)
    assert made.prior is None
    assert made.secondary_matrix() is None
    with pytest.raises(FitError, match="lambda cannot be chosen without a prior matrix; give a prior, or lambda 0"):
        _calibrated(experiment, regularisation="held-out")
    with pytest.raises(FitError, match="lambda: 5 counts2 needs a prior matrix to pull towards; give one or lambda 0"):
        _calibrated(experiment, regularisation=5.0)


def test_a_stated_load_needs_no_prior(arm: Path) -> None:
    """Whether the URDF has the load already is not tested then; the fit goes on."""
    load = '[[load]]\nlink = "hand"\nmass_kg = 0.001\ncentre_of_mass_m = [0.0, 0.0, 0.0]\n\n[[support]]'
    edit(arm / PARQUET, "[[support]]", load)
    experiment = load_experiment(edit(arm / PARQUET, 'prior = "matrix_SIM001.txt"\n', ""))
    assert link_loads(experiment) is not None
    assert _calibrated(experiment).prior is None


def test_an_experiment_without_the_wanted_intervals_is_refused(arm: Path) -> None:
    """An experiment that only judges cannot be fitted."""
    experiment = load_experiment(edit(arm / PARQUET, '"calibration"', '"ignore"'))
    with pytest.raises(ExperimentError, match=r"'small arm': expected an interval with use = \"calibration\", it has"):
        _calibrated(experiment)
