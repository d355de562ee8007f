# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque run`: the right stage stops it, the right answer comes out, and exit codes tell which."""

from __future__ import annotations

import json
import shlex
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import forcetorque
from forcetorque.base.errors import ExperimentError
from forcetorque.experiment.calibration.calibration_file import read_calibration
from forcetorque.inspection.draft.draft import Draft, ProposalRow
from forcetorque.inspection.draft.questions import answer_questions, open_questions
from forcetorque.recording.storage import read_recording, write_recording
from forcetorque.workbench.simulated_benches import BenchFaults
from tests.app.json_schema import faults
from tests.app.outcome import Run
from tests.scenes.benches import write_bench
from tests.scenes.experiments import PARQUET, edit, snapshot, write_experiments

FITTED = "results/arm_ft_SIM001.json"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The experiment of the small arm in the working folder."""
    write_experiments(tmp_path)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def shifted(folder: Path, start_s: float, counts: float) -> None:
    """Add counts to all channels of the arm's sensor from an instant on."""
    recording = read_recording(folder / "recording")
    stream = recording.stream("arm_ft")
    signal = stream.signal("raw")
    values = signal.values.copy()
    values[(stream.stamp_ns - recording.start_ns) * 1e-9 >= start_s] += counts
    moved = replace(stream, signals={**stream.signals, "raw": replace(signal, values=values)})
    write_recording(folder / "recording", replace(recording, streams={**recording.streams, "arm_ft": moved}))


@pytest.mark.long
@pytest.mark.usefixtures("folder")
def test_a_good_log_goes_the_whole_way(run: Run) -> None:
    """Every stage is done in its order; the files are there, and the verdict is that of `evaluate`."""
    outcome = run("run", PARQUET, "-o", "results", "--format", "json")
    result = json.loads(outcome.out)
    assert faults(result, run("schema", "run").result()) == []
    assert [stage["name"] for stage in result["stages"]] == [
        "inspect",
        "check",
        "calibrate",
        "evaluate",
        "report",
        "export",
    ]
    assert {stage["outcome"] for stage in result["stages"]} == {"done"}
    assert all(Path(file).is_file() for file in result["files"])
    uses = run("evaluate", PARQUET, "-c", FITTED, "--format", "json").result()["load_cases"]
    assert [use["decision"] for use in result["load_cases"]] == [use["decision"] for use in uses]
    assert outcome.code == (0 if all(use["decision"] == "use" for use in uses) else 1)


@pytest.mark.usefixtures("folder")
def test_people_read_the_verdict_first(run: Run) -> None:
    """The first line has the sensor and the verdict of `evaluate`, a later one the files; tables wait for --details."""
    short = run("run", PARQUET, "-o", "results", "--no-report").out.splitlines()
    first = run("evaluate", PARQUET, "-c", FITTED).out.splitlines()[0]
    assert short[0].split("  ")[-1] == first.split("  ")[-1]
    assert any("calibrations.csv" in line for line in short)
    assert len(short) <= 12
    assert "calibrations.csv" in run("run", PARQUET, "-o", "results", "--no-report").error()  # is there already
    assert "stage" in run("run", PARQUET, "-o", "results", "--no-report", "--force", "--details").out


@pytest.mark.long
def test_a_contact_in_the_fitted_interval_stops_it(folder: Path, run: Run) -> None:
    """Nothing is written and exit code 3 tells; a reason goes on, and stands in calibration and report."""
    shifted(folder, 6.0, 0.0)
    recording = read_recording(folder / "recording")
    stream = recording.stream("arm_ft")
    signal, seconds = stream.signal("raw"), (stream.stamp_ns - recording.start_ns) * 1e-9
    touched = signal.values.copy()
    touched[(seconds > 6.0) & (seconds < 9.0)] *= 0.3  # most of the weight rests on something
    moved = replace(stream, signals={**stream.signals, "raw": replace(signal, values=touched)})
    write_recording(folder / "recording", replace(recording, streams={**recording.streams, "arm_ft": moved}))
    before = snapshot(folder)
    stopped = run("run", PARQUET, "-o", "results")
    assert stopped.code == 3
    assert "STOPPED AT INSPECT" in stopped.out.splitlines()[0]
    assert f"\n  forcetorque init --resume {PARQUET}\n" in stopped.out
    assert snapshot(folder) == before
    went_on = run("run", PARQUET, "-o", "results", "--override", "the table is part of the test", "--format", "json")
    result = json.loads(went_on.out)
    assert [stage["outcome"] for stage in result["stages"] if stage["name"] == "inspect"] == ["overridden"]
    assert result["override"] == "the table is part of the test"
    assert any("the table is part of the test" in doubt for doubt in read_calibration(Path(FITTED)).warnings)
    assert "the table is part of the test" in Path("results/report.html").read_text(encoding="utf-8")


