# SPDX-License-Identifier: BSD-3-Clause
"""Experiments in the hand of a script: from a file and from arrays, with the same answers as the command line."""

from __future__ import annotations

import copy
import pickle
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

import forcetorque
from forcetorque.app.python.experiment import Experiment, load_experiment
from forcetorque.app.python.experiment_of_arrays import experiment_of_arrays
from forcetorque.app.python.run import Run
from forcetorque.base.errors import ExperimentError, FitError, RecordingError, ShapeError
from forcetorque.calibration.calibrate import data_doubts
from forcetorque.calibration.summary import information_gains
from forcetorque.evaluation.commands import evaluate, validate
from forcetorque.evaluation.load_cases.verdict import use_verdicts
from forcetorque.evaluation.sphere.sphere import spheres
from forcetorque.experiment.calibration.calibration_file import read_calibration
from forcetorque.experiment.calibration.estimation_type import ESTIMATION_TYPES
from forcetorque.experiment.calibration.robot_model_error import EXACT
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.planning.planning import plan as analysis_plan
from forcetorque.planning.proposed_recordings import Effort
from forcetorque.recording.recording import Finding, Use
from tests.app.python.arrays import arrays_of
from tests.scenes.experiment_folders import arm, intact
from tests.scenes.experiments import JOINTS, PARQUET

__all__ = ["arm", "intact"]


@pytest.fixture
def experiment(arm: Path) -> Experiment:
    """The experiment of the small arm, from its file."""
    return load_experiment(arm / PARQUET)


@pytest.mark.usefixtures("blank_pictures")
def test_a_sensor_is_chosen_by_name_and_asked_by_method(experiment: Experiment, tmp_path: Path) -> None:
    """Calibrate, evaluate, verdict and report in a line each; the calibration is saved and read."""
    run = experiment["arm_ft"]
    calibration = run.calibrate()
    assert calibration.provenance.code_version
    evaluation = run.evaluate(calibration)
    asked = evaluate(SensorRun(experiment, "arm_ft"), {"calibration": calibration})
    assert evaluation.json_text() == asked.json_text()
    assert run.verdicts(calibration) == evaluation.load_cases
    calibration.save(tmp_path / "arm.json")
    np.testing.assert_array_equal(read_calibration(tmp_path / "arm.json").matrix, calibration.matrix)
    run.report({"mine": calibration}).save(tmp_path / "a.html")
    assert "mine" in (tmp_path / "a.html").read_text(encoding="utf-8")
    assert run.validate(calibration).contact_forces


def test_arrays_give_what_the_file_gives(experiment: Experiment) -> None:
    """The same matrix, errors and expected wrenches, but for instants that are rounded to a nanosecond."""
    arrays = experiment_of_arrays(**arrays_of(experiment))
    one, other = experiment["arm_ft"], arrays["arm_ft"]
    fitted, same = one.calibrate(), other.calibrate()
    np.testing.assert_allclose(same.matrix, fitted.matrix, rtol=1e-6, atol=1e-9)  # instants are rounded to 1 ns
    np.testing.assert_allclose(same.offset, fitted.offset, rtol=1e-6)
    _, expected = other.expected_wrenches("validate")
    label = next(i.label for i in experiment.recording.intervals if i.use is Use.VALIDATION)
    np.testing.assert_allclose(expected, one.expected_wrenches(label)[1], atol=1e-5)
    rows = zip(one.evaluate(fitted).verdicts, other.evaluate(same).verdicts, strict=True)
    for row, twin in rows:
        assert twin.force_error_mean_N == pytest.approx(row.force_error_mean_N, rel=1e-5)


def test_the_robot_model_may_be_off_unless_it_is_said_to_be_exact(experiment: Experiment) -> None:
    """By the defaults of a file, or as specified."""
    for tolerance, mass in ((None, 0.03), ({"mass_relative": 0.1}, 0.1), ("exact", 0.0)):
        made = experiment_of_arrays(**arrays_of(experiment, tolerance=tolerance))
        assert made.fit_options.tolerance.mass == mass
    assert made.fit_options.tolerance == EXACT


@pytest.mark.long
def test_arrays_may_come_in_frames_of_pandas(experiment: Experiment) -> None:
    """Readings, instants and joint positions: the columns of one frame, or of several."""
    arguments = arrays_of(experiment)
    joints = pd.DataFrame(arguments["joints"])
    readings = pd.DataFrame(arguments["reading"], columns=[f"ch{k}" for k in range(6)])
    frames = {"joints": joints, "reading": readings, "time_s": pd.Series(arguments["time_s"])}
    by_frames = experiment_of_arrays(**arguments | frames)["arm_ft"].calibrate()
    np.testing.assert_array_equal(by_frames.matrix, experiment_of_arrays(**arguments)["arm_ft"].calibrate().matrix)


