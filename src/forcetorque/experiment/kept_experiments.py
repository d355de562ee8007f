# SPDX-License-Identifier: BSD-3-Clause
"""Experiments that a command has read, for what follows it in the same run."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from forcetorque.experiment.experiment import Experiment
    from forcetorque.results.result import Result

    Accept = Callable[[Path, Experiment], None]
    Finished = Callable[[Path, Experiment, Result], None]

_KEPT: ContextVar[dict[Path, Experiment] | None] = ContextVar("forcetorque_kept_experiments", default=None)
_ACCEPT: ContextVar[Accept | None] = ContextVar("forcetorque_accept", default=None)
_FINISHED: ContextVar[Finished | None] = ContextVar("forcetorque_finished", default=None)
_ASKED_BY: ContextVar[str] = ContextVar("forcetorque_experiments_asked_by", default="")


@contextmanager
def kept_experiments(
    asked_by: str, accept: Accept | None = None, finished: Finished | None = None
) -> Iterator[Mapping[Path, Experiment]]:
    """Keep every experiment that is read in the body, so that its log need not be read again.

    Args:
        asked_by: Option that needs them, with its value, for messages.
        accept: Called with file and experiment when it was read; raises where it cannot be used.
        finished: Called with file, experiment and result of each experiment by a command that reads more recordings
            than memory holds; then none is kept.

    Yields:
        Experiments by their file, or by the log that one was made of; empty until they are read.
    """
    experiments: dict[Path, Experiment] = {}
    token, option = _KEPT.set(experiments if finished is None else None), _ASKED_BY.set(asked_by)
    accepted, done = _ACCEPT.set(accept), _FINISHED.set(finished)
    try:
        yield experiments
    finally:
        _KEPT.reset(token)
        _ASKED_BY.reset(option)
        _ACCEPT.reset(accepted)
        _FINISHED.reset(done)


def experiments_asked_by() -> str:
    """Option that needs an experiment of every file, with its value; empty if none does."""
    return _ASKED_BY.get()


def keep_experiment(path: Path, experiment: Experiment) -> Experiment:
    """Keep an experiment if someone asked for it, and see first that it can be used.

    Args:
        path: Its file, or the log that it was made of.
        experiment: The experiment.

    Returns:
        The same.
    """
    accept, kept = _ACCEPT.get(), _KEPT.get()
    if accept is not None:
        accept(path, experiment)
    if kept is not None:
        kept[path] = experiment
    return experiment


def experiment_finished(path: Path, experiment: Experiment, result: Result) -> None:
    """Hand on an experiment before the next one is read.

    Args:
        path: Its file.
        experiment: The experiment.
        result: What the command says of it.
    """
    finished = _FINISHED.get()
    if finished is not None:
        finished(path, experiment, result)
