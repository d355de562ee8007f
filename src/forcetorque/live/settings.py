# SPDX-License-Identifier: BSD-3-Clause
"""What is stated of a live run on the command line, and what it states of correctors."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any

import numpy as np

from forcetorque.base.errors import ForceTorqueError, RecordingError, known_names
from forcetorque.base.units import parsed_numbers
from forcetorque.live.bias_tracking_and_tare import Tracking
from forcetorque.live.corrector import CorrectorOptions
from forcetorque.live.gravity_and_tool_weight import Tool
from forcetorque.live.net_ft import RDT_PORT
from forcetorque.live.option_values import FaultPolicy, HeldQuantity, Input, OffsetSource
from forcetorque.live.zenoh_session import ROUTER


@dataclass(frozen=True, slots=True, kw_only=True)
class Settings:
    """What is stated of a live run; every option of the command by its name."""

    form: Input | None = None
    """Form of the lines on standard input."""
    quantity: HeldQuantity | None = None
    """What samples hold."""
    channels: Sequence[str] = ()
    """`[SENSOR=]COLUMN,COLUMN,...`."""
    variables: Sequence[str] = ()
    """`[SENSOR.]NAME=COLUMN`, or an index in the list of temperatures."""
    status: Sequence[str] = ()
    """`[SENSOR=]COLUMN`."""
    index: Sequence[str] = ()
    """`[SENSOR=]INDEX` in the list of force-torque sensors."""
    stamp: str | None = None
    """`COLUMN:UNIT`."""
    sequence: str | None = None
    """Column of packet numbers."""
    gravity: str | None = None
    """Three columns."""
    envelope: bool = False
    """Whether lines of YARP begin with number and time."""
    frame: Sequence[str] = ()
    """`[SENSOR=]FRAME`: of messages of ROS 2 their frame, of wrenches of a table that of the calibration."""
    rate_hz: float | None = None
    """Rate of the sender; Hz."""
    replay: Path | None = None
    """Experiment file."""
    speed: float = 1.0
    """Times as fast as it was recorded; 0 for as fast as possible."""
    ati: str | None = None
    """Address of a box."""
    ati_port: int = RDT_PORT
    """Its port."""
    ati_force: str | None = None
    """Unit of a count of force."""
    ati_torque: str | None = None
    """Unit of a count of moment."""
    ros2: Sequence[str] = ()
    """`[SENSOR=]TOPIC` of WrenchStamped."""
    publish: Sequence[str] = ()
    """`[SENSOR=]TOPIC` of corrected wrenches."""
    domain: int = 0
    """`ROS_DOMAIN_ID`."""
    router: str = ROUTER
    """Endpoint of the router of zenoh."""
    robot: Path | None = None
    """URDF by which gravity follows from joints."""
    joints: str | None = None
    """Topic of JointState."""
    base_gravity: str | None = None
    """Acceleration of free fall along the axes of the root link; x,y,z; m/s2."""
    shown: bool = False
    """Whether a page shows the run, with the robot where it is stated."""
    offset: OffsetSource = OffsetSource.FITTED
    """Where the offset comes from."""
    session: str | None = None
    """Power cycle that gives the fitted offset."""
    tare_s: float = 1.0
    """Time that a tare takes; s."""
    tool_mass_kg: float | None = None
    """Mass of the tool; kg."""
    tool_centre_m: str | None = None
    """Its centre of mass in the frame of the reading; x,y,z; m."""
    take_tool_off: bool = False
    """Whether its weight is taken off."""
    random_walk: str | None = None
    """Random walk of the bias in an hour; N,N m."""
    tracking_noise: str | None = None
    """Noise that is neither bias nor load; N,N m."""
    with_temperature: bool = False
    """Whether a part of the tracked bias is linear in temperature."""
    policy: FaultPolicy = FaultPolicy.FLAG
    """What becomes of samples with a fault."""
    limit_counts: float | None = None
    """Limit of the converter; counts."""
    frozen_after_s: float = 0.5
    """Time for which channels may repeat a reading; s; 0 for any."""


def corrector_options(settings: Settings, quantity: HeldQuantity) -> CorrectorOptions:
    """Give the options of the correctors.

    Args:
        settings: What is stated.
        quantity: What samples hold.

    Returns:
        The options.

    Raises:
        RecordingError: If a number is out of range, or mass or centre of the tool is missing.
    """
    if (settings.tool_mass_kg is None) != (settings.tool_centre_m is None):
        raise RecordingError("expected both --tool-mass and --tool-centre, or neither of them")
    tool = None
    if settings.tool_mass_kg is not None and settings.tool_centre_m is not None:
        tool = Tool(
            mass_kg=settings.tool_mass_kg, centre_m=np.array(numbers_of("--tool-centre", settings.tool_centre_m, 3))
        )
    tracking = Tracking(with_temperature=settings.with_temperature)
    if settings.random_walk is not None:
        force, moment = numbers_of("--random-walk", settings.random_walk, 2)
        tracking = replace(tracking, random_walk_N=force, random_walk_Nm=moment)
    if settings.tracking_noise is not None:
        force, moment = numbers_of("--tracking-noise", settings.tracking_noise, 2)
        tracking = replace(tracking, noise_N=force, noise_Nm=moment)
    return CorrectorOptions(
        quantity=quantity,
        session=settings.session,
        offset=settings.offset,
        tare_s=settings.tare_s,
        policy=settings.policy,
        limit_counts=settings.limit_counts,
        frozen_after_s=settings.frozen_after_s or math.inf,
        tool=tool,
        take_tool_off=settings.take_tool_off,
        tracking=tracking,
    )


def numbers_of(option: str, text: str, count: int) -> list[float]:
    """Read numbers between commas.

    Args:
        option: Option that states them.
        text: The numbers.
        count: How many there must be.

    Returns:
        The numbers.

    Raises:
        RecordingError: If they are not so many finite numbers.
    """
    values = parsed_numbers(text.split(","))
    if len(values) != count or not all(map(math.isfinite, values)):
        raise RecordingError(f"{option}: expected {count} numbers between commas, got {text!r}")
    return values


_OPTIONS = {"variables": "variable", "rate_hz": "rate", "tool_mass_kg": "tool-mass"}
"""Options that are not called as their settings."""


def refuse(settings: Settings, *names: str, of: str | None = None) -> None:
    """Refuse settings that do nothing.

    Args:
        settings: What is stated.
        *names: Names of the settings.
        of: What they do nothing for; None for the source.

    Raises:
        RecordingError: If one is stated.
    """
    of = of or (
        "--replay"
        if settings.replay is not None
        else "--ati"
        if settings.ati is not None
        else "--ros2"
        if settings.ros2
        else f"--input {settings.form}"
    )
    defaults = {entry.name: entry.default for entry in fields(settings)}
    for name in names:
        value = getattr(settings, name)
        if value != defaults[name] and value != []:
            raise RecordingError(f"--{_OPTIONS.get(name, name.replace('_', '-'))}: not of {of}")


def by_sensor(option: str, entries: Sequence[str], names: Sequence[str]) -> dict[str, str]:
    """Divide what is stated for every sensor, as `SENSOR=...`; of one sensor without its name.

    Args:
        option: Option that states it.
        entries: What is stated.
        names: Names of the sensors.

    Returns:
        What is stated by sensor; not every sensor must be there.

    Raises:
        RecordingError: If a sensor is not known, or stated twice.
    """
    values: dict[str, str] = {}
    for entry in entries:
        name, equals, value = entry.partition("=")
        if not equals and len(names) == 1:
            name, value = names[0], entry
        if name not in names or name in values:
            raise RecordingError(f"{option} {entry}: expected SENSOR=... once per sensor; {known_names(name, names)}")
        values[name] = value
    return values


def read_settings(values: Mapping[str, Any]) -> Settings:
    """Take what was typed.

    Args:
        values: Options by name; None for those that were not typed.

    Returns:
        The settings.

    Raises:
        ForceTorqueError: If a number is not finite.
    """
    for name, value in values.items():
        if isinstance(value, float) and not math.isfinite(value):
            raise ForceTorqueError(f"--{name.replace('_', '-')}: expected a finite number, got {value}")
    return Settings(**{name: value for name, value in values.items() if value is not None})
