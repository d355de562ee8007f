# SPDX-License-Identifier: BSD-3-Clause
"""Calibration files from before there were variables are read by every command, with the same results."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from forcetorque.calibration.export.formats import ExportFormat
from tests.app.outcome import Outcome, Run
from tests.scenes.experiments import PARQUET, YARP

OLD, NEW = "forcetorque/calibration/1", "forcetorque/calibration/3"
ADDED = ("variables", "estimation_type", "raw_offset_counts")
"""Keys that version 1 did not have."""


@pytest.fixture
def files(arm: Path) -> tuple[str, str]:
    """Names, of one length, of a file of today and of the same calibration as it was written before."""
    content = json.loads((arm / "fitted.json").read_text(encoding="utf-8"))
    assert content["schema"] == NEW
    (arm / "new.json").write_text(json.dumps(content), encoding="utf-8")
    old = {key: value for key, value in content.items() if key not in ADDED} | {"schema": OLD}
    assert len(old) == len(content) - len(ADDED)
    (arm / "old.json").write_text(json.dumps(old), encoding="utf-8")
    return "new.json", "old.json"


def _same(new: Outcome, old: Outcome) -> bool:
    assert (new.code, old.code) == (0, 0), old.err
    return new.out == old.out.replace("old.json", "new.json") and new.err == old.err.replace("old.json", "new.json")


@pytest.mark.parametrize("output_format", ["json", "csv", "table"])
@pytest.mark.parametrize("form", [PARQUET, YARP])
@pytest.mark.parametrize("command", ["evaluate", "estimate", "bench gains"])
def test_what_is_measured_with_them_is_the_same(
    run: Run, files: tuple[str, str], form: str, command: str, output_format: str
) -> None:
    """Verdicts, estimates and resolutions are those of the same calibration in today's form."""
    rest = ("-o", "out.csv") if command == "estimate" else ()
    new, old = (run(*command.split(), form, "-c", file, *rest, "--format", output_format) for file in files)
    assert _same(new, old)


@pytest.mark.parametrize("to", [to for to in ExportFormat if to is not ExportFormat.COEFFICIENTS])
def test_what_is_exported_of_them_is_the_same(run: Run, files: tuple[str, str], to: ExportFormat) -> None:
    """The written files agree byte by byte."""
    written = []
    for file in files:
        done = run("export", file, "--to", to.value, "-o", "out.file", "--force", "--format", "json")
        written.append((Path("out.file").read_bytes(), done))
    (first, new), (second, old) = written
    assert first == second
    assert _same(new, old)


def test_they_say_what_a_stream_is_made_with(run: Run, files: tuple[str, str]) -> None:
    """A stream of the same calibration needs no correction, told by either file."""
    for made in files:
        for stream in files:
            words = ("export", made, "--to", "wholebodydynamics", "-o", "ft.xml", "--stream", stream)
            (entry,) = run(*words, "--format", "json").result()["calibrations"]
            identity = [[float(i == k) for k in range(6)] for i in range(6)]
            for row, expected in zip(entry["matrix"], identity, strict=True):
                assert row == pytest.approx(expected, abs=1e-9)
            assert entry["offset"] == pytest.approx([0.0] * 6, abs=1e-9)


def test_they_have_no_coefficients(run: Run, files: tuple[str, str]) -> None:
    """The refusal is the same as for a calibration without variables in today's form."""
    errors = [run("export", file, "--to", "coefficients", "-o", "out.csv").error() for file in files]
    assert errors == ["error: out.csv: expected a calibration with a linear variable such as temperature, got none"] * 2


def test_a_form_that_never_was_is_refused(arm: Path, run: Run, files: tuple[str, str]) -> None:
    """Negative control: the schema is looked at."""
    text = (arm / "old.json").read_text(encoding="utf-8")
    (arm / "old.json").write_text(text.replace(OLD, "forcetorque/calibration/0"), encoding="utf-8")
    error = run("evaluate", PARQUET, "-c", "old.json").error()
    assert error.startswith(f"error: old.json: expected the schema '{NEW}', got 'forcetorque/calibration/0'; fit again")
