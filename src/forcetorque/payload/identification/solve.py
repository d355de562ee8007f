# SPDX-License-Identifier: BSD-3-Clause
"""Solve a problem of known loads."""

from __future__ import annotations

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError
from forcetorque.base.pose import skew
from forcetorque.payload.identification.bias_drift_and_jumps import bias_tests, choose_drift
from forcetorque.payload.identification.estimation_problem import INERTIAL, Load, LoadProblem
from forcetorque.payload.identification.frame_unit_and_clock_errors import hypotheses
from forcetorque.payload.identification.load_estimates import (
    BiasRow,
    LoadEstimate,
    LoadSolution,
    OutlierRow,
    VariableRow,
    six,
)
from forcetorque.payload.identification.measurement_model import inertial, instants
from forcetorque.payload.identification.parameter_vector import Kind, inertia_of, places, six_of
from forcetorque.payload.identification.robust_fit import Fit, fit
from forcetorque.payload.identification.unobservable_parameters import open_directions, spanned_by

_NAMED = 0.5
"""Rows that count less than this are named."""


def solve(problem: LoadProblem) -> LoadSolution:
    """Estimate everything that the rows tell, with intervals, and name what they leave open.

    Nothing is refused because the rows tell it badly: its interval is wide, or infinite.

    Returns:
        The solution.

    Raises:
        FitError: If there is no row.
    """
    if not len(problem.rows):
        raise FitError("rows: expected at least one reading under a load, got none")
    drift = choose_drift(problem)
    fitted = fit(problem, drift=drift.taken)
    half = fitted.half_width
    return LoadSolution(
        loads=load_estimates(fitted),
        sessions=session_estimates(fitted),
        variables=tuple(_variable(fitted, number, half) for number in range(len(problem.variables))),
        mount=fitted.guess.rotation,
        mount_half_width=_or_zero(fitted, Kind.MOUNT, half, 3),
        tilt=_or_zero(fitted, Kind.TILT, fitted.guess.values, 2),
        tilt_half_width=_or_zero(fitted, Kind.TILT, half, 2),
        response=fitted.guess.response,
        guess=fitted.guess,
        parameters=tuple(one.name for one in fitted.guess.parameters),
        covariance=fitted.covariance,
        residual=fitted.residual,
        weight=fitted.weight,
        open_directions=open_directions(fitted),
        disagreeing=_disagreeing(fitted),
        drift=drift,
        bias_tests=bias_tests(fitted, drift=drift.taken),
        hypotheses=hypotheses(fitted, drift=drift.taken),
        spanned=spanned_by(fitted),
    )


def load_estimates(fitted: Fit) -> tuple[LoadEstimate, ...]:
    """Give the loads of a fit.

    Returns:
        Loads, in the order of the problem.
    """
    return tuple(_load(fitted, number, fitted.half_width) for number in range(len(fitted.problem.loads)))


def session_estimates(fitted: Fit) -> tuple[BiasRow, ...]:
    """Give the biases of a fit.

    Returns:
        Sessions, in the order of the problem.
    """
    return tuple(_session(fitted, number, fitted.half_width) for number in range(len(fitted.problem.sessions)))


def _or_zero(fitted: Fit, kind: Kind, values: FloatArray, count: int) -> FloatArray:
    own = places(fitted.guess.parameters, kind)
    return values[own] if own else np.zeros(count)


def _load(fitted: Fit, number: int, half: FloatArray) -> LoadEstimate:
    load, guess, listed = fitted.problem.loads[number], fitted.guess, fitted.guess.parameters
    own = [k for kind in (Kind.MASS, Kind.FIRST_MOMENT, Kind.INERTIA) for k in places(listed, kind, number)]
    if not own and not load.is_known:
        return _absent(load)
    values, change = inertial(load, number, guess)
    covariance = np.zeros((INERTIAL, INERTIAL))
    is_open = fitted.is_open[own]
    inner = fitted.covariance[np.ix_(own, own)]
    inner[is_open] = inner[:, is_open] = 0.0
    covariance = change @ inner @ change.T
    unknown = (change[:, is_open] != 0.0).any(axis=1)
    values = np.where(unknown, np.nan, values)
    covariance[unknown] = covariance[:, unknown] = np.inf
    mass, first = float(values[0]), values[1:4]
    centre = first / mass if mass else np.zeros(3) if load.centre_of_mass is None else load.centre_of_mass
    # inertia about the centre of mass: I + m hat(c)^2
    inertia = inertia_of(values[4:]) + mass * skew(centre) @ skew(centre)
    widening = _widening(fitted, own, half)
    return LoadEstimate(
        name=load.name,
        mass=mass,
        mass_half_width=float(half[places(listed, Kind.MASS, number)][0]) if load.mass is None else 0.0,
        first_moment=first,
        centre_of_mass=centre,
        centre_of_mass_half_width=_centre_half_width(load, covariance, mass, centre, widening),
        inertia=inertia,
        inertia_half_width=_inertia_half_width(load, covariance, mass, centre, widening),
        covariance=covariance,
        estimated=bool(own),
    )


