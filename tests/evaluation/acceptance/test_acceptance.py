# SPDX-License-Identifier: BSD-3-Clause
"""Acceptance: every limit against the number that its command gives, on both sides of it, and what is not measured."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError, ForceTorqueError, FormatError, MissingFileError
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.evaluation.acceptance.acceptance import Acceptance, accept
from forcetorque.evaluation.acceptance.acceptance_file import AcceptanceFile, read_acceptance
from forcetorque.evaluation.acceptance.criteria import Bound, Criterion
from forcetorque.evaluation.acceptance.static_checks import check
from forcetorque.evaluation.commands import evaluate
from forcetorque.evaluation.validation.contact_force_errors import contact_forces
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.provenance import FittedInterval, Selection
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.seen_and_outside_samples import sentences
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.validation_offset import Offset
from forcetorque.recording.recording import Use
from tests.scenes.experiments import MOUNTED, PARQUET, TWO, YARP, edit, holed
from tests.scenes.warm_experiments import TEMPERATURE, with_variables

ANY = [1e9] * 6
NONE = [0.0] * 6
JUST = 1e-9
"""Relative distance from a number to a limit just beside it."""
ROOT = Path(__file__).parents[3]

LIMITS: dict[str, dict[str, Any]] = {
    "evaluate": {
        "force_error_mean_N": 1e9,
        "force_error_largest_N": 1e9,
        "moment_error_mean_Nm": 1e9,
        "moment_error_largest_Nm": 1e9,
        "rmse": ANY,
        "bias": ANY,
        "largest": ANY,
    },
    "improvement": {"force_error_ratio": 1e9, "moment_error_ratio": 1e9},
    "validate": {"force_mean_N": 1e9, "moment_mean_Nm": 1e9, "mean_absolute": ANY},
    "matrix": {"condition": 1e9, "full_scale": NONE, "resolution_worst": ANY, "resolution_rms": ANY},
    "population": {"robust_z": 1e9, "quantiles": [0.0, 1.0], "at_least_sensors": 1},
    "recording": {"saturated_share": 1.0, "missing_share": 1.0, "lost_share": 1.0},
    "offset": {"change": ANY, "force_change_N": 1e9, "per_degree": ANY},
    "uncertainty": {"matrix_relative": 1e9, "offset": ANY},
    "excitation": {"directions": 1, "condition": 1e9},
    "information_gain": dict.fromkeys(WRENCH_COMPONENTS, 0.0),
}
"""Every key of every table with a limit that holds."""
OTHERS = {f"SN{k}": MOUNTED * np.random.default_rng(k).uniform(0.9, 1.1, (6, 6)) for k in range(9)}


def _spec(**tables: Any) -> AcceptanceFile:
    return AcceptanceFile.model_validate({"schema": "forcetorque/acceptance/1", "name": "test", **tables})


def _fitted(experiment: Experiment, *, regularisation: float | None = None) -> tuple[str, Calibration]:
    return "new", calibrate_sensor(_run(experiment), code_version="test", created="test", regularisation=regularisation)


def _run(experiment: Experiment) -> SensorRun:
    return SensorRun(experiment, experiment.sensors[0])


def _numbered(experiment: Experiment) -> Experiment:
    """The same experiment whose sensor numbers its messages and has lost some."""
    stream = experiment.recording.stream("arm_ft")
    sequence = np.arange(len(stream)) + 4 * (np.arange(len(stream)) > 300)
    streams = {**experiment.recording.streams, "arm_ft": replace(stream, sequence=sequence)}
    return replace(experiment, recording=replace(experiment.recording, streams=streams))


def _criteria(experiment: Experiment, spec: AcceptanceFile, calibration: Any) -> dict[str, Criterion]:
    judged = accept(_run(experiment), spec, calibration, population=OTHERS).criteria
    assert len({row.criterion for row in judged}) == len(judged)
    return {row.criterion: row for row in judged}


@pytest.fixture
def drifting(warm_log: Path) -> Experiment:
    """An experiment of which everything can be measured."""
    return _numbered(load_experiment(with_variables(warm_log / PARQUET, TEMPERATURE)))


def test_every_limit_is_one_criterion(drifting: Experiment) -> None:
    """All keys of the file, six per axis; the tables here have every key that the file may have."""
    for key, table in LIMITS.items():
        form = AcceptanceFile.model_fields["validate_" if key == "validate" else key].annotation
        fields = next(part for part in form.__args__ if part is not type(None)).model_fields  # type: ignore[union-attr]
        assert set(fields) - set(table) <= {"offset", "other_sensors"}
    found = _criteria(drifting, _spec(**LIMITS), _fitted(drifting))
    expected = []
    for key, table in LIMITS.items():
        for name, value in table.items():
            if name == "quantiles":
                expected += ["population.lowest_quantile", "population.highest_quantile"]
            elif isinstance(value, list):
                expected += [f"{key}.{name}.{component}" for component in WRENCH_COMPONENTS]
            else:
                expected.append(f"{key}.{name}")
    assert list(found) == expected
    assert all(each.passed for each in found.values())


def _beside(found: dict[str, Criterion], side: float) -> dict[str, dict[str, Any]]:
    """Limits just beside what was measured: side 1 where all hold, -1 where none does."""
    tables: dict[str, dict[str, Any]] = {}
    for each in found.values():
        table, key, *component = each.criterion.split(".")
        step = side * JUST * max(abs(each.measured), 1e-3)
        limit = each.measured + (step if each.bound is Bound.AT_MOST else -step)
        if isinstance(LIMITS[table].get(key), int):
            limit = round(each.measured) + (0 if side > 0.0 else 1)
        if component:
            tables.setdefault(table, {}).setdefault(key, {})[component[0]] = limit
        else:
            tables.setdefault(table, {})[key] = limit
    return tables


def test_every_limit_holds_on_one_side_and_fails_on_the_other(drifting: Experiment) -> None:
    """A limit moved by a part in 1e9 over the measured number turns the verdict, for each of them."""
    calibration = _fitted(drifting)
    found = _criteria(drifting, _spec(**LIMITS), calibration)
    # shares of nothing and quantiles of 0 and 1 have no number beyond them
    movable = {
        name: each
        for name, each in found.items()
        if "quantile" not in name and not (name.startswith("recording.") and each.measured == 0.0)
    }
    assert len(found) - len(movable) == 4
    kept = _criteria(drifting, _spec(**_beside(movable, 1.0)), calibration)
    broken = _criteria(drifting, _spec(**_beside(movable, -1.0)), calibration)
    assert set(kept) == set(broken) == set(movable)
    assert [name for name, each in kept.items() if not each.passed] == []
    assert [name for name, each in broken.items() if each.passed] == []


@pytest.mark.long
def test_the_numbers_are_those_of_the_other_commands(drifting: Experiment) -> None:
    """Evaluation, contact forces, checks and the calibration give the same numbers by themselves."""
    name, calibration = _fitted(drifting)
    run = _run(drifting)
    found = {key: each.measured for key, each in _criteria(drifting, _spec(**LIMITS), (name, calibration)).items()}
    counts = {key: each.count for key, each in _criteria(drifting, _spec(**LIMITS), (name, calibration)).items()}
    verdicts = {(v.calibration, v.offset): v for v in evaluate(run, {name: calibration}).verdicts}
    new, prior = verdicts["new", Offset.FITTED], verdicts["prior", Offset.FITTED]
    assert found["evaluate.force_error_mean_N"] == new.force_error_mean_N
    assert found["evaluate.rmse.tz"] == new.rmse[5]
    assert found["evaluate.bias.fx"] == abs(new.bias[0])
    assert found["improvement.force_error_ratio"] == new.force_error_mean_N / prior.force_error_mean_N
    assert counts["evaluate.rmse.tz"] == new.samples
    (contact,) = [
        v
        for v in contact_forces(run, {name: calibration}).verdicts
        if (v.calibration, v.offset) == ("new", Offset.FIRST_SECOND)
    ]
    assert found["validate.mean_absolute.fz"] == contact.mean_absolute[2]
    checks = check(run, (name, calibration), population=OTHERS)
    assert checks.full_scale_positive is not None
    assert checks.full_scale_negative is not None
    assert found["matrix.full_scale.ty"] == min(checks.full_scale_positive[4], -checks.full_scale_negative[4])
    assert found["population.robust_z"] == max(abs(feature.robust_z) for feature in checks.population)
    assert (counts["population.robust_z"], found["population.at_least_sensors"]) == (9, 9)
    assert found["recording.lost_share"] == max(row.lost_share or 0.0 for row in checks.recording) > 0.0
    assert calibration.matrix_standard_error is not None
    errors = np.linalg.norm(calibration.matrix_standard_error, axis=1) / np.linalg.norm(calibration.matrix, axis=1)
    assert found["uncertainty.matrix_relative"] == errors.max()
    assert found["excitation.directions"] == sum(calibration.validity.excited)
    assert calibration.posterior is not None
    shares = calibration.posterior.learnt_shares()
    assert shares is not None
    assert [found[f"information_gain.{component}"] for component in WRENCH_COMPONENTS] == shares.tolist()


def test_what_was_learnt_is_judged_of_generative_fits_alone(drifting: Experiment) -> None:
    """A share just above the limit holds, one just below fails; a type of the thesis knows none."""
    name, calibration = _fitted(drifting)
    assert calibration.posterior is not None
    shares = calibration.posterior.learnt_shares()
    assert shares is not None
    for factor, passed in ((1.0 - JUST, True), (1.0 + JUST, False)):
        (row,) = _criteria(drifting, _spec(information_gain={"tz": shares[5] * factor}), (name, calibration)).values()
        assert (row.criterion, row.passed) == ("information_gain.tz", passed)
    by_thesis = _fitted(drifting, regularisation=5.0)
    message = r"\[information_gain\] cannot be evaluated: calibration 'new' is not a generative"
    with pytest.raises(ForceTorqueError, match=message):
        accept(_run(drifting), _spec(information_gain={"tz": 0.1}), by_thesis)


@pytest.mark.long
def test_a_calibration_may_be_called_prior(drifting: Experiment) -> None:
    """A file of that name is not mistaken for the prior."""
    name, calibration = _fitted(drifting)
    spec = _spec(evaluate=LIMITS["evaluate"], improvement=LIMITS["improvement"], validate=LIMITS["validate"])
    first, second = (_criteria(drifting, spec, (called, calibration)) for called in (name, "prior"))
    assert [each.measured for each in first.values()] == [each.measured for each in second.values()]
    assert first["improvement.force_error_ratio"].measured < 0.5


def test_an_offset_that_gaps_do_not_give_cannot_be_judged(arm: Path) -> None:
    """Where the first second is a gap, contact forces are judged with the fitted offset only; else the gap is named."""
    experiment = load_experiment(arm / PARQUET)
    gap = replace(experiment, recording=holed(experiment.recording, "arm_ft", 14.5, 15.6))
    as_fitted = _spec(validate={"force_mean_N": 1e9, "offset": "fitted"})
    assert [each.passed for each in accept(_run(gap), as_fitted).criteria] == [True]
    with pytest.raises(
        ExperimentError, match=r"\[validate\] cannot be evaluated: contact force by prior over 'judge', off"
    ):
        accept(_run(gap), _spec(validate={"force_mean_N": 1e9, "offset": "first-second"}))


def test_the_offset_is_that_which_is_asked_for(arm: Path) -> None:
    """The fitted offset and the other one give different numbers, in evaluation and validation."""
    experiment = load_experiment(arm / PARQUET)
    calibration = _fitted(experiment)
    seen = []
    for of_errors, of_contacts in (("fitted", "fitted"), ("judged-mean", "first-second")):
        spec = _spec(
            evaluate={"force_error_mean_N": 1.0, "offset": of_errors},
            validate={"force_mean_N": 1.0, "offset": of_contacts},
        )
        seen.append([each.measured for each in _criteria(experiment, spec, calibration).values()])
    assert all(first != second for first, second in zip(*seen, strict=True))


@pytest.mark.long
def test_other_sensors_as_measured_count(arm: Path) -> None:
    """The error of the tool's prior is in the arm's contact force where the tool's own reading is used."""
    experiment = load_experiment(arm / TWO)
    calibration = _fitted(experiment, regularisation=100.0)  # more of the prior would hide it
    seen = [
        _criteria(experiment, _spec(validate={"force_mean_N": 1e9, "other_sensors": mode}), calibration)
        for mode in ("model", "measured")
    ]
    first, second = (each["validate.force_mean_N"].measured for each in seen)
    assert second > 2.0 * first


