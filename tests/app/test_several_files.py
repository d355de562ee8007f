# SPDX-License-Identifier: BSD-3-Clause
"""Commands that take any number of experiment files: one answer, that of each beside it, and what is refused."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from forcetorque.experiment.calibration.calibration_file import Calibration, write_calibration
from tests.app.json_schema import faults
from tests.app.outcome import Run
from tests.cases import some_cases
from tests.scenes.campaigns import by_day
from tests.scenes.experiments import edit
from tests.scenes.studies import VALIDATION

LIMITS = 'schema = "forcetorque/acceptance/1"\nname = "leg"\n\n[evaluate]\nforce_error_mean_N = {limit}\n'
COMMANDS = {
    "accept": ("--spec", "limits.toml", "-c", "arm.json"),
    "evaluate": ("-c", "arm.json"),
    "study validate": ("-c", "arm.json"),
}
CODES = {"accept": 3}
"""Exit code where it is not 0: every limit holds, and the loads to come are more than the data show."""


@pytest.fixture(scope="module")
def calibrated(recorded: Path) -> Calibration:
    """A calibration that has an offset for each day."""
    return by_day(recorded)


@pytest.fixture
def judged(days: Path, calibrated: Calibration, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Folder of the days, with a calibration that has an offset for each; it is the working folder."""
    write_calibration(days / "arm.json", calibrated)
    (days / "limits.toml").write_text(LIMITS.format(limit=100.0), encoding="utf-8")
    monkeypatch.chdir(days)
    return days


@some_cases("command", COMMANDS)
def test_the_json_has_both_and_fits_the_schema(judged: Path, run: Run, command: str) -> None:
    """What all files show together, and each by itself; of one file there is no more than ever."""
    words = (*COMMANDS[command], "--format", "json")
    both = [run(*command.split(), *files, *words) for files in (VALIDATION, VALIDATION[:1])]
    assert [ended.code for ended in both] == [CODES.get(command, 0)] * 2
    several, one = (json.loads(ended.out) for ended in both)
    schema = run("schema", command.split()[-1]).result()
    assert faults(several, schema) == faults(one, schema) == []
    assert several["experiment"] == "arm day_1; arm day_2"
    assert [row["recording"] for row in several["recordings"]][:1] == ["arm day_1"]
    assert {row["recording"] for row in several["recordings"]} == {"arm day_1", "arm day_2"}
    extra = set(several) - set(one)
    assert "recordings" in extra
    assert all(name.startswith("recording") for name in extra)
    assert list(one) == [name for name in several if name in one]


@some_cases("command", COMMANDS)
def test_people_see_a_line_per_recording(judged: Path, run: Run, command: str) -> None:
    """Below what they show together; not where there is one file."""
    several, one = (
        run(*command.split(), *VALIDATION, *COMMANDS[command], "--details"),
        run(*command.split(), VALIDATION[0], *COMMANDS[command], "--details"),
    )
    assert (several.code, one.code) == (CODES.get(command, 0),) * 2
    assert "each recording by itself" in several.out
    assert "arm day_2" in several.out
    assert "each recording by itself" not in one.out
    assert "arm day_2" not in one.out


@some_cases("command", ["evaluate", "study validate"])
def test_lines_of_csv_say_of_which_recording_they_are(judged: Path, run: Run, command: str) -> None:
    """Pooled lines of none; one file has no such column."""
    words = (*COMMANDS[command], "--format", "csv")
    rows = run(*command.split(), *VALIDATION, *words).rows()
    names = [row["recording"] for row in rows]
    assert set(names) == {"", "arm day_1", "arm day_2"}
    assert names.count("") == names.count("arm day_1") == names.count("arm day_2")
    assert "recording" not in run(*command.split(), VALIDATION[0], *words).rows()[0]


