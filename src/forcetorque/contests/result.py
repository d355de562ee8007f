# SPDX-License-Identifier: BSD-3-Clause
"""Rows of a contest: a contestant, its errors under every load, a pair, and what could not take part."""

from __future__ import annotations

from typing import Annotated

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.noise.paired_comparison import Judgement
from forcetorque.contests.methods import Reader
from forcetorque.contests.pairs import Parts, RatedPair, rms_intervals
from forcetorque.contests.phases import Trial, changes, repeatability
from forcetorque.results.number_text import finite_or_none
from forcetorque.results.row import Row, Shown, ShownWrench, WrenchValues


class ContestantRow(Row):
    """What one contestant reached on loads that nobody was fitted on."""

    contestant: Annotated[str, Shown("contestant")]
    """Its name."""
    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    method: str
    """Its method."""
    source: str
    """What it is read by, in words."""
    runs: int
    """Runs that judged it."""
    fitted_loads_kg: tuple[float, ...]
    """Loads that it was fitted on; kg."""
    rank: Annotated[int, Shown("rank")]
    """Rank by force and moment together: one more than the contestants that err less beyond doubt."""
    error_percent: Annotated[float, Shown("error", "% of the loads", digits=2)]
    """Root mean square error of force over the judged force and of moment over the judged moment, together; %."""
    force_error_N: Annotated[float, Shown("force", "N", digits=3)]
    """Root mean square norm of the force error."""
    rank_force: Annotated[int, Shown("rank, force")]
    """Rank by it."""
    moment_error_Nm: Annotated[float, Shown("moment", "N m", digits=4)]
    """Root mean square norm of the moment error."""
    rank_moment: Annotated[int, Shown("rank, moment")]
    """Rank by it."""
    rmse: WrenchValues
    """Root mean square error per component, all loads together: its accuracy; N, N m."""
    repeatability: WrenchValues | None
    """Standard deviation between runs with one load, at the same phases: its precision; none where none was
    repeated."""
    full_scale: WrenchValues | None
    """Full scale; N, N m; none where nobody says."""
    rmse_percent_of_full_scale: WrenchValues | None
    """Root mean square error over the full scale; %."""
    drift_per_hour: WrenchValues | None
    """Change of the mean error from run to run; N, N m per h; none where it cannot be told."""
    drift_per_hour_half_width_95: WrenchValues | None
    """Half of its 95 % interval."""
    drift_per_degC: WrenchValues | None
    """The same with the temperature of the sensor; N, N m per degC."""
    drift_per_degC_half_width_95: WrenchValues | None
    """Half of its 95 % interval."""


class ContestScoreRow(Row):
    """One score of one contestant, for tables of six components."""

    contestant: Annotated[str, Shown("contestant")]
    """Its name."""
    score: Annotated[str, Shown("score")]
    """What the numbers are."""
    values: Annotated[WrenchValues, ShownWrench(digits=4)]
    """The numbers."""


class ContestLoadRow(Row):
    """Errors of a contestant under one load."""

    contestant: Annotated[str, Shown("contestant")]
    """Its name."""
    load_kg: Annotated[float, Shown("load", "kg", digits=2)]
    """Mass that hung there."""
    rmse: Annotated[WrenchValues, ShownWrench(digits=4)]
    """Root mean square error over the phases; N, N m."""
    rmse_low: WrenchValues | None
    """Lower end of its 95 % interval; none where too few stretches tell any."""
    rmse_high: WrenchValues | None
    """Upper end."""


class ContestPairRow(Row):
    """Two contestants."""

    contestant: Annotated[str, Shown("contestant")]
    """One."""
    other: Annotated[str, Shown("against")]
    """The other."""
    error_of: Annotated[str, Shown("error of")]
    """`wrench` (force and moment over the loads, together), `force` or `moment`."""
    ratio: Annotated[float, Shown("ratio", digits=2)]
    """Root mean square error of the one over that of the other."""
    ratio_low: Annotated[float | None, Shown("at least", digits=2)]
    """Lower end of an interval that holds for all pairs at once with 95 %."""
    ratio_high: Annotated[float | None, Shown("at most", digits=2)]
    """Upper end."""
    stretches: Annotated[int, Shown("stretches")]
    """Independent stretches of the motion that the interval comes from, of all loads."""
    judgement: Annotated[Judgement, Shown("judgement")]
    """What the interval says of the one."""