@pytest.mark.long
def test_several_spans_are_fitted_and_judged(experiment: Experiment) -> None:
    """Halves of a span hold its samples; intervals are numbered where there are several of a use."""
    arguments = arrays_of(experiment)
    start, end = arguments["calibrate"]
    first, last = arguments["validate"]
    halves = {
        "calibrate": [(start, 0.5 * (start + end)), (0.5 * (start + end), end)],
        "validate": np.array([(first, 0.4 * first + 0.6 * last), (0.7 * last + 0.3 * first, last)]),
    }
    several = experiment_of_arrays(**arguments | halves)
    labels = [interval.label for interval in several.recording.intervals]
    assert labels == ["calibrate 1", "calibrate 2", "validate 1", "validate 2"]
    assert {role.kind for role in several.roles.values()} == {"calibrate", "validate"}
    run, whole = several["arm_ft"], experiment_of_arrays(**arguments)["arm_ft"]
    calibration = run.calibrate()
    assert calibration.provenance.samples == whole.calibrate().provenance.samples
    all_judged = whole.evaluate(calibration).verdicts[0].samples
    assert 0.85 * all_judged < run.evaluate(calibration).verdicts[0].samples < 0.95 * all_judged
    time_s, _ = run.expected_wrenches("validate 2")
    assert time_s[0] >= halves["validate"][1, 0]
    listed = experiment_of_arrays(**arguments | {"calibrate": [arguments["calibrate"]]})
    assert [interval.label for interval in listed.recording.intervals] == ["calibrate", "validate"]


@pytest.mark.long
def test_a_calibrated_wrench_needs_the_matrix_that_made_it(experiment: Experiment) -> None:
    """Or the identity with full scales; the calibration is then of the wrench."""
    prior = experiment.sensors[0].prior
    assert prior is not None
    arguments = arrays_of(experiment)
    wrench = arguments["reading"] @ prior.T
    with pytest.raises(ExperimentError, match="needs the prior that made it"):
        experiment_of_arrays(**arguments | {"reading": wrench, "quantity": "wrench", "prior": None})
    by_prior = experiment_of_arrays(**arguments | {"reading": wrench, "quantity": "wrench"})["arm_ft"].calibrate()
    np.testing.assert_allclose(by_prior.matrix, experiment["arm_ft"].calibrate().matrix, rtol=1e-6)
    unknown = {"reading": wrench, "quantity": "wrench", "prior": np.eye(6), "full_scale": [900.0] * 3 + [30.0] * 3}
    assert experiment_of_arrays(**arguments | unknown)["arm_ft"].calibrate().matrix.shape == (6, 6)


