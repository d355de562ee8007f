# SPDX-License-Identifier: BSD-3-Clause
"""What experiment files add to their logs, and what of these is left out, said by every answer that rests on it."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from functools import wraps
from typing import Any, ParamSpec, TypeVar

from forcetorque.recording import Recording
from forcetorque.result import Result, UnusableSamples

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


def with_recording_notes(analysis: Callable[Options, Answer]) -> Callable[Options, Answer]:
    """Let the result of an analysis state what is added to the recordings that it is given, and what is left out.

    The first are warnings of the result; the second are records of it.

    Args:
        analysis: A function whose arguments hold experiments, their sensors, or many of these.

    Returns:
        The function; its result has a warning for every addition that no warning of it names yet, and unusable samples.
    """

    @wraps(analysis)
    def noted(*args: Options.args, **options: Options.kwargs) -> Answer:
        result = analysis(*args, **options)
        arguments = (*args, *options.values())
        untold = tuple(_untold(arguments, result.warnings))
        left_out = result.unusable_samples
        if result.interval_uses is not None:
            left_out = (*left_out, *_left_out(arguments, result.interval_uses))
        if not untold and not left_out:
            return result
        notes = {"warnings": (*result.warnings, *untold), "unusable_samples": tuple(dict.fromkeys(left_out))}
        return result.model_copy(update=notes)

    return noted


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
    from forcetorque.analysis.runs.unusable import unusable_samples
    from forcetorque.experiment.content import Experiment

    for experiment, sensor in dict.fromkeys(_experiments(arguments)):
        if isinstance(experiment, Experiment):
            yield from unusable_samples(experiment, sensor=sensor, uses=uses)


def _experiments(argument: Any, sensor: str | None = None) -> Iterator[tuple[Any, str | None]]:
    """Experiments, with the name of the only sensor that is asked about; of sensors in them, and of many of these."""
    if isinstance(getattr(argument, "recording", None), Recording):
        yield argument, sensor
    elif hasattr(argument, "runs"):
        yield from _experiments(argument.runs)
    elif hasattr(argument, "experiment"):
        yield from _experiments(argument.experiment, getattr(getattr(argument, "sensor", None), "name", None))
    elif isinstance(argument, Mapping | Sequence) and not isinstance(argument, str | bytes):
        for entry in argument.values() if isinstance(argument, Mapping) else argument:
            yield from _experiments(entry)
