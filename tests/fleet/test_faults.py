# SPDX-License-Identifier: BSD-3-Clause
"""What goes wrong while recordings are added: each is one clear error or row, nothing is lost or counted twice."""

from __future__ import annotations

import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pyarrow.parquet as pq
import pytest

from forcetorque.base.errors import ChangingFileError, ExperimentError, FormatError, OutputError
from forcetorque.fleet import added_and_failed_recordings as add
from forcetorque.fleet.added_and_failed_recordings import Failures, add_recording, stored_failures
from forcetorque.fleet.parquet_dataset import Dataset
from forcetorque.fleet.recording_source import RecordingSource
from forcetorque.fleet.run import run_plan
from forcetorque.fleet.sensor_record import AddOptions
from tests.fleet.pools import InProcess

FILES = ("day_1.toml", "day_2.toml")
OPTIONS = AddOptions()


@contextmanager
def _small_disk(size: int) -> Iterator[None]:
    """No file of this process may grow beyond a size in bytes, as on a disk that is full."""
    resource = pytest.importorskip("resource")
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


def _plan(folder: Path, more: str = "") -> Path:
    file = folder / "plan.toml"
    file.write_text(
        f'schema = "forcetorque/fleet_plan/1"\ndataset = "fleet"\n[[recordings]]\nexperiments = "day_*.toml"\n{more}',
        encoding="utf-8",
    )
    return file


def test_a_full_disk(days: Path) -> None:
    """One error with the file; nothing is left of it, and the next attempt adds the recording."""
    source, folder = RecordingSource(experiment=days / FILES[0]), days / "fleet"
    with _small_disk(4096), pytest.raises(OutputError, match=r"\.parquet: expected to write the file, got File too"):
        add_recording(source, folder, OPTIONS)
    assert [path for path in folder.rglob("*") if path.is_file()] == []
    assert [row.state for row in add_recording(source, folder, OPTIONS)] == ["added"]


@pytest.mark.long
def test_a_full_disk_is_a_row_that_is_tried_again(days: Path) -> None:
    """Not a failure of the data, although the failure itself cannot be kept."""
    plan = _plan(days)
    with _small_disk(4096):
        first = run_plan(plan, InProcess())
    assert (first.added, [row.earlier for row in first.failures]) == (0, [False, False])
    assert all("expected to write the file" in row.error for row in first.failures)
    second = run_plan(plan, InProcess())
    assert (second.added, second.failures) == (2, ())


