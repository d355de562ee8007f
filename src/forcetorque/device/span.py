# SPDX-License-Identifier: BSD-3-Clause
"""Whether a calibration device excites all six axes, what would help, and which motion informs most."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import RobotError
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.device.description import Device
from forcetorque.device.excitation import (
    Remedy,
    Run,
    least_excitation,
    remedies,
    swing_at_yaw_zero,
    uncertain,
    workbench_loads,
)
from forcetorque.device.expected_wrench import answer_of
from forcetorque.device.held_out import HELD_OUT_FORCE_N, HELD_OUT_MOMENT_NM, SAMPLES, held_out_loads, sample_noise
from forcetorque.device.motion import DeviceTrajectory
from forcetorque.device.motion_design import Designer
from forcetorque.device.tolerances import Tolerances
from forcetorque.results.table import FloatOrNull, Row, Shown, Table, table_of
from forcetorque.workbench.bench import Placement
from forcetorque.workbench.excitation import MatrixError, Span


class SensorSpanRow(Row):
    """What still poses of a motion excite in a sensor."""

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
    """What no pose has; empty where nothing is missing."""


class RemedyRow(Row):
    """What one way to excite a sensor is worth, against held-out loads."""

    motion: Annotated[str, Shown("motion")]
    """What it is called."""
    words: Annotated[str, Shown("what is done")]
    """What is done."""
    rank: Annotated[int, Shown("rank")]
    """Directions of load that are spanned."""
    smallest: Annotated[float, Shown("smallest", digits=4)]
    """Smallest singular value with the heaviest load, force and moment over their largest, over the root of n."""
    excitation: Annotated[float, Shown("least over bench", digits=3)]
    """Spread of the loads in the direction in which it is least against that of the 24 positions of the workbench."""
    force_N: Annotated[FloatOrNull, Shown("force error", "N", digits=3)]
    """Predicted root mean square error of a component of the force; without end where a direction is missing."""
    moment_Nm: Annotated[FloatOrNull, Shown("moment error", "N m", digits=4)]
    """The same of the moment."""


class DirectionRow(Row):
    """Predicted standard deviation of readings under a load along one axis: 100 N, or 5 N m."""

    motion: Annotated[str, Shown("motion")]
    """What the sensor was calibrated by."""
    error: Annotated[str, Shown("error of")]
    """Whether of the force in N or of the moment in N m, its largest component."""
    fx: Annotated[FloatOrNull, Shown("fx", digits=4)]
    """Under a load along fx; without end where nothing is known of it."""
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
    """A motion against another one of the same time."""

    motion: Annotated[str, Shown("motion")]
    """What it is called."""
    duration_s: Annotated[float, Shown("time", "s", digits=1)]
    """How long it takes."""
    volume: Annotated[float, Shown("log volume", digits=1)]
    """Logarithm of the determinant of the covariance of the matrix, which is lowered."""
    force_N: Annotated[float, Shown("force error", "N", digits=4)]
    """Predicted root mean square error of a component of the force."""
    moment_Nm: Annotated[float, Shown("moment error", "N m", digits=5)]
    """The same of the moment."""
    pitch_Nm: Annotated[float, Shown("pitch", "N m", digits=1)]
    """Largest torque of the motor of pitch."""
    yaw_Nm: Annotated[float, Shown("yaw", "N m", digits=1)]
    """Largest torque of the motor of yaw."""


def sensor_span_row(sensor: str, motion: str, poses: int, span: Span) -> SensorSpanRow:
    """Sum up what poses span.

    Args:
        sensor: Name of the sensor.
        motion: The motion.
        poses: How many.
        span: What they span.

    Returns:
        The row.
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
    """Give the error that is to be expected of held-out loads.

    Args:
        error: What is to be expected of the matrix.

    Returns:
        Root mean square over loads and axes, of force and of moment; N, N m.
    """
    force, moment = np.sqrt(np.array(error.mean_squares(held_out_loads())) / 3.0).tolist()
    return force, moment


