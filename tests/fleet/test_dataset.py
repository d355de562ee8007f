# SPDX-License-Identifier: BSD-3-Clause
"""A dataset of the simulated arm on three days: what is added, kept, calibrated and evaluated from it."""

from __future__ import annotations

import re
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from forcetorque.app.wrapped_commands import _in_place_of
from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FitError, FormatError, MissingFileError, OutputError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.evaluation.commands import evaluate
from forcetorque.evaluation.evaluation import validation_errors
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.fleet.added_and_failed_recordings import add_recording, add_recordings
from forcetorque.fleet.analyses_of_dataset import COMMANDS, FROM_LOGS, dataset_logs
from forcetorque.fleet.evaluate import evaluate_dataset
from forcetorque.fleet.parquet_columns import columns_of, rows_of, schema_of, unit_of
from forcetorque.fleet.parquet_dataset import Dataset, is_dataset
from forcetorque.fleet.recording_source import RecordingSource
from forcetorque.fleet.report import fleet_report_of
from forcetorque.fleet.report_page import page
from forcetorque.fleet.run import run_calibrate
from forcetorque.fleet.sensor_record import SCHEMA, AddOptions, SensorRecord, path_digest
from forcetorque.fleet.table import fleet_table_of
from tests.app.outcome import Run
from tests.scenes.studies import CALIBRATION as _ALL_CALIBRATION, SERIAL, VALIDATION

CALIBRATION = _ALL_CALIBRATION[2:]
FILES = (*CALIBRATION, *VALIDATION)
OPTIONS = AddOptions(block_s=3.0)
"""Blocks so short that every interval has several."""
SAME = 1e-12
"""Rounding of sums in another order, over sizes."""


