# SPDX-License-Identifier: BSD-3-Clause
"""A contest of sensors and methods through one motion under loads that none was fitted on, and its rows."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.errors import ExperimentError, FitError, SensorError, SerialNumberError, ShapeError
from forcetorque.contests.contest_file import Entries
from forcetorque.contests.contestant_errors_and_comparison import (
    ContestPairRow,
    Phases,
    Reader,
    compared_pairs,
    contestant_reader,
    contestant_trials,
    mean_squares,
    ranks_and_winner,
    rms_intervals,
)
from forcetorque.contests.phases_and_runs_by_load import (
    Trial,
    by_load,
    changes,
    common_phases,
    repeatability,
    require_same_motion,
)
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Row, Shown, ShownWrench, Table, WrenchValues, optional_table, table_of


class ContestantRow(Row):
    """What one contestant reached on loads that were not fitted."""

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
    """Number of its validation runs."""
    fitted_loads_kg: tuple[float, ...]
    """Loads that it was fitted on; kg."""
    rank: Annotated[int, Shown("rank")]
    """Rank by force and moment together: one more than the number of contestants with significantly smaller errors."""
    error_percent: Annotated[float, Shown("error", "% of the loads of all", digits=2)]
    """Root mean square error of force over the judged force and of moment over the judged moment of all contestants,
    together; %."""
    validated_N: Annotated[float, Shown("validated", "N", digits=1)]
    """Root mean square force about its mean that this contestant was judged by."""
    validated_Nm: float
    """The same of the moment; N m."""
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
    """Full scale; N, N m; none where it is not stated."""
    rmse_percent_of_full_scale: WrenchValues | None
    """Root mean square error over the full scale; %."""
    drift_per_hour: WrenchValues | None
    """Change of the mean error from run to run; N, N m per h; none where the samples do not determine it."""
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
    """Mass of the carried load."""
    rmse: Annotated[WrenchValues, ShownWrench(digits=4)]
    """Root mean square error over the phases; N, N m."""
    rmse_low: WrenchValues | None
    """Lower end of its 95 % interval; none where there are too few segments."""
    rmse_high: WrenchValues | None
    """Upper end."""


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
    squares: FloatArray,
    common: BoolArray,
    *,
    scale: tuple[float, float],
    judged: tuple[float, float],
    ranks: tuple[int, int, int],
) -> ContestantRow:
    """Compute the scores of a contestant.

    Args:
        reader: The contestant.
        loads: Its runs by load.
        squares: Their squared errors by `mean_squares`; shape (loads, q, 6).
        common: Phases that all runs have; shape (p,).
        scale: Root mean square force and moment that were judged; N, N m.
        judged: Its own judged force and moment; N, N m.
        ranks: Its ranks by wrench, force and moment.

    Returns:
        The row.
    """
    entry, mean = reader.entry, squares.mean(axis=(0, 1))
    rmse = np.sqrt(mean)
    force, moment = float(np.sqrt(mean[:3].sum())), float(np.sqrt(mean[3:].sum()))
    drift = changes(loads)
    per_hour, hour_half_width = drift.get("per hour", (None, None))
    per_degree, degree_half_width = drift.get("per degC", (None, None))
    sensor = reader.judged[0][1].sensor
    return ContestantRow(
        contestant=entry.name,
        sensor=sensor.name,
        serial=sensor.serial,
        method=entry.method.value,
        source=reader.correction.source,
        runs=sum(map(len, loads.values())),
        fitted_loads_kg=reader.fitted_loads_kg,
        rank=ranks[0],
        error_percent=100.0 * float(np.hypot(force / scale[0], moment / scale[1])),
        validated_N=judged[0],
        validated_Nm=judged[1],
        force_error_N=force,
        rank_force=ranks[1],
        moment_error_Nm=moment,
        rank_moment=ranks[2],
        rmse=rmse,
        repeatability=repeatability(loads, common),
        full_scale=entry.full_scale,
        rmse_percent_of_full_scale=None if entry.full_scale is None else 100.0 * rmse / entry.full_scale,
        drift_per_hour=per_hour,
        drift_per_hour_half_width_95=hour_half_width,
        drift_per_degC=per_degree,
        drift_per_degC_half_width_95=degree_half_width,
    )


def load_rows(name: str, loads: dict[float, tuple[Trial, ...]], squares: FloatArray) -> list[ContestLoadRow]:
    """Compute the errors of a contestant under every load.

    Args:
        name: The contestant.
        loads: Its runs by load.
        squares: Their squared errors by `mean_squares`; shape (loads, q, 6).

    Returns:
        A row per load.
    """
    rows = []
    for load, of_load in zip(loads, squares, strict=True):
        rms, low, high = rms_intervals(of_load)
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


def score_rows(rows: tuple[ContestantRow, ...]) -> list[ContestScoreRow]:
    """Put the scores of six components below each other.

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


SAME_LOAD_KG = 0.1
"""A judged load that differs by less from a fitted one was fitted on; they come in steps of 5 kg."""

