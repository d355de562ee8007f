# SPDX-License-Identifier: BSD-3-Clause
"""Loads and biases with their intervals from a problem of known loads, and what its samples leave unobservable."""

from __future__ import annotations

from collections.abc import Sequence

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
from forcetorque.payload.identification.measurement_model import inertial, instants, load_wrench
from forcetorque.payload.identification.parameter_vector import AXES, Kind, Parameter, inertia_of, places, six_of
from forcetorque.payload.identification.robust_fit import Fit, fit

_TAKES_PART = 1e-4
"""Unknowns with less than this part of the largest one of a direction have no part in it."""
_UNKNOWN_BY = 0.5
"""A mass is not told if its interval is as wide as this part of it to either side."""
_REACH_M = 0.05
"""A centre of mass is not told if its interval is as wide to either side; m."""
_RANK = 1e-3
"""Directions of wrench that the loads move by less than this part of the strongest one are not spanned."""
_LEVER_M = 0.1
"""Lever at which a moment counts as much as a force where directions are compared; m."""

_ADVICE = {
    Kind.MASS: "turn the sensor about two level axes, so that gravity moves in its axes, or state the mass",
    Kind.FIRST_MOMENT: "turn the sensor about two level axes, so that gravity moves in its axes",
    Kind.INERTIA: "turn the load with changing speed about every axis, or leave the inertia out",
    Kind.MATRIX: "record a load with its centre of mass elsewhere",
    Kind.MOUNT: "turn the sensor about two level axes",
    Kind.TILT: "turn the sensor about two level axes",
    Kind.VARIABLE: "record the same pose at another value of it",
    Kind.DRIFT: "come back to an earlier pose later in the session",
    Kind.BIAS: "record more rows in that session",
}


_SCALE = "state the mass of one load: known masses give the scale"


def open_directions(fitted: Fit) -> tuple[str, ...]:
    """Name what is open.

    Returns:
        Directions that no row tells, and loads that are told too vaguely to be of use.
    """
    return (*_untold(fitted), *_vague(fitted))


def _untold(fitted: Fit) -> list[str]:
    listed = fitted.guess.parameters
    groups: dict[tuple[object, ...], list[FloatArray]] = {}
    for direction in _reduced(fitted.unobservable):
        share = np.abs(direction) > _TAKES_PART * np.abs(direction).max()
        chosen = [one for one, part in zip(listed, share, strict=True) if part]
        groups.setdefault(tuple(dict.fromkeys((one.kind, one.owner) for one in chosen)), []).append(direction)
    return [_named(fitted, directions) for directions in groups.values()]


def _reduced(free: FloatArray) -> FloatArray:
    """Row echelon form of the open directions, loads first: each then has as few unknowns as can be; shape (k, p)."""
    rows = free.T.copy()
    done = 0
    for column in range(rows.shape[1]):
        if done == len(rows):
            break
        pivot = done + int(np.abs(rows[done:, column]).argmax())
        if abs(rows[pivot, column]) < 1e-5 * np.abs(rows[pivot]).max():
            continue
        rows[[done, pivot]] = rows[[pivot, done]]
        rows[done] /= rows[done, column]
        others = np.arange(len(rows)) != done
        rows[others] -= np.outer(rows[others, column], rows[done])
        done += 1
    rows[np.abs(rows) < 1e-7] = 0.0
    return rows


def _named(fitted: Fit, directions: Sequence[FloatArray]) -> str:
    listed = fitted.guess.parameters
    total = np.abs(np.array(directions))
    share = (total > _TAKES_PART * total.max(axis=1, keepdims=True)).any(axis=0)
    chosen = [one for one, part in zip(listed, share, strict=True) if part]
    kinds = list(dict.fromkeys((one.kind, one.owner) for one in chosen))
    words = [_words(fitted.problem, kind, owner, chosen, directions, listed) for kind, owner in kinds]
    together = "is not told" if len(words) == 1 else "are told only together"
    advice = _SCALE if {kind for kind, _ in kinds} >= {Kind.MASS, Kind.MATRIX} else _ADVICE[kinds[0][0]]
    return f"{' and '.join(words)} {together}: {advice}"


