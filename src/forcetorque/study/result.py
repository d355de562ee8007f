# SPDX-License-Identifier: BSD-3-Clause
"""Result of studies: records of the choice, its worth on other sessions, and warnings on loads not fitted."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.experiment.validation_offset import KNOWN_BEFORE, Offset
from forcetorque.results.number_text import number, with_error
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import COMPONENTS, Row, RowOfSensor, Shown, Table, WrenchValues, table_of
from forcetorque.study import thesis_tables as tables
from forcetorque.study.candidate_errors import LEVER_M, PUSH_N, PushError, push_error
from forcetorque.study.candidate_fits import WORKBENCH, Study
from forcetorque.study.candidate_selection import CONVENTION, FAR_SD
from forcetorque.study.study import SensorStudy


class FittedCombination(Row):
    """Calibration intervals that were fitted together."""

    name: str
    """Name."""
    intervals: tuple[str, ...]
    """Labels of the intervals."""
    samples: int
    """Number of samples."""
    excited: int
    """Directions of the raw readings that the loads move."""
    channels: int
    """Number of raw channels."""


class UnfittedLoad(Row):
    """What a matrix makes of pushes of 50 N in random directions, with levers up to 0.3 m."""

    push_force_N: float | None
    """Mean norm of the force error; None where the true matrix is not known."""
    push_moment_Nm: float | None
    """Mean norm of the moment error; None where the true matrix is not known."""
    deviation_sd: float | None
    """How far it reads them from the generative fit of the same data, in standard deviations that this predicts: the
    largest component; None where there is no such fit."""


class ChosenCandidate(Row):
    """A candidate, or the workbench matrix, with its mean contact force over all validation data."""

    name: str
    """Data set, type and lambda of (5.4); `workbench` for the prior."""
    lambda_counts2: float | None
    """Lambda of (5.4), as `calibrate` counts it; counts2; None, as the next two, for a generative fit and the prior."""
    table_lambda_counts2: float | None
    """The same as the tables of the thesis count it, a sixth; counts2."""
    relative_lambda: float | None
    """The same over the mean variance of the raw channels."""
    force_mean_N: float
    """Mean norm of the contact force."""
    force_mean_error_N: float
    """Standard error of that mean, from blocks of time."""
    moment_mean_Nm: float
    """Mean norm of the contact moment."""
    mean_absolute: WrenchValues
    """Mean absolute value per component; N, N m."""
    unfitted: UnfittedLoad
    """What it makes of loads that were not fitted."""


class AxisChoice(Row):
    """The best candidate of one axis."""

    axis: str
    """Component."""
    name: str
    """Data set, type and lambda."""
    mean_absolute: float
    """Its mean absolute value; N, N m."""
    workbench: float | None
    """That of the workbench matrix, offset from the first second."""


class SessionChoice(Row):
    """A choice made on all other sessions, scored on one."""

    session: Annotated[str, Shown("scored on")]
    """Session."""
    samples: Annotated[int, Shown("samples")]
    """Number of its samples."""
    chosen: Annotated[str, Shown("chosen on the other sessions")]
    """Candidate that is best by magnitude on the other sessions."""
    force_mean_N: Annotated[float, Shown("force", "N", digits=3)]
    """Its mean norm of the contact force on this session."""
    workbench_force_mean_N: Annotated[float | None, Shown("workbench", "N", digits=3)]
    """That of the workbench matrix, offset from the first second."""
    by_axis: tuple[str, ...]
    """Candidates that are best on the other sessions, per component."""
    mean_absolute: WrenchValues
    """Their mean absolute value on this session; N, N m."""


class ModeChoice(Row):
    """What is best in one offset mode."""

    offset: Offset
    """Offset from the first second of the validation interval, or that of the fitted data."""
    best: ChosenCandidate
    """Smallest mean contact force."""
    by_axis: tuple[AxisChoice, ...]
    """Smallest mean absolute value of every component."""
    by_axis_unfitted: UnfittedLoad
    """What the matrix of these rows makes of loads that were not fitted."""
    across_sessions: tuple[SessionChoice, ...]
    """The same choice, made and scored on different sessions; empty if there is only one."""


_WORSE = 1.05
"""Error of a push over that of the workbench matrix, from which on a matrix made the sensor worse."""


def unfitted_load(study: Study, rows: Sequence[int]) -> UnfittedLoad:
    """Evaluate a model that takes its six rows from models of a study.

    Args:
        study: The study.
        rows: Index of the model that gives each row.

    Returns:
        What it makes of loads that were not fitted.
    """
    push = _push(study, rows)
    deviation = max(_deviations(study, rows), default=None)
    return UnfittedLoad(
        push_force_N=None if push is None else push.force_N,
        push_moment_Nm=None if push is None else push.moment_Nm,
        deviation_sd=deviation,
    )


def unfitted_warnings(sensor: SensorStudy) -> Iterator[str]:
    """Say which choices make the sensor worse, or may, at loads that were not fitted.

    Yields:
        A sentence per choice and reason.
    """
    study = sensor.study
    for offset in KNOWN_BEFORE:
        choice = study.choices[offset]
        for name, rows in (
            (f"best, offset {offset}", (choice.by_magnitude,) * 6),
            (f"best by axis, offset {offset}", choice.by_axis),
        ):
            for sentence in (*_harmful(study, rows), *_far(study, rows)):
                yield f"{sensor.data.identity.name}: {name}: {sentence}"


def _harmful(study: Study, rows: Sequence[int]) -> Iterator[str]:
    push = _push(study, rows)
    before = None if study.workbench is None else study.push_error(len(study.models) - 1)
    if push is None or before is None or push.over(before) <= _WORSE:
        return
    yield (
        f"a push of {PUSH_N:g} N with a lever up to {LEVER_M:g} m errs by {_words(push)}, with the workbench matrix by "
        f"{_words(before)}: it is worse than no calibration where loads were not fitted; {_instead(study, rows)}"
    )


def _far(study: Study, rows: Sequence[int]) -> Iterator[str]:
    deviations = dict(zip(WRENCH_COMPONENTS, _deviations(study, rows), strict=False))
    beyond = [name for name, value in deviations.items() if value > FAR_SD]
    if beyond:
        yield (
            f"a push of {PUSH_N:g} N reads {max(deviations.values()):.1f} standard deviations away from the estimate "
            f"of prior and data together ({', '.join(beyond)}): a load that was not fitted may be measured wrong; "
            f"{_instead(study, rows)}"
        )


def _instead(study: Study, rows: Sequence[int]) -> str:
    """Name the generative fit of the same data, which keeps the prior where no load speaks."""
    used = {study.candidates[index].data_set for index in rows}
    fits = {fit.data_set: k for k, fit in enumerate(study.generative, start=len(study.fits.candidates))}
    # of the data sets of several rows the largest tells the most
    samples = {c.moments.count: c.name for c in study.fits.combinations if c.name in used and c.name in fits}
    if not samples:
        return "keep the workbench matrix, or record loads along the directions that lack them"
    index = fits[samples[max(samples)]]
    push = study.push_error(index)
    errs = "" if push is None else f" and errs by {_words(push)}"
    return f"the default, {study.name(index)!r}, keeps the prior there{errs}"


def _push(study: Study, rows: Sequence[int]) -> PushError | None:
    if study.truth is None:
        return None
    matrix = np.stack([study.models[index].matrix[axis] for axis, index in enumerate(rows)])
    return push_error(matrix, study.truth)


def _deviations(study: Study, rows: Sequence[int]) -> list[float]:
    """Deviation of every row from the generative fit of its data set; nothing where one has none."""
    if max(rows) >= len(study.candidates):
        return []
    values = [float(study.push_deviations[index, axis]) for axis, index in enumerate(rows)]
    return values if np.isfinite(values).all() else []


def _words(push: PushError) -> str:
    return f"{push.force_N:.3g} N and {push.moment_Nm:.3g} N m"


class StudiedSensor(RowOfSensor):
    """The study of one sensor."""

    folder: str | None
    """Folder of its files, where they were written."""
    candidates: int
    """Number of matrices fitted by the types of the thesis."""
    generative: int
    """Number of generative fits, one per combination that allows it."""
    validation_samples: int
    """Number of validation samples."""
    combinations: tuple[FittedCombination, ...]
    """What was fitted together."""
    left_out: tuple[str, ...]
    """Types that a combination cannot give, with the reason."""
    workbench: ChosenCandidate | None
    """The prior matrix, offset from the first second; None for a sensor without one."""
    modes: tuple[ModeChoice, ...]
    """The choice in both offset modes."""
    files: tuple[str, ...]
    """Tables, figures and calibrations in the folder."""
    candidate_rows: tuple[dict[str, Any], ...] = Field(exclude=True, repr=False)
    """Everything about every candidate; cells by heading."""

    def blocks(self) -> Iterator[Table | str]:
        """Give the choice, for all axes together, axis by axis and session by session.

        Yields:
            Tables and sentences.
        """
        yield (
            f"{self.sensor} ({self.serial}): {self.candidates} matrices of {len(self.combinations)} data sets and "
            f"{self.generative} generative fits, evaluated on {self.validation_samples} samples that were not fitted"
        )
        yield self._best()
        yield self._by_axis()
        yield from self._unfitted()
        for mode in self.modes:
            if mode.across_sessions:
                caption = f"what to expect on another session, offset {mode.offset}"
                yield table_of(mode.across_sessions, caption)
        for combination in self.combinations:
            if combination.excited < combination.channels:
                moved = f"{combination.excited} of {combination.channels}"
                yield f"{combination.name}: loads move only {moved} raw directions"
        if self.folder is not None:
            yield f"tables, figures and calibrations are in {self.folder}"

    def _best(self) -> Table:
        chosen = [] if self.workbench is None else [(self.workbench, Offset.FIRST_SECOND)]
        chosen += [(mode.best, mode.offset) for mode in self.modes]
        return Table(
            caption="mean contact force where nothing touches; per axis: mean absolute value",
            headings=("candidate", "offset", "force, N", "moment, N m", *COMPONENTS),
            rows=tuple(
                (
                    candidate.name,
                    offset,
                    with_error(candidate.force_mean_N, candidate.force_mean_error_N, digits=3),
                    number(candidate.moment_mean_Nm, 4),
                    *(number(float(value), 3) for value in candidate.mean_absolute),
                )
                for candidate, offset in chosen
            ),
        )

    def _by_axis(self) -> Table:
        return Table(
            caption="best candidate of every axis",
            headings=("axis", "best", "offset", "value", "workbench"),
            rows=tuple(
                (row.axis, row.name, mode.offset, number(row.mean_absolute, 4), number(row.workbench, 4))
                for mode in self.modes
                for row in mode.by_axis
            ),
        )

    def _unfitted(self) -> Iterator[Table]:
        """Give the choices at loads that were not fitted, where anything is known of them."""
        chosen = [(WORKBENCH, "", self.workbench.unfitted)] if self.workbench is not None else []
        for mode in self.modes:
            chosen.append((mode.best.name, mode.offset, mode.best.unfitted))
            chosen.append(("by axis", mode.offset, mode.by_axis_unfitted))
        known = any(load.push_force_N is not None or load.deviation_sd is not None for _, _, load in chosen)
        if known:
            yield Table(
                caption=f"loads that were not fitted: pushes of {PUSH_N:g} N with levers up to {LEVER_M:g} m",
                headings=("candidate", "offset", "error, N", "error, N m", "from the default, s.d."),
                rows=tuple(
                    (
                        name,
                        offset,
                        number(load.push_force_N, 3),
                        number(load.push_moment_Nm, 4),
                        number(load.deviation_sd, 1) + (" far" if (load.deviation_sd or 0.0) > FAR_SD else ""),
                    )
                    for name, offset, load in chosen
                ),
            )


class Studies(DrawnResult):
    """Studies of sensors over the same recordings."""

    drawn_by: ClassVar[str] = "forcetorque.study.figures:studies_figure"
    drawn_fields: ClassVar[tuple[str, ...]] = ("sensors",)
    answered_by: ClassVar[str | None] = "forcetorque.study.answers:study_answers"

    interval_uses = ()

    schema_name: Literal["forcetorque/study/2"] = Field(default="forcetorque/study/2", alias="schema")
    """Form of the result."""
    lambda_convention: str = f"{CONVENTION}; counts2"
    """How lambdas are counted; in the first form of the result names and `--lambda` counted a sixth of it."""
    experiments: tuple[str, ...]
    """Experiment files."""
    folder: str | None
    """Folder with a folder per sensor, where files were written."""
    sensors: tuple[StudiedSensor, ...]
    """One per sensor."""

    def blocks(self) -> Iterator[Table | str]:
        """Give the choice for one sensor after the other.

        Yields:
            Tables and sentences.
        """
        for sensor in self.sensors:
            yield from sensor.blocks()

    def records(self) -> list[dict[str, object]]:
        """Give everything about every candidate as lines.

        Returns:
            A line per sensor and candidate, and one for its workbench matrix.
        """
        return [{"sensor": sensor.sensor, **row} for sensor in self.sensors for row in sensor.candidate_rows]


def studied_sensor(study: SensorStudy) -> StudiedSensor:
    """Summarise the study of a sensor.

    Returns:
        The choice; no files are written.
    """
    core, identity = study.study, study.data.identity
    judged = core.errors[Offset.FIRST_SECOND]
    return StudiedSensor(
        sensor=identity.name,
        serial=identity.serial,
        folder=None,
        candidates=len(core.fits.candidates),
        generative=len(core.generative),
        validation_samples=int(judged.count.sum()),
        combinations=tuple(
            FittedCombination(
                name=combination.name,
                intervals=tuple(combination.labels),
                samples=combination.moments.count,
                excited=sum(combination.excitation.excited),
                channels=combination.moments.channels,
            )
            for combination in core.fits.combinations
        ),
        left_out=study.left_out,
        workbench=None if core.workbench is None else _chosen(core, Offset.FIRST_SECOND, len(core.models) - 1),
        modes=tuple(_mode(core, offset) for offset in KNOWN_BEFORE),
        files=(),
        candidate_rows=tuple(tables.candidate_rows(core)),
    )


def study_warnings(study: SensorStudy) -> tuple[str, ...]:
    """List the warnings about the choice.

    Returns:
        A text per session that is fitted and validated, one per type that a combination cannot give, one per choice
        that makes the sensor worse, or may, at loads that were not fitted, and what experiment files add to their logs.
    """
    fitted = {interval.session for interval in study.data.calibration}
    shared = sorted({interval.session for interval in study.data.validation} & fitted)
    return (
        *(f"session {name!r} is fitted and validated: its score is not that of another session" for name in shared),
        *(f"left out: {sentence}" for sentence in study.left_out),
        *unfitted_warnings(study),
        *study.data.added,
    )


def _mode(study: Study, offset: Offset) -> ModeChoice:
    choice, pooled = study.choices[offset], study.errors[offset].pooled()
    return ModeChoice(
        offset=offset,
        best=_chosen(study, offset, choice.by_magnitude),
        by_axis=tuple(
            AxisChoice(
                axis=component,
                name=study.name(index),
                mean_absolute=float(pooled.mean_absolute[index, axis]),
                workbench=None if study.workbench is None else float(pooled.mean_absolute[-1, axis]),
            )
            for axis, (component, index) in enumerate(zip(WRENCH_COMPONENTS, choice.by_axis, strict=True))
        ),
        by_axis_unfitted=unfitted_load(study, choice.by_axis),
        across_sessions=tuple(
            SessionChoice(
                session=score.session,
                samples=score.samples,
                chosen=study.name(score.chosen),
                force_mean_N=score.force_mean,
                workbench_force_mean_N=score.workbench_force_mean,
                by_axis=tuple(study.name(index) for index in score.by_axis),
                mean_absolute=score.mean_absolute,
            )
            for score in choice.across_sessions
        ),
    )


def _chosen(study: Study, offset: Offset, index: int) -> ChosenCandidate:
    pooled, spread = study.errors[offset].pooled(), study.errors[offset].standard_error()
    # a generative fit, and the workbench, have no lambda
    candidate = study.fits.candidates[index] if index < len(study.fits.candidates) else None
    return ChosenCandidate(
        name=study.name(index),
        table_lambda_counts2=None if candidate is None else candidate.table_lambda,
        lambda_counts2=None if candidate is None else candidate.lambda_counts2,
        relative_lambda=None if candidate is None else candidate.relative_lambda,
        force_mean_N=float(pooled.force_mean[index]),
        force_mean_error_N=float(spread.force_mean[index]),
        moment_mean_Nm=float(pooled.moment_mean[index]),
        mean_absolute=pooled.mean_absolute[index],
        unfitted=unfitted_load(study, (index,) * 6),
    )
