# SPDX-License-Identifier: BSD-3-Clause
"""An experiment from arrays, without a file: readings, joint positions and a robot are all that it needs."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal

import numpy as np

from forcetorque.arrays import FloatArray, IntArray, require_shape
from forcetorque.errors import ExperimentError
from forcetorque.estimation import Processing
from forcetorque.experiment.content import ExperimentSensor, FitOptions, Role
from forcetorque.interactive.experiment import Experiment
from forcetorque.recording import Interval, Recording, Signal, Stream, Support, Use
from forcetorque.robot import RobotModel, read_urdf
from forcetorque.spatial import WRENCH_COMPONENTS, WRENCH_UNITS

Span = tuple[float, float]
"""Start and end; s on the clock of the samples; the end is excluded."""
_READINGS, _JOINTS = "readings", "joints"


def experiment_of_arrays(
    robot: RobotModel | Path | str,
    sensor: str,
    *,
    time_s: Any,
    reading: Any,
    joints: Mapping[str, Any],
    joint_time_s: Any = None,
    support: str,
    gravity_direction: Any,
    calibrate: Span,
    judge: Span | None = None,
    serial: str,
    prior: Any = None,
    full_scale: Any = None,
    limit_counts: float = 32767.0,
    quantity: Literal["raw", "wrench"] = "raw",
    name: str = "arrays",
) -> Experiment:
    """Make an experiment of one sensor from arrays.

    Args:
        robot: Robot, or its URDF file; `RobotModel.with_sensor` declares a sensor that has no tag.
        sensor: Name of the sensor in it.
        time_s: Instants of the samples, rising; shape (n,); s.
        reading: What the sensor logged; shape (n, c) in counts, or (n, 6) in N and N m for the quantity `wrench`.
        joints: Positions by name of the joint, shape (m,) each, rad or m: a dictionary or a pandas frame.
        joint_time_s: Instants of the positions on the same clock, rising; shape (m,); s; those of the readings if left
            out.
        support: Link that stands still and is the only one to touch the world.
        gravity_direction: Direction in which things fall, in the axes of that link; shape (3,).
        calibrate: Span that is fitted.
        judge: Span that judges; none if left out.
        serial: Serial number of the sensor.
        prior: Matrix that it was calibrated with before; shape (6, c); N/count, N m/count; None where there is none.
        full_scale: Full scale of its components; shape (6,); N, N m.
        limit_counts: Largest magnitude of a raw reading, at which it saturates; counts; that of 16 bits if left out.
        quantity: Whether the reading is `raw` or a calibrated `wrench`, which needs the prior that made it, or
            `numpy.eye(6)` with `full_scale` where that is not known.
        name: Name of the experiment.

    Returns:
        The experiment: `experiment[sensor].calibrate()` and so on.

    Raises:
        ExperimentError: If joints, frames or spans do not fit each other.
        ShapeError: If the shapes are not these.
    """
    model = robot if isinstance(robot, RobotModel) else read_urdf(robot)
    stamps = _stamps(time_s, "time_s")
    joint_stamps = stamps if joint_time_s is None else _stamps(joint_time_s, "joint_time_s")
    recording = Recording(
        streams={
            _READINGS: _reading_stream(model, sensor, stamps, reading, quantity),
            _JOINTS: _joint_stream(model, joint_stamps, joints),
        }
    )
    if quantity == "wrench" and prior is None:
        raise ExperimentError("reading: a calibrated wrench needs the prior that made it, or numpy.eye(6); got none")
    if support not in model.links:
        raise ExperimentError(f"support: the robot {model.name!r} has no link {support!r}")
    if not limit_counts > 0.0:
        raise ExperimentError(f"limit_counts: expected a positive number of counts, got {limit_counts!r}")
    ground = Support(frame=support, gravity_direction=gravity_direction)
    spans = [("calibrate", calibrate, Use.CALIBRATION), ("judge", judge, Use.VALIDATION)]
    intervals = [
        Interval(label=label, start_ns=_ns(span[0]), end_ns=_ns(span[1]), use=use, support=ground)
        for label, span, use in spans
        if span is not None
    ]
    matrix = None if prior is None else np.asarray(prior, dtype=np.float64)
    known = _same(matrix, quantity)
    return Experiment(
        name=name,
        file=Path(name),
        model=model,
        recording=recording.with_intervals(intervals),
        sensors=(
            ExperimentSensor(
                name=model.sensor(sensor).name,
                serial=serial,
                stream=_READINGS,
                quantity=quantity,
                prior=matrix,
                prior_source=None if matrix is None else "identity" if known else "given as an array",
                limit_counts=limit_counts,
                full_scale=None if full_scale is None else np.asarray(full_scale, dtype=np.float64),
            ),
        ),
        contacts=(),
        length_scale=None,
        processing=Processing(),
        regularisation=None,
        fit_options=FitOptions(),
        sphere_intervals=None,
        roles={interval.label: Role(kind=interval.label, session=None) for interval in intervals},
        supports=(ground,),
        inputs_sha256={},
    )


def _same(matrix: FloatArray | None, quantity: str) -> bool:
    """Whether the prior says nothing of the sensor: the reading itself takes the place of counts."""
    return matrix is not None and quantity == "wrench" and np.array_equal(matrix, np.eye(6))


def _ns(seconds: float) -> int:
    return round(seconds * 1e9)


def _stamps(time_s: Any, name: str) -> IntArray:
    time = np.asarray(time_s, dtype=np.float64)
    require_shape(time, name=name, shape=(None,))
    if not np.isfinite(time).all() or (np.diff(time) <= 0.0).any():
        raise ExperimentError(f"{name}: expected finite instants that rise; sort the samples, drop repeated ones")
    return np.round(time * 1e9).astype(np.int64)


def _reading_stream(model: RobotModel, sensor: str, stamps: IntArray, reading: Any, quantity: str) -> Stream:
    values = np.asarray(reading, dtype=np.float64)
    require_shape(values, name="reading", shape=(len(stamps), 6 if quantity == "wrench" else None))
    if quantity == "wrench":
        frame = model.sensor(sensor).name
        signal = Signal(quantity="wrench", values=values, columns=WRENCH_COMPONENTS, units=WRENCH_UNITS, frame=frame)
    else:
        count = values.shape[1]
        columns = tuple(f"ch{k}" for k in range(count))
        signal = Signal(quantity="raw", values=values, columns=columns, units=("counts",) * count)
    return Stream(name=_READINGS, clock="arrays", stamp_ns=stamps, signals={quantity: signal})


def _joint_stream(model: RobotModel, stamps: IntArray, joints: Mapping[str, Any]) -> Stream:
    names = tuple(str(joint) for joint in joints)
    absent = [joint for joint in names if joint not in model.joints]
    if absent or not names:
        raise ExperimentError(
            f"joints: expected names of joints of the robot {model.name!r}, got {', '.join(absent) or 'none'}"
        )
    for joint in names:
        require_shape(np.asarray(joints[joint], dtype=np.float64), name=f"joints[{joint!r}]", shape=(len(stamps),))
    signal = Signal(
        quantity="position",
        values=np.column_stack([np.asarray(joints[joint], dtype=np.float64) for joint in names]),
        columns=names,
        units=tuple(model.joints[joint].type.unit for joint in names),
    )
    return Stream(name=_JOINTS, clock="arrays", stamp_ns=stamps, signals={"position": signal})
