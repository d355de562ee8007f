# SPDX-License-Identifier: BSD-3-Clause
"""An experiment from the tables of its file, with arrays, a robot and prior matrices in place of files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from forcetorque.app.python.experiment import Experiment
from forcetorque.base.arrays import FloatArray, require_shape
from forcetorque.base.errors import ExperimentError, known_names, require_known
from forcetorque.experiment.loading import load_tables
from forcetorque.experiment.named_files import InMemory
from forcetorque.recording.recording import Recording
from forcetorque.recording.stream import QUANTITIES, Labels
from forcetorque.robot.model import RobotModel

_IN_MEMORY: Final = "arrays"
"""Stands in the tables for the path of a log, robot or prior matrix that is none."""
_OF_SEVERAL_FORMS: Final = "orientation"
"""Quantity whose number of columns depends on its form, such as quaternion or matrix."""


def experiment_of_tables(tables: Mapping[str, Any], *, folder: Path | str = ".") -> Experiment:
    """Make an experiment from the tables of an experiment file, where arrays stand in place of names of arrays.

    The tables are those of a file whose recording has the format `npz`; `forcetorque schema experiment` prints them.
    `schema` may be left out, and `format` and `path` of the recording where its streams hold arrays. In place of files,
    `urdf` of the robot may be a `RobotModel`, and `prior` of a sensor its matrix, shape (6, c), N/count, N m/count.

    Args:
        tables: Tables by key: `recording = {"stream": [...]}` with streams as `stream_of_arrays` makes them, `robot`,
            lists `sensor`, `support`, `interval`, and what else the file may have, such as `load` and `contact`.
        folder: Folder that paths in them are relative to.

    Returns:
        The experiment, its sensors by name.

    Raises:
        MissingFileError: If a file that they name is not there.
        FormatError: If a key is unknown, missing or has a wrong value.
        UnitError: If a unit is not one of its quantity.
        ExperimentError: If they contradict themselves, the robot or the recording, an array holds no numbers, or the
            robot has no joint of the name of a column.
    """
    content = {"schema": "forcetorque/experiment/1", "name": _IN_MEMORY, **tables}
    robot, priors, arrays = _robot(content), _priors(content), _arrays(content)
    in_memory = InMemory(robot=robot, priors=priors, arrays=arrays)
    experiment = load_tables(_plain(content), in_memory, folder=Path(folder))
    if arrays is not None:
        _require_joints(experiment.recording, experiment.model)
    return Experiment.of(experiment)


def stream_of_arrays(
    name: str,
    time_s: Any,
    *,
    frame: str | None = None,
    clock: str = "log",
    units: Mapping[str, str | Sequence[str]] | None = None,
    **quantities: Any,
) -> dict[str, Any]:
    """Make the table of a stream from arrays, for `experiment_of_tables`.

    Args:
        name: Name of the stream.
        time_s: Instants of its samples on its clock; shape (n,); s.
        frame: Link or frame along whose axes wrenches and readings of an IMU are given.
        clock: Name of its clock; only streams of one clock are combined.
        units: Unit of each quantity, or of each of its columns; the SI unit of the quantity if left out, `rad` of
            positions.
        quantities: Samples by quantity, such as `raw` (counts), `wrench` (N, N m), `position` (rad, m),
            `proper_acceleration` (m/s2), `angular_velocity` (rad/s), `temperature` (degC); shape (n, k) or (n,). Where
            columns have names, such as positions of joints, a dictionary or a frame of pandas with columns of shape
            (n,).

    Returns:
        The table, with arrays in it.

    Raises:
        ExperimentError: If a quantity is unknown, there is none, or a unit is of a quantity that is not given.
        ShapeError: If arrays have another number of rows than there are instants, or of columns than the quantity has.
    """
    place = f"stream {name!r}"
    if not quantities:
        raise ExperimentError(f"{place}: expected a quantity, such as raw=counts, got none")
    time = numbers(time_s, f"{place}: time_s")
    require_shape(time, name=f"{place}: time_s", shape=(None,))
    for key in units or {}:
        require_known(key, quantities, ExperimentError, f"{place}: units: {key!r} is not given")
    signals = []
    for key, given in quantities.items():
        require_known(key, QUANTITIES, ExperimentError, f"{place}: no quantity is called {key!r}")
        values, names = _columns(given, f"{place}: {key}")
        width = None if key == _OF_SEVERAL_FORMS else len(QUANTITIES[key].columns) or None
        require_shape(values, name=f"{place}: {key}", shape=(len(time), width))
        signals.append(_signal(key, values, names, frame, (units or {}).get(key)))
    return {"name": name, "clock": clock, "variable": time, "time": {"unit": "s"}, "signal": signals}


def _columns(given: Any, place: str) -> tuple[FloatArray, list[str] | None]:
    """Samples, shape (n, k), and the names of columns that have any."""
    if hasattr(given, "keys"):  # a frame of pandas has them, and is no Mapping
        names = [str(column) for column in given]
        columns = [numbers(given[column], f"{place}[{column!r}]") for column in given]
        for column, values in zip(names, columns, strict=True):
            require_shape(values, name=f"{place}[{column!r}]", shape=(None if not columns else len(columns[0]),))
        if not columns:
            raise ExperimentError(f"{place}: expected columns by name, got none")
        return np.column_stack(columns), names
    values = numbers(given, place)
    return values[:, None] if values.ndim == 1 else values, None


def _signal(
    key: str, values: FloatArray, names: list[str] | None, frame: str | None, unit: str | Sequence[str] | None
) -> dict[str, Any]:
    quantity, count = QUANTITIES[key], values.shape[1]
    fixed = quantity.labels is Labels.FIXED
    if unit is None:
        unit = list(quantity.units) if fixed and len(quantity.units) == count else next(iter(quantity.units), "1")
    signal = {"quantity": key, "variable": values, "columns": [1, count], "unit": unit}
    if fixed and names is not None and names != list(quantity.columns):
        raise ExperimentError(
            f"{key}: expected the columns {', '.join(quantity.columns)} in this order, got {', '.join(names)}"
        )
    if names is None and key == "raw":
        names = [f"ch{k}" for k in range(count)]  # as messages call channels
    if names is not None and not fixed:
        signal["names"] = names
    if quantity.has_frame and frame is not None:
        signal["frame"] = frame
    return signal


def _require_joints(recording: Recording, model: RobotModel) -> None:
    """Refuse columns by names of joints that the robot does not have."""
    for stream in recording.streams.values():
        for key, signal in stream.signals.items():
            absent = [name for name in signal.columns if name not in model.joints]
            if absent and QUANTITIES[key].labels is Labels.JOINTS:
                raise ExperimentError(
                    f"stream {stream.name!r}: {key}: expected names of joints of the robot {model.name!r}, got "
                    f"{', '.join(absent)}; {known_names(absent[0], model.joints)}"
                )


def _robot(content: dict[str, Any]) -> RobotModel | None:
    """The robot, in whose place a name stands afterwards."""
    robot = content.get("robot")
    if not isinstance(robot, Mapping) or not isinstance(robot.get("urdf"), RobotModel):
        return None
    content["robot"] = {**robot, "urdf": _IN_MEMORY}
    model: RobotModel = robot["urdf"]
    return model


def _priors(content: dict[str, Any]) -> dict[str, FloatArray]:
    """Prior matrices by sensor, in whose place a name stands afterwards."""
    priors: dict[str, FloatArray] = {}
    sensors = []
    for k, sensor in enumerate(_tables(content, "sensor")):
        prior = sensor.get("prior")
        if prior is not None and not isinstance(prior, str | Path | Mapping):
            matrix = numbers(prior, f"sensor[{k}].prior")
            require_shape(matrix, name=f"sensor[{k}].prior", shape=(6, None))
            if not np.isfinite(matrix).all():
                raise ExperimentError(f"sensor[{k}].prior: expected a matrix of finite numbers, got NaN or infinity")
            priors[str(sensor.get("name"))] = matrix
            sensor = {**sensor, "prior": _IN_MEMORY}
        sensors.append(sensor)
    if sensors:
        content["sensor"] = sensors
    return priors


def _arrays(content: dict[str, Any]) -> dict[str, FloatArray] | None:
    """Arrays of the recording, in whose place their places stand afterwards; None where it names a log."""
    recording = content.get("recording")
    if not isinstance(recording, Mapping) or "path" in recording:
        return None
    arrays: dict[str, FloatArray] = {}

    def named(table: Any, place: str) -> Any:
        given = table.get("variable") if isinstance(table, Mapping) else None
        if given is None:
            return table
        if isinstance(given, str):
            raise ExperimentError(f"recording.{place}.variable: expected an array, got {brief(given)}")
        values = numbers(given, f"recording.{place}.variable")
        if values.ndim not in (1, 2):
            raise ExperimentError(f"recording.{place}.variable: expected rows of numbers, got {brief(given)}")
        arrays[place] = values[:, None] if values.ndim == 1 else values
        return {**table, "variable": place}

    streams = []
    for k, stream in enumerate(_tables(recording, "stream")):
        changed = dict(named(stream, f"stream[{k}]"))
        if "time" in changed:
            changed["time"] = named(changed["time"], f"stream[{k}].time")
        signals = enumerate(_tables(changed, "signal"))
        changed["signal"] = [named(signal, f"stream[{k}].signal[{j}]") for j, signal in signals]
        streams.append(changed)
    content["recording"] = {"format": "npz", "path": _IN_MEMORY, **recording, "stream": streams}
    return arrays


def _tables(table: Mapping[str, Any], key: str) -> list[Mapping[str, Any]]:
    """The list of tables under a key; none where there is something else, which the form of the file refuses."""
    entries = table.get(key)
    if isinstance(entries, list | tuple) and all(isinstance(entry, Mapping) for entry in entries):
        return list(entries)
    return []


def _plain(value: Any) -> Any:
    """Tables as a parser of TOML gives them: lists and numbers of Python in place of those of NumPy."""
    if isinstance(value, Mapping):
        return {str(key): _plain(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(entry) for entry in value]
    return value.tolist() if isinstance(value, np.ndarray | np.generic) else value


def numbers(given: Any, name: str) -> FloatArray:
    """Take what is given as numbers, NaN where none is; text of numbers is accepted, instants and complex are not.

    Args:
        given: An array, or what NumPy makes one of.
        name: Name of the argument, for the message.

    Returns:
        The numbers.

    Raises:
        ExperimentError: If it holds anything else.
    """
    refusal = ExperimentError(f"{name}: expected numbers, got {brief(given)}")
    try:
        array = _plain_array(given)
        values = array.astype(np.float64) if array.dtype.kind not in "mMc" else None
    except (TypeError, ValueError) as error:
        raise refusal from error
    if values is None:
        raise refusal
    return values


def brief(given: Any) -> str:
    """Describe an argument in a few words, of any size.

    Args:
        given: The argument.

    Returns:
        Its value if it is short, else its type and shape.
    """
    shape = getattr(given, "shape", None)
    if shape is not None:
        return f"{type(given).__name__} of shape {shape}"
    return repr(given) if given is None or isinstance(given, str | int | float) else f"a {type(given).__name__}"


def _plain_array(given: Any) -> npt.NDArray[Any]:
    """An array of numpy, whose NaN stands for what is masked and for what pandas knows to be missing."""
    if isinstance(given, np.ma.MaskedArray):
        return np.where(np.ma.getmaskarray(given), np.nan, given.data)
    array = np.asarray(given)
    if array.dtype == object and hasattr(given, "to_numpy"):  # of pandas, where numbers that may be missing are objects
        return np.asarray(given.to_numpy(dtype=np.float64, na_value=np.nan))
    return array
