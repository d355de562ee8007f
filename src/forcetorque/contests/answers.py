# SPDX-License-Identifier: BSD-3-Clause
"""The answer of `bench contest` in a few lines: who errs least, and how surely."""

from __future__ import annotations

from typing import TYPE_CHECKING

from forcetorque.results.answer import Answer, Concern

if TYPE_CHECKING:
    from forcetorque.contests.contest_scores import Contest
    from forcetorque.contests.contestant_errors_and_comparison import ContestPairRow


_NAMED = 5
"""Contestants that are named; the others are counted."""


def contest_answer(contest: Contest) -> Answer:
    """Give the answer."""
    rows = contest.contestants
    errors = ", ".join(f"{row.contestant} {row.error_percent:.2g} %" for row in rows[:_NAMED])
    more = f" and {len(rows) - _NAMED} more" if len(rows) > _NAMED else ""
    loads = ", ".join(f"{load:g}" for load in contest.loads_kg)
    lacking = len(contest.left_out)
    left = f"; {lacking} could not take part" if lacking else ""
    won = f"LEAST ERROR: {contest.winner}" if contest.winner is not None else "NONE ERRS LEAST"
    return Answer(
        subject=f"{contest.contest}, loads of {loads} kg",
        verdict=won if contest.comparable else "NOT COMPARABLE",
        why=(f"error in % of the loads of all: {errors}{more}", f"{_ratios(contest)}{left}"),
        written=(contest.figure_file,),
        concern=Concern.NONE if contest.winner is not None else Concern.UNCERTAIN,
    )


def _ratios(contest: Contest) -> str:
    """How the first compares with the nearest of the others."""
    pairs = [pair for pair in contest.pairs if pair.error_of == "wrench"]
    first = contest.contestants[0].contestant
    against = [pair for pair in pairs if first in (pair.contestant, pair.other)] or pairs
    return "; ".join(_pair(pair) for pair in against[:2])


def _pair(pair: ContestPairRow) -> str:
    ends = (
        ""
        if pair.ratio_low is None or pair.ratio_high is None
        else f" (95 %: {pair.ratio_low:.2f} to {pair.ratio_high:.2f})"
    )
    return f"{pair.contestant} errs {pair.ratio:.2f} times as much as {pair.other}{ends}: {pair.conclusion}"
