# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque robot balance` on vertical forces and on wrenches: tables, files, pictures, refusals."""

from __future__ import annotations

from pathlib import Path

import pyarrow.parquet as pq
import pytest

from tests.app.json_schema import faults
from tests.app.outcome import Run
from tests.locomotion.foot_forces import write_foot_forces


@pytest.fixture
def feet(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The file of vertical forces; its folder is the working folder."""
    monkeypatch.chdir(tmp_path)
    return write_foot_forces(tmp_path).relative_to(tmp_path)


def test_phases_samples_and_a_figure(feet: Path, run: Run) -> None:
    """Both feet, the left, both; each sample in the file; what is not told is said."""
    words = ("robot", "balance", feet, "--touch", "50N", "--release", "20N")
    shown = run(*words, "-o", "samples.parquet", "--figure", "feet.png", "--format", "json")
    assert shown.code == 0
    result = shown.result()
    assert faults(result, run("schema", "balance").result()) == []
    assert [(row["phase"], row["intervals"]) for row in result["phases"]] == [("l_sole + r_sole", 2), ("l_sole", 1)]
    assert all(abs(row["from_weight_N"]) < 1.0 for row in result["phases"])
    assert "centre of pressure and zero moment point: only the vertical forces" in shown.err
    table = pq.read_table("samples.parquet")
    assert table.num_rows == 600
    assert {"force.l_sole", "share.r_sole", "down.r_sole", "net_force"} <= set(table.column_names)
    assert Path("feet.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--touch", "20N", "--release", "50N"), "cross"),
        (("--touch", "50"), "--touch: force: expected newtons such as 50N, or a share of body weight as 15%, got '50'"),
        (("--touch", "5000N"), "no support phase found: expected a foot that bears 5e+03 N"),
        (("-o", "samples.txt"), "expected a name that ends in .parquet or .csv"),
    ],
)
def test_bad_input_is_one_line(feet: Path, run: Run, words: tuple[str, ...], message: str) -> None:
    """Thresholds that cross or have no unit, no phase, a file of no known form."""
    refused = run("robot", "balance", feet, *words)
    assert refused.code == 2
    assert message in refused.err.splitlines()[-1]
    assert not Path("samples.txt").exists()


@pytest.mark.parametrize("key", ["friction", "torsional_friction_m"])
def test_a_friction_beside_a_vertical_force_is_refused(feet: Path, run: Run, key: str) -> None:
    """A vertical force alone shows no slip, so that the limit would do nothing."""
    feet.write_text(
        feet.read_text(encoding="utf-8").replace('stream = "feet_r"', f'stream = "feet_r"\n{key} = 0.5'),
        encoding="utf-8",
    )
    refused = run("robot", "balance", feet)
    assert refused.code == 2
    assert f"sole[1]: expected {key} of a sole whose force and moment a sensor measures, got stream" in refused.err


def test_a_file_without_soles_is_told_what_to_state(feet: Path, run: Run) -> None:
    """Without [[sole]] nobody knows what the robot stands on."""
    text = feet.read_text(encoding="utf-8")
    first, last = text.index("[[sole]]"), text.index("[[interval]]")
    feet.write_text(text[:first] + text[last:], encoding="utf-8")
    refused = run("robot", "balance", feet)
    assert refused.code == 2
    assert "sole" in refused.err or "sensor" in refused.err
