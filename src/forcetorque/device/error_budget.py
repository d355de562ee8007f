# SPDX-License-Identifier: BSD-3-Clause
"""Errors of the expected wrench: root mean square and largest over a motion, and grades of parts at every load."""

from __future__ import annotations

from collections.abc import Mapping, Sequence as Several
from dataclasses import dataclass, field, replace
from itertools import product

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, check_arrays, names
from forcetorque.base.errors import SensorError
from forcetorque.device.components import Device, device_load
from forcetorque.device.expected_wrench import ENCODERS, IMU, ExpectedWrench
from forcetorque.device.motion import Sequence
from forcetorque.device.tolerances import Tolerance


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ErrorBudget(ArrayRecord):
    """First-order errors of the expected wrench of one sensor over n poses."""

    quantities: tuple[str, ...] = field(metadata=names("k"))
    """Quantities with errors."""
    tolerances: tuple[Tolerance, ...]
    """Tolerances of the quantities."""
    slopes: FloatArray = field(metadata=array("k", None, 6))
    """Change of the wrench per unit of each; shape (k, n, 6)."""

    def __post_init__(self) -> None:
        check_arrays(self)
        if not self.quantities:
            raise SensorError("errors of the expected wrench: expected at least one quantity with an error, got none")

    @classmethod
    def of(cls, expected: ExpectedWrench, tolerances: Mapping[str, Tolerance]) -> ErrorBudget:
        """Propagate errors of quantities to the expected wrench.

        Args:
            expected: The expected wrench.
            tolerances: Tolerances by quantity.

        Returns:
            The errors.
        """
        require_one_source(tolerances)
        nonzero = {name: tolerance for name, tolerance in tolerances.items() if not tolerance.is_zero}
        slopes = [expected.derivative(name) for name in nonzero]
        return cls(
            quantities=tuple(nonzero),
            tolerances=tuple(nonzero.values()),
            slopes=np.array(slopes).reshape(len(nonzero), len(expected.poses), 6),
        )

    def only(self, *quantities: str) -> ErrorBudget:
        """Set the errors of the other quantities to zero.

        Args:
            *quantities: Quantities that keep their errors.

        Returns:
            The errors by these quantities.
        """
        kept = [k for k, name in enumerate(self.quantities) if name in quantities]
        return ErrorBudget(
            quantities=tuple(self.quantities[k] for k in kept),
            tolerances=tuple(self.tolerances[k] for k in kept),
            slopes=self.slopes[kept],
        )

    @property
    def rms(self) -> FloatArray:
        """Root mean square over the poses, and over devices with these tolerances; shape (6,); N, N m."""
        variances = np.array([tolerance.variance for tolerance in self.tolerances])
        square = np.einsum("k,knc->nc", variances, self.slopes**2) + self._fixed**2
        return np.asarray(np.sqrt(square.mean(axis=0)), dtype=np.float64)

    @property
    def largest(self) -> FloatArray:
        """Largest magnitude of each component in any pose, with the largest errors; shape (6,); N, N m."""
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
    def largest_single_norms(self) -> tuple[float, float]:
        """Largest norms of the errors of force and moment by a single quantity; N, N m."""
        norms = np.array([self.only(quantity).largest_norms for quantity in self.quantities])
        force, moment = norms.max(axis=0).tolist()
        return force, moment

    @property
    def _fixed(self) -> FloatArray:
        return np.asarray(
            np.einsum("k,knc->nc", np.array([tolerance.fixed for tolerance in self.tolerances]), self.slopes)
        )


def drawn_errors(
    expected: ExpectedWrench, tolerances: Mapping[str, Tolerance], rng: np.random.Generator, draws: int
) -> FloatArray:
    """Draw errors of quantities and compute the expected wrench with them, without linearisation.

    Args:
        expected: The expected wrench.
        tolerances: Tolerances by quantity.
        rng: Source of random numbers.
        draws: Number of motions, d.

    Returns:
        Wrong less true wrenches; shape (d, n, 6); N, N m.
    """
    require_one_source(tolerances)
    true, n = expected.wrench(), len(expected.poses)
    drawn = ({name: tolerance.drawn(rng, n) for name, tolerance in tolerances.items()} for _ in range(draws))
    return np.array([expected.wrench(errors) - true for errors in drawn]).reshape(draws, n, 6)


def require_one_source(tolerances: Mapping[str, Tolerance]) -> None:
    """Refuse an expected wrench that takes gravity from encoders and from an inertial sensor.

    Args:
        tolerances: Tolerances by quantity.

    Raises:
        SensorError: If both have tolerances.
    """
    both = [{name for name in names if name in tolerances} for names in (ENCODERS, IMU)]
    if all(both):
        raise SensorError(
            f"errors of the expected wrench: expected gravity by encoders or by an inertial sensor, got both "
            f"({', '.join(sorted(both[0] | both[1]))}); compute one expected wrench of each"
        )


