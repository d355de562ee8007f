# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque bench workbench` as it is typed."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.experiment.calibration.calibration_file import read_calibration
from forcetorque.workbench.simulated_benches import BenchFaults
from tests.app.outcome import Run
from tests.scenes.benches import write_bench


@pytest.fixture
def bench(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a sensor that is recorded, and one that is not yet."""
    write_bench(tmp_path, serial="SIM001", faults=BenchFaults(swapped=(3, 8)))
    write_bench(tmp_path, serial="SIM002", seed=2, positions=2)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.long
def test_it_writes_a_calibration_and_a_figure_and_reports_the_fault(run: Run, bench: Path) -> None:
    """Which export then takes as any other."""
    outcome = run("bench", "workbench", "SIM001.toml", "-o", "new.json", "--figure", "bench.png")
    assert outcome.code == 0
    assert "SIM001: positions 4 and 9 are swapped" in outcome.out
    assert "1 fault(s) of the bench are detected" in outcome.err
    blocks, fault = read_calibration("new.json").warnings[:2], read_calibration("new.json").warnings[2]
    assert all("the measurement matches position" in message for message in blocks)
    assert fault == "SIM001: positions 4 and 9 are swapped"
    assert (bench / "bench.png").read_bytes().startswith(b"\x89PNG")
    assert run("export", "new.json", "--to", "icub-matrix", "-o", "matrix_SIM001.txt").code == 0


def test_it_names_the_next_position(run: Run, bench: Path) -> None:
    """Without fitting anything; as JSON too."""
    outcome = run("bench", "workbench", "SIM002.toml", "--next")
    assert (outcome.code, outcome.err) == (0, "")
    assert "\nnext: record position 3 " in outcome.out
    result = run("bench", "workbench", "SIM002.toml", "--next", "--format", "json").result()
    assert result["sensors"] == []
    assert len(result["blocks_checked"]) == 2


@pytest.mark.long
def test_several_sensors_are_compared(run: Run, bench: Path) -> None:
    """A row each; one file holds one calibration."""
    write_bench(bench, serial="SIM003", seed=3)
    outcome = run("bench", "workbench", "SIM001.toml", "SIM003.toml", "--format", "csv")
    assert outcome.code == 0
    assert len(outcome.out.splitlines()) == 3
    refused = run("bench", "workbench", "SIM001.toml", "SIM003.toml", "-o", "new.json")
    assert refused.code == 2
    assert "a file holds one calibration" in refused.err


@pytest.mark.long
def test_a_limit_that_fails_is_exit_code_1(run: Run, bench: Path) -> None:
    """No fault is allowed, and one is detected."""
    (bench / "limits.toml").write_text(
        'schema = "forcetorque/acceptance/1"\nname = "bench"\n[workbench]\nfaults = 0\n', encoding="utf-8"
    )
    outcome = run("bench", "workbench", "SIM001.toml", "--spec", "limits.toml", "--details")
    assert outcome.code == 1
    assert "workbench.faults" in outcome.out


@pytest.fixture
def plate(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> FloatArray:
    """The workbench file of docs/workbench.md; known wrenches of its table, shape (40, 6); N, N m."""
    monkeypatch.chdir(tmp_path)
    page = (Path(__file__).parents[2] / "docs" / "workbench.md").read_text(encoding="utf-8")
    file = re.search(r"```toml\n(# plate\.toml\n.*?)```", page, re.DOTALL)
    assert file is not None
    Path("plate.toml").write_text(file[1], encoding="utf-8")
    return np.random.default_rng(1).uniform(-20.0, 20.0, (40, 6)) * [1, 1, 1, 0.1, 0.1, 0.1]


def _write_readings(known: FloatArray) -> None:
    components = ("Fx", "Fy", "Fz", "Mx", "My", "Mz")
    head = ",".join([*components, *(f"known_{name}" for name in components)])
    readings = 1.1 * np.nan_to_num(known) + 0.01 * np.random.default_rng(2).normal(size=known.shape)
    np.savetxt("readings.csv", np.hstack([readings, known]), delimiter=",", header=head, comments="")


def test_the_file_of_a_table_with_applied_wrenches_is_that_of_the_page(run: Run, plate: FloatArray) -> None:
    """As docs/workbench.md has it, with a table of those columns; the table alone is refused by what it should be."""
    _write_readings(plate)
    assert "next: fit them: the same command without --next" in run("bench", "workbench", "plate.toml", "--next").out
    assert "FITTED, NO FAULT OF THE BENCH" in run("bench", "workbench", "plate.toml", "-o", "plate.json").out
    refused = run("bench", "workbench", "readings.csv", "-o", "x.json").error()
    assert "expected a workbench file (TOML), which names" in refused
    assert "got the table; docs/workbench.md" in refused


def test_unknown_loads_are_the_first_reason_of_no_matrix(run: Run, plate: FloatArray) -> None:
    """Of the positions that load one direction; what to load is named, and the exit code is 1."""
    plate[:20, 2] = 0.0
    plate[20:] = np.nan
    _write_readings(plate)
    outcome = run("bench", "workbench", "plate.toml")
    reasons = " ".join(outcome.out.split())
    assert (outcome.code, "NO MATRIX" in reasons) == (1, True)
    assert reasons.index("20 of 40 positions are not used") < reasons.index("not fz; without")
    assert "give prior, or load fz" in reasons
    assert "no position loads" not in reasons
