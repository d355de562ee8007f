# SPDX-License-Identifier: BSD-3-Clause
"""One sensor of a scenario: drawn from its family, mounted, with the error of its workbench matrix."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only
from forcetorque.base.errors import FormatError, known_names
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.simulation.effects import Creep, Crosstalk, ScrewPattern, ThermalDrift, mounted
from forcetorque.simulation.family import CHANNEL_ANGLES, FAMILIES, IN_PLANE
from forcetorque.simulation.scenario.sensor_section import Sensors
from forcetorque.simulation.sensor import (
    SimulatedSensor,
    distorted_by_mounting,
    matrix_error,
    mounted_matrix,
    random_matrix_error,
)

_LEAST_SHARE = 1e-6
"""A drawn error below this share of the wanted one is rounding and no mounting."""


def workbench_errors(workbench: FloatArray, mounted: FloatArray, changes: Sequence[FloatArray]) -> FloatArray:
    """Give what a workbench matrix gets wrong on a mounted sensor that has no other fault.

    Args:
        workbench: Matrix of the workbench; shape (6, 6); N/count, N m/count.
        mounted: True matrix; shape (6, 6); N/count, N m/count.
        changes: Changes of the true wrench of every recording since the offset was taken; shapes (n, 6); N, N m.

    Returns:
        Measured minus true wrenches of all recordings; shape (sum of n, 6); N, N m.
    """
    return np.concatenate(list(changes)) @ matrix_error(workbench, mounted).T


def mounted_with_error(
    workbench: FloatArray, mounted: FloatArray, changes: Sequence[FloatArray], *, mean_absolute: Any
) -> FloatArray:
    """Scale what mounting did to a sensor until its workbench matrix errs by as much as is wanted.

    A true wrench w is read as `(1 + E) w`, where `1 + E = workbench mounted^-1`. Every row of E is
    scaled, so each component of the error keeps its course in time and changes in size only. This is
    exact, because true loads do not depend on the sensor.

    Args:
        workbench: Matrix of the workbench; shape (6, 6); N/count, N m/count.
        mounted: True matrix as drawn; shape (6, 6); N/count, N m/count.
        changes: Changes of the true wrench of every recording over which the error is taken, since its offset was
            taken; shapes (n, 6); N, N m.
        mean_absolute: Mean absolute error of every component, as `workbench_errors` has it; shape (6,); N, N m.

    Returns:
        True matrix with that error; shape (6, 6); N/count, N m/count.

    Raises:
        FormatError: If there is nothing to scale in a component, or no mounting can do so much.
    """
    wanted = read_only(mean_absolute, name="mean_absolute", shape=(6,))
    drawn = np.abs(workbench_errors(workbench, mounted, changes)).mean(axis=0)
    for name, unit, want, have in zip(WRENCH_COMPONENTS, WRENCH_UNITS, wanted, drawn, strict=True):
        if have < _LEAST_SHARE * want:
            raise FormatError(
                f"workbench_error: expected an error of {want:g} {unit} in {name}, but mounting as drawn gives none "
                "that could be scaled; set mounting_spread or uneven screws, and recordings that load the sensor"
            )
    scale = np.divide(wanted, drawn, out=np.zeros(6), where=wanted > 0.0)
    error = scale[:, None] * matrix_error(workbench, mounted)
    where = f"workbench_error: expected what mounting can do, got mean errors {wanted.tolist()} (N, N m)"
    return mounted_matrix(where, workbench, error)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Specimen:
    """A sensor with its truth."""

    number: int
    """Its place among the sensors of the robot."""
    serial: str
    """Serial number."""
    workbench: FloatArray
    """Matrix before mounting, as a perfect workbench finds it; shape (6, 6); N/count, N m/count."""
    sensor: SimulatedSensor
    """The sensor as mounted, without the offset of a power-up."""
    power_up_counts: float
    """Spread of the offset of a channel from one power-up to the next; counts."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "workbench", read_only(self.workbench, name="workbench", shape=(6, 6)))

    def powered_up(self, rng: np.random.Generator) -> SimulatedSensor:
        """Switch the board on: every channel gets another offset.

        Args:
            rng: Source of the offset.

        Returns:
            The sensor with its offset.
        """
        change = self.sensor.matrix @ (self.power_up_counts * rng.standard_normal(6))
        return replace(self.sensor, offset=self.sensor.offset - change)


