# SPDX-License-Identifier: BSD-3-Clause
"""An experiment from arrays, without a file: readings, joint positions and a robot are all that it needs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from numbers import Real
from pathlib import Path
from typing import Any, Literal, get_args

import numpy as np
import numpy.typing as npt

from forcetorque.app.python.experiment import Experiment
from forcetorque.base.arrays import FloatArray, IntArray, require_shape
from forcetorque.base.errors import ExperimentError, known_names
from forcetorque.base.toml_file import one_for_each
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.experiment.experiment import ExperimentSensor, FitOptions, Role
from forcetorque.recording.recording import Interval, Recording, Support, Use
from forcetorque.recording.stream import Signal, Stream
from forcetorque.robot.mechanics.samples import Processing
from forcetorque.robot.model import RobotModel
from forcetorque.robot.urdf import read_urdf

Span = tuple[float, float]
"""Start and end; s on the clock of the samples; the end is excluded."""
Spans = Span | Sequence[Span]
"""One span, or several that do not overlap."""
_Quantity = Literal["raw", "wrench"]
_READINGS, _JOINTS = "readings", "joints"
_KINDS = {Use.CALIBRATION: "calibrate", Use.VALIDATION: "judge"}
"""Arguments that spans come by, after which their intervals are called."""
_LATEST_S = 9.2e9
"""Seconds, which as nanoseconds fill 64 bits."""
_LONGEST_QUOTE = 60
"""Characters up to which spans are quoted as they came."""


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
    calibrate: Spans,
    judge: Spans | None = None,
    serial: str,
    prior: Any = None,
    full_scale: Any = None,
    limit_counts: float = 32767.0,
    quantity: _Quantity = "raw",
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
        calibrate: Span that is fitted, `(1.0, 59.0)`, or several, `[(1.0, 29.0), (31.0, 59.0)]`; s. Their intervals
            are called `calibrate`, or `calibrate 1` and so on.
        judge: Span that judges, or several, in the same way; none if left out.
        serial: Serial number of the sensor.
        prior: Matrix that it was calibrated with before; shape (6, c); N/count, N m/count; None where there is none.
        full_scale: Full scale of its components; shape (6,), or one number for all; N, N m.
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
    model = _robot(robot)
    if quantity not in get_args(_Quantity):
        raise ExperimentError(f"quantity: expected {' or '.join(map(repr, get_args(_Quantity)))}, got {quantity!r}")
    if not (isinstance(serial, str) and serial):
        raise ExperimentError(f"serial: expected the serial number as text, such as 'SN026', got {serial!r}")
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
        raise ExperimentError(
            f"support: the robot {model.name!r} has no link {support!r}; {known_names(support, model.links)}"
        )
    if not (isinstance(limit_counts, Real) and limit_counts > 0.0):
        raise ExperimentError(f"limit_counts: expected a positive number of counts, got {limit_counts!r}")
    ground = Support(frame=support, gravity_direction=_numbers(gravity_direction, "gravity_direction"))
    intervals = _intervals(calibrate, Use.CALIBRATION, ground)
    if judge is not None:
        intervals += _intervals(judge, Use.VALIDATION, ground)
    _require_apart(intervals)
    matrix = None if prior is None else _numbers(prior, "prior")
    if matrix is not None and not np.isfinite(matrix).all():
        raise ExperimentError("prior: expected a matrix of finite numbers, got NaN or infinity in it")
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
                full_scale=None if full_scale is None else _full_scale(full_scale),
            ),
        ),
        contacts=(),
        processing=Processing(),
        fit_options=FitOptions(),
        roles={interval.label: Role(kind=_KINDS[interval.use], session=None) for interval in intervals},
        supports=(ground,),
        inputs_sha256={},
    )


def _same(matrix: FloatArray | None, quantity: str) -> bool:
    """Whether the prior says nothing of the sensor: the reading itself takes the place of counts."""
    return matrix is not None and quantity == "wrench" and np.array_equal(matrix, np.eye(6))


def _robot(robot: RobotModel | Path | str) -> RobotModel:
    if isinstance(robot, RobotModel):
        return robot
    if not isinstance(robot, str | Path):
        raise ExperimentError(f"robot: expected a RobotModel or the path of a URDF file, got {_what(robot)}")
    if str(robot).lstrip().startswith("<"):
        raise ExperimentError("robot: expected the path of a URDF file, got its text; write that to a file first")
    return read_urdf(robot)


def _what(given: Any) -> str:
    """What came, in a few words however large it is."""
    shape = getattr(given, "shape", None)
    if shape is not None:
        return f"{type(given).__name__} of shape {shape}"
    return repr(given) if given is None or isinstance(given, str | int | float) else f"a {type(given).__name__}"


def _numbers(given: Any, name: str) -> FloatArray:
    """What is given as numbers, NaN where none is; text of numbers is taken for them, instants and complex are not."""
    try:
        array = _plain(given)
        if array.dtype.kind in "mMc":
            raise TypeError
        return array.astype(np.float64)
    except (TypeError, ValueError) as error:
        raise ExperimentError(f"{name}: expected numbers, got {_what(given)}") from error


def _plain(given: Any) -> npt.NDArray[Any]:
    """An array of numpy, whose NaN stands for what is masked and for what pandas knows to be missing."""
    if isinstance(given, np.ma.MaskedArray):
        return np.where(np.ma.getmaskarray(given), np.nan, given.data)
    array = np.asarray(given)
    if array.dtype == object and hasattr(given, "to_numpy"):  # of pandas, where numbers that may be missing are objects
        return np.asarray(given.to_numpy(dtype=np.float64, na_value=np.nan))
    return array


def _full_scale(given: Any) -> FloatArray:
    full_scale = _numbers(one_for_each(given, 6), "full_scale")
    require_shape(full_scale, name="full_scale", shape=(6,))
    if not (np.isfinite(full_scale) & (full_scale > 0.0)).all():
        raise ExperimentError(f"full_scale: expected six finite numbers above 0, N and N m, got {full_scale.tolist()}")
    return full_scale


def _intervals(given: Any, use: Use, ground: Support) -> list[Interval]:
    name = _KINDS[use]
    spans = _bounds_s(name, given)
    labels = [name] if len(spans) == 1 else [f"{name} {number}" for number in range(1, len(spans) + 1)]
    return [
        Interval(label=label, start_ns=round(start * 1e9), end_ns=round(end * 1e9), use=use, support=ground)
        for label, (start, end) in zip(labels, spans.tolist(), strict=True)
    ]


def _require_apart(intervals: Sequence[Interval]) -> None:
    """Refuse samples that would be fitted and judged, or fitted twice, in the words of a caller without a file."""
    for before, after in pairwise(sorted(intervals, key=lambda interval: interval.start_ns)):
        if after.start_ns < before.end_ns:
            arguments = " and ".join(dict.fromkeys(_KINDS[interval.use] for interval in (before, after)))
            raise ExperimentError(
                f"{arguments}: expected spans that do not overlap, got {before.label!r} to "
                f"{before.end_ns * 1e-9:g} s and {after.label!r} from {after.start_ns * 1e-9:g} s"
            )


def _bounds_s(name: str, given: Any) -> FloatArray:
    """Starts and ends; shape (k, 2)."""
    try:
        bounds = np.asarray(given, dtype=np.float64)
        if bounds.shape[-1:] != (2,) or bounds.ndim > 2 or not (bounds.size and (np.abs(bounds) < _LATEST_S).all()):
            raise ValueError
    except (TypeError, ValueError) as error:
        got = repr(given) if len(repr(given)) < _LONGEST_QUOTE else _what(given)
        raise ExperimentError(
            f"{name}: expected one span, start and end in s on the clock of time_s, such as (1.0, 59.0), or a list of "
            f"them, got {got}"
        ) from error
    return bounds.reshape(-1, 2)


def _stamps(time_s: Any, name: str) -> IntArray:
    try:
        time = _numbers(time_s, name)
    except ExperimentError as error:
        raise ExperimentError(
            f"{error}; give seconds: of dates t those are (t - t[0]) / numpy.timedelta64(1, 's'), one t[0] for all"
        ) from error
    require_shape(time, name=name, shape=(None,))
    if not np.isfinite(time).all() or (np.diff(time) <= 0.0).any():
        raise ExperimentError(f"{name}: expected finite instants that rise; sort the samples, drop repeated ones")
    if time.size and np.abs(time).max() > _LATEST_S:
        raise ExperimentError(f"{name}: expected seconds, got {time[-1]:.3g}; divide nanoseconds by 1e9")
    return np.round(time * 1e9).astype(np.int64)


def _reading_stream(model: RobotModel, sensor: str, stamps: IntArray, reading: Any, quantity: str) -> Stream:
    values = _numbers(reading, "reading")
    require_shape(values, name="reading", shape=(len(stamps), 6 if quantity == "wrench" else None))
    if quantity == "wrench":
        named = [str(column) for column in getattr(reading, "columns", WRENCH_COMPONENTS)]
        if sorted(named) == sorted(WRENCH_COMPONENTS) and named != list(WRENCH_COMPONENTS):
            raise ExperimentError(
                f"reading: expected the columns {', '.join(WRENCH_COMPONENTS)} in this order, got {', '.join(named)}"
            )
        frame = model.sensor(sensor).name
        signal = Signal(quantity="wrench", values=values, columns=WRENCH_COMPONENTS, units=WRENCH_UNITS, frame=frame)
    else:
        count = values.shape[1]
        columns = tuple(f"ch{k}" for k in range(count))
        signal = Signal(quantity="raw", values=values, columns=columns, units=("counts",) * count)
    return Stream(name=_READINGS, clock="arrays", stamp_ns=stamps, signals={quantity: signal})


def _joint_stream(model: RobotModel, stamps: IntArray, joints: Mapping[str, Any]) -> Stream:
    if not hasattr(joints, "keys"):  # a frame of pandas has them, and is no Mapping
        raise ExperimentError(
            f"joints: expected positions by name of the joint, a dictionary or a pandas frame, got {_what(joints)}"
        )
    names = tuple(str(joint) for joint in joints)
    absent = [joint for joint in names if joint not in model.joints]
    if absent or not names:
        raise ExperimentError(
            f"joints: expected names of joints of the robot {model.name!r}, got {', '.join(absent) or 'none'}"
        )
    positions = [_numbers(joints[joint], f"joints[{joint!r}]") for joint in joints]
    for joint, values in zip(names, positions, strict=True):
        require_shape(values, name=f"joints[{joint!r}]", shape=(len(stamps),))
    signal = Signal(
        quantity="position",
        values=np.column_stack(positions),
        columns=names,
        units=tuple(model.joints[joint].type.unit for joint in names),
    )
    return Stream(name=_JOINTS, clock="arrays", stamp_ns=stamps, signals={"position": signal})
