# SPDX-License-Identifier: BSD-3-Clause
"""One fit with what the data said about it, refused where nothing determines it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.calibration.estimation import Estimation
from forcetorque.calibration.excitation import Excitation, excitation_of
from forcetorque.calibration.gate.reference_motion import require_moving_load
from forcetorque.calibration.moments import Moments
from forcetorque.calibration.regression import Regression
from forcetorque.calibration.wrench_model import WrenchModel
from forcetorque.errors import FitError

_STILL = 1e-24
"""Variance of a variable, relative to its squared mean, below which it is a constant."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MatrixFit:
    """A model of a sensor, and what the data said about it."""

    model: WrenchModel
    """Matrix, offset and coefficients of variables."""
    regularisation: float
    """Lambda of the fit; counts2; infinite where the prior was kept."""
    residual: FloatArray
    """Root mean square residual per component on the fitted samples; shape (6,); N, N m."""
    excitation: Excitation
    """Rank, conditioning and directions of the fitted samples, without what variables explain."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "residual", read_only(self.residual, name="residual", shape=(6,)))

    @property
    def matrix(self) -> FloatArray:
        """Calibration matrix; shape (6, c); N/count, N m/count."""
        return self.model.matrix

    @property
    def offset(self) -> FloatArray:
        """Offset in wrench space; shape (6,); N, N m."""
        return self.model.offset


def fit_matrix(moments: Moments, estimation: Estimation, regularisation: float) -> MatrixFit:
    """Fit matrix, offset and variables, and refuse where nothing determines a direction of the matrix.

    Args:
        moments: Moments of the fitted samples.
        estimation: Offset strategy, variables and prior.
        regularisation: Lambda; counts2.

    Returns:
        The fit.

    Raises:
        FitError: If there are fewer samples than unknowns, a variable does not change, or lambda is 0 and
            the loads leave a direction of the raw readings unexcited; the message names it.
    """
    regression = Regression.of(moments, estimation)
    require_determined(moments, estimation, regularisation)
    excitation = excitation_of(moments.without_variables() if estimation.kind.with_variables else moments)
    model = regression.at(regularisation)
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
        model=model,
        regularisation=regularisation,
        residual=np.sqrt(moments.squared_error(model)),
        excitation=excitation,
    )


def require_determined(moments: Moments, estimation: Estimation, regularisation: float) -> None:
    """Refuse data that cannot tell the unknowns apart, even with a prior matrix.

    Args:
        moments: Moments of the fitted samples.
        estimation: Offset strategy, variables and prior.
        regularisation: Lambda; counts2; infinite leaves only offset and variables unknown.

    Raises:
        FitError: If there are fewer samples than unknowns of one axis, a variable without a prior does not change, or
            there is a matrix to fit and no load, or none that moves.
    """
    variables = estimation.variables if estimation.kind.with_variables else ()
    matrix = 0 if math.isinf(regularisation) else moments.channels
    unknowns = matrix + len(variables) + (estimation.raw_offset is None)
    if moments.count < unknowns:
        raise FitError(
            f"expected at least {unknowns} samples for {unknowns} unknowns of every axis, got {moments.count}; "
            "give longer intervals"
        )
    if matrix:
        require_moving_load(moments)
    for k, variable in enumerate(variables):
        mean, place = moments.variable_mean[k], moments.channels + k
        if variable.prior is None and moments.second[place, place] <= _STILL * mean**2:
            raise FitError(
                f"variable {variable.name!r}: its value is {mean:g} {variable.unit} throughout the fitted data, so its "
                "coefficients cannot be told from the offset; fit data at several values, or a type without variables"
            )
