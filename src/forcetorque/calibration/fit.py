# SPDX-License-Identifier: BSD-3-Clause
"""The regularised fit: matrix and offset from moments, towards a prior matrix.

    C*, o* = argmin  mean |f - C r - o|^2  +  lambda |C - C_prior|_F^2        thesis (5.4)

The mean over samples is part of the convention, so lambda has the unit counts2 and does not depend
on the number of samples. The offset is not penalised: eliminating it centres the moments, and the
six rows of C share one c x c system,  C (R + lambda 1) = B + lambda C_prior.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.calibration.excitation import Excitation, excitation_of
from forcetorque.calibration.moments import Moments
from forcetorque.errors import FitError, ShapeError


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MatrixFit:
    """A matrix with its offset, and what the data said about it."""

    matrix: FloatArray
    """Calibration matrix; shape (6, c); N/count, N m/count."""
    offset: FloatArray
    """Offset in wrench space; shape (6,); N, N m."""
    regularisation: float
    """Lambda of the fit; counts2; infinite where the prior was kept."""
    residual: FloatArray
    """Root mean square residual per component on the fitted samples; shape (6,); N, N m."""
    excitation: Excitation
    """Rank, conditioning and directions of the fitted samples."""

    def __post_init__(self) -> None:
        channels = np.asarray(self.matrix).shape[-1]
        for field, shape in (("matrix", (6, channels)), ("offset", (6,)), ("residual", (6,))):
            object.__setattr__(self, field, read_only(getattr(self, field), name=field, shape=shape))


def solve_matrix(moments: Moments, prior: FloatArray | None, regularisation: float) -> tuple[FloatArray, FloatArray]:
    """Solve for matrix and offset, without asking whether the data determine them.

    Args:
        moments: Moments of the fitted samples.
        prior: Matrix to stay close to; shape (6, c); None only for lambda = 0.
        regularisation: Lambda, at least 0; counts2; infinite keeps the prior and fits the offset.

    Returns:
        Matrix of shape (6, c) and offset of shape (6,).

    Raises:
        FitError: If lambda is negative or not a number, or positive without a prior.
        ShapeError: If the prior does not have one column per channel.
    """
    if not regularisation >= 0.0:
        raise FitError(f"lambda: expected a number of at least 0 counts2, got {regularisation}")
    if prior is None and regularisation > 0.0:
        raise FitError(f"lambda: {regularisation:g} counts2 needs a prior matrix to pull towards; give one or lambda 0")
    if prior is not None and prior.shape != (6, moments.channels):
        raise ShapeError(f"prior: expected shape (6, {moments.channels}), got {prior.shape}")
    if prior is not None and math.isinf(regularisation):
        matrix = np.array(prior)
    else:
        system = moments.raw_raw + regularisation * np.eye(moments.channels)
        target = moments.reference_raw + (regularisation * prior if prior is not None else 0.0)
        matrix = np.asarray(np.linalg.lstsq(system, target.T, rcond=None)[0].T, dtype=np.float64)
    return matrix, moments.reference_mean - matrix @ moments.raw_mean


def fit_matrix(moments: Moments, prior: FloatArray | None, regularisation: float) -> MatrixFit:
    """Fit matrix and offset, and refuse where nothing determines a direction of the matrix.

    Args:
        moments: Moments of the fitted samples.
        prior: Matrix to stay close to; shape (6, c); None only for lambda = 0.
        regularisation: Lambda; counts2.

    Returns:
        The fit.

    Raises:
        FitError: If lambda is 0 and the loads leave a direction of the raw readings unexcited; the
            message names it.
    """
    excitation = excitation_of(moments)
    matrix, offset = solve_matrix(moments, prior, regularisation)
    if regularisation == 0.0 and not all(excitation.excited):
        names = tuple(f"ch{k}" for k in range(moments.channels))
        still = ", ".join(excitation.unmoved_components())
        count = excitation.excited.count(False)
        raise FitError(
            f"lambda is 0 and the data do not excite {count} of {moments.channels} directions "
            f"of the raw readings: {excitation.describe_unexcited(channel_names=names)}"
            f"{f'; the reference does not change in {still}' if still else ''}; "
            "move the limb so that these loads change, or give a prior matrix and lambda > 0"
        )
    return MatrixFit(
        matrix=matrix,
        offset=offset,
        regularisation=regularisation,
        residual=np.sqrt(moments.squared_error(matrix, offset)),
        excitation=excitation,
    )
