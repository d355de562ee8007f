# SPDX-License-Identifier: BSD-3-Clause
"""How large the change of readings is beside that of stated loads: a unit that is another one shows as a factor."""

from __future__ import annotations

import math
from collections.abc import Iterator

from forcetorque.arrays import FloatArray
from forcetorque.constants import STANDARD_GRAVITY
from forcetorque.loads.expected import load_wrench
from forcetorque.loads.fit import plain_fit
from forcetorque.loads.problem import LoadProblem
from forcetorque.loads.solution import Hypothesis
from forcetorque.spatial import FORCE, MOMENT, si_factor

_NEAR = 0.02
"""Part by which a factor may be off one that a unit makes."""
_MOST = 2.0
"""No sensor that was ever calibrated reads more times what is there, or less."""
_SURE = 4.0
"""Standard errors by which a factor must lie beyond."""
_LBF = si_factor("lbf")[1]
_FORCES = {
    1.0 / STANDARD_GRAVITY: "forces are in kg: multiply by 9.80665 m/s2",
    STANDARD_GRAVITY: "forces are in N, not in kgf",
    1e3: "forces are in mN",
    1e-3: "forces are in kN",
    1.0 / _LBF: "forces are in lbf",
    _LBF: "forces are in N, not in lbf",
}
"""What readings are over what they should be, where their unit is another one."""
_MOMENTS = {1e3: "moments are in N mm", 1e-3: "moments are in N m, not in N mm"}


def scales(problem: LoadProblem) -> Iterator[Hypothesis]:
    """Name forces and moments that are a multiple of what the stated loads demand.

    Args:
        problem: Readings and loads.

    Yields:
        An account for each, `mixed units` where a unit makes that multiple, else `another size`; none where a mass is
        not stated, and of moments none where a centre of mass is not.
    """
    if not problem.loads or any(load.mass is None for load in problem.loads):
        return
    demanded = load_wrench(problem, plain_fit(problem, drift=False)[0])
    yield from _scale(problem, demanded, FORCE, "forces", "mass_kg", _FORCES)
    if all(load.mass == 0.0 or load.centre_of_mass is not None for load in problem.loads):
        yield from _scale(problem, demanded, MOMENT, "moments", "centre_of_mass_m", _MOMENTS)


def _scale(
    problem: LoadProblem, demanded: FloatArray, axes: slice, what: str, key: str, units: dict[float, str]
) -> Iterator[Hypothesis]:
    load, reading = (problem.rows.moved(wrench[:, axes]) for wrench in (demanded, problem.rows.wrench))
    square = float((load**2).sum())
    degrees = reading.size - 3 * len(problem.sessions) - 1
    if square == 0.0 or degrees < 1:
        return
    factor = float((load * reading).sum()) / square
    error = math.sqrt(float(((reading - factor * load) ** 2).sum()) / degrees / square)
    unit = next((words for ratio, words in units.items() if abs(factor / ratio - 1.0) < _NEAR), None)
    beyond = max(factor - _MOST, 1.0 / _MOST - factor)
    if unit is None and (problem.matrix_prior is not None or beyond < _SURE * error):
        return
    name = "mixed units" if unit else "another size"
    remedy = f"{unit}; state the units of the columns" if unit else f"check the units of the columns, and {key}"
    words = f"{what} change by {factor:.4g} of what the stated loads make of them: {remedy}"
    yield Hypothesis(name=name, words=words, residual_share=1.0)