@pytest.fixture(scope="module")
def added(recorded: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Dataset of four recordings; nobody changes it."""
    folder = tmp_path_factory.mktemp("fleet") / "dataset"
    add_recordings([recorded / name for name in FILES], folder, OPTIONS)
    return folder


def _source(file: Path) -> RecordingSource:
    return RecordingSource(experiment=file)


def _in_order(dataset: Dataset, names: tuple[str, ...], folder: Path) -> list[SensorRun]:
    """Runs of experiment files in the order in which the dataset has them."""
    files = [Path(record.file).name for record in dataset.records(dataset.files)]
    return [SensorRun(load_experiment(folder / name), "arm_ft") for name in sorted(names, key=files.index)]


def _from_dataset(dataset: Dataset) -> Calibration:
    moments, _ = dataset.moments(dataset.records(dataset.of_sensor(SERIAL)))
    return calibrate_sensor(None, code_version="1", created="2020", moments=moments)


def _close(one: FloatArray, other: FloatArray) -> bool:
    return float(np.abs(one - other).max()) <= SAME * float(np.abs(other).max())


def test_calibration_is_that_of_the_logs(added: Path, recorded: Path) -> None:
    """Matrix, offsets, coefficients, covariance, range and names; blocks put together are the intervals."""
    dataset = Dataset.opened(added)
    blocks = [record.moments.intervals for record in dataset.records(dataset.files) if record.moments is not None]
    assert [len(one) > 1 for one in blocks] == [True] * len(CALIBRATION)
    made = _from_dataset(dataset)
    expected = calibrate_sensor(_in_order(dataset, CALIBRATION, recorded), code_version="1", created="2020")
    assert made.posterior is not None
    assert expected.posterior is not None
    assert made.validity.loads is not None
    assert expected.validity.loads is not None
    for one, other in (
        (made.matrix, expected.matrix),
        (made.offset, expected.offset),
        (made.variables[0].coefficients, expected.variables[0].coefficients),
        (made.posterior.covariance, expected.posterior.covariance),
        (made.validity.loads.maximum, expected.validity.loads.maximum),
    ):
        assert _close(one, other)
    assert [one.name for one in made.sessions] == [one.name for one in expected.sessions]
    assert made.provenance.intervals == expected.provenance.intervals
    assert (made.provenance.samples, made.provenance.dropped) == (
        expected.provenance.samples,
        expected.provenance.dropped,
    )


def test_evaluation_is_that_of_the_logs(added: Path, recorded: Path) -> None:
    """Errors per axis with either offset, of calibration and prior, and verdicts with their reasons."""
    dataset = Dataset.opened(added)
    calibration = _from_dataset(dataset)
    made = evaluate_dataset(dataset, {"calibration": calibration})
    validation = [record.file for record in dataset.records(dataset.files) if record.evaluation is not None]
    runs = [SensorRun(load_experiment(file), "arm_ft") for file in validation]
    expected = evaluate(runs, calibration)
    assert len(made.errors) == len(expected.verdicts) == 4
    for row, other in zip(made.errors, expected.verdicts, strict=True):
        assert (row.calibration, row.offset, row.samples) == (other.calibration, other.offset, other.samples)
        for name in ("rmse", "bias", "excitation_N", "load_Nm"):
            assert np.allclose(getattr(row, name), getattr(other, name), rtol=1e-9, atol=1e-9)
    assert made.load_cases
    for use, verdict in zip(made.load_cases, expected.load_cases, strict=True):
        assert (use.decision, use.message) == (verdict.decision, verdict.message)
        assert [reason.text for reason in use.reasons] == [reason.text for reason in verdict.reasons]
        assert use.errors[0].measured == pytest.approx(verdict.errors[0].measured, rel=1e-9)


@pytest.mark.long
def test_comparison_with_the_prior_is_that_of_the_logs(added: Path, recorded: Path) -> None:
    """A calibration that is made worse than its prior is found so by blocks as by samples."""
    dataset = Dataset.opened(added)
    fitted = _from_dataset(dataset)
    spoilt = fitted.model_copy(update={"matrix": 1.3 * fitted.matrix})
    made = evaluate_dataset(dataset, {"spoilt": spoilt}).load_cases
    validation = [record.file for record in dataset.records(dataset.files) if record.evaluation is not None]
    runs = [SensorRun(load_experiment(file), "arm_ft") for file in validation]
    expected = evaluate(runs, {"spoilt": spoilt}).load_cases
    assert [use.decision for use in made] == [use.decision for use in expected]
    assert [[reason.against for reason in use.reasons] for use in made] == [
        [reason.against for reason in use.reasons] for use in expected
    ]
    assert any("larger than that of its prior" in reason.text for use in made for reason in use.reasons)


@pytest.mark.long
def test_order_of_adding_changes_nothing(added: Path, recorded: Path, tmp_path: Path) -> None:
    """Files of the same names, and the same calibration to the last bit."""
    other = tmp_path / "other"
    for name in reversed(FILES):
        add_recording(_source(recorded / name), other, OPTIONS)
    assert Dataset(other).present() == Dataset(added).present()
    assert np.array_equal(_from_dataset(Dataset(other)).matrix, _from_dataset(Dataset(added)).matrix)


def test_adding_again_changes_nothing(added: Path, recorded: Path, tmp_path: Path) -> None:
    """Also from another folder; a file that a killed process left is not read, and no other one either."""
    before = {path: path.stat().st_mtime_ns for path in added.rglob("*.parquet")}
    moved = Path(shutil.copytree(recorded, tmp_path / "moved"))
    for folder in (recorded, moved):
        (row,) = add_recording(_source(folder / FILES[0]), added, OPTIONS)
        assert row.state == "present"
    half = next(iter(before)).with_name(".forcetorque-0123456789abcdef0123456789abcdef.tmp")
    half.write_bytes(b"PAR1 half")
    assert len(Dataset.opened(added).files) == len(FILES)
    half.unlink()
    assert {path: path.stat().st_mtime_ns for path in added.rglob("*.parquet")} == before


def test_a_recording_that_changed_is_refused(days: Path, tmp_path: Path) -> None:
    """Until it is to take the place of what was added; then it counts once."""
    file, folder = days / FILES[2], tmp_path / "dataset"
    add_recording(_source(file), folder, OPTIONS)
    file.write_text(file.read_text(encoding="utf-8").replace("start_s = 0.5", "start_s = 1.0"), encoding="utf-8")
    with pytest.raises(ExperimentError, match=rf"changed after it was added to .*: {FILES[2]}; --replace"):
        add_recording(_source(file), folder, OPTIONS)
    before = Dataset(folder).present()
    (row,) = add_recording(_source(file), folder, OPTIONS, replace=True)
    assert row.state == "added"
    after = Dataset(folder).present()
    assert len(after) == 1
    assert after != before


def test_a_corrected_serial_number_or_robot_takes_the_place(days: Path, tmp_path: Path) -> None:
    """Otherwise one recording would count for two sensors, or a robot that was forgotten could not be named."""
    file, folder = days / FILES[0], tmp_path / "dataset"
    add_recording(_source(file), folder, OPTIONS)
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace("SIM001", "SIM002"), encoding="utf-8")
    (days / "matrix_SIM001.txt").rename(days / "matrix_SIM002.txt")
    with pytest.raises(ExperimentError, match="changed after it was added"):
        add_recording(_source(file), folder, OPTIONS)
    add_recording(_source(file), folder, OPTIONS, replace=True)
    assert [one.serial for one in Dataset(folder).present()] == ["SIM002"]
    named = replace(OPTIONS, robot="arm 7")
    with pytest.raises(ExperimentError, match="put it right by --replace"):
        add_recording(_source(file), folder, named)
    add_recording(_source(file), folder, named, replace=True)
    assert [(one.robot, one.serial) for one in Dataset(folder).present()] == [("arm 7", "SIM002")]


def test_a_file_beside_a_recording_does_not_have_it_read_again(
    days: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Only folders that are logs are looked at; one that is changed is."""
    file, folder = days / FILES[0], tmp_path / "dataset"
    add_recording(_source(file), folder, OPTIONS)
    (days / "notes.txt").write_text("windy", encoding="utf-8")
    loaded: list[Path] = []
    load = RecordingSource.load
    monkeypatch.setattr(RecordingSource, "load", lambda self: loaded.append(self.experiment) or load(self))
    (row,) = add_recording(_source(file), folder, OPTIONS)
    assert (row.state, loaded) == ("present", [])
    log = load_experiment(file).recording
    assert log is not None
    (days / file.stem / "notes.txt").write_text("in the log", encoding="utf-8")
    assert [one.state for one in add_recording(_source(file), folder, OPTIONS)] == ["present"]
    assert loaded == [file]


def test_a_file_is_no_dataset(days: Path, tmp_path: Path) -> None:
    """It is refused before anything is read."""
    (tmp_path / "notes.txt").write_text("mine", encoding="utf-8")
    with pytest.raises(OutputError, match="expected a folder for the dataset, got a file"):
        add_recordings([days / FILES[0]], tmp_path / "notes.txt", OPTIONS)


def test_other_options_take_the_place(days: Path, tmp_path: Path) -> None:
    """A recording counts once, whichever options and versions it was added with."""
    folder = tmp_path / "dataset"
    add_recording(_source(days / FILES[2]), folder, OPTIONS)
    add_recording(_source(days / FILES[2]), folder, AddOptions())
    assert len(list(folder.rglob("*.parquet"))) == 1


def test_serial_number_of_two_robots_is_refused(days: Path, tmp_path: Path) -> None:
    """When it is added, and where both were added at once."""
    folder, other = tmp_path / "dataset", tmp_path / "other"
    add_recording(_source(days / FILES[2]), folder, AddOptions(robot="r1"))
    with pytest.raises(ExperimentError, match=f"got '{SERIAL}', which the dataset has of robot 'r1', here it is of"):
        add_recording(_source(days / FILES[3]), folder, AddOptions(robot="r2"))
    add_recording(_source(days / FILES[3]), other, AddOptions(robot="r2"))
    shutil.copytree(other, folder, dirs_exist_ok=True)
    with pytest.raises(ExperimentError, match="on one robot, got it on r1 and r2"):
        Dataset.opened(folder).of_sensor(SERIAL)


def test_newer_version_and_damaged_files_are_named(added: Path, tmp_path: Path) -> None:
    """Each in one error with the file."""
    folder = Path(shutil.copytree(added, tmp_path / "dataset"))
    file = next(folder.rglob("*.parquet"))
    whole = pq.read_table(file)
    pq.write_table(whole.replace_schema_metadata({"schema": "forcetorque/dataset/99"}), file)
    with pytest.raises(FormatError, match=r"expected a dataset of the form .*, got forcetorque/dataset/99, of a newer"):
        fleet_table_of(folder)
    pq.write_table(whole.replace_schema_metadata({}), file)
    with pytest.raises(FormatError, match="got another Parquet file"):
        fleet_table_of(folder)
    file.write_bytes(b"PAR1 cut")
    with pytest.raises(FormatError, match=rf"{file.name}: expected a file of the form {SCHEMA}, got"):
        fleet_table_of(folder)
    with pytest.raises(MissingFileError, match="expected a dataset"):
        Dataset.opened(tmp_path / "none")


def test_unknown_sensors_are_refused(added: Path) -> None:
    """With those that are there; a name stands for a serial number where one sensor has it."""
    dataset = Dataset.opened(added)
    with pytest.raises(ExperimentError, match=f"no sensor has the serial number 'SIM002'; did you mean.*{SERIAL}"):
        dataset.of_sensor("SIM002")
    assert dataset.identity("arm_ft").serial == SERIAL


def test_table_has_the_errors_of_all_recordings(added: Path, recorded: Path) -> None:
    """Root mean squares about the means of intervals, by the prior matrix."""
    (row,) = fleet_table_of(added).sensors
    squares, samples = 0.0, 0
    for name in FILES:
        run = SensorRun(load_experiment(recorded / name), "arm_ft")
        (interval,) = run.experiment.recording.intervals
        part = run.interval_samples(interval, variables=["temperature"])
        assert run.sensor.prior is not None
        error = (part.raw @ run.sensor.prior.T - part.samples.reference)[:, :3]
        squares, samples = squares + float(((error - error.mean(axis=0)) ** 2).sum()), samples + len(error)
    assert (row.recordings, row.samples) == (len(FILES), samples)
    assert row.times_median == pytest.approx(1.0)
    assert row.prior_force_error_N == pytest.approx(np.sqrt(squares / samples), rel=1e-9)


def test_numbers_have_units(added: Path) -> None:
    """In the metadata of the fields of every file, also of nested ones; negative control: a field of no unit."""

    def numbers(field: pa.Field) -> list[pa.Field]:
        kind, inner = field.type, field
        while pa.types.is_list(kind):
            kind = kind.value_type
        if pa.types.is_struct(kind):
            return [one for k in range(kind.num_fields) for one in numbers(kind.field(k))]
        return [inner] if pa.types.is_floating(kind) else []

    schema = pq.read_schema(next(added.rglob("*.parquet")))
    assert schema.metadata[b"schema"].decode() == SCHEMA
    found = [one for field in schema for one in numbers(field)]
    assert len(found) > 30
    assert {one.name for one in found if not (one.metadata or {}).get(b"unit")} == set()
    assert unit_of("label") is None


def test_records_survive_a_file(added: Path) -> None:
    """Every field of a record, through columns and back."""
    dataset = Dataset.opened(added)
    records = dataset.records(dataset.files)
    again = [SensorRecord.model_validate(row) for row in rows_of(SensorRecord, columns_of(SensorRecord, records))]
    assert again == records
    assert {column.name for column in schema_of(SensorRecord)} == set(SensorRecord.model_fields)


@pytest.fixture
def in_rows(added: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The same dataset with a row for every few seconds of an interval."""
    monkeypatch.setattr("forcetorque.fleet.parquet_dataset._ROW_WINDOWS", 5)
    dataset = Dataset(tmp_path / "rows")
    for record in Dataset(added).records(Dataset(added).files):
        dataset.write(record, OPTIONS)
    return dataset.folder


def test_a_long_record_has_several_rows(added: Path, in_rows: Path) -> None:
    """All of them are one record; rows after the first have blocks of moments and the recording, so sums count once."""
    whole, divided = Dataset(added), Dataset(in_rows)
    records = divided.records(divided.files)
    assert records == whole.records(whole.files)
    files = [in_rows / file.path for file in divided.files]
    fitted = [file for file in files if pq.read_metadata(file).num_rows > 1]
    assert len(fitted) == len(CALIBRATION)
    for file in fitted:
        rows = pq.read_table(file).to_pylist()
        assert pq.read_metadata(file).num_row_groups == len(rows)
        assert all(row["moments"]["intervals"] for row in rows)
        assert len({row["recording"] for row in rows}) == 1
        named = {name for row in rows[1:] for name, value in row.items() if value not in (None, [])}
        assert named == {"recording", "moments"}
        assert {name for row in rows[1:] for name, value in row["moments"].items() if value not in (None, [])} == {
            "intervals"
        }
        pq.write_table(pq.read_table(file), file)  # in one row group, as other programs write it
    assert divided.records(divided.files) == records


def test_rows_of_several_recordings_in_one_file_are_refused(in_rows: Path) -> None:
    """Such as files that another program joined; also where only the first columns are read."""
    dataset = Dataset(in_rows)
    first, second = (in_rows / file.path for file in dataset.files[:2])
    pq.write_table(pa.concat_tables([pq.read_table(first), pq.read_table(second)]), first)
    with pytest.raises(FormatError, match=rf"{first.name}: .* got rows of several recordings; remove it and add again"):
        dataset.records(dataset.files)
    with pytest.raises(FormatError, match="rows of several recordings"):
        fleet_table_of(in_rows)


def test_a_dataset_of_the_first_form_is_read(added: Path, tmp_path: Path) -> None:
    """In which every record is one row."""
    folder = Path(shutil.copytree(added, tmp_path / "first"))
    records = Dataset(added).records(Dataset(added).files)
    for file in folder.rglob("*.parquet"):
        pq.write_table(pq.read_table(file).replace_schema_metadata({"schema": "forcetorque/dataset/1"}), file)
    assert Dataset(folder).records(Dataset(folder).files) == records


@pytest.mark.long
def test_duckdb_and_polars_read_it(added: Path, in_rows: Path) -> None:
    """As it is: partitions as columns, blocks as nested ones, several rows of a long record."""
    duckdb = pytest.importorskip("duckdb")
    polars = pytest.importorskip("polars")
    pattern = f"{in_rows}/*/*/*/*.parquet"
    (count, blocks), *_ = duckdb.sql(
        f"select count(identity), sum(len(moments.intervals)) from read_parquet('{pattern}', hive_partitioning=true) "
        f"where sensor = '{SERIAL}'"
    ).fetchall()
    records = Dataset(added).records(Dataset(added).files)
    kept = sum(len(record.moments.intervals) for record in records if record.moments is not None)
    assert (count, blocks) == (len(FILES), kept)
    frame = polars.read_parquet(pattern, hive_partitioning=True)
    assert frame["sensor"].unique().to_list() == [SERIAL]
    assert frame["findings"].list.len().sum() == sum(len(record.findings) for record in records)
    assert frame["identity"].count() == len(FILES) < frame.height


def test_commands(added: Path, recorded: Path, tmp_path: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """Add, table, calibrate and evaluate as they are typed; a command that needs samples names the log."""
    monkeypatch.chdir(tmp_path)
    log = str(recorded / FILES[2])
    first = run("fleet", "add", log, "--into", "mine", "--format", "json").result()
    assert [row["state"] for row in first["sensors"]] == ["added"]
    assert "ALREADY THERE" in run("fleet", "add", log, "--into", "mine").out
    assert is_dataset(tmp_path / "mine")
    assert run("fleet", "table", str(added), "--format", "csv").rows()[0]["serial"] == SERIAL
    answer = run("calibrate", str(added), "--sensor", SERIAL, "-o", "c.json")
    assert answer.code == 0, answer.err
    evaluated = run("evaluate", str(added), "-c", "c.json", "--format", "json").result()
    assert evaluated["schema"] == "forcetorque/evaluate_dataset/1"
    assert evaluated["load_cases"]
    drawn = run("evaluate", str(added), "-c", "c.json", "--figure", "e.png", "--format", "json").result()
    assert drawn["figure"] == "e.png"
    assert (tmp_path / "e.png").read_bytes().startswith(b"\x89PNG")
    assert "expected a name that ends in" in run("evaluate", str(added), "-c", "c.json", "--figure", "e.txt").error()
    shown = run("evaluate", str(added), "-c", "c.json")
    assert len(shown.out.splitlines()) <= 12
    assert "need the log" in run("evaluate", str(added), "-c", "c.json", "--details").out
    refused = run("report", str(added), "-o", "page.html").error()
    assert f"report needs samples, which a dataset does not keep; name experiment files in place of {added}:" in refused
    assert f"{recorded}" in refused
    assert "needs samples" in run("calibrate", str(added), "-o", "d.json", "--type", "SnTdTO").error()
    assert "a dataset alone" in run("evaluate", str(added), log, "-c", "c.json").error()
    assert 'expected an interval with use = "calibration"' in run("calibrate", "mine", "-o", "d.json").err


def test_a_copy_of_a_recording_counts_once(added: Path, days: Path, tmp_path: Path) -> None:
    """Under another name: it is left out and named, and matrix and errors are those without it."""
    shutil.copytree(added, tmp_path / "dataset")
    for number, name in enumerate((CALIBRATION[0], VALIDATION[0])):
        text = (days / name).read_text()
        (days / f"copy_{number}.toml").write_text(re.sub(r'(?m)^name = ".*"', f'name = "copy {number}"', text, count=1))
        add_recording(_source(days / f"copy_{number}.toml"), tmp_path / "dataset", OPTIONS)
    once, twice = Dataset.opened(added), Dataset.opened(tmp_path / "dataset")
    assert len(twice.files) == len(once.files) + 2
    first, second = (
        calibrate_sensor(None, code_version="1", created="now", moments=one.moments(one.records(one.files))[0])
        for one in (once, twice)
    )
    np.testing.assert_allclose(second.matrix, first.matrix, rtol=SAME)
    assert second.warnings == first.warnings, "a copy is no doubt about what was fitted"
    (left_out,) = twice.moments(twice.records(twice.files))[1]
    assert re.search(r"copy 0.* again, and readings count once; it is left out$", left_out)
    assert not once.moments(once.records(once.files))[1]
    alone, both = (evaluate_dataset(one, {"new": calibration}) for one, calibration in ((once, first), (twice, second)))
    assert alone.load_cases
    assert [(case.decision, case.message) for case in both.load_cases] == [
        (case.decision, case.message) for case in alone.load_cases
    ]
    assert [row.samples for row in both.errors] == [row.samples for row in alone.errors]
    assert any("copy 1" in text and "it is left out" in text for text in both.warnings)
    folder = tmp_path / "calibrations"
    calibrated = run_calibrate(SERIAL, twice.folder, folder, code_version="1", created="now")
    assert [re.findall(r"copy \d", text) for text in calibrated.left_out] == [["copy 0"], ["copy 1"]]
    of_once, of_twice = (fleet_report_of(one.folder, [folder]) for one in (once, twice))
    assert of_once.warnings == ()
    assert of_twice.coverage == of_once.coverage
    (warnings,) = (
        part for part in page(of_twice, created="2026-01-01T00:00:00+00:00").sections if part.title == "Warnings"
    )
    assert all(name in str(warnings.blocks) for name in ("copy 0", "copy 1", "it is left out"))
    assert all(part.title != "Warnings" for part in page(of_once, created="2026-01-01T00:00:00+00:00").sections)


def test_evaluate_refuses_a_copy_of_a_log(days: Path) -> None:
    """Under another name its samples would count twice; another log is evaluated."""
    text = (days / VALIDATION[0]).read_text()
    (days / "copy.toml").write_text(re.sub(r'(?m)^name = ".*"', 'name = "copy"', text, count=1))
    log, copy, other = (
        SensorRun(load_experiment(days / name), "arm_ft") for name in (VALIDATION[0], "copy.toml", VALIDATION[1])
    )
    with pytest.raises(ExperimentError, match="'copy' has readings of .* again, .*; leave one of the two out"):
        validation_errors([log, copy], {})
    assert validation_errors([log, other], {}).recordings


def test_quadratic_terms_need_samples(added: Path) -> None:
    """A calibration that has them is refused with the log that it can be evaluated on."""
    from forcetorque.experiment.calibration.quadratic_correction import QuadraticCorrection

    dataset = Dataset.opened(added)
    plain = _from_dataset(dataset)
    quadratic = QuadraticCorrection.model_construct()
    with pytest.raises(FitError, match="quadratic terms need samples"):
        evaluate_dataset(dataset, {"c": plain.model_copy(update={"quadratic": quadratic})})


@pytest.mark.long
@pytest.mark.parametrize("command", ["inspect", "payload"])
def test_commands_that_need_samples_read_the_recordings(added: Path, recorded: Path, run: Run, command: str) -> None:
    """By the experiment files that the dataset names, which is said; results are those of these files."""
    files = sorted((recorded / name for name in FILES), key=lambda file: load_experiment(file).recording.start_ns)
    read = files[-1:] if command == "inspect" else files
    from_dataset = run(command, str(added), "--format", "json")
    assert f"{command} needs samples: reading the recordings of {added}: {files[-1]}" in from_dataset.err
    from_files = run(command, *map(str, read), "--format", "json")
    assert (from_dataset.code, from_dataset.out) == (from_files.code, from_files.out)


def test_recordings_are_read_where_they_were_added_from(added: Path, recorded: Path) -> None:
    """Those of the chosen sensors in the order of time, by the names that these have there."""
    dataset = Dataset.opened(added)
    files, sensors = logs = dataset_logs(dataset, "plan", [SERIAL])
    assert {file.name for file in files} == set(FILES)
    rows = [row for file in files for row in dataset.rows(dataset.of_path(path_digest(file)), ["start_ns"])]
    starts = [row["start_ns"] for row in rows]
    assert starts == sorted(starts)
    assert sensors == (dataset.identity(SERIAL).name,)
    given = {"experiments": [added], "sensor": SERIAL}
    replaced = _in_place_of(added, logs, given, ["experiments"])
    assert replaced == {"experiments": list(files), "sensor": sensors[0]}
    assert _in_place_of(added, logs, {"log": added}, ["log"]) == {"log": files[-1]}


def test_recordings_that_are_not_there_are_named(days: Path, tmp_path: Path) -> None:
    """With what needs their samples."""
    (tmp_path / "moved").mkdir()
    file = next(iter(sorted(days.glob("*.toml"))))
    add_recording(RecordingSource(experiment=file), tmp_path / "fleet", AddOptions())
    dataset = Dataset.opened(tmp_path / "fleet")
    file.rename(tmp_path / "moved" / file.name)
    with pytest.raises(MissingFileError, match=f"view needs samples, .* added from, .*{file.name}, which is not there"):
        dataset_logs(dataset, "view", ())


def test_the_page_says_what_every_command_does_with_a_dataset() -> None:
    """Each is from the dataset, reads the recordings that it names, or refuses it."""
    page = (Path(__file__).parents[2] / "docs" / "fleet.md").read_text(encoding="utf-8")
    _, of_dataset, of_samples = re.split(r"\n\| (?:from the dataset|reads the recordings) \|", page)
    for command in COMMANDS:
        assert f"`{command}`" in of_dataset
    rows, _, _ = of_samples.partition("\n\n")
    listed = [name.split()[-1] for name in re.findall("`([^`]+)`", rows)]
    assert sorted(listed) == sorted(FROM_LOGS)
