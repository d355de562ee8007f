# SPDX-License-Identifier: BSD-3-Clause
"""All sensors of a robot at once, from equations of parts that nothing touches.

The unknowns, changes of all matrices, offsets and errors of the model, are normal with a prior: the size of a sensor's
changes follows from the data (evidence), tolerances of the model are stated. The noise of every row of every part is
what is left over, found by iteration. Noise of the readings stands in the coefficients too: its expected part of the
normal equations is taken off, no more of it than what is left over can hold (errors in variables).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.calibration.joint.model_error import ZERO, ErrorTerm
from forcetorque.calibration.joint.sums import PartSums, Places
from forcetorque.calibration.joint.windows import UNITS
from forcetorque.errors import FitError

CHANGE: Final = 0.05
"""Expected size of an entry of a change, in `UNITS`, before data tell it."""
_CHANGE_WEIGHT = 4.0
"""Coefficients' worth of data that the expectation counts for."""
_EXPECTED = 0.04
_SMALLEST, _LARGEST = 0.003, 0.15
_OFFSET_DEVIATION = 1e3
"""Standard deviation of an offset before any data, in `UNITS`: hardly anything is known of it.

Much more would cost the digits that directions need which only the prior tells, such as a joint's zero from the frame
of the sensor beside it.
"""
_REPEATS = 4.0
"""Residuals of neighbouring windows are alike, so that n windows tell as much as n over this."""
_LEAST_VARIANCE = 1e-4
_NOISE_SHARE = 0.9
"""Largest share of what is left over that noise of the readings may claim: taking off more explodes."""
_ROUNDS = 12


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class JointFit:
    """What equations of parts say of all sensors together; unknowns in `UNITS`."""

    places: Places
    """Where the unknowns stand."""
    mean: FloatArray
    """Most probable values; shape (p,)."""
    covariance: FloatArray
    """Their covariance; shape (p, p)."""
    deviations: FloatArray
    """Standard deviation of each before any data; shape (p,)."""
    residual: tuple[tuple[str, str, FloatArray], ...]
    """Part, recording and root mean square of what is left of its equation, shape (6,); N, N m."""

    def change(self, sensor: str) -> FloatArray:
        """Give what the wrenches by the prior matrix of a sensor are to be multiplied by.

        Args:
            sensor: The sensor.

        Returns:
            1 + D; shape (6, 6); N, N m.
        """
        change = self.mean[self.places.changes(sensor)].reshape(6, 6)
        factor: FloatArray = np.eye(6) + UNITS[:, None] * change / UNITS
        return factor

    def offset(self, sensor: str, session: str) -> FloatArray:
        """Give what is to be added to the wrenches of a sensor.

        Args:
            sensor: The sensor.
            session: The session.

        Returns:
            Offset; shape (6,); N, N m.
        """
        offset: FloatArray = self.mean[self.places.offset(sensor, session)] * UNITS
        return offset

    def wrench(self, sensor: str, session: str, readings: FloatArray) -> FloatArray:
        """Correct what a sensor reads by its prior matrix.

        Args:
            sensor: The sensor.
            session: The session.
            readings: Wrenches by the prior matrix, without offset; shape (n, 6); N, N m.

        Returns:
            Wrenches; shape (n, 6); N, N m.
        """
        wrench: FloatArray = readings @ self.change(sensor).T + self.offset(sensor, session)
        return wrench

    def joint_zeros(self) -> dict[str, float]:
        """Give what is to be added to the positions of joints.

        Returns:
            By the name of the joint; rad or m.
        """
        return {
            term.name.removeprefix(ZERO): value for term, value, _ in self.model_errors() if term.name.startswith(ZERO)
        }

    def error_covariance(self, sensor: str, load: FloatArray) -> FloatArray:
        """Predict the covariance of the error of changes of load.

        Args:
            sensor: The sensor.
            load: Change of the load; shape (..., 6); N, N m.

        Returns:
            Covariance; shape (..., 6, 6).
        """
        own = self.places.changes(sensor)
        covariance = self.covariance[own, own].reshape(6, 6, 6, 6)
        unit = np.asarray(load, dtype=np.float64) / UNITS
        scaled: FloatArray = np.einsum("...b,abcd,...d->...ac", unit, covariance, unit) * np.outer(UNITS, UNITS)
        return scaled

    def prior_error_covariance(self, sensor: str, load: FloatArray) -> FloatArray:
        """Predict the covariance of the error of changes of load by the prior matrix.

        Args:
            sensor: The sensor.
            load: Change of the load; shape (..., 6); N, N m.

        Returns:
            Covariance; shape (..., 6, 6).
        """
        variance = (self.deviations[self.places.changes(sensor)] ** 2).reshape(6, 6)
        unit = np.asarray(load, dtype=np.float64) / UNITS
        covariance: FloatArray = (unit**2 @ variance.T * UNITS**2)[..., None] * np.eye(6)
        return covariance

    def model_errors(self) -> list[tuple[ErrorTerm, float, float]]:
        """Give what was found to be wrong with the model.

        Returns:
            Every term with its value and what is left of its standard deviation, in its unit.
        """
        own = self.places.errors
        deviations = np.sqrt(np.diag(self.covariance)[own])
        return list(zip(self.places.terms, self.mean[own].tolist(), deviations.tolist(), strict=True))