def draw_specimen(
    described: Sensors, number: int, rng: np.random.Generator, *, loads: Sequence[FloatArray] | None = None
) -> Specimen:
    """Draw a sensor.

    Args:
        described: What sensors are made of.
        number: Its place among the sensors of the robot, from which its serial number comes.
        rng: Source of what differs between sensors.
        loads: Changes of its true wrench in every validation recording, if the error of its workbench matrix is set;
            shapes (n, 6); N, N m.

    Returns:
        The sensor.

    Raises:
        FormatError: If there is no such family.
    """
    if described.family not in FAMILIES:
        raise FormatError(
            f"sensors: no family is called {described.family!r}; {known_names(described.family, FAMILIES)}"
        )
    sensitivity = FAMILIES[described.family].draw(rng)
    torque = np.array(described.screw_torque_Nm)
    screws = ScrewPattern(angle_rad=2.0 * np.pi * np.arange(len(torque)) / len(torque), torque_Nm=torque)
    workbench = np.asarray(np.linalg.inv(sensitivity), dtype=np.float64)
    if described.matrix_error is None:
        bent = mounted(
            sensitivity, screws, arm_angle_rad=CHANNEL_ANGLES, in_plane=IN_PLANE, strength=described.mounting_strength
        )
        matrix = distorted_by_mounting(
            np.asarray(np.linalg.inv(bent), dtype=np.float64), relative=described.mounting_spread, rng=rng
        )
    else:
        share, lever_m = described.matrix_error.share, described.matrix_error.lever_m
        where = f"sensors.matrix_error: expected what mounting can do, got a share of {share:g}"
        matrix = mounted_matrix(where, workbench, random_matrix_error(share, lever_m, rng))
    if described.workbench_error is not None and loads is not None:
        wanted = described.workbench_error.mean_absolute
        matrix = mounted_with_error(workbench, matrix, loads, mean_absolute=wanted)
    return Specimen(
        number=number,
        serial=f"SIM{number + 1:03d}",
        workbench=workbench,
        sensor=SimulatedSensor(
            matrix=matrix,
            offset=-matrix @ (described.offset_counts * rng.standard_normal(6)),
            noise_counts=described.noise_counts,
            noise_corner_hz=described.noise_corner_hz,
            step_counts=described.step_counts,
            limit_counts=described.limit_counts,
            drift=_drift(described, rng),
            creep=Creep(share=described.creep_share, time_constant_s=described.creep_time_s)
            if described.creep_share
            else None,
            crosstalk=_crosstalk(described, matrix, rng),
        ),
        power_up_counts=described.power_up_counts,
    )


def _drift(described: Sensors, rng: np.random.Generator) -> ThermalDrift | None:
    slopes = (
        described.drift_counts_per_degC,
        described.gradient_counts_per_degC,
        described.hysteresis_counts_per_degC,
    )
    drawn = [spread * rng.standard_normal(6) for spread in slopes]
    if not any(slopes):
        return None
    return ThermalDrift(
        slope=drawn[0],
        reference_degC=described.reference_degC,
        gradient_slope=drawn[1] if slopes[1] else None,
        hysteresis_slope=drawn[2] if slopes[2] else None,
    )


def _crosstalk(described: Sensors, matrix: FloatArray, rng: np.random.Generator) -> Crosstalk | None:
    quadratic = described.crosstalk_counts * rng.standard_normal((6, 6, 6))
    if not described.crosstalk_counts:
        return None
    return Crosstalk(quadratic=quadratic, full_scale=np.abs(matrix).sum(axis=1) * described.limit_counts)