def test_the_verdict_is_that_of_all_files_together(judged: Path, run: Run) -> None:
    """A limit that the mean over all samples keeps, and one day does not, is kept; a smaller one is not."""
    result = run("evaluate", *VALIDATION, "-c", "arm.json", "--format", "json").result()
    means = [
        [
            row["force_error_mean_N"]
            for row in result[name]
            if (row["calibration"], row["offset"]) == ("arm.json", "fitted")
        ]
        for name in ("verdicts", "recordings")
    ]
    (pooled,), days = means
    assert min(days) < pooled < max(days)
    for limit, code in ((0.5 * (pooled + max(days)), 3), (0.5 * (pooled + min(days)), 1)):
        Path("limits.toml").write_text(LIMITS.format(limit=limit), encoding="utf-8")
        assert run("accept", *VALIDATION, *COMMANDS["accept"]).code == code


@pytest.mark.parametrize("command", COMMANDS)
def test_files_of_another_sensor_are_refused(judged: Path, run: Run, command: str) -> None:
    """Another serial number under the same name; the error names the file, the numbers, and what to do."""
    edit(judged / VALIDATION[1], 'serial = "SIM001"', 'serial = "SIM002"')
    error = run(*command.split(), *VALIDATION, *COMMANDS[command]).error()
    assert error.startswith(f"error: {VALIDATION[1]}: sensor 'arm_ft': expected the serial number of {VALIDATION[0]}, ")
    assert error.endswith(
        "SIM001, got SIM002; files are pooled for one sensor, mounted and read in one way: leave one of the two out"
    )


@pytest.mark.parametrize("command", [*COMMANDS, "estimate"])
def test_a_file_that_comes_twice_is_refused(judged: Path, run: Run, command: str) -> None:
    """Its samples would count twice."""
    words = COMMANDS.get(command, ("-o", "estimates.csv"))
    error = run(*command.split(), VALIDATION[0], f"./{VALIDATION[0]}", *words).error()
    assert error.endswith("expected every experiment file once, it comes twice; its samples would too")
    assert not Path("estimates.csv").exists()


def test_a_file_without_the_sensor_is_named(judged: Path, run: Run) -> None:
    """The sensors are those of the first file."""
    edit(judged / VALIDATION[1], 'name = "arm_ft"\nstream', 'name = "tool_ft"\nstream')
    for pair in (VALIDATION, VALIDATION[::-1]):
        error = run("evaluate", *pair, "-c", "arm.json").error()
        assert VALIDATION[1] in error


@pytest.mark.long
def test_estimates_are_written_per_file(judged: Path, run: Run) -> None:
    """One file of samples each, with the name of its experiment, as each gives by itself."""
    result = run("estimate", *VALIDATION, "-o", "estimates.csv", "-c", "arm.json", "--format", "json").result()
    schema = run("schema", "estimate").result()
    assert faults(result, schema) == []
    files = ["estimates.day_1.csv", "estimates.day_2.csv"]
    assert [row["file"] for row in result["recordings"]] == files
    assert result["samples"] == sum(row["samples"] for row in result["recordings"])
    for file, name in zip(VALIDATION, files, strict=True):
        alone = run("estimate", file, "-o", "alone.csv", "-c", "arm.json", "--format", "json").result()
        assert Path("alone.csv").read_bytes() == Path(name).read_bytes()
        (apart,) = [row for row in result["recordings"] if row["file"] == name]
        assert apart == {key: alone[key] if key != "file" else name for key in apart}
        assert "recordings" not in alone
    rows = run("estimate", *VALIDATION, "-o", "estimates.csv", "-c", "arm.json", "--format", "csv").rows()
    assert {row["experiment"] for row in rows} == {"arm day_1", "arm day_2"}


@pytest.mark.long
@pytest.mark.usefixtures("blank_pictures")
def test_a_report_reads_every_file_with_its_session(judged: Path, run: Run) -> None:
    """Errors with the calibration's own offset are those of `evaluate` on each recording."""
    assert run("report", *VALIDATION, "arm.json", "-o", "report.html").code == 0
    report = json.loads(Path("report.numbers.json").read_text(encoding="utf-8"))
    apart = run("evaluate", *VALIDATION, "-c", "arm.json", "--format", "json").result()["recordings"]
    for experiment in report["experiments"]:
        (sensor,) = experiment["sensors"]
        own = [row for row in apart if row["recording"] == experiment["experiment"]]
        for row, same in zip(sensor["evaluation"], own, strict=True):
            assert np.allclose(row["rmse"], same["rmse"], rtol=0.0, atol=1e-12)
