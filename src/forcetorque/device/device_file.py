# SPDX-License-Identifier: BSD-3-Clause
"""The file of a device: its components, motion and simulation; and the default device."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, model_validator

from forcetorque.base.toml_file import Finite, NotNegative, Positive, Table, read_toml
from forcetorque.device.components import Device
from forcetorque.device.motion import Sequence, YawReturn, twelve_steps
from forcetorque.simulation.scenario.file import Imu, Sensors


class DevicePosture(Table):
    """A posture of the motion."""

    pitch_deg: Finite
    """Pitch."""
    yaw_deg: Finite
    """Yaw."""
    turn_deg: Finite = 0.0
    """The joint about the axis of the sensors, of a device that has one."""
    hinge_deg: Finite = 0.0
    """The hinge, at the end of the way."""
    unlocked: bool = False
    """Whether the hinge hangs freely on the way there."""


class DeviceMotion(Table):
    """The motion of the device."""

    yaw_return: YawReturn = YawReturn.TOGETHER
    """How yaw returns to 0 in the 12 steps."""
    hold_s: NotNegative = 1.0
    """Rest at every posture."""
    posture: Annotated[tuple[DevicePosture, ...], Field(min_length=2)] | None = None
    """Postures in order; the 12 steps of the thesis if left out."""


class DeviceSimulation(Table):
    """Recordings that are simulated, one for each load."""

    seed: Annotated[int, Field(ge=0, strict=True)] = 1
    """Seed of sensors and noise."""
    loads_kg: Annotated[tuple[NotNegative, ...], Field(min_length=1)] = (35.0, 15.0)
    """Loads to calibrate with; 0 is the empty carrier."""
    validation_kg: tuple[NotNegative, ...] = (25.0,)
    """Loads to validate the calibration with."""
    rate_hz: Positive = 100.0
    """Rate of every stream."""
    prior: bool = False
    """Whether the experiment files name the prior matrices of the sensors."""
    accuracy_N: Positive = 0.9
    """Accuracy of expected forces in the experiment files: encoders of 0.5 degree, as in the thesis, have an error of
    0.14 degree (root mean square), which is 0.9 N of 35 kg."""
    accuracy_Nm: Positive = 0.2
    """The same of expected moments, 0.245 m from the load."""
    sensors: Sensors = Sensors(family="double range", limit_counts=131071)
    """Family and range of the sensors; 35 kg at these levers need more than the usual 16 bits."""
    imu: Imu | None = None
    """An IMU that measures gravity in place of a level base; none if left out."""

    @model_validator(mode="after")
    def _loads_differ(self) -> DeviceSimulation:
        loads = (*self.loads_kg, *self.validation_kg)
        if len(set(loads)) != len(loads):
            listed = ", ".join(f"{load:g}" for load in loads)
            raise ValueError(f"expected each load once in loads_kg and validation_kg, got {listed}")
        return self


class DeviceHeat(Table):
    """Heating and cooling of the sensors in their stack, as one body that loses heat to the room."""

    heating_W: NotNegative
    """Heat that the heater, or the Peltier element, puts in at most."""
    cooling_W: NotNegative
    """Heat that it takes out at most; 0 of a heater."""
    loss_W_per_K: Positive
    """Heat that sensors and interfaces lose to the room and to the arm, for every kelvin above them."""
    capacity_J_per_K: Positive
    """Heat capacity of sensors and interfaces."""
    ambient_degC: Finite = 22.0
    """Temperature of the room."""


class DeviceFile(Device):
    """The whole file."""

    schema_name: Literal["forcetorque/device-file/1"] = Field(alias="schema")
    """Form of the file."""
    motion: DeviceMotion = DeviceMotion()
    """Its motion."""
    simulation: DeviceSimulation = DeviceSimulation()
    """Its simulation."""
    heat: DeviceHeat | None = None
    """Heating and cooling of the largest stack of sensors; none if left out."""

    @property
    def sequence(self) -> Sequence:
        """The sequence of postures."""
        postures = self.motion.posture
        if postures is None:
            return twelve_steps(self, yaw_return=self.motion.yaw_return)
        keys = [f"{joint}_deg" for joint in self.joint_names]
        return Sequence.of(
            self,
            "motion",
            [[getattr(posture, key) for key in keys] for posture in postures],
            unlocked=tuple(posture.unlocked for posture in postures[1:]),
        )


DEFAULT_DEVICE = Path(__file__).with_name("default.toml")
"""A device with the numbers of the thesis, and with ours where the thesis has none."""


def read_device(path: Path | str = DEFAULT_DEVICE) -> DeviceFile:
    """Read a device, its motion and its simulation.

    Args:
        path: TOML file; the default device if left out.

    Returns:
        The device.
    """
    return read_toml(path, DeviceFile, what="a device file")
