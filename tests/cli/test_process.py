# SPDX-License-Identifier: BSD-3-Clause
"""The program as a shell starts it: exit code, standard output, standard error."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from forcetorque.cli.output import Format, print_result
from tests.cli.outcome import Outcome
from tests.experiments import PARQUET, YARP, edit, snapshot


def _start(*words: str) -> Outcome:
    ended = subprocess.run(
        [sys.executable, "-W", "error", *words], capture_output=True, text=True, encoding="utf-8", check=False
    )
    return Outcome(code=ended.returncode, out=ended.stdout, err=ended.stderr)


def test_a_result_goes_to_standard_output_alone(arm: Path) -> None:
    """Standard output is the JSON and nothing but; the log is on standard error; the exit code is 0."""
    ended = _start("-m", "forcetorque", "calibrate", YARP, "-o", "made.json", "--format", "json")
    assert ended.result()["calibrations"][0]["file"] == "made.json"
    assert ended.err.splitlines() == ended.log
    assert ended.log[0] == f"INFO: reading {YARP}"
    assert json.loads(Path("made.json").read_text(encoding="utf-8"))["sensor"]["serial"] == "SIM001"


def test_an_error_is_one_line_and_exit_code_2(arm: Path) -> None:
    """No traceback, nothing on standard output, no file."""
    edit(arm / PARQUET, 'frame = "base"', 'frame = "bse"')
    before = snapshot(arm)
    error = _start("-m", "forcetorque", "calibrate", PARQUET, "-o", "made.json").error()
    assert error.startswith(f"error: {PARQUET}: support[0]: robot 'arm' has no link 'bse'; did you mean \"base\"?")
    assert snapshot(arm) == before


def test_the_parser_needs_nothing_scientific() -> None:
    """Help and version answer at once, because what computes is imported when a command runs."""
    code = "import sys, forcetorque.cli; print(sorted({'numpy', 'scipy', 'pyarrow', 'pydantic'} & set(sys.modules)))"
    assert _start("-c", code) == Outcome(code=0, out="[]\n", err="")


def test_rows_of_different_length_make_one_csv(capsys: pytest.CaptureFixture[str]) -> None:
    """Sensors with six and with eight channels share a header; what a row does not have is empty."""
    rows: list[dict[str, object]] = [{"sensor": "a", "c0": 1.5}, {"sensor": "b", "c0": 2, "c1": 3}]
    print_result({}, rows, Format.CSV, show=lambda: None)
    assert capsys.readouterr().out == "sensor,c0,c1\na,1.5,\nb,2,3\n"
