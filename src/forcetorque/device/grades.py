# SPDX-License-Identifier: BSD-3-Clause
"""Grades of what tells gravity, held against the largest error that a reference may have, at every load."""

from __future__ import annotations

from collections.abc import Mapping
from collections.abc import Sequence as Several
from dataclasses import dataclass, replace

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only
from forcetorque.device.description import Device, device_load
from forcetorque.device.error_budget import ErrorBudget
from forcetorque.device.expected_wrench import ENCODERS, IMU, Reference
from forcetorque.device.sequence import Sequence
from forcetorque.device.tolerances import Tolerance

FORCE_LIMIT_N = 0.5
"""Largest error of a reference force by requirement 6 of the thesis (6.2.1); N."""
MOMENT_LIMIT_NM = 0.02
"""Largest error of a reference moment by it; N m."""

SPACING_DEG = 5.0
"""How far joints go at most from one pose to the next over which errors are taken, evenly over the path; deg."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Grade:
    """An encoder on each motor, or an inertial sensor beside the sensor, by the full width of its error."""

    by_imu: bool
    """Whether it is an inertial sensor."""
    full_width: float
    """Full width of the error; deg of an encoder, m/s2 of an inertial sensor."""

    @property
    def name(self) -> str:
        """What it is called."""
        return "IMU" if self.by_imu else "encoders"

    @property
    def unit(self) -> str:
        """Unit of the full width."""
        return "m/s2" if self.by_imu else "deg"

    @property
    def quantities(self) -> tuple[str, ...]:
        """Quantities that are off."""
        return IMU if self.by_imu else ENCODERS

    @property
    def tolerance(self) -> Tolerance:
        """By how much each of them is."""
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
class LoadErrors:
    """Errors of the reference of a sensor at every load."""

    loads_kg: FloatArray
    """Mass on the hinge, carrier included, growing; shape (l,); kg."""
    budgets: tuple[ErrorBudget, ...]
    """Errors at each load."""

    def __post_init__(self) -> None:
        shape = (len(self.budgets),)
        object.__setattr__(self, "loads_kg", read_only(self.loads_kg, name="loads_kg", shape=shape))

    @property
    def at_most(self) -> ErrorBudget:
        """Errors at the largest load."""
        return self.budgets[-1]

    @property
    def met_to_kg(self) -> tuple[float | None, float | None]:
        """Loads up to which no component of force and moment is off by more than requirement 6 allows.

        Errors are taken to be a line from a load to the next.

        Returns:
            Of force and moment; at most the largest load; None where the smallest is too much; kg.
        """
        largest = np.array([budget.largest for budget in self.budgets])
        force = _crossing(self.loads_kg, largest[:, :3].max(axis=1), FORCE_LIMIT_N)
        return force, _crossing(self.loads_kg, largest[:, 3:].max(axis=1), MOMENT_LIMIT_NM)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Graded:
    """What a grade does to the reference of a sensor."""

    grade: Grade
    """The grade."""
    errors: LoadErrors
    """Errors at every load."""

    @property
    def of_one(self) -> tuple[float, float]:
        """Largest norms of the errors of force and moment at the largest load, one quantity off alone; N, N m."""
        alone = np.array([self.errors.at_most.only(quantity).largest_norms for quantity in self.grade.quantities])
        force, moment = alone.max(axis=0)
        return float(force), float(moment)


def load_errors(device: Device, sensor: str, sequence: Sequence, tolerances: Mapping[str, Tolerance]) -> LoadErrors:
    """Propagate errors to the reference of a sensor at every load of a device.

    Args:
        device: The device.
        sensor: The sensor.
        sequence: What it does.
        tolerances: By how much each quantity is off.

    Returns:
        The errors, over poses that are `SPACING_DEG` from each other at most.
    """
    loads = [device_load(device, load) for load in device.loads_kg]
    budgets = []
    for load in loads:
        poses = sequence.still_poses(device, load, spacing_deg=SPACING_DEG)
        reference = Reference(device=device, load=load, poses=poses, sensor=sensor)
        budgets.append(ErrorBudget.of(reference, tolerances))
    return LoadErrors(loads_kg=np.array([load.mass_kg for load in loads]), budgets=tuple(budgets))


def graded(device: Device, sensor: str, sequence: Sequence, grades: Several[Grade]) -> tuple[Graded, ...]:
    """Hold grades against requirement 6 at every load of a device.

    Args:
        device: The device.
        sensor: The sensor.
        sequence: What it does.
        grades: The grades.

    Returns:
        One for each grade.
    """
    units = {
        quantities: load_errors(device, sensor, sequence, dict.fromkeys(quantities, Tolerance(step=1.0)))
        for quantities in {grade.quantities for grade in grades}
    }
    return tuple(Graded(grade=grade, errors=_with_tolerance(units[grade.quantities], grade)) for grade in grades)


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
