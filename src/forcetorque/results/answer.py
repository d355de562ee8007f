# SPDX-License-Identifier: BSD-3-Clause
"""The answer of an analysis in a few lines: what it is about, the verdict or number, why, and what to do next."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import IntEnum
from typing import Final

from forcetorque.results.table_rendering import shortened, wrapped

EXPERIMENT: Final = "{experiment}"
"""Stands in a command for the experiment files that were typed."""
_INDENT = "  "
_MOST_WARNINGS = 3
"""Warnings that are shown below an answer; the others are counted."""


class Concern(IntEnum):
    """How much an answer asks for attention; several are sorted by it."""

    NONE = 0
    """All is as it should be."""
    UNCERTAIN = 1
    """Something is lacking or doubtful."""
    BAD = 2
    """Who goes on would be misled."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Answer:
    """The answer about one sensor or one thing."""

    subject: str
    """What it is about, such as `r_leg_ft_sensor (SN026), r.json`."""
    verdict: str
    """The verdict in capitals, or the number with its interval."""
    why: tuple[str, ...] = ()
    """At most two sentences."""
    step: str = ""
    """What to do next; empty where nothing is to be done."""
    command: str = ""
    """The command that does it, without the name of the program; `EXPERIMENT` stands for the files that were typed."""
    concern: Concern = Concern.NONE
    """How much it asks for attention."""


def answer_text(answers: Sequence[Answer], width: int, experiment: str = "EXPERIMENT.toml") -> str:
    """Write answers for people: a line for each, the worst first, and why and what next for the worst.

    Args:
        answers: At least one.
        width: Characters of a line.
        experiment: What stands for the experiment files in commands.

    Returns:
        Lines, each with its end.
    """
    ordered = sorted(answers, key=lambda answer: -answer.concern)
    return "".join(f"{line}\n" for line in _lines(ordered, width, experiment))


def _lines(answers: Sequence[Answer], width: int, experiment: str) -> Iterator[str]:
    for answer in answers:
        yield _headline(answer, width)
        if answer is answers[0]:
            for sentence in answer.why:
                yield _indented(sentence, width)
    worst = answers[0]
    if worst.step:
        yield wrapped(f"next: {worst.step}", width)
    if worst.command:
        yield f"{_INDENT}forcetorque {worst.command.replace(EXPERIMENT, experiment)}"


def _headline(answer: Answer, width: int) -> str:
    """Subject to the left, verdict to the right; below it where there is no room."""
    gap = width - len(answer.subject) - len(answer.verdict)
    if gap >= 2:
        return f"{answer.subject}{' ' * gap}{answer.verdict}"
    return f"{answer.subject}\n{_INDENT}{answer.verdict}"


def _indented(sentence: str, width: int) -> str:
    return "\n".join(f"{_INDENT}{line}" for line in wrapped(sentence, width - len(_INDENT)).splitlines())


def warnings_text(sentences: Sequence[str], width: int) -> str:
    """Count warnings and show the first of them, each in one line.

    Args:
        sentences: The warnings, the worst first.
        width: Characters of a line.

    Returns:
        Lines, each with its end; empty without warnings.
    """
    if not sentences:
        return ""
    shown = [f"{_INDENT}{shortened(sentence, width - len(_INDENT))}" for sentence in sentences[:_MOST_WARNINGS]]
    more = len(sentences) - len(shown)
    rest = f", {len(shown)} shown" if more else ""
    return "\n".join([f"{len(sentences)} warning{'s' * (len(sentences) > 1)}{rest}:", *shown]) + "\n"
