# SPDX-License-Identifier: BSD-3-Clause
"""The regularised regression: one eigenvalue problem per data set, then any lambda, refused where undetermined."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, array
from forcetorque.base.errors import FitError, ShapeError
from forcetorque.experiment.calibration.estimation_type import Estimation, OffsetStrategy
from forcetorque.experiment.calibration.excitation import Excitation, excitation_of
from forcetorque.experiment.calibration.moments import Moments, symmetric_pseudo_inverse
from forcetorque.experiment.calibration.sensor_model import LinearVariable, WrenchModel
from forcetorque.inspection.plausibility.gravity_sense_gain_and_unit_checks import require_moving_load

_SINGULAR = 1e-14
"""Eigenvalues below this part of the largest are rounding: at lambda 0 the prior is kept along them."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Regression:
    """Normal equations of one estimation on one data set, ready for any lambda."""

    estimation: Estimation
    """Offset strategy, variables and prior."""
    channels: int
    """Number c of raw channels."""
    eigenvalues: FloatArray
    """Of the second moment of the p penalised columns, free of what the others explain; shape (p,)."""
    vectors: FloatArray
    """Its eigenvectors, one per column; shape (p, p)."""
    target: FloatArray
    """Mean product of the reference with the penalised columns, likewise free; shape (6, p)."""
    penalised: BoolArray
    """Which of the columns - raw, variables, constant - are penalised; shape (q,)."""
    free_solution: FloatArray
    """Coefficients of the q - p free columns if the penalised ones were zero; shape (6, q - p)."""
    free_change: FloatArray
    """How they change with the coefficients of the penalised ones; shape (p, q - p)."""
    origin: FloatArray
    """Point about which raw, variables and reference were taken; shape (c + v + 6,)."""

    @classmethod
    def of(cls, moments: Moments, estimation: Estimation) -> Regression:
        """Prepare the fit of a data set.

        Args:
            moments: Moments of the fitted samples.
            estimation: Offset strategy, variables and prior.

        Returns:
            The regression.

        Raises:
            ShapeError: If prior, raw offset or variables do not fit the samples.
        """
        _require_fit(moments, estimation)
        origin, gram, penalised = _columns(moments, estimation)
        p, u = np.flatnonzero(penalised), np.flatnonzero(~penalised)
        f = np.arange(len(penalised), len(gram))
        inverse = symmetric_pseudo_inverse(gram[np.ix_(u, u)])
        change = gram[np.ix_(p, u)] @ inverse
        eigenvalues, vectors = np.linalg.eigh(gram[np.ix_(p, p)] - change @ gram[np.ix_(u, p)])
        return cls(
            estimation=estimation,
            channels=moments.channels,
            eigenvalues=np.maximum(eigenvalues, 0.0),
            vectors=vectors,
            target=gram[np.ix_(f, p)] - gram[np.ix_(f, u)] @ change.T,
            penalised=penalised,
            free_solution=gram[np.ix_(f, u)] @ inverse,
            free_change=change,
            origin=origin,
        )

    def at(self, regularisation: float) -> WrenchModel:
        """Solve for one lambda, without asking whether the data determine the answer.

        Args:
            regularisation: Lambda, at least 0; counts2; infinite keeps the prior and fits the rest.

        Returns:
            The model.

        Raises:
            FitError: If lambda is negative or not a number, or positive without a prior.
        """
        if not regularisation >= 0.0:
            raise FitError(f"lambda: expected a number of at least 0 counts2, got {regularisation}")
        if self.estimation.prior is None and regularisation > 0.0:
            raise FitError(
                f"lambda: {regularisation:g} counts2 needs a prior matrix to pull towards; give one or lambda 0"
            )
        prior = np.zeros((6, self.channels)) if self.estimation.prior is None else self.estimation.prior
        pulled = np.column_stack([prior, *self._prior_coefficients()])
        if math.isinf(regularisation):
            return self._model(pulled)
        system = self.eigenvalues + regularisation
        determined = system > _SINGULAR * self.eigenvalues[-1]
        inverse = np.divide(1.0, system, out=np.zeros_like(system), where=determined)
        along = (self.target + regularisation * pulled) @ self.vectors * inverse
        return self._model((along + np.where(determined, 0.0, pulled @ self.vectors)) @ self.vectors.T)

    def completed(self, matrix: FloatArray) -> WrenchModel:
        """Give a matrix the offset and the coefficients that the data have with it.

        Args:
            matrix: Calibration matrix; shape (6, c); N/count, N m/count.

        Returns:
            The model; coefficients with a prior keep it.
        """
        return self._model(np.column_stack([matrix, *self._prior_coefficients()]))

    def _prior_coefficients(self) -> list[FloatArray]:
        return [variable.prior for variable in _fitted(self.estimation) if variable.prior is not None]

    def _model(self, solved: FloatArray) -> WrenchModel:
        """From the coefficients of the penalised columns to all of them."""
        c, variables = self.channels, len(_fitted(self.estimation))
        columns = np.empty((6, len(self.penalised)))
        columns[:, self.penalised] = solved
        columns[:, ~self.penalised] = self.free_solution - solved @ self.free_change
        matrix, coefficients = columns[:, :c], columns[:, c : c + variables]
        values = self.estimation.reference_values[:variables]
        # the wrench at the origin of the raw readings, with every variable at its reference value
        offset = self.origin[-6:] - matrix @ self.origin[:c] - coefficients @ (self.origin[c : c + variables] - values)
        if self.estimation.kind.offset is OffsetStrategy.ONE_SHOT:
            offset = offset + columns[:, -1]
        return WrenchModel(matrix=matrix, offset=offset, coefficients=coefficients, reference_values=values)


