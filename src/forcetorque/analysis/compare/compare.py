# SPDX-License-Identifier: BSD-3-Clause
"""The spheres of many sensors, mounting conditions and trials: which sensor, mounted how, weighs alike in all axes."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

from pydantic import Field

from forcetorque.analysis.compare.rows import GroupFitRow, GroupRow, TrialRow, group_rows
from forcetorque.analysis.compare.tables import FITS, comparison_blocks
from forcetorque.analysis.compare.trial_group import TrialGroup, group_trials
from forcetorque.analysis.compare.trials import read_trials
from forcetorque.analysis.runs.added import with_recording_notes
from forcetorque.analysis.sphere.rows import EllipsoidRow, FailureRow
from forcetorque.calibration import Calibration
from forcetorque.evaluation.sphere import RULE, TOLERANCE
from forcetorque.result import Result, Table

_COMMON = ("sensor", "serial", "condition", "candidate")
"""What tells groups apart, in every line of the CSV."""
_OF_A_FIT = (
    *("identifiable", "index_kg", "index_low_kg", "index_high_kg"),
    *(f"{name}_{axis}_{unit}" for name, unit in (("mass", "kg"), ("error", "N"), ("centre", "N")) for axis in "xyz"),
    "why",
)
"""Columns of an ellipsoid in the CSV; the JSON has the others too."""


class Comparison(Result):
    """Spheres of trials, and of the sensors and conditions that they are trials of."""

    schema_name: Literal["forcetorque/compare/1"] = Field(default="forcetorque/compare/1", alias="schema")
    """Form of the result."""
    tolerance: float
    """Half width of an interval, relative to the mean radius, up to which a number is identifiable."""
    rule: str = Field(repr=False)
    """How it is decided what is identifiable."""
    figure: str | None
    """File of the figure; none where none was drawn."""
    trials: tuple[TrialRow, ...]
    """One per sensor, trial and way to read it, in the order of the groups."""
    groups: tuple[GroupRow, ...]
    """One per sensor, condition and way to read it."""
    failures: tuple[FailureRow, ...]
    """What could not be analysed; the exit code is 1 if there is any."""
    analyses: tuple[TrialGroup, ...] = Field(default=(), exclude=True, repr=False)
    """The trials and pooled fits behind every group, for figures."""

    def blocks(self) -> Iterator[Table | str]:
        """Give every trial, conditions side by side, drift and ranks.

        Yields:
            Tables and sentences.
        """
        if self.trials:
            yield from comparison_blocks(self.trials, self.groups)
        yield from (f"FAILED: {failure.message}" for failure in self.failures)
        if self.figure is not None:
            yield f"drawn to {self.figure}"

    def records(self) -> list[dict[str, object]]:
        """Give lines of numbers: those of trials, then means, pooled fits and drifts of groups, then failures.

        Returns:
            Lines by column; `row` says what each is, and `fit` by which ellipsoid.
        """
        lines: list[dict[str, object]] = []
        for trial in self.trials:
            head = _picked(trial, *_COMMON, "trial", "file", "model_mass_kg", "samples")
            for name, _ in FITS:
                fit: EllipsoidRow | None = getattr(trial, name)
                if fit is not None:
                    lines.append({"row": "trial", "fit": name, **head, **_fit_values(fit)})
        for group in self.groups:
            for name, _ in FITS:
                by: GroupFitRow | None = getattr(group, name)
                if by is not None:
                    head = {"fit": name, **_picked(group, *_COMMON, "trials")}
                    lines += [{"row": kind, **head, **values} for kind, values in _group_values(by)]
        return lines + [{"row": "failure", **failure.flat()} for failure in self.failures]


@with_recording_notes
def compare(
    paths: Sequence[Path | str],
    *,
    sensors: Sequence[str] | None = None,
    calibrations: Mapping[str, Calibration] | None = None,
    intervals: Sequence[str] | None = None,
    by_interval: bool = False,
    progress: Callable[[str], None] | None = None,
) -> Comparison:
    """Compare the spheres of sensors over experiments; what fails does not stop the others.

    Args:
        paths: Experiment files, in the order of the trials.
        sensors: Names of sensors, each in one file at least; None for all.
        calibrations: Calibrations by name, each for the sensor of its name and serial number in whatever file.
        intervals: Labels or kinds of the intervals whose motion draws the sphere; None for what each file says.
        by_interval: Whether each interval is a trial of its own; else all of a file are taken together.
        progress: Called with a line for people at every file, and at every group that is pooled.

    Returns:
        Trials sorted by sensor, condition and way of reading, and what failed.

    Raises:
        MissingFileError: If a file is not there; nothing has been read then.
        ExperimentError: If a file is named twice.
    """
    trials, failures = read_trials(
        paths, sensors=sensors, calibrations=calibrations, intervals=intervals, by_interval=by_interval,
        progress=progress,
    )  # fmt: skip
    groups, warnings = group_trials(trials, progress=progress)
    flattered = (
        f"{trial.sphere.candidate} was fitted on {', '.join(map(repr, trial.sphere.fitted_on))} of {trial.file}, so "
        "the verdict on it flatters"
        for trial in trials
        if trial.sphere.fitted_on
    )
    return Comparison(
        tolerance=TOLERANCE,
        rule=RULE,
        figure=None,
        trials=tuple(TrialRow.of(trial, k) for group in groups for k, trial in enumerate(group.trials, 1)),
        groups=group_rows(groups),
        failures=tuple(failures),
        analyses=tuple(groups),
        warnings=(
            *(f"failed: {failure.message}" for failure in failures),
            *warnings,
            *flattered,
            *dict.fromkeys(f"{trial.file}: {sentence}" for trial in trials for sentence in trial.added),
        ),
    )


def _picked(row: TrialRow | GroupRow, *names: str) -> dict[str, Any]:
    return {name: getattr(row, name) for name in names}


def _fit_values(fit: EllipsoidRow) -> dict[str, object]:
    values = fit.flat()
    return {name: values.get(name) for name in _OF_A_FIT}


def _group_values(by: GroupFitRow) -> Iterator[tuple[str, dict[str, object]]]:
    """Mean, pooled fit and drift of a group, as far as it has them."""
    yield (
        "mean",
        {
            "trials": by.known,
            "identifiable": by.known > 0,
            "index_kg": by.mean_index_kg,
            "index_low_kg": by.mean_low_kg,
            "index_high_kg": by.mean_high_kg,
            "rank": by.rank if by.pooled is None else None,
        },
    )
    if by.pooled is not None:
        yield "pooled", {**_fit_values(by.pooled), "rank": by.rank}
    if by.drift is not None:
        yield "drift", by.drift.flat()