def _widening(fitted: Fit, own: list[int], half: FloatArray) -> float:
    """Half-widths over standard errors: the worst quantile of the load's unknowns."""
    error = np.sqrt(np.diag(fitted.covariance)[own])
    known = np.isfinite(error) & (error > 0.0)
    return float((half[own][known] / error[known]).max(initial=0.0))


def _centre_half_width(
    load: Load, covariance: FloatArray, mass: float, centre: FloatArray, widening: float
) -> FloatArray:
    """Of the ratio of first moment and mass, by its change with both; shape (3,); m."""
    if load.centre_of_mass is not None or mass == 0.0:
        return np.zeros(3)
    if not np.isfinite(mass):
        return np.full(3, np.inf)
    change = np.hstack([-centre[:, None], np.eye(3)]) / mass
    half = np.full(3, np.inf)
    for k in range(3):
        used = [0, 1 + k]
        if np.isfinite(covariance[np.ix_(used, used)]).all():
            half[k] = widening * np.sqrt(change[k, used] @ covariance[np.ix_(used, used)] @ change[k, used])
    return half


def _inertia_half_width(
    load: Load, covariance: FloatArray, mass: float, centre: FloatArray, widening: float
) -> FloatArray:
    """Of the inertia about the centre of mass, `I + hat(h)^2 / m`, by its change with all ten; shape (3, 3); kg m2."""
    if not isinstance(load.inertia, str):
        return np.zeros((3, 3))
    if not np.isfinite(covariance).all() or mass == 0.0:
        return np.full((3, 3), np.inf)
    hat, axes = skew(centre), skew(np.eye(3))
    by_first = six_of(axes @ hat + hat @ axes)
    change = np.hstack([-six_of(hat @ hat)[:, None], by_first.T, np.eye(6)])
    return inertia_of(widening * np.sqrt(np.einsum("ia,ab,ib->i", change, covariance, change)))


def _absent(load: Load) -> LoadEstimate:
    """A load that no row has, and that is not stated."""
    return LoadEstimate(
        name=load.name,
        mass=np.nan,
        mass_half_width=np.inf,
        first_moment=np.full(3, np.nan),
        centre_of_mass=np.full(3, np.nan),
        centre_of_mass_half_width=np.full(3, np.inf),
        inertia=np.full((3, 3), np.nan),
        inertia_half_width=np.full((3, 3), np.inf),
        covariance=np.full((INERTIAL, INERTIAL), np.inf),
        estimated=True,
    )


def _session(fitted: Fit, number: int, half: FloatArray) -> BiasRow:
    problem, listed = fitted.problem, fitted.guess.parameters
    bias, drift = places(listed, Kind.BIAS, number), places(listed, Kind.DRIFT, number)
    values = np.where(np.isfinite(half), fitted.guess.values, np.nan)
    mine = problem.rows.session == number
    return BiasRow(
        session=problem.sessions[number],
        observations=int(mine.sum()),
        at_s=float(instants(problem.rows)[mine].mean()) if mine.any() else None,
        bias=six(values[bias]) if bias else (None,) * 6,
        bias_half_width_95=six(half[bias]) if bias else (None,) * 6,
        drift_per_s=six(values[drift]) if drift else None,
        drift_half_width_95_per_s=six(half[drift]) if drift else None,
    )


def _variable(fitted: Fit, number: int, half: FloatArray) -> VariableRow:
    own = places(fitted.guess.parameters, Kind.VARIABLE, number)
    values = np.where(np.isfinite(half), fitted.guess.values, np.nan)
    return VariableRow(
        variable=fitted.problem.variables[number], coefficients=six(values[own]), half_width_95=six(half[own])
    )


def _disagreeing(fitted: Fit) -> tuple[OutlierRow, ...]:
    return tuple(
        OutlierRow(
            observation=fitted.problem.rows.names[k],
            session=fitted.problem.sessions[fitted.problem.rows.session[k]],
            weight=float(fitted.weight[k]),
            residual=fitted.residual[k],
        )
        for k in np.flatnonzero(fitted.weight < _NAMED)
    )