def test_without_a_calibration_the_prior_is_judged(arm: Path) -> None:
    """By contact force and matrix; its force is larger than that of the fit."""
    experiment = load_experiment(arm / PARQUET)
    spec = _spec(validate={"force_mean_N": 1e9}, matrix={"condition": 1e9})
    prior, new = _criteria(experiment, spec, None), _criteria(experiment, spec, _fitted(experiment))
    assert prior["validate.force_mean_N"].measured > 5.0 * new["validate.force_mean_N"].measured
    assert prior["matrix.condition"].measured != new["matrix.condition"].measured


def test_a_prior_without_data_for_an_offset_is_judged_with_what_it_has(arm: Path) -> None:
    """Its own offset is none: the sensor's own one is in the error, which fails where the first second hides it."""
    edit(arm / PARQUET, 'use = "calibration"', 'use = "ignore"')
    experiment = load_experiment(arm / PARQUET)
    forces = [
        _criteria(experiment, _spec(validate={"force_mean_N": 1e9, "offset": offset}), None)["validate.force_mean_N"]
        for offset in ("fitted", "first-second")
    ]
    assert forces[0].measured > 1.5 * forces[1].measured > 0.0


@pytest.mark.long
def test_a_choice_made_on_the_judged_interval_is_a_warning(drifting: Experiment) -> None:
    """Where errors are judged, in evaluation, improvement or validation; not where only the matrix is."""
    name, calibration = _fitted(drifting)
    (judged,) = drifting.intervals(Use.VALIDATION)
    span = FittedInterval(label="day", start_ns=judged.start_ns, end_ns=judged.end_ns)
    chosen = calibration.model_copy(update={"selection": Selection(rule="best of two", chosen_on=(span,))})
    tables = ("evaluate", "improvement", "validate", "matrix", "offset")
    words = "new was chosen among others on 'judge' too, so the verdict on it flatters"
    for table in tables:
        expected = (words,) if table not in ("matrix", "offset") else ()
        spec = _spec(**{table: LIMITS[table]})
        plain = accept(_run(drifting), spec, (name, calibration))
        assert len(plain.validity) == len(expected)
        assert plain.warnings == sentences(plain.validity)
        assert accept(_run(drifting), spec, (name, chosen)).warnings == (*plain.warnings, *expected)


