# SPDX-License-Identifier: BSD-3-Clause
"""The tables of `forcetorque compare` for people, in the form of thesis Tables 4.1, 4.3 and 4.4."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING

from forcetorque.cli.compare_result import CompareResult, GroupFitRow, GroupRow, TrialRow
from forcetorque.cli.output import console, table
from forcetorque.cli.sphere_result import EllipsoidRow
from forcetorque.result.names import short_names

if TYPE_CHECKING:
    from rich.table import Table

_FITS = (("with_reference", "with the model"), ("without_reference", "without the model"))
_MANY = 10
"""Sensors above which they get no tables of their own."""


def show(result: CompareResult) -> None:
    """Print the result for people.

    Args:
        result: The result.
    """
    screen = console()
    if result.trials:
        names = short_names([row.candidate for row in result.trials])
        screen.print(_trial_table(result.trials, names))
        label, compared = _labels(result.groups, names), _compared(result.groups)
        for rows in compared[:_MANY]:
            for name, words in _FITS:
                if _says_something(rows, result.trials, name):
                    title = f"{rows[0].sensor} ({rows[0].serial}), {names[rows[0].candidate]}: index {words}, kg"
                    screen.print(title, soft_wrap=True)
                    screen.print(_condition_table(rows, result.trials, name))
        if len(compared) > _MANY:
            screen.print(
                f"{len(compared) - _MANY} more sensors have tables like these; see --format json", soft_wrap=True
            )
        several = [row for row in result.groups if row.trials > 1]
        if several:
            screen.print(_drift_table(several, label))
        for row in several:
            if row.not_pooled is not None:
                screen.print(f"{label(row)}: not pooled: {row.not_pooled}", soft_wrap=True)
        if len(result.groups) > 1:
            screen.print(_rank_table(result.groups, result.trials, label))
            screen.print(
                "rank: one more than the sensors whose whole interval lies below; what overlaps is in no order",
                soft_wrap=True,
            )
        screen.print(
            "index: standard deviation of the masses of three axes; in brackets: not identifiable, neither averaged "
            "nor ranked; pooled: one shape for all trials, a centre for each",
            soft_wrap=True,
        )
    for failure in result.failures:
        screen.print(f"FAILED: {failure.message}", soft_wrap=True)
    if result.figure is not None:
        screen.print(f"drawn to {result.figure}", soft_wrap=True)


def _trial_table(trials: Sequence[TrialRow], names: Mapping[str, str]) -> Table:
    columns = {
        "condition": [row.condition or "-" for row in trials],
        "candidate": [names[row.candidate] for row in trials],
    }
    shown = {name: words for name, words in columns.items() if len(set(words)) > 1}
    numbered = any(row.trial > 1 for row in trials)
    made = table(
        "sensor", "serial", *shown, *(["trial"] if numbered else []), "error x, N", "y, N", "z, N", "index with, kg",
        "index without, kg", title="every trial; errors with the model, index with and without it",
    )  # fmt: skip
    for k, row in enumerate(trials):
        words = [column[k] for column in shown.values()]
        fit = row.with_reference
        errors = ["-"] * 3
        if fit is not None and fit.error_N is not None:
            errors = [f"{error:.4f}" if fit.identifiable else f"({error:.4f})" for error in fit.error_N]
        made.add_row(
            row.sensor, row.serial, *words, *([str(row.trial)] if numbered else []), *errors,
            _index(fit), _index(row.without_reference),
        )  # fmt: skip
    return made


def _compared(groups: Sequence[GroupRow]) -> list[list[GroupRow]]:
    """Groups of one sensor and candidate, where there are several trials or conditions."""
    found: dict[tuple[str, str, str], list[GroupRow]] = {}
    for row in groups:
        found.setdefault((row.sensor, row.serial, row.candidate), []).append(row)
    return [rows for rows in found.values() if len(rows) > 1 or rows[0].trials > 1]


def _says_something(groups: Sequence[GroupRow], trials: Sequence[TrialRow], name: str) -> bool:
    keys = {_key(row) for row in groups}
    return any(_index(getattr(trial, name)) != "-" for trial in trials if _key(trial) in keys)


def _condition_table(groups: Sequence[GroupRow], trials: Sequence[TrialRow], name: str) -> Table:
    """Trials down and conditions across, as in Tables 4.3 and 4.4."""
    made = table("trial", *(row.condition or "no condition" for row in groups))
    columns = []
    for row in groups:
        mine = [each for each in trials if _key(each) == _key(row)]
        columns.append([_index(getattr(each, name)) for each in mine])
    for k in range(max(len(column) for column in columns)):
        made.add_row(str(k + 1), *(column[k] if k < len(column) else "-" for column in columns))
    fits: list[GroupFitRow | None] = [getattr(row, name) for row in groups]
    made.add_section()
    made.add_row("mean of trials", *(_mean(fit, row.trials) for fit, row in zip(fits, groups, strict=True)))
    made.add_row("  from their scatter", *("-" if fit is None else _mean_ends(fit) for fit in fits))
    made.add_row("pooled fit", *("-" if fit is None else _index(fit.pooled) for fit in fits))
    made.add_row("  from left-out tenths", *("-" if fit is None else _ends(fit.pooled) for fit in fits))
    return made


def _drift_table(groups: Sequence[GroupRow], label: Callable[[GroupRow], str]) -> Table:
    made = table(
        "sensor", "fit", "index, kg", "masses x y z, kg", "centre x y z, N", "beyond the intervals",
        title="drift: last trial minus first",
    )  # fmt: skip
    for row in groups:
        for name, words in _FITS:
            fit: GroupFitRow | None = getattr(row, name)
            if fit is None or fit.drift is None:
                continue
            drift = fit.drift
            masses, centre = (
                " ".join(f"{value:+.2f}" for value in values) for values in (drift.mass_kg, drift.centre_N)
            )
            values = [f"{drift.index_kg:+.3f}", masses, centre]
            if not drift.identifiable:
                values = [f"({value})" for value in values]
            beyond = "not identifiable" if drift.exceeds is None else ", ".join(drift.exceeds) or "nothing"
            made.add_row(label(row), words.split()[0], *values, beyond)
    return made


def _rank_table(groups: Sequence[GroupRow], trials: Sequence[TrialRow], label: Callable[[GroupRow], str]) -> Table:
    """Groups by index, unknown ones last in the order of the files; ranks are of intervals and may skip about."""
    made = table(
        "sensor", "trials", "index with, kg", "interval", "rank", "index without, kg", "interval", "rank",
        title="by index of the pooled fit, or of the only trial",
    )  # fmt: skip
    first = {_key(trial): trial for trial in reversed(trials)}
    lines = []
    for row in groups:
        cells, place = [], []
        for name, _ in _FITS:
            by: GroupFitRow | None = getattr(row, name)
            only: EllipsoidRow | None = getattr(first[_key(row)], name)
            fit = only if row.trials == 1 else None if by is None else by.pooled
            cells += [_index(fit), _ends(fit), "-" if by is None or by.rank is None else str(by.rank)]
            index = fit.index_kg if fit is not None and fit.identifiable else None
            place.append(float("inf") if index is None else index)
        lines.append((place, [label(row), str(row.trials), *cells]))
    for _, cells in sorted(lines, key=lambda line: line[0]):
        made.add_row(*cells)
    return made


def _labels(groups: Sequence[GroupRow], names: Mapping[str, str]) -> Callable[[GroupRow], str]:
    """What names a group in one line: the sensor, and what not all groups have in common."""
    conditions, candidates = len({row.condition for row in groups}) > 1, len({row.candidate for row in groups}) > 1

    def label(row: GroupRow) -> str:
        parts = [f"{row.sensor} ({row.serial})"]
        parts += [row.condition or "no condition"] if conditions else []
        parts += [names[row.candidate]] if candidates else []
        return ", ".join(parts)

    return label


def _key(row: GroupRow | TrialRow) -> tuple[str, str, str | None, str]:
    return row.sensor, row.serial, row.condition, row.candidate


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
    return f"{fit.mean_low_kg:.2f} to {fit.mean_high_kg:.2f}"


def _ends(fit: EllipsoidRow | None) -> str:
    if fit is None:
        return "-"
    return f"{fit.index_low_kg:.2f} to {'any' if fit.index_high_kg is None else f'{fit.index_high_kg:.2f}'}"