@pytest.mark.parametrize(
    ("changes", "error", "message"),
    [
        ({"support": "bse"}, ExperimentError, "support: the robot 'arm' has no link 'bse'"),
        ({"joints": {"knee": np.zeros(3)}}, ExperimentError, "joints: expected names of joints .*got knee"),
        ({"joints": {}}, ExperimentError, "joints: expected names of joints .*got none"),
        ({"time_s": np.zeros(5)}, ExperimentError, "time_s: expected finite instants that rise"),
        ({"reading": np.zeros((7, 6))}, ShapeError, "reading"),
        ({"sensor": "leg"}, forcetorque.ForceTorqueError, "leg"),
        ({"gravity_direction": [0, 0, 0]}, forcetorque.ForceTorqueError, "gravity_direction"),
        ({"limit_counts": 0.0}, ExperimentError, "limit_counts: expected a positive number of counts, got 0.0"),
        ({"calibrate": (9.0, 2.0)}, forcetorque.ForceTorqueError, "expected an end after its start"),
        ({"calibrate": (1.0, 2.0, 3.0)}, ExperimentError, r"calibrate: expected one span.*got \(1.0, 2.0, 3.0\)"),
        ({"calibrate": [(1, 2), (3, 4, 5)]}, ExperimentError, "calibrate: expected one span.*or a list of them"),
        ({"calibrate": []}, ExperimentError, "calibrate: expected one span"),
        ({"calibrate": [[(1, 2), (3, 4)]]}, ExperimentError, "calibrate: expected one span"),
        ({"calibrate": np.arange(999.0)}, ExperimentError, r"calibrate: .* got ndarray of shape \(999,\)"),
        (
            {"calibrate": [(3, 5), (1, 4)]},
            ExperimentError,
            "calibrate: expected spans that do not overlap, got 'calibrate 2' to 4 s and 'calibrate 1' from 3 s",
        ),
        (
            {"calibrate": (1, 4), "validate": (3, 5)},
            ExperimentError,
            "calibrate and validate: expected spans that do not overlap, got 'calibrate' to 4 s and 'validate' from",
        ),
        ({"calibrate": None}, ExperimentError, "calibrate: expected one span"),
        ({"validate": (np.nan, 2.0)}, ExperimentError, "validate: expected one span"),
        ({"validate": (0.0, np.inf)}, ExperimentError, "validate: expected one span"),
        (
            {"time_s": pd.date_range("2026-01-01", periods=5)},
            ExperimentError,
            "time_s: expected numbers, .*timedelta64",
        ),
        ({"time_s": np.arange(5, dtype="timedelta64[ns]")}, ExperimentError, "time_s: expected numbers, .*timedelta64"),
        ({"time_s": 1.7e18 + 1e9 * np.arange(5)}, ExperimentError, "time_s: expected seconds.*divide nanoseconds"),
        ({"robot": "<robot name='arm'/>"}, ExperimentError, "robot: expected the path of a URDF file, got its text"),
        ({"robot": None}, ExperimentError, "robot: expected a RobotModel or the path of a URDF file, got None"),
        ({"sensor": None}, forcetorque.ForceTorqueError, "no force-torque sensor None; known: arm_ft"),
        (
            {"joints": np.zeros((9, 5))},
            ExperimentError,
            r"joints: .*dictionary or a pandas frame, got ndarray of shape",
        ),
        ({"reading": np.zeros((9, 6), dtype=complex)}, ExperimentError, "reading: expected numbers"),
        ({"quantity": "wrnch"}, ExperimentError, "quantity: expected 'raw' or 'wrench', got 'wrnch'"),
        ({"serial": 26}, ExperimentError, "serial: expected the serial number as text, such as 'SN026', got 26"),
        ({"serial": ""}, ExperimentError, "serial: expected the serial number as text"),
        ({"prior": "matrix.txt"}, ExperimentError, "prior: expected numbers, got 'matrix.txt'"),
        ({"prior": np.full((6, 6), np.nan)}, ExperimentError, "prior: expected a matrix of finite numbers"),
        ({"full_scale": [0.0] * 6}, ExperimentError, "full_scale: expected six finite numbers above 0"),
        ({"gravity_direction": "down"}, ExperimentError, "gravity_direction: expected numbers, got 'down'"),
        ({"limit_counts": None}, ExperimentError, "limit_counts: expected a positive number of counts, got None"),
    ],
)
def test_arrays_that_do_not_fit_are_refused(
    experiment: Experiment, changes: dict[str, Any], error: type[Exception], message: str
) -> None:
    """In one line of words that name the argument, however large it is."""
    with pytest.raises(error, match=message) as refused:
        experiment_of_arrays(**arrays_of(experiment, **changes))
    assert "\n" not in str(refused.value)
    assert len(str(refused.value)) < 300


def test_milliseconds_for_seconds_are_refused_with_the_likely_cause(experiment: Experiment) -> None:
    """All stamps and spans a thousand times too large contradict no other argument."""
    arguments = arrays_of(experiment)
    times = {name: 1000.0 * np.asarray(arguments[name]) for name in ("time_s", "joint_time_s", "calibrate", "validate")}
    with pytest.raises(RecordingError, match="lengthen the window, or specify the stamps in their unit"):
        experiment_of_arrays(**arguments | times)["arm_ft"].calibrate()


@pytest.mark.long
def test_what_is_missing_is_no_reading(experiment: Experiment) -> None:
    """Samples that are masked, or NA of pandas, are left out as NaN is; the values below a mask were fitted."""
    arguments = arrays_of(experiment)
    lost = np.arange(len(arguments["reading"])) % 10 == 3
    holes = np.where(lost[:, None], np.nan, arguments["reading"])
    masked = np.ma.masked_array(np.where(lost[:, None], 7.0, holes), mask=np.repeat(lost[:, None], 6, axis=1))
    expected = experiment_of_arrays(**arguments | {"reading": holes})["arm_ft"].calibrate()
    for reading in (masked, pd.DataFrame(holes).convert_dtypes()):
        calibration = experiment_of_arrays(**arguments | {"reading": reading})["arm_ft"].calibrate()
        assert calibration.provenance.samples == expected.provenance.samples
        np.testing.assert_array_equal(calibration.matrix, expected.matrix)


