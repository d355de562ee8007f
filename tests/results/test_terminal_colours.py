# SPDX-License-Identifier: BSD-3-Clause
"""A terminal shows the word of a verdict in the colour of its concern; nothing else has a colour."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Iterator
from contextlib import suppress

import pytest

from forcetorque.results.answer import Answer, Concern
from forcetorque.results.result import Result
from forcetorque.results.terminal.command_output import Format, show

pty = pytest.importorskip("pty", reason="this system has no pseudo-terminals")

ANSWERS = (
    Answer(subject="r_leg_ft", verdict="DO NOT USE for standing", why=("the error is 20 N",), concern=Concern.BAD),
    Answer(subject="arm_ft", verdict="0.12 N, NOTHING LOST", concern=Concern.UNCERTAIN),
    Answer(subject="l_leg_ft", verdict="USE"),
    Answer(subject="tool", verdict="1.20 kg"),
    Answer(subject="a log", verdict="2000 samples of LEFT FT"),
    Answer(subject="patch", verdict="12 OF 16 TAXELS HAVE A CURVE", concern=Concern.BAD),
)


class _Checked(Result):
    def answers(self) -> Iterator[Answer]:
        yield from ANSWERS


@pytest.fixture
def environment(monkeypatch: pytest.MonkeyPatch) -> pytest.MonkeyPatch:
    """A terminal of 40 characters that knows colours."""
    monkeypatch.setenv("COLUMNS", "40")
    monkeypatch.setenv("TERM", "xterm-256color")
    monkeypatch.delenv("NO_COLOR", raising=False)
    return monkeypatch


def _shown(monkeypatch: pytest.MonkeyPatch, *, terminal: bool) -> str:
    """What the command line prints on a pseudo-terminal, or into a pipe."""
    reader, writer = pty.openpty() if terminal else os.pipe()
    with os.fdopen(writer, "w", encoding="utf-8") as stream, monkeypatch.context() as patched:
        patched.setattr(sys, "stdout", stream)
        show(_Checked(), Format.TABLE)
    text = b""
    with suppress(OSError):  # a terminal whose other end is closed
        while piece := os.read(reader, 65536):
            text += piece
    os.close(reader)
    return text.decode().replace("\r\n", "\n")


def test_each_verdict_has_its_colour_on_a_terminal(environment: pytest.MonkeyPatch) -> None:
    """Red, yellow and green, the worst first; numbers and names have none, and the text is that of a pipe."""
    text = _shown(environment, terminal=True)
    assert re.findall(r"\033\[1;(\d+)m([^\033]*)\033\[0m", text) == [
        ("31", "DO NOT USE"),
        ("31", "12 OF 16 TAXELS HAVE A CURVE"),
        ("33", "NOTHING LOST"),
        ("32", "USE"),
    ]
    assert text.count("\033") == 8
    assert re.sub(r"\033\[[\d;]*m", "", text) == _shown(environment, terminal=False)


@pytest.mark.parametrize("variable", ["NO_COLOR=1", "TERM=dumb"])
def test_no_colour_where_none_is_wanted(environment: pytest.MonkeyPatch, variable: str) -> None:
    """By the variable NO_COLOR, and on a terminal without colours."""
    environment.setenv(*variable.split("="))
    assert "\033" not in _shown(environment, terminal=True)


def test_an_empty_variable_forbids_nothing(environment: pytest.MonkeyPatch) -> None:
    """As no-color.org has it."""
    environment.setenv("NO_COLOR", "")
    assert "\033" in _shown(environment, terminal=True)


def test_a_pipe_has_no_colour(environment: pytest.MonkeyPatch) -> None:
    """What reads it would have to remove them."""
    assert "\033" not in _shown(environment, terminal=False)
