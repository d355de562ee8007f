# SPDX-License-Identifier: BSD-3-Clause
"""Experiments and motions from arrays, without a file: readings, joint positions and a robot are all that it needs."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import wraps
from inspect import signature
from itertools import pairwise
from numbers import Real
from pathlib import Path
from typing import Any, Literal, ParamSpec, get_args

import numpy as np

from forcetorque.app.python.experiment import Experiment
from forcetorque.app.python.experiment_of_tables import brief, experiment_of_tables, numbers, stream_of_arrays
from forcetorque.base.arrays import FloatArray, require_shape
from forcetorque.base.errors import ExperimentError, require_known
from forcetorque.base.toml_file import one_for_each
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.locomotion.motion_quality import BAND_SHARE, Motion
from forcetorque.robot.installed_robots import urdf_file
from forcetorque.robot.model import RobotModel
from forcetorque.robot.urdf import read_urdf

Span = tuple[float, float]
"""Start and end; s on the clock of the samples; the end is excluded."""
Spans = Span | Sequence[Span]
"""One span, or several that do not overlap."""
_Quantity = Literal["raw", "wrench"]
_READINGS, _JOINTS = "readings", "joints"
_USES = {"calibrate": "calibration", "validate": "validation"}
"""Uses of spans by the arguments that they come by, after which their intervals are called."""
_LATEST_S = 9.2e9
"""Seconds, which as nanoseconds fill 64 bits."""
_LEAST_SHARE = 0.005
"""Share of the limit that counts reach: fractions that stay below are newtons. Heuristic."""
_MOST_WHOLE_N = 1000.0
"""Largest magnitude of a reading in whole newtons: larger whole numbers are counts. Heuristic."""
_LONGEST_QUOTE = 60
"""Characters up to which spans are quoted as they came."""


_NEEDED = {
    "robot": "RobotModel, or path of its URDF file",
    "sensor": "its name in the robot",
    "time_s": "instants of the reading, shape (n,), s",
    "reading": 'shape (n, c), counts; or (n, 6), N and N m, with quantity="wrench"',
    "joints": "positions by name of the joint, shape (m,), rad or m",
    "support": "name of the link that stands still",
    "gravity_direction": "where things fall, in the axes of the support, shape (3,)",
    "calibrate": "span to fit, start and end, s",
    "serial": "serial number, text",
}
"""Arguments without a default, and what they are, for the error that names all that are missing."""
_Parameters = ParamSpec("_Parameters")


def _all_missing_at_once(make: Callable[_Parameters, Experiment]) -> Callable[_Parameters, Experiment]:
    """Name all missing arguments in one error."""

    @wraps(make)
    def made(*args: _Parameters.args, **named: _Parameters.kwargs) -> Experiment:
        given = {*signature(make).bind_partial(*args, **named).arguments}
        missing = [f"{name} ({words})" for name, words in _NEEDED.items() if name not in given]
        if missing:
            raise ExperimentError(f"experiment_of_arrays: expected also {', '.join(missing)}")
        return make(*args, **named)

    return made


@_all_missing_at_once
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
    validate: Spans | None = None,
    serial: str,
    prior: Any = None,
    full_scale: Any = None,
    limit_counts: float = 32767.0,
    quantity: _Quantity = "raw",
    tolerance: Mapping[str, float] | Literal["exact"] | None = None,
    name: str = "arrays",
) -> Experiment:
    """Make an experiment of one sensor from arrays.

    `experiment_of_tables` takes several sensors, loads, an IMU, contacts, sessions, load cases and accuracy.

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
        validate: Span that validates, or several, in the same way; none if left out.
        serial: Serial number of the sensor.
        prior: Matrix that it was calibrated with before; shape (6, c); N/count, N m/count; None where there is none.
        full_scale: Full scale of its components; shape (6,), or one number for all; N, N m.
        limit_counts: Largest magnitude of a raw reading, at which it saturates; counts; that of 16 bits if left out.
        quantity: Whether the reading is `raw` or a calibrated `wrench`, which needs the prior that made it, or
            `numpy.eye(6)` with `full_scale` where that is not known.
        tolerance: How far the robot model may be from the robot, such as `{"mass_relative": 0.03}`, with the keys of
            `tolerance` of `[robot]` in an experiment file, and their defaults; "exact" for a simulated robot.
        name: Name of the experiment.

    Returns:
        The experiment: `experiment[sensor].calibrate()` and so on.

    Raises:
        ExperimentError: If arguments are missing, joints, frames or spans do not fit each other, or a reading in counts
            has the magnitude of one in N, or the other way round.
        ShapeError: If the shapes are not these.
    """
    model = _robot(robot)
    if quantity not in get_args(_Quantity):
        raise ExperimentError(f"quantity: expected {' or '.join(map(repr, get_args(_Quantity)))}, got {quantity!r}")
    if not (isinstance(serial, str) and serial):
        raise ExperimentError(f"serial: expected the serial number as text, such as 'SN026', got {serial!r}")
    time = _instants(time_s, "time_s")
    joint_time = time if joint_time_s is None else _instants(joint_time_s, "joint_time_s")
    streams = [
        _reading_table(model.sensor(sensor).name, time, reading, quantity),
        _joint_table(model, joint_time, joints),
    ]
    if quantity == "wrench" and prior is None:
        raise ExperimentError("reading: a calibrated wrench needs the prior that made it, or numpy.eye(6); got none")
    require_known(support, model.links, ExperimentError, f"support: the robot {model.name!r} has no link {support!r}")
    if not (isinstance(limit_counts, Real) and limit_counts > 0.0):
        raise ExperimentError(f"limit_counts: expected a positive number of counts, got {limit_counts!r}")
    _require_magnitude(streams[0]["signal"][0]["variable"], quantity, limit_counts)
    spans = {"calibrate": calibrate} if validate is None else {"calibrate": calibrate, "validate": validate}
    intervals = [interval for kind, given in spans.items() for interval in _intervals(kind, given)]
    _require_apart(intervals)
    matrix = None if prior is None else numbers(prior, "prior")
    if matrix is not None and not np.isfinite(matrix).all():
        raise ExperimentError("prior: expected a matrix of finite numbers, got NaN or infinity in it")
    earliest_s = float(min([*time[:1], *joint_time[:1]], default=0.0))  # intervals count from there
    return experiment_of_tables(
        {
            "name": name,
            "robot": {"urdf": model, "tolerance": {} if tolerance is None else tolerance},
            "recording": {"stream": streams},
            "sensor": [
                {
                    "name": sensor,
                    "serial": serial,
                    "stream": _READINGS,
                    "prior": "identity" if _same(matrix, quantity) else matrix,
                    "limit_counts": float(limit_counts),
                    "full_scale": None if full_scale is None else _full_scale(full_scale),
                }
            ],
            "support": [{"frame": support, "gravity_direction": numbers(gravity_direction, "gravity_direction")}],
            "interval": [
                interval
                | {"start_s": interval["start_s"] - earliest_s, "end_s": interval["end_s"] - earliest_s}
                | {"support": support}
                for interval in intervals
            ],
        }
    )


def _same(matrix: FloatArray | None, quantity: str) -> bool:
    """Whether the prior says nothing of the sensor: the reading itself takes the place of counts."""
    return matrix is not None and quantity == "wrench" and np.array_equal(matrix, np.eye(6))


def _robot(robot: RobotModel | Path | str) -> RobotModel:
    if isinstance(robot, RobotModel):
        return robot
    if not isinstance(robot, str | Path):
        raise ExperimentError(f"robot: expected a RobotModel or the path of a URDF file, got {brief(robot)}")
    if str(robot).lstrip().startswith("<"):
        raise ExperimentError("robot: expected the path of a URDF file, got its text; write that to a file first")
    return read_urdf(urdf_file(robot))


def _full_scale(given: Any) -> FloatArray:
    full_scale = numbers(one_for_each(given, 6), "full_scale")
    require_shape(full_scale, name="full_scale", shape=(6,))
    if not (np.isfinite(full_scale) & (full_scale > 0.0)).all():
        raise ExperimentError(f"full_scale: expected six finite numbers above 0, N and N m, got {full_scale.tolist()}")
    return full_scale


def _intervals(kind: str, given: Any) -> list[dict[str, Any]]:
    """Tables of intervals, on the clock of the arrays."""
    spans = _bounds_s(kind, given).tolist()
    labels = [kind] if len(spans) == 1 else [f"{kind} {number}" for number in range(1, len(spans) + 1)]
    return [
        {"label": label, "start_s": start, "end_s": end, "use": _USES[kind], "kind": kind}
        for label, (start, end) in zip(labels, spans, strict=True)
    ]


def _require_apart(intervals: Sequence[Mapping[str, Any]]) -> None:
    """Refuse samples that would be fitted and judged, or fitted twice, in the words of a caller without a file."""
    for before, after in pairwise(sorted(intervals, key=lambda interval: float(interval["start_s"]))):
        if after["start_s"] < before["end_s"]:
            arguments = " and ".join(dict.fromkeys(interval["kind"] for interval in (before, after)))
            raise ExperimentError(
                f"{arguments}: expected spans that do not overlap, got {before['label']!r} to "
                f"{before['end_s']:g} s and {after['label']!r} from {after['start_s']:g} s"
            )


def _bounds_s(name: str, given: Any) -> FloatArray:
    """Starts and ends; shape (k, 2)."""
    try:
        bounds = np.asarray(given, dtype=np.float64)
        if bounds.shape[-1:] != (2,) or bounds.ndim > 2 or not (bounds.size and (np.abs(bounds) < _LATEST_S).all()):
            raise ValueError
    except (TypeError, ValueError) as error:
        got = repr(given) if len(repr(given)) < _LONGEST_QUOTE else brief(given)
        raise ExperimentError(
            f"{name}: expected one span, start and end in s on the clock of time_s, such as (1.0, 59.0), or a list of "
            f"them, got {got}"
        ) from error
    return bounds.reshape(-1, 2)


def _instants(time_s: Any, name: str) -> FloatArray:
    try:
        time = numbers(time_s, name)
    except ExperimentError as error:
        raise ExperimentError(
            f"{error}; give seconds: of dates t those are (t - t[0]) / numpy.timedelta64(1, 's'), one t[0] for all"
        ) from error
    require_shape(time, name=name, shape=(None,))
    if not np.isfinite(time).all() or (np.diff(time) <= 0.0).any():
        raise ExperimentError(f"{name}: expected finite instants that rise; sort the samples, drop repeated ones")
    if time.size and np.abs(time).max() > _LATEST_S:
        raise ExperimentError(f"{name}: expected seconds, got {time[-1]:.3g}; divide nanoseconds by 1e9")
    return time


def _require_magnitude(values: FloatArray, quantity: str, limit_counts: float) -> None:
    """Refuse counts that can only be newtons, and newtons that can only be counts."""
    known = values[np.isfinite(values)]
    if not known.size:
        return
    largest, whole = float(np.abs(known).max()), bool((known == np.rint(known)).all())
    if quantity == "raw" and not whole and largest < _LEAST_SHARE * limit_counts:
        raise ExperimentError(
            f"reading: expected counts up to the order of limit_counts, {limit_counts:g}, got fractions up to "
            f'{largest:.3g}, as of N; state quantity="wrench" for N and N m, or limit_counts of this converter'
        )
    if quantity == "wrench" and whole and largest > _MOST_WHOLE_N:
        raise ExperimentError(
            f"reading: expected N and N m, got whole numbers up to {largest:.6g}, as of counts; state "
            'quantity="raw" for counts'
        )


def _reading_table(sensor: str, time: FloatArray, reading: Any, quantity: str) -> dict[str, Any]:
    values = numbers(reading, "reading")
    require_shape(values, name="reading", shape=(len(time), 6 if quantity == "wrench" else None))
    if quantity == "wrench":
        named = [str(column) for column in getattr(reading, "columns", WRENCH_COMPONENTS)]
        if sorted(named) == sorted(WRENCH_COMPONENTS) and named != list(WRENCH_COMPONENTS):
            raise ExperimentError(
                f"reading: expected the columns {', '.join(WRENCH_COMPONENTS)} in this order, got {', '.join(named)}"
            )
    samples: dict[str, Any] = {quantity: values}
    return stream_of_arrays(_READINGS, time, frame=sensor, clock="arrays", **samples)


def _joint_table(model: RobotModel, time: FloatArray, joints: Mapping[str, Any]) -> dict[str, Any]:
    if not hasattr(joints, "keys"):  # a frame of pandas has them, and is no Mapping
        raise ExperimentError(
            f"joints: expected positions by name of the joint, a dictionary or a pandas frame, got {brief(joints)}"
        )
    names = tuple(str(joint) for joint in joints)
    absent = [joint for joint in names if joint not in model.joints]
    if absent or not names:
        raise ExperimentError(
            f"joints: expected names of joints of the robot {model.name!r}, got {', '.join(absent) or 'none'}"
        )
    positions = {str(joint): numbers(joints[joint], f"joints[{joint!r}]") for joint in joints}
    for joint, values in positions.items():
        require_shape(values, name=f"joints[{joint!r}]", shape=(len(time),))
    units = [model.joints[joint].type.unit for joint in names]
    return stream_of_arrays(_JOINTS, time, clock="arrays", position=positions, units={"position": units})


def motion_of_arrays(
    time_s: Any,
    columns: Mapping[str, Any],
    units: Mapping[str, str],
    *,
    desired: Mapping[str, Any] | None = None,
    steps_s: Sequence[float] = (),
    band_share: float = BAND_SHARE,
) -> Motion:
    """Say how arrays move, such as columns of a data frame or of a simulation.

    Args:
        time_s: Instants; shape (n,); s.
        columns: Samples by name; shape (n,) each.
        units: Unit of each.
        desired: What was wanted of some of them, by their names; shape (n,) each.
        steps_s: Instants of steps; those of what was wanted if none is named; s.
        band_share: Half of the band of settling over the step.

    Returns:
        Oscillations, settling times and tracking errors.
    """
    from forcetorque.locomotion.logged_signals import motion_signals_of_arrays
    from forcetorque.locomotion.motion_quality import motion

    signals = motion_signals_of_arrays(time_s, columns, units, desired=desired)
    return motion(signals, steps_s=steps_s, band_share=band_share)