def _words(
    problem: LoadProblem,
    kind: Kind,
    owner: int,
    chosen: Sequence[Parameter],
    directions: Sequence[FloatArray],
    listed: Sequence[Parameter],
) -> str:
    own = [one for one in chosen if one.kind is kind and one.owner == owner]
    if kind in (Kind.MASS, Kind.INERTIA):
        return f"the {kind} of {problem.loads[owner].name!r}"
    if kind is Kind.FIRST_MOMENT:
        vectors = [_vector(direction, kind, owner, listed) for direction in directions]
        along = f"along {vector_words(vectors[0])}" if len(vectors) == 1 else f"along {_axes(own)}"
        return f"the centre of mass of {problem.loads[owner].name!r} {along}"
    if kind in (Kind.BIAS, Kind.DRIFT):
        forces, moments = any(one.component < 3 for one in own), any(one.component > 2 for one in own)
        of = "" if len(problem.sessions) == 1 else f" of session {problem.sessions[owner]!r}"
        if len(directions) == 1 and forces != moments:
            vector = _vector(directions[0], kind, owner, listed)
            along = vector_words(vector[:3]) if forces else vector_words(vector[3:])
            return f"the {kind}{of} {'along' if forces else 'about'} {along}"
        return f"the {kind}{of} in {' and '.join(['force'] * forces + ['moment'] * moments)}"
    return {Kind.MATRIX: "the matrix", Kind.MOUNT: "the mount", Kind.TILT: "the tilt"}.get(kind) or (
        f"what {problem.variables[owner]} does"
    )


def _vector(direction: FloatArray, kind: Kind, owner: int, listed: Sequence[Parameter]) -> FloatArray:
    vector = np.zeros(6 if kind in (Kind.BIAS, Kind.DRIFT) else 3)
    for one, part in zip(listed, direction, strict=True):
        if one.kind is kind and one.owner == owner:
            vector[one.component] = part
    return vector


def _axes(own: Sequence[Parameter]) -> str:
    return ", ".join(AXES[k] for k in sorted({one.component % 3 for one in own}))


def vector_words(vector: FloatArray) -> str:
    """Name a direction in space.

    Args:
        vector: Shape (3,).

    Returns:
        The axis, or components of the unit vector.
    """
    unit = vector / np.linalg.norm(vector)
    k = int(np.abs(unit).argmax())
    if abs(unit[k]) > 0.9995:
        return AXES[k]
    return "({:.2f}, {:.2f}, {:.2f})".format(*(np.round(unit * np.sign(unit[k]), 2) + 0.0))  # no -0.00


def _vague(fitted: Fit) -> list[str]:
    listed, half, values = fitted.guess.parameters, fitted.half_width, fitted.guess.values
    vague = []
    for k, one in enumerate(listed):
        load = fitted.problem.loads[one.owner].name if one.kind in (Kind.MASS, Kind.FIRST_MOMENT) else ""
        if one.kind is Kind.MASS and np.isfinite(half[k]) and half[k] > _UNKNOWN_BY * abs(values[k]):
            vague.append(f"the mass of {load!r} is told only to {half[k]:.3g} kg: {_ADVICE[Kind.MASS]}")
        mass = fitted.guess.of(Kind.MASS, one.owner)
        weight = float(mass[0]) if len(mass) else fitted.problem.loads[one.owner].mass if load else None
        if one.kind is Kind.FIRST_MOMENT and weight and np.isfinite(half[k]) and half[k] > _REACH_M * abs(weight):
            vague.append(
                f"the centre of mass of {load!r} along {AXES[one.component]} is told only to "
                f"{1e3 * half[k] / abs(weight):.0f} mm: {_ADVICE[Kind.FIRST_MOMENT]}"
            )
    return vague


def spanned_directions(wrench: FloatArray, session: np.ndarray) -> int:
    """Count the directions of wrench that loads move, as a matrix would need them: one centre of mass moves three.

    Args:
        wrench: Wrenches of the loads; shape (n, 6); N, N m.
        session: Power-up of each row, which has a bias of its own; shape (n,).

    Returns:
        From 0 to 6.
    """
    moved = wrench.copy()
    for number in np.unique(session):
        mine = session == number
        moved[mine] -= moved[mine].mean(axis=0)
    strengths = np.linalg.svd(moved * np.repeat([1.0, 1.0 / _LEVER_M], 3), compute_uv=False)
    return int((strengths > _RANK * strengths.max(initial=0.0)).sum()) if strengths.max(initial=0.0) > 0.0 else 0


def spanned_by(fitted: Fit) -> int:
    """Count the directions of wrench that the loads of a fit move.

    Returns:
        From 0 to 6.
    """
    return spanned_directions(load_wrench(fitted.problem, fitted.guess), fitted.problem.rows.session)


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
    at_s = instants(problem.rows)[mine]
    return BiasRow(
        session=problem.sessions[number],
        observations=int(mine.sum()),
        at_s=float(at_s.mean()) if mine.any() else None,
        length_s=float(np.ptp(at_s)) if mine.any() else None,
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
