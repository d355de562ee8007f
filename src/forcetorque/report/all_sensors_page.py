# SPDX-License-Identifier: BSD-3-Clause
"""Page one of a report on several sensors: all of them in one table, those that must not be used first."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Final

from forcetorque.evaluation.answers import CONCERN
from forcetorque.evaluation.load_cases.verdict import TONES, Decision, LoadCaseError, LoadCaseVerdict
from forcetorque.report.decision import NextSteps, Undecided
from forcetorque.results.document.content import Place, Section, Tone, Verdict
from forcetorque.results.number_text import amount
from forcetorque.results.table import Table, short_names

_ORDER: Final[Sequence[Decision]] = sorted(CONCERN, key=CONCERN.__getitem__, reverse=True)
"""Verdicts, the one that asks most for attention first."""
_HEADINGS = ("sensor", "calibration", "may it be used?", "for", "force error", "moment error", "do next, or why not")


def all_sensors_page(
    uses: Sequence[LoadCaseVerdict], undecided: Sequence[Undecided], steps: Sequence[NextSteps]
) -> Section:
    """Put all sensors on one page.

    Args:
        uses: Verdicts on all calibrations.
        undecided: Calibrations and sensors without a verdict.
        steps: What to do next about every sensor.

    Returns:
        A section with a page of its own: how many may be used, and a line per verdict.
    """
    unjudged = [row.calibration for row in undecided if row.calibration is not None]
    names = short_names([*(use.calibration for use in uses), *unjudged])
    first = {(row.sensor, row.serial): next(iter(row.steps), "") for row in steps}
    rows = [_row(use, names, first) for use in sorted(uses, key=lambda use: _ORDER.index(use.decision))]
    for row in undecided:
        name = "" if row.calibration is None else names[row.calibration]
        rows.append((f"{row.sensor} ({row.serial})", name, "no verdict", "", "", "", row.reason))
    caption = "Predicted errors: prior → calibration (at most with 95 %; allowed)"
    table = Table(caption=caption, headings=_HEADINGS, rows=tuple(rows))
    return Section(title="All sensors", blocks=(*_counts(uses, undecided), table), place=Place.PAGE)


def _row(use: LoadCaseVerdict, names: Mapping[str, str], first: Mapping[tuple[str, str], str]) -> tuple[str, ...]:
    errors = {error.quantity: _error(error) for error in use.errors}
    remedy = next((reason.remedy for reason in use.reasons if reason.remedy is not None), None)
    return (
        f"{use.sensor} ({use.serial})",
        names[use.calibration],
        use.decision,
        use.loads,
        errors.get("force", ""),
        errors.get("moment", ""),
        remedy or first.get((use.sensor, use.serial), ""),
    )


def _error(error: LoadCaseError) -> str:
    before = "" if error.before is None else f"{amount(error.before, '')} → "
    allowed = "" if error.allowed is None else f"; {amount(error.allowed, '')}"
    return f"{before}{amount(error.after, error.unit)} ({amount(error.after_at_most, '')}{allowed})"


def _counts(uses: Sequence[LoadCaseVerdict], undecided: Sequence[Undecided]) -> Iterator[Verdict]:
    """Name the sensors by their worst verdict."""
    worst: dict[tuple[str, str], Decision] = {}
    for use in uses:
        key = (use.sensor, use.serial)
        worst[key] = min(worst.get(key, "use"), use.decision, key=_ORDER.index)
    for decision in _ORDER:
        sensors = [sensor for (sensor, _), one in worst.items() if one == decision]
        if sensors:
            yield Verdict(tone=Tone(TONES[decision]), word=decision, text=f"{len(sensors)}: {', '.join(sensors)}.")
    without = dict.fromkeys(row.sensor for row in undecided if (row.sensor, row.serial) not in worst)
    if without:
        yield Verdict(tone=Tone.UNKNOWN, word="no verdict", text=f"{len(without)}: {', '.join(without)}.")
