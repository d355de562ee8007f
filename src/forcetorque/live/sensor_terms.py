# SPDX-License-Identifier: BSD-3-Clause
"""What a live sensor takes from its calibration: the linear model of its samples, and the covariance of its error."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError, RecordingError, known_names
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.posterior import Posterior
from forcetorque.experiment.calibration.quadratic_correction import QuadraticCorrection
from forcetorque.experiment.calibration.sensor_model import measured_components, secondary_matrix
from forcetorque.live.option_values import HeldQuantity


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SensorTerms:
    """Model of one sensor, of samples of c numbers and v variables."""

    matrix: FloatArray
    """From the sample to the wrench; shape (6, c)."""
    coefficients: FloatArray
    """Of the variables; shape (6, v); N, N m per unit."""
    reference_values: FloatArray
    """Values at which the variables contribute nothing; shape (v,)."""
    offset: FloatArray
    """Fitted offset; shape (6,); N, N m."""
    session: str | None
    """Power cycle that the offset is of; None where the calibration has no names of them."""
    variables: tuple[str, ...]
    """Names of the variables."""
    quadratic: QuadraticCorrection | None
    """Quadratic terms; None for a linear sensor."""
    to_counts: FloatArray | None
    """From the sample back to counts; shape (6, 6); None where samples are counts."""
    covariance: FloatArray
    """Of every component, what the error has of loads, variables and offset: `d covariance d` is its variance for
    `d = (load, variables less reference values, 1)`; shape (6, 7 + v, 7 + v); NaN without a posterior."""


def sensor_terms(
    calibration: Calibration, quantity: HeldQuantity, session: str | None, *, with_offset_error: bool
) -> SensorTerms:
    """Take the terms of a calibration.

    Args:
        calibration: The calibration.
        quantity: What samples hold.
        session: Power cycle whose offset is taken; None for the last.
        with_offset_error: Whether the error of the fitted offset counts.

    Returns:
        The terms.

    Raises:
        RecordingError: If the calibration has no such session.
        FitError: If samples are wrenches, and there is no prior that can be inverted, or the sensor measures fewer than
            six components.
    """
    if not measured_components(calibration.matrix).all():
        raise FitError(f"calibration of {calibration.sensor.name!r}: expected one of a sensor of six components")
    names = [entry.name for entry in calibration.sessions]
    if session is not None and session not in names:
        raise RecordingError(
            f"calibration of {calibration.sensor.name!r}: no session {session!r}; {known_names(session, names)}"
        )
    chosen = calibration if session is None else calibration.in_session(session)
    model = chosen.model
    matrix = model.matrix
    to_counts: FloatArray | None = None
    if quantity is HeldQuantity.WRENCH:
        if calibration.prior is None or calibration.prior.matrix.shape != (6, 6):
            raise FitError(
                f"calibration of {calibration.sensor.name!r}: samples that are wrenches need its prior matrix of six "
                "channels, got none; give raw counts"
            )
        matrix = secondary_matrix(model.matrix, calibration.prior.matrix)
        to_counts = np.asarray(np.linalg.inv(calibration.prior.matrix), dtype=np.float64)
    variables = tuple(variable.name for variable in calibration.variables)
    named = session if session is not None else next(reversed(names), None)
    return SensorTerms(
        matrix=matrix,
        coefficients=model.coefficients,
        reference_values=model.reference_values,
        offset=model.offset,
        session=named,
        variables=variables,
        quadratic=model.quadratic,
        to_counts=to_counts,
        covariance=_covariance(calibration.posterior, variables, named if with_offset_error else None),
    )


def _covariance(posterior: Posterior | None, variables: tuple[str, ...], session: str | None) -> FloatArray:
    """The posterior's, in the order of load, variables and offset; without a session the offset is known."""
    size = 7 + len(variables)
    if posterior is None:
        return np.full((6, size, size), np.nan)
    places = list(range(6))
    places += [6 + posterior.variables.index(name) if name in posterior.variables else -1 for name in variables]
    places.append(6 + len(posterior.variables) + posterior.sessions.index(session) if session is not None else -1)
    own = np.flatnonzero(np.array(places) >= 0)
    there = np.array(places)[own]
    covariance = np.zeros((6, size, size))
    of_rows = posterior.covariance[:, there[:, None], there]
    covariance[:, own[:, None], own] = np.einsum("ai,ijk->ajk", posterior.to_wrench**2, of_rows)
    return covariance
