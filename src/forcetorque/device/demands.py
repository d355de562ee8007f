# SPDX-License-Identifier: BSD-3-Clause
"""Demands on a calibration device, checked by computation: motors, locks, space, errors of the expected wrench."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import RobotError
from forcetorque.device.components import Device, device_load
from forcetorque.device.device_file import DeviceFile
from forcetorque.device.error_budget import (
    DATA_SHEETS,
    THESIS_GRADES,
    ErrorBudget,
    Grade,
    LoadErrors,
    graded_errors,
    load_errors,
)
from forcetorque.device.expected_wrench import BRACKET_LENGTH, COMPLIANCE, ENCODERS, LOAD_LENGTH, MASS, device_response
from forcetorque.device.motion import DeviceTrajectory, Sequence, YawReturn, twelve_steps
from forcetorque.device.motors_hinge_and_envelope import (
    ARM_RADIUS_M,
    EnvelopeRow,
    MotorRow,
    average_over_peak,
    envelope,
    hinge_ways,
    motor_row,
    path_rad,
    pendulum_Nm,
)
from forcetorque.device.requirements import (
    MOST_SENSORS,
    BudgetRow,
    GradeRow,
    HingeRow,
    LockRow,
    RequirementRow,
    UnwindingRow,
    requirement_rows,
)
from forcetorque.device.tolerances import Tolerance
from forcetorque.results.table import Row, Table, optional_table, table_of
from forcetorque.robot.motion import JointMotion

RATE_HZ = 20.0
"""Rate at which torques are sampled."""
TOLERANCES: Mapping[str, Tolerance] = {
    **dict.fromkeys(ENCODERS, Tolerance(step=float(np.deg2rad(0.1)))),
    MASS: Tolerance(zero=1e-3),
    BRACKET_LENGTH: Tolerance(zero=2e-4),
    LOAD_LENGTH: Tolerance(zero=2e-4),
    COMPLIANCE: Tolerance(fixed=1e-6),
}
"""Errors of a well-made device: encoders of 0.1 deg full width, 0.05 % of the mass and 0.1 mm of lengths each way, and
an arm behind the encoders that bends by 0.13 mrad under 131 N m."""

_SPACING_DEG = 5.0
_ROUNDING_NM = 1e-9
_GRADES = sorted((*THESIS_GRADES, *DATA_SHEETS), key=lambda grade: (grade.by_imu, grade.full_width))
_LARGEST = (
    *("single_force_N", "single_moment_Nm", "largest_force_N", "largest_moment_Nm"),
    *("force_met_to_kg", "moment_met_to_kg"),
)
_ENDLESS_DEG = (-10.0, 1090.0)
_UNITS = {"pitch": ("deg", 180.0 / np.pi), "yaw": ("deg", 180.0 / np.pi), MASS: ("%", 100.0)} | {
    BRACKET_LENGTH: ("mm", 1e3),
    LOAD_LENGTH: ("mm", 1e3),
    COMPLIANCE: ("urad/Nm", 1e6),
}


class DeviceDemands(Row):
    """Demands on a device with the largest stack of sensors, and how it meets them."""

    sensors: tuple[str, ...]
    """Sensors of the stack."""
    load: str
    """Largest load, for all records that name no other load."""
    requirements: tuple[RequirementRow, ...]
    """The requirements of the thesis (6.2.1)."""
    motors: tuple[MotorRow, ...]
    """Torques of the motors."""
    unwinding: tuple[UnwindingRow, ...]
    """Average torques by how yaw returns in the 12 steps; none of other motions."""
    hinge: tuple[HingeRow, ...]
    """Moments about the hinge, way by way."""
    locks: tuple[LockRow, ...]
    """Whether each load reaches the other lock."""
    envelope: tuple[EnvelopeRow, ...]
    """The swept space, by view."""
    budget: tuple[BudgetRow, ...]
    """Errors of the expected wrench, by sensor and quantity."""
    grades: tuple[GradeRow, ...]
    """Errors by grade of encoders and inertial sensors, of the innermost sensor."""

    def blocks(self) -> Iterator[Table | str]:
        """Make the text for the terminal.

        Yields:
            Tables and messages.
        """
        stack = f"{len(self.sensors)} sensors and {self.load}"
        yield table_of(self.requirements, f"requirements (6.2.1), with {stack}")
        yield from (f"{row.number}. {row.verdict}: {row.why}" for row in self.requirements)
        yield table_of(self.motors, f"motors, with {stack}")
        yield from optional_table(self.unwinding, "average (6.1) over peak, by how yaw returns in the 12 steps")
        yield table_of(self.hinge, f"moment of gravity about the hinge, {self.load}")
        yield table_of(self.locks, "locks of the hinge, by load")
        yield table_of(self.envelope, f"swept space: plates, and the arm within {ARM_RADIUS_M:g} m of its axis")
        yield table_of(self.budget, f"errors of the expected wrench, {self.load}")
        context = f"at {self.sensors[0]}, {self.load}, by the source of gravity"
        yield table_of(self.grades, f"root mean square errors {context} (Table 6.3)", leave_out=_LARGEST)
        yield table_of(self.grades, f"largest errors {context}", leave_out=("rms",))


def device_demands(file: DeviceFile) -> DeviceDemands:
    """Check the demands on a device, with three sensors in its stack.

    Args:
        file: The device with its motion; missing sensors are copies of its first.

    Returns:
        The demands, and how the device meets them.

    Raises:
        RobotError: If no motor moves, so that there is no path to average torques over.
    """
    full = file.with_sensors(MOST_SENSORS)
    sequence = full.sequence
    load = device_load(full, max(full.loads_kg))
    trajectory = DeviceTrajectory(device=full, load=load, sequence=sequence, hold_s=full.motion.hold_s)
    motors = _motor_rows(trajectory)
    swept = envelope(full, load, sequence.still_poses(full, load, spacing_deg=_SPACING_DEG))
    errors = {sensor: load_errors(full, sensor, sequence, TOLERANCES) for sensor in full.sensor_names}
    graded = graded_errors(full, full.sensor_names[0], sequence, _GRADES)
    return DeviceDemands(
        sensors=full.sensor_names,
        load=load.name,
        requirements=requirement_rows(full, swept, errors),
        motors=motors,
        unwinding=tuple(_unwinding(full, yaw_return) for yaw_return in YawReturn if full.motion.posture is None),
        hinge=_hinge_rows(full, sequence),
        locks=tuple(_lock_row(full, sequence, load_kg) for load_kg in full.loads_kg),
        envelope=swept,
        budget=tuple(row for sensor, by_load in errors.items() for row in _budget_rows(sensor, by_load)),
        grades=tuple(_grade_row(grade, graded[grade]) for grade in _GRADES),
    )


def _motor_rows(trajectory: DeviceTrajectory) -> tuple[MotorRow, ...]:
    device = trajectory.device
    time, motion = trajectory.sampled(RATE_HZ)
    moving = device_response(device, trajectory.load, motion)
    limits = {"pitch": device.pitch.torque_Nm, "yaw": device.yaw.torque_Nm}
    rows = tuple(
        motor_row(
            joint,
            torque,
            position,
            time,
            moving_peak_Nm=float(np.abs(moving.torque(joint)).max()),
            limit_Nm=limits[joint],
        )
        for joint, torque, position in _static_torques(trajectory)
    )
    if all(row.average_Nm is None for row in rows):
        count = len(trajectory.sequence.postures)
        raise RobotError(
            f"sequence {trajectory.sequence.name!r}: expected pitch or yaw to move, to average torques over by (6.1), "
            f"got {count} postures that all hold; give postures that differ, or none for the 12 steps"
        )
    return rows


def _static_torques(trajectory: DeviceTrajectory) -> Iterator[tuple[str, FloatArray, FloatArray]]:
    """Names of both motors, their torques of weight alone, and their positions."""
    _, motion = trajectory.sampled(RATE_HZ)
    static = device_response(trajectory.device, trajectory.load, JointMotion.at_rest(motion.names, motion.position))
    for joint in ("pitch", "yaw"):
        yield joint, static.torque(joint), motion.position[:, motion.names.index(joint)]


def _unwinding(device: Device, yaw_return: YawReturn) -> UnwindingRow:
    # a yaw that never returns needs a range without a limit
    endless = device.changed(yaw=device.yaw.model_copy(update={"range_deg": _ENDLESS_DEG}))
    load = device_load(endless, max(endless.loads_kg))
    sequence = twelve_steps(endless, yaw_return=yaw_return)
    pitch, yaw = _static_torques(DeviceTrajectory(device=endless, load=load, sequence=sequence))
    return UnwindingRow(
        yaw_return=yaw_return.value,
        yaw_path_deg=float(np.rad2deg(path_rad(yaw[2]))),
        pitch_over_peak=average_over_peak(*pitch[1:]),
        yaw_over_peak=average_over_peak(*yaw[1:]),
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
    """A moment, or 0 where it is rounding only, which would be shown with a sign."""
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


def _budget_rows(sensor: str, errors: LoadErrors) -> Iterator[BudgetRow]:
    budget = errors.at_largest_load
    for quantity, tolerance in zip(budget.quantities, budget.tolerances, strict=True):
        unit, factor = _UNITS[quantity]
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


def _grade_row(grade: Grade, errors: LoadErrors) -> GradeRow:
    budget = errors.at_largest_load
    single_force, single_moment = budget.largest_single_norms
    force_kg, moment_kg = errors.met_to_kg
    return GradeRow(
        gravity_by=grade.name,
        full_width=grade.full_width,
        plus_minus=0.5 * grade.full_width,
        unit=grade.unit,
        rms=budget.rms,
        single_force_N=single_force,
        single_moment_Nm=single_moment,
        largest=budget.largest,
        largest_force_N=float(budget.largest[:3].max()),
        largest_moment_Nm=float(budget.largest[3:].max()),
        force_norm_N=budget.largest_norms[0],
        moment_norm_Nm=budget.largest_norms[1],
        force_met_to_kg=force_kg,
        moment_met_to_kg=moment_kg,
    )
