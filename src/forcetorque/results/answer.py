# SPDX-License-Identifier: BSD-3-Clause
"""The answer of an analysis in a few lines: what it is about, the verdict or number, why, and what to do next."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import IntEnum
from typing import Final

from forcetorque.results.table_rendering import shortened, wrapped
from forcetorque.results.visual_roles import TERMINAL

EXPERIMENT: Final = "{experiment}"
"""Stands in a command for the experiment files that were typed."""
FIRST_EXPERIMENT: Final = "{first experiment}"
"""Stands in a command that takes one experiment file for the first of them."""
AGAIN: Final = "{again}"
"""A command that stands for the one that was typed, with all its options; from Python there is none."""
_ANY = "EXPERIMENT.toml"
MOST_LINES: Final = 12
"""Lines of the answer about one sensor or one thing at 80 characters, warnings included; a further one adds a line."""
STANDARD_WIDTH: Final = 80
"""Characters of a line from which on an answer has no more lines than that."""
_INDENT = "  "
_MOST_WARNINGS = 3
"""Warnings that are shown below an answer where there is room; the others are counted."""
_CONTINUED = " \\"
"""Ends a line of a command that goes on in the next one; a shell reads it so too."""


class Concern(IntEnum):
    """How much an answer asks for attention; several are sorted by it."""

    NONE = 0
    """All is as it should be."""
    UNCERTAIN = 1
    """Something is lacking or doubtful."""
    BAD = 2
    """Who goes on would be misled."""


_COLOURS = {
    Concern.NONE: TERMINAL["good"],
    Concern.UNCERTAIN: TERMINAL["caution"],
    Concern.BAD: TERMINAL["bad"],
}
_CAPITALS = re.compile(r"^(\s*(?:[\d.]+ \S+, )?)((?:\d+ )?[A-Z]{2,}(?:[ -](?:[A-Z]+|\d+))*)\b")
"""The words of a verdict that are coloured: capitals at its beginning or after a number; later ones may be names."""

_WORD = re.compile(r"""(?:'[^']*'|"[^"]*"|\S)+""")
"""A word of a command, in quotes where it holds spaces."""


def typed(*words: str) -> str:
    """Write a command as it is typed.

    Args:
        words: Its words, without the name of the program; `EXPERIMENT` stands for the files that were typed, and
            `FIRST_EXPERIMENT` for the first of them.

    Returns:
        The words, in quotes where a shell needs them.
    """
    return " ".join(word if word in (EXPERIMENT, FIRST_EXPERIMENT) else shlex.quote(word) for word in words)


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
    lines: tuple[str, ...] = ()
    """Lines of a file that the step is about, as they are to be copied."""
    command: str = ""
    """The command that does it, as `typed` writes it."""
    written: tuple[str | None, ...] = ()
    """Files that were written, and that nothing else names; None for those that were not written."""
    concern: Concern = Concern.NONE
    """How much it asks for attention."""


def answer_text(
    answers: Sequence[Answer],
    width: int,
    experiment: str = "",
    first: str = "",
    *,
    again: str = "",
    most: int | None = None,
    coloured: bool = False,
) -> str:
    """Write answers for people: a line for each with its reason, the worst first, and what next for the worst.

    Args:
        answers: The answers.
        width: Characters of a line.
        experiment: What stands for the experiment files in commands; a word for any if empty.
        first: What stands for the first of them.
        again: What stands for `AGAIN`; such a command is left out if empty.
        most: Lines. Where there is no room for all of why, its sentences are cut, the last ones first, then left
            out; one line of the worst answer stays. None for as many lines as there are.
        coloured: Whether the words of each verdict that are in capitals have the colour of its concern.

    Returns:
        Lines, each with its end; empty without answers.
    """
    if not answers:
        return ""
    ordered = sorted(answers, key=lambda answer: -answer.concern)
    names = {EXPERIMENT: experiment or _ANY, FIRST_EXPERIMENT: first or experiment or _ANY}
    names = {AGAIN: again, **names}  # first, because it has the experiment in it
    headlines = [_headline(answer, width, coloured) for answer in ordered]
    end = [*_end(ordered, width, names)]
    # the reasons of further answers that ask for attention, before more of the worst
    worst, *others = ordered
    sentences = [(0, sentence) for sentence in worst.why]
    further = [(k, one.why[0]) for k, one in enumerate(others, start=1) if one.concern and one.why]
    sentences[1:1] = further
    room = None if most is None else most - len("\n".join([*headlines, *end]).splitlines())
    parts = _cut([sentence for _, sentence in sentences], len(further), width, room)
    reasons = [
        [headline, *(line for (k, _), lines in zip(sentences, parts, strict=True) if k == number for line in lines)]
        for number, headline in enumerate(headlines)
    ]
    return "".join(f"{part}\n" for part in [*(line for lines in reasons for line in lines), *end])


