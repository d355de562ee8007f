# SPDX-License-Identifier: BSD-3-Clause
"""What an experiment file says for the fusion of joint torques: motors, and how far wrenches and model may be off."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from forcetorque.base.toml_file import Finite, NotNegative, Positive, Table, Text


class MotorTable(Table):
    """The motor of a joint, whose current or PWM duty tells the torque of the joint."""

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
    """Speed below which friction may be anything, so that the motor tells nothing; rad/s, m/s."""

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
                f"{self.quantity}, and no {other}; no torque can be told from a motor without them"
            )
            raise PydanticCustomError("motor_constant", "{message}", {"message": message})
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
    """Largest rate of intervals, or windows, with a conflict though all is as stated."""
    window_s: Positive = 1.0
    """Length of the windows in which sources are compared; s."""