FORCE_LIMIT_N = 0.5
"""Largest error of an expected force by requirement 6 of the thesis (6.2.1); N."""
MOMENT_LIMIT_NM = 0.02
"""Largest error of an expected moment by requirement 6; N m."""

SPACING_DEG = 5.0
"""Largest angle of joints between consecutive poses of the errors, evenly over the path; deg."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Grade:
    """An encoder on each motor, or an inertial sensor beside the sensor, by the full width of its error."""

    by_imu: bool
    """Whether it is an inertial sensor."""
    full_width: float
    """Full width of the error; deg of an encoder, m/s2 of an inertial sensor."""

    @property
    def name(self) -> str:
        """Name."""
        return "IMU" if self.by_imu else "encoders"

    @property
    def unit(self) -> str:
        """Unit of the full width."""
        return "m/s2" if self.by_imu else "deg"

    @property
    def quantities(self) -> tuple[str, ...]:
        """Quantities with errors."""
        return IMU if self.by_imu else ENCODERS

    @property
    def tolerance(self) -> Tolerance:
        """Tolerance of each of these quantities."""
        return Tolerance(step=self.full_width if self.by_imu else float(np.deg2rad(self.full_width)))


THESIS_GRADES = (
    *(Grade(by_imu=True, full_width=width) for width in (0.015, 0.03)),
    *(Grade(by_imu=False, full_width=width) for width in (0.5, 0.25, 0.1)),
)
"""Rows of Table 6.3."""
DATA_SHEETS = (
    *(Grade(by_imu=True, full_width=width) for width in (0.0192, 0.0384)),
    *(Grade(by_imu=False, full_width=width) for width in (1.0, 0.15)),
)
"""BNO055 at 2 g and 4 g with 4 LSB each way; AS5045 at best, 0.5 deg each way; and an encoder for 0.5 N."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LoadErrors(ArrayRecord):
    """Errors of the expected wrench of a sensor at every load."""

    loads_kg: FloatArray = field(metadata=array("l"))
    """Mass on the hinge, carrier included, growing; shape (l,); kg."""
    budgets: tuple[ErrorBudget, ...] = field(metadata=names("l"))
    """Errors at each load."""

    @property
    def at_largest_load(self) -> ErrorBudget:
        """Errors at the largest load."""
        return self.budgets[-1]

    @property
    def met_to_kg(self) -> tuple[float | None, float | None]:
        """Loads up to which the errors of all components of force and moment meet requirement 6.

        Errors are interpolated linearly between loads.

        Returns:
            Of force and moment; at most the largest load; None where the smallest is too much; kg.
        """
        largest = np.array([budget.largest for budget in self.budgets])
        force = _crossing(self.loads_kg, largest[:, :3].max(axis=1), FORCE_LIMIT_N)
        return force, _crossing(self.loads_kg, largest[:, 3:].max(axis=1), MOMENT_LIMIT_NM)


def load_errors(device: Device, sensor: str, sequence: Sequence, tolerances: Mapping[str, Tolerance]) -> LoadErrors:
    """Propagate errors to the expected wrench of a sensor at every load of a device.

    Args:
        device: The device.
        sensor: The sensor.
        sequence: Its motion.
        tolerances: Tolerances by quantity.

    Returns:
        The errors, over poses at most `SPACING_DEG` from each other.
    """
    loads = [device_load(device, load) for load in device.loads_kg]
    budgets = []
    for load in loads:
        poses = sequence.still_poses(device, load, spacing_deg=SPACING_DEG)
        expected = ExpectedWrench(device=device, load=load, poses=poses, sensor=sensor)
        budgets.append(ErrorBudget.of(expected, tolerances))
    return LoadErrors(loads_kg=np.array([load.mass_kg for load in loads]), budgets=tuple(budgets))


def graded_errors(device: Device, sensor: str, sequence: Sequence, grades: Several[Grade]) -> dict[Grade, LoadErrors]:
    """Compute the errors by grades at every load of a device.

    Args:
        device: The device.
        sensor: The sensor.
        sequence: Its motion.
        grades: The grades.

    Returns:
        The errors by grade.
    """
    units = {
        quantities: load_errors(device, sensor, sequence, dict.fromkeys(quantities, Tolerance(step=1.0)))
        for quantities in {grade.quantities for grade in grades}
    }
    return {grade: _with_tolerance(units[grade.quantities], grade) for grade in grades}


def _with_tolerance(unit: LoadErrors, grade: Grade) -> LoadErrors:
    """The same slopes with the tolerance of a grade."""
    tolerances = (grade.tolerance,) * len(grade.quantities)
    return replace(unit, budgets=tuple(replace(budget, tolerances=tolerances) for budget in unit.budgets))


def _crossing(loads_kg: FloatArray, errors: FloatArray, limit: float) -> float | None:
    beyond = np.flatnonzero(errors > limit)
    if not len(beyond):
        return float(loads_kg[-1])
    k = int(beyond[0])
    if k == 0:
        return None
    return float(np.interp(limit, errors[k - 1 : k + 1], loads_kg[k - 1 : k + 1]))
