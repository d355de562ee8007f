# SPDX-License-Identifier: BSD-3-Clause
"""Fit a load problem: linearise, estimate under the noise, repeat; robust weights and prior distributions."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.noise.slow_noise import SHAPES, SlowNoise
from forcetorque.base.units import MAD_TO_DEVIATION, SI_FACTORS
from forcetorque.base.wrench import FORCE, MOMENT
from forcetorque.payload.identification.estimate_under_noise import (
    Estimate,
    Group,
    estimate,
    groups_of,
    noise_sizes,
    sizes_under,
)
from forcetorque.payload.identification.estimation_problem import LoadProblem
from forcetorque.payload.identification.load_estimates import HypothesisRow
from forcetorque.payload.identification.measurement_model import changes, expected, first_mount, inertial, load_wrench
from forcetorque.payload.identification.parameter_vector import OF_LOAD, Guess, Kind, places, unknowns_of

FALSE_ALARMS = 0.01
"""Share of problems without a fault in which some row is said to disagree."""
_MEDIAN = 5.348
"""Median of chi-squared of six degrees of freedom."""
_LEAST_LEFT = 1e-6
"""Rows of which the fit leaves less than this part to be told by the others say nothing of themselves."""
_LEAST_WEIGHT = 1e-4
_AXES = 6
_LEAST_NOISE = 0.1
"""Noise of an axis, over that of the noisiest of its three, that medians of few rows are not trusted below."""
_EXACT = 1e-12
"""Distances below this are of rows without noise, which leave rounding only."""


def in_best_shapes(
    groups: tuple[Group, Group], basis: FloatArray, estimate: Estimate
) -> Iterator[tuple[Group, SlowNoise, float, FloatArray, FloatArray]]:
    """Weigh what the fit leaves by the covariance of the best shape of the noise.

    What the best shapes alone would have estimated is taken off, not the mean of all shapes: only then is the
    covariance of what is left that of these shapes, less what `estimate.of_best_shapes` takes.

    Args:
        groups: Forces and moments, at the estimate.
        basis: Directions that were estimated; shape (p, r).
        estimate: What was estimated.

    Yields:
        Each group with the shape of its noise V and the variance s of the white part; `V^-1 X / s` of the directions,
        shape (3 n, r); and `V^-1 e / s` of what is left, shape (3 n,).
    """
    for group, noise, variance in zip(groups, estimate.shapes, estimate.variances, strict=True):
        known = group.line.solve(group.design @ basis, noise)[0] / variance
        left = group.line.solve(group.values[:, None], noise)[0][:, 0] / variance
        yield group, noise, variance, known, left - known @ estimate.apart[0]


def row_distances(groups: tuple[Group, Group], basis: FloatArray, estimate: Estimate, weight: FloatArray) -> FloatArray:
    """Hold every row against what all others, and the slow noise around it, say of it.

    Args:
        groups: Forces and moments, at the estimate.
        basis: Directions that were estimated; shape (p, r).
        estimate: What was estimated.
        weight: What every row counted; shape (n,). A distance does not depend on that of its own row.

    Returns:
        Squared distances over what they are of sound rows in the middle of six axes, chi-squared of six degrees; shape
        (n,).
    """
    total = np.zeros(len(groups[0].values) // 3)
    for group, noise, variance, known, left in in_best_shapes(groups, basis, estimate):
        alone = group.line.precision_diagonal(noise) / variance
        own = alone - np.einsum("nr,rs,ns->n", known, estimate.of_best_shapes, known)
        checked = own > _LEAST_LEFT * alone
        own = np.where(checked, own, 1.0)
        # `left / own` is the error when all others foretell the value, of variance `1 / own` with its weight
        counted, white = weight[group.order], variance / group.line.share
        expected_square = np.maximum(1.0 / own - (1.0 - counted) * white, counted * white)
        np.add.at(total, group.order, np.where(checked, (left / own) ** 2 / expected_square, 0.0))
    middle = float(np.median(total)) / _MEDIAN
    return total / middle if middle > _EXACT else np.zeros_like(total)


def row_weights(distance: FloatArray) -> FloatArray:
    """Weigh rows down that are too far.

    Args:
        distance: Squared distances, as of `row_distances`; shape (n,).

    Returns:
        From 0 to 1, 1 up to a distance that chance makes in one of a hundred problems, then falling with the square of
        the distance; shape (n,).
    """
    from scipy.special import fdtri  # here because importing it takes longer than most commands

    n = max(len(distance), 1)
    limit = 6.0 * float(fdtri(6.0, max(n - 3.0, 1.0), 1.0 - FALSE_ALARMS / n))
    return np.clip(limit / np.maximum(distance, limit), _LEAST_WEIGHT, 1.0)


_NEAR = 0.02
"""Part by which a factor may be off one that a unit makes."""
_MOST = 2.0
"""No sensor that was ever calibrated reads more times what is there, or less."""
_SURE = 4.0
"""Standard errors by which a factor must lie beyond."""


def _ratios(si: str) -> dict[float, str]:
    """In words what unit readings seem to be in, by what they are over what they should be."""
    factors = {unit: factor for unit, (own, factor) in SI_FACTORS.items() if own == si != unit}
    words = {factor: f"in {si}, not in {unit}" for unit, factor in factors.items()}
    words |= {1.0 / factor: f"in {unit}" for unit, factor in factors.items()}  # what is read for the unit itself rules
    return words | ({1.0 / factors["kgf"]: "in kg: multiply by 9.80665 m/s2"} if "kgf" in factors else {})


_UNITS = {si: _ratios(si) for si in ("N", "N m")}


def scales(problem: LoadProblem, guess: Guess, *, other_sizes: bool) -> Iterator[HypothesisRow]:
    """Name forces and moments that are a multiple of what the stated loads demand.

    Args:
        problem: Readings and loads.
        guess: What least squares make of it.
        other_sizes: Whether multiples count that no unit makes.

    Yields:
        An account for each, `mixed units` where a unit makes that multiple, else `another size`; none where a mass is
        not stated, and of moments none where a centre of mass is not.
    """
    if not problem.loads or any(load.mass is None for load in problem.loads):
        return
    demanded = load_wrench(problem, guess)
    kinds = [(FORCE, "forces", "mass_kg", "N")]
    if all(load.mass == 0.0 or load.centre_of_mass is not None for load in problem.loads):
        kinds.append((MOMENT, "moments", "centre_of_mass_m", "N m"))
    for axes, what, key, si in kinds:
        account = _scale(problem, demanded, axes, _UNITS[si])
        if account is None:
            continue
        factor, unit = account
        if unit is not None:
            words, name = f"{what} are {unit}; state the units of the columns", "mixed units"
        elif other_sizes:
            words, name = f"check the units of the columns, and {key}", "another size"
        else:
            continue
        size = f"{what} change by {factor:.4g} of what the stated loads make of them"
        yield HypothesisRow(name=name, description=f"{size}: {words}", residual_share=1.0, severity="contradiction")


def _scale(
    problem: LoadProblem, demanded: FloatArray, axes: slice, units: dict[float, str]
) -> tuple[float, str | None] | None:
    """What readings are of what is demanded, and the unit that makes it so; None where they are of its size."""
    load, reading = (problem.rows.moved(wrench[:, axes]) for wrench in (demanded, problem.rows.wrench))
    square = float((load**2).sum())
    degrees = reading.size - 3 * len(problem.sessions) - 1
    if square == 0.0 or degrees < 1:
        return None
    factor = float((load * reading).sum()) / square
    error = math.sqrt(float(((reading - factor * load) ** 2).sum()) / degrees / square)
    beyond = max(factor - _MOST, 1.0 / _MOST - factor)
    unit = next((words for ratio, words in units.items() if beyond > 0.0 and abs(factor / ratio - 1.0) < _NEAR), None)
    if unit is None and (problem.matrix_prior is not None or beyond < _SURE * error):
        return None
    return factor, unit


def before(problem: LoadProblem, guess: Guess) -> tuple[FloatArray, FloatArray]:
    """Give the prior of the unknowns about a guess.

    Args:
        problem: The problem.
        guess: Values of its p unknowns.

    Returns:
        Its precision, shape (p, p), zero where nothing is known; and that times what is expected of the unknowns less
        their values; shape (p,).
    """
    listed = guess.parameters
    precision, sides = np.zeros((len(listed), len(listed))), np.zeros(len(listed))
    if problem.matrix_prior is not None:
        for row, known in enumerate(np.linalg.inv(problem.matrix_prior)):
            own = places(listed, Kind.MATRIX, row)
            precision[np.ix_(own, own)] = known
            sides[own] = -known @ guess.values[own]
    for number, load in enumerate(problem.loads):
        own = [place for kind in OF_LOAD for place in places(listed, kind, number)]
        if not own:
            continue
        values, change = inertial(load, number, guess)
        if load.expected is not None and load.precision is not None:
            precision[np.ix_(own, own)] += change.T @ load.precision @ change
            sides[own] += change.T @ load.precision @ (load.expected - values)
        if problem.slope:
            sides[own] -= change.T @ problem.slope[number]
    return precision, sides


_OPEN = 1e-6
"""Directions of unit columns that change the readings by less than this part of the strongest one are open."""
_STEPS = 25
"""Steps in which a nonlinear problem settles; with rotations and a matrix it takes five."""
_WEIGHED = 4
"""First steps, in which each axis is weighed by what is left of it."""
_SETTLED = 1e-6
"""Change of the expected reading, over that of the noise, at which nothing moves any more."""
_ROUNDING = 1e-12
"""The same over the reading, of rows without noise."""
_ROUNDS = 6
"""Rounds in which rows that disagree lose weight; three are usual."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Fit:
    """A fitted problem."""

    problem: LoadProblem
    """What was fitted."""
    guess: Guess
    """Values of the unknowns; in open directions the smallest."""
    basis: FloatArray
    """Parameters of each direction that the samples determine; shape (p, r)."""
    unobservable: FloatArray
    """Parameters of each direction that they do not determine; shape (p, p - r)."""
    estimate: Estimate
    """Covariance in the directions that are determined, and noise."""
    groups: tuple[Group, Group]
    """Forces and moments, at the values of the unknowns."""
    residual: FloatArray
    """Reading less what is expected; shape (n, 6); N, N m."""
    weight: FloatArray
    """What every row counts; shape (n,)."""

    @property
    def covariance(self) -> FloatArray:
        """Covariance of all unknowns; shape (p, p); infinite in the rows and columns of what is open."""
        basis = self.basis
        covariance = basis @ self.estimate.covariance @ basis.T
        covariance[self.is_open] = np.inf
        covariance[:, self.is_open] = np.inf
        return covariance

    @property
    def is_open(self) -> BoolArray:
        """Which unknowns have a share in what is open; shape (p,)."""
        share = np.abs(self.unobservable)
        scale = share.max(axis=0, initial=0.0)
        shared = share > _OPEN * np.where(scale > 0.0, scale, 1.0)
        return np.asarray(shared.any(axis=1), dtype=np.bool_)

    @cached_property
    def half_width(self) -> FloatArray:
        """Half-widths of 95 % intervals of all unknowns; shape (p,); infinite where they are open."""
        return np.where(self.is_open, np.inf, self.estimate.half_widths(self.basis))


