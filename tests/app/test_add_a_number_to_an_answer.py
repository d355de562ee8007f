# SPDX-License-Identifier: BSD-3-Clause
"""A number of an answer is one field and its value: table, JSON, CSV, page and schema have it from then on.

This is the recipe of docs/architecture.md, followed with the answer of `tests/toys/command`.
"""

from __future__ import annotations

import shutil
from importlib import import_module
from pathlib import Path

import pytest

from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from tests.app.added_command import NAME, TOY, added_command
from tests.app.outcome import Run
from tests.scenes.experiments import PARQUET, edit

FIELD = '    samples: Annotated[int, Shown("readings")]\n    """Number of its samples."""\n'
VALUE = "        samples=len(stamps),\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """The toy's files with the field below its neighbour, and its value."""
    folder = Path(shutil.copytree(TOY, tmp_path / "toy", ignore=shutil.ignore_patterns("__pycache__")))
    file = folder / NAME / "extents.py"
    above = '    """From its first to its last sample; s."""\n'
    edit(file, above, above + FIELD)
    value = "        duration_s=float(stamps[-1] - stamps[0]) * 1e-9,\n"
    edit(file, value, value + VALUE)
    return folder


def test_every_form_of_the_answer_has_it(run: Run, arm: Path, folder: Path) -> None:
    """Under its key where programs read, under its heading where people do."""
    with added_command(folder):
        extents = import_module(f"forcetorque.{NAME}.extents")
        (row,) = run(NAME, PARQUET, "--format", "json").result()["sensors"]
        assert row["samples"] == 1200
        assert [line["samples"] for line in run(NAME, PARQUET, "--format", "csv").rows()] == ["1200"]
        _, _, heading, _, line, *_ = run(NAME, PARQUET).out.splitlines()
        assert "readings" in heading
        assert "1200" in line
        assert '"samples": {' in run("schema", NAME).out
        content = load_experiment(arm / PARQUET)
        page = extents.sensor_extent(SensorRun(content, "arm_ft"))._repr_html_()
        assert "readings" in page


def test_without_the_field_no_form_has_it(run: Run, arm: Path) -> None:
    """Negative control."""
    with added_command():
        forms = [run(NAME, PARQUET, "--format", form).out for form in ("json", "csv", "table")]
        assert not any("samples" in text or "readings" in text for text in forms)
