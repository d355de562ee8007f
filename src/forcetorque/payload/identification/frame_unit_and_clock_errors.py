# SPDX-License-Identifier: BSD-3-Clause
"""Other accounts of the same rows, by name: what would explain them better, and what is to be changed for it.

Each is fitted by least squares, as the problem as stated is. They are compared by what they leave of the change of the
readings, forces and moments alike, so that neither a unit nor columns in another order matter.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import FORCE_AND_MOMENT, WRENCH_COMPONENTS, MeasureDirection
from forcetorque.payload.identification.axis_and_mount_errors import axis_errors
from forcetorque.payload.identification.bias_drift_and_jumps import strongest_jump
from forcetorque.payload.identification.estimation_problem import LoadProblem, LoadRows
from forcetorque.payload.identification.load_estimates import HypothesisRow
from forcetorque.payload.identification.measurement_model import first_mount, masses, turn_words, turned_by
from forcetorque.payload.identification.parameter_vector import Kind
from forcetorque.payload.identification.robust_fit import Fit, plain_fit, scales
from forcetorque.robot.mount_estimate import quarter_turns

_BETTER = 0.5
"""A hypothesis is named if it leaves less than this part of what the problem as stated leaves."""
_CLEARLY = 0.2
"""One that is tried in twenty-three ways, or with a lag to choose, must leave less."""
_FAR_M = 2.0
"""Nobody hangs a load farther from a sensor; m."""
_NEAR_M = 1e-3
"""Nobody builds a load whose centre of mass is nearer to the sensor's origin; m (heuristic)."""
_POSES = 0.5
"""Gravity turns by less than this part of itself from row to row where a motion was recorded, not single poses."""
_LESS_FOR_JUMP = 0.7
"""A jump is named if it leaves less than this part: slow noise has small ones everywhere."""
_ROUNDING = 1e-9
"""Where less than this part of the change of the readings is left, it is rounding."""
_EXPLAINED = 0.02
"""Where less than this part of the change of the readings is left, nothing but jumps and lags is looked for."""
_TURNED = 0.1
"""Gravity turns if it is by this part of itself from its mean, on average."""
_MOVED = 0.01
"""The load moves if its acceleration is by this part of itself from its mean in each power-up."""
_SURE = 2.0
"""Half-widths of its interval by which a mass must be below 0 to contradict the sense of the reading."""
_OF_WRENCH_AXES = ("wrench in world axes", "wrench turned twice")
"""Hypotheses that turn the wrench of every row by a rotation of its own."""
_LAGS = np.concatenate([-np.arange(0.1, 2.05, 0.1), np.arange(0.1, 2.05, 0.1)])
"""Lags that are tried; s."""


def hypotheses(fitted: Fit, *, drift: bool) -> tuple[HypothesisRow, ...]:
    """Name what explains the rows better than the problem as stated.

    Where the readings stay while the load moves, the log is frozen, and nothing else is looked for; where no load
    moves, rows tell nothing of frames, clocks and units.

    Args:
        fitted: The problem as stated.
        drift: Whether biases move evenly in time.

    Returns:
        The best first.
    """
    problem, rows = fitted.problem, fitted.problem.rows
    if not _moves(rows):
        return (*_unit_of_gravity(rows), *_stated_as_nothing(problem))
    if np.abs(rows.moved(rows.wrench)).max() <= _ROUNDING * np.abs(rows.wrench).max():
        words = f"all {len(rows)} rows have the same reading: the log is frozen, or nothing was read"
        return (HypothesisRow(name="frozen log", description=words, residual_share=1.0, severity="contradiction"),)
    guess, residual = plain_fit(problem, drift=drift)
    stated = unexplained(rows, residual)
    named = [*_unit_of_gravity(rows), *_of_levers(fitted), *_stated_as_nothing(problem), *_reversed(fitted)]
    if stated > _EXPLAINED:
        for name, words, limit, other in _others(problem):
            left = plain_fit(other, drift=drift)[1]
            share = unexplained(other.rows, left) / stated
            if name in _OF_WRENCH_AXES and not share < limit:
                # where a moment was moved to another point after it was turned, the forces alone come out right
                forces, before = _unexplained(other.rows, left)[0], _unexplained(rows, residual)[0]
                share = forces / before if before > _EXPLAINED and forces < _CLEARLY * before else share
            if share < limit:
                named.append(
                    HypothesisRow(name=name, description=words, residual_share=share, severity="contradiction")
                )
    named += scales(problem, guess, other_sizes=not named)
    named += axis_errors(fitted, permuted=stated > _EXPLAINED, drift=drift) if not named else ()
    named += _lag(problem, residual, drift=drift)
    named += _of_nothing(fitted) if not named else ()
    named += _jump(fitted, residual, drift=drift)
    return tuple(sorted(named, key=lambda one: one.residual_share))