@pytest.mark.long
def test_a_clock_among_the_counts_is_refused(experiment: Experiment) -> None:
    """Without a prior nothing else says how many channels there are: seven columns were fitted without a word."""
    arguments = arrays_of(experiment, prior=None, full_scale=[900.0] * 3 + [30.0] * 3)
    run = experiment_of_arrays(**arguments)["arm_ft"]
    assert run.calibrate().matrix.shape == (6, 6)
    timed = np.column_stack([arguments["time_s"], arguments["reading"]])
    with pytest.raises(FitError, match="channel ch0, column 1 of 7 of the raw reading, rises"):
        experiment_of_arrays(**arguments | {"reading": timed})["arm_ft"].calibrate()


def test_a_span_of_one_sample_is_refused_and_one_of_few_is_a_doubt(
    experiment: Experiment, caplog: pytest.LogCaptureFixture
) -> None:
    """A prior fits them all the same, and only judging showed that nothing was learnt."""
    arguments = arrays_of(experiment)
    start, step = arguments["calibrate"][0], float(np.median(np.diff(arguments["time_s"])))
    with pytest.raises(FitError, match="stands still"):
        experiment_of_arrays(**arguments | {"calibrate": (start, start + 1.0 * step)})["arm_ft"].calibrate()
    with caplog.at_level("WARNING", logger="forcetorque"):
        experiment_of_arrays(**arguments | {"calibrate": (start, start + 12.0 * step)})["arm_ft"].calibrate()
    assert "12 samples are fitted, which do not tell" in caplog.text


def test_what_is_to_be_done_is_said_in_words_of_python(experiment: Experiment) -> None:
    """Who has arrays has no table of a file to change, and who calls a method no option of a command."""
    arguments = arrays_of(experiment)
    joints = {name: values for name, values in arguments["joints"].items() if name != JOINTS[-1]}
    with pytest.raises(RecordingError, match=f"joint '{JOINTS[-1]}'.*, among arrays repeat its position"):
        experiment_of_arrays(**arguments | {"joints": joints})["arm_ft"].calibrate()
    still = {name: np.zeros_like(values) for name, values in arguments["joints"].items()}
    with pytest.raises(FitError, match="to where the limb moves, among arrays calibrate$"):
        experiment_of_arrays(**arguments | {"joints": still})["arm_ft"].calibrate()
    run = experiment_of_arrays(**arguments)["arm_ft"]
    with pytest.raises(ExperimentError, match="by --clearance-deg, from Python clearance_deg$"):
        run.plan()
    with pytest.raises(ExperimentError, match="by --force, from Python force"):
        run.response("impact", mass_kg=1.0)


def test_columns_of_a_wrench_in_another_order_are_refused(experiment: Experiment) -> None:
    """A frame whose columns are named says itself that moments come first; they were taken for forces."""
    arguments = arrays_of(experiment, quantity="wrench", prior=np.eye(6), full_scale=[900.0] * 3 + [30.0] * 3)
    frame = pd.DataFrame(arguments["reading"] * 1e-3, columns=["fx", "fy", "fz", "tx", "ty", "tz"])
    with pytest.raises(ExperimentError, match="in this order, got tx, ty, tz, fx, fy, fz"):
        experiment_of_arrays(**arguments | {"reading": frame[["tx", "ty", "tz", "fx", "fy", "fz"]]})
    assert experiment_of_arrays(**arguments | {"reading": frame}).sensors


def test_an_experiment_is_a_collection_of_sensors_by_name(experiment: Experiment) -> None:
    """It lists their names, knows whether it has one, offers them to a notebook, and names them where one is wrong."""
    assert list(experiment) == ["arm_ft"] == experiment._ipython_key_completions_()
    assert "arm_ft" in experiment
    assert "leg_ft" not in experiment
    assert 0 not in experiment
    with pytest.raises(ExperimentError, match="has no sensor 0; known: arm_ft"):
        experiment[0]  # type: ignore[index]


def test_the_limit_of_the_converter_is_that_of_16_bits_or_stated(experiment: Experiment) -> None:
    """As in a file; head-room is counted from it."""
    one, other = (
        experiment_of_arrays(**arrays_of(experiment, **changes)).sensors[0]
        for changes in ({}, {"limit_counts": 2047.0})
    )
    assert one.limit_counts == experiment.sensors[0].limit_counts
    assert other.limit_counts == 2047.0


