# SPDX-License-Identifier: BSD-3-Clause
"""What experiment files add to their logs, said by every answer that rests on it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import wraps
from types import FunctionType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from forcetorque.recording import Recording

ADDED = {"clock", "transformed", "fixed_joint", "stated_rate", "skipped_rows"}
"""Kinds of findings that say what the experiment file adds to its log."""


def added_to(recording: Recording) -> tuple[str, ...]:
    """Say what an experiment file adds to its log.

    Args:
        recording: The recording.

    Returns:
        A sentence for every clock, frame, joint, rate or line.
    """
    return tuple(f"{finding.stream}: {finding.message}" for finding in recording.findings if finding.kind in ADDED)


def saying_what_was_added(offered: Any) -> Any:
    """Let a question say what was added to the recordings that it is asked about, as warnings of its result.

    Args:
        offered: What a package offers: a question, or anything else.

    Returns:
        The question, which says it; anything else as it is.
    """
    if not isinstance(offered, FunctionType):
        return offered
    question: Callable[..., Any] = offered

    @wraps(question)
    def asked(*args: Any, **options: Any) -> Any:
        from forcetorque.result import Result  # here because the door opens before any question is asked

        answer = question(*args, **options)
        if not isinstance(answer, Result):
            return answer
        untold = tuple(_untold((*args, *options.values()), answer.warnings))
        return answer.model_copy(update={"warnings": (*answer.warnings, *untold)}) if untold else answer

    return asked


def _untold(arguments: Iterable[Any], told: Iterable[str]) -> Iterator[str]:
    """What no warning says yet; of several recordings with the name of each."""
    recordings = dict.fromkeys(_recordings(arguments))
    said = tuple(told)
    for name, recording in recordings:
        for sentence in added_to(recording):
            if not any(sentence in warning for warning in said):
                yield sentence if len(recordings) == 1 else f"{name}: {sentence}"


def _recordings(argument: Any) -> Iterator[tuple[str, Recording]]:
    """The recordings of experiments, of sensors in them, and of many of these."""
    from forcetorque.recording import Recording  # here because the door opens before any question is asked

    if isinstance(getattr(argument, "recording", None), Recording):
        yield argument.name, argument.recording
    elif hasattr(argument, "runs"):
        yield from _recordings(argument.runs)
    elif hasattr(argument, "experiment"):
        yield from _recordings(argument.experiment)
    elif isinstance(argument, Mapping | Sequence) and not isinstance(argument, str | bytes):
        for entry in argument.values() if isinstance(argument, Mapping) else argument:
            yield from _recordings(entry)
