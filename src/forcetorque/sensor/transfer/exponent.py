# SPDX-License-Identifier: BSD-3-Clause
"""Search for the one exponent of a function that is linear in its other parameters."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import FitError

_TOLERANCE = 1e-14
"""Relative change of a parameter, or of the squared error, below which the refinement stops: rounding."""


def fit_exponent(
    shape: Callable[[float], FloatArray], output: FloatArray, *, candidates: FloatArray, name: str
) -> tuple[float, FloatArray]:
    """Find the exponent, and the parameters that go with it, by least squares of the output.

    For each exponent the other parameters are linear least squares (separable least squares), so the
    candidates show where the best exponent lies without a start for the others. From the best one
    all parameters are refined together, the exponent between the two neighbours.

    Args:
        shape: Output per linear parameter, for an exponent; gives shape (n, parameters).
        output: Outputs; shape (n,).
        candidates: Exponents to start from, ascending; shape (k,).
        name: Kind of function, for the message.

    Returns:
        Exponent and linear parameters.

    Raises:
        FitError: If the best candidate is the first or the last: the points then look like a limit of the
            function, which has no such exponent.
    """
    from scipy import optimize  # here because importing it takes longer than most fits

    def best_linear(exponent: float) -> FloatArray:
        return np.asarray(np.linalg.lstsq(shape(exponent), output, rcond=None)[0], dtype=np.float64)

    def residual(parameters: FloatArray) -> FloatArray:
        return np.asarray(shape(float(parameters[0])) @ parameters[1:] - output, dtype=np.float64)

    starts = [np.array([exponent, *best_linear(exponent)]) for exponent in candidates]
    errors = [float((residual(start) ** 2).sum()) for start in starts]
    best = int(np.argmin(errors))
    if best in {0, len(starts) - 1}:
        raise FitError(
            f"{name}: no exponent between {candidates[0]:g} and {candidates[-1]:g} (of scaled points) fits best; "
            "the points do not bend as this function does, fit another kind"
        )
    free = np.full(len(starts[best]) - 1, np.inf)
    optimum = optimize.least_squares(
        residual,
        starts[best],
        bounds=([candidates[best - 1], *-free], [candidates[best + 1], *free]),
        x_scale="jac",
        ftol=_TOLERANCE,
        xtol=_TOLERANCE,
        gtol=_TOLERANCE,
    )
    return float(optimum.x[0]), np.asarray(optimum.x[1:], dtype=np.float64)