_RATES = (
    "intervals of all pairs hold together with 95 %: of contests without a difference at most 5 % rank anybody, and of "
    "contests whose errors differ by a quarter or more at most 5 % call a pair equal (no difference); inconclusive: "
    "too few, or too unlike, segments of the motion"
)


class Contest(DrawnResult):
    """Who errs less than whom."""

    drawn_by: ClassVar[str] = "forcetorque.contests.figures:contest_figure"
    drawn_fields: ClassVar[tuple[str, ...]] = ("loads",)
    answered_by: ClassVar[str | None] = "forcetorque.contests.answers:contest_answer"

    schema_name: Literal["forcetorque/contest/2"] = Field(default="forcetorque/contest/2", alias="schema")
    """Form of the result."""
    contest: str
    """Name of the contest."""
    offset: str
    """Which offset all were evaluated with."""
    phases: int
    """Phases of the motion that all runs have."""
    loads_kg: tuple[float, ...]
    """Validation loads, on which no contestant was fitted; kg."""
    comparable: bool
    """Whether all carry one load: the forces that judge them differ by 25 % at most, the moments by a factor of 2."""
    winner: str | None
    """The contestant with significantly smaller errors than every other, by force and moment together; none where there
    is none, or they are not comparable."""
    contestants: tuple[ContestantRow, ...]
    """Contestants, the best first."""
    loads: tuple[ContestLoadRow, ...]
    """Their errors under every load."""
    pairs: tuple[ContestPairRow, ...]
    """Every contestant against every other."""
    left_out: tuple[LeftOutRow, ...]
    """Those that lack what their method needs."""

    def blocks(self) -> Iterator[Table | str]:
        """Give ranks, scores, errors by load and pairs.

        Yields:
            Tables and sentences.
        """
        loads = ", ".join(f"{load:g}" for load in self.loads_kg)
        judged = f"loads of {loads} kg, on which no contestant was fitted, in {self.phases} phases"
        yield table_of(self.contestants, f"{self.contest}: {judged}; offset {self.offset}")
        yield from self._verdict()
        yield table_of(score_rows(self.contestants), "scores by component, all loads together")
        yield table_of(self.loads, "root mean square error under every load")
        yield table_of([pair for pair in self.pairs if pair.error_of == "wrench"], "pairs, force and moment together")
        yield _RATES
        yield from optional_table(self.left_out, "could not take part")

    def _verdict(self) -> Iterator[str]:
        best = [row.contestant for row in self.contestants if row.rank == 1]
        if not self.comparable:
            yield "not comparable: the contestants do not carry one load, and errors are in % of the loads of all"
        elif self.winner is not None:
            yield f"{self.winner} errs least, significantly"
        else:
            yield f"no contestant wins significantly; in the first place: {'; '.join(best)}"
        for pair in self.pairs:
            if pair.error_of == "wrench" and pair.conclusion == "no difference":
                yield f"{pair.contestant} and {pair.other} are equal: {pair.ratio:.2f}, {_ends(pair)}"

    def records(self) -> list[dict[str, object]]:
        """Give contestants, then pairs, as flat lines.

        Returns:
            The lines; `row` says what each is.
        """
        rows: tuple[tuple[str, Sequence[ContestantRow | ContestPairRow]], ...] = (
            ("contestant", self.contestants),
            ("pair", self.pairs),
        )
        return [{"row": kind, **row.flat()} for kind, lines in rows for row in lines]


def _ends(pair: ContestPairRow) -> str:
    if pair.ratio_low is None or pair.ratio_high is None or pair.ratio_low == pair.ratio_high:
        return "the same in every sample"
    return f"{pair.ratio_low:.2f} to {pair.ratio_high:.2f}"


def ranking(entries: Entries, *, code_version: str, created: str) -> Contest:
    """Let sensors and methods meet on the same loads.

    Errors are averaged over phases of the motion, squared and pooled over runs with one load before anything is
    compared.

    Args:
        entries: Who meets, and on what.
        code_version: Version of this library, for the record of what is fitted.
        created: Date and time, ISO 8601, for the same.

    Returns:
        Ranks, scores and pairs; contestants that lack what their method needs are named, the others go on.

    Raises:
        ExperimentError: If fewer than two can be judged, on loads that all share and no contestant was fitted on.
    """
    readers, left_out = _readers(entries, code_version=code_version, created=created)
    judged_loads = _require_unfitted(readers)
    phases = Phases(entries.phases)
    trials = {reader.entry.name: contestant_trials(reader, phases, entries.offset) for reader in readers}
    require_same_motion(phases.paths, phases=entries.phases)
    common = common_phases(trials)
    loads = {name: by_load(own) for name, own in trials.items()}
    squares = {name: mean_squares(own, common) for name, own in loads.items()}
    judged = {name: _judged(own, common) for name, own in trials.items()}
    scale_N, scale_Nm = np.sqrt(np.mean([np.square(own) for own in judged.values()], axis=0)).tolist()
    scale = (scale_N, scale_Nm)
    pairs = compared_pairs(squares, scale=scale)
    ranks, winner = ranks_and_winner(tuple(squares), pairs)
    rows = [
        contestant_row(
            reader,
            loads[name],
            squares[name],
            common,
            scale=scale,
            judged=judged[name],
            ranks=ranks[name],
        )
        for reader in readers
        for name in [reader.entry.name]
    ]
    rows.sort(key=lambda row: (row.rank, row.error_percent))
    unlike = tuple(_unlike(rows))
    return Contest(
        contest=entries.name,
        offset=entries.offset.value,
        phases=int(common.sum()),
        loads_kg=judged_loads,
        comparable=not unlike,
        winner=None if unlike else winner,
        contestants=tuple(rows),
        loads=tuple(row for name in squares for row in load_rows(name, loads[name], squares[name])),
        pairs=tuple(pairs),
        left_out=tuple(left_out),
        warnings=(*unlike, *_warnings(rows)),
    )


