# SPDX-License-Identifier: BSD-3-Clause
"""From samples of one sensor to its matrix, offset, lambda and what they are worth."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.calibration.fit import MatrixFit, fit_matrix, solve_matrix
from forcetorque.calibration.held_out import BLOCKS, LambdaCurve, choose_lambda, jackknife_error
from forcetorque.calibration.moments import Moments, pooled
from forcetorque.errors import FitError, ShapeError


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DataSet:
    """Raw readings and reference wrenches of one stretch of time."""

    label: str
    """Label of the interval."""
    raw: FloatArray
    """Raw readings in the order of time; shape (n, c); counts."""
    reference: FloatArray
    """Reference wrenches; shape (n, 6); N, N m."""

    def __post_init__(self) -> None:
        raw = read_only(self.raw, name="raw", shape=(None, None))
        object.__setattr__(self, "raw", raw)
        object.__setattr__(self, "reference", read_only(self.reference, name="reference", shape=(len(raw), 6)))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CalibrationFit:
    """A fit with the choice of lambda and its uncertainty."""

    fit: MatrixFit
    """Matrix, offset, residual and excitation."""
    curve: LambdaCurve | None
    """Held-out error over lambda; None where lambda was given."""
    matrix_standard_error: FloatArray | None
    """Standard error of the matrix by leaving out blocks; shape (6, c); None with one block or a kept prior."""
    offset_standard_error: FloatArray | None
    """Standard error of the offset by leaving out blocks; shape (6,); N, N m."""
    prior_offset: FloatArray | None
    """Offset that the same data give with the prior matrix; shape (6,); N, N m; None without prior."""


def calibrate(
    data_sets: Sequence[DataSet], prior: FloatArray | None, *, regularisation: float | None = None
) -> CalibrationFit:
    """Fit matrix and offset of a sensor to the reference wrenches.

    Args:
        data_sets: Stretches of calibration data, at least one; they share one offset.
        prior: Matrix to stay close to; shape (6, c); None for a sensor without one.
        regularisation: Lambda; counts2; None to choose it on held-out blocks.

    Returns:
        The fit, the choice of lambda and standard errors.

    Raises:
        FitError: If there are no data, lambda is to be chosen without a prior, or the data leave an
            unpenalised direction unexcited.
        ShapeError: If the data sets have different numbers of channels.
    """
    if not data_sets:
        raise FitError("expected at least one calibration interval, got none")
    channels = {data.raw.shape[1] for data in data_sets}
    if len(channels) > 1:
        raise ShapeError(f"data sets: expected one number of raw channels, got {sorted(channels)}")
    blocks = _blocks(data_sets)
    moments = pooled(blocks)
    curve = None
    if regularisation is None:
        if prior is None:
            raise FitError("lambda cannot be chosen without a prior matrix; give a prior, or lambda 0")
        curve = choose_lambda(blocks, prior)
        regularisation = curve.chosen
    fit = fit_matrix(moments, prior, regularisation)
    matrix_error, offset_error = jackknife_error(blocks, prior, regularisation) if len(blocks) > 1 else (None, None)
    return CalibrationFit(
        fit=fit,
        curve=curve,
        matrix_standard_error=None if math.isinf(regularisation) else matrix_error,
        offset_standard_error=offset_error,
        prior_offset=None if prior is None else solve_matrix(moments, prior, math.inf)[1],
    )


def _blocks(data_sets: Sequence[DataSet]) -> list[Moments]:
    """Divide every stretch in equal contiguous pieces, so that there are at least `BLOCKS` in all."""
    pieces = math.ceil(BLOCKS / len(data_sets))
    return [
        Moments.of(data.raw[part], data.reference[part])
        for data in data_sets
        for part in np.array_split(np.arange(len(data.raw)), min(pieces, max(len(data.raw), 1)))
    ]
