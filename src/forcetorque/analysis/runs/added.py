# SPDX-License-Identifier: BSD-3-Clause
"""What experiment files add to their logs, said by every answer that rests on it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import wraps
from typing import Any, ParamSpec, TypeVar

from forcetorque.recording import Recording
from forcetorque.result import Result

Options = ParamSpec("Options")
Answer = TypeVar("Answer", bound=Result)

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


def warns_of_additions(analysis: Callable[Options, Answer]) -> Callable[Options, Answer]:
    """Let the result of an analysis warn of what experiment files add to the recordings that it is given.

    Args:
        analysis: A function whose arguments hold experiments, their sensors, or many of these.

    Returns:
        The function; its result has a warning for every addition that no warning of it names yet.
    """

    @wraps(analysis)
    def warning(*args: Options.args, **options: Options.kwargs) -> Answer:
        result = analysis(*args, **options)
        untold = tuple(_untold((*args, *options.values()), result.warnings))
        return result.model_copy(update={"warnings": (*result.warnings, *untold)}) if untold else result

    return warning


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
    if isinstance(getattr(argument, "recording", None), Recording):
        yield argument.name, argument.recording
    elif hasattr(argument, "runs"):
        yield from _recordings(argument.runs)
    elif hasattr(argument, "experiment"):
        yield from _recordings(argument.experiment)
    elif isinstance(argument, Mapping | Sequence) and not isinstance(argument, str | bytes):
        for entry in argument.values() if isinstance(argument, Mapping) else argument:
            yield from _recordings(entry)