def plain_fit(
    problem: LoadProblem, *, drift: bool, weight: FloatArray | None = None, alike: bool = False
) -> tuple[Guess, FloatArray]:
    """Fit by weighted least squares, as if the noise were white.

    Args:
        problem: The problem.
        drift: Whether biases move evenly in time.
        weight: What every row counts; shape (n,); the same if left out.
        alike: Whether the three axes of force count alike, and those of moment, whatever their noise.

    Returns:
        Values of the unknowns, and residuals; shape (n, 6); N, N m.
    """
    rows = problem.rows
    counts = rows.share * (np.ones(len(rows)) if weight is None else weight)
    guess = Guess.zero(unknowns_of(problem, drift=drift), first_mount(problem) if problem.mount else None)
    now = expected(problem, guess)
    flat = replace(problem, slope=())
    sizes = noise_sizes(rows.wrench - now)
    rounding = _ROUNDING * noise_sizes(rows.wrench)
    for step in range(_STEPS):
        residual = rows.wrench - now
        sizes = noise_sizes(residual * np.sqrt(counts)[:, None]) if 0 < step < _WEIGHED else sizes
        if alike:
            sizes = np.repeat(np.sqrt((sizes.reshape(2, 3) ** 2).mean(axis=1)), 3)
        root = np.sqrt(counts)[:, None] / sizes
        # the slope is that under the noise at the end: against that of the first steps it would outweigh the rows
        posed = problem if step >= _WEIGHED else flat
        moved = _step(posed, guess, changes(problem, guess) * root[:, :, None], residual * root)
        guess = guess.moved(guess.values + moved)
        before, now = now, expected(problem, guess)
        shift = np.abs((now - before) / np.maximum(_SETTLED * sizes, rounding)).max(initial=0.0)
        if shift < 1.0 and (step >= _WEIGHED or (alike and not problem.slope)):
            break
    return guess, rows.wrench - now


