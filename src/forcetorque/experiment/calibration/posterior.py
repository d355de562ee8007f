# SPDX-License-Identifier: BSD-3-Clause
"""What a fit knows of a sensor: mean and covariance, with errors of loads that the sensor itself identified."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Annotated, Any, Final, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import ArrayField, FloatArray, SymmetricField, require_shape, rounded
from forcetorque.base.errors import ShapeError, require_known
from forcetorque.base.stored_table import StoredTable
from forcetorque.experiment.calibration.expected_sensor_errors import LOADS
from forcetorque.experiment.calibration.robot_model_error import ErrorTerm

_DIGITS: Final = 9
"""Significant digits of what a fit knows of errors of the robot model."""


class RowNoise(StoredTable):
    """Noise of one row of the model, of means over a second: white, and a slow offset."""

    white: float = Field(ge=0.0)
    """Standard deviation of the white part; N, N m in wrench space, counts in channel space."""
    time_constant_s: float = Field(ge=0.0)
    """How long the slow offset takes to forget itself; 0 where there is none."""
    ratio: float = Field(ge=0.0)
    """Variance of the slow offset over that of the white part."""


class ModelPart(StoredTable):
    """Errors of the robot model that were estimated beside the unknowns of a sensor, and what these owe to them."""

    terms: tuple[ErrorTerm, ...]
    """The errors, t of them, with their deviations before any data."""
    term_covariance: Annotated[FloatArray, SymmetricField()]
    """Their covariance; shape (t, t); products of their units."""
    response: Annotated[FloatArray, ArrayField((None, None, None))]
    """By how much the mean of the unknowns of every row would change per unit of each error, were it known; shape
    (rows, p, t)."""

    @classmethod
    def fitted(cls, terms: tuple[ErrorTerm, ...], covariance: FloatArray, response: FloatArray) -> ModelPart:
        """Keep what a fit found, to `_DIGITS` digits: it is the largest part of a file of a calibration.

        Args:
            terms: As of the class.
            covariance: As `term_covariance` of the class.
            response: As of the class.

        Returns:
            The part.
        """
        return cls(terms=terms, term_covariance=rounded(covariance, _DIGITS), response=rounded(response, _DIGITS))

    @classmethod
    def exact(cls, rows: int, unknowns: int) -> ModelPart:
        """Describe a robot model without errors.

        Args:
            rows: Rows of the sensor.
            unknowns: Unknowns of each.

        Returns:
            A part without terms.
        """
        return cls(terms=(), term_covariance=np.zeros((0, 0)), response=np.zeros((rows, unknowns, 0)))

    @property
    def covariance(self) -> FloatArray:
        """Covariance of the unknowns by these errors alone; shape (rows, p, p)."""
        return self.response @ self.term_covariance @ self.response.transpose(0, 2, 1)

    def places(self, terms: Sequence[ErrorTerm]) -> list[int]:
        """Find errors by name and nominal value.

        Args:
            terms: Some of the errors.

        Returns:
            Their places.
        """
        known = {(term.name, term.nominal): place for place, term in enumerate(self.terms)}
        return [known[term.name, term.nominal] for term in terms]

    def with_terms(self, terms: Sequence[ErrorTerm]) -> ModelPart:
        """Add errors that the unknowns do not depend on yet.

        Args:
            terms: Errors; those that are there already stay as they are.

        Returns:
            All of them, the new ones last, with what was assumed of these before any data.
        """
        known = {(term.name, term.nominal) for term in self.terms}
        new = tuple(term for term in terms if (term.name, term.nominal) not in known)
        old, rows = len(self.terms), self.response.shape[:2]
        covariance = np.diag(np.r_[np.zeros(old), [term.deviation**2 for term in new]])
        covariance[:old, :old] = self.term_covariance
        response = np.concatenate([self.response, np.zeros((*rows, len(new)))], axis=2)
        return ModelPart(terms=(*self.terms, *new), term_covariance=covariance, response=response)


class Posterior(StoredTable):
    """Mean and covariance of all unknowns."""

    space: Literal["wrench", "channel"]
    """Whether rows are components of the wrench, by the prior matrix or a rough one, or channels."""
    variables: tuple[str, ...]
    """Names of the variables."""
    sessions: tuple[str, ...]
    """Names of the sessions."""
    drift: bool
    """Whether every session has a drift too."""
    mean: Annotated[FloatArray, ArrayField((None, None))]
    """Unknowns of every row; shape (rows, p); per N, per N m, per unit, offset, offset per second."""
    covariance: Annotated[FloatArray, ArrayField((None, None, None))]
    """Their covariance, repeatability included; shape (rows, p, p)."""
    mean_covariance: Annotated[FloatArray, ArrayField((None, 6, 6))]
    """Covariance of the six coefficients without the repeatability; shape (rows, 6, 6)."""
    prior_covariance: Annotated[FloatArray, ArrayField((None, 6, 6))] | None
    """Covariance of the six coefficients before any data; shape (rows, 6, 6); None without a prior."""
    to_wrench: Annotated[FloatArray, ArrayField((6, None))]
    """Error of a wrench per error of a row; shape (6, rows)."""
    noise: tuple[RowNoise, ...]
    """Noise of every row."""
    accuracy: Annotated[FloatArray, ArrayField((6,), minimum=0.0)]
    """Accuracy of the reference that was taken for granted; N, N m."""
    repeatability: float = Field(ge=0.0)
    """Share of its response by which the sensor differs from one motion to the next."""
    load_centre: Annotated[FloatArray, ArrayField((6,))]
    """Mean fitted wrench; N, N m."""
    model: ModelPart | None = None
    """Errors of the robot model; None where it was taken as exact."""

    @property
    def cross_talk(self) -> FloatArray:
        """What the sensor reads of loads in components that it does not measure, which nothing corrects.

        Returns:
            Reading per load; shape (6, 6); zeros for a sensor of six components.
        """
        measured = self.to_wrench.any(axis=1)
        if measured.all():
            return np.zeros((LOADS, LOADS))
        return np.where(measured, 0.0, self.to_wrench @ self.mean[:, :LOADS])

    @property
    def model_covariance(self) -> FloatArray | None:
        """Part of the covariance that would go if the robot model were known exactly; None where it was taken as exact.

        Returns:
            Covariance; shape (rows, p, p).
        """
        return None if self.model is None else self.model.covariance

    def error_covariance(self, wrench: Any, *, variables: Any = None, session: str | None = None) -> FloatArray:
        """Predict the covariance of the error of readings under given loads.

        Args:
            wrench: Loads; shape (..., 6); N, N m.
            variables: Variables less their reference values; shape (..., v); None for reference values.
            session: Session whose offset the readings are taken with; None for an offset that is known, so that
                wrenches are changes of load.

        Returns:
            Mean product of measured minus true wrench, in components that are measured; shape (..., 6, 6).

        Raises:
            ShapeError: If the shapes are not these, or there is no such session.
        """
        load = np.asarray(wrench, dtype=np.float64)
        if load.ndim == 0 or load.shape[-1] != 6:
            raise ShapeError(f"wrench: expected shape (..., 6), got {load.shape}")
        design = np.zeros((*load.shape[:-1], self.mean.shape[1]))
        design[..., :6] = load
        v = len(self.variables)
        if variables is not None:
            values = np.asarray(variables, dtype=np.float64)
            require_shape(values, name="variables", shape=(*load.shape[:-1], v))
            design[..., 6 : 6 + v] = values
        if session is not None:
            require_known(session, self.sessions, ShapeError, f"no session is called {session!r}")
            design[..., 6 + v + self.sessions.index(session)] = 1.0
        covariance = self._in_wrench(np.einsum("...j,ijk,...k->...i", design, self.covariance, design))
        disturbed = load @ self.cross_talk.T
        return covariance + disturbed[..., :, None] * disturbed[..., None, :]

    def prior_error_covariance(self, wrench: Any) -> FloatArray | None:
        """Predict the covariance of the error that the prior matrix makes of changes of load, before any data.

        Args:
            wrench: Changes of load; shape (..., 6); N, N m.

        Returns:
            Covariance; shape (..., 6, 6); None without a prior.
        """
        if self.prior_covariance is None:
            return None
        load = np.asarray(wrench, dtype=np.float64)
        return self._in_wrench(np.einsum("...j,ijk,...k->...i", load, self.prior_covariance, load))

    def learnt_error_covariance(self, wrench: Any) -> FloatArray:
        """Predict the covariance of the error of changes of load, as if the sensor repeated itself exactly.

        Args:
            wrench: Changes of load; shape (..., 6); N, N m.

        Returns:
            Covariance; shape (..., 6, 6).
        """
        load = np.asarray(wrench, dtype=np.float64)
        return self._in_wrench(np.einsum("...j,ijk,...k->...i", load, self.mean_covariance, load))

    def learnt_shares(self) -> FloatArray | None:
        """Tell how much less than before is left of the uncertainty of each load direction.

        Returns:
            One less the standard deviation after over that before, of the error that a load along each component makes,
            root mean square over the components of the error; shape (6,); None without a prior.
        """
        before = self.prior_error_covariance(np.eye(6))
        if before is None:
            return None
        after = self.learnt_error_covariance(np.eye(6))
        measured = self.to_wrench.any(axis=1)
        ratios = np.einsum("kii->ki", after)[:, measured] / np.einsum("kii->ki", before)[:, measured]
        return 1.0 - np.sqrt(ratios.mean(axis=1))

    def matrix_error(self, matrix: FloatArray) -> FloatArray:
        """Give the standard errors of the calibration matrix.

        Args:
            matrix: The matrix; shape (6, c).

        Returns:
            Standard errors, to first order; shape (6, c); N/count, N m/count.
        """
        variance = np.einsum("jb,ijk,kb->ib", matrix, self.covariance[:, :6, :6], matrix)
        return np.sqrt(np.maximum(self.to_wrench**2 @ variance, 0.0))

    def coefficient_error(self, coefficients: FloatArray) -> FloatArray:
        """Give the standard errors of the coefficients of the variables.

        Args:
            coefficients: The coefficients; shape (6, v).

        Returns:
            Standard errors, to first order; shape (6, v); N, N m per unit.
        """
        errors = np.zeros_like(coefficients)
        for k in range(coefficients.shape[1]):
            # the coefficient is read through the matrix, whose own error moves it too
            errors[:, k] = self._spread(coefficients[:, k], 6 + k)
        return errors

    def offset_error(self, offset: FloatArray, session: str) -> FloatArray:
        """Give the standard errors of the offset of a session.

        Args:
            offset: The offset in wrench space; shape (6,); N, N m.
            session: The session.

        Returns:
            Standard errors, to first order; shape (6,); N, N m.
        """
        return self._spread(offset, 6 + len(self.variables) + self.sessions.index(session))

    def _spread(self, wrench: FloatArray, place: int) -> FloatArray:
        design = np.zeros(self.mean.shape[1])
        design[:6], design[place] = wrench, 1.0
        variance = np.einsum("j,ijk,k->i", design, self.covariance, design)
        return np.sqrt(np.maximum(self.to_wrench**2 @ variance, 0.0))

    def _in_wrench(self, variance: FloatArray) -> FloatArray:
        return np.einsum("ai,...i,bi->...ab", self.to_wrench, variance, self.to_wrench)


class LoadError(StoredTable):
    """Errors of response and offsets that come of the loads.

    Loads phi and response E were estimated together, with covariance S of phi and T of E and phi. A fit of E under the
    estimated loads has the covariance of E given phi; what the loads add is `T S^-1 T^T`, here as `factor factor^T`.
    """

    sessions: tuple[str, ...]
    """Power-ups whose offsets it moves."""
    factor: Annotated[FloatArray, ArrayField((LOADS, None, None))]
    """Of every component of the reading, what each of q independent errors of size 1 does to the six coefficients of
    its response and to its offsets; shape (6, 6 + sessions, q); per N, per N m; N, N m."""

    @classmethod
    def largest(cls, errors: Iterable[LoadError | None]) -> LoadError | None:
        """Choose among what several recordings carry.

        Args:
            errors: Of each recording; the same of those that were weighed together.

        Returns:
            The one that moves the response most: moments that were stored apart do not say what their loads have in
            common. None if none carries any.
        """
        known = [error for error in errors if error is not None]
        return max(known, key=lambda error: float((error.factor[:, :LOADS] ** 2).sum()), default=None)

    def widened(self, posterior: Posterior, prior: FloatArray) -> Posterior:
        """Add what the loads leave open to what a fit knows under them.

        Args:
            posterior: What the fit knows.
            prior: Prior matrix, by which the loads were weighed; shape (6, c).

        Returns:
            The posterior with wider covariances.
        """
        placed = self._placed(posterior)
        if posterior.space == "channel":
            response = np.linalg.pinv(prior)
            placed = np.einsum("ji,ipq->jpq", response, placed)
        added = placed @ placed.transpose(0, 2, 1)
        return posterior.model_copy(
            update={
                "covariance": posterior.covariance + added,
                "mean_covariance": posterior.mean_covariance + added[:, :LOADS, :LOADS],
            }
        )

    def _placed(self, posterior: Posterior) -> FloatArray:
        """The factor at the places of the posterior's unknowns; shape (6, p, q)."""
        placed = np.zeros((LOADS, posterior.mean.shape[1], self.factor.shape[2]))
        placed[:, :LOADS] = self.factor[:, :LOADS]
        first = LOADS + len(posterior.variables)
        for place, session in enumerate(posterior.sessions, start=first):
            number = next((k for k, name in enumerate(self.sessions) if _same(name, session)), None)
            if number is not None:
                placed[:, place] = self.factor[:, LOADS + number]
        return placed


def _same(name: str, session: str) -> bool:
    """Whether a power-up is a session, with or without its recording in front."""
    return name == session or name.endswith(f": {session}")
