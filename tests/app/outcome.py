# SPDX-License-Identifier: BSD-3-Clause
"""A command that runs in this process, and what it left behind: exit code, result and messages."""

from __future__ import annotations

import csv
import io
import json
import logging
import signal
import sys
from collections.abc import Callable
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from typing import Any

import pytest

from forcetorque.app.command_line import main


@dataclass(frozen=True)
class Outcome:
    """The end of one run of the command line."""

    code: int
    out: str
    err: str

    @property
    def log(self) -> list[str]:
        """Lines on standard error that are no error."""
        return [line for line in self.err.splitlines() if line.startswith(("INFO: ", "WARNING: "))]

    def result(self) -> Any:
        """Give the JSON on standard output of a run that went well."""
        assert self.code == 0, self.err
        return json.loads(self.out)

    def rows(self) -> list[dict[str, str]]:
        """Give the rows of the CSV on standard output of a run that went well, all as long as the header."""
        assert self.code == 0, self.err
        header, *rows = csv.reader(io.StringIO(self.out, newline=""), strict=True)
        assert len(set(header)) == len(header)
        assert {len(row) for row in rows} == {len(header)}
        return [dict(zip(header, row, strict=True)) for row in rows]

    def error(self) -> str:
        """Give the one line of a run that was refused: nothing on standard output, the log, then the error."""
        assert (self.code, self.out) == (2, "")
        *log, error = self.err.splitlines()
        assert log == self.log
        assert error.startswith("error: ")
        assert self.err.endswith("\n")
        return error


Run = Callable[..., Outcome]
"""Runs the command line in this process with the given words."""


def typed(*words: object, columns: int = 120) -> Outcome:
    """Run `forcetorque` with words as typed in a shell.

    Args:
        words: What follows the name of the program.
        columns: Width of the terminal.

    Returns:
        What it left.
    """
    out, err = (io.TextIOWrapper(io.BytesIO(), encoding="utf-8", newline="") for _ in range(2))
    with pytest.MonkeyPatch.context() as patch, redirect_stdout(out), redirect_stderr(err):
        # the handler of an earlier run writes to what standard error was then
        patch.setattr(logging.getLogger("forcetorque"), "handlers", [])
        patch.setattr(sys, "argv", ["forcetorque", *map(str, words)])
        patch.setenv("COLUMNS", str(columns))
        with pytest.raises(SystemExit) as stop:
            main()
    code = stop.value.code
    return Outcome(code=code if isinstance(code, int) else 0, out=_written(out), err=_written(err))


def _written(stream: io.TextIOWrapper) -> str:
    stream.seek(0)
    return stream.read()


def heed_interrupts() -> None:
    """Let a process that is begun heed Ctrl-C, which a shell has what runs in the background ignore."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
