# SPDX-License-Identifier: BSD-3-Clause
"""Rows of a calibration device: its loads, its motions, and what was written."""

from __future__ import annotations

from typing import Annotated

import numpy as np

from forcetorque.exsitu.device import Device, DeviceAnswer, DeviceTrajectory, HungLoad
from forcetorque.result import Row, Shown


class DeviceLoadRow(Row):
    """What a load does in the motion of the device."""

    load: Annotated[str, Shown("load")]
    """What it is called."""
    mass_kg: Annotated[float, Shown("mass", "kg", digits=2)]
    """Mass, carrier included."""
    centre_m: Annotated[float, Shown("from hinge", "m", digits=4)]
    """Distance of its centre of mass from the axis of the hinge."""
    force_N: Annotated[float, Shown("force", "N", digits=1)]
    """Largest force on the innermost sensor."""
    moment_Nm: Annotated[float, Shown("moment", "N m", digits=2)]
    """Largest moment on it."""
    pitch_Nm: Annotated[float, Shown("pitch", "N m", digits=2)]
    """Largest torque of the motor of pitch."""
    yaw_Nm: Annotated[float, Shown("yaw", "N m", digits=2)]
    """Largest torque of the motor of yaw."""
    hinge_Nm: Annotated[float, Shown("lock", "N m", digits=2)]
    """Largest torque on the lock of the hinge."""


class DeviceMotionRow(Row):
    """A motion of the device."""

    motion: Annotated[str, Shown("motion")]
    """What it is called."""
    order: Annotated[str, Shown("axes")]
    """Axes from the base on."""
    postures: Annotated[int, Shown("postures")]
    """At how many it rests."""
    duration_s: Annotated[float, Shown("time", "s", digits=1)]
    """How long it takes."""
    pitch_deg_s: Annotated[float, Shown("pitch", "deg/s", digits=1)]
    """Largest speed of pitch."""
    yaw_deg_s: Annotated[float, Shown("yaw", "deg/s", digits=1)]
    """Largest speed of yaw."""


class DeviceRecordingRow(Row):
    """A simulated recording of the device."""

    experiment: Annotated[str, Shown("experiment", file=True)]
    """Its experiment file."""
    load: Annotated[str, Shown("load")]
    """What hangs on the device."""
    use: Annotated[str, Shown("use")]
    """What it is for."""
    seconds: Annotated[float, Shown("time", "s", digits=0)]
    """Length."""
    samples: Annotated[int, Shown("samples")]
    """Samples of all sensors."""
    saturated: Annotated[int, Shown("saturated")]
    """How many of them are saturated."""


def load_row(device: Device, load: HungLoad, answer: DeviceAnswer) -> DeviceLoadRow:
    """Sum up what a load does.

    Args:
        device: The device.
        load: What hangs on it.
        answer: What sensors read and motors hold in the motion.

    Returns:
        The row.
    """
    wrench = answer.wrenches.of_name(device.sensor_names[0])
    peaks = {joint: float(np.abs(answer.torque(joint)).max()) for joint in ("pitch", "yaw", "hinge")}
    return DeviceLoadRow(
        load=load.name,
        mass_kg=load.mass_kg,
        centre_m=float(np.linalg.norm(load.centre_of_mass_m)),
        force_N=float(np.linalg.norm(wrench[:, :3], axis=1).max()),
        moment_Nm=float(np.linalg.norm(wrench[:, 3:], axis=1).max()),
        pitch_Nm=peaks["pitch"],
        yaw_Nm=peaks["yaw"],
        hinge_Nm=peaks["hinge"],
    )


def motion_row(name: str, trajectory: DeviceTrajectory, rate_hz: float) -> DeviceMotionRow:
    """Sum up a motion.

    Args:
        name: What it is called.
        trajectory: The motion.
        rate_hz: Rate at which its speeds are looked at.

    Returns:
        The row.
    """
    device = trajectory.device
    _, motion = trajectory.sampled(rate_hz)
    fastest = dict(zip(motion.names, np.rad2deg(np.abs(motion.velocity).max(axis=0)).tolist(), strict=True))
    axes = ("yaw", "pitch") if device.yaw_first else ("pitch", "yaw")
    return DeviceMotionRow(
        motion=name,
        order=", ".join((*axes, *device.joint_names[2:])),
        postures=len(trajectory.sequence.postures),
        duration_s=trajectory.duration_s,
        pitch_deg_s=fastest["pitch"],
        yaw_deg_s=fastest["yaw"],
    )
