# SPDX-License-Identifier: BSD-3-Clause
"""Components of a calibration device: two axes, sensors in a stack, a hinge, a carrier with weights."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Self

import numpy as np
from pydantic import Field, model_validator

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import SensorError
from forcetorque.base.inertia import Inertia
from forcetorque.base.toml_file import Finite, NotNegative, Positive, Table, Text
from forcetorque.base.units import STANDARD_GRAVITY

_MOST_SENSORS = 3

Three = Annotated[tuple[Finite, ...], Field(min_length=3, max_length=3)]
Moments = Annotated[tuple[NotNegative, ...], Field(min_length=3, max_length=3)]


class Part(Table):
    """A rigid part; its frame is at its foot, z towards the load when the device is straight."""

    mass_kg: NotNegative
    """Mass."""
    centre_of_mass_m: Three = (0.0, 0.0, 0.0)
    """Centre of mass."""
    moments_kgm2: Moments = (0.0, 0.0, 0.0)
    """Rotational inertia about x, y and z through the centre of mass."""
    height_m: NotNegative = 0.0
    """Height from its foot to the foot of the next part."""


class Axis(Table):
    """A motor, and the part that it turns before the next axis or the stack."""

    range_deg: Annotated[tuple[Finite, ...], Field(min_length=2, max_length=2)]
    """Lowest and highest position."""
    speed_deg_s: Positive
    """Largest speed."""
    torque_Nm: Positive
    """Largest torque, which the motor may give for a moment."""
    part: Part
    """The part that it turns, in the frame of the axis."""

    @model_validator(mode="after")
    def _in_order(self) -> Axis:
        _require_order(self.range_deg, "range_deg")
        return self


class StackedSensor(Table):
    """A sensor between its interfaces; its frame is at the face of the body towards the load."""

    name: Text
    """Name of the sensor."""
    serial: Text
    """Serial number."""
    female: Part
    """Interface on the side of the motors."""
    body: Part
    """The sensor."""
    male: Part
    """Interface on the side of the load."""

    @property
    def height_m(self) -> float:
        """Height in the stack."""
        return self.female.height_m + self.body.height_m + self.male.height_m


class Turn(Table):
    """A joint that turns hinge and load about the axis of the sensors, set by hand or by another motor."""

    positions_deg: Annotated[tuple[Finite, ...], Field(min_length=1)] = (0.0, 90.0)
    """Positions that it can be set to."""
    speed_deg_s: Positive = 30.0
    """Largest speed."""


class Hinge(Table):
    """The passive joint; positive in the direction of gravity at yaw 0 while pitch rises from straight down."""

    locks_deg: Annotated[tuple[Finite, ...], Field(min_length=1)] = (0.0, 90.0)
    """Positions in which it locks by itself."""
    range_deg: Annotated[tuple[Finite, ...], Field(min_length=2, max_length=2)] = (-95.0, 95.0)
    """Lowest and highest position that its stops allow."""
    encoder: bool = False
    """Whether its position is measured, so that samples of its swing can be used."""
    bracket: Part
    """Part on the side of the sensors; its height ends at the axis of the hinge."""

    @model_validator(mode="after")
    def _locks_within_the_stops(self) -> Hinge:
        _require_order(self.range_deg, "range_deg")
        for lock in self.locks_deg:
            if not self.range_deg[0] <= lock <= self.range_deg[1]:
                raise ValueError(f"lock at {lock:g} deg: expected one within range_deg = {list(self.range_deg)}")
        return self


class Weights(Table):
    """Plates on the carrier, one on the other; the first one is lighter by the carrier, so that loads are round."""

    step_kg: Positive
    """Mass of a plate."""
    most_kg: Positive
    """Largest load."""
    foot_m: NotNegative
    """Distance of the first plate from the axis of the hinge."""
    height_m: Positive
    """Height of a plate of `step_kg`."""
    radius_m: Positive
    """Radius of the plates."""


class Device(Table):
    """A calibration device; with all joints at 0 its arm is level and straight.

    From the base on: pitch, yaw, the sensors in their stack, the turn if there is one, the hinge, the carrier.
    """

    name: Text
    """Name of the device."""
    gravity: Positive = STANDARD_GRAVITY
    """Magnitude of gravity; m/s2."""
    yaw_first: bool = False
    """Whether yaw comes before pitch, which does not reach all directions of gravity in the 12 steps."""
    pitch: Axis
    """The axis that raises the arm; it is level."""
    yaw: Axis
    """The axis along the arm."""
    sensor: Annotated[tuple[StackedSensor, ...], Field(min_length=1, max_length=_MOST_SENSORS)]
    """Sensors in the stack, from the motors to the load."""
    turn: Turn | None = None
    """Joint about the axis of the sensors; none if left out."""
    hinge: Hinge
    """The passive joint."""
    carrier: Part
    """Carrier of the weights, in the frame of the hinge."""
    weights: Weights
    """The weights."""

    @property
    def sensor_names(self) -> tuple[str, ...]:
        """Names of the sensors, from the motors to the load."""
        return tuple(sensor.name for sensor in self.sensor)

    @property
    def joint_names(self) -> tuple[str, ...]:
        """Joints in the order of postures: `pitch`, `yaw`, `turn` if there is one, `hinge`."""
        return ("pitch", "yaw", *(() if self.turn is None else ("turn",)), "hinge")

    @property
    def loads_kg(self) -> tuple[float, ...]:
        """Loads that can be put on; the empty carrier, which is no round number, comes first as 0."""
        count = math.floor(self.weights.most_kg / self.weights.step_kg + 1e-9)
        return tuple(k * self.weights.step_kg for k in range(count + 1))

    def with_sensors(self, count: int) -> Self:
        """Change the number of sensors.

        Args:
            count: Number of sensors.

        Returns:
            The device with the first of its sensors; additional ones are copies of the first, named with a number.
        """
        first = self.sensor[0]
        more = (
            first.model_copy(update={"name": f"{first.name}_{k + 1}", "serial": f"{first.serial}-{k + 1}"})
            for k in range(len(self.sensor), count)
        )
        return self.changed(sensor=(*self.sensor, *more)[:count])

    def with_locks(self, *locks_deg: float) -> Self:
        """Change the locks of the hinge.

        Args:
            locks_deg: Positions of the locks.

        Returns:
            The device with these locks.
        """
        return self.changed(hinge=self.hinge.model_copy(update={"locks_deg": locks_deg}))

    def changed(self, **fields: object) -> Self:
        """Change fields, and validate the device again.

        Args:
            **fields: Fields with their new values.

        Returns:
            The device; pydantic raises `ValidationError` if it is invalid.
        """
        return type(self).model_validate(self.model_copy(update=fields).model_dump(by_alias=True))

    @model_validator(mode="after")
    def _names_differ(self) -> Device:
        for field in ("name", "serial"):
            values = [getattr(sensor, field) for sensor in self.sensor]
            if len(set(values)) != len(values):
                raise ValueError(f"sensors: expected each {field} once, got {', '.join(values)}")
        return self

    @model_validator(mode="after")
    def _the_carrier_is_lighter_than_a_plate(self) -> Device:
        if not 0.0 < self.carrier.mass_kg < self.weights.step_kg <= self.weights.most_kg:
            message = (
                f"expected 0 kg < carrier < weights.step_kg <= weights.most_kg, got a carrier of "
                f"{self.carrier.mass_kg:g} kg, steps of {self.weights.step_kg:g} kg and {self.weights.most_kg:g} kg"
            )
            raise ValueError(message)
        return self


def _require_order(bounds: tuple[float, ...], field: str) -> None:
    if not bounds[0] < bounds[1]:
        raise ValueError(f"{field}: expected the lowest, then the highest, got {list(bounds)}")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class AttachedLoad:
    """A load on the hinge, carrier included."""

    name: str
    """Name, such as `35 kg`."""
    inertia: Inertia
    """Inertia in and about the frame of the carrier: at the hinge, y along its axis, z towards the load."""

    @classmethod
    def point(cls, mass_kg: float, distance_m: float) -> AttachedLoad:
        """Make a point mass straight in front of the hinge.

        Args:
            mass_kg: Mass.
            distance_m: Distance from the axis of the hinge.

        Returns:
            The load.

        Raises:
            SensorError: If the mass or the distance is not positive.
        """
        if not (0.0 < mass_kg < np.inf and 0.0 < distance_m < np.inf):
            raise SensorError(
                f"load: expected a mass of more than 0 kg in front of the hinge, got {mass_kg:g} kg at {distance_m:g} m"
            )
        inertia = Inertia.about_centre_of_mass(
            mass=mass_kg, centre_of_mass=[0.0, 0.0, distance_m], second_moment=np.zeros((3, 3))
        )
        return cls(name=f"{mass_kg:g} kg at {distance_m:g} m", inertia=inertia)

    @property
    def mass_kg(self) -> float:
        """Mass."""
        return self.inertia.mass

    @property
    def centre_of_mass_m(self) -> FloatArray:
        """Centre of mass in the frame of the carrier; shape (3,)."""
        return self.inertia.first_moment / self.inertia.mass


def device_load(device: Device, load_kg: float) -> AttachedLoad:
    """Put weights on the carrier.

    Args:
        device: The device.
        load_kg: Load, carrier included, in steps of a plate; 0 is the empty carrier; kg.

    Returns:
        The load.

    Raises:
        SensorError: If there is no such number of plates.
    """
    steps = load_kg / device.weights.step_kg
    if not 0.0 <= load_kg <= device.weights.most_kg + 1e-9 or abs(steps - round(steps)) > 1e-9:
        raise SensorError(
            f"load: device {device.name!r} takes {', '.join(f'{load:g}' for load in device.loads_kg)} kg, carrier "
            f"included and 0 for the empty carrier; got {load_kg:g} kg"
        )
    carrier = part_inertia(device.carrier)
    if round(steps) == 0:
        return AttachedLoad(name="empty carrier", inertia=carrier)
    return AttachedLoad(
        name=f"{load_kg:g} kg", inertia=carrier + _plates(device.weights, load_kg, load_kg - device.carrier.mass_kg)
    )


def part_inertia(part: Part) -> Inertia:
    """Compute the inertia of a part in and about its frame."""
    return Inertia.about_centre_of_mass(
        mass=part.mass_kg, centre_of_mass=part.centre_of_mass_m, second_moment=np.diag(part.moments_kgm2)
    )


def _plates(weights: Weights, load_kg: float, mass_kg: float) -> Inertia:
    """Inertia of a solid cylinder as high as the plates of a load."""
    height = weights.height_m * load_kg / weights.step_kg
    across = mass_kg * (3.0 * weights.radius_m**2 + height**2) / 12.0
    along = mass_kg * weights.radius_m**2 / 2.0
    return Inertia.about_centre_of_mass(
        mass=mass_kg,
        centre_of_mass=[0.0, 0.0, weights.foot_m + height / 2.0],
        second_moment=np.diag([across, across, along]),
    )
