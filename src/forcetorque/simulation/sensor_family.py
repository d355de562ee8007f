# SPDX-License-Identifier: BSD-3-Clause
"""Families of six-axis sensors, their electronics, and one sensor drawn of a family with its mounting error."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, read_only
from forcetorque.base.errors import FormatError, require_known
from forcetorque.base.pose import make_pose, rotation_about_z
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS, wrench_matrix
from forcetorque.sensor.electronics import CHANNEL_ANGLES, IN_PLANE, Y_ELEMENT, Electronics
from forcetorque.simulation.scenario.scenario_file import Sensors
from forcetorque.simulation.sensor_effects import Creep, Crosstalk, ScrewPattern, ThermalDrift, mounted
from forcetorque.simulation.simulated_sensor import (
    SimulatedSensor,
    distorted_by_mounting,
    matrix_error,
    mounted_matrix,
    random_matrix_error,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Spread:
    """Standard deviations between sensors, and between the gauges of one."""

    sensitivity: float = 0.095
    """Of the whole sensor, relative."""
    thickness: float = 0.045
    """Of the channels out of the plane against those in it, relative."""
    gauge: float = 0.025
    """Of each gauge, relative."""
    axis_m: float = 0.6e-3
    """Of the axis about which the channels out of the plane see moments, in x and in y; m."""
    height_m: float = 0.4e-3
    """Of the height of the frame above the arms; m."""
    tilt: float = 0.035
    """Of the share of the other bending of its arm that a gauge sees."""
    turn_rad: float = 0.015
    """Of the direction of an arm; rad."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SensorFamily:
    """A design with its electronics, and how sensors of it differ."""

    name: str
    """Name of the family."""
    electronics: Electronics
    """What turns strain into counts."""
    height_m: float
    """Height of the sensor's frame above the plane of the arms; m."""
    axis_m: tuple[float, float] = (0.0, 0.0)
    """Axis about which the channels out of the plane see moments, in x and y from that of the frame: unequal arms
    move it; m."""
    out_of_plane: tuple[float, float, float] = (1.0, 1.0, 1.0)
    """Sensitivity of each arm's channel out of the plane, relative to that of the common design."""
    spread: Spread = Spread()
    """How sensors differ."""

    def nominal(self) -> FloatArray:
        """Give the response of the design.

        Returns:
            Counts of every channel per component of a wrench; shape (6, 6); counts/N, counts/(N m).
        """
        strain = self._in_frame(_strain_matrix(), np.array([*self.axis_m, self.height_m]))
        return self._gains(1.0) * self.electronics.counts_per_strain * strain

    def draw(self, rng: np.random.Generator) -> FloatArray:
        """Give the response of a sensor, as a perfect workbench would find it.

        Args:
            rng: Source of what differs.

        Returns:
            Counts of every channel per component of a wrench; shape (6, 6); counts/N, counts/(N m).
        """
        spread = self.spread
        turned = _strain_matrix().copy()
        for row, angle in zip(turned, spread.turn_rad * rng.standard_normal(6), strict=True):
            turn = rotation_about_z(angle)
            row[:3], row[3:] = turn @ row[:3], turn @ row[3:]
        gains = self._gains(np.exp(spread.thickness * rng.standard_normal()))
        # what the other gauges of the arm see, in the strength of this gauge
        tilted = gains * turned + spread.tilt * rng.standard_normal((6, 1)) * (gains * turned)[[1, 0, 3, 2, 5, 4]]
        scatter = np.array([spread.axis_m, spread.axis_m, spread.height_m]) * rng.standard_normal(3)
        place = np.array([*self.axis_m, self.height_m]) + scatter
        strength = np.exp(spread.sensitivity * rng.standard_normal() + spread.gauge * rng.standard_normal((6, 1)))
        return strength * self.electronics.counts_per_strain * self._in_frame(tilted, place)

    def _in_frame(self, strain: FloatArray, place: FloatArray) -> FloatArray:
        """Strain per wrench in the sensor's frame, from that per wrench in the middle of the arms."""
        middle = np.array([0.0, 0.0, place[2]])
        return np.where(IN_PLANE[:, None], strain @ _arms_X_frame(middle), strain @ _arms_X_frame(place))

    def _gains(self, thickness: float) -> FloatArray:
        gains = np.ones(6)
        gains[~IN_PLANE] = thickness * np.array(self.out_of_plane)
        return gains[:, None]


@cache
def _strain_matrix() -> FloatArray:
    """That of the common design, which thousands of sensors are drawn from."""
    return read_only(Y_ELEMENT.strain_matrix(), name="strain_matrix", shape=(6, 6))


def _arms_X_frame(place: FloatArray) -> FloatArray:
    """Express a wrench in a frame whose origin is at a place above the arms in the frame of the arms."""
    return wrench_matrix(make_pose(np.eye(3), place))


FAMILIES = {
    family.name: family
    for family in (
        SensorFamily(name="standard", electronics=Electronics(amplifier_gain=113.0), height_m=8.6e-3),
        SensorFamily(
            name="double range",
            electronics=Electronics(amplifier_gain=53.0),
            height_m=10.1e-3,
            axis_m=(2.1e-3, 0.4e-3),
            out_of_plane=(1.08, 1.08, 1.08),
            spread=Spread(sensitivity=0.12),
        ),
        SensorFamily(
            name="stiff in z",
            electronics=Electronics(amplifier_gain=112.0),
            height_m=10.4e-3,
            axis_m=(-0.7e-3, 1.2e-3),
            out_of_plane=(0.375, 0.445, 0.445),
            spread=Spread(sensitivity=0.025, thickness=0.03),
        ),
    )
}
"""Families by name: the usual one, one of about twice its range, and one of thrice the range along z."""


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
                "that could be scaled; set mounting_sd or uneven screws, and recordings that load the sensor"
            )
    scale = np.divide(wanted, drawn, out=np.zeros(6), where=wanted > 0.0)
    error = scale[:, None] * matrix_error(workbench, mounted)
    where = f"workbench_error: expected what mounting can do, got mean errors {wanted.tolist()} (N, N m)"
    return mounted_matrix(where, workbench, error)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Specimen(ArrayRecord):
    """A sensor with its truth."""

    number: int
    """Its place among the sensors of the robot."""
    serial: str
    """Serial number."""
    workbench: FloatArray = field(metadata=array(6, 6))
    """Matrix before mounting, as a perfect workbench finds it; shape (6, 6); N/count, N m/count."""
    sensor: SimulatedSensor
    """The sensor as mounted, without the offset of a power-up."""
    power_up_counts: float
    """Spread of the offset of a channel from one power-up to the next; counts."""

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
    require_known(described.family, FAMILIES, FormatError, f"sensors: no family is called {described.family!r}")
    sensitivity = FAMILIES[described.family].draw(rng)
    torque = np.array(described.screw_torque_Nm)
    screws = ScrewPattern(angle_rad=2.0 * np.pi * np.arange(len(torque)) / len(torque), torque_Nm=torque)
    workbench = np.asarray(np.linalg.inv(sensitivity), dtype=np.float64)
    if described.matrix_error is None:
        bent = mounted(
            sensitivity, screws, arm_angle_rad=CHANNEL_ANGLES, in_plane=IN_PLANE, strength=described.mounting_strength
        )
        matrix = distorted_by_mounting(
            np.asarray(np.linalg.inv(bent), dtype=np.float64), relative=described.mounting_sd, rng=rng
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