def solve(moments: Moments, estimation: Estimation, regularisation: float) -> WrenchModel:
    """Solve for one lambda; see `Regression`, which serves many.

    Args:
        moments: Moments of the fitted samples.
        estimation: Offset strategy, variables and prior.
        regularisation: Lambda, at least 0; counts2; infinite keeps the prior and fits the rest.

    Returns:
        The model.
    """
    return Regression.of(moments, estimation).at(regularisation)


def _require_fit(moments: Moments, estimation: Estimation) -> None:
    c, v = moments.channels, moments.variables
    if estimation.prior is not None and estimation.prior.shape != (6, c):
        raise ShapeError(f"prior: expected shape (6, {c}), got {estimation.prior.shape}")
    if estimation.raw_offset is not None and estimation.raw_offset.shape != (c,):
        raise ShapeError(f"raw_offset: expected shape ({c},), got {estimation.raw_offset.shape}")
    if len(_fitted(estimation)) not in (0, v):
        raise ShapeError(f"variables: expected the {len(estimation.variables)} of the estimation, the data have {v}")


def _fitted(estimation: Estimation) -> tuple[LinearVariable, ...]:
    return estimation.variables if estimation.kind.with_variables else ()


def _columns(moments: Moments, estimation: Estimation) -> tuple[FloatArray, FloatArray, BoolArray]:
    """Origin of the columns, their second moment about it with the reference last, and which are penalised."""
    c, fitted = moments.channels, _fitted(estimation)
    origin = _origin(moments, estimation)
    gram, step = moments.about(origin), moments.mean - origin
    kept = np.r_[: c + len(fitted), len(origin) - 6 : len(origin)]
    gram, step, constants = gram[np.ix_(kept, kept)], step[kept], 0
    if estimation.kind.offset is OffsetStrategy.ONE_SHOT:
        constants, place = 1, c + len(fitted)
        gram = np.insert(np.insert(gram, place, step, axis=0), place, np.insert(step, place, 1.0), axis=1)
    penalised = [True] * c + [variable.prior is not None for variable in fitted] + [False] * constants
    return origin, gram, np.array(penalised)


def _origin(moments: Moments, estimation: Estimation) -> FloatArray:
    """Point about which raw, variables and reference are taken, which is where the offset strategies differ."""
    strategy, zero = estimation.kind.offset, np.zeros(6)
    if strategy is OffsetStrategy.SPHERE and estimation.raw_offset is not None:
        values = estimation.reference_values if _fitted(estimation) else moments.variable_mean
        return np.concatenate([estimation.raw_offset, values, zero])
    if strategy is OffsetStrategy.CENTRALISED:
        return moments.mean
    if strategy is OffsetStrategy.ONE_SHOT:
        # a constant takes up any shift of the columns; from the means no digits are lost to large raw offsets or to
        # variables far from zero, such as kelvins and seconds since 1970
        return np.concatenate([moments.raw_mean, moments.variable_mean, zero])
    # a strategy that was added without its line here must not pass for one of these
    raise FitError(f"type {estimation.kind.name}: no origin of the columns is stated for the offset {strategy.value!r}")


_STILL = 1e-24
"""Variance of a variable, relative to its squared mean, below which it is a constant."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MatrixFit(ArrayRecord):
    """A model of a sensor, and what the data said about it."""

    model: WrenchModel
    """Matrix, offset and coefficients of variables."""
    regularisation: float
    """Lambda of the fit; counts2; infinite where the prior was kept."""
    residual: FloatArray = field(metadata=array(6))
    """Root mean square residual per component on the fitted samples; shape (6,); N, N m."""
    excitation: Excitation
    """Rank, conditioning and directions of the fitted samples, without what variables explain."""

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