def _moves(rows: LoadRows) -> bool:
    """Whether the load moves within a power-up, or another one is hung."""
    gravity = rows.proper_acceleration
    moved = float(np.sqrt((rows.moved(gravity) ** 2).sum(axis=1).mean()))
    if moved > _MOVED * float(np.linalg.norm(gravity, axis=1).max(initial=0.0)):
        return True
    return len(np.unique(np.stack([rows.session, rows.load]), axis=1).T) > len(np.unique(rows.session))


def unexplained(rows: LoadRows, residual: FloatArray) -> float:
    """Say which part of the change of the readings is left, forces and moments alike.

    Args:
        rows: The rows.
        residual: What is left; shape (n, 6); N, N m.

    Returns:
        Root mean square of both shares; 0 where nothing changes.
    """
    return float(np.sqrt(np.mean(np.square(_unexplained(rows, residual)))))


def _unexplained(rows: LoadRows, residual: FloatArray) -> tuple[float, float]:
    """Shares of the changes of forces and of moments that are left."""
    moved, shares = rows.moved(rows.wrench), []
    for axes in FORCE_AND_MOMENT:
        whole = float((moved[:, axes] ** 2).sum())
        shares.append(float(np.sqrt((residual[:, axes] ** 2).sum() / whole)) if whole > 0.0 else 0.0)
    return shares[0], shares[1]


def _others(problem: LoadProblem) -> Iterator[tuple[str, str, float, LoadProblem]]:
    rows = problem.rows
    swapped = replace(problem, rows=replace(rows, wrench=rows.wrench[:, [3, 4, 5, 0, 1, 2]]))
    yield "swapped columns", "the columns of force and torque are swapped: list force first", _BETTER, swapped
    if rows.orientation is not None:
        world = np.einsum("nij,nj->ni", rows.orientation, rows.proper_acceleration)
        other = np.einsum("nij,nj->ni", rows.orientation, world)
        turned = replace(
            problem, rows=replace(rows, proper_acceleration=other, orientation=rows.orientation.transpose(0, 2, 1))
        )
        words = "the rotation is transposed: it is that of the world in the sensor's axes; state the other sense"
        yield "transposed rotation", words, _BETTER, turned
        words = "the wrench is along the axes of the world, not of the sensor: turn it, or state the other frame"
        yield "wrench in world axes", words, _BETTER, _wrench_turned(problem, rows.orientation.transpose(0, 2, 1))
        words = (
            "the wrench was along the axes of the sensor before it was turned into them: leave [[transform]] out, or "
            "record the field as the controller sends it"
        )
        yield "wrench turned twice", words, _BETTER, _wrench_turned(problem, rows.orientation)
    if not problem.mount:
        turn = min(quarter_turns()[1:], key=lambda turn: float(((turn - first_mount(problem)) ** 2).sum()))
        words = f"the sensor is turned against the axes of the motion: {turn_words(turn)}; state the frames so"
        acceleration = rows.proper_acceleration @ turn.T
        turned = replace(problem, rows=_turned(rows, turn, acceleration), tilt=False)
        yield "turned axes", words, _CLEARLY, turned


def _wrench_turned(problem: LoadProblem, turn: FloatArray) -> LoadProblem:
    """The problem with wrenches that are turned, each by its own rotation; `turn` has shape (n, 3, 3)."""
    rows = problem.rows
    wrench = np.hstack([np.einsum("nij,nj->ni", turn, rows.wrench[:, axes]) for axes in FORCE_AND_MOMENT])
    return replace(problem, rows=replace(rows, wrench=wrench))


