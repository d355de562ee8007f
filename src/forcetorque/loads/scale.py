# SPDX-License-Identifier: BSD-3-Clause
"""How large the change of readings is beside that of stated loads: a unit that is another one shows as a factor."""

from __future__ import annotations

import math
from collections.abc import Iterator

from forcetorque.arrays import FloatArray
from forcetorque.loads.expected import load_wrench
from forcetorque.loads.guess import Guess
from forcetorque.loads.problem import LoadProblem
from forcetorque.loads.solution import Hypothesis
from forcetorque.spatial import FORCE, MOMENT, SI_FACTORS

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
