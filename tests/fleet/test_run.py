# SPDX-License-Identifier: BSD-3-Clause
"""Plans: recordings by pattern, failures that are kept and tried again, and logs that share an experiment file."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError, FormatError, MissingExtraError, MissingFileError, OutputError
from forcetorque.fleet.parquet_dataset import Dataset
from forcetorque.fleet.recording_source import RecordingSource
from forcetorque.fleet.run import run_plan
from tests.app.outcome import Run
from tests.fleet.pools import InProcess

PLAN = """
schema = "forcetorque/fleet_plan/1"
dataset = "fleet"
calibrations = "calibrations"
[[recordings]]
experiments = "{pattern}"
"""


def _plan(folder: Path, text: str) -> Path:
    file = folder / "plan.toml"
    file.write_text(text, encoding="utf-8")
    return file


@pytest.mark.long
def test_a_plan_is_worked_off_and_resumed(days: Path) -> None:
    """Added once, calibrated, evaluated; a recording that fails is a row, is not tried in vain, then tried again."""
    broken = days / "move_broken.toml"
    text = (days / "move_warm.toml").read_text(encoding="utf-8")
    broken.write_text(text.replace('support = "base"', 'support = "none"'), encoding="utf-8")
    (days / "day_2.toml").unlink()
    (days / "grid_cold.toml").unlink()
    (days / "grid_warm.toml").unlink()
    plan = _plan(days, PLAN.format(pattern="[md]*_*.toml"))
    first = run_plan(plan, InProcess())
    assert (first.recordings, first.added, first.present, first.passed) == (4, 3, 0, False)
    assert [(row.subject, row.earlier) for row in first.failures] == [(str(broken), False)]
    assert "'none'" in first.failures[0].error
    (sensor,) = first.sensors
    assert (sensor.recordings, Path(sensor.file).is_file()) == (2, True)
    assert sensor.decision in {"use", "do not use", "not enough data"}
    assert sensor.force_error_rms_N is not None
    assert sensor.prior_force_error_rms_N is not None
    assert sensor.force_error_rms_N < sensor.prior_force_error_rms_N
    second = run_plan(plan, InProcess())
    assert (second.added, second.present, second.failures[0].earlier) == (0, 3, True)
    broken.write_text(text.replace('"arm move_warm"', '"arm other"'), encoding="utf-8")
    third = run_plan(plan, InProcess(), retry_failed=True)
    assert (third.added, third.present) == (1, 3)
    assert list((days / "fleet" / "failures").iterdir()) == []


def test_logs_share_an_experiment_file(days: Path) -> None:
    """The log takes the place of the path; each is a recording by its own name, and its path is in the dataset."""
    plan = _plan(
        days,
        'schema = "forcetorque/fleet_plan/1"\ndataset = "fleet"\n'
        '[[recordings]]\ntemplate = "day_2.toml"\nlogs = "day_[12]"\nrobot = "arm 7"\n',
    )
    assert run_plan(plan, InProcess()).added == 2
    dataset = Dataset.opened(days / "fleet")
    records = dataset.records(dataset.files)
    assert sorted(record.experiment for record in records) == ["arm day_2, day_1", "arm day_2, day_2"]
    assert sorted(Path(record.file).name for record in records) == ["day_1", "day_2"]
    assert {file.robot for file in dataset.files} == {"arm 7"}
    assert run_plan(plan, InProcess()).present == 2


def test_bad_plans_are_refused(days: Path) -> None:
    """A pattern without a match, a recording of two tables, a table of no or both kinds."""
    with pytest.raises(ExperimentError, match=r"plan.toml: recordings\[0\]: expected files that match 'none/\*'"):
        run_plan(_plan(days, PLAN.format(pattern="none/*")), InProcess())
    twice = PLAN.format(pattern="day_1.toml") + '[[recordings]]\nexperiments = "day_*.toml"\n'
    with pytest.raises(ExperimentError, match=r"recordings\[1\]: .*day_1.toml is in recordings\[0\] too"):
        run_plan(_plan(days, twice), InProcess())
    with pytest.raises(FormatError, match="template and logs, one of both"):
        run_plan(_plan(days, PLAN.format(pattern="*") + 'logs = "*"\n'), InProcess())


ADDRESSES = """schema = "forcetorque/fleet_plan/1"
dataset = "{dataset}"
[[recordings]]
template = "day_2.toml"
logs = "{logs}"
"""


def test_logs_are_read_from_addresses(days: Path) -> None:
    """As from folders, but for their names; a second run copies them and adds nothing."""
    fsspec = pytest.importorskip("fsspec")
    memory = fsspec.filesystem("memory")
    for day in ("day_1", "day_2"):
        memory.put(str(days / day), f"/fleet/{day}", recursive=True)
    plan = _plan(days, ADDRESSES.format(dataset="fleet", logs="memory://fleet/day_*"))
    assert run_plan(plan, InProcess()).added == 2
    assert run_plan(plan, InProcess()).present == 2
    local = _plan(days, ADDRESSES.format(dataset="local", logs="day_[12]"))
    assert run_plan(local, InProcess()).added == 2
    from_addresses, from_folders = (
        sorted(dataset.records(dataset.files), key=lambda record: record.experiment)
        for dataset in (Dataset.opened(days / "fleet"), Dataset.opened(days / "local"))
    )
    for one, other in zip(from_addresses, from_folders, strict=True):
        assert one.file == f"memory:///fleet/{Path(other.file).name}"
        assert (one.experiment, one.start_ns) == (other.experiment, other.start_ns)
        assert sorted(one.inputs_sha256.values()) == sorted(other.inputs_sha256.values())
        assert {name for name in one.inputs_sha256 if "memory" in name}
        assert one.evaluation is not None
        assert other.evaluation is not None
        assert np.array_equal(one.evaluation.sessions[0].raw, other.evaluation.sessions[0].raw)
    memory.rm("/fleet/day_1", recursive=True)
    (days / "day_2.toml").touch()
    source = RecordingSource(experiment=days / "day_2.toml", address="memory://fleet/day_1")
    with pytest.raises(MissingFileError, match="memory://fleet/day_1: expected a log that fsspec reads"):
        source.load()


def test_addresses_that_cannot_be_used_are_refused(days: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Results on one, experiment files at one, a pattern that matches nothing, a scheme that is not known."""
    with pytest.raises(OutputError, match=r"plan.toml: dataset: expected a local or mounted folder.*'s3://b/fleet'"):
        run_plan(_plan(days, ADDRESSES.format(dataset="s3://b/fleet", logs="day_1")), InProcess())
    with pytest.raises(OutputError, match=r"recordings\[0\]: experiments: expected a local"):
        run_plan(_plan(days, PLAN.format(pattern="memory://none/*.toml")), InProcess())
    pytest.importorskip("fsspec")
    with pytest.raises(ExperimentError, match=r"expected logs that match 'memory://none/\*', there is none"):
        run_plan(_plan(days, ADDRESSES.format(dataset="fleet", logs="memory://none/*")), InProcess())
    nowhere = _plan(days, ADDRESSES.format(dataset="fleet", logs="nowhere://x"))
    with pytest.raises(ExperimentError, match="expected an address that fsspec reads, got 'nowhere://x'"):
        run_plan(nowhere, InProcess())
    monkeypatch.setitem(sys.modules, "fsspec", None)
    with pytest.raises(MissingExtraError, match=r"addresses of logs need fsspec: pip install 'forcetorque\[fleet\]'"):
        run_plan(nowhere, InProcess())