def test_what_evaluate_forbids_is_not_accepted(arm: Path) -> None:
    """The verdict of `evaluate` on the same data counts, though every limit holds; a good calibration passes."""
    experiment = load_experiment(arm / PARQUET)
    name, good = _fitted(experiment)
    wrong = good.model_copy(update={"matrix": 2.0 * np.asarray(good.matrix)})
    spec = _spec(evaluate={"force_error_mean_N": 1e9})
    for calibration, decision in ((good, None), (wrong, "do not use")):
        accepted = accept(_run(experiment), spec, (name, calibration))
        assert accepted.load_cases == evaluate(_run(experiment), {name: calibration}).load_cases
        forbidden = [row for row in accepted.criteria if row.criterion.startswith("verdict.")]
        assert [use.load_case for use in accepted.load_cases if use.decision == "do not use"] == [
            row.criterion.removeprefix("verdict.") for row in forbidden
        ]
        assert (accepted.accepted or accepted.undecided) is (decision is None) is not bool(forbidden)
        # each says first why
        reasons = {f"verdict.{use.load_case}": use.reasons for use in accepted.load_cases}
        assert [row.note for row in forbidden] == [reasons[row.criterion][0].text for row in forbidden]


def test_a_file_that_limits_errors_leaves_a_sensor_undecided_where_evaluate_lacks_data(arm: Path) -> None:
    """Every limit holds, and the loads to come are more than the data show; a file of the matrix alone accepts it."""
    experiment = load_experiment(arm / PARQUET)
    name, good = _fitted(experiment)
    doubted = good.model_copy(update={"warnings": ("gains of 12 %",)})
    limits: dict[str, dict[str, Any]] = {"evaluate": {"force_error_mean_N": 1e9}, "matrix": {"condition": 1e9}}
    for table, undecided in (("evaluate", True), ("matrix", False)):
        result = accept(_run(experiment), _spec(**{table: limits[table]}), (name, doubted))
        assert [use.decision for use in result.load_cases] == ["not enough data"]
        assert all(row.passed for row in result.criteria)
        assert (result.accepted, result.undecided, result.passed) == (not undecided, undecided, not undecided)
        (answer,) = result.answers()
        assert answer.verdict == ("UNDECIDED" if undecided else "ACCEPTED")
        assert Acceptance.together([result, result]).undecided is undecided


