# SPDX-License-Identifier: BSD-3-Clause
"""What to record next, so that a sensor errs less at the loads of its use."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FitError, require_known
from forcetorque.evaluation.load_cases.load_case import LoadCase, operating_load_cases
from forcetorque.evaluation.load_cases.predicted_error import PredictedError, predict_from_posterior
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.expected_sensor_errors import ACCURACY_SHARE, Assumptions, quadratic_scale
from forcetorque.experiment.calibration.robot_model_error import EXACT
from forcetorque.experiment.calibrations_under_test import OneCalibration, one_named
from forcetorque.experiment.campaign import Campaign, Runs
from forcetorque.experiment.raw_counts import prior_size_of
from forcetorque.experiment.recording_notes import with_recording_notes
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.planning.information import Knowledge, Nuisance, unfitted_posterior
from forcetorque.planning.posture_search import Criterion
from forcetorque.planning.proposed_recordings import (
    TEMPERATURE,
    Demand,
    Effort,
    Proposal,
    proposals,
    supports_of,
    workplaces,
)
from forcetorque.planning.result import (
    PlannedPosture,
    PlannedRecording,
    advice,
    limits_of,
    posture_rows,
    posture_tables,
    recording_row,
    recordings_table,
)
from forcetorque.planning.section import PLAN, PlanTable
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Table

RECORDINGS, SECONDS = 3, 60.0
"""Recordings that are planned unless told otherwise, and about how long each is."""
_QUICK = Effort(postures=150, swaps=0)


class Plan(DrawnResult):
    """Recordings, the most useful first, and what is expected after each."""

    drawn_by: ClassVar[str] = "forcetorque.planning.figures:plan_figure"

    answered_by: ClassVar[str | None] = "forcetorque.planning.answers:plan_answer"

    schema_name: Literal["forcetorque/plan/1"] = Field(default="forcetorque/plan/1", alias="schema")
    """Form of the result."""
    sensor: str
    """Name of the sensor."""
    serial: str
    """Its serial number."""
    load_case: str
    """Load case whose error is lowered."""
    loads: str
    """Its loads, as text."""
    start: Literal["calibration", "prior"]
    """What is known before: a calibration, or the prior matrix alone."""
    advice: str
    """What to record first and what it brings, or why nothing helps."""
    recordings: tuple[PlannedRecording, ...]
    """What to record, in this order."""
    postures: tuple[PlannedPosture, ...]
    """Postures of all recordings."""
    limits: tuple[str, ...]
    """Assumptions, and what was not checked."""
    folder: str | None = None
    """Where the trajectories were written."""
    proposals: tuple[Proposal, ...] = Field(default=(), exclude=True)
    """The recordings with their trajectories."""

    def blocks(self) -> Iterator[Table | str]:
        """Give what people read: recordings, postures, and sentences.

        Yields:
            Tables and sentences.
        """
        yield f"{self.sensor} ({self.serial}), to be used for {self.load_case}: {self.loads}"
        if self.recordings:
            yield recordings_table(self.recordings)
            yield from posture_tables(self.postures)
        yield self.advice
        yield from self.limits


@with_recording_notes
def plan(
    runs: Runs,
    calibration: OneCalibration | None = None,
    *,
    load_case: str | None = None,
    clearance_deg: float | None = None,
    recordings: int = RECORDINGS,
    seconds: float | None = None,
    effort: Effort | None = None,
    progress: Callable[[str], None] = lambda _: None,
) -> Plan:
    """Plan recordings that lower the predicted error at a load case most, one after the other.

    Args:
        runs: The sensor, in one experiment or several.
        calibration: What is known of it, alone or by its name; None for its prior matrix.
        load_case: Name of the load case; the one that is furthest from what is allowed if left out.
        clearance_deg: What joints keep away from their limits; that of `[plan]` if left out; deg.
        recordings: How many recordings.
        seconds: About how long each may be; 60 if None; s.
        effort: How long to look for them.
        progress: Called with what is being done.

    Returns:
        The plan.

    Raises:
        ExperimentError: If no clearance is given, limits contradict each other, or nothing can move.
        FitError: If the calibration has no covariance, or there is no prior to begin with.
    """
    _, fitted = one_named(calibration)
    start = _start(runs, fitted, load_case)
    table = _table(start.runs)
    demand = Demand(
        criterion=Criterion(case=start.case),
        seconds=_seconds(SECONDS if seconds is None else seconds, table),
        hold_s=table.hold_s,
        effort=effort or Effort(),
    )
    places = workplaces(start.runs[0], table, _clearance(table, clearance_deg), supports_of(start.runs, table))
    wanted = proposals(
        places,
        start.known,
        demand,
        recordings=recordings,
        temperatures=_temperatures(table, start),
        progress=progress,
    )
    planned: list[Proposal] = []
    rows: list[PlannedRecording] = []
    before = start.error
    for number, best in enumerate(wanted, start=1):
        after = predict_from_posterior(best.after.posterior, start.case)
        planned.append(best)
        rows.append(recording_row(number, best, before, after, start.case))
        before = after
    known = planned[-1].after
    return Plan(
        sensor=start.runs[0].sensor.name,
        serial=start.runs[0].sensor.serial,
        load_case=start.case.name,
        loads=start.case.words,
        start="prior" if calibration is None else "calibration",
        advice=advice(rows, start.known.posterior, known.posterior, demand.criterion, places),
        recordings=tuple(rows),
        postures=tuple(row for k, one in enumerate(planned, 1) for row in posture_rows(k, one)),
        limits=limits_of(
            calibrated=calibration is not None,
            posterior=start.known.posterior,
            tolerance=start.runs[0].experiment.fit_options.tolerance,
        ),
        proposals=tuple(planned),
    )


def plan_sentence(runs: Runs, calibration: Calibration | None = None, *, load_case: str | None = None) -> str:
    """Advise in a sentence or two what to record next; quick, for assessments.

    Args:
        runs: The sensor, in one experiment or several.
        calibration: What is known of it; None for its prior matrix.
        load_case: Name of the load case.

    Returns:
        What to record first and what it brings; without a clearance what to state to have it planned.
    """
    table = _table(_runs(runs))
    if table.clearance_deg is None:
        return "state clearance_deg in [plan] of the experiment file, and `forcetorque plan` says what to record next"
    return plan(runs, calibration, load_case=load_case, recordings=1, effort=_QUICK).advice


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Start:
    """What is known before."""

    runs: Sequence[SensorRun]
    known: Knowledge
    case: LoadCase
    error: PredictedError


def _start(runs: Runs, calibration: Calibration | None, load_case: str | None) -> _Start:
    own = _runs(runs)
    variables = [variable.linear for variable in own[0].sensor.variables]
    if calibration is None:
        matrix, assumptions = _assumed(own[0], None)
        posterior, seconds = unfitted_posterior(matrix, assumptions, variables), 0.0
    else:
        calibration.require_serial(own[0].sensor.serial)
        if calibration.posterior is None:
            raise FitError(
                f"a plan needs a calibration with a covariance, got one of type {calibration.estimation_type!r}; fit "
                "it by the generative model, the default of `forcetorque calibrate`, or leave it out"
            )
        matrix, assumptions = _assumed(own[0], calibration)
        posterior = calibration.posterior
        seconds = sum(span.end_ns - span.start_ns for span in calibration.provenance.intervals) * 1e-9
    cases = operating_load_cases(own, matrix=None if calibration is None else calibration.matrix)
    errors = [predict_from_posterior(posterior, case) for case in cases]
    place = _chosen(cases, errors, load_case)
    exact = own[0].experiment.fit_options.tolerance == EXACT
    size = quadratic_scale(with_prior=own[0].sensor.prior is not None, exact=exact)
    nuisance = Nuisance.of(matrix, assumptions, with_prior=posterior.space == "wrench", size=size)
    known = Knowledge.of(posterior, seconds=seconds, nuisance=nuisance)
    return _Start(runs=own, known=known, case=cases[place], error=errors[place])


def _chosen(cases: Sequence[LoadCase], errors: Sequence[PredictedError], wanted: str | None) -> int:
    names = [case.name for case in cases]
    if not cases:
        raise ExperimentError(
            "a plan needs loads of use: no distal link of the sensor has a mass; state a [[load_case]]"
        )
    if wanted is None:
        ratios = [_excess(case, error) for case, error in zip(cases, errors, strict=True)]
        return int(np.argmax(ratios))
    require_known(wanted, names, ExperimentError, f"no load case of the sensor is called {wanted!r}")
    return names.index(wanted)


def _excess(case: LoadCase, error: PredictedError) -> float:
    force, moment = case.requirement
    return max(error.force.typical / force, error.moment.typical / moment)


def _assumed(run: SensorRun, calibration: Calibration | None) -> tuple[FloatArray, Assumptions]:
    """The matrix before any recording, that of the calibration without one, and what is known beside it."""
    sensor, options = run.sensor, run.experiment.fit_options
    sensor.require_six_components("a plan")
    matrix, scale = sensor.prior, sensor.full_scale
    if matrix is None and calibration is not None:
        matrix = calibration.matrix
    if matrix is not None and sensor.prior_source != "identity":
        scale = np.full(matrix.shape[1], sensor.limit_counts)
    elif scale is None and options.accuracy is not None and (options.accuracy > 0.0).all():
        scale = options.accuracy / ACCURACY_SHARE
    if scale is None:
        raise ExperimentError(
            f"sensor {sensor.name!r}: expected a prior matrix or full_scale of [[sensor]], by which to say what is "
            "known before any recording; or name a calibration"
        )
    assumptions = Assumptions(
        full_scale=scale,
        accuracy=options.accuracy,
        repeatability=options.repeatability,
        prior_size=prior_size_of(sensor, scale),
    )
    return np.eye(6) if matrix is None else matrix, assumptions


def _runs(runs: Runs) -> Sequence[SensorRun]:
    own = runs.runs if isinstance(runs, Campaign) else (runs,) if isinstance(runs, SensorRun) else tuple(runs)
    if not own:
        raise ExperimentError("expected at least one run of a sensor, got none; name an experiment file")
    for run in own[1:]:
        if (run.sensor.name, run.sensor.serial) != (own[0].sensor.name, own[0].sensor.serial):
            raise ExperimentError(
                f"expected experiments of one sensor, got {own[0].sensor.name!r} ({own[0].sensor.serial}) and "
                f"{run.sensor.name!r} ({run.sensor.serial})"
            )
    return own


def _table(runs: Sequence[SensorRun]) -> PlanTable:
    if not all(run.experiment.stands for run in runs):
        raise ExperimentError("plan: expected [robot] with a [[support]] at rest, whose joints can be moved")
    tables = [table for run in runs if (table := run.experiment.section(PLAN)) is not None]
    if any(table != tables[0] for table in tables[1:]):
        raise ExperimentError("plan: the experiment files state several [plan] that differ; state it in one of them")
    return tables[0] if tables else PlanTable()


def _clearance(table: PlanTable, given: float | None) -> float:
    clearance = table.clearance_deg if given is None else given
    if clearance is None:
        raise ExperimentError(
            "plan: expected a clearance from the joint limits, in deg; state clearance_deg in [plan] of the experiment "
            "file, or by --clearance-deg, from Python clearance_deg"
        )
    if not 0.0 <= clearance < np.inf:
        raise ExperimentError(f"plan: expected a clearance of at least 0 deg, got {clearance:g}")
    return clearance


def _seconds(seconds: float, table: PlanTable) -> float:
    if not 4.0 * (table.hold_s + 1.0) <= seconds < np.inf:
        raise ExperimentError(
            f"plan: expected recordings of at least {4.0 * (table.hold_s + 1.0):g} s, for a few postures, got "
            f"{seconds:g} s"
        )
    return seconds


def _temperatures(table: PlanTable, start: _Start) -> list[tuple[float, float] | None]:
    """A recording at the first of the temperatures, and one from the lowest to the highest."""
    values = table.temperatures
    if not values:
        return [None]
    if TEMPERATURE not in start.known.posterior.variables:
        raise ExperimentError(
            f"plan: temperatures: sensor {start.runs[0].sensor.name!r} was fitted without the variable "
            f"{TEMPERATURE!r}; add a [[sensor.variable]] of that name, or leave them out"
        )
    steady = (values[0], values[0])
    return [steady] if len(set(values)) == 1 else [steady, (min(values), max(values))]
