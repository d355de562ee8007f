# SPDX-License-Identifier: BSD-3-Clause
"""Excitation of all six axes by a calibration device, options to improve it, and an optimised motion."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Annotated

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import RobotError
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.device.components import Device
from forcetorque.device.excitation_options import (
    HELD_OUT_FORCE_N,
    HELD_OUT_MOMENT_NM,
    SAMPLES,
    ExcitationOption,
    excitation_options,
    held_out_loads,
    least_excitation,
    sample_noise,
    sampled_poses,
    still_poses,
    swing_at_yaw_zero,
    workbench_loads,
)
from forcetorque.device.expected_wrench import device_response
from forcetorque.device.motion import DeviceTrajectory
from forcetorque.device.optimised_motion import Designer
from forcetorque.device.tolerances import Tolerances, joined_loads
from forcetorque.results.table import FloatOrNull, Row, Shown, Table, optional_table, table_of
from forcetorque.workbench.excitation import MatrixError, Span
from forcetorque.workbench.position_means import Placement


class SensorSpanRow(Row):
    """Excitation of a sensor by static poses of a motion."""

    sensor: Annotated[str, Shown("sensor")]
    """Name of the sensor."""
    motion: Annotated[str, Shown("motion")]
    """The motion."""
    poses: Annotated[int, Shown("poses")]
    """Poses at rest."""
    rank: Annotated[int, Shown("rank")]
    """Directions of load that are spanned, to a share of 1e-9."""
    smallest: Annotated[float, Shown("smallest", digits=3)]
    """Smallest singular value that is not zero, of force and moment over their largest, over the root of n."""
    missing: Annotated[str, Shown("missing")]
    """Moments that no pose excites; empty where all are excited."""


class OptionRow(Row):
    """Excitation by one option, and predicted errors at held-out loads."""

    motion: Annotated[str, Shown("motion")]
    """Name of the option."""
    description: Annotated[str, Shown("change")]
    """What changes, as text."""
    rank: Annotated[int, Shown("rank")]
    """Directions of load that are spanned."""
    smallest: Annotated[float, Shown("smallest", digits=4)]
    """Smallest singular value with the heaviest load, force and moment over their largest, over the root of n."""
    excitation: Annotated[float, Shown("least over bench", digits=3)]
    """Least ratio, over all directions, of the standard deviations of these loads and those of the workbench."""
    force_N: Annotated[FloatOrNull, Shown("force error", "N", digits=3)]
    """Predicted root mean square error of a component of the force; infinite where a direction is not excited."""
    moment_Nm: Annotated[FloatOrNull, Shown("moment error", "N m", digits=4)]
    """The same of the moment."""


class DirectionRow(Row):
    """Predicted standard deviation of measurements of a load along one axis: 100 N, or 5 N m."""

    motion: Annotated[str, Shown("motion")]
    """Motion, or workbench, of the calibration."""
    error: Annotated[str, Shown("error of")]
    """Whether of the force in N or of the moment in N m, its largest component."""
    fx: Annotated[FloatOrNull, Shown("fx", digits=4)]
    """Under a load along fx; infinite where it is undetermined."""
    fy: Annotated[FloatOrNull, Shown("fy", digits=4)]
    """Under a load along fy."""
    fz: Annotated[FloatOrNull, Shown("fz", digits=4)]
    """Under a load along fz."""
    tx: Annotated[FloatOrNull, Shown("tx", digits=4)]
    """Under a load along tx."""
    ty: Annotated[FloatOrNull, Shown("ty", digits=4)]
    """Under a load along ty."""
    tz: Annotated[FloatOrNull, Shown("tz", digits=4)]
    """Under a load along tz."""


class MotionRow(Row):
    """A motion of the comparison, all of one duration."""

    motion: Annotated[str, Shown("motion")]
    """Name of the motion."""
    duration_s: Annotated[float, Shown("time", "s", digits=1)]
    """Duration."""
    volume: Annotated[float, Shown("log volume", digits=1)]
    """Logarithm of the determinant of the covariance of the matrix, which the optimisation lowers."""
    force_N: Annotated[float, Shown("force error", "N", digits=4)]
    """Predicted root mean square error of a component of the force."""
    moment_Nm: Annotated[float, Shown("moment error", "N m", digits=5)]
    """The same of the moment."""
    pitch_Nm: Annotated[float, Shown("pitch", "N m", digits=1)]
    """Largest torque of the motor of pitch."""
    yaw_Nm: Annotated[float, Shown("yaw", "N m", digits=1)]
    """Largest torque of the motor of yaw."""


def sensor_span_row(sensor: str, motion: str, poses: int, span: Span) -> SensorSpanRow:
    """Make the record of the span of poses.

    Args:
        sensor: Name of the sensor.
        motion: Name of the motion.
        poses: Number of poses.
        span: Span of their loads.

    Returns:
        The record.
    """
    return SensorSpanRow(
        sensor=sensor,
        motion=motion,
        poses=poses,
        rank=span.rank,
        smallest=float(span.strengths[span.rank - 1]),
        missing="; ".join(line.text for line in span.missing),
    )


def predicted_rms(error: MatrixError) -> tuple[float, float]:
    """Predict the error at held-out loads.

    Returns:
        Root mean square over loads and axes, of force and of moment; N, N m.
    """
    force, moment = np.sqrt(np.array(error.mean_squares(held_out_loads())) / 3.0).tolist()
    return force, moment


def direction_rows(motion: str, error: MatrixError) -> tuple[DirectionRow, DirectionRow]:
    """Predict the error of measurements of loads along one axis.

    Args:
        motion: Motion, or workbench, of the calibration.
        error: Error of the matrix.

    Returns:
        A record for the force, and one for the moment.
    """
    along = error.error(np.diag(np.repeat([HELD_OUT_FORCE_N, HELD_OUT_MOMENT_NM], 3)))
    return (
        _direction_row(motion, "force, N", along[:, :3]),
        _direction_row(motion, "moment, N m", along[:, 3:]),
    )


def _direction_row(motion: str, error: str, along: FloatArray) -> DirectionRow:
    worst = dict(zip(WRENCH_COMPONENTS, along.max(axis=1).tolist(), strict=True))
    return DirectionRow(motion=motion, error=error, **worst)


COMPARED_KG = 25.0
"""Load with which the device is compared with the workbench, whose heaviest weight is the same; kg."""
PLACEMENTS = (
    Placement(angle_rad=np.deg2rad(0.2), position_m=1e-3),
    Placement(angle_rad=np.deg2rad(0.05), position_m=2e-4),
)
"""Placement of weights of the workbench: usual, and as accurate as possible."""
_MOTION_HZ = 10.0


class DeviceSpan(Row):
    """Excitation by a device, options to improve it, and an optimised motion."""

    sensors: tuple[SensorSpanRow, ...]
    """Excitation of every sensor by the 12 steps, without and with a swing at yaw 0."""
    options: tuple[OptionRow, ...]
    """Options to excite more, for the innermost sensor."""
    directions: tuple[DirectionRow, ...]
    """Predicted errors in every direction of load, the workbench with its two placements among them."""
    motions: tuple[MotionRow, ...] = ()
    """The motion with the third lock and the optimised one; none where the device cannot do the first."""
    impossible: tuple[str, ...] = ()
    """Rejection reasons of options that this device cannot do."""
    trajectories: dict[str, DeviceTrajectory] = Field(default_factory=dict, exclude=True, repr=False)
    """The motions by name."""

    def blocks(self) -> Iterator[Table | str]:
        """Make the text for the terminal.

        Yields:
            Tables and messages.
        """
        yield table_of(self.sensors, "excitation by static poses")
        yield table_of(self.options, f"excitation options: errors predicted with {COMPARED_KG:g} kg")
        yield table_of(self.directions, "predicted errors under 100 N or 5 N m along one axis")
        yield from optional_table(self.motions, "an optimised motion under the same speeds, ranges and time")
        yield from self.impossible
        yield _nearest(self.options)


def device_span(device: Device, *, tolerances: Tolerances | None = None, swaps: int = 1000) -> DeviceSpan:
    """Compute the excitation by a device, options to improve it, and an optimised motion.

    Args:
        device: The device, pitch first, with locks at 0 and 90 degrees.
        tolerances: Its tolerances; 0.1 degree, 0.1 mm and 0.05 % of mass if None.
        swaps: Number of changes that the optimisation tries.

    Returns:
        Ranks, options, and motions.
    """
    device = device.changed(turn=None)  # it stays at 0, except in the option that turns the load
    exact = tolerances or Tolerances()
    compared = COMPARED_KG if COMPARED_KG in device.loads_kg else device.loads_kg[-1]
    heaviest = excitation_options(device, device.loads_kg[-1])
    possible, impossible = _possible(excitation_options(device, compared))
    bench = [workbench_loads(placement, SAMPLES) for placement in PLACEMENTS]
    sensor = device.sensor_names[0]
    rows: list[OptionRow] = []
    directions: list[DirectionRow] = []
    for name, option in possible.items():
        loads = joined_loads(option.sampled(SAMPLES), sensor, exact)
        error = loads.matrix_error(sample_noise())
        span = Span.of(np.concatenate([poses.wrench(sensor) for poses in heaviest[name].sampled(SAMPLES)]))
        force, moment = predicted_rms(error)
        rows.append(
            OptionRow(
                motion=name,
                description=option.description,
                rank=span.rank,
                smallest=span.least_strength if span.rank == 6 else 0.0,
                excitation=least_excitation(loads, bench[0]),
                force_N=force,
                moment_Nm=moment,
            )
        )
        directions += direction_rows(name, error)
    for placement, loads in zip(PLACEMENTS, bench, strict=True):
        name = f"workbench, {np.rad2deg(placement.angle_rad):g} deg and {1e3 * placement.position_m:g} mm"
        directions += direction_rows(name, loads.matrix_error(sample_noise()))
    motions, trajectories = _motions(possible, sensor, exact, swaps)
    return DeviceSpan(
        sensors=tuple(_sensor_rows(device, heaviest["12 steps"].trajectories[0])),
        options=tuple(rows),
        directions=tuple(directions),
        motions=tuple(motions),
        impossible=tuple(impossible),
        trajectories=trajectories,
    )


def optimised_motion(
    third: DeviceTrajectory, sensor: str, *, swaps: int = 1000, tolerances: Tolerances | None = None
) -> DeviceTrajectory:
    """Optimise a motion of the same duration as one with a third lock.

    Args:
        third: The motion with a third lock.
        sensor: Sensor to calibrate.
        swaps: Number of changes that the optimisation tries.
        tolerances: Tolerances of the device.

    Returns:
        The motion.
    """
    designer = Designer(
        device=third.device,
        load=third.load,
        sensor=sensor,
        seconds=third.duration_s,
        hold_s=third.hold_s,
        swaps=swaps,
        tolerances=tolerances or Tolerances(),
    )
    best = designer.improve(third.sequence.postures)
    return replace(third, sequence=best.sequence)


def _motions(
    possible: dict[str, ExcitationOption], sensor: str, tolerances: Tolerances, swaps: int
) -> tuple[list[MotionRow], dict[str, DeviceTrajectory]]:
    if "third lock" not in possible:
        return [], {}
    third = possible["third lock"].trajectories[0]
    optimised = optimised_motion(third, sensor, swaps=swaps, tolerances=tolerances)
    trajectories = {"third lock": third, "optimised": optimised}
    rows = []
    for name, trajectory in trajectories.items():
        error = sampled_poses(trajectory, SAMPLES).uncertain(sensor, tolerances).matrix_error(sample_noise())
        force, moment = predicted_rms(error)
        _, motion = trajectory.sampled(_MOTION_HZ)
        response = device_response(trajectory.device, trajectory.load, motion)
        peaks = [float(np.abs(response.torque(joint)).max()) for joint in ("pitch", "yaw")]
        rows.append(
            MotionRow(
                motion=name,
                duration_s=trajectory.duration_s,
                volume=error.volume,
                force_N=force,
                moment_Nm=moment,
                pitch_Nm=peaks[0],
                yaw_Nm=peaks[1],
            )
        )
    return rows, trajectories


def _possible(options: dict[str, ExcitationOption]) -> tuple[dict[str, ExcitationOption], list[str]]:
    """The options that the device can do, and rejection reasons of the others."""
    possible, impossible = {}, []
    for name, option in options.items():
        try:
            for trajectory in option.trajectories:
                trajectory.sequence.require_possible(trajectory.device, trajectory.load)
        except RobotError as error:
            impossible.append(f"{name}: left out, {error}")
        else:
            possible[name] = option
    return possible, impossible


def _sensor_rows(device: Device, twelve: DeviceTrajectory) -> Iterator[SensorSpanRow]:
    encoded = device.changed(hinge=device.hinge.model_copy(update={"encoder": True}))
    swing = DeviceTrajectory(device=encoded, load=twelve.load, sequence=swing_at_yaw_zero(encoded))
    for sensor in device.sensor_names:
        for name, motion in (("12 steps", twelve), ("and a swing at yaw 0", swing)):
            poses = still_poses(motion)
            yield sensor_span_row(sensor, name, len(poses.count), Span.of(poses.wrench(sensor)))


def _nearest(rows: tuple[OptionRow, ...]) -> str:
    best = max(rows, key=lambda row: row.excitation)
    return (
        f"nearest to the excitation of the 24 positions of the workbench: {best.motion!r}, with at least "
        f"{best.excitation:.2f} of theirs in every direction"
    )
