# SPDX-License-Identifier: BSD-3-Clause
"""The spheres of many sensors, mounting conditions and trials compared (thesis Tables 4.1, 4.3 and 4.4)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, ClassVar, Literal, Self

from pydantic import Field

from forcetorque.base.progress import Progress
from forcetorque.evaluation.sphere.ellipsoid import RULE, TOLERANCE
from forcetorque.evaluation.sphere.result import EllipsoidRow, FailureRow
from forcetorque.evaluation.trials.result import GroupFitRow, GroupRow, TrialRow, group_rows
from forcetorque.evaluation.trials.trials import TrialGroup, TrialSphere, group_trials
from forcetorque.results.number_text import interval
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Table, short_names

_Fit = Literal["with_model", "without_model"]
FITS: tuple[tuple[_Fit, str], ...] = (
    ("with_model", "with the model"),
    ("without_model", "without the model"),
)
"""The two ellipsoids of every trial, and their words."""
_MANY = 10
"""Sensors above which they get no tables of their own."""


def comparison_blocks(trials: Sequence[TrialRow], groups: Sequence[GroupRow]) -> Iterator[Table | str]:
    """Show trials, conditions, drift and ranks.

    Args:
        trials: The trials, at least one.
        groups: Their groups.

    Yields:
        Tables and sentences.
    """
    names = short_names([row.calibration for row in trials])
    label = _labels(groups, names)
    yield _trial_table(trials, names)
    yield from _condition_tables(trials, groups, names)
    several = [row for row in groups if row.trials > 1]
    if several:
        yield _drift_table(several, label)
    for row in several:
        if row.not_pooled is not None:
            yield f"{label(row)}: not pooled: {row.not_pooled}"
    if len(groups) > 1:
        yield _rank_table(groups, trials, label)
        yield "rank: one more than the sensors whose whole interval lies below; what overlaps is in no order"
    yield (
        "index: standard deviation of the masses of three axes; in brackets: not identifiable, neither averaged nor "
        "ranked; pooled: one shape for all trials, a centre for each"
    )


def _trial_table(trials: Sequence[TrialRow], names: Mapping[str, str]) -> Table:
    """Every trial, as in Table 4.1; columns that are the same everywhere are left out."""
    words = {
        "condition": [row.condition or "-" for row in trials],
        "calibration": [names[row.calibration] for row in trials],
    }
    shown = {heading: column for heading, column in words.items() if len(set(column)) > 1}
    if any(row.trial > 1 for row in trials):
        shown["trial"] = [str(row.trial) for row in trials]
    return Table(
        caption="every trial; errors with the model, index with and without it",
        headings=(
            "sensor", "serial", *shown, "error x, N", "y, N", "z, N", "index with, kg", "index without, kg",
        ),
        rows=tuple(
            (row.sensor, row.serial, *(column[k] for column in shown.values()), *_errors(row.with_model),
             _index(row.with_model), _index(row.without_model))
            for k, row in enumerate(trials)
        ),
    )  # fmt: skip


def _condition_tables(
    trials: Sequence[TrialRow], groups: Sequence[GroupRow], names: Mapping[str, str]
) -> Iterator[Table | str]:
    """A table per sensor and candidate that has several trials or conditions, and per fit that says something."""
    sensors: dict[tuple[str, str, str], list[GroupRow]] = {}
    for row in groups:
        sensors.setdefault((row.sensor, row.serial, row.calibration), []).append(row)
    compared = [rows for rows in sensors.values() if len(rows) > 1 or rows[0].trials > 1]
    for rows in compared[:_MANY]:
        keys = {_key(row) for row in rows}
        for fit, words in FITS:
            if any(_index(getattr(trial, fit)) != "-" for trial in trials if _key(trial) in keys):
                caption = f"{rows[0].sensor} ({rows[0].serial}), {names[rows[0].calibration]}: index {words}, kg"
                yield _condition_table(rows, trials, fit, caption)
    if len(compared) > _MANY:
        yield f"{len(compared) - _MANY} more sensors have tables like these; see --format json"


def _condition_table(groups: Sequence[GroupRow], trials: Sequence[TrialRow], name: _Fit, caption: str) -> Table:
    """Trials down and conditions across, as in Tables 4.3 and 4.4."""
    columns = [[_index(getattr(trial, name)) for trial in trials if _key(trial) == _key(row)] for row in groups]
    longest = max(len(column) for column in columns)
    fits: list[GroupFitRow | None] = [getattr(row, name) for row in groups]
    means = (_mean(fit, row.trials) for fit, row in zip(fits, groups, strict=True))
    return Table(
        caption=caption,
        headings=("trial", *(row.condition or "no condition" for row in groups)),
        rows=(
            *((str(k + 1), *(column[k] if k < len(column) else "-" for column in columns)) for k in range(longest)),
            ("mean of trials", *means),
            ("  from their scatter", *("-" if fit is None else _mean_ends(fit) for fit in fits)),
            ("pooled fit", *("-" if fit is None else _index(fit.pooled) for fit in fits)),
            ("  from left-out tenths", *("-" if fit is None else _ends(fit.pooled) for fit in fits)),
        ),
    )


def _drift_table(groups: Sequence[GroupRow], label: Callable[[GroupRow], str]) -> Table:
    lines: list[tuple[str, ...]] = []
    for row in groups:
        for name, words in FITS:
            fit: GroupFitRow | None = getattr(row, name)
            if fit is None or fit.drift is None:
                continue
            drift = fit.drift
            changes = (drift.mass_kg, drift.centre_N)
            values = [f"{drift.index_kg:+.3f}", *(" ".join(f"{value:+.2f}" for value in change) for change in changes)]
            if not drift.identifiable:
                values = [f"({value})" for value in values]
            beyond = "not identifiable" if drift.exceeds is None else ", ".join(drift.exceeds) or "nothing"
            lines.append((label(row), words.split()[0], *values, beyond))
    return Table(
        caption="drift: last trial minus first",
        headings=("sensor", "fit", "index, kg", "masses x y z, kg", "centre x y z, N", "beyond the intervals"),
        rows=tuple(lines),
    )


def _rank_table(groups: Sequence[GroupRow], trials: Sequence[TrialRow], label: Callable[[GroupRow], str]) -> Table:
    """Groups by index, unknown ones last in the order of the files; ranks are of intervals and may skip about."""
    first = {_key(trial): trial for trial in reversed(trials)}
    lines = []
    for row in groups:
        cells, place = [], []
        for name, _ in FITS:
            by: GroupFitRow | None = getattr(row, name)
            only: EllipsoidRow | None = getattr(first[_key(row)], name)
            fit = only if row.trials == 1 else None if by is None else by.pooled
            cells += [_index(fit), _ends(fit), "-" if by is None or by.rank is None else str(by.rank)]
            index = fit.index_kg if fit is not None and fit.identifiable else None
            place.append(float("inf") if index is None else index)
        lines.append((place, (label(row), str(row.trials), *cells)))
    return Table(
        caption="by index of the pooled fit, or of the only trial",
        headings=(
            "sensor", "trials", "index with, kg", "interval", "rank", "index without, kg", "interval", "rank",
        ),
        rows=tuple(cells for _, cells in sorted(lines, key=lambda line: line[0])),
    )  # fmt: skip


def _labels(groups: Sequence[GroupRow], names: Mapping[str, str]) -> Callable[[GroupRow], str]:
    """What names a group in one line: the sensor, and what not all groups have in common."""
    conditions, candidates = len({row.condition for row in groups}) > 1, len({row.calibration for row in groups}) > 1

    def label(row: GroupRow) -> str:
        words = [f"{row.sensor} ({row.serial})"]
        words += [row.condition or "no condition"] if conditions else []
        words += [names[row.calibration]] if candidates else []
        return ", ".join(words)

    return label


def _key(row: GroupRow | TrialRow) -> tuple[str, str, str | None, str]:
    return row.sensor, row.serial, row.condition, row.calibration


def _errors(fit: EllipsoidRow | None) -> tuple[str, ...]:
    if fit is None or fit.error_N is None:
        return ("-",) * 3
    return tuple(f"{error:.4f}" if fit.identifiable else f"({error:.4f})" for error in fit.error_N)


def _index(fit: EllipsoidRow | None) -> str:
    if fit is None or fit.index_kg is None:
        return "-"
    return f"{fit.index_kg:.4f}" if fit.identifiable else f"({fit.index_kg:.4f})"


def _mean(fit: GroupFitRow | None, trials: int) -> str:
    if fit is None or fit.mean_index_kg is None:
        return "-"
    of = "" if fit.known == trials else f", {fit.known} of {trials}"
    return f"{fit.mean_index_kg:.4f}{of}"


def _mean_ends(fit: GroupFitRow) -> str:
    if fit.mean_low_kg is None or fit.mean_high_kg is None:
        return "-"
    return interval(fit.mean_low_kg, fit.mean_high_kg, digits=2)


def _ends(fit: EllipsoidRow | None) -> str:
    return "-" if fit is None else interval(fit.index_low_kg, fit.index_high_kg, digits=2)


_COMMON = ("sensor", "serial", "condition", "calibration")
"""What tells groups apart, in every line of the CSV."""
_OF_A_FIT = (
    *("identifiable", "index_kg", "index_low_kg", "index_high_kg"),
    *(f"{name}_{axis}_{unit}" for name, unit in (("mass", "kg"), ("error", "N"), ("centre", "N")) for axis in "xyz"),
    "why",
)
"""Columns of an ellipsoid in the CSV; the JSON has the others too."""


class Comparison(DrawnResult):
    """Spheres of trials, and of the sensors and conditions that they are trials of."""

    answered_by: ClassVar[str | None] = "forcetorque.evaluation.sphere.answers:comparison_answers"
    drawn_by: ClassVar[str] = "forcetorque.evaluation.figures.sphere:index_figure"
    drawn_fields: ClassVar[tuple[str, ...]] = ("analyses",)

    schema_name: Literal["forcetorque/compare/2"] = Field(default="forcetorque/compare/2", alias="schema")
    """Form of the result."""
    tolerance: float
    """Half width of an interval, relative to the mean radius, up to which a number is identifiable."""
    rule: str = Field(repr=False)
    """How it is decided what is identifiable."""
    trials: tuple[TrialRow, ...]
    """One per sensor, trial and way to read it, in the order of the groups."""
    groups: tuple[GroupRow, ...]
    """One per sensor, condition and way to read it."""
    failures: tuple[FailureRow, ...]
    """What could not be analysed; the exit code is 1 if there is any."""
    analyses: tuple[TrialGroup, ...] = Field(default=(), exclude=True, repr=False)
    """The trials and pooled fits behind every group, for figures."""

    @classmethod
    def of(cls, trials: Sequence[TrialSphere], failures: Sequence[FailureRow], progress: Progress) -> Self:
        """Pool trials, and compare them.

        Args:
            trials: Trials in the order of their files.
            failures: What could not be analysed.
            progress: Called with a line for people at every group that is pooled.

        Returns:
            Trials sorted by sensor, condition and way of reading.
        """
        groups, warnings = group_trials(trials, progress=progress)
        return cls(
            tolerance=TOLERANCE,
            rule=RULE,
            figure=None,
            trials=tuple(TrialRow.of(trial, k) for group in groups for k, trial in enumerate(group.trials, 1)),
            groups=group_rows(groups),
            failures=tuple(failures),
            analyses=tuple(groups),
            warnings=(
                *(failure.sentence for failure in failures if not failure.skipped),
                *warnings,
                *dict.fromkeys(f"{trial.file}: {doubt}" for trial in trials for doubt in trial.sphere.doubts()),
                *dict.fromkeys(f"{trial.file}: {sentence}" for trial in trials for sentence in trial.added),
            ),
        )

    @property
    def passed(self) -> bool:
        """Whether no trial failed, nor the figure."""
        return all(failure.skipped for failure in self.failures)

    def without_figure(self, file: Path, error: Exception) -> Self:
        """Give the result with a failure in place of its figure: what fails then must not cost the result.

        Args:
            file: The figure.
            error: Why it is not there.

        Returns:
            The result.
        """
        if not self.analyses:  # there is nothing to draw
            return self
        failure = FailureRow(file=str(file), sensor=None, message=" ".join(str(error).split()))
        return self.model_copy(update={"failures": (*self.failures, failure)})

    def blocks(self) -> Iterator[Table | str]:
        """Give every trial, conditions side by side, drift and ranks.

        Yields:
            Tables and sentences.
        """
        if self.trials:
            yield from comparison_blocks(self.trials, self.groups)
        yield from (failure.sentence for failure in self.failures)

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
