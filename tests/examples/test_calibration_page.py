# SPDX-License-Identifier: BSD-3-Clause
"""What calibration.md and method.md of docs/calibration show can be typed, and comes to the figures there."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from forcetorque.experiment.experiment_file_tables import CalibrationTable

ROOT = Path(__file__).resolve().parents[2]
PAGE = "".join(
    (ROOT / "docs" / "calibration" / page).read_text(encoding="utf-8") for page in ("calibration.md", "method.md")
)
ALL = [f"{motion}{again}.toml" for motion in ("grid", "tz", "bsl", "bnsl") for again in ("", "_2")]
LAST_DIGIT = 0.51
"""Units of the last digit that a printed figure may be off, and its rounding."""


def _typed(folder: Path, *words: str) -> str:
    done = subprocess.run(
        [sys.executable, *words],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(ROOT / "src"), "COLUMNS": "200"},
        capture_output=True,
        text=True,
        check=True,
    )
    return done.stdout


def _row(title: str) -> list[str]:
    """Figures of a row of the page's table, as they are printed."""
    (line,) = [line for line in PAGE.splitlines() if line.startswith(f"| {title} |")]
    return re.findall(r"[\d.]+", line.removeprefix(f"| {title} |"))


def _agree(figures: list[str], values: list[float]) -> None:
    assert len(figures) == len(values)
    for figure, value in zip(figures, values, strict=True):
        digits = len(figure.partition(".")[2])
        assert float(figure) == pytest.approx(value, abs=LAST_DIGIT * 10.0**-digits)


def test_the_keys_of_the_page_are_those_of_the_file() -> None:
    """Its block of TOML is a valid table."""
    (block,) = (one for one in re.findall(r"```toml\n(.*?)```", PAGE, re.DOTALL) if "[calibration]" in one)
    table = CalibrationTable.model_validate(tomllib.loads(block)["calibration"])
    assert table.generative
    assert table.accuracy is not None


@pytest.mark.long
def test_the_example_with_the_truth_is_as_the_page_says(tmp_path: Path) -> None:
    """Errors on another day, and of a push that was not recorded, before, after one recording, and after eight."""
    _typed(tmp_path, "-m", "forcetorque", "simulate", "icub-insitu", "-o", "simulated")
    folder = tmp_path / "simulated"
    command = ("-m", "forcetorque", "calibrate", "--sensor", "l_leg_ft")
    shown = [_typed(folder, *command, "grid.toml", "-o", "grid.json"), _typed(folder, *command, *ALL, "-o", "all.json")]
    for said, learnt in zip(shown, re.findall(r"^    (information gained: [^;\n]*)", PAGE, re.MULTILINE), strict=True):
        assert learnt in " ".join(said.split())
    for day in ("grid_day2", "bsl_day2"):
        judged = _typed(
            folder, "-m", "forcetorque", "evaluate", f"{day}.toml", "-c", "grid.json", "-c", "all.json", "--details"
        )
        own = [line for line in judged.splitlines() if "judged-mean" in line]
        prior, _, grid, pooled = (float(line.split("±")[0].split()[-1]) for line in own)
        _agree(_row(f"`{day}`, mean taken off: force"), [prior, grid, pooled])
    (block,) = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
    printed = [
        [float(value) for value in re.findall(r" ([\d.]+)", line)] for line in _typed(folder, "-c", block).splitlines()
    ]
    before, grid_push, (grid_share,), _, all_push, (all_share,) = printed
    _agree(_row("push of 50 N, not recorded: force"), [before[0], grid_push[0], all_push[0]])
    _agree(_row("the same: moment"), [before[1], grid_push[1], all_push[1]])
    _agree(_row("errors of the push within their 95 % interval"), [100.0 * grid_share, 100.0 * all_share])