def test_limits_of_the_matrix_need_no_verdict(arm: Path) -> None:
    """Validation data that were fitted leave no verdict: a warning says so, and what is stated is judged."""
    experiment = load_experiment(arm / PARQUET)
    name, good = _fitted(experiment)
    (judged,) = experiment.intervals(Use.VALIDATION)
    span = FittedInterval(label="judge", start_ns=judged.start_ns, end_ns=judged.end_ns)
    provenance = good.provenance.model_copy(update={"intervals": (span,)})
    fitted = good.model_copy(update={"provenance": provenance})
    accepted = accept(_run(experiment), _spec(matrix={"condition": 1e9}), (name, fitted))
    assert accepted.accepted
    assert accepted.load_cases == ()
    assert ["no verdict on its use" in words for words in accepted.warnings] == [True]


def test_together_every_sensor_must_pass(arm: Path) -> None:
    """One sensor that fails is enough, in either order; nobody can state another verdict than the criteria give."""
    experiment = load_experiment(arm / TWO)
    first, second = experiment.sensors
    runs = [SensorRun(experiment, first), SensorRun(experiment, replace(second, prior=MOUNTED))]
    conditions = [check(run).condition or 0.0 for run in runs]
    spec = _spec(matrix={"condition": sum(conditions) / 2.0})
    single = [accept(run, spec) for run in runs]
    assert sorted(result.accepted for result in single) == [False, True]
    for results in (single, single[::-1]):
        both = Acceptance.together(results)
        assert not both.accepted
        assert [row.sensor for row in both.measured] == [row.sensor for row in both.criteria]
        assert len(both.criteria) == 2
    (passing,) = [result for result in single if result.accepted]
    (failing,) = [result for result in single if not result.accepted]
    assert Acceptance.together([passing, passing]).accepted
    assert not Acceptance.model_validate({**dict(failing), "accepted": True}).accepted


