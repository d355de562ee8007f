# SPDX-License-Identifier: BSD-3-Clause
"""What commands say is had from Python in a line, from a file and from arrays."""

from __future__ import annotations

import json
from collections.abc import Callable
from inspect import signature
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from forcetorque.app import motion, simulate, study, workbench
from forcetorque.app.command_line import whole_program
from forcetorque.app.python.experiment import Experiment, calibrate_jointly, load_experiment
from forcetorque.app.python.experiment_of_arrays import experiment_of_arrays
from forcetorque.app.python.run import Run
from forcetorque.base.errors import ExperimentError, FitError, ForceTorqueError, OutputError
from forcetorque.calibration.calibrate import calibrate_for_file
from forcetorque.calibration.joint.calibrate import calibrate_jointly as calibrate_jointly_of_experiments
from forcetorque.evaluation.acceptance.acceptance import accept
from forcetorque.evaluation.acceptance.acceptance_file import read_acceptance
from forcetorque.evaluation.commands import compare, evaluate, validate
from forcetorque.experiment.calibration.calibration_file import read_calibration
from forcetorque.inspection.draft.draft import draft_experiment
from forcetorque.inspection.inspect import inspect_log
from forcetorque.locomotion.logged_signals import motion_signals
from forcetorque.planning.planning import plan
from forcetorque.report.report import report
from forcetorque.sensor.bandwidth.response import response
from forcetorque.sensor.commands import thermal
from forcetorque.skin.commands import calibrate_skin
from forcetorque.skin.taxels.calibrate import calibrate_skin as calibrate_skin_of_recordings
from forcetorque.workbench.calibrate import workbench as workbench_of_recordings
from tests.app.python.arrays import arrays_of
from tests.cases import some_cases
from tests.scenes.benches import write_bench
from tests.scenes.experiment_folders import arm, intact
from tests.scenes.experiments import PARQUET, snapshot

__all__ = ["arm", "intact"]

ROOT = Path(__file__).resolve().parents[3]
SPEC = """
schema = "forcetorque/acceptance/1"
name = "arm"
[evaluate]
force_error_mean_N = 5.0
"""


@pytest.fixture
def experiment(arm: Path) -> Experiment:
    """The experiment of the small arm, from its file."""
    return load_experiment(arm / PARQUET)


def _said(*words: Path | str, codes: tuple[int, ...] = (0, 1)) -> str:
    """What a command writes as JSON to standard output, with one of these exit codes."""
    answer = CliRunner().invoke(whole_program(), [*map(str, words), "--format", "json"])
    assert answer.exit_code in codes, answer.output
    return answer.stdout


@pytest.mark.parametrize(
    ("door", "function"),
    [
        (Run.calibrate, calibrate_for_file),
        (Run.validate, validate),
        (Run.thermal, thermal),
        (Run.response, response),
        (Run.accept, accept),
        (Run.plan, plan),
        (Run.report, report),
        (workbench, workbench_of_recordings),
        (calibrate_jointly, calibrate_jointly_of_experiments),
        (calibrate_skin, calibrate_skin_of_recordings),
        (motion, motion_signals),
    ],
    ids=lambda function: function.__qualname__,
)
def test_options_are_named_where_they_are_completed(door: Callable[..., Any], function: Callable[..., Any]) -> None:
    """All of the function behind, with its defaults; what a method knows by itself is not asked for."""
    behind, named = signature(function).parameters, signature(door).parameters
    own = {"code_version", "created", "name", "calibration", "viewer"}
    options = {one.name: one.default for one in behind.values() if one.kind is one.KEYWORD_ONLY and one.name not in own}
    assert options.keys() <= named.keys()
    stated = options.keys() - {"progress"}  # silence is a function, or None
    assert stated
    assert all(named[option].default == options[option] for option in stated)
    assert not any(one.kind is one.VAR_KEYWORD for one in named.values())


def test_an_experiment_is_inspected_without_its_file(experiment: Experiment, arm: Path) -> None:
    """As the file is; one that was made from arrays too."""
    assert experiment.inspect().json_text() == inspect_log(arm / PARQUET).json_text()
    saturated = experiment_of_arrays(**arrays_of(experiment, limit_counts=1000.0)).inspect()
    assert saturated.source == "arrays"
    assert "saturation" in {row.kind for row in saturated.findings}


