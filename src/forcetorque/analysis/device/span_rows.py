# SPDX-License-Identifier: BSD-3-Clause
"""Rows of what a calibration device excites: rank and missing direction, remedies, and errors in every direction."""

from __future__ import annotations

from typing import Annotated

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.exsitu.device import HELD_OUT_FORCE_N, HELD_OUT_MOMENT_NM, held_out_loads
from forcetorque.exsitu.span import Span
from forcetorque.exsitu.uncertain_loads import MatrixError
from forcetorque.result import FloatOrNull, Row, Shown
from forcetorque.spatial import WRENCH_COMPONENTS


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
        missing="; ".join(line.words for line in span.missing),
    )


def predicted_rms(error: MatrixError) -> tuple[float, float]:
    """Give the error that is to be expected of held-out loads.

    Args:
        error: What is to be expected of the matrix.

    Returns:
        Root mean square over loads and axes, of force and of moment; N, N m.
    """
    force, moment = np.sqrt(np.array(error.trace(held_out_loads())) / 3.0).tolist()
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