def _turned(rows: LoadRows, turn: FloatArray, acceleration: FloatArray) -> LoadRows:
    others: dict[str, Any] = {}
    if rows.angular_velocity_products is not None and rows.angular_acceleration is not None:
        others["angular_velocity_products"] = turn @ rows.angular_velocity_products @ turn.T
        others["angular_acceleration"] = rows.angular_acceleration @ turn.T
    for field in ("columns", "known"):
        values = getattr(rows, field)
        if values is not None:
            others[field] = np.einsum("ij,nj...->ni...", turned_by(turn), values)
    return replace(rows, proper_acceleration=acceleration, orientation=None, **others)


def _reversed(fitted: Fit) -> Iterator[HypothesisRow]:
    """A mass below zero, or a stated one that the readings contradict in sign."""
    problem = fitted.problem
    other = {
        MeasureDirection.CHILD_TO_PARENT: MeasureDirection.PARENT_TO_CHILD,
        MeasureDirection.PARENT_TO_CHILD: MeasureDirection.CHILD_TO_PARENT,
    }[problem.direction]
    words = (
        f"gravity or the sense of the reading is reversed: state measure_direction = {other.value!r}, or turn gravity"
    )
    half = fitted.half_width
    for k, one in enumerate(fitted.guess.parameters):
        if one.kind is Kind.MASS and fitted.guess.values[k] + _SURE * half[k] < 0.0:
            yield HypothesisRow(
                name="reversed direction", description=words, residual_share=1.0, severity="contradiction"
            )
            return
    if all(load.mass is not None for load in problem.loads):
        rows, sign = problem.rows, replace(problem, direction=other)
        stated, turned = (unexplained(rows, plain_fit(one, drift=False)[1]) for one in (problem, sign))
        if turned < _BETTER * stated:
            yield HypothesisRow(
                name="reversed direction", description=words, residual_share=turned / stated, severity="contradiction"
            )


def _unit_of_gravity(rows: LoadRows) -> Iterator[HypothesisRow]:
    """Gravity of another size."""
    size = rows.acceleration_size
    gravity = float(np.median(np.linalg.norm(rows.proper_acceleration, axis=1) if size is None else size))
    if rows.angular_velocity_products is None and not 9.0 < gravity < 10.6:
        words = f"gravity is {gravity:.4g} m/s2: its unit is another one, such as g; state the unit of the column"
        yield HypothesisRow(name="unit of gravity", description=words, residual_share=1.0, severity="contradiction")


def _of_levers(fitted: Fit) -> Iterator[HypothesisRow]:
    """Centres of mass that are surely farther from the sensor's origin, or nearer to it, than any load can be."""
    problem, guess, half = fitted.problem, fitted.guess, fitted.half_width
    for number, (load, mass) in enumerate(zip(problem.loads, masses(problem, guess), strict=True)):
        first = guess.of(Kind.FIRST_MOMENT, number)
        if not len(first) or not np.isfinite(mass):
            continue
        size, error = (
            float(np.linalg.norm(values)) for values in (first, half[guess.index[Kind.FIRST_MOMENT, number]])
        )
        weighed = guess.index.get((Kind.MASS, number), [])
        mass_error = float(half[weighed[0]]) if weighed else 0.0
        if not np.isfinite(error + mass_error):
            continue
        nearest = (size - error) / (abs(mass) + mass_error)
        if nearest > _FAR_M:
            words = (
                f"the centre of mass of {load.name!r} is at least {nearest:.3g} m away: moments may be in N mm, or "
                "forces in kg; state the units of the columns"
            )
            yield HypothesisRow(name="mixed units", description=words, residual_share=1.0, severity="contradiction")
        # the frame of a load on a link has its origin anywhere, at the centre of mass too
        if problem.rows.columns is None and error < size and size + error < _NEAR_M * (abs(mass) - mass_error):
            words = (
                f"the centre of mass of {load.name!r} is {1e3 * size / abs(mass):.2g} mm from the sensor's origin: "
                "moments may be in N m where N mm is stated; state the units of the columns"
            )
            yield HypothesisRow(name="mixed units", description=words, residual_share=1.0, severity="contradiction")


def _stated_as_nothing(problem: LoadProblem) -> Iterator[HypothesisRow]:
    """Loads that weigh nothing by what is stated."""
    if all(load.mass == 0.0 for load in problem.loads):
        words = "all masses are stated as 0: state those of the weights, or leave them out to estimate them"
        yield HypothesisRow(name="no load", description=words, residual_share=1.0, severity="contradiction")