def test_contacts_are_estimated_without_a_file(experiment: Experiment, arm: Path, tmp_path: Path) -> None:
    """As the command says it, with every sample; a file is written where one is named."""
    calibration = experiment["arm_ft"].calibrate()
    calibration.save(tmp_path / "calibration")
    summary = experiment.estimate(calibration, contacts=["hand"])
    file = tmp_path / "estimates.parquet"
    words = ("-c", tmp_path / "calibration", "--contacts", "hand", "-o", file)
    command = json.loads(_said("estimate", arm / PARQUET, *words))
    mine = json.loads(summary.json_text())
    assert mine["contacts"] == command["contacts"] != []
    assert sum(len(span.stamp_ns) for span in summary.intervals) == summary.samples == command["samples"]
    assert summary.file is None
    assert experiment.estimate(calibration, output=tmp_path / "mine.csv").file == str(tmp_path / "mine.csv")
    assert (tmp_path / "mine.csv").is_file()
    with pytest.raises(ExperimentError, match="contact 'knee': robot 'arm' has no link 'knee'"):
        experiment.estimate(contacts=["knee"])


@pytest.mark.long
def test_a_sensor_is_accepted_by_limits(experiment: Experiment, arm: Path, tmp_path: Path) -> None:
    """By a file or its content, as the command says it."""
    run, spec = experiment["arm_ft"], tmp_path / "limits.toml"
    spec.write_text(SPEC, encoding="utf-8")
    run.calibrate().save(tmp_path / "calibration")
    calibration = read_calibration(tmp_path / "calibration")
    acceptance = run.accept(spec, calibration)
    words = ("accept", arm / PARQUET, "--spec", spec, "-c", tmp_path / "calibration")
    command = json.loads(_said(*words, codes=(acceptance.exit_code,)))
    mine = json.loads(acceptance.json_text())
    assert mine["accepted"] == command["accepted"]
    assert mine["criteria"] == [row | {"calibration": "calibration"} for row in command["criteria"]] != []
    assert run.accept(read_acceptance(spec), calibration).criteria == acceptance.criteria


@pytest.mark.long
def test_head_room_and_spheres_are_asked_of_a_run(experiment: Experiment, arm: Path, tmp_path: Path) -> None:
    """As the commands say them."""
    run = experiment["arm_ft"]
    assert run.gains(margin=0.3).json_text() == _said("bench", "gains", arm / PARQUET, "--margin", "0.3").strip()
    calibration = run.calibrate()
    calibration.save(tmp_path / "calibration")
    spheres = run.sphere({str(tmp_path / "calibration"): calibration})
    command = json.loads(_said("study", "sphere", arm / PARQUET, "-c", tmp_path / "calibration"))
    rows = json.loads(spheres.json_text())["rows"]
    assert rows == command["rows"] != []


@pytest.mark.long
def test_ways_to_fit_are_studied_with_a_folder_or_without(arm: Path, tmp_path: Path) -> None:
    """Every candidate as the command has it, and its files; no file, and a type that there is not, are refused."""
    mine = study(arm / PARQUET, kinds=["OnTdTO"], lambdas=[1000.0, 0.0, 1000.0])
    words = ("--type", "OnTdTO", "--lambda", "0", "--lambda", "1000", "-o", tmp_path / "study")
    command = json.loads(_said("study", "fits", arm / PARQUET, *words))
    (sensor,), (twin,) = json.loads(mine.json_text())["sensors"], command["sensors"]
    assert sensor | {"folder": twin["folder"], "files": twin["files"]} == twin
    assert mine.folder is None
    said: list[str] = []
    written = study(
        arm / PARQUET, kinds=["OnTdTO"], lambdas=[0.0, 1000.0], folder=tmp_path / "mine", progress=said.append
    )
    assert said
    assert (written.folder, written.records()) == (str(tmp_path / "mine"), mine.records())
    (own,) = (tmp_path / "mine").iterdir()
    assert {file.name for file in own.iterdir()} == {file.name for file in Path(twin["folder"]).iterdir()}
    with pytest.raises(ForceTorqueError, match="mine"):
        study(arm / "none.toml", folder=tmp_path / "mine")
    with pytest.raises(FitError, match="no estimation type is called 'On'"):
        study(arm / PARQUET, kinds=["On"])
    with pytest.raises(ExperimentError, match="expected at least one experiment file to study, got none"):
        study()