def direction_rows(motion: str, error: MatrixError) -> tuple[DirectionRow, DirectionRow]:
    """Say how wrong readings under loads along one axis are.

    Args:
        motion: What the sensor was calibrated by.
        error: What is to be expected of the matrix.

    Returns:
        A row for the force, and one for the moment.
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
"""Load with which the device is held against the workbench, whose heaviest weight is the same; kg."""
PLACEMENTS = (
    Placement(angle_rad=np.deg2rad(0.2), position_m=1e-3),
    Placement(angle_rad=np.deg2rad(0.05), position_m=2e-4),
)
"""How exactly weights of the workbench are placed: as is usual, and as well as can be."""
_MOTION_HZ = 10.0


class DeviceSpan(Row):
    """What a device excites, remedies, and a better motion."""

    sensors: tuple[SensorSpanRow, ...]
    """What the 12 steps excite in every sensor, and what they do with a swing at yaw 0."""
    remedies: tuple[RemedyRow, ...]
    """What would help, for the innermost sensor."""
    directions: tuple[DirectionRow, ...]
    """Predicted errors in every direction of load, the workbench with its two placements among them."""
    motions: tuple[MotionRow, ...] = ()
    """The motion with the third lock and the optimised one; none where the device cannot do the first."""
    impossible: tuple[str, ...] = ()
    """Why remedies are left out that this device cannot do."""
    trajectories: dict[str, DeviceTrajectory] = Field(default_factory=dict, exclude=True, repr=False)
    """The motions by their names."""

    def blocks(self) -> Iterator[Table | str]:
        """Give what people read.

        Yields:
            Tables and sentences.
        """
        yield table_of(self.sensors, "what still poses excite")
        yield table_of(self.remedies, f"remedies: errors predicted with {COMPARED_KG:g} kg")
        yield table_of(self.directions, "predicted errors under 100 N or 5 N m along one axis")
        if self.motions:
            yield table_of(self.motions, "a better motion under the same speeds, ranges and time")
        yield from self.impossible
        yield _nearest(self.remedies)


def device_span(device: Device, *, tolerances: Tolerances | None = None, swaps: int = 1000) -> DeviceSpan:
    """Say what a device excites and what would excite more.

    Args:
        device: The device, pitch first, with locks at 0 and 90 degrees.
        tolerances: How exact it is; 0.1 degree, 0.1 mm and 0.05 % of mass if None.
        swaps: Changes that are tried of the optimised motion.

    Returns:
        Ranks, remedies, and motions.
    """
    device = device.changed(turn=None)  # it stays at 0, but where turning is the remedy
    exact = tolerances or Tolerances()
    compared = COMPARED_KG if COMPARED_KG in device.loads_kg else device.loads_kg[-1]
    heaviest = remedies(device, device.loads_kg[-1])
    possible, impossible = _possible(remedies(device, compared))
    bench = [workbench_loads(placement, SAMPLES) for placement in PLACEMENTS]
    sensor = device.sensor_names[0]
    rows: list[RemedyRow] = []
    directions: list[DirectionRow] = []
    for name, remedy in possible.items():
        loads = uncertain(remedy.sampled(SAMPLES), sensor, exact)
        error = loads.matrix_error(sample_noise())
        span = Span.of(np.concatenate([poses.wrench(sensor) for poses in heaviest[name].sampled(SAMPLES)]))
        force, moment = predicted_rms(error)
        rows.append(
            RemedyRow(
                motion=name,
                words=remedy.words,
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
        sensors=tuple(_sensor_rows(device, heaviest["12 steps"].runs[0])),
        remedies=tuple(rows),
        directions=tuple(directions),
        motions=tuple(motions),
        impossible=tuple(impossible),
        trajectories=trajectories,
    )


def better_motion(third: Run, sensor: str, *, swaps: int = 1000, tolerances: Tolerances | None = None) -> Run:
    """Find a motion that teaches more than one with a third lock, in the same time.

    Args:
        third: That motion.
        sensor: Sensor that is to be calibrated.
        swaps: Changes that are tried.
        tolerances: How exact the device is.

    Returns:
        The motion.
    """
    designer = Designer(
        device=third.device,
        load=third.load,
        sensor=sensor,
        seconds=third.trajectory.duration_s,
        hold_s=third.hold_s,
        swaps=swaps,
        tolerances=tolerances or Tolerances(),
    )
    best = designer.better_than(third.sequence.postures)
    return Run(device=third.device, load=third.load, sequence=best.sequence, hold_s=third.hold_s)


def _motions(
    possible: dict[str, Remedy], sensor: str, tolerances: Tolerances, swaps: int
) -> tuple[list[MotionRow], dict[str, DeviceTrajectory]]:
    if "third lock" not in possible:
        return [], {}
    third = possible["third lock"].runs[0]
    runs = {"third lock": third, "optimised": better_motion(third, sensor, swaps=swaps, tolerances=tolerances)}
    rows = []
    for name, run in runs.items():
        error = run.sampled(SAMPLES).uncertain(sensor, tolerances).matrix_error(sample_noise())
        force, moment = predicted_rms(error)
        answer = answer_of(run.device, run.load, run.trajectory.sampled(_MOTION_HZ)[1])
        peaks = [float(np.abs(answer.torque(joint)).max()) for joint in ("pitch", "yaw")]
        rows.append(
            MotionRow(
                motion=name,
                duration_s=run.trajectory.duration_s,
                volume=error.volume,
                force_N=force,
                moment_Nm=moment,
                pitch_Nm=peaks[0],
                yaw_Nm=peaks[1],
            )
        )
    return rows, {name: run.trajectory for name, run in runs.items()}


def _possible(every: dict[str, Remedy]) -> tuple[dict[str, Remedy], list[str]]:
    possible, impossible = {}, []
    for name, remedy in every.items():
        try:
            for run in remedy.runs:
                run.sequence.require_possible(run.device, run.load)
        except RobotError as error:
            impossible.append(f"{name}: left out, {error}")
        else:
            possible[name] = remedy
    return possible, impossible


def _sensor_rows(device: Device, run: Run) -> Iterator[SensorSpanRow]:
    encoded = device.changed(hinge=device.hinge.model_copy(update={"encoder": True}))
    swing = Run(device=encoded, load=run.load, sequence=swing_at_yaw_zero(encoded))
    for sensor in device.sensor_names:
        for name, motion in (("12 steps", run), ("and a swing at yaw 0", swing)):
            poses = motion.still_poses()
            yield sensor_span_row(sensor, name, len(poses.count), Span.of(poses.wrench(sensor)))


def _nearest(rows: tuple[RemedyRow, ...]) -> str:
    best = max(rows, key=lambda row: row.excitation)
    return (
        f"nearest to the excitation of the 24 positions of the workbench in every direction: {best.motion!r}, with "
        f"{best.excitation:.2f} of theirs in the direction in which it has least"
    )