def test_workers_are_at_least_one(days: Path, run: Run) -> None:
    """And none beside a cluster."""
    file = str(_plan(days, PLAN.format(pattern="*.toml")))
    assert "expected at least 1" in run("fleet", "run", file, "--workers", "0").error()
    assert "beside --dask" in run("fleet", "run", file, "--workers", "2", "--dask", "tcp://x:1").error()


@pytest.mark.long
def test_processes_give_the_same(days: Path, run: Run) -> None:
    """Two processes, the dataset of one process to the last byte of its names, and exit code 0."""
    plan = _plan(days, PLAN.format(pattern="day_*.toml"))
    run_plan(plan, InProcess())
    one = Dataset(days / "fleet").present()
    plan.write_text(plan.read_text(encoding="utf-8").replace('"fleet"', '"other"'), encoding="utf-8")
    done = run("fleet", "run", str(plan), "--workers", "2", "--format", "json")
    assert done.code == 1  # nothing to fit in recordings for validation
    assert Dataset(days / "other").present() == one


@pytest.mark.long
def test_make_and_xargs_add_at_once_and_a_kill_leaves_nothing(days: Path) -> None:
    """The lines of docs/fleet.md, in two processes at once; then one that is killed while it adds, and again."""
    program = f"{sys.executable} -m forcetorque"
    page = (Path(__file__).parents[2] / "docs" / "fleet.md").read_text(encoding="utf-8")
    (rule,) = re.findall(r"```make\n(.*?)```", page, re.DOTALL)
    (line,) = re.findall(r"    (printf .* --into fleet)\n", page)
    (days / "logs").mkdir()
    for name in ("day_1", "day_2"):
        shutil.move(days / f"{name}.toml", days / "logs")
        text = (days / "logs" / f"{name}.toml").read_text(encoding="utf-8")
        text = text.replace('"robot.urdf"', '"../robot.urdf"').replace("matrix_", "../matrix_")
        (days / "logs" / f"{name}.toml").write_text(text.replace(f'"{name}"\n', f'"../{name}"\n', 1), encoding="utf-8")
    (days / "Makefile").write_text(rule.replace("forcetorque", program), encoding="utf-8")
    subprocess.run(["make", "-j2"], cwd=days, check=True, capture_output=True)
    made = Dataset.opened(days / "fleet").present()
    assert len(made) == 2
    shutil.rmtree(days / "fleet")
    added = subprocess.Popen([*program.split(), "fleet", "add", "logs/day_1.toml", "--into", "fleet"], cwd=days)
    while added.poll() is None and not (days / "fleet").exists():
        time.sleep(0.01)
    added.kill()
    added.wait()
    subprocess.run(line.replace("forcetorque", program), shell=True, cwd=days, check=True, capture_output=True)
    assert Dataset.opened(days / "fleet").present() == made
    assert list((days / "fleet").rglob(".forcetorque-*")) == []
