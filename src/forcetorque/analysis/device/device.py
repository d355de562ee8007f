# SPDX-License-Identifier: BSD-3-Clause
"""A calibration device by computation: what its loads do, how it moves, and what can be learnt with it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from pydantic import Field

from forcetorque.analysis.device.demands import DeviceDemands, device_demands
from forcetorque.analysis.device.rows import (
    DeviceLoadRow,
    DeviceMotionRow,
    DeviceRecordingRow,
    load_row,
    motion_row,
)
from forcetorque.analysis.device.span import DeviceSpan, device_span
from forcetorque.arrays import FloatArray
from forcetorque.exsitu.device import DeviceAnswer, DeviceFile, DeviceTrajectory, answer_of, device_load
from forcetorque.result import Result, Table, table_of
from forcetorque.robot import JointMotion

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
    answer: DeviceAnswer
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
