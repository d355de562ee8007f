# SPDX-License-Identifier: BSD-3-Clause
"""What experiment files add to their logs, and what of these is left out, said by every answer that rests on it."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from functools import wraps
from types import FunctionType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from forcetorque.recording import Recording
    from forcetorque.result import UnusableSamples

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
    """Let a question say what was added to the recordings that it is asked about, and what of them is left out.

    The first are warnings of its result; the second are rows of it.

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
        arguments = (*args, *options.values())
        untold = tuple(_untold(arguments, answer.warnings))
        left_out = answer.unusable_samples
        if answer.interval_uses is not None:
            left_out = (*left_out, *_left_out(arguments, answer.interval_uses))
        if not untold and not left_out:
            return answer
        said = {"warnings": (*answer.warnings, *untold), "unusable_samples": tuple(dict.fromkeys(left_out))}
        return answer.model_copy(update=said)

    return asked


def _untold(arguments: Iterable[Any], told: Iterable[str]) -> Iterator[str]:
    """What no warning says yet; of several recordings with the name of each."""
    recordings = dict.fromkeys((experiment.name, experiment.recording) for experiment, _ in _experiments(arguments))
    said = tuple(told)
    for name, recording in recordings:
        for sentence in added_to(recording):
            if not any(sentence in warning for warning in said):
                yield sentence if len(recordings) == 1 else f"{name}: {sentence}"


def _left_out(arguments: Iterable[Any], uses: Collection[str]) -> Iterator[UnusableSamples]:
    """What is left out of the sensors that were read."""
    from forcetorque.analysis.runs.unusable import unusable_samples  # as above
    from forcetorque.experiment.content import Experiment

    for experiment, sensor in dict.fromkeys(_experiments(arguments)):
        if isinstance(experiment, Experiment):
            yield from unusable_samples(experiment, sensor=sensor, uses=uses)


def _experiments(argument: Any, sensor: str | None = None) -> Iterator[tuple[Any, str | None]]:
    """Experiments, with the name of the only sensor that is asked about; of sensors in them, and of many of these."""
    from forcetorque.recording import Recording  # here because the door opens before any question is asked

    if isinstance(getattr(argument, "recording", None), Recording):
        yield argument, sensor
    elif hasattr(argument, "runs"):
        yield from _experiments(argument.runs)
    elif hasattr(argument, "experiment"):
        yield from _experiments(argument.experiment, getattr(getattr(argument, "sensor", None), "name", None))
    elif isinstance(argument, Mapping | Sequence) and not isinstance(argument, str | bytes):
        for entry in argument.values() if isinstance(argument, Mapping) else argument:
            yield from _experiments(entry)
