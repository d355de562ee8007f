# SPDX-License-Identifier: BSD-3-Clause
"""What is demanded of a calibration device, checked by computation: motors, locks, space, errors of references."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
from pydantic import Field

from forcetorque.base.errors import RobotError
from forcetorque.device.demand_result import (
    MOST_SENSORS,
    BudgetRow,
    EnvelopeRow,
    GradeRow,
    HingeRow,
    LockRow,
    MotorRow,
    RequirementRow,
    UnwindingRow,
    requirement_rows,
)
from forcetorque.device.description import Device, device_load
from forcetorque.device.device_file import DeviceFile
from forcetorque.device.error_budget import (
    DATA_SHEETS,
    THESIS_GRADES,
    ErrorBudget,
    Graded,
    LoadErrors,
    graded,
    load_errors,
)
from forcetorque.device.expected_wrench import BRACKET_LENGTH, COMPLIANCE, ENCODERS, LOAD_LENGTH, MASS, answer_of
from forcetorque.device.mechanical_demands import (
    ARM_RADIUS_M,
    MotorDuty,
    Silhouette,
    envelope,
    hinge_ways,
    motor_duty,
    pendulum_Nm,
)
from forcetorque.device.motion import DeviceTrajectory, Sequence, YawReturn, twelve_steps
from forcetorque.device.tolerances import Tolerance
from forcetorque.results.table import Row, Table, table_of
from forcetorque.robot.motion import JointMotion

RATE_HZ = 20.0
"""Rate at which torques are looked at."""
TOLERANCES: Mapping[str, Tolerance] = {
    **dict.fromkeys(ENCODERS, Tolerance(step=float(np.deg2rad(0.1)))),
    MASS: Tolerance(zero=1e-3),
    BRACKET_LENGTH: Tolerance(zero=2e-4),
    LOAD_LENGTH: Tolerance(zero=2e-4),
    COMPLIANCE: Tolerance(fixed=1e-6),
}
"""What a well-made device is off by: encoders of 0.1 deg full width, 0.05 % of the mass and 0.1 mm of lengths each way,
and an arm behind the encoders that bends by 0.13 mrad under 131 N m."""

_SPACING_DEG = 5.0
_ROUNDING_NM = 1e-9
_GRADES = sorted((*THESIS_GRADES, *DATA_SHEETS), key=lambda grade: (grade.by_imu, grade.full_width))
_LARGEST = (
    *("one_force_N", "one_moment_Nm", "largest_force_N", "largest_moment_Nm"),
    *("force_met_to_kg", "moment_met_to_kg"),
)
_ENDLESS_DEG = (-10.0, 1090.0)
_UNITS = {"pitch": ("deg", 180.0 / np.pi), "yaw": ("deg", 180.0 / np.pi), MASS: ("%", 100.0)} | {
    BRACKET_LENGTH: ("mm", 1e3),
    LOAD_LENGTH: ("mm", 1e3),
    COMPLIANCE: ("urad/Nm", 1e6),
}


class DeviceDemands(Row):
    """What is demanded of a device with the largest stack of sensors, and what it does."""

    sensors: tuple[str, ...]
    """Sensors of the stack."""
    load: str
    """Largest load, at which all is computed that does not name another."""
    requirements: tuple[RequirementRow, ...]
    """The requirements of the thesis (6.2.1)."""
    motors: tuple[MotorRow, ...]
    """What motors bear."""
    unwinding: tuple[UnwindingRow, ...]
    """How their averages depend on how yaw gets back in the 12 steps; none of other motions."""
    hinge: tuple[HingeRow, ...]
    """Moments about the hinge, way by way."""
    locks: tuple[LockRow, ...]
    """Whether each load gets to the other lock."""
    envelope: tuple[EnvelopeRow, ...]
    """The space that is swept."""
    budget: tuple[BudgetRow, ...]
    """Errors of references, by sensor and quantity."""
    grades: tuple[GradeRow, ...]
    """Errors by grade of encoders and inertial sensors, of the innermost sensor."""
    silhouettes: tuple[Silhouette, ...] = Field(exclude=True, repr=False)
    """What is swept in each view, for the figure."""

    def blocks(self) -> Iterator[Table | str]:
        """Give what people read.

        Yields:
            Tables and sentences.
        """
        stack = f"{len(self.sensors)} sensors and {self.load}"
        yield table_of(self.requirements, f"requirements (6.2.1), with {stack}")
        yield from (f"{row.number}. {row.verdict}: {row.why}" for row in self.requirements)
        yield table_of(self.motors, f"motors, with {stack}")
        if self.unwinding:
            yield table_of(self.unwinding, "average (6.1) over peak, by how yaw gets back in the 12 steps")
        yield table_of(self.hinge, f"moment of gravity about the hinge, {self.load}")
        yield table_of(self.locks, "locks of the hinge, by load")
        yield table_of(self.envelope, f"space that is swept: plates, and the arm within {ARM_RADIUS_M:g} m of its axis")
        yield table_of(self.budget, f"errors of references, {self.load}")
        place = f"at {self.sensors[0]}, {self.load}, by what tells gravity"
        yield table_of(self.grades, f"root mean square errors {place} (Table 6.3)", leave_out=_LARGEST)
        yield table_of(self.grades, f"largest errors {place}", leave_out=("rms",))


def device_demands(file: DeviceFile) -> DeviceDemands:
    """Check what is demanded of a device, with three sensors in its stack.

    Args:
        file: The device, and what it does; missing sensors are stacked like its first.

    Returns:
        What it does.

    Raises:
        RobotError: If no motor moves, so that there is no path to average torques over.
    """
    full = file.with_sensors(MOST_SENSORS)
    sequence = full.sequence
    load = device_load(full, max(full.loads_kg))
    trajectory = DeviceTrajectory(device=full, load=load, sequence=sequence, hold_s=full.motion.hold_s)
    motors = _motor_rows(trajectory)
    silhouettes = envelope(full, load, sequence.still_poses(full, load, spacing_deg=_SPACING_DEG))
    errors = {sensor: load_errors(full, sensor, sequence, TOLERANCES) for sensor in full.sensor_names}
    return DeviceDemands(
        sensors=full.sensor_names,
        load=load.name,
        requirements=requirement_rows(full, silhouettes, errors),
        motors=motors,
        unwinding=tuple(_unwinding(full, one) for one in YawReturn if full.motion.posture is None),
        hinge=_hinge_rows(full, sequence),
        locks=tuple(_lock_row(full, sequence, load_kg) for load_kg in full.loads_kg),
        envelope=tuple(_envelope_row(one) for one in silhouettes),
        budget=tuple(row for sensor, one in errors.items() for row in _budget_rows(sensor, one)),
        grades=tuple(_grade_row(one) for one in graded(full, full.sensor_names[0], sequence, _GRADES)),
        silhouettes=silhouettes,
    )


def _motor_rows(trajectory: DeviceTrajectory) -> tuple[MotorRow, ...]:
    device, load = trajectory.device, trajectory.load
    duties = _duties(trajectory)
    if all(duty.average_Nm is None for duty in duties):
        count = len(trajectory.sequence.postures)
        raise RobotError(
            f"sequence {trajectory.sequence.name!r}: expected pitch or yaw to move, to average torques over by (6.1), "
            f"got {count} postures that all hold; state postures that differ, or none for the 12 steps"
        )
    moving = answer_of(device, load, trajectory.sampled(RATE_HZ)[1])
    limits = {"pitch": device.pitch.torque_Nm, "yaw": device.yaw.torque_Nm}
    return tuple(
        MotorRow(
            joint=duty.joint,
            peak_Nm=duty.peak_Nm,
            moving_peak_Nm=float(np.abs(moving.torque(duty.joint)).max()),
            average_Nm=duty.average_Nm,
            average_over_peak=_over_peak(duty),
            rms_Nm=duty.rms_Nm,
            holding_Nm=duty.holding_Nm,
            limit_Nm=limits[duty.joint],
        )
        for duty in duties
    )


def _duties(trajectory: DeviceTrajectory) -> tuple[MotorDuty, MotorDuty]:
    """What pitch and yaw bear of weight alone."""
    time, motion = trajectory.sampled(RATE_HZ)
    still = answer_of(trajectory.device, trajectory.load, JointMotion.at_rest(motion.names, motion.position))
    pitch, yaw = (
        motor_duty(joint, still.torque(joint), motion.position[:, motion.names.index(joint)], time)
        for joint in ("pitch", "yaw")
    )
    return pitch, yaw


def _over_peak(duty: MotorDuty) -> float | None:
    return duty.average_Nm / duty.peak_Nm if duty.average_Nm is not None and duty.peak_Nm > 0.0 else None


def _unwinding(device: Device, yaw_return: YawReturn) -> UnwindingRow:
    # a yaw that never returns needs cables that let it
    endless = device.changed(yaw=device.yaw.model_copy(update={"range_deg": _ENDLESS_DEG}))
    load = device_load(endless, max(endless.loads_kg))
    sequence = twelve_steps(endless, yaw_return=yaw_return)
    pitch, yaw = _duties(DeviceTrajectory(device=endless, load=load, sequence=sequence))
    return UnwindingRow(
        yaw_return=yaw_return.value,
        yaw_path_deg=float(np.rad2deg(yaw.path_rad)),
        pitch_over_peak=_over_peak(pitch),
        yaw_over_peak=_over_peak(yaw),
    )


def _hinge_rows(device: Device, sequence: Sequence) -> tuple[HingeRow, ...]:
    ways = hinge_ways(device, device_load(device, max(device.loads_kg)), sequence)
    return tuple(
        HingeRow(
            step=way.step,
            hinge="free" if way.unlocked else "locked",
            from_deg=float(np.rad2deg(way.lock_rad)),
            to_deg=float(np.rad2deg(way.end_rad)),
            least_Nm=_moment(way.moment.min()),
            most_Nm=_moment(way.moment.max()),
        )
        for way in ways
    )


def _moment(value: float) -> float:
    """A moment, or 0 where it is nothing but rounding, which would be shown with a sign."""
    return float(value) if abs(value) > _ROUNDING_NM else 0.0


def _lock_row(device: Device, sequence: Sequence, load_kg: float) -> LockRow:
    load = device_load(device, load_kg)
    ways = hinge_ways(device, load, sequence)
    return LockRow(
        load=load.name,
        reaches=all(way.drives_to_end for way in ways if way.unlocked),
        holding_Nm=max(way.holding_Nm for way in ways),
        closing_Nm=pendulum_Nm(device, load) * float(np.sin(np.deg2rad(1.0))),
    )


def _envelope_row(silhouette: Silhouette) -> EnvelopeRow:
    width, height = silhouette.extent_m
    return EnvelopeRow(
        view=silhouette.view,
        width_m=float(width),
        height_m=float(height),
        rectangle_m2=silhouette.rectangle_m2,
        hull_m2=silhouette.hull_m2,
    )


def _budget_rows(sensor: str, errors: LoadErrors) -> Iterator[BudgetRow]:
    budget = errors.at_most
    for quantity, tolerance in zip(budget.quantities, budget.tolerances, strict=True):
        unit, factor = _UNITS.get(quantity, ("m/s2", 1.0))
        plus_minus = factor * (tolerance.largest + abs(tolerance.fixed))
        yield _budget_row(sensor, quantity, plus_minus, unit, budget.only(quantity))
    yield _budget_row(sensor, "all", None, "", budget)


def _budget_row(sensor: str, quantity: str, plus_minus: float | None, unit: str, budget: ErrorBudget) -> BudgetRow:
    force, moment = budget.largest_norms
    return BudgetRow(
        sensor=sensor,
        quantity=quantity.replace("_", " "),
        plus_minus=plus_minus,
        unit=unit,
        rms=budget.rms,
        largest=budget.largest,
        force_N=force,
        moment_Nm=moment,
    )


def _grade_row(one: Graded) -> GradeRow:
    budget = one.errors.at_most
    force_kg, moment_kg = one.errors.met_to_kg
    return GradeRow(
        gravity_by=one.grade.name,
        full_width=one.grade.full_width,
        plus_minus=0.5 * one.grade.full_width,
        unit=one.grade.unit,
        rms=budget.rms,
        one_force_N=one.of_one[0],
        one_moment_Nm=one.of_one[1],
        largest=budget.largest,
        largest_force_N=float(budget.largest[:3].max()),
        largest_moment_Nm=float(budget.largest[3:].max()),
        force_norm_N=budget.largest_norms[0],
        moment_norm_Nm=budget.largest_norms[1],
        force_met_to_kg=force_kg,
        moment_met_to_kg=moment_kg,
    )
