# SPDX-License-Identifier: BSD-3-Clause
"""Tables of errors on data that was not fitted: what varies and what is constant apart, and what they are worth."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from forcetorque.evaluation import Offset
from forcetorque.result import VAGUE_WORDS, Table, table_of, with_first_column, without_vague

if TYPE_CHECKING:
    from forcetorque.analysis.evaluate.evaluate import CandidateErrors
    from forcetorque.analysis.runs.sensor_run import SensorRun

_WORTH = ("independent", "excitation_N", "excitation_Nm")
"""What tells how much an error is worth, in the second table."""

_VARYING = {"offset", "rmse", "force_error_mean_N", "moment_error_mean_Nm"}
"""What the first table has."""

ERROR_WORDS = (
    "per axis: RMSE, and below it the constant part of it; force, moment: mean norm of the error ± half its 95 % "
    f"interval ({VAGUE_WORDS}); moved: standard deviation of the load"
)
"""Which number is which."""


def error_tables(
    rows: Sequence[CandidateErrors], caption: str, *, recordings: Sequence[str] | None = None
) -> Iterator[Table]:
    """Put errors into two tables that fit a page.

    Args:
        rows: Errors, at least one row.
        caption: What they are of.
        recordings: Recording of every row; None where there is one for all.

    Yields:
        RMSE per axis with norms; and mean errors per axis of the same candidates, where the offset is not that of the
        judged samples themselves, which leaves none, with what tells how much the errors are worth.
    """
    yield _named(without_vague(table_of(rows, caption, leave_out={"bias", *_WORTH})), recordings)
    kept = [k for k, row in enumerate(rows) if row.offset is not Offset.JUDGED_MEAN]
    names = None if recordings is None else [recordings[k] for k in kept]
    shown = table_of([rows[k] for k in kept], "mean error, by its own offset", leave_out=_VARYING)
    yield _named(shown, names)


def smoothing_words(run: SensorRun) -> str:
    """Say whether reading and reference are smoothed before they are compared.

    Args:
        run: The sensor.

    Returns:
        The words.
    """
    smoothing = run.experiment.processing.smoothing
    return "not smoothed" if smoothing is None else f"reading and reference smoothed over {smoothing.window_s:g} s"


def _named(table: Table, recordings: Sequence[str] | None) -> Table:
    return table if recordings is None else with_first_column(table, "recording", recordings)