def test_what_to_record_next_is_planned_fromarrays_of(experiment: Experiment) -> None:
    """As from the file, and as the function says it."""
    run = experiment_of_arrays(**arrays_of(experiment))["arm_ft"]
    quick: dict[str, Any] = {"clearance_deg": 5.0, "recordings": 1, "effort": Effort(postures=30, swaps=5)}
    plan = run.plan(**quick)
    assert len(plan.recordings) == 1
    assert plan.advice == analysis_plan(run, **quick).advice == experiment["arm_ft"].plan(**quick).advice
    assert run.plan(run.calibrate(), **quick).advice != plan.advice


@pytest.mark.long
def test_without_a_span_to_judge_nothing_is_judged(experiment: Experiment) -> None:
    """A fit is had all the same, and may not be used yet."""
    run = experiment_of_arrays(**arrays_of(experiment, validate=None))["arm_ft"]
    calibration = run.calibrate()
    assert [verdict.decision for verdict in run.verdicts(calibration)] == ["not enough data"]
    with pytest.raises(ExperimentError, match="expected an interval"):
        run.evaluate(calibration)
    with pytest.raises(ExperimentError, match="no interval is labelled 'validate'"):
        run.expected_wrenches("validate")
    with pytest.raises(FitError):
        run.calibrate(nonlinear=True, kind="generative")


@pytest.mark.long
def test_what_makes_a_fit_doubtful_is_said(arm: Path, caplog: pytest.LogCaptureFixture) -> None:
    """A channel that reaches its limit in fitted samples is logged, as `calibrate` of the command line warns of it."""
    experiment = load_experiment(arm / PARQUET)
    with caplog.at_level("WARNING", logger="forcetorque"):
        experiment["arm_ft"].calibrate()
    assert caplog.messages == []
    fitted = experiment["arm_ft"].samples(Use.CALIBRATION)[0].readings.raw
    saturated = experiment_of_arrays(**arrays_of(experiment, limit_counts=float(np.abs(fitted).max())))["arm_ft"]
    expected = list(data_doubts(saturated))
    assert any("saturation" in sentence for sentence in expected)
    with caplog.at_level("WARNING", logger="forcetorque"):
        saturated.calibrate()
    assert caplog.messages[: len(expected)] == expected


def test_the_page_of_an_experiment_says_what_was_found_while_reading(experiment: Experiment) -> None:
    """Findings of the log, with what would be markup escaped; none where there are none."""
    assert "warning" not in experiment._repr_html_()
    found = Finding(kind="gap", message="3 messages <lost>", stream="arm_ft", start_ns=0, end_ns=1, count=3)
    told = Experiment.of(replace(experiment, recording=replace(experiment.recording, findings=(found,))))
    assert told._repr_html_().startswith("<p><b>warning:</b> arm_ft: 3 messages &lt;lost&gt;</p>")


def test_the_page_of_a_calibration_says_what_was_learnt_and_what_is_doubtful(experiment: Experiment) -> None:
    """The share of every load that the recording decided, and doubts before the matrix."""
    calibration = experiment["arm_ft"].calibrate()
    rows = information_gains(calibration)
    assert rows is not None
    page = calibration.model_copy(update={"warnings": ("a < b",)})._repr_html_()
    assert page.startswith("<p><b>warning:</b> a &lt; b</p><table ")
    assert all(f"{row.direction} {100.0 * row.uncertainty_reduction:.0f} %" in page for row in rows)


def test_what_a_notebook_shows_is_short(experiment: Experiment) -> None:
    """One line for an experiment, a run and a calibration; tables of HTML for experiment and calibration."""
    run = experiment["arm_ft"]
    calibration = run.calibrate()
    assert isinstance(run, Run)
    for thing in (experiment, run, calibration):
        assert len(repr(thing)) < 300
        assert "arm_ft" in repr(thing)
    assert str(calibration) == repr(calibration)
    assert "<td" in experiment._repr_html_()
    assert f"{calibration.matrix[0, 0]:.4g}" in calibration._repr_html_()