def _step(problem: LoadProblem, guess: Guess, design: FloatArray, values: FloatArray) -> FloatArray:
    """Least-squares step in the directions that are determined; shape (p,)."""
    precision, sides = before(problem, guess)
    basis, _ = directions_of(design, precision)
    flat = design.reshape(-1, design.shape[2]) @ basis
    inner = flat.T @ flat + basis.T @ precision @ basis
    return basis @ np.linalg.solve(inner, flat.T @ values.reshape(-1) + basis.T @ sides)


def directions_of(design: FloatArray, precision: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Separate the combinations of unknowns that are determined from those that are not.

    Args:
        design: Change of the readings with the unknowns, over their noise; shape (n, 6, p).
        precision: Precision of the unknowns before the rows; shape (p, p).

    Returns:
        Parameters of each that is determined, shape (p, r), and of each that is not, shape (p, p - r).
    """
    flat = design.reshape(-1, design.shape[2])
    products = flat.T @ flat + precision
    size = np.sqrt(np.diag(products))
    seen = size > 0.0
    scale = np.where(seen, size, 1.0)
    squares, turned = np.linalg.eigh(products / np.outer(scale, scale))
    known = squares > _OPEN**2 * squares.max(initial=0.0)
    scaled = turned / scale[:, None]
    return scaled[:, known], scaled[:, ~known]


def fit(problem: LoadProblem, *, drift: bool) -> Fit:
    """Fit under white and slow noise; rows that disagree with all others lose weight.

    Args:
        problem: The problem.
        drift: Whether biases move evenly in time.

    Returns:
        The fit.
    """
    weight = _first_weights(problem, drift=drift)
    for _ in range(_ROUNDS):
        fitted = _weighed_fit(problem, drift=drift, weight=weight)
        if (np.abs(fitted.residual) <= _ROUNDING * noise_sizes(problem.rows.wrench)).all():
            break
        lighter = row_weights(row_distances(fitted.groups, fitted.basis, fitted.estimate, weight))
        if np.allclose(lighter, weight, rtol=0.02, atol=1e-4):
            break
        weight = lighter
    return fitted


_GROSS = 8.0
"""Deviations of the middle rows by which a row is off in one axis before the noise of that axis is estimated."""
_FIRST_ROUNDS = 6
"""Rounds in which rows that are grossly off come to light, one behind the other."""


def _first_weights(problem: LoadProblem, *, drift: bool) -> FloatArray:
    """What every row counts at first, less where it is grossly off in one axis; shape (n,)."""
    # such a row makes the noise of its axis as large as itself, which medians do not; `fit` weighs all rows anew
    rows = problem.rows
    weight = np.ones(len(rows))
    for _ in range(_FIRST_ROUNDS):
        guess, residual = plain_fit(problem, drift=drift, weight=weight)
        spare = len(rows) - len(guess.parameters) / _AXES
        if spare < 1.0:
            break
        size = np.abs(residual) * np.sqrt(rows.share)[:, None]
        middle = MAD_TO_DEVIATION * np.median(size, axis=0) * np.sqrt(len(rows) / spare)
        # an axis that most rows fit exactly is no measure of the others
        floor = np.maximum(
            _LEAST_NOISE * np.repeat(middle.reshape(2, 3).max(axis=1), 3), _ROUNDING * noise_sizes(rows.wrench)
        )
        distance = (size / np.maximum(middle, floor)).max(axis=1)
        lighter = np.clip((_GROSS / np.maximum(distance, _GROSS)) ** 4, _LEAST_WEIGHT, 1.0)
        if np.allclose(lighter, weight, rtol=0.1, atol=1e-3):
            break
        weight = lighter
    return weight


def _weighed_fit(problem: LoadProblem, *, drift: bool, weight: FloatArray) -> Fit:
    rows = problem.rows
    guess, residual = plain_fit(problem, drift=drift, weight=weight)
    shapes = SHAPES[:1] if rows.time_s is None else SHAPES
    linear = not any(one.kind in (Kind.MOUNT, Kind.TILT, Kind.MATRIX) for one in guess.parameters)
    # what exact rows leave is rounding, of which a part may be exactly zero
    rounding = _ROUNDING * noise_sizes(rows.wrench)
    sizes = noise_sizes(np.hypot(residual * np.sqrt(rows.share * weight)[:, None], rounding))
    for _ in range(2 if linear and rows.angular_velocity_products is None else 4):
        design = changes(problem, guess)
        precision, sides = before(problem, guess)
        basis, unobservable = directions_of(design / sizes[:, None], precision)
        groups = groups_of(rows, design, residual, sizes, weight)
        answer = estimate(groups, basis, (basis.T @ precision @ basis, basis.T @ sides), shapes)
        guess = guess.moved(guess.values + basis @ answer.mean)
        residual = rows.wrench - expected(problem, guess)
        used, sizes = sizes, sizes_under(groups_of(rows, design, residual, sizes, weight), answer, sizes, rounding)
    return Fit(
        problem=problem,
        guess=guess,
        basis=basis,
        unobservable=unobservable,
        estimate=answer,
        groups=groups_of(rows, design, residual, used, weight),
        residual=residual,
        weight=weight,
    )