def fit_jointly(sums: Sequence[PartSums], terms: Sequence[ErrorTerm] = ()) -> JointFit:
    """Find what is most probable.

    Args:
        sums: Moments of the equations.
        terms: Errors of the model that their coefficients allow for.

    Returns:
        The fit.

    Raises:
        FitError: If there are no equations.
    """
    if not sums:
        raise FitError("joint calibration: no window of any part has readings and motion; look for gaps in the log")
    places = Places.of(sums, terms)
    columns = [places.of_part(part.sensors, part.session, part.terms) for part in sums]
    one = np.zeros(len(places))
    for sensor in places.sensors:
        one[places.changes(sensor)] = np.eye(6).ravel()
    size = np.full(len(places.sensors), CHANGE)
    variance = [np.maximum(0.01 * part.square / part.count, _LEAST_VARIANCE) for part in sums]
    mean = np.zeros(len(places))
    for sweep in range(_ROUNDS):
        deviations = _deviations(places, size)
        products, shared = np.zeros((len(places), len(places))), np.zeros(len(places))
        for part, own, spread in zip(sums, columns, variance, strict=True):
            _add(products, shared, part, own, spread, one[own], mean)
        values, vectors = np.linalg.eigh(deviations[:, None] * products * deviations)
        # where noise explains everything the prior stays
        scaled = vectors * deviations[:, None]
        covariance = (scaled / (np.maximum(values, 0.0) + 1.0)) @ scaled.T
        mean = covariance @ shared
        variance = [np.maximum(part.rest(mean[own]), _LEAST_VARIANCE) for part, own in zip(sums, columns, strict=True)]
        if 1 < sweep < _ROUNDS - 1:
            size = _sizes(places, mean, covariance, size)
    residual = tuple(
        (part.part, part.recording, np.sqrt(spread) * UNITS) for part, spread in zip(sums, variance, strict=True)
    )
    return JointFit(places=places, mean=mean, covariance=covariance, deviations=deviations, residual=residual)


def _add(
    products: FloatArray,
    shared: FloatArray,
    part: PartSums,
    own: IntArray,
    variance: FloatArray,
    one: FloatArray,
    mean: FloatArray,
) -> None:
    """Add the equations of a part, each row by the noise that is left over, less what noise adds."""
    changes, scale = part.noise.shape[1], float(part.common @ mean[own])
    for row in range(6):
        weight = 1.0 / (variance[row] * _REPEATS)
        noise = part.noise[row]
        claimed = one[:changes] @ noise @ one[:changes] / part.count
        share = 1.0 if claimed <= 0.0 else min(1.0, _NOISE_SHARE * variance[row] / claimed)
        left, right = part.products[row].copy(), part.shared[row].copy()
        left[:changes, :changes] -= share * noise
        right[:changes] += share * noise @ one[:changes]  # the same noise stands in coefficients and right side
        # what else is left over grows with all sensors and masses together: a fit would shrink them alike for nothing
        right += max(variance[row] - share * claimed, 0.0) * part.count * (1.0 + scale) * part.common
        products[np.ix_(own, own)] += weight * left
        shared[own] += weight * right


def _deviations(places: Places, size: FloatArray) -> FloatArray:
    deviations = np.full(len(places), _OFFSET_DEVIATION)
    for sensor, own in zip(places.sensors, size, strict=True):
        deviations[places.changes(sensor)] = own
    deviations[places.errors] = [term.deviation for term in places.terms]
    return deviations


def _sizes(places: Places, mean: FloatArray, covariance: FloatArray, size: FloatArray) -> FloatArray:
    """Size of the changes of every sensor, by what the data tell of them."""
    sizes = np.empty_like(size)
    for k, sensor in enumerate(places.sensors):
        own = places.changes(sensor)
        told = 36.0 - float(np.diag(covariance)[own].sum()) / size[k] ** 2
        square = float(mean[own] @ mean[own]) + _CHANGE_WEIGHT * _EXPECTED**2
        sizes[k] = np.clip(np.sqrt(square / (max(told, 0.0) + _CHANGE_WEIGHT)), _SMALLEST, _LARGEST)
    return sizes