def test_a_calibration_that_must_not_be_used_is_withheld(folder: Path, run: Run) -> None:
    """Data that were not fitted are off by a constant: no calibration is written."""
    shifted(folder, 14.2, 400.0)
    stopped = run("run", PARQUET, "-o", "results")
    assert stopped.code == 3
    assert "STOPPED AT EVALUATE" in stopped.out.splitlines()[0]
    assert "forcetorque inspect" not in stopped.out  # which would show nothing of the remedy
    assert not Path("results").exists()


def test_a_sensor_read_in_the_wrong_sense_stops_it(folder: Path, run: Run) -> None:
    """Calibrate refuses it, and so does the whole way, even with a reason to go on."""
    edit(folder / PARQUET, "gravity_direction = [0.0, 0.0, -1.0]", "gravity_direction = [0.0, 0.0, 1.0]")
    stopped = run("run", PARQUET, "-o", "results")
    assert stopped.code == 3
    assert "STOPPED AT CHECK" in stopped.out.splitlines()[0]
    assert f"\n  forcetorque init --resume {PARQUET}\n" in stopped.out  # which tries the change of the line
    assert not Path("results").exists()


def test_a_log_of_skin_ends_with_commands_that_take_it(
    tmp_path: Path, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    """`run` begins its file, and names `init --resume`, because a file without a sensor is none of `run`."""
    monkeypatch.chdir(tmp_path)
    head = ",".join(["time_s", *(f"taxel_{k}" for k in range(12)), "pressure_kPa"])
    rows = "\n".join(",".join(map(str, [k / 10, *[240 - k] * 13])) for k in range(30))
    Path("skin.csv").write_text(f"{head}\n{rows}\n", encoding="utf-8")
    stopped = run("run", "skin.csv", "-o", "results", "--no-input", "--format", "json")
    assert stopped.code == 4
    command = json.loads(stopped.out)["stages"][0]["command"]
    assert command == "init --resume results/experiment.toml"
    assert "TO FILL IN" in run(*command.split()).out


def test_a_log_without_a_file_asks_its_questions(tmp_path: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """They are listed with exit code 4; answered one by one they end in the same way as a file that was written."""
    monkeypatch.chdir(tmp_path)
    rows = "\n".join(f"{0.01 * k:.2f},{k % 7},{k % 5},{k % 3},{k % 2},1,2" for k in range(200))
    Path("log.csv").write_text(f"time,fx,fy,fz,tx,ty,tz\n{rows}\n", encoding="utf-8")
    stopped = run("run", "log.csv", "-o", "results", "--no-input", "--format", "json")
    questions = json.loads(stopped.out)["questions"]
    assert stopped.code == 4
    assert json.loads(stopped.out)["stages"][0]["command"] == "run results/experiment.toml -o results"
    file = Path("results/experiment.toml")
    assert len(questions) == len(open_questions(file)) > 1
    asked: list[str] = []
    answers = {
        "units": "N, N, N, N m, N m, N m",
        "axes": "ft_sensor",
        "serial": "SN1",
        "full_scale": "300, 300, 300, 30, 30, 30",
        "motion": "none",
        "measure_direction": "child_to_parent",
    }

    def answer(question: str) -> str:
        asked.append(question)
        return "" if len(asked) == 1 else answers[question.splitlines()[-1].partition(", ")[2].partition(":")[0]]

    assert not answer_questions(file, answer)
    assert len(asked) == len(questions)
    assert len(open_questions(file)) == 1
    Path("other.csv").write_text("time,fx,fy,fz,tx,ty,tz\n", encoding="utf-8")
    before = snapshot(tmp_path)
    assert "was begun of another log than other.csv" in run("run", "other.csv", "-o", "results", "--no-input").error()
    assert "got both" in run("run", "log.csv", file, "-o", "results", "--no-input").error()
    assert "got --column-names" in run("run", file, "--column-names", "t,fx,fy,fz,tx,ty,tz", "--no-input").error()
    later = run("run", "log.csv", "-o", "results", "--no-input", "--loads", "thesis-6.1")
    assert "--loads would change nothing" in later.error()
    assert snapshot(tmp_path) == before
    assert run("run", "log.csv", "-o", "results", "--no-input").code == 4
    assert answer_questions(file, lambda _: "s")
    assert open_questions(file) == ()
    assert 'unit = "s"' in file.read_text(encoding="utf-8")


def test_a_log_that_was_left_out_is_no_other_log(tmp_path: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """The same command goes on with the file; with fewer logs than the file names, or one more, it does not."""
    monkeypatch.chdir(tmp_path)
    for name, offset in (("ft.csv", 0), ("foot.csv", 1), ("external_wrench.csv", 2), ("other.csv", 3)):
        rows = "\n".join(f"{0.01 * k:.2f},{k % 7},{k % 5},{k % 3},{k % 2},1,{offset}" for k in range(200))
        Path(name).write_text(f"time_s,fx,fy,fz,tx,ty,tz\n{rows}\n", encoding="utf-8")
    two = ("ft.csv", "foot.csv")
    for logs, code in (((*two, "external_wrench.csv"), 4), ((*two, "external_wrench.csv"), 4), (two, 4)):
        assert run("run", *logs, "-o", "results", "--no-input").code == code
    text = Path("results/experiment.toml").read_text(encoding="utf-8")
    assert [one for one in text.split("\n") if "external_wrench" in one] == ['# log left out: "../external_wrench.csv"']
    for others in (("ft.csv",), ("other.csv",), ("external_wrench.csv",), ("ft.csv", "other.csv"), (*two, "other.csv")):
        assert "begun of another log" in run("run", *others, "-o", "results", "--no-input").error()


def test_a_log_without_headings_is_read_by_the_names_of_its_columns(
    tmp_path: Path, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As `init` reads it: the sensor is found, and the questions are those of a log with headings."""
    monkeypatch.chdir(tmp_path)
    rows = "\n".join(f"{0.01 * n:.2f},0.1,0.2,9.{n % 10},0.01,0.02,0.03" for n in range(200))
    Path("bare.csv").write_text(f"{rows}\n", encoding="utf-8")
    Path("log.csv").write_text(f"time,fx,fy,fz,tx,ty,tz\n{rows}\n", encoding="utf-8")
    names = "time, fx,fy,fz,tx,ty,tz"
    bare = run("run", "bare.csv", "-o", "bare", "--column-names", names, "--no-input", "--format", "json")
    log = run("run", "log.csv", "-o", "log", "--no-input", "--format", "json")
    assert bare.code == log.code == 4
    questions = [[own.split(", ")[1].split(":")[0] for own in json.loads(one.out)["questions"]] for one in (bare, log)]
    assert questions[0] == questions[1]


def test_what_cannot_be_checked_is_not_called_checked(folder: Path, run: Run) -> None:
    """Without the position of a joint nothing is compared with the model: the stage gives the reason."""
    recording = read_recording(folder / "recording")
    stream = recording.stream("joints")
    lacking = {
        quantity: replace(signal, columns=signal.columns[:-1], values=signal.values[:, :-1], units=signal.units[:-1])
        for quantity, signal in stream.signals.items()
    }
    shorter = replace(stream, signals=lacking)
    write_recording(folder / "recording", replace(recording, streams={**recording.streams, "joints": shorter}))
    outcome = run("run", PARQUET, "-o", "results", "--no-report", "--format", "json")
    assert outcome.code == 3
    check, calibrate = json.loads(outcome.out)["stages"][-2:]
    assert "; not checked: arm_ft: no comparison with the model" in check["text"]
    assert calibrate["text"].split(": ")[-1] in check["text"]


def test_a_log_without_a_sensor_is_refused(tmp_path: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """By the log, with what was expected; the file that was begun has nothing to ask."""
    monkeypatch.chdir(tmp_path)
    rows = "".join(f"{0.1 * k:.1f},{20 + k}\n" for k in range(99))
    Path("log.csv").write_text(f"timestamp_s,temperature_degC\n{rows}", encoding="utf-8")
    message = "log.csv: expected a wrench or raw samples of a force-torque sensor, got none"
    assert message in run("run", "log.csv", "-o", "results", "--no-input").error()


def test_a_file_with_open_questions_lists_them(folder: Path, run: Run) -> None:
    """As a file that was begun from a log; without a terminal nothing is asked."""
    edit(folder / PARQUET, 'serial = "SIM001"', 'serial = "?"  # on its label')
    outcome = run("run", PARQUET, "-o", "results", "--no-input")
    assert outcome.code == 4
    assert "1 question(s) are open" in " ".join(outcome.out.split())


def test_the_next_command_has_all_recordings_and_sensors(
    folder: Path, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With a question or a proposal of one of them open, the command that goes on is the one that was typed."""
    edit(folder / PARQUET, 'serial = "SIM001"', 'serial = "?"  # on its label')
    typed = ("run", "other one.toml", PARQUET, "-o", "results", "--sensor", "arm_ft")
    Path("other one.toml").write_bytes((folder / PARQUET).read_bytes().replace(b'"?"', b'"SIM001"'))
    outcome = run(*typed, "--no-input", "--format", "json")
    assert outcome.code == 4
    assert shlex.split(json.loads(outcome.out)["stages"][0]["command"]) == list(typed)
    row = ProposalRow(line=None, kind="sign", proposal="turn it", residual_before_N=None, residual_after_N=None)
    draft = Draft(file=PARQUET, format="toml", streams={}, questions=(), proposals=(row,), notes=(), content="")
    monkeypatch.setattr("forcetorque.inspection.draft.questions.resume_experiment", lambda *_, **__: draft)
    (stage,) = json.loads(run(*typed, "--no-input", "--format", "json").out)["stages"]
    assert stage["remedy"].endswith(f"forcetorque {shlex.join(typed)} declines them all")


@pytest.mark.parametrize("command", [("run",), ("init", "--no-input", "--resume")], ids=["run", "init"])
def test_a_file_that_is_no_toml_is_one_line(folder: Path, run: Run, command: tuple[str, ...]) -> None:
    """Another encoding, half a file, and none."""
    (folder / "other.toml").write_bytes('schema = "forcetorque/experiment/1"'.encode("utf-16"))
    (folder / "half.toml").write_text("[robot", encoding="utf-8")
    for file, words in (
        ("other.toml", "expected TOML"),
        ("half.toml", "expected TOML"),
        ("none.toml", "there is none"),
    ):
        assert words in run(*command, file).error()


@pytest.mark.long
def test_known_loads_of_a_workbench(tmp_path: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """A sound bench gives a calibration; swapped weights stop it."""
    monkeypatch.chdir(tmp_path)
    file, _ = write_bench(tmp_path)
    good = run("run", file, "-o", "results", "--format", "json")
    assert [stage["outcome"] for stage in json.loads(good.out)["stages"]] == ["done"]
    assert read_calibration(Path(json.loads(good.out)["files"][0])).sensor.serial == "SIM001"
    bad = tmp_path / "bad"
    bad.mkdir()
    swapped, _ = write_bench(bad, faults=BenchFaults(swapped=(3, 12)))
    stopped = run("run", swapped, "-o", "other")
    assert stopped.code == 3
    assert not Path("other").exists()
    swapped, _ = write_bench(bad, faults=BenchFaults(swapped=(3, 8)))
    went_on = run("run", swapped, "-o", "other", "--override", "the swap is known", "--format", "json")
    warnings = read_calibration(Path(json.loads(went_on.out)["files"][0])).warnings
    assert any("the swap is known" in warning for warning in warnings)
    assert not any(
        "override" in warning for warning in read_calibration(Path(json.loads(good.out)["files"][0])).warnings
    )
    again, _ = write_bench(tmp_path, serial="SIM002")
    both = run("run", swapped, again, "-o", "two", "--override", "the swap is known", "--format", "json")
    files = [Path(one) for one in json.loads(both.out)["files"]]
    assert files == [Path("two/l_leg_ft_SIM001.json"), Path("two/l_leg_ft_SIM002.json")]
    assert all(any("the swap is known" in words for words in read_calibration(one).warnings) for one in files)


def test_a_bench_without_a_matrix_is_stopped_for_good(
    tmp_path: Path, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    """No reason to go on makes a matrix."""
    monkeypatch.chdir(tmp_path)
    names = [f"{kind}{axis}" for kind in ("f", "t", "known_f", "known_t") for axis in "xyz"]
    loads = np.eye(6)[:3]
    rows = np.hstack([1e3 * loads, loads])
    np.savetxt("three.csv", rows, delimiter=",", header=",".join(names), comments="")
    Path("three.toml").write_text(
        f"""schema = "forcetorque/bench/1"
[sensor]
name = "plate"
serial = "P1"
measure_direction = "child_to_parent"
full_scale = 1e6
[measurements]
format = "rows"
file = "three.csv"
channels = {names[:6]}
known = {names[6:]}
known_units = ["N", "N", "N", "N m", "N m", "N m"]
""",
        encoding="utf-8",
    )
    stopped = run("run", "three.toml", "-o", "none", "--override", "x")
    assert stopped.code == 3
    assert "give prior" in stopped.out
    assert "--override" not in stopped.out
    assert not Path("none").exists()


@pytest.mark.long
def test_recordings_of_one_use_each_go_together(folder: Path, run: Run) -> None:
    """One file is fitted and the other evaluates, in either order; without one to fit it is said."""
    text = (folder / PARQUET).read_text(encoding="utf-8")
    head, fit, judge = text.split("[[interval]]")
    Path("fit.toml").write_text(f"{head}[[interval]]{fit}", encoding="utf-8")
    Path("judge.toml").write_text(f"{head}[[interval]]{judge}".replace("small arm", "again"), encoding="utf-8")
    result = json.loads(run("run", "judge.toml", "fit.toml", "-o", "results", "--no-report", "--format", "json").out)
    assert [stage["outcome"] for stage in result["stages"]] == ["done"] * 5
    lonely = run("run", "judge.toml", "-o", "other", "--no-report")
    assert 'use = "calibration"' in lonely.err + lonely.out
    assert lonely.code in (2, 3)


def test_inputs_and_other_files_are_never_written_over(folder: Path, run: Run) -> None:
    """The prior has the name of an exported matrix: it is refused at once, with --force too; so is a file as folder."""
    before = snapshot(folder)
    for more in ((), ("--force",)):
        refused = run("run", PARQUET, "-o", ".", "--no-report", *more).error()
        assert "matrix_SIM001.txt" in refused
        assert "got an input of the result" in refused
    assert "got a file" in run("run", PARQUET, "-o", PARQUET, "--no-report").error()
    assert snapshot(folder) == before


def test_the_demonstration_writes_over_nothing_of_others(folder: Path, run: Run) -> None:
    """A folder with an experiment of its own is left as it is."""
    (folder / "experiment.toml").write_text("mine", encoding="utf-8")
    before = snapshot(folder)
    assert "or that of an earlier demonstration" in run("demo", "-o", ".").error()
    assert snapshot(folder) == before


def test_without_data_to_evaluate_the_calibration_is_written_and_to_be_evaluated(folder: Path, run: Run) -> None:
    """No verdict; `evaluate` would be refused, so an interval comes first, and the details need --force."""
    edit(folder / PARQUET, 'use = "validation"', 'use = "ignore"')
    outcome = run("run", PARQUET, "-o", "results", "--no-report")
    assert outcome.out.splitlines()[0].split()[-1] == "FITTED"
    assert 'next: add an [[interval]] with use = "validation"' in outcome.out
    assert outcome.out.endswith("\ndetails: --force --details\n")
    assert "forcetorque evaluate" not in outcome.out
    assert Path(FITTED).is_file()
    assert run("evaluate", PARQUET, "-c", FITTED).code == 2
    again = run("run", PARQUET, "-o", "results", "--no-report", "--details")
    assert "an earlier run wrote it" in again.error()
    assert "reading" not in again.err


def test_nothing_to_fit_is_said_before_anything_is_computed(folder: Path, run: Run) -> None:
    """The file has no calibration interval."""
    edit(folder / PARQUET, 'use = "calibration"', 'use = "ignore"')
    outcome = run("run", PARQUET, "-o", "results")
    assert outcome.code == 2
    assert 'expected an [[interval]] with use = "calibration"' in outcome.err
    assert f"forcetorque inspect {PARQUET} shows when something touches it" in outcome.err
    assert "INFO: inspect" not in outcome.log


@pytest.mark.long
def test_the_robot_s_file_is_written_only_of_a_sensor_that_may_be_used(folder: Path, run: Run) -> None:
    """By its load case: no file to load by mistake where the error may be larger than is allowed."""
    text = (folder / PARQUET).read_text(encoding="utf-8")
    case = '\n[[load_case]]\nname = "push"\nforce_N = 30.0\nradius_m = 0.1\nforce_error_N = 20.0\n'
    for output, stated, code in (("default", "", 1), ("rough", case, 0)):
        (folder / PARQUET).write_text(text + stated, encoding="utf-8")
        outcome = run("run", PARQUET, "-o", output, "--no-report", "--format", "json")
        written = (folder / output / "matrix_SIM001.txt").is_file()
        assert (outcome.code, written) == (code, code == 0)
        exported = json.loads(outcome.out)["stages"][-1]["text"]
        assert ("for the sensor may not be used yet: matrix_SIM001.txt; forcetorque export" in exported) is not written
        assert (folder / output / "calibrations.csv").is_file()


@pytest.mark.long
@pytest.mark.real_data
def test_sensors_of_a_standing_leg_are_fitted_all_at_once(tmp_path: Path) -> None:
    """One of them cannot be fitted alone, and has no verdict, with the reason; nobody takes the result for usable."""
    file = Path(__file__).parents[3] / "examples" / "15_icub_yoga_jointly.toml"
    result = forcetorque.run(file, tmp_path / "out", with_report=False)
    assert result.exit_code == 1
    assert "4 of 4 sensors, all at once" in result.stages[2].text
    assert {Path(name).name for name in result.files} >= {"l_leg_ft_sensor_SN217.json", "r_leg_ft_sensor_SN026.json"}
    assert {use.sensor for use in result.load_cases} == {"r_leg_ft_sensor", "r_foot_ft_sensor"}
    assert result.stages[3].text.count("no verdict") == 2
    answers = list(result.answers())
    without = [one for one in answers if one.verdict == "NO VERDICT"]
    assert len(without) == 2
    assert all("torso_pitch" in one.why[0] for one in without)
    assert len(answers) == 4
    assert all("4 sensors are fitted at once, as by `calibrate --jointly`" in one.why for one in answers)


@pytest.mark.long
@pytest.mark.usefixtures("folder")
def test_from_python() -> None:
    """One line, with the same result; an empty reason is refused."""
    result = forcetorque.run(PARQUET, "results", with_report=False)
    assert result.stopped is None
    assert Path(FITTED).is_file()
    again = forcetorque.load_experiment(PARQUET).run("again", with_report=False)
    assert [stage.name for stage in again.stages] == [stage.name for stage in result.stages]
    assert [use.message for use in again.load_cases] == [use.message for use in result.load_cases]
    with pytest.raises(ExperimentError, match="expected the reason to go on"):
        forcetorque.run(PARQUET, "results", override=" ")
