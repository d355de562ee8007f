# SPDX-License-Identifier: BSD-3-Clause
"""The program as a shell starts it: exit code, standard output, standard error."""

from __future__ import annotations

import json
import logging
import os
import subprocess
import sys
from pathlib import Path

import pytest

from forcetorque.results.result import Result
from forcetorque.results.terminal.command_output import Format, show
from tests.app.outcome import Outcome, Run
from tests.scenes.experiments import PARQUET, YARP, edit, snapshot

_KEPT = ("PYTHONPATH", "HOME")
_PATHS = {name: value for name, value in os.environ.items() if name in _KEPT or name.startswith("OPENBLAS_")}
"""Where an interpreter finds the library and its compiled code."""


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


@pytest.mark.long
def test_an_error_is_one_line_and_exit_code_2(arm: Path) -> None:
    """No traceback, nothing on standard output, no file."""
    edit(arm / PARQUET, 'frame = "base"', 'frame = "bse"')
    before = snapshot(arm)
    error = _start("-m", "forcetorque", "calibrate", PARQUET, "-o", "made.json").error()
    assert error.startswith(f"error: {PARQUET}: support[0]: robot 'arm' has no link 'bse'; did you mean \"base\"?")
    assert snapshot(arm) == before


def test_the_parser_needs_nothing_scientific() -> None:
    """Help and version answer at once, because what computes is imported when a command runs."""
    heavy = "{'numpy', 'scipy', 'pyarrow', 'pydantic'}"
    code = f"import sys, forcetorque.app.command_line; print(sorted({heavy} & set(sys.modules)))"
    assert _start("-c", code) == Outcome(code=0, out="[]\n", err="")


_FORMS = ("table", "csv", "json")
_IN_EVERY_FORM = f"""
import sys
from forcetorque.app.command_line import main
for form in {_FORMS}:
    sys.argv = ["forcetorque", *sys.argv[1:7], form]
    try:
        main()
    except SystemExit as ended:
        assert ended.code in (0, None), ended.code
    print("end of form")
"""


@pytest.mark.long
def test_a_terminal_without_letters_gets_them_spelled(arm: Path, run: Run) -> None:
    """Under `LC_ALL=C` without UTF-8 mode: numbers with their errors in plain letters, as many as elsewhere."""
    plain = {"LC_ALL": "C", "PYTHONCOERCECLOCALE": "0", "PYTHONUTF8": "0", "COLUMNS": "120", "PATH": os.environ["PATH"]}
    words = ("evaluate", PARQUET, "-c", "fitted.json", "--details", "--format")
    shown = subprocess.run(
        [sys.executable, "-c", _IN_EVERY_FORM, *words], capture_output=True, check=False, env={**plain, **_PATHS}
    )
    assert (shown.returncode, b"Traceback" in shown.stderr) == (0, False)
    whole = "".join(f"{run(*words, form).out}end of form\n" for form in _FORMS)
    assert shown.stdout.decode("ascii") == whole.replace("±", "+-").replace("─", "-")
    assert [b"+-" in form for form in shown.stdout.split(b"end of form\n")] == [True, False, False, False]


@pytest.mark.long
def test_a_name_that_is_no_text_is_one_line(arm: Path) -> None:
    """The name of a file may hold bytes of another encoding; the error still says it."""
    ended = subprocess.run(
        [sys.executable.encode(), b"-m", b"forcetorque", b"evaluate", b"caf\xe9.toml", b"-c", b"fitted.json"],
        capture_output=True,
        check=False,
    )
    assert ended.returncode == 2
    assert ended.stderr.decode("utf-8").splitlines()[-1].startswith("error: caf\\xdce9.toml: ")


def test_a_warning_is_said_once(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    """However often it comes; how often is said."""
    monkeypatch.setattr(logging.getLogger("forcetorque"), "handlers", [])
    show(Result(warnings=("left out: torque of knee",) * 222 + ("it flatters",)), Format.TABLE)
    assert capsys.readouterr().err.splitlines() == [
        "WARNING: left out: torque of knee (222 times)",
        "WARNING: it flatters",
    ]


def test_rows_of_different_length_make_one_csv(capsys: pytest.CaptureFixture[str]) -> None:
    """Sensors with six and with eight channels share a header; what a row does not have is empty."""

    class Channels(Result):
        """Channels of two sensors."""

        def records(self) -> list[dict[str, object]]:
            return [{"sensor": "a", "c0": 1.5}, {"sensor": "b", "c0": 2, "c1": 3}]

    show(Channels(), Format.CSV)
    assert capsys.readouterr().out == "sensor,c0,c1\na,1.5,\nb,2,3\n"
