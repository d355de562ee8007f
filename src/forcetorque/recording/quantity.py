# SPDX-License-Identifier: BSD-3-Clause
"""The quantities that a stream may hold: their columns, units and meaning.

This table is the single definition; docs/recording.md and `forcetorque schema recording` are made
from it, readers fill it and everything later uses nothing else.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from forcetorque.spatial import WRENCH_COMPONENTS, WRENCH_UNITS


class Labels(StrEnum):
    """What names the columns of a quantity."""

    FIXED = "fixed"
    """The columns always have the same names."""
    JOINTS = "joints"
    """One column per joint, named as in the robot model."""
    CHANNELS = "channels"
    """One column per channel of the electronics, in the order of the electronics."""
    TAXELS = "taxels"
    """One column per number in a message of skin, in its order."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Quantity:
    """One physical quantity of a recording."""

    name: str
    """Name of the signal in a stream."""
    labels: Labels
    """What names its columns."""
    columns: tuple[str, ...] = ()
    """Column names where they are fixed."""
    units: tuple[str, ...] = ()
    """Allowed units: one per column where the columns are fixed, else the choice that each column has; any if empty."""
    has_frame: bool = False
    """Whether the values are along the axes of a frame, which must then be named."""
    description: str
    """Meaning, in one line."""


_XYZ = ("x", "y", "z")

QUANTITIES = {
    quantity.name: quantity
    for quantity in (
        Quantity(
            name="wrench",
            labels=Labels.FIXED,
            columns=WRENCH_COMPONENTS,
            units=WRENCH_UNITS,
            has_frame=True,
            description="Reading of a force-torque sensor that was already turned into force, then moment.",
        ),
        Quantity(
            name="applied_wrench",
            labels=Labels.FIXED,
            columns=WRENCH_COMPONENTS,
            units=WRENCH_UNITS,
            has_frame=True,
            description="Known wrench, as of a dead weight: what an exact sensor without bias reads, in its direction.",
        ),
        Quantity(
            name="vertical_force",
            labels=Labels.FIXED,
            columns=("vertical_force",),
            units=("N",),
            description="Force of the ground on a foot along the normal of its sole, positive where it presses.",
        ),
        Quantity(
            name="raw",
            labels=Labels.CHANNELS,
            units=("counts",),
            description="Reading of a force-torque sensor as its electronics deliver it.",
        ),
        Quantity(
            name="position",
            labels=Labels.JOINTS,
            units=("rad", "m"),
            description="Joint positions: rad for rotary joints, m for prismatic ones.",
        ),
        Quantity(
            name="velocity", labels=Labels.JOINTS, units=("rad/s", "m/s"), description="Joint velocities as logged."
        ),
        Quantity(
            name="acceleration",
            labels=Labels.JOINTS,
            units=("rad/s2", "m/s2"),
            description="Joint accelerations as logged.",
        ),
        Quantity(
            name="torque",
            labels=Labels.JOINTS,
            units=("N m", "N"),
            description="Joint torques along +q as the robot has them: N m for rotary joints, N for prismatic ones.",
        ),
        Quantity(
            name="motor_current",
            labels=Labels.JOINTS,
            units=("A",),
            description="Current of the motor of every joint, positive where it drives along +q times the gear ratio.",
        ),
        Quantity(
            name="pwm",
            labels=Labels.JOINTS,
            units=("1",),
            description="PWM duty of the motor of every joint, from -1 to 1, with the sign of the current.",
        ),
        Quantity(
            name="temperature",
            labels=Labels.FIXED,
            columns=("temperature",),
            units=("degC",),
            description="Temperature of a sensor.",
        ),
        Quantity(
            name="proper_acceleration",
            labels=Labels.FIXED,
            columns=_XYZ,
            units=("m/s2",) * 3,
            has_frame=True,
            description="Reading of an accelerometer: +9.8 m/s2 upwards at rest.",
        ),
        Quantity(
            name="orientation",
            labels=Labels.FIXED,
            columns=tuple(f"r{row}{column}" for row in "123" for column in "123"),
            units=("1",) * 9,
            has_frame=True,
            description="Rotation matrix of a frame, row by row: it turns vectors along its axes to the world's.",
        ),
        Quantity(
            name="translation",
            labels=Labels.FIXED,
            columns=_XYZ,
            units=("m",) * 3,
            has_frame=True,
            description="Where the origin of a frame is in the world, along the world's axes.",
        ),
        Quantity(
            name="gravity",
            labels=Labels.FIXED,
            columns=_XYZ,
            units=("m/s2",) * 3,
            has_frame=True,
            description="Acceleration of free fall along the axes of a frame: it points down.",
        ),
        Quantity(
            name="angular_velocity",
            labels=Labels.FIXED,
            columns=_XYZ,
            units=("rad/s",) * 3,
            has_frame=True,
            description="Reading of a gyroscope.",
        ),
        Quantity(
            name="angular_acceleration",
            labels=Labels.FIXED,
            columns=_XYZ,
            units=("rad/s2",) * 3,
            has_frame=True,
            description="Angular acceleration, where a device gives it.",
        ),
        Quantity(
            name="saturated",
            labels=Labels.FIXED,
            columns=("saturated",),
            units=("0 or 1",),
            description="Status of a board: 1 while a channel is at its limit and the last valid sample is held.",
        ),
        Quantity(
            name="taxel_counts",
            labels=Labels.TAXELS,
            units=("counts",),
            description="Reading of every taxel of a patch of skin as its electronics deliver it; pressure lowers it.",
        ),
        Quantity(
            name="skin_event",
            labels=Labels.CHANNELS,
            units=("m", "1", "counts", "heuristic"),
            has_frame=True,
            description="Contacts that a skinManager sees on a patch; its force is a heuristic, not newtons.",
        ),
        Quantity(
            name="pressure",
            labels=Labels.FIXED,
            columns=("pressure",),
            units=("Pa",),
            description="Pressure of a chamber or bag above that of the air around, which skin is calibrated with.",
        ),
        Quantity(
            name="scalar",
            labels=Labels.CHANNELS,
            description="Anything else that may move a reading, such as a supply voltage; names and units of the log.",
        ),
        Quantity(
            name="device_stamp",
            labels=Labels.FIXED,
            columns=("device_stamp",),
            units=("tick",),
            description="The device's own clock, in its own unit: shows transport delay and jitter.",
        ),
    )
}
"""Every quantity by name."""
