# SPDX-License-Identifier: BSD-3-Clause
"""Unknowns of a joint fit: units, places in the vector, most probable values, how far sensors are from priors."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Final, Self

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray, require_shape
from forcetorque.calibration.generative.fit import gain_and_frame_changes
from forcetorque.experiment.calibration.expected_sensor_errors import (
    COEFFICIENTS_TOGETHER,
    GAIN,
    LOADS,
    STATED,
    Assumptions,
    Scale,
    mount_scales,
    sensor_root,
    variable_sizes,
)
from forcetorque.experiment.calibration.joint_posterior_and_robot_correction import LENGTH_M
from forcetorque.experiment.calibration.robot_model_error import ZERO, ErrorTerm
from forcetorque.experiment.calibration.sensor_model import LinearVariable

UNITS: Final = np.array([1.0, 1.0, 1.0, LENGTH_M, LENGTH_M, LENGTH_M])
"""Unit of every component; N, N m."""
CHANGES: Final = 36
"""Changes of the matrix of one sensor."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Places:
    """Where the unknowns stand: changes of every sensor, offsets by session, slopes, errors of the model."""

    sensors: tuple[str, ...]
    """Sensors."""
    offsets: Mapping[tuple[str, str], int]
    """Number of the offset of a sensor in a session."""
    terms: tuple[ErrorTerm, ...]
    """Errors of the model."""
    slopes: Mapping[tuple[str, str], int]
    """Number of the slope of a sensor by a variable."""

    @classmethod
    def of(
        cls,
        offsets: Iterable[tuple[str, str]],
        terms: Sequence[ErrorTerm],
        slopes: Iterable[tuple[str, str]] = (),
    ) -> Places:
        """Lay out the unknowns of equations.

        Args:
            offsets: Sensor and session of every offset in the equations; repeated pairs count once.
            terms: Errors of the model.
            slopes: Sensor and variable of every slope in the equations; repeated pairs count once.

        Returns:
            The places.
        """
        pairs = dict.fromkeys(offsets)
        return cls(
            sensors=tuple(dict.fromkeys(name for name, _ in pairs)),
            offsets={pair: number for number, pair in enumerate(pairs)},
            terms=tuple(terms),
            slopes={pair: number for number, pair in enumerate(dict.fromkeys(slopes))},
        )

    def __len__(self) -> int:
        return CHANGES * len(self.sensors) + LOADS * (len(self.offsets) + len(self.slopes)) + len(self.terms)

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

    def slope(self, sensor: str, variable: str) -> slice:
        """Give the places of a slope.

        Returns:
            Six places.
        """
        start = CHANGES * len(self.sensors) + LOADS * (len(self.offsets) + self.slopes[sensor, variable])
        return slice(start, start + LOADS)

    @property
    def errors(self) -> slice:
        """The places of the errors of the model."""
        return slice(len(self) - len(self.terms), len(self))

    def of_part(
        self, sensors: Sequence[str], session: str, slopes: Sequence[tuple[str, str]], terms: Sequence[str]
    ) -> IntArray:
        """Give the places of the coefficients of a part.

        Args:
            sensors: Its sensors.
            session: The session.
            slopes: Sensor and variable of its slopes.
            terms: Names of the errors of the model that it depends on.

        Returns:
            Places in the order of the coefficients; shape (p,).
        """
        own = [self.changes(name) for name in sensors]
        own += [self.offset(name, session) for name in sensors]
        own += [self.slope(*pair) for pair in slopes]
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

    def slope(self, sensor: str, variable: str) -> FloatArray:
        """Give what is to be added to the wrenches of a sensor per unit of a variable.

        Returns:
            Slope; shape (6,); N, N m per unit.
        """
        return self.mean[self.places.slope(sensor, variable)] * UNITS

    def added(self, sensor: str, session: str, variables: Mapping[tuple[str, str], FloatArray]) -> FloatArray:
        """Give what is to be added to the wrenches of a sensor at some instants.

        Args:
            sensor: The sensor.
            session: The session.
            variables: By sensor and name, variables less their reference values; shape (n, 1) each.

        Returns:
            Offset and what the variables add; shape (6,), or (n, 6) where the sensor has variables; N, N m.
        """
        total = self.offset(sensor, session)
        for (owner, name), values in variables.items():
            if owner == sensor:
                total = total + values * self.slope(sensor, name)
        return total

    def wrench(
        self, sensor: str, session: str, readings: FloatArray, variables: Mapping[tuple[str, str], FloatArray]
    ) -> FloatArray:
        """Correct what a sensor reads by its prior matrix.

        Args:
            sensor: The sensor.
            session: The session.
            readings: Wrenches by the prior matrix, without offset; shape (n, 6); N, N m.
            variables: As of `added`.

        Returns:
            Wrenches; shape (n, 6); N, N m; NaN where the fit has no offset of the sensor in the session.
        """
        if (sensor, session) not in self.places.offsets:
            return np.full_like(readings, np.nan)
        return readings @ self.change(sensor).T + self.added(sensor, session, variables)

    def reading(
        self, sensor: str, session: str, wrenches: FloatArray, variables: Mapping[tuple[str, str], FloatArray]
    ) -> FloatArray:
        """Give what a sensor reads of wrenches by its prior matrix.

        Args:
            sensor: The sensor.
            session: The session.
            wrenches: Wrenches; shape (n, 6); N, N m.
            variables: As of `added`.

        Returns:
            Readings without offset; shape (n, 6); N, N m; NaN as of `wrench`.
        """
        if (sensor, session) not in self.places.offsets:
            return np.full_like(wrenches, np.nan)
        readings = np.linalg.solve(self.change(sensor), (wrenches - self.added(sensor, session, variables)).T).T
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
    slopes: Mapping[str, FloatArray] = field(default_factory=dict)
    """Standard deviation of what a unit of every variable adds; shape (6,) each; in `UNITS` per unit."""
    expected_slopes: Mapping[str, FloatArray] = field(default_factory=dict)
    """What it is expected to add, of variables of which that is stated; shape (6,) each; in `UNITS` per unit."""

    @classmethod
    def of(
        cls, matrix: FloatArray, assumptions: Assumptions, extents: Sequence[tuple[LinearVariable, float]] = ()
    ) -> Self:
        """Tell it from a prior matrix.

        Args:
            matrix: Prior matrix; shape (6, c); N/count, N m/count.
            assumptions: Full scales of the channels, and how far matrix and frame may be off.
            extents: Linear variables, and over which range each was seen.

        Returns:
            The prior distribution: every coefficient relative to the root mean square of its row, gains of channels,
            rotation (rad) and shift (m) of the frame; slopes by what is stated, or of all channels together.

        Raises:
            FitError: If nothing is known of a slope, and its variable never moved.
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
        changes = gain_and_frame_changes(scaled, np.eye(LOADS), response)
        basis = np.concatenate([coefficients, changes], axis=2) * UNITS[:, None] / UNITS[:, None, None]
        return cls(
            basis=basis.reshape(CHANGES, -1),
            scales=(expected, expected, GAIN, *mount_scales(assumptions.mount)),
            kinds=tuple(np.repeat(np.arange(5), [CHANGES // 2, CHANGES // 2, channels, 3, 3]).tolist()),
            slopes={
                variable.name: size * variable_sizes(variable, np.diag(1.0 / size), extent) / UNITS
                for variable, extent in extents
            },
            expected_slopes={
                variable.name: variable.prior / UNITS for variable, _ in extents if variable.prior is not None
            },
        )


EVEN: Final = SensorPrior(basis=np.eye(CHANGES), scales=(COEFFICIENTS_TOGETHER,), kinds=(0,) * CHANGES)
"""Every coefficient of D scatters alike: for a sensor of which no matrix is known."""
