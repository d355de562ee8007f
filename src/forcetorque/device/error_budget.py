# SPDX-License-Identifier: BSD-3-Clause
"""Errors of a reference: root mean square and largest over a motion, by first order and by drawing."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only
from forcetorque.base.errors import SensorError
from forcetorque.device.expected_wrench import ENCODERS, IMU, Reference
from forcetorque.device.tolerances import Tolerance


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ErrorBudget:
    """First-order errors of the reference of one sensor over n poses."""

    quantities: tuple[str, ...]
    """Quantities that are off."""
    tolerances: tuple[Tolerance, ...]
    """By how much; one per quantity."""
    slopes: FloatArray
    """Change of the wrench per unit of each; shape (k, n, 6)."""

    def __post_init__(self) -> None:
        k = len(self.quantities)
        object.__setattr__(self, "slopes", read_only(self.slopes, name="slopes", shape=(k, None, 6)))
        if k == 0:
            raise SensorError("errors of the reference: expected at least one quantity that is off, got none")

    @classmethod
    def of(cls, reference: Reference, tolerances: Mapping[str, Tolerance]) -> ErrorBudget:
        """Propagate errors of quantities to the wrench.

        Args:
            reference: The reference.
            tolerances: By how much each quantity is off.

        Returns:
            The errors.
        """
        require_one_source(tolerances)
        off = {name: tolerance for name, tolerance in tolerances.items() if not tolerance.is_zero}
        slopes = [reference.slope(name) for name in off]
        return cls(
            quantities=tuple(off),
            tolerances=tuple(off.values()),
            slopes=np.array(slopes).reshape(len(off), len(reference.poses), 6),
        )

    def only(self, *quantities: str) -> ErrorBudget:
        """Leave the other quantities at their true values.

        Args:
            *quantities: Quantities that stay off.

        Returns:
            What they do alone.
        """
        kept = [k for k, name in enumerate(self.quantities) if name in quantities]
        return ErrorBudget(
            quantities=tuple(self.quantities[k] for k in kept),
            tolerances=tuple(self.tolerances[k] for k in kept),
            slopes=self.slopes[kept],
        )

    @property
    def rms(self) -> FloatArray:
        """Root mean square over the poses, and over all devices that are made so; shape (6,); N, N m."""
        variances = np.array([tolerance.variance for tolerance in self.tolerances])
        square = np.einsum("k,knc->nc", variances, self.slopes**2) + self._fixed**2
        return np.asarray(np.sqrt(square.mean(axis=0)), dtype=np.float64)

    @property
    def largest(self) -> FloatArray:
        """Largest magnitude of each component in any pose, all quantities off at worst; shape (6,); N, N m."""
        reach = np.array([tolerance.largest for tolerance in self.tolerances])
        worst = np.einsum("k,knc->nc", reach, np.abs(self.slopes)) + np.abs(self._fixed)
        return np.asarray(worst.max(axis=0), dtype=np.float64)

    @property
    def largest_norms(self) -> tuple[float, float]:
        """Largest norm of the error of the force and of that of the moment, in any pose; N, N m.

        A norm is convex, so that it is largest with every quantity at one of its ends.
        """
        reach = np.array([tolerance.largest for tolerance in self.tolerances])
        force = moment = 0.0
        for signs in product((-1.0, 1.0), repeat=len(reach)):
            error = np.einsum("k,knc->nc", np.array(signs) * reach, self.slopes) + self._fixed
            force = max(force, float(np.linalg.norm(error[:, :3], axis=1).max()))
            moment = max(moment, float(np.linalg.norm(error[:, 3:], axis=1).max()))
        return force, moment

    @property
    def _fixed(self) -> FloatArray:
        return np.asarray(
            np.einsum("k,knc->nc", np.array([tolerance.fixed for tolerance in self.tolerances]), self.slopes)
        )


def drawn_errors(
    reference: Reference, tolerances: Mapping[str, Tolerance], rng: np.random.Generator, draws: int
) -> FloatArray:
    """Draw errors of quantities and compute the reference with them in full, without first orders.

    Args:
        reference: The reference.
        tolerances: By how much each quantity is off.
        rng: Source of random numbers.
        draws: Number of motions, d.

    Returns:
        Wrong less true wrenches; shape (d, n, 6); N, N m.
    """
    require_one_source(tolerances)
    true, n = reference.wrench(), len(reference.poses)
    drawn = ({name: tolerance.drawn(rng, n) for name, tolerance in tolerances.items()} for _ in range(draws))
    return np.array([reference.wrench(errors) - true for errors in drawn]).reshape(draws, n, 6)


def require_one_source(tolerances: Mapping[str, Tolerance]) -> None:
    """Refuse a reference that takes gravity from encoders and from an inertial sensor.

    Args:
        tolerances: Tolerances by quantity.

    Raises:
        SensorError: If both are off.
    """
    both = [{name for name in names if name in tolerances} for names in (ENCODERS, IMU)]
    if all(both):
        raise SensorError(
            f"errors of the reference: expected gravity by encoders or by an inertial sensor, got both "
            f"({', '.join(sorted(both[0] | both[1]))}); compute one reference of each"
        )