@pytest.mark.long
def test_a_robot_is_simulated_and_its_sensor_fitted_over_recordings(tmp_path: Path) -> None:
    """A bundled scenario by name; runs of two experiments are fitted together, and a file is no run."""
    said: list[str] = []
    written = simulate("wrist", tmp_path / "simulated", progress=said.append)
    assert len(written.records()) == len(said) == 2
    with pytest.raises(ForceTorqueError, match="no scenario is called 'wrst'; did you mean \"wrist\""):
        simulate("wrst", tmp_path / "other")
    cold = load_experiment(tmp_path / "simulated" / "cold.toml")["arm_ft"]
    stated = (tmp_path / "simulated" / "warm.toml").read_text(encoding="utf-8")
    (tmp_path / "simulated" / "more.toml").write_text(stated.replace('"validation"', '"calibration"'), encoding="utf-8")
    warm = load_experiment(tmp_path / "simulated" / "more.toml")["arm_ft"]
    both = cold.calibrate(warm)
    assert both.provenance.samples == cold.calibrate().provenance.samples + warm.calibrate().provenance.samples
    with pytest.raises(ExperimentError, match=r"expected sensors of experiments.*got a str"):
        cold.calibrate("warm.toml")  # type: ignore[arg-type]
    with pytest.raises(ExperimentError, match=r"expected sensors of experiments.*got a Experiment"):
        evaluate(warm.experiment, {})  # type: ignore[arg-type]


@pytest.mark.long
def test_a_workbench_is_asked_by_its_file(tmp_path: Path) -> None:
    """Its content gives the same."""
    from forcetorque.workbench.bench_recording import read_bench

    file, _ = write_bench(tmp_path)
    answer = workbench(file)
    assert answer.faults == workbench(read_bench(file)).faults
    assert answer.calibrations[0].provenance.code_version


@pytest.mark.long
def test_a_log_and_trials_may_be_named_by_text(arm: Path) -> None:
    """One log needs no list; trials need no Path."""
    log = str(ROOT / "docs" / "tutorial" / "log.csv")
    assert draft_experiment(log).content == draft_experiment([Path(log)]).content
    spheres = compare([str(arm / PARQUET)])
    assert spheres.json_text() == compare([arm / PARQUET]).json_text()


def test_a_page_of_posture_and_forces_is_written_from_what_a_script_holds(
    experiment: Experiment, tmp_path: Path
) -> None:
    """With a calibration that no file holds; of arrays too, and of no sensor that there is not."""
    calibration = experiment["arm_ft"].calibrate()
    view = experiment.view(tmp_path / "view.html", {"mine": calibration})
    page = (tmp_path / "view.html").read_text(encoding="utf-8")
    assert view.file_bytes == (tmp_path / "view.html").stat().st_size
    assert "mine" in page
    assert view.sensors == ("arm_ft",)
    arrays = experiment_of_arrays(**arrays_of(experiment))
    assert arrays.view(tmp_path / "arrays.html").samples == view.samples
    with pytest.raises(ExperimentError, match="has no sensor 'leg'"):
        experiment.view(tmp_path / "leg.html", sensors=["leg"])
    with pytest.raises(ExperimentError, match="expected a Calibration"):
        experiment.view(tmp_path / "leg.html", "arm.json")  # type: ignore[arg-type]


@some_cases("force", [True, False])
@some_cases("name", ["recording/arm_ft.parquet", "arm.urdf", PARQUET, "matrix_SIM001.txt"])
def test_no_method_writes_over_what_it_has_read(arm: Path, name: str, force: bool) -> None:
    """Not even by force, and not through a link."""
    from forcetorque.calibration import export_calibrations

    experiment = load_experiment(arm / PARQUET)
    calibration = experiment["arm_ft"].calibrate()
    document = experiment["arm_ft"].report(calibration)
    for link in ("link.html", "link.csv"):
        (arm / link).symlink_to(name)
    before = snapshot(arm)
    writers: tuple[Callable[[], object], ...] = (
        lambda: calibration.save(arm / name, force=force),
        lambda: document.save(arm / "link.html", force=force),
        lambda: experiment.estimate(output=arm / "link.csv", force=force),
        lambda: experiment.view(arm / name, force=force),
        lambda: export_calibrations(calibration, "csv").save(arm / name, force=force),
    )
    for write in writers:
        with pytest.raises(OutputError, match="got an input of the result"):
            write()
    assert snapshot(arm) == before


def test_a_method_replaces_a_result_and_needs_force_for_anything_else(arm: Path) -> None:
    """A file of parameters that nobody here wrote stays as it is."""
    calibration = load_experiment(arm / PARQUET)["arm_ft"].calibrate()
    for _ in range(2):
        calibration.save(arm / "new.json")
    (arm / "mine.json").write_text('{"name": "mine"}')
    with pytest.raises(OutputError, match="expected a new file, or a result or figure to replace"):
        calibration.save(arm / "mine.json")
    calibration.save(arm / "mine.json", force=True)
    assert read_calibration(arm / "mine.json").sensor == calibration.sensor