@pytest.mark.long
def test_an_acceptance_shows_itself(drifting: Experiment) -> None:
    """On a narrow page no number is folded; a notebook gets the table; the first words of it are few."""
    result = accept(_run(drifting), _spec(**LIMITS), _fitted(drifting), population=OTHERS)
    narrow, wide = result.text(60), result.text(120)
    for row in result.criteria:
        assert f"{row.measured:.4g}" in narrow.split()
        assert row.criterion in wide.split()
    assert max(len(line) for line in narrow.splitlines()) <= 60
    assert "<th" in result._repr_html_()
    assert ">evaluate.rmse.fx</td>" in result._repr_html_()
    assert len(repr(result)) < 600
    assert result.records()[0]["passed"] is True
    assert list(json.loads(result.json_text())) == [
        "schema", "figure", "experiment", "specification", "accepted", "undecided", "criteria", "measured", "validity",
        "load_cases",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("table", "key", "reason"),
    [
        ("evaluate", "rmse", "evaluates a calibration, none was given of 'arm_ft'"),
        ("improvement", "force_error_ratio", "evaluates a calibration"),
        ("uncertainty", "offset", "evaluates a calibration"),
        ("excitation", "directions", "evaluates a calibration"),
        ("information_gain", "fz", "evaluates a calibration"),
        ("population", "robust_z", "no matrices of other sensors were given; name them by --population"),
        ("recording", "lost_share", "stream 'arm_ft' has no sequence numbers"),
        ("offset", "per_degree", "expected a variable of the sensor in degC"),
    ],
)
def test_what_cannot_be_judged_is_an_error_that_names_it(arm: Path, table: str, key: str, reason: str) -> None:
    """Sensor, table and reason; the same limit is no obstacle where it is not stated."""
    experiment = load_experiment(arm / PARQUET)
    with pytest.raises(ForceTorqueError, match=rf"^sensor 'arm_ft': \[{table}\] cannot be evaluated: .*{reason}"):
        accept(_run(experiment), _spec(**{table: {key: LIMITS[table][key]}}))
    assert len(accept(_run(experiment), _spec(matrix={"condition": 5.0})).criteria) == 1