def _of_nothing(fitted: Fit) -> Iterator[HypothesisRow]:
    """Loads that weigh nothing by the readings."""
    problem, half = fitted.problem, fitted.half_width
    gravity = problem.rows.proper_acceleration
    moved = np.linalg.norm(gravity - gravity.mean(axis=0), axis=1).mean()
    turns = bool(moved > _TURNED * np.linalg.norm(gravity, axis=1).max())
    for k, one in enumerate(fitted.guess.parameters):
        if one.kind is Kind.MASS and turns and abs(fitted.guess.values[k]) <= half[k] < np.inf:
            words = f"the mass of {problem.loads[one.owner].name!r} is not told from 0 although gravity turns"
            sentence = f"{words}: nothing hangs on the sensor, or it was not read"
            yield HypothesisRow(name="no load", description=sentence, residual_share=1.0, severity="contradiction")


def _lag(problem: LoadProblem, residual: FloatArray, *, drift: bool) -> Iterator[HypothesisRow]:
    """A reading that is behind the motion, or before it, by a filter or another clock."""
    rows = problem.rows
    if rows.time_s is None or len(rows) < 3 or not (np.diff(rows.time_s) > 0.0).all():
        return
    turned = np.linalg.norm(np.diff(rows.proper_acceleration, axis=0), axis=1)
    if not 0.0 < float(turned.max()) < _POSES * float(np.linalg.norm(rows.proper_acceleration, axis=1).max()):
        return  # poses one after the other say nothing of what was in between
    stated = unexplained(rows, residual)
    if not stated > _ROUNDING:
        return
    shares = []
    for lag in _LAGS:
        late = replace(problem, rows=_behind(rows, rows.time_s, lag), tilt=False)
        shares.append(unexplained(rows, plain_fit(late, drift=drift)[1]) / stated)
    best = int(np.argmin(shares))
    if shares[best] < _BETTER:
        side = "behind" if _LAGS[best] > 0.0 else "ahead of"
        words = (
            f"the reading is about {abs(_LAGS[best]):.1f} s {side} the motion, as a filter or another clock makes it: "
            "shift the clock of the stream, or use rows in which nothing moves"
        )
        yield HypothesisRow(name="lag", description=words, residual_share=float(shares[best]), severity="caution")


def _behind(rows: LoadRows, time_s: FloatArray, lag: float) -> LoadRows:
    """Rows whose motion, turning aside, is that of other instants."""

    def then(values: FloatArray) -> FloatArray:
        columns = [np.interp(time_s - lag, time_s, column) for column in values.reshape(len(rows), -1).T]
        return np.stack(columns, axis=1).reshape(values.shape)

    return replace(
        rows,
        orientation=None,
        proper_acceleration=then(rows.proper_acceleration),
        columns=None if rows.columns is None else then(rows.columns),
        known=None if rows.known is None else then(rows.known),
    )


def _jump(fitted: Fit, residual: FloatArray, *, drift: bool) -> Iterator[HypothesisRow]:
    problem, rows = fitted.problem, fitted.problem.rows
    stated = unexplained(rows, residual)
    jump = strongest_jump(fitted) if stated > _ROUNDING else None
    if jump is None:
        return
    row, axis = jump
    session = np.where(
        (rows.session == rows.session[row]) & (np.arange(len(rows)) >= row),
        len(problem.sessions),
        rows.session,
    )
    name = problem.sessions[int(rows.session[row])]
    cut = replace(problem, rows=replace(rows, session=session), sessions=(*problem.sessions, f"{name}, after the jump"))
    guess, left = plain_fit(cut, drift=drift)
    mass = ", ".join(f"{value:.4g}" for value in masses(cut, guess))
    words = (
        f"the bias jumps in {WRENCH_COMPONENTS[axis]} before {rows.names[row]!r}, as of a sensor that was zeroed, "
        "switched off or touched from there on: give what follows a session of its own, or leave it out if there was "
        f"contact (the mass is {mass} kg then)"
    )
    share = unexplained(rows, left) / stated
    if share < _LESS_FOR_JUMP:
        yield HypothesisRow(name="jump", description=words, residual_share=share, severity="caution")