def _cut(sentences: Sequence[str], further: int, width: int, room: int | None) -> list[list[str]]:
    """Lines of each sentence: one as far as there is room, then more of the first ones."""
    lines = [_indented(sentence, width).splitlines() for sentence in sentences]
    if room is None or sum(map(len, lines)) <= room:
        return lines
    room = max(room, 1)
    counts = [int(k < room) for k in range(len(lines))]
    for k, own in enumerate(lines):
        counts[k] += min(max(room - sum(counts), 0), len(own) - counts[k]) if counts[k] else 0
    shown = sum(map(bool, counts))
    last = shown - 1 if shown - 1 > further else 0  # of the worst answer
    for k, own in enumerate(lines):
        cut = counts[k] < len(own) or (k == last and shown < len(lines))
        del own[counts[k] :]
        if cut and own:
            own[-1] = _INDENT + shortened(f"{own[-1]} …", width - len(_INDENT))
    return lines


def _end(answers: Sequence[Answer], width: int, names: Mapping[str, str]) -> Iterator[str]:
    """Files that were written, and what to do next for the worst answer."""
    files = dict.fromkeys(file for answer in answers for file in answer.written if file is not None)
    if files:
        yield wrapped(f"written: {', '.join(files)}", width)
    worst = answers[0]
    if worst.step:
        yield wrapped(f"next: {worst.step}", width)
    yield from (f"{_INDENT}{line}" for line in worst.lines)
    if worst.command:
        command = worst.command
        for placeholder, name in names.items():
            command = command.replace(placeholder, name)
        if command:
            yield _command(f"forcetorque {command}", width)


def _headline(answer: Answer, width: int, coloured: bool) -> str:
    """Subject to the left, verdict to the right; below it where there is no room."""
    gap = width - len(answer.subject) - len(answer.verdict)
    fits = gap >= 2
    verdict = answer.verdict if fits else _indented(answer.verdict, width)
    if coloured:
        verdict = _CAPITALS.sub(rf"\1\033[1;{_COLOURS[answer.concern]}m\2\033[0m", verdict, count=1)
    return f"{answer.subject}{' ' * gap}{verdict}" if fits else f"{wrapped(answer.subject, width)}\n{verdict}"


def _indented(sentence: str, width: int) -> str:
    return "\n".join(f"{_INDENT}{line}" for line in wrapped(sentence, width - len(_INDENT)).splitlines())


def _command(command: str, width: int) -> str:
    """A command that can be copied: a line that is too long goes on in the next one as a shell reads it."""
    if len(_INDENT) + len(command) <= width:
        return f"{_INDENT}{command}"
    lines = [""]
    for word in _WORD.findall(command):
        longer = f"{lines[-1]} {word}".lstrip()
        if lines[-1] and len(_INDENT) * len(lines[:2]) + len(longer) + len(_CONTINUED) > width:
            lines.append(word)
        else:
            lines[-1] = longer
    return f"{_CONTINUED}\n".join(f"{_INDENT * min(2, number)}{line}" for number, line in enumerate(lines, start=1))


def warnings_text(sentences: Sequence[str], width: int, most: int = _MOST_WARNINGS) -> str:
    """Count warnings and show the first of them, each in one line.

    Args:
        sentences: The warnings, the worst first.
        width: Characters of a line.
        most: Warnings to show, where there is room for as many.

    Returns:
        Lines, each with its end; empty without warnings.
    """
    if not sentences:
        return ""
    count = max(0, min(most, _MOST_WARNINGS))
    shown = [f"{_INDENT}{shortened(sentence, width - len(_INDENT))}" for sentence in sentences[:count]]
    more = len(sentences) - len(shown)
    rest = f", {len(shown) or 'none'} shown" if more else ""
    colon = ":" if shown else ""
    return "\n".join([f"{len(sentences)} warning{'s' * (len(sentences) > 1)}{rest}{colon}", *shown]) + "\n"
