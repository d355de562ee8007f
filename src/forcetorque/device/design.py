# SPDX-License-Identifier: BSD-3-Clause
"""A calibration device by computation: its loads, motions, and what can be identified with it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import FloatArray
from forcetorque.device.demands import DeviceDemands, device_demands
from forcetorque.device.description import AttachedLoad, Device, device_load
from forcetorque.device.device_file import DeviceFile
from forcetorque.device.expected_wrench import DeviceResponse, answer_of
from forcetorque.device.motion import DeviceTrajectory
from forcetorque.device.span import DeviceSpan, device_span
from forcetorque.results.result import Result
from forcetorque.results.table import Row, Shown, Table, table_of
from forcetorque.robot.motion import JointMotion


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
    """Load attached to the device."""
    use: Annotated[str, Shown("use")]
    """What it is for."""
    seconds: Annotated[float, Shown("time", "s", digits=0)]
    """Length."""
    samples: Annotated[int, Shown("samples")]
    """Samples of all sensors."""
    saturated: Annotated[int, Shown("saturated")]
    """How many of them are saturated."""


def load_row(device: Device, load: AttachedLoad, answer: DeviceResponse) -> DeviceLoadRow:
    """Sum up what a load does.

    Args:
        device: The device.
        load: Attached load.
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


PICTURE_HZ = 10.0
"""Rate at which motions are looked at and drawn."""
_SWAPPED = "axes swapped"
"""What is added to the name of a motion where the first two axes are swapped (figure 6.6)."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DevicePicture:
    """What figures of a device show."""

    time_s: FloatArray
    """Instants; shape (n,); s."""
    motion: JointMotion
    """Motion of the joints at them."""
    answer: DeviceResponse
    """What sensors read and motors hold with the heaviest load."""
    clouds: dict[str, FloatArray]
    """Wrenches of the innermost sensor by the names of the motions; shapes (n, 6); N, N m."""


class DeviceDesign(Result):
    """A calibration device, checked by computation."""

    schema_name: Literal["forcetorque/device/1"] = Field(default="forcetorque/device/1", alias="schema")
    """Form of the result."""
    device: str
    """Name of the device."""
    sensors: tuple[str, ...]
    """Sensors in the stack, from the motors to the load."""
    loads: tuple[DeviceLoadRow, ...]
    """One per load that it takes."""
    motions: tuple[DeviceMotionRow, ...]
    """Its motion and, of the 12 steps, that with the first two axes swapped."""
    span: DeviceSpan
    """What it excites, what would excite more, and a better motion."""
    demands: DeviceDemands
    """What is demanded of it, with the largest stack of sensors."""
    recordings: tuple[DeviceRecordingRow, ...] = ()
    """Simulated recordings; none where nothing was written."""
    folder: str | None = None
    """Where all was written; None where nothing was."""
    figures: tuple[str, ...] = ()
    """Files of figures; none where none were drawn."""
    file: DeviceFile = Field(exclude=True, repr=False)
    """The device."""
    trajectories: dict[str, DeviceTrajectory] = Field(exclude=True, repr=False)
    """Motions by their names: those of `motions`, then those of `span`."""
    picture: DevicePicture = Field(exclude=True, repr=False)
    """What figures show."""

    def blocks(self) -> Iterator[Table | str]:
        """Give what people read.

        Yields:
            Tables and sentences.
        """
        yield f"{self.device} with {len(self.sensors)} sensor{'s' * (len(self.sensors) > 1)}: {', '.join(self.sensors)}"
        yield table_of(self.loads, f"loads: the largest in the motion, at {self.sensors[0]} and on the axes")
        yield table_of(self.motions, "motions")
        yield from self.span.blocks()
        yield from self.demands.blocks()
        if self.recordings:
            yield table_of(self.recordings, "simulated recordings")
        if self.folder is not None:
            yield f"everything is in {self.folder}"
        yield from (f"drawn to {figure}" for figure in self.figures)


def design_device(file: DeviceFile) -> DeviceDesign:
    """Check a calibration device by computation.

    Args:
        file: The device, how it moves, and what is simulated of it.

    Returns:
        What its loads do and how it moves.
    """
    trajectory, trajectories = _trajectory(file), _trajectories(file)
    loads = [device_load(file, load_kg) for load_kg in file.loads_kg]
    time, motion = trajectory.sampled(PICTURE_HZ)
    span = device_span(file)
    answers = [answer_of(file, load, motion) for load in loads]
    return DeviceDesign(
        device=file.name,
        sensors=file.sensor_names,
        loads=tuple(load_row(file, load, answer) for load, answer in zip(loads, answers, strict=True)),
        motions=tuple(motion_row(name, one, PICTURE_HZ) for name, one in trajectories.items()),
        span=span,
        demands=device_demands(file),
        file=file,
        trajectories=trajectories | span.trajectories,
        picture=DevicePicture(
            time_s=time,
            motion=motion,
            answer=answers[-1],
            clouds={
                name: answer_of(one.device, one.load, one.sampled(PICTURE_HZ)[1]).wrenches.of_name(file.sensor_names[0])
                for name, one in trajectories.items()
            },
        ),
    )


def _trajectories(file: DeviceFile) -> dict[str, DeviceTrajectory]:
    """The motion and, of the 12 steps, what they are with the axes swapped: other postures need not fit that."""
    motion = _trajectory(file)
    trajectories = {motion.sequence.name: motion}
    if file.motion.posture is None:
        trajectories[f"{motion.sequence.name}, {_SWAPPED}"] = _trajectory(file.changed(yaw_first=not file.yaw_first))
    return trajectories


def _trajectory(file: DeviceFile) -> DeviceTrajectory:
    """The motion with the heaviest load, which hangs where all others do."""
    load = device_load(file, file.loads_kg[-1])
    return DeviceTrajectory(device=file, load=load, sequence=file.sequence, hold_s=file.motion.hold_s)