def _readers(entries: Entries, *, code_version: str, created: str) -> tuple[list[Reader], list[LeftOutRow]]:
    readers: list[Reader] = []
    left_out: list[LeftOutRow] = []
    for entry in entries.contestants:
        try:
            readers.append(contestant_reader(entry, entries.runs, code_version=code_version, created=created))
        except (ExperimentError, FitError, SensorError, SerialNumberError, ShapeError) as error:
            left_out.append(LeftOutRow(contestant=entry.name, method=entry.method.value, why=str(error)))
    every = {load for reader in readers for load in _loads(reader)}
    for reader in tuple(readers):
        lacking = sorted(load for load in every if load not in _loads(reader))
        if lacking:
            readers.remove(reader)
            why = f"no validation run has it under {', '.join(f'{load:g}' for load in lacking)} kg, as others are"
            left_out.append(LeftOutRow(contestant=reader.entry.name, method=reader.entry.method.value, why=why))
    if len(readers) < 2:
        reasons = "; ".join(f"{row.contestant}: {row.why}" for row in left_out)
        raise ExperimentError(
            f"contest {entries.name!r}: expected at least two contestants that can be evaluated under the same loads, "
            f"got {len(readers)}; {reasons}"
        )
    return readers, left_out


def _loads(reader: Reader) -> tuple[float, ...]:
    return tuple(sorted({run.load_kg for run, _ in reader.judged}))


def _require_unfitted(readers: Sequence[Reader]) -> tuple[float, ...]:
    """Refuse loads that favour one contestant because it was fitted on them."""
    for reader in readers:
        for load in reader.fitted_loads_kg:
            runs = [run.name for other in readers for run, _ in other.judged if abs(run.load_kg - load) < SAME_LOAD_KG]
            if runs:
                raise ExperimentError(
                    f"{runs[0]}: expected validation loads that no contestant was fitted on, got {load:g} kg, on which "
                    f"{reader.entry.name!r} was; such a load favours it: validate with another weight, or fit on "
                    "others (fitted_on)"
                )
    return _loads(readers[0])


def _judged(trials: Sequence[Trial], common: BoolArray) -> tuple[float, float]:
    """Root mean square force and moment about their means that judge a contestant; N, N m."""
    references = np.concatenate([trial.reference[common] for trial in trials])
    moved = references - references.mean(axis=0)
    return (
        float(np.sqrt((moved[:, :3] ** 2).sum(axis=1).mean())),
        float(np.sqrt((moved[:, 3:] ** 2).sum(axis=1).mean())),
    )


_ONE_LOAD = 1.25
"""Ratio of judged forces up to which sensors carry one load: errors that differ by as much count as equal."""
_ONE_STACK = 2.0
"""Ratio of judged moments up to which they do: sensors of one stack have unlike levers, by which it is 1.6 on the
device of the thesis."""


def _unlike(rows: Sequence[ContestantRow]) -> Iterator[str]:
    """How forces and moments that judge the contestants differ; nothing where they carry one load."""
    for judged, unit, most_unlike in (("validated_N", "N", _ONE_LOAD), ("validated_Nm", "N m", _ONE_STACK)):
        least, *_, most = sorted(rows, key=lambda row: float(getattr(row, judged)))
        low, high = getattr(least, judged), getattr(most, judged)
        if high > most_unlike * low:
            yield (
                f"{most.contestant} is judged by {high:.3g} {unit}, {least.contestant} by {low:.3g} {unit}: they do "
                f"not carry one load, and who carries less errs less in {unit}; mount them where they carry the same"
            )


def _warnings(rows: Sequence[ContestantRow]) -> Iterator[str]:
    if all(row.repeatability is None for row in rows):
        yield "no load was repeated: precision and drift are unobservable; repeat a run"
    without = [row.contestant for row in rows if row.full_scale is None]
    if without and len(without) < len(rows):
        yield f"no percent of full scale for {', '.join(without)}: state catalogue or full_scale"
