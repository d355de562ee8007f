# SPDX-License-Identifier: BSD-3-Clause
"""What the rows leave open, in words: which unknowns are told only together, or not at all, and what to do about it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.payload.identification.estimation_problem import LoadProblem
from forcetorque.payload.identification.measurement_model import load_wrench
from forcetorque.payload.identification.parameter_vector import AXES, Kind, Parameter
from forcetorque.payload.identification.robust_fit import Fit

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
