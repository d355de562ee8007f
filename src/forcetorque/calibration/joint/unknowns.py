# SPDX-License-Identifier: BSD-3-Clause
"""Unknowns of a joint fit: units, places in the vector, most probable values, how far sensors are from priors."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Final, Self

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray, require_shape
from forcetorque.calibration.generative.fit import FRAME_CHANGES
from forcetorque.experiment.calibration.expected_sensor_errors import (
    COEFFICIENTS_TOGETHER,
    GAIN,
    LOADS,
    STATED,
    Assumptions,
    Scale,
    mount_scales,
    sensor_root,
)
from forcetorque.experiment.calibration.joint_posterior import LENGTH_M
from forcetorque.experiment.calibration.robot_model_error import ZERO, ErrorTerm

UNITS: Final = np.array([1.0, 1.0, 1.0, LENGTH_M, LENGTH_M, LENGTH_M])
"""Unit of every component; N, N m."""
CHANGES: Final = 36
"""Changes of the matrix of one sensor."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Places:
    """Where the unknowns stand: changes of every sensor, offsets by session, errors of the model."""

    sensors: tuple[str, ...]
    """Sensors."""
    offsets: Mapping[tuple[str, str], int]
    """Number of the offset of a sensor in a session."""
    terms: tuple[ErrorTerm, ...]
    """Errors of the model."""

    @classmethod
    def of(cls, offsets: Iterable[tuple[str, str]], terms: Sequence[ErrorTerm]) -> Places:
        """Lay out the unknowns of equations.

        Args:
            offsets: Sensor and session of every offset in the equations; repeated pairs count once.
            terms: Errors of the model.

        Returns:
            The places.
        """
        pairs = dict.fromkeys(offsets)
        return cls(
            sensors=tuple(dict.fromkeys(name for name, _ in pairs)),
            offsets={pair: number for number, pair in enumerate(pairs)},
            terms=tuple(terms),
        )

    def __len__(self) -> int:
        return CHANGES * len(self.sensors) + LOADS * len(self.offsets) + len(self.terms)

    def changes(self, sensor: str) -> slice:
        """Give the places of the changes of a sensor, row by row.

        Returns:
            36 places.
        """
        start = CHANGES * self.sensors.index(sensor)
        return slice(start, start + CHANGES)

    def offset(self, sensor: str, session: str) -> slice:
        """Give the places of an offset.

        Returns:
            Six places.
        """
        start = CHANGES * len(self.sensors) + LOADS * self.offsets[sensor, session]
        return slice(start, start + LOADS)

    @property
    def errors(self) -> slice:
        """The places of the errors of the model."""
        return slice(len(self) - len(self.terms), len(self))

    def of_part(self, sensors: Sequence[str], session: str, terms: Sequence[str]) -> IntArray:
        """Give the places of the coefficients of a part.

        Args:
            sensors: Its sensors.
            session: The session.
            terms: Names of the errors of the model that it depends on.

        Returns:
            Places in the order of the coefficients; shape (p,).
        """
        own = [self.changes(name) for name in sensors]
        own += [self.offset(name, session) for name in sensors]
        numbers = {term.name: number for number, term in enumerate(self.terms, start=self.errors.start)}
        return np.concatenate(
            [*(np.arange(s.start, s.stop) for s in own), np.array([numbers[name] for name in terms], dtype=np.int64)]
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class JointFit:
    """What equations of parts say of all sensors together; unknowns in `UNITS`."""

    places: Places
    """Where the unknowns stand."""
    mean: FloatArray
    """Most probable values; shape (p,)."""
    covariance: FloatArray
    """Covariance of their errors if changes are as large as evidence says; shape (p, p)."""
    prior_root: FloatArray
    """R, with R R^T the covariance of the unknowns before any data, by evidence; shape (p, q)."""

    def change(self, sensor: str) -> FloatArray:
        """Give what the wrenches by the prior matrix of a sensor are to be multiplied by.

        Returns:
            1 + D; shape (6, 6); N, N m.
        """
        change = self.mean[self.places.changes(sensor)].reshape(6, 6)
        return np.eye(6) + UNITS[:, None] * change / UNITS

    def offset(self, sensor: str, session: str) -> FloatArray:
        """Give what is to be added to the wrenches of a sensor.

        Returns:
            Offset; shape (6,); N, N m.
        """
        return self.mean[self.places.offset(sensor, session)] * UNITS

    def wrench(self, sensor: str, session: str, readings: FloatArray) -> FloatArray:
        """Correct what a sensor reads by its prior matrix.

        Args:
            sensor: The sensor.
            session: The session.
            readings: Wrenches by the prior matrix, without offset; shape (n, 6); N, N m.

        Returns:
            Wrenches; shape (n, 6); N, N m.
        """
        return readings @ self.change(sensor).T + self.offset(sensor, session)

    def reading(self, sensor: str, session: str, wrenches: FloatArray) -> FloatArray:
        """Give what a sensor reads of wrenches by its prior matrix.

        Args:
            sensor: The sensor.
            session: The session.
            wrenches: Wrenches; shape (n, 6); N, N m.

        Returns:
            Readings without offset; shape (n, 6); N, N m.
        """
        readings = np.linalg.solve(self.change(sensor), (wrenches - self.offset(sensor, session)).T).T
        return np.asarray(readings, dtype=np.float64)

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
        return np.einsum("...b,abcd,...d->...ac", unit, covariance, unit) * np.outer(UNITS, UNITS)

    def prior_covariance(self, sensor: str) -> FloatArray:
        """Give the covariance of the changes of a sensor before any data.

        Returns:
            Covariance, row by row; shape (36, 36); in `UNITS`.
        """
        own = self.places.changes(sensor)
        root = self.prior_root[own]
        return root @ root.T

    def model_errors(self) -> list[tuple[ErrorTerm, float, float]]:
        """Give what was found to be wrong with the model.

        Returns:
            Every term with its value and what is left of its standard deviation, in its unit.
        """
        own = self.places.errors
        deviations = np.sqrt(np.diag(self.covariance)[own])
        return list(zip(self.places.terms, self.mean[own].tolist(), deviations.tolist(), strict=True))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SensorPrior:
    """The q unknowns of a sensor, and what they are worth in its changes D."""

    basis: FloatArray
    """What the unknowns add to D row by row, in `UNITS`; shape (36, q)."""
    scales: tuple[Scale, ...]
    """Expected sizes of their kinds."""
    kinds: tuple[int, ...]
    """Number of the kind of every unknown; q of them."""

    @classmethod
    def of(cls, matrix: FloatArray, assumptions: Assumptions) -> Self:
        """Tell it from a prior matrix.

        Args:
            matrix: Prior matrix; shape (6, c); N/count, N m/count.
            assumptions: Full scales of the channels, and how far matrix and frame may be off.

        Returns:
            The prior distribution: every coefficient relative to the root mean square of its row, gains of channels,
            rotation (rad) and shift (m) of the frame.
        """
        channels = matrix.shape[1]
        require_shape(assumptions.full_scale, name="full_scale", shape=(channels,))
        scaled = matrix * assumptions.full_scale
        response = np.asarray(np.linalg.pinv(scaled), dtype=np.float64)
        size = np.sqrt((scaled**2).mean(axis=1))
        stated = assumptions.prior_size
        expected, own = (COEFFICIENTS_TOGETHER, np.ones(LOADS)) if stated is None else (STATED, stated)
        coefficients = np.zeros((LOADS, LOADS, CHANGES))
        for row in range(LOADS):
            coefficients[row, :, LOADS * row : LOADS * (row + 1)] = own[row] * size[row] * sensor_root(response)
        gains = np.einsum("kc,cd->kdc", scaled, response)
        moved = FRAME_CHANGES.transpose(1, 2, 0)
        basis = np.concatenate([coefficients, gains, moved], axis=2) * UNITS[:, None] / UNITS[:, None, None]
        return cls(
            basis=basis.reshape(CHANGES, -1),
            scales=(expected, expected, GAIN, *mount_scales(assumptions.mount)),
            kinds=tuple(np.repeat(np.arange(5), [CHANGES // 2, CHANGES // 2, channels, 3, 3]).tolist()),
        )


EVEN: Final = SensorPrior(basis=np.eye(CHANGES), scales=(COEFFICIENTS_TOGETHER,), kinds=(0,) * CHANGES)
"""Every coefficient of D scatters alike: for a sensor of which no matrix is known."""