class LeftOutRow(Row):
    """A contestant that could not take part."""

    contestant: Annotated[str, Shown("contestant")]
    """Its name."""
    method: Annotated[str, Shown("method")]
    """Its method."""
    why: Annotated[str, Shown("what it lacks")]
    """Why."""


def contestant_row(
    reader: Reader,
    loads: dict[float, tuple[Trial, ...]],
    parts: Parts,
    common: BoolArray,
    *,
    scale: tuple[float, float],
    places: tuple[int, int, int],
) -> ContestantRow:
    """Say what a contestant reached.

    Args:
        reader: The contestant.
        loads: Its runs by load.
        parts: Their squared errors.
        common: Phases that all runs have; shape (p,).
        scale: Root mean square force and moment that were judged; N, N m.
        places: Its ranks by wrench, force and moment.

    Returns:
        The row.
    """
    entry, squares = reader.entry, parts.squares.mean(axis=(0, 1))
    rmse = np.sqrt(squares)
    force, moment = float(np.sqrt(squares[:3].sum())), float(np.sqrt(squares[3:].sum()))
    change = changes(loads)
    hour, degree = change.get("per hour"), change.get("per degC")
    sensor = reader.judged[0][1].sensor
    return ContestantRow(
        contestant=entry.name,
        sensor=sensor.name,
        serial=sensor.serial,
        method=entry.method.value,
        source=reader.correction.source,
        runs=sum(map(len, loads.values())),
        fitted_loads_kg=reader.fitted_loads_kg,
        rank=places[0],
        error_percent=100.0 * float(np.hypot(force / scale[0], moment / scale[1])),
        force_error_N=force,
        rank_force=places[1],
        moment_error_Nm=moment,
        rank_moment=places[2],
        rmse=rmse,
        repeatability=repeatability(loads, common),
        full_scale=entry.full_scale,
        rmse_percent_of_full_scale=None if entry.full_scale is None else 100.0 * rmse / entry.full_scale,
        drift_per_hour=None if hour is None else hour.per_unit,
        drift_per_hour_half_width_95=None if hour is None else hour.half_width,
        drift_per_degC=None if degree is None else degree.per_unit,
        drift_per_degC_half_width_95=None if degree is None else degree.half_width,
    )


def load_rows(name: str, loads: dict[float, tuple[Trial, ...]], parts: Parts) -> list[ContestLoadRow]:
    """Say how a contestant errs under every load.

    Args:
        name: The contestant.
        loads: Its runs by load.
        parts: Their squared errors.

    Returns:
        A row per load.
    """
    rows = []
    for load, squares in zip(loads, parts.squares, strict=True):
        rms, low, high = rms_intervals(squares)
        known = bool(np.isfinite(high).all())
        rows.append(
            ContestLoadRow(
                contestant=name,
                load_kg=load,
                rmse=rms,
                rmse_low=low if known else None,
                rmse_high=high if known else None,
            )
        )
    return rows


def pair_row(pair: RatedPair) -> ContestPairRow:
    """Write a pair.

    Args:
        pair: The pair.

    Returns:
        Its row.
    """
    known = finite_or_none(pair.ratio.high) is not None
    return ContestPairRow(
        contestant=pair.first,
        other=pair.second,
        error_of=pair.quantity,
        ratio=pair.ratio.ratio,
        ratio_low=pair.ratio.low if known else None,
        ratio_high=pair.ratio.high if known else None,
        stretches=pair.ratio.stretches,
        judgement=pair.ratio.judgement,
    )


def score_rows(rows: tuple[ContestantRow, ...]) -> list[ContestScoreRow]:
    """Put the scores of six components below each other.

    Args:
        rows: The contestants.

    Returns:
        A row per contestant and score that is known.
    """
    scores: tuple[tuple[str, str], ...] = (
        ("accuracy, RMS", "rmse"),
        ("% of full scale", "rmse_percent_of_full_scale"),
        ("precision, SD", "repeatability"),
        ("drift per hour", "drift_per_hour"),
        ("  ±", "drift_per_hour_half_width_95"),
        ("drift per degC", "drift_per_degC"),
        ("  ±", "drift_per_degC_half_width_95"),
    )
    shown: list[tuple[str, str, FloatArray | None]] = [
        (row.contestant, words, getattr(row, field)) for row in rows for words, field in scores
    ]
    return [
        ContestScoreRow(contestant=n, score=words, values=values) for n, words, values in shown if values is not None
    ]
