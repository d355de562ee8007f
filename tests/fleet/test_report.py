# SPDX-License-Identifier: BSD-3-Clause
"""The report on a fleet: damaged sensors come first, those that were not evaluated have no rank, failures are there."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError, ForceTorqueError, MissingFileError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.evaluation.load_cases.verdict import LOOK_FOR_CAUSE, Reason
from forcetorque.experiment.calibration.calibration_file import read_calibration
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.fleet.added_and_failed_recordings import add_recordings
from forcetorque.fleet.commands import fleet_report
from forcetorque.fleet.evaluate import evaluate_dataset
from forcetorque.fleet.parquet_dataset import Dataset
from forcetorque.fleet.report import FleetReport, _next
from forcetorque.fleet.report_page import page
from forcetorque.fleet.run import run_calibrate, run_plan
from forcetorque.fleet.sensor_evaluation import SensorEvaluation
from forcetorque.fleet.sensor_record import AddOptions
from forcetorque.results.answer import MOST_LINES, answer_text
from forcetorque.results.document.content import Section, Verdict
from tests.app.outcome import Run
from tests.fleet.pools import InProcess
from tests.scenes.fleets import fleet_of, write_logs

DAMAGED: Mapping[int, str] = {1: "gain", 3: "reversed", 4: "drifting", 6: "dead", 7: "noisy"}
SAME = 1e-12
"""Rounding of sums in another order, over sizes."""


@pytest.fixture(scope="module")
def base(recorded: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder with the dataset `fleet` of one recording to calibrate and one to validate; nobody changes it."""
    folder = tmp_path_factory.mktemp("base")
    files = [recorded / name for name in ("grid_cold.toml", "move_warm.toml", "day_2.toml")]
    add_recordings(files, folder / "fleet", AddOptions())
    return folder


def _fleet(base: Path, robots: int, folder: Path, damaged: Mapping[int, str] = DAMAGED) -> list[str]:
    """Write a fleet whose sensors have one calibration."""
    dataset = Dataset(base / "fleet")
    records = dataset.records(dataset.files)
    calibration = calibrate_sensor(
        None, code_version="1", created="2020-01-01T00:00:00+00:00", moments=dataset.moments(records)[0]
    )
    (validated,) = (record for record in records if record.evaluation is not None)
    return fleet_of(robots, damaged, validated, calibration, folder)


def _report(folder: Path) -> FleetReport:
    return fleet_report(folder / "fleet", calibrations=[folder / "calibrations"])


def _assert_damaged_first(report: FleetReport, serials: list[str], damaged: Mapping[int, str]) -> None:
    """Damaged sensors are the first, beyond what is allowed and not to be used; the others are within it."""
    first, others = report.ranked[: len(damaged)], report.ranked[len(damaged) :]
    assert {row.serial for row in first} == {serials[k] for k in damaged}
    assert len(others) == len(serials) - len(damaged)
    assert all(row.times_allowed is not None and row.times_allowed > 1.0 for row in first)
    assert all(row.decision != "use" and row.step and row.command for row in first)
    assert all(row.times_allowed is not None and row.times_allowed < 1.0 for row in others)
    assert [row.rank for row in report.ranked] == list(range(1, len(serials) + 1))


def _texts(section: Section) -> str:
    return " ".join(str(block) for block in section.blocks)


