# SPDX-License-Identifier: BSD-3-Clause
"""Judging calibrations: which candidates, on which samples, and what is refused."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError, SerialNumberError, ShapeError
from forcetorque.base.noise.autocorrelation import autocorrelation
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.evaluation.commands import evaluate
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.evaluated_wrenches import evaluated_wrenches
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Use
from tests.scenes.experiments import PARQUET, YARP, add, edit, write_sharing


@pytest.fixture(scope="module")
def experiment(intact: Path) -> Experiment:
    """The experiment with raw counts."""
    return load_experiment(intact / PARQUET)


@pytest.fixture(scope="module")
def fitted(experiment: Experiment) -> Calibration:
    """Its sensor, calibrated."""
    return _fitted(experiment, 100.0)


def _fitted(experiment: Experiment, regularisation: float) -> Calibration:
    sensor = experiment.sensors[0]
    return calibrate_sensor(
        SensorRun(experiment, sensor), code_version="1", created="today", regularisation=regularisation
    )


def test_every_candidate_is_judged_with_both_offsets(experiment: Experiment, fitted: Calibration) -> None:
    """One calibration means four verdicts, the prior first; all are of the same samples."""
    verdicts = evaluate(SensorRun(experiment, experiment.sensors[0]), {"new": fitted}).verdicts
    assert [(v.calibration, v.offset) for v in verdicts] == [
        ("prior", "fitted"),
        ("prior", "judged-mean"),
        ("new", "fitted"),
        ("new", "judged-mean"),
    ]
    (part,) = SensorRun(experiment, experiment.sensors[0]).samples(Use.VALIDATION)
    assert {v.samples for v in verdicts} == {len(part.samples)}
    assert len(part.samples) > 400


def test_the_new_matrix_is_better_than_the_prior_where_it_was_not_fitted(
    experiment: Experiment, fitted: Calibration
) -> None:
    """The simulated mounting is found: every force error falls to a tenth, with either offset."""
    by_key = {
        (v.calibration, v.offset): v
        for v in evaluate(SensorRun(experiment, experiment.sensors[0]), {"new": fitted}).verdicts
    }
    for offset in ("fitted", "judged-mean"):
        new, prior = by_key["new", offset], by_key["prior", offset]
        assert new.force_error_mean_N < 0.1 * prior.force_error_mean_N
        assert (new.rmse[:3] < 0.1 * prior.rmse[:3]).all()
    assert len(by_key) == 4


def test_the_re_estimated_offset_leaves_no_mean_error(experiment: Experiment, fitted: Calibration) -> None:
    """It is estimated on the judged samples; the fitted one is not."""
    verdicts = evaluate(SensorRun(experiment, experiment.sensors[0]), {"new": fitted}).verdicts
    bias = {v.offset: np.abs(v.bias).max() for v in verdicts if v.calibration == "new"}
    assert bias["judged-mean"] < 1e-11 < 1e-3 < bias["fitted"]


def test_a_calibration_that_is_called_prior_is_compared_with_its_prior(
    experiment: Experiment, fitted: Calibration
) -> None:
    """As under any other name; with itself it would be no different."""
    run = SensorRun(experiment, experiment.sensors[0])
    one, other = (evaluate(run, {name: fitted}).comparisons for name in ("new", "prior"))
    assert {row.conclusion for row in one} == {"better"}
    assert [row.ratio for row in one] == [row.ratio for row in other]


def test_a_shared_prior_comes_once(experiment: Experiment, fitted: Calibration) -> None:
    """Two calibrations of the same data and prior have one prior, whose offset may differ by rounding."""
    candidates = {}
    for change in (1e-13, 1e-3):  # N, N m
        assert fitted.prior is not None
        prior = fitted.prior.model_copy(update={"offset": fitted.prior.offset + change})
        other = _fitted(experiment, 1e6).model_copy(update={"prior": prior})
        verdicts = evaluate(SensorRun(experiment, experiment.sensors[0]), {"a": fitted, "b": other}).verdicts
        candidates[change] = list(dict.fromkeys(v.calibration for v in verdicts))
    assert candidates == {1e-13: ["prior of a", "a", "b"], 1e-3: ["prior of a", "prior of b", "a", "b"]}


def test_a_calibration_without_prior_stands_alone(experiment: Experiment, fitted: Calibration) -> None:
    """There is nothing to compare with, and nothing is made up."""
    alone = fitted.model_copy(update={"prior": None})
    verdicts = evaluate(SensorRun(experiment, experiment.sensors[0]), {"new": alone}).verdicts
    assert [v.calibration for v in verdicts] == ["new", "new"]


def test_the_share_of_readings_in_two_recordings_is_that_of_their_duration(arm: Path) -> None:
    """Two of eight seconds are in the longer recording too: 25 %, not one interval of two."""
    runs = [SensorRun(load_experiment(arm / file), "arm_ft") for file in write_sharing(arm, "validation")]
    with pytest.raises(ExperimentError, match=r"^'second' has about 25 % of its readings in common with 'first'"):
        evaluate(runs, {})


def test_another_serial_number_is_refused(experiment: Experiment, fitted: Calibration) -> None:
    """A calibration of another sensor is named, with both numbers."""
    foreign = fitted.model_copy(update={"sensor": fitted.sensor.model_copy(update={"serial": "SIM009"})})
    with pytest.raises(SerialNumberError, match="^new: calibration of sensor 'SIM009': .* got 'SIM001'"):
        evaluate(SensorRun(experiment, experiment.sensors[0]), {"old": fitted, "new": foreign})


@pytest.mark.parametrize(("field", "value"), [("frame", "parent"), ("measure_direction", "parent_to_child")])
def test_a_reading_in_another_frame_or_sign_is_refused(
    experiment: Experiment, fitted: Calibration, field: str, value: str
) -> None:
    """Wrenches are not compared with references that mean something else."""
    identity = type(fitted.sensor).model_validate({**fitted.sensor.model_dump(), field: value})
    other = fitted.model_copy(update={"sensor": identity})
    with pytest.raises(
        ExperimentError, match=rf"calibration 'new': expected .* child, child_to_parent, .* got .*{value}"
    ):
        evaluate(SensorRun(experiment, experiment.sensors[0]), {"new": other})


def test_another_number_of_channels_is_refused(experiment: Experiment, fitted: Calibration) -> None:
    """A matrix that does not fit the readings is named."""
    narrow = fitted.model_copy(update={"matrix": fitted.matrix[:, :5], "prior": None})
    with pytest.raises(ShapeError, match=r"new: matrix: expected an array of shape \(6, 6\), got \(6, 5\)"):
        evaluate(SensorRun(experiment, experiment.sensors[0]), {"new": narrow})


@pytest.mark.parametrize(("start_s", "refused"), [("13.999", True), ("14.0", False)])
def test_samples_that_were_fitted_are_not_judged(arm: Path, fitted: Calibration, start_s: str, refused: bool) -> None:
    """One millisecond that was fitted is enough to refuse, the instant at which the fit ended is not."""
    edit(arm / PARQUET, "end_s = 14.0", "end_s = 10.0")
    edit(arm / PARQUET, "start_s = 14.5", f"start_s = {start_s}")
    changed = load_experiment(arm / PARQUET)
    if refused:
        with pytest.raises(
            ExperimentError, match="'new' was fitted on the interval 'fit', which overlaps the validation inte"
        ):
            evaluate(SensorRun(changed, changed.sensors[0]), {"new": fitted})
    else:
        assert len(evaluate(SensorRun(changed, changed.sensors[0]), {"new": fitted}).verdicts) == 4


def test_intervals_are_pooled_before_anything_is_averaged(arm: Path, fitted: Calibration) -> None:
    """Two judged intervals give the statistics of all their samples together."""
    whole = load_experiment(arm / PARQUET)
    edit(arm / PARQUET, "end_s = 23.5", "end_s = 17.0")
    rest = 'label = "rest"\nstart_s = 17.0\nend_s = 23.5\nuse = "validation"\nsupport = "base"'
    add(arm / PARQUET, f"\n[[interval]]\n{rest}\n")
    parts = load_experiment(arm / PARQUET)
    assert [interval.label for interval in parts.intervals(Use.VALIDATION)] == ["judge", "rest"]
    one, many = (evaluate(SensorRun(e, e.sensors[0]), {"new": fitted}).verdicts[2] for e in (whole, parts))
    assert one.samples == many.samples
    assert np.abs(one.rmse - many.rmse).max() < 1e-9  # N, N m; rounding


def test_an_experiment_that_only_fits_judges_nothing(experiment: Experiment, fitted: Calibration) -> None:
    """Without an interval for validation there is no verdict."""
    fits = experiment.intervals(Use.CALIBRATION)
    only = replace(experiment, recording=experiment.recording.with_intervals(fits))
    with pytest.raises(ExperimentError, match=r"expected an interval with use = \"validation\", it has none"):
        evaluate(SensorRun(only, only.sensors[0]), {"new": fitted})


def test_counts_through_another_prior_are_refused(arm: Path) -> None:
    """A matrix is for counts recovered through the prior of its fit; through another they are other numbers."""
    path = arm / YARP
    experiment = load_experiment(path)
    calibration = _fitted(experiment, 100.0)
    assert evaluate(SensorRun(experiment, experiment.sensors[0]), {"new": calibration}).verdicts
    other = load_experiment(edit(path, 'prior = "matrix_SIM001.txt"', 'prior = "identity"'))
    with pytest.raises(ExperimentError, match="recovered through the prior that it was fitted with"):
        evaluate(SensorRun(other, other.sensors[0]), {"new": calibration})


def test_without_a_calibration_the_prior_of_the_experiment_is_judged(
    experiment: Experiment, fitted: Calibration
) -> None:
    """It gets the same offset as the prior that a calibration carries, so the same numbers."""
    sensor = experiment.sensors[0]
    alone = evaluate(SensorRun(experiment, sensor), {}).verdicts
    carried = evaluate(SensorRun(experiment, sensor), {"new": fitted}).verdicts[:2]
    assert [(one.calibration, one.offset) for one in alone] == [("prior", "fitted"), ("prior", "judged-mean")]
    for one, other in zip(alone, carried, strict=True):
        np.testing.assert_allclose(one.rmse, other.rmse, rtol=1e-9)
        assert one.samples == other.samples


def test_intervals_are_judged_in_the_order_of_time(arm: Path, fitted: Calibration) -> None:
    """Where the file lists the later one first, wrenches are those of the file in order; time never falls."""
    edit(arm / PARQUET, "end_s = 23.5", "end_s = 17.0")
    rest = 'label = "rest"\nstart_s = 17.0\nend_s = 23.5\nuse = "validation"\nsupport = "base"\n'
    ordered = load_experiment(add(arm / PARQUET, f"\n[[interval]]\n{rest}"))
    intervals = ordered.recording.intervals
    turned = replace(ordered, recording=ordered.recording.with_intervals(intervals[::-1]))
    assert [interval.label for interval in turned.intervals(Use.VALIDATION)] == ["rest", "judge"]
    for given in ({"new": fitted}, {}):
        one, other = (evaluated_wrenches(SensorRun(each, each.sensors[0]), given) for each in (ordered, turned))
        assert (np.diff(other.time_s) > 0.0).all()
        assert autocorrelation(other.reference[:, 0], other.time_s).count == len(other.time_s)
        np.testing.assert_array_equal(one.time_s, other.time_s)
        for (name, first), (_, second) in zip(one.measured, other.measured, strict=True):
            np.testing.assert_allclose(first, second, atol=1e-9, err_msg=name)  # N, N m; rounding


def test_every_calibration_names_the_prior_to_compare_it_with(experiment: Experiment, fitted: Calibration) -> None:
    """Also where the prior is shared; priors, and a calibration without one, have none."""
    assert fitted.prior is not None
    moved = fitted.model_copy(update={"prior": fitted.prior.model_copy(update={"offset": fitted.prior.offset + 1.0})})
    bare = fitted.model_copy(update={"prior": None})
    given = {"a": fitted, "b": _fitted(experiment, 1e6), "c": moved, "prior": bare}
    judged = evaluated_wrenches(SensorRun(experiment, experiment.sensors[0]), given)
    assert judged.priors == {"a": "prior of a", "b": "prior of a", "c": "prior of c"}
    assert [each.name for each in judged.candidates] == [name for name, _ in judged.measured]
    verdicts = evaluate(SensorRun(experiment, experiment.sensors[0]), given).verdicts
    assert {(v.calibration, v.prior) for v in verdicts} == {
        ("prior of a", None),
        ("prior of c", None),
        ("a", "prior of a"),
        ("b", "prior of a"),
        ("c", "prior of c"),
        ("prior", None),
    }


def test_calibrations_one_by_one_are_judged_as_together(experiment: Experiment, fitted: Calibration) -> None:
    """Each, and the prior that it names, has the same errors, whoever else is judged."""
    given = {"a": fitted, "b": _fitted(experiment, 1e6)}
    sensor = experiment.sensors[0]
    together = {(v.calibration, v.offset): v for v in evaluate(SensorRun(experiment, sensor), given).verdicts}
    compared = 0
    for name, calibration in given.items():
        alone = {
            (v.calibration, v.offset): v for v in evaluate(SensorRun(experiment, sensor), {name: calibration}).verdicts
        }
        for offset in ("fitted", "judged-mean"):
            one, other = alone[name, offset], together[name, offset]
            assert (one.prior, other.prior) == ("prior", "prior of a")
            for a, b in ((one, other), (alone["prior", offset], together["prior of a", offset])):
                np.testing.assert_allclose(a.rmse, b.rmse, rtol=1e-9)
                assert a.force_error_standard_error_N == pytest.approx(b.force_error_standard_error_N, rel=1e-9)
                compared += 1
    assert compared == 8


def test_where_the_offset_comes_from_is_said(experiment: Experiment, fitted: Calibration) -> None:
    """That of a prior from the fitted data, of a calibration from its file; of a prior alone, perhaps from nowhere."""
    sensor = experiment.sensors[0]
    sources = {
        (v.calibration, v.offset): v.offset_source
        for v in evaluate(SensorRun(experiment, sensor), {"new": fitted}).verdicts
    }
    assert sources == {
        ("prior", "fitted"): "the prior matrix_SIM001.txt, offset of the data that new was fitted on",
        ("new", "fitted"): "new",
        ("prior", "judged-mean"): "the evaluated samples themselves",
        ("new", "judged-mean"): "the evaluated samples themselves",
    }
    judged = experiment.recording.with_intervals(experiment.intervals(Use.VALIDATION))
    alone, _ = evaluate(SensorRun(replace(experiment, recording=judged), sensor), {}).verdicts
    assert alone.offset_source == "the prior matrix_SIM001.txt, no offset removed"
