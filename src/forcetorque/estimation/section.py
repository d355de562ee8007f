# SPDX-License-Identifier: BSD-3-Clause
"""Sections for estimates: length scale, motors, and how far wrenches and model may be off in joint torques."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from forcetorque.base.errors import ExperimentError, require_known
from forcetorque.base.toml_file import Finite, NotNegative, Positive, Table, Text
from forcetorque.experiment.input_files import stated_in
from forcetorque.experiment.section import Loading, Section


class MotorTable(Table):
    """The motor of a joint, whose current or PWM duty gives the torque of the joint."""

    joint: Text
    """Joint of the URDF."""
    quantity: Literal["motor_current", "pwm"] = "motor_current"
    """What the recording holds of it."""
    torque_constant_Nm_per_A: Positive | None = None
    """Torque of the motor per ampere; N m/A; needed with `motor_current`."""
    torque_per_duty_Nm: Positive | None = None
    """Torque of the motor at rest at a duty of 1; N m; needed with `pwm`."""
    gear_ratio: Finite | None = None
    """Turns of the motor per turn of the joint; negative where it turns the other way."""
    standstill: Positive = 0.02
    """Speed below which friction may be anything, so that the motor shows nothing; rad/s, m/s."""

    @property
    def torque_constant(self) -> float:
        """Torque of the motor per unit of what the recording holds; N m/A, N m."""
        stated = self.torque_constant_Nm_per_A if self.quantity == "motor_current" else self.torque_per_duty_Nm
        return stated or 0.0

    @model_validator(mode="after")
    def _tells_a_torque(self) -> MotorTable:
        key, other = "torque_constant_Nm_per_A", "torque_per_duty_Nm"
        if self.quantity == "pwm":
            key, other = other, key
        if getattr(self, key) is None or self.gear_ratio in (None, 0.0) or getattr(self, other) is not None:
            message = (
                f"motor of joint {self.joint!r}: expected {key} and a gear_ratio other than 0 with the quantity "
                f"{self.quantity}, and no {other}; the torque cannot be computed from a motor without them"
            )
            raise ValueError(message)
        return self


class FusionTable(Table):
    """How joint torques of several sources are made one."""

    model_deviation: Positive | Annotated[dict[Text, Positive], Field(min_length=1)]
    """Standard deviation of what masses and motion leave open in a torque that is computed from wrenches: one for all
    joints, or a table of one per joint; N m, N where prismatic. All sources that use wrenches share this error."""
    noise_time_s: NotNegative = 1.0
    """Time over which errors of wrenches and model repeat themselves, as those of a matrix do that change with the
    load; 0 where they are white noise; s."""
    false_alarm: Annotated[float, Field(gt=0.0, lt=1.0, strict=True)] = 0.01
    """Largest rate of intervals, or windows, with a conflict though all is as specified."""
    window_s: Positive = 1.0
    """Length of the windows in which sources are compared; s."""


class EstimationTable(Table):
    """How contacts are separated."""

    length_scale_m: Positive | None = None
    """Moment that weighs as much as one newton; needed where a sub-model has more than six unknowns."""


def _checked(motors: tuple[MotorTable, ...], loading: Loading) -> tuple[MotorTable, ...]:
    """Motors of joints that the robot has, and of which the recording holds what they show."""
    file, model, recording = loading.file, loading.model, loading.recording
    for index, motor in enumerate(motors):
        where = f"{file}: motor[{index}]"
        require_known(
            motor.joint, model.joints, ExperimentError, f"{where}: robot {model.name!r} has no joint {motor.joint!r}"
        )
        if motor.joint in [earlier.joint for earlier in motors[:index]]:
            raise ExperimentError(f"{where}: the joint {motor.joint!r} is listed twice; keep one motor")
        if motor.quantity != motors[0].quantity:
            raise ExperimentError(
                f"{where}: expected the quantity {motors[0].quantity}, as of the motors before, got {motor.quantity}; "
                "motors are one source"
            )
        with stated_in(where):
            signals = recording.joint_signals(motor.quantity)
        require_known(
            motor.joint, signals, ExperimentError, f"{where}: no stream holds {motor.quantity} of joint {motor.joint!r}"
        )
    return motors


def _as_stated(table: FusionTable | None, loading: Loading) -> FusionTable | None:
    return table


def _length_scale(table: EstimationTable, loading: Loading) -> float | None:
    return table.length_scale_m


MOTORS: Section[tuple[MotorTable, ...], tuple[MotorTable, ...]] = Section(
    key="motor",
    type=tuple[MotorTable, ...],
    default=(),
    description="Motors whose current or PWM gives joint torques, for `estimate --fuse`.",
    read=_checked,
    empty=(),
)
FUSION: Section[FusionTable | None, FusionTable | None] = Section(
    key="fusion",
    type=FusionTable | None,
    default=None,
    description="How joint torques of several sources are made one; needed for `estimate --fuse`.",
    read=_as_stated,
    empty=None,
)
LENGTH_SCALE: Section[EstimationTable, float | None] = Section(
    key="estimation",
    type=EstimationTable,
    default=EstimationTable(),
    description="How contacts are separated.",
    read=_length_scale,
    empty=None,
    of_robot=False,
)
"""Moment that weighs as much as one newton, where contacts leave something undetermined; m."""
