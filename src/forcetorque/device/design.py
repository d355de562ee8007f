# SPDX-License-Identifier: BSD-3-Clause
"""Analysis of a calibration device: its loads, motions, excitation and demands."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from forcetorque.device.components import AttachedLoad, Device, device_load
from forcetorque.device.demands import DeviceDemands, device_demands
from forcetorque.device.device_file import DeviceFile
from forcetorque.device.excitation_and_predicted_errors import DeviceSpan, device_span
from forcetorque.device.expected_wrench import DeviceResponse, device_response
from forcetorque.device.motion import DeviceTrajectory
from forcetorque.device.requirements import RequirementRow, Verdict
from forcetorque.results.answer import Answer, Concern, typed
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Row, Shown, Table, optional_table, table_of


class DeviceLoadRow(Row):
    """Wrenches and torques by a load in the motion of the device."""

    load: Annotated[str, Shown("load")]
    """Name of the load."""
    mass_kg: Annotated[float, Shown("mass", "kg", digits=2)]
    """Mass, carrier included."""
    centre_m: Annotated[float, Shown("from hinge", "m", digits=4)]
    """Distance of its centre of mass from the axis of the hinge."""
    force_N: Annotated[float, Shown("force", "N", digits=1)]
    """Largest force on the innermost sensor."""
    moment_Nm: Annotated[float, Shown("moment", "N m", digits=2)]
    """Largest moment on the innermost sensor."""
    pitch_Nm: Annotated[float, Shown("pitch", "N m", digits=2)]
    """Largest torque of the motor of pitch."""
    yaw_Nm: Annotated[float, Shown("yaw", "N m", digits=2)]
    """Largest torque of the motor of yaw."""
    hinge_Nm: Annotated[float, Shown("lock", "N m", digits=2)]
    """Largest torque on the lock of the hinge."""


class DeviceMotionRow(Row):
    """A motion of the device."""

    motion: Annotated[str, Shown("motion")]
    """Name of the motion."""
    order: Annotated[str, Shown("axes")]
    """Axes from the base on."""
    postures: Annotated[int, Shown("postures")]
    """Number of postures."""
    duration_s: Annotated[float, Shown("time", "s", digits=1)]
    """Duration."""
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
    """Use: calibration or validation."""
    seconds: Annotated[float, Shown("time", "s", digits=0)]
    """Duration."""
    samples: Annotated[int, Shown("samples")]
    """Samples of all sensors."""
    saturated: Annotated[int, Shown("saturated")]
    """Number of saturated samples."""


def _load_row(device: Device, load: AttachedLoad, response: DeviceResponse) -> DeviceLoadRow:
    wrench = response.wrenches.of_name(device.sensor_names[0])
    peaks = {joint: float(np.abs(response.torque(joint)).max()) for joint in ("pitch", "yaw", "hinge")}
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


def _motion_row(name: str, trajectory: DeviceTrajectory) -> DeviceMotionRow:
    device = trajectory.device
    _, motion = trajectory.sampled(PICTURE_HZ)
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
"""Rate at which motions are sampled and drawn."""
_SWAPPED = "axes swapped"
"""Suffix of the name of a motion with the first two axes swapped (figure 6.6)."""


class DeviceDesign(DrawnResult):
    """A calibration device, checked by computation."""

    drawn_by: ClassVar[str] = "forcetorque.device.figures:requirement_figure"

    schema_name: Literal["forcetorque/device/2"] = Field(default="forcetorque/device/2", alias="schema")
    """Form of the result."""
    device: str
    """Name of the device."""
    sensors: tuple[str, ...]
    """Sensors in the stack, from the motors to the load."""
    loads: tuple[DeviceLoadRow, ...]
    """One per load that it takes."""
    motions: tuple[DeviceMotionRow, ...]
    """Its motion and, of the 12 steps, the one with the first two axes swapped."""
    span: DeviceSpan
    """Its excitation, options to improve it, and an optimised motion."""
    demands: DeviceDemands
    """Demands on it, with the largest stack of sensors."""
    recordings: tuple[DeviceRecordingRow, ...] = ()
    """Simulated recordings; none where nothing was written."""
    folder: str | None = None
    """Folder of all files; None where nothing was written."""
    figures: tuple[str, ...] = ()
    """Files of figures; none where none were drawn."""
    file: DeviceFile = Field(exclude=True, repr=False)
    """The device."""
    trajectories: dict[str, DeviceTrajectory] = Field(exclude=True, repr=False)
    """Motions by name: those of `motions`, then those of `span`."""

    def answers(self) -> Iterator[Answer]:
        """Give the answer: how many requirements are met, which are not, and what the first sensor is excited in.

        Yields:
            One answer.
        """
        rows = self.demands.requirements
        met = [row for row in rows if row.verdict is Verdict.MET]
        failed = [row for row in rows if row.verdict is Verdict.NOT_MET]
        first = next((row for row in self.span.sensors if row.sensor == self.sensors[0]), None)
        missing = "" if first is None or not first.missing else f", not {first.missing}"
        excited = (
            ()
            if first is None
            else (f"{first.motion} excites {first.rank} of 6 directions of {first.sensor}{missing}",)
        )
        calibrated = [row.experiment for row in self.recordings if row.use == "calibration"]
        yield Answer(
            subject=f"{self.device} with {len(self.sensors)} sensor{'s' * (len(self.sensors) > 1)}",
            verdict=f"MEETS {len(met)} OF {len(met) + len(failed)} REQUIREMENTS",
            why=(
                f"not met: {'; '.join(_requirement(row) for row in failed) or 'none'}; "
                f"{len(rows) - len(met) - len(failed)} of {len(rows)} not computed",
                *excited,
            ),
            step="calibrate with the simulated recordings"
            if calibrated
            else "write URDF and logs by the same command with --output FOLDER",
            command=typed("inspect", calibrated[0]) if calibrated else "",
            written=(self.folder, *self.figures, self.figure_file),
            concern=Concern.BAD if failed else Concern.NONE,
        )

    def blocks(self) -> Iterator[Table | str]:
        """Make the text for the terminal.

        Yields:
            Tables and messages.
        """
        yield f"{self.device} with {len(self.sensors)} sensor{'s' * (len(self.sensors) > 1)}: {', '.join(self.sensors)}"
        yield table_of(self.loads, f"loads: the largest in the motion, at {self.sensors[0]} and on the axes")
        yield table_of(self.motions, "motions")
        yield from self.span.blocks()
        yield from self.demands.blocks()
        yield from optional_table(self.recordings, "simulated recordings")
        if self.folder is not None:
            yield f"all files are in {self.folder}"
        yield from (f"drawn to {figure}" for figure in self.figures)


def _requirement(row: RequirementRow) -> str:
    if row.value is None or row.limit is None:
        return f"{row.number} {row.requirement}"
    return f"{row.number} {row.requirement}, {row.value:.3g} of {row.limit:.3g} {row.unit}"


def design_device(file: DeviceFile) -> DeviceDesign:
    """Analyse a calibration device.

    Args:
        file: The device, its motion, and its simulation.

    Returns:
        Loads, motions, excitation and demands.
    """
    trajectory, trajectories = _trajectory(file), _trajectories(file)
    loads = [device_load(file, load_kg) for load_kg in file.loads_kg]
    _, motion = trajectory.sampled(PICTURE_HZ)
    span = device_span(file)
    return DeviceDesign(
        device=file.name,
        sensors=file.sensor_names,
        loads=tuple(_load_row(file, load, device_response(file, load, motion)) for load in loads),
        motions=tuple(_motion_row(name, other) for name, other in trajectories.items()),
        span=span,
        demands=device_demands(file),
        file=file,
        trajectories=trajectories | span.trajectories,
    )


def _trajectories(file: DeviceFile) -> dict[str, DeviceTrajectory]:
    """The motion and, of the 12 steps, the one with the axes swapped, which other postures may not allow."""
    motion = _trajectory(file)
    trajectories = {motion.sequence.name: motion}
    if file.motion.posture is None:
        trajectories[f"{motion.sequence.name}, {_SWAPPED}"] = _trajectory(file.changed(yaw_first=not file.yaw_first))
    return trajectories


def _trajectory(file: DeviceFile) -> DeviceTrajectory:
    """The motion with the heaviest load, which hangs like all others."""
    load = device_load(file, file.loads_kg[-1])
    return DeviceTrajectory(device=file, load=load, sequence=file.sequence, hold_s=file.motion.hold_s)
