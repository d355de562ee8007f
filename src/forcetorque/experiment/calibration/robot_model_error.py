# SPDX-License-Identifier: BSD-3-Clause
"""How far a robot model may be from the robot, and the numbers of it that a fit estimates beside the sensor."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Final

import numpy as np

from forcetorque.base.stored_table import StoredTable

MASS: Final = "mass of "
"""How the name of the error of a mass begins."""
CENTRE: Final = " of centre of "
"""What the name of the error of a centre of mass has between axis and body."""
ZERO: Final = "zero of "
"""How the name of the error of a joint begins."""
ACCELERATION: Final = " of acceleration of "
"""What the name of the error of an acceleration has between axis and frame."""
DELAY: Final = "delay of the readings of "
"""How the name of the delay of a recording begins."""
PULL: Final = " pull of cables at "
"""What the name of the force of cables per rad has between axis and joint."""
TWIST: Final = " twist of cables at "
"""The same of their moment."""
CABLE_LEVER_M: Final = 0.05
"""Moment of cables over their force; m."""
SUSPICIOUS: Final = 3.0
"""Error of the model over its tolerance from which a warning names it."""


class TermKind(StrEnum):
    """What a number of the model is; errors of one kind share one size. A slider has no zero but a position."""

    MASS = "mass"
    CENTRE = "centre"
    ZERO = "joint zero"
    POSITION = "joint position"
    ACCELERATION = "acceleration"
    DELAY = "delay"
    PULL = "pull of cables"
    TWIST = "twist of cables"

    @property
    def unit(self) -> str:
        """Unit of the error; empty for a relative one."""
        return _UNITS[self]


OF_CABLES: Final = (TermKind.PULL, TermKind.TWIST)
"""Kinds of what cables and covers do, which are no numbers of the robot model itself."""
_UNITS: Final = {
    TermKind.MASS: "",
    TermKind.CENTRE: "m",
    TermKind.ZERO: "rad",
    TermKind.POSITION: "m",
    TermKind.ACCELERATION: "m/s2",
    TermKind.DELAY: "s",
    TermKind.PULL: "N/rad",
    TermKind.TWIST: "N m/rad",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class MountTolerance:
    """How far the frame of a sensor may be from that of the robot model, as standard deviations."""

    rotation_rad: float | None = None
    """Of the rotation about each axis; rad; None where nobody knows, so that data decide from some 0.35 degrees on."""
    shift_m: float | None = None
    """Of the shift of the origin along each axis; m; None for 2 mm."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ModelTolerance:
    """How far a robot model may be from the robot, as standard deviations."""

    mass: float = 0.03
    """Of the mass of every body, relative."""
    centre_m: float = 0.003
    """Of every coordinate of its centre of mass; m."""
    joint_zero_rad: float = float(np.radians(0.5))
    """Of the zero of every joint; rad, or m for one that slides."""
    acceleration: float = 0.05
    """Of every component of what an accelerometer reads at rest, or of gravity in a still frame; m/s2."""
    delay_s: float = 0.005
    """Of the time by which the readings of a recording come later than the joints; s."""
    cable_N_rad: float = 1.0
    """Of what cables and covers pull along each axis per rad of a joint near the sensor; N/rad, and of their moment as
    much over `CABLE_LEVER_M`. Data may find it smaller."""
    links: Mapping[str, float] = field(default_factory=dict)
    """Of the mass of single links, relative, by their names."""
    joints: Mapping[str, float] = field(default_factory=dict)
    """Of the zero of single joints, by their names; rad or m."""
    mounts: Mapping[str, MountTolerance] = field(default_factory=dict)
    """Of the frames of single sensors, by their names; of all others `mount`."""
    mount: MountTolerance = MountTolerance()
    """Of the frame of every sensor."""
    found: Mapping[str, float] = field(default_factory=dict)
    """Of numbers that an earlier calibration found, by the names of their errors; in the unit of each."""

    def mount_of(self, sensor: str) -> MountTolerance:
        """Give the tolerance of the frame of a sensor.

        Args:
            sensor: Its name.

        Returns:
            That of the sensor, or that of all.
        """
        return self.mounts.get(sensor, self.mount)


EXACT: Final = ModelTolerance(
    mass=0.0, centre_m=0.0, joint_zero_rad=0.0, acceleration=0.0, delay_s=0.0, cable_N_rad=0.0
)
"""A model that is taken to be exact."""


class ErrorTerm(StoredTable):
    """One number that the model may have wrong."""

    name: str
    """What it is, such as `mass of l_upper_leg`."""
    kind: TermKind
    """Kind of number."""
    deviation: float
    """Standard deviation before any data, in the unit of the kind."""
    nominal: float = 0.0
    """Mass that it is of, by which bodies of one name in several robots differ, such as tools; kg; 0 of other kinds."""

    @property
    def unit(self) -> str:
        """Its unit; empty for a relative one."""
        return self.kind.unit


class ModelError(StoredTable):
    """What a fit found of one number of the model."""

    name: str
    """What it is, such as `mass of l_upper_leg`."""
    unit: str
    """Its unit; empty for a relative one."""
    value: float
    """What is to be added to the number of the model; of a mass, relative."""
    standard_error: float
    """Standard deviation of the value after the fit."""
    tolerance: float
    """Standard deviation before any data."""

    @property
    def is_of_cables(self) -> bool:
        """Whether it is a pull or twist of cables, and no number of the robot model itself."""
        return PULL in self.name or TWIST in self.name

    @property
    def is_suspicious(self) -> bool:
        """Whether it is beyond `SUSPICIOUS` tolerances, and more than twice its standard error from zero."""
        return abs(self.value) > SUSPICIOUS * self.tolerance and abs(self.value) > 2.0 * self.standard_error

    @property
    def message(self) -> str:
        """The error with its 95 % interval, as a warning has it."""
        low, high = (self.value + sign * 1.96 * self.standard_error for sign in (-1.0, 1.0))
        scale, unit = {"": (100.0, "%"), "rad": (180.0 / np.pi, "deg"), "m": (1e3, "mm"), "s": (1e3, "ms")}.get(
            self.unit, (1.0, self.unit)
        )
        return (
            f"{self.name}: off by {scale * self.value:+.3g} {unit} (95 %: {scale * low:+.3g} to {scale * high:+.3g}), "
            f"tolerance {scale * self.tolerance:.3g} {unit}"
        )