@pytest.mark.parametrize("question", ["evaluate", "validate", "verdicts", "plan", "figure"])
def test_what_is_no_calibration_is_refused_in_a_line(experiment: Experiment, question: str) -> None:
    """The file of one is named with what reads it; so is another thing under a name."""
    ask = getattr(experiment["arm_ft"], question)
    with pytest.raises(
        ExperimentError, match=r"expected a Calibration.*; read_calibration\('arm.json'\) reads a file$"
    ):
        ask("arm.json")
    with pytest.raises(ExperimentError, match="expected a Calibration.*, got a int$"):
        ask(26)
    if question != "plan":
        with pytest.raises(
            ExperimentError, match=r"calibrations\['mine'\]: expected a Calibration, got 'arm.json'; read"
        ):
            ask({"mine": Path("arm.json")})


@pytest.mark.long
def test_verdicts_show_themselves_as_a_table(experiment: Experiment) -> None:
    """A row per calibration and load case; the tuple that they are stays one, and their records are flat."""
    run = experiment["arm_ft"]
    calibration = run.calibrate()
    verdicts = run.verdicts({"mine": calibration, "theirs": calibration})
    assert isinstance(verdicts, tuple)
    assert len(verdicts) == len(verdicts.records()) == 2 * len(run.verdicts(calibration)) > 0
    assert [record["decision"] for record in verdicts.records()] == [verdict.decision for verdict in verdicts]
    page, text = verdicts._repr_html_(), " ".join(str(verdicts).split())
    assert page.count("<tr>") == len(verdicts) + 1
    for verdict in verdicts:
        assert all(f">{cell}</td>" in page for cell in (verdict.calibration, verdict.load_case, verdict.decision))
        assert f"{verdict.calibration} {verdict.load_case} {verdict.decision}" in text
    assert "LoadCaseVerdict(" not in text


@pytest.mark.long
def test_one_calibration_needs_no_name(experiment: Experiment) -> None:
    """The functions of `analysis` take it as the methods do."""
    run = experiment["arm_ft"]
    calibration = run.calibrate()
    assert evaluate(run, calibration).json_text() == run.evaluate(calibration).json_text()
    assert validate(run, calibration).json_text() == run.validate(calibration).json_text()
    assert use_verdicts(run, calibration) == run.verdicts(calibration)
    assert [row.calibration for row in spheres(run, calibration).rows] == ["prior", "calibration"]


def test_an_estimation_type_is_given_by_its_name(experiment: Experiment) -> None:
    """As on the command line; another name, and a lambda that is no number, are refused in a line."""
    run = experiment["arm_ft"]
    by_name = run.calibrate(kind="OnTdTO", regularisation=1000.0)
    by_type = run.calibrate(kind=ESTIMATION_TYPES["OnTdTO"], regularisation=1000.0)
    np.testing.assert_array_equal(by_name.matrix, by_type.matrix)
    with pytest.raises(FitError, match="no estimation type is called 'OnTd'; did you mean"):
        run.calibrate(kind="OnTd")
    with pytest.raises(FitError, match="regularisation: expected lambda in counts2, or 'held-out', got 'some'"):
        run.calibrate(regularisation="some")


@pytest.mark.long
def test_answers_and_calibrations_are_compared_by_their_numbers(experiment: Experiment, tmp_path: Path) -> None:
    """What was saved is what is read; another offset, another kind of thing and another name are not the same."""
    run = experiment["arm_ft"]
    calibration = run.calibrate()
    calibration.save(tmp_path / "arm.json")
    read = read_calibration(tmp_path / "arm.json")
    assert read == calibration
    assert calibration in [read]
    assert run.evaluate(read) == run.evaluate(calibration)
    offset = calibration.offset + np.array([0.0, 0.0, 0.0, 0.0, 0.0, 1e-9])
    assert read != calibration.model_copy(update={"offset": offset})
    assert read != calibration.model_copy(update={"raw_offset_counts": np.zeros(6)})
    assert read != calibration.sensor
    assert run.evaluate({"other": read}) != run.evaluate(calibration)


@pytest.mark.long
def test_an_experiment_goes_to_another_process(experiment: Experiment) -> None:
    """Experiment and run, pickled or copied, before and after a question, fit as they do themselves."""
    run = experiment["arm_ft"]
    untouched = pickle.loads(pickle.dumps(experiment))  # noqa: S301 - pickled here
    calibration = run.calibrate()
    for twin in (untouched["arm_ft"], copy.deepcopy(run)):
        np.testing.assert_array_equal(twin.calibrate().matrix, calibration.matrix)
    with pytest.raises(TypeError, match="does not support item assignment"):
        untouched.recording.streams["other"] = untouched.recording.streams["joints"]
