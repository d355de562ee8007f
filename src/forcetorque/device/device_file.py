# SPDX-License-Identifier: BSD-3-Clause
"""The file of a device: its parts, its motion, what is simulated; and the device that comes with the library."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from forcetorque.base.toml_file import Finite, NotNegative, Positive, Table, read_toml
from forcetorque.device.description import Device
from forcetorque.device.motion import Sequence, YawReturn, twelve_steps
from forcetorque.simulation.scenario.file import Imu, Sensors


class DevicePosture(Table):
    """A posture that the device goes to."""

    pitch_deg: Finite
    """Pitch."""
    yaw_deg: Finite
    """Yaw."""
    turn_deg: Finite = 0.0
    """The turn about the axis of the sensors, of a device that has one."""
    hinge_deg: Finite = 0.0
    """The hinge, at the end."""
    unlocked: bool = False
    """Whether the hinge hangs freely on the way there."""


class DeviceMotion(Table):
    """How the device moves."""

    yaw_return: YawReturn = YawReturn.TOGETHER
    """How yaw gets back to 0 in the 12 steps."""
    hold_s: NotNegative = 1.0
    """Rest at every posture."""
    posture: Annotated[tuple[DevicePosture, ...], Field(min_length=2)] | None = None
    """Postures in turn; the 12 steps of the thesis if left out."""


class DeviceSimulation(Table):
    """Recordings that are simulated, one for each load."""

    seed: Annotated[int, Field(ge=0, strict=True)] = 1
    """Seed of sensors and noise."""
    loads_kg: Annotated[tuple[NotNegative, ...], Field(min_length=1)] = (35.0, 15.0)
    """Loads to calibrate with; 0 is the empty carrier."""
    validation_kg: tuple[NotNegative, ...] = (25.0,)
    """Loads to judge the calibration with."""
    rate_hz: Positive = 100.0
    """Rate of every stream."""
    prior: bool = False
    """Whether the experiment files name the matrices that the sensors had before they were mounted."""
    accuracy_N: Positive = 0.9
    """Accuracy of reference forces that the experiment files state: encoders of 0.5 degree, as the thesis considers
    them, are off by 0.14 degree (root mean square), and 35 kg make 0.9 N of it."""
    accuracy_Nm: Positive = 0.2
    """The same of reference moments, 0.245 m from the load."""
    sensors: Sensors = Sensors(family="double range", limit_counts=131071)
    """What the sensors are made of; 35 kg at these levers take more than the 16 bits of the usual ones."""
    imu: Imu | None = None
    """An IMU that tells gravity in place of a level base; none if left out."""

    @model_validator(mode="after")
    def _loads_differ(self) -> DeviceSimulation:
        loads = (*self.loads_kg, *self.validation_kg)
        if len(set(loads)) != len(loads):
            stated = ", ".join(f"{load:g}" for load in loads)
            message = f"expected each load once in loads_kg and validation_kg, got {stated}"
            raise PydanticCustomError("loads", "{message}", {"message": message})
        return self


class DeviceFile(Device):
    """The whole file."""

    schema_name: Literal["forcetorque/device-file/1"] = Field(alias="schema")
    """Form of the file."""
    motion: DeviceMotion = DeviceMotion()
    """How it moves."""
    simulation: DeviceSimulation = DeviceSimulation()
    """What is simulated of it."""

    @property
    def sequence(self) -> Sequence:
        """What it does."""
        stated = self.motion.posture
        if stated is None:
            return twelve_steps(self, yaw_return=self.motion.yaw_return)
        keys = [f"{joint}_deg" for joint in self.joint_names]
        return Sequence.of(
            self,
            "motion",
            [[getattr(posture, key) for key in keys] for posture in stated],
            unlocked=tuple(posture.unlocked for posture in stated[1:]),
        )


DEFAULT_DEVICE = Path(__file__).with_name("default.toml")
"""A device with the figures that the thesis prints; what it does not print is ours."""


def read_device(path: Path | str = DEFAULT_DEVICE) -> DeviceFile:
    """Read what a device is made of, how it moves and what is simulated of it.

    Args:
        path: TOML file; the device that comes with the library if left out.

    Returns:
        The device.
    """
    return read_toml(path, DeviceFile, what="a device file")
