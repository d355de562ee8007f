# SPDX-License-Identifier: BSD-3-Clause
"""Rows of what a study comes to."""

from __future__ import annotations

from typing import Annotated

from forcetorque.experiment.offset_policy import Offset
from forcetorque.results.row import Row, Shown, WrenchValues


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
    """Offset from the first second of the judged interval, or that of the fitted data."""
    best: ChosenCandidate
    """Smallest mean contact force."""
    by_axis: tuple[AxisChoice, ...]
    """Smallest mean absolute value of every component."""
    by_axis_unfitted: UnfittedLoad
    """What the matrix of these rows makes of loads that were not fitted."""
    across_sessions: tuple[SessionChoice, ...]
    """The same choice, made and scored on different sessions; empty if there is only one."""
