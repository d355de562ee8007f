# SPDX-License-Identifier: BSD-3-Clause
"""What `forcetorque study fits` refuses: one line says why, and no folder, not even a temporary one, is left behind."""

from __future__ import annotations

from pathlib import Path

import pytest

from forcetorque.base.errors import ForceTorqueError
from forcetorque.study.study import SensorStudy
from tests.app.outcome import Run
from tests.cases import some_cases
from tests.scenes.experiments import PARQUET, edit, snapshot
from tests.scenes.studies import CALIBRATION, FILES, SERIAL, VALIDATION

QUICK = ("--type", "OnTdTO", "--type", "OwTrTO", "--lambda", "0", "--lambda", "100")
TABLES_AND_CALIBRATIONS = 7 + 4


@some_cases(
    ("words", "message"),
    [
        (("--data-set", "grid"), "--data-set: expected NAME=LABEL,LABEL with labels or kinds, got 'grid'"),
        (("--data-set", "=grid"), "--data-set: expected NAME=LABEL,LABEL"),
        (("--data-set", "a= ,"), "--data-set: expected NAME=LABEL,LABEL"),
        (("--data-set", "a=grid", "--data-set", "a =random"), "--data-set: the name 'a' comes twice"),
        (("--data-set", "a=gird"), "data set 'a': no calibration interval or kind is called 'gird'; did you mean"),
        (("--data-set", "a=day_1"), "no calibration interval or kind is called 'day_1'"),
        (("--type", "OwTr"), "no estimation type is called 'OwTr'; did you mean \"OwTrTO\"?"),
        (("--lambda", "-1"), "--lambda: expected numbers of at least 0 counts2, got [-1.0]"),
        (("--lambda", "nan"), "--lambda: expected numbers of at least 0 counts2, got [nan]"),
        (("--lambda", "inf", "--lambda", "1"), "--lambda: expected numbers of at least 0 counts2, got [1.0, inf]"),
        (("--sensor", "arm_tf"), "grid_cold.toml: experiment 'arm grid_cold' has no sensor 'arm_tf'; did you mean"),
        (("--sphere", "grid_cod"), "sphere: no calibration interval is called 'grid_cod'; did you mean"),
        (
            ("--type", "SnTdTO"),
            "error: sensor 'arm_ft': nothing can be fitted; grid SnTdTO: sphere offset: name the data sets that draw",
        ),
    ],
    quick=11,
)
def test_options_that_are_refused(days: Path, run: Run, words: tuple[str, ...], message: str) -> None:
    """One line that says which option or name; no folder, not even those above it, and no temporary file is left."""
    before = snapshot(days)
    assert message in run("study", "fits", *FILES, *words, "-o", "deep/down/out").error()
    assert snapshot(days) == before


@some_cases(
    ("files", "message"),
    [
        ((*FILES, "absent.toml"), "absent.toml"),
        (VALIDATION, 'expected at least one interval with use = "calibration", got none'),
        ((*FILES, "day_1.toml"), "day_1.toml: expected every experiment file once, it comes twice"),
        (CALIBRATION, 'expected at least one interval with use = "validation", got none'),
    ],
    quick=3,
)
def test_files_that_are_refused(days: Path, run: Run, files: tuple[str, ...], message: str) -> None:
    """Missing, of one use only, or given twice."""
    before = snapshot(days)
    assert message in run("study", "fits", *files, "-o", "out").error()
    assert snapshot(days) == before


def test_another_sensor_is_refused_with_both_files(days: Path, run: Run) -> None:
    """The line on standard error names the file, the first file, and the two numbers."""
    edit(days / "day_2.toml", f'serial = "{SERIAL}"', 'serial = "SIM002"')
    error = run("study", "fits", *FILES, "-o", "out").error()
    assert "day_2.toml: sensor 'arm_ft': expected the serial number of grid_cold.toml, SIM001, got SIM002" in error


def test_too_many_kinds_are_refused(arm: Path, run: Run) -> None:
    """Seven intervals without a kind; the message says how to go on."""
    (fit,) = [block for block in (arm / PARQUET).read_text(encoding="utf-8").split("[[interval]]") if '"fit"' in block]
    several = [
        fit.replace('"fit"', f'"fit_{k}"').replace("0.5", f"{0.5 + k}").replace("14.0", f"{1.5 + k}") for k in range(7)
    ]
    edit(arm / PARQUET, fit, "[[interval]]".join(several))
    error = run("study", "fits", PARQUET, "-o", "out").error()
    assert "at most 6 kinds of data to try every combination, got 7: fit_0, fit_1" in error
    assert "name combinations with --data-set" in error


def test_a_folder_that_is_there_is_refused_before_any_work(days: Path, run: Run) -> None:
    """Whatever is in it stays, and nothing is read."""
    Path("out").mkdir()
    (Path("out") / "mine.txt").write_text("mine", encoding="utf-8")
    done = run("study", "fits", *FILES, "-o", "out")
    assert done.error() == "error: --output out: expected a new folder, it is there already"
    assert done.log == []
    assert [path.name for path in Path("out").iterdir()] == ["mine.txt"]


@pytest.mark.long
def test_an_error_at_the_very_end_leaves_nothing_behind(days: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """Tables and calibrations of a study that broke off are not there; folders that were, are."""

    def broken(made: SensorStudy, folder: Path, progress: object) -> list[str]:
        assert len(list(folder.iterdir())) == TABLES_AND_CALIBRATIONS
        raise ForceTorqueError("the figures cannot be drawn")

    monkeypatch.setattr("forcetorque.study.study_folder.write_figures", broken)
    Path("mine").mkdir()
    before = snapshot(days)
    for output in ("out", "new/er/out", "mine/out"):
        few = ("move_cold.toml", *VALIDATION, *QUICK)
        assert run("study", "fits", *few, "-o", output).error() == "error: the figures cannot be drawn"
        assert snapshot(days) == before
