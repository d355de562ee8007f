# SPDX-License-Identifier: BSD-3-Clause
"""Robust weights of samples that disagree with all others, and the scale of measurements against specified loads."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.units import SI_FACTORS
from forcetorque.base.wrench import FORCE, MOMENT
from forcetorque.payload.identification.noise import Estimate, Group
from forcetorque.payload.identification.parameters import Guess
from forcetorque.payload.identification.prediction import load_wrench
from forcetorque.payload.identification.problem import LoadProblem
from forcetorque.payload.identification.solution import Hypothesis

FALSE_ALARMS = 0.01
"""Share of problems without a fault in which some row is said to disagree."""
_MEDIAN = 5.348
"""Median of chi-squared of six degrees of freedom."""
_LEAST_LEFT = 1e-6
"""Rows of which the fit leaves less than this part to be told by the others say nothing of themselves."""
_LEAST_WEIGHT = 1e-4
_EXACT = 1e-12
"""Distances below this are of rows without noise, which leave rounding only."""


def row_distances(groups: tuple[Group, Group], basis: FloatArray, estimate: Estimate, weight: FloatArray) -> FloatArray:
    """Hold every row against what all others, and the slow noise around it, say of it.

    Args:
        groups: Forces and moments, at the estimate.
        basis: Directions that were estimated; shape (p, r).
        estimate: What was estimated.
        weight: What every row counted; shape (n,): that makes it less sure, not less far.

    Returns:
        Squared distances over what they are of sound rows in the middle of six axes, chi-squared of six degrees; shape
        (n,).
    """
    total = np.zeros(len(groups[0].values) // 3)
    for group, noise, variance in zip(groups, estimate.shapes, estimate.variances, strict=True):
        known, _ = group.line.solve(group.design @ basis, noise)
        left, _ = group.line.solve(group.values[:, None], noise)
        alone = group.line.precision_diagonal(noise) / variance
        fitted = np.einsum("nr,rs,ns->n", known, estimate.covariance, known) / variance**2
        own = alone - fitted
        checked = own > _LEAST_LEFT * alone
        square = np.where(checked, (left[:, 0] / variance) ** 2 / np.where(checked, own, 1.0), 0.0)
        np.add.at(total, group.order, square)
    total /= weight
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


def scales(problem: LoadProblem, guess: Guess, *, other_sizes: bool) -> Iterator[Hypothesis]:
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
        yield Hypothesis(name=name, words=f"{size}: {words}", residual_share=1.0)


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