def test_damaged_sensors_come_first(base: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Although the first day of each was without damage; a sensor without calibration or validation has no rank."""
    serials = _fleet(base, 8, tmp_path)
    (tmp_path / "calibrations" / f"{serials[0]}.json").unlink()
    failures = tmp_path / "fleet" / "failures"
    failures.mkdir()
    failure = {"schema": "forcetorque/failure/1", "file": "/logs/x.toml", "error": "/logs/x.toml: expected a log"}
    (failures / "x.json").write_text(json.dumps(failure), encoding="utf-8")
    monkeypatch.chdir(tmp_path)  # lines of the answer are counted, which have the folder in them
    report = _report(Path())
    _assert_damaged_first(report, serials[1:], {k - 1: name for k, name in DAMAGED.items()})
    (unranked,) = report.unranked
    assert (unranked.serial, unranked.reason) == (serials[0], "no calibration of it was given")
    assert [row.file for row in report.over_time if row.serial == serials[1]] == [
        f"/logs/{serials[1]}/day_{day}.toml" for day in range(2)
    ]
    healthy, damaged = (one for one in report.over_time if one.serial == serials[3])
    assert damaged.force_error_rms_N > 10.0 * healthy.force_error_rms_N
    assert answer_text(tuple(report.answers()), 80).count("\n") <= MOST_LINES
    document = page(report, created="2026-01-01T00:00:00+00:00")
    titles = [section.title for section in document.sections]
    assert titles[0] == "Worst sensors first"
    assert [block.word for block in document.sections[0].blocks if isinstance(block, Verdict)][0] == "do not use"
    assert "7 of 8" in _texts(document.sections[0])
    assert serials[0] in _texts(document.sections[titles.index("Sensors without a rank")])
    assert "expected a log" in _texts(document.sections[titles.index("Recordings that failed")])


def test_every_verdict_has_the_last_recording(base: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Report, plan and evaluation say the same of a sensor that was damaged after a healthy day."""
    serials = _fleet(base, 2, tmp_path, {1: "gain"})
    dataset, files = Dataset(tmp_path / "fleet"), {s: tmp_path / "calibrations" / f"{s}.json" for s in serials}
    reported = {row.serial: (row.decision, row.reason) for row in _report(tmp_path).ranked}
    for serial, file in files.items():
        (evaluated,) = evaluate_dataset(dataset, {str(file): read_calibration(file)}).load_cases
        assert reported[serial] == (evaluated.decision, evaluated.reasons[0].text)
        assert evaluated.message.endswith(evaluated.reasons[0].text)
    assert "in the last recording" in reported[serials[1]][1]
    assert reported[serials[1]][0] != "use"
    assert "in the last recording" not in reported[serials[0]][1]
    made = SimpleNamespace(save=lambda: None, calibrations=[SimpleNamespace(calibration=read_calibration(file))])
    monkeypatch.setattr("forcetorque.fleet.run.calibrate_for_file", lambda *_, **__: made)
    monkeypatch.setattr("forcetorque.fleet.run.Dataset.moments", lambda *_: ([], ()))
    calibrated = run_calibrate(serials[1], dataset.folder, tmp_path, code_version="1", created="2020")
    assert calibrated.decision == reported[serials[1]][0]


def test_any_recording_without_a_date_may_be_the_last(base: Path, tmp_path: Path) -> None:
    """The damaged one counts wherever it stands; negative control: by dates it is the first, and does not."""
    serials = _fleet(base, 1, tmp_path, {0: "gain"})
    dataset, file = Dataset(tmp_path / "fleet"), tmp_path / "calibrations" / f"{serials[0]}.json"
    healthy, damaged = dataset.records(dataset.of_sensor(serials[0]))
    calibrations = {str(file): read_calibration(file)}

    def reasons(start_ns: int) -> list[str]:
        records = [damaged.model_copy(update={"start_ns": start_ns}), healthy.model_copy(update={"start_ns": start_ns})]
        evaluation = SensorEvaluation(dataset.folder, serials[0], records, calibrations)
        return [one.text for verdict in evaluation.verdicts() for one in verdict.reasons]

    assert any("day_1.toml, which has no date and may be the last recording, its" in text for text in reasons(0))
    assert not any("last recording" in text for text in reasons(healthy.start_ns))


@pytest.mark.usefixtures("blank_pictures")
def test_a_report_without_a_page_is_printed(base: Path, run: Run) -> None:
    """No file is asked for, and none is written; a figure that cannot be drawn is a warning with the reason."""
    answer = run("fleet", "report", str(base / "fleet"), "--format", "json").result()
    assert answer["file"] is None
    assert answer["unranked"]
    outcome = run("fleet", "report", base / "fleet", "--format", "json", "--figure", base / "report.png")
    account = json.loads(outcome.out)
    assert (outcome.code, account["figure"], account["unranked"]) == (0, None, answer["unranked"])
    serial = answer["unranked"][0]["serial"]
    assert f"({serial}): no calibration of it was given" in outcome.err


@pytest.mark.usefixtures("blank_pictures")
def test_the_page_is_written(base: Path, tmp_path: Path, run: Run) -> None:
    """As HTML alone; a sensor without validation, and no calibration at all, give a page without ranks."""
    dataset, file = base / "fleet", tmp_path / "fleet.html"
    answer = run("fleet", "report", str(dataset), "-o", str(file), "--format", "json").result()
    assert answer["ranked"] == []
    assert "calibrate" in answer["unranked"][0]["command"]
    assert "Only sensors that were evaluated have a rank: 0 of 1" in file.read_text(encoding="utf-8")
    with pytest.raises(ForceTorqueError, match=r"expected a name that ends in .html"):
        fleet_report(dataset).save(tmp_path / "fleet.txt")


def test_two_calibrations_of_a_sensor_are_refused(base: Path, tmp_path: Path) -> None:
    """Only one is in use; a calibration of another fleet is a warning; an empty folder is refused."""
    _fleet(base, 1, tmp_path)
    own = tmp_path / "calibrations" / "FT000.json"
    (tmp_path / "other.json").write_bytes(own.read_bytes())
    with pytest.raises(ExperimentError, match=r"expected one calibration of every sensor, got .*FT000.json of 'FT000'"):
        fleet_report(base / "fleet", calibrations=[own, tmp_path / "other.json"])
    (warning,) = fleet_report(base / "fleet", calibrations=[own]).warnings
    assert "(FT000), which the dataset does not have" in warning
    (tmp_path / "empty").mkdir()
    (tmp_path / "calibrations" / "a_report.json").write_text('{"schema": "forcetorque/other/1"}', encoding="utf-8")
    assert fleet_report(base / "fleet", calibrations=[own.parent]).warnings == (warning,)
    with pytest.raises(MissingFileError, match=r"expected a folder of calibrations, .json; it holds none"):
        fleet_report(base / "fleet", calibrations=[tmp_path / "empty"])


@pytest.mark.long
def test_two_hundred_robots(base: Path, tmp_path: Path) -> None:
    """Five damaged sensors among 200 are the first five."""
    damaged = {13: "gain", 42: "reversed", 77: "drifting", 123: "dead", 199: "noisy"}
    serials = _fleet(base, 200, tmp_path, damaged)
    _assert_damaged_first(_report(tmp_path), serials, damaged)


@pytest.mark.long
@pytest.mark.parametrize("robots", [12, 200])
def test_logs_of_robots(tmp_path: Path, robots: int) -> None:
    """From logs to the page: five damaged sensors are the first five, calibrations are those of the logs."""
    damaged = {1: "gain", 3: "reversed", 4: "drifting", 7: "dead", 10: "clipped"}
    plan = write_logs(robots, damaged, tmp_path)
    done = run_plan(plan, InProcess())
    assert (done.added, done.failures) == (4 * robots, ())
    report = _report(tmp_path)
    _assert_damaged_first(report, [f"FT{k:03}" for k in range(robots)], damaged)
    assert [row.fitted_recordings for row in report.coverage] == [2] * robots
    for row in report.ranked:
        records = Dataset(tmp_path / "fleet").records(Dataset(tmp_path / "fleet").of_sensor(row.serial))
        runs = [SensorRun(load_experiment(one.file), "arm_ft") for one in records if one.moments is not None]
        expected = calibrate_sensor(runs, code_version="1", created="2020")
        made = read_calibration(row.calibration)
        assert np.abs(made.matrix - expected.matrix).max() <= SAME * np.abs(expected.matrix).max()
        assert np.abs(made.offset - expected.offset).max() <= SAME * np.abs(expected.offset).max()
    report.save(tmp_path / "fleet.html")
    assert (tmp_path / "fleet.html").stat().st_size > 20_000


@pytest.mark.parametrize(("remedy", "command"), [("Tare it.", ""), (LOOK_FOR_CAUSE, "inspect day.toml --details")])
def test_the_next_command_does_what_the_step_says(remedy: str, command: str) -> None:
    """`inspect` shows causes of an error, and nothing of a tare."""
    verdict = SimpleNamespace(reasons=(Reason(against="use", text="it errs", remedy=remedy),))
    row = SimpleNamespace(last_file="day.toml", allowed=None)
    assert _next(row, verdict, SimpleNamespace()) == (remedy, command)