@pytest.mark.long
def test_missing_intervals_and_counts_are_errors(arm: Path) -> None:
    """No validation interval, one interval to compare offsets of, a stream without counts."""
    edit(arm / PARQUET, 'use = "validation"', 'use = "ignore"')
    experiment = load_experiment(arm / PARQUET)
    for table, reason in (
        ("evaluate", 'expected an interval with use = "validation"'),
        ("validate", 'expected an interval with use = "validation"'),
        ("offset", "at least 2 recordings, got 1"),
    ):
        with pytest.raises(ForceTorqueError, match=rf"\[{table}\] cannot be evaluated: .*{reason}"):
            _criteria(experiment, _spec(**{table: LIMITS[table]}), _fitted(experiment))
    edit(arm / YARP, 'prior = "matrix_SIM001.txt"', 'prior = "identity"')
    unknown = load_experiment(arm / YARP)
    with pytest.raises(ExperimentError, match=r"\[matrix\] cannot be evaluated: the matrix is not for counts"):
        _criteria(unknown, _spec(matrix={"condition": 5.0}), None)


def test_what_a_calibration_lacks_is_an_error(arm: Path) -> None:
    """No standard errors of a kept prior, no improvement without one, no full scale of a singular matrix."""
    experiment = load_experiment(arm / PARQUET)
    name, calibration = _fitted(experiment)
    kept = calibration.model_copy(update={"matrix_standard_error": None, "offset_standard_error": None})
    for key in ("matrix_relative", "offset"):
        with pytest.raises(ExperimentError, match="standard error"):
            _criteria(experiment, _spec(uncertainty={key: LIMITS["uncertainty"][key]}), (name, kept))
    first = calibration.model_copy(update={"prior": None})
    with pytest.raises(ExperimentError, match="has no prior to improve on"):
        _criteria(experiment, _spec(improvement={"force_error_ratio": 1.0}), (name, first))
    equal = np.array(calibration.matrix)
    equal[4] = equal[3]
    singular = (name, calibration.model_copy(update={"matrix": equal}))
    found = _criteria(experiment, _spec(matrix={"condition": 1e12}), singular)["matrix.condition"]
    assert (found.measured, found.passed) == (math.inf, False)
    with pytest.raises(ExperimentError, match="full_scale: .*singular"):
        _criteria(experiment, _spec(matrix={"full_scale": NONE}), singular)