@pytest.mark.long
def test_a_damaged_log_is_a_row_until_it_is_whole(days: Path) -> None:
    """The other recording is added; the damaged one is not tried in vain, but as soon as its log changed."""
    plan, log = _plan(days), next((days / "day_1").glob("*.parquet"))
    whole = log.read_bytes()
    log.write_bytes(whole[: len(whole) // 2])
    first = run_plan(plan, InProcess())
    assert (first.added, [Path(row.subject).name for row in first.failures]) == (1, ["day_1.toml"])
    assert log.name in first.failures[0].error
    assert [row.earlier for row in run_plan(plan, InProcess()).failures] == [True]
    log.write_bytes(whole)
    third = run_plan(plan, InProcess())
    assert (third.added, third.present, third.failures) == (1, 1, ())
    assert Dataset.opened(days / "fleet").recordings == 2


def test_a_log_that_grows_while_it_is_read(days: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It is refused with the name of the file, and added when it is complete; negative control: it does not grow."""
    source, folder, log = RecordingSource(experiment=days / FILES[0]), days / "fleet", days / "day_1" / "arm_ft.parquet"
    reduce = add.sensor_records

    def growing(*arguments: object, **options: object) -> object:
        with log.open("ab") as stream:
            stream.write(b"more")
        return reduce(*arguments, **options)  # type: ignore[arg-type]

    whole = log.read_bytes()
    monkeypatch.setattr(add, "sensor_records", growing)
    with pytest.raises(ChangingFileError, match=r"day_1.toml: expected inputs that do not change .* day_1/arm_ft.parq"):
        add_recording(source, folder, OPTIONS)
    assert Dataset(folder).present() == []
    monkeypatch.undo()
    log.write_bytes(whole)
    assert [row.state for row in add_recording(source, folder, OPTIONS)] == ["added"]


@pytest.mark.long
def test_a_log_that_another_process_writes(days: Path) -> None:
    """A process of its own refuses it with the name of the file and adds nothing; then it is added once."""
    command = [sys.executable, "-m", "forcetorque", "fleet", "add", FILES[0], "--into", "fleet"]
    log, rounds = days / "day_1" / "recording.json", 0
    with subprocess.Popen(command, cwd=days, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as adding:
        while adding.poll() is None:
            with log.open("a", encoding="utf-8") as stream:
                stream.write("\n")  # the file can be read at any time
            rounds += 1
            time.sleep(0.01)
        assert adding.stderr is not None
        assert "expected inputs that do not change" in (said := adding.stderr.read())
    assert (adding.returncode, rounds > 1, "day_1/recording.json" in said) == (2, True, True)
    assert Dataset(days / "fleet").present() == []
    subprocess.run(command, cwd=days, check=True, capture_output=True)
    assert Dataset.opened(days / "fleet").recordings == 1


def test_a_recording_of_an_installed_robot_is_known_again(days: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It is added by the name of its robot, not read a second time, and changed where the file of the robot is."""
    description = days / "cache" / "arms" / "urdf"
    (days / "cache" / "arms" / ".git").mkdir(parents=True)
    (days / "cache" / "arms" / ".git" / "HEAD").write_text("1234\n", encoding="utf-8")
    description.mkdir()
    shutil.move(days / "robot.urdf", description / "armlet.urdf")
    monkeypatch.setenv("ROBOT_DESCRIPTIONS_CACHE", str(days / "cache"))
    file, folder = days / FILES[0], days / "fleet"
    file.write_text(file.read_text(encoding="utf-8").replace('"robot.urdf"', '"armlet"'), encoding="utf-8")
    source = RecordingSource(experiment=file)
    assert [row.state for row in add_recording(source, folder, OPTIONS)] == ["added"]
    with monkeypatch.context() as patch:
        patch.setattr(RecordingSource, "load", lambda own: pytest.fail("it is read again"))
        assert [row.state for row in add_recording(source, folder, OPTIONS)] == ["present"]
    with (description / "armlet.urdf").open("a", encoding="utf-8") as stream:
        stream.write("<!-- another -->\n")
    with pytest.raises(ExperimentError, match=r"changed after it was added to .*armlet \(arms 1234\)"):
        add_recording(source, folder, OPTIONS)


def test_a_failure_is_forgotten_when_the_recording_is_added(days: Path) -> None:
    """By `fleet add` as by the plan that failed; a failure of another recording stays."""
    folder, sources = days / "fleet", [RecordingSource(experiment=days / file) for file in FILES[:2]]
    kept = Failures(dataset=folder, options=OPTIONS, code_version="1")
    for source in sources:
        kept.keep(source, "damaged")
    add_recording(sources[0], folder, OPTIONS)
    assert [one.file for one in stored_failures(folder)] == [str(sources[1].path)]


@pytest.mark.long
def test_a_recording_that_changed_is_a_row(days: Path) -> None:
    """What was added stays as it is."""
    plan, file = _plan(days), days / FILES[0]
    run_plan(plan, InProcess())
    before = Dataset(days / "fleet").present()
    file.write_text(file.read_text(encoding="utf-8").replace("start_s = 0.5", "start_s = 1.0"), encoding="utf-8")
    again = run_plan(plan, InProcess())
    assert (again.added, again.present, len(again.failures)) == (0, 1, 1)
    assert "changed after it was added" in again.failures[0].error
    assert "--replace" in again.failures[0].error
    assert Dataset(days / "fleet").present() == before


@pytest.mark.long
def test_one_serial_number_on_two_robots_is_a_row(days: Path) -> None:
    """The first robot keeps its recording."""
    (days / "other").mkdir()
    shutil.move(days / FILES[1], days / "other")
    file = days / "other" / FILES[1]
    text = file.read_text(encoding="utf-8").replace('"robot.urdf"', '"../robot.urdf"').replace("matrix_", "../matrix_")
    file.write_text(text.replace('path = "day_2"', 'path = "../day_2"'), encoding="utf-8")
    plan = _plan(days, 'robot = "one"\n[[recordings]]\nexperiments = "other/*.toml"\nrobot = "two"\n')
    done = run_plan(plan, InProcess())
    assert (done.added, len(done.failures)) == (1, 1)
    assert "expected a serial number that no other robot has" in done.failures[0].error
    assert len(Dataset(days / "fleet").present()) == 1


def test_a_dataset_of_a_newer_form_is_left_alone(days: Path) -> None:
    """A recording that a newer version added is not replaced by an earlier one."""
    source, folder = RecordingSource(experiment=days / FILES[0]), days / "fleet"
    add_recording(source, folder, OPTIONS)
    (one,) = Dataset(folder).present()
    file = folder / one.path
    newer = file.with_name(file.name.replace(one.options, "0123abcd"))
    pq.write_table(pq.read_table(file).replace_schema_metadata({"schema": "forcetorque/dataset/99"}), newer)
    file.unlink()
    with pytest.raises(FormatError, match="of a newer version of forcetorque; install that version"):
        add_recording(source, folder, OPTIONS)
    assert [path.name for path in folder.rglob("*.parquet")] == [newer.name]


def test_a_pattern_without_a_match_adds_nothing(days: Path) -> None:
    """Although another table has recordings."""
    plan = _plan(days, '[[recordings]]\nexperiments = "none/*.toml"\n')
    with pytest.raises(ExperimentError, match=r"recordings\[1\]: expected files that match 'none/\*.toml'"):
        run_plan(plan, InProcess())
    assert not (days / "fleet").exists()