HEAD = 'schema = "forcetorque/acceptance/1"\nname = "limits"\n'


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (HEAD, "expected at least one table of limits: evaluate, excitation, improvement"),
        (HEAD + "[evaluate]\n", "evaluate: expected at least one limit: bias, force_error_largest_N"),
        (HEAD + '[evaluate]\noffset = "fitted"\n', "evaluate: expected at least one limit"),
        (HEAD + "[evaluate]\nrms = 3.0\n", r"evaluate: unknown key 'rms'; did you mean .rmse.\? known: "),
        (HEAD + "[evalute]\nrmse = 3.0\n", "unknown key 'evalute'; did you mean"),
        (HEAD + "[evaluate]\nrmse = [1.0, 2.0]\n", "evaluate.rmse: expected six numbers, fx fy fz tx ty tz"),
        (HEAD + "[evaluate]\nrmse = { fq = 1.0 }\n", "evaluate.rmse.fq"),
        (HEAD + "[evaluate]\nrmse = {}\n", "evaluate.rmse"),
        (HEAD + "[evaluate]\nrmse = { fz = -1.0 }\n", "evaluate.rmse.fz: .*at least 0"),
        (HEAD + "[evaluate]\nforce_error_mean_N = nan\n", "evaluate.force_error_mean_N: .*finite"),
        (HEAD + '[evaluate]\nforce_error_mean_N = "2"\n', "evaluate.force_error_mean_N: .*number"),
        (HEAD + '[evaluate]\noffset = "none"\nbias = { fz = 1.0 }\n', "evaluate.offset: .*'fitted' or 'judged-mean'"),
        (HEAD + '[evaluate]\noffset = "re-estimated"\nbias = { fz = 1 }\n', 'evaluate.offset: .*write "judged-mean"'),
        (HEAD + '[improvement]\noffset = "re-estimated"\nforce_error_ratio = 1\n', '.offset: .*write "judged-mean"'),
        (HEAD + '[validate]\noffset = "re-estimated"\nforce_mean_N = 1\n', 'validate.offset: .*write "first-second"'),
        (HEAD + '[validate]\noffset = "judged-mean"\nforce_mean_N = 1\n', "'first-second' or 'fitted'"),
        (HEAD + "[recording]\nsaturated_share = 2.0\n", "recording.saturated_share: .*at most 1"),
        (HEAD + "[population]\nquantiles = [0.9, 0.1]\n", "quantiles: expected the lower one first"),
        (HEAD + "[population]\nquantiles = [0.1]\n", r"population.quantiles: expected 2 values, got \[0\.1\]$"),
        (HEAD + "[population]\nquantiles = [-0.1]\n", r"population.quantiles\[0\]: expected at least 0, got -0\.1$"),
        (HEAD + "[excitation]\ndirections = 5.5\n", "excitation.directions"),
        (HEAD + "[information_gain]\nfz = 97.0\n", "information_gain.fz: .*at most 1"),
        (HEAD.replace("/1", "/2") + "[matrix]\ncondition = 3.0\n", "schema: .*'forcetorque/acceptance/1'"),
        ('name = "limits"\n[matrix]\ncondition = 3.0\n', "schema: expected this key, there is none"),
        ("[evaluate", "expected TOML"),
    ],
)
def test_wrong_files_are_refused_with_their_key(tmp_path: Path, text: str, message: str) -> None:
    """File, key and what was expected, in one line."""
    file = tmp_path / "limits.toml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(FormatError, match=rf"^{file}: .*{message}") as refused:
        read_acceptance(file)
    assert "\n" not in str(refused.value).replace(text, "")


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    """The path, and that an acceptance file was expected."""
    with pytest.raises(MissingFileError, match="none.toml: expected an acceptance file, there is none"):
        read_acceptance(tmp_path / "none.toml")


def test_lists_and_tables_per_axis_mean_the_same(tmp_path: Path) -> None:
    """Six numbers in the order of the wrench, or by name; integers are numbers too."""
    file = tmp_path / "limits.toml"
    file.write_text(HEAD + "[evaluate]\nrmse = [1, 2.0, 3, 4, 5, 6]\nbias = { tz = 6 }\n", encoding="utf-8")
    spec = read_acceptance(file)
    assert spec.evaluate is not None
    assert spec.evaluate.rmse == dict(zip(WRENCH_COMPONENTS, range(1, 7), strict=True))
    assert spec.evaluate.bias == {"tz": 6.0}


def test_the_example_states_limits_of_every_table() -> None:
    """Who copies it sees all tables."""
    spec = read_acceptance(ROOT / "examples" / "11_acceptance.toml")
    assert all(getattr(spec, "validate_" if key == "validate" else key) is not None for key in LIMITS)
