# SPDX-License-Identifier: BSD-3-Clause
"""The streams of an experiment, from whatever format they were logged in."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from forcetorque.errors import ExperimentError, MissingFileError
from forcetorque.exchange.tabular import StampColumn, TableLayout, TableSignal, read_table
from forcetorque.exchange.yarp import (
    MeasuresSensor,
    PortReading,
    read_analog,
    read_inertial,
    read_measures,
    read_state,
    read_state_ext,
)
from forcetorque.experiment import log_schema, schema
from forcetorque.experiment.inputs import Inputs, stated_in
from forcetorque.recording import Recording, Stream, read_recording
from forcetorque.robot import RobotModel


def read_streams(parsed: schema.ExperimentFile, file: Path, model: RobotModel | None, inputs: Inputs) -> Recording:
    """Read the streams that the experiment file names.

    Args:
        parsed: Content of the experiment file.
        file: The experiment file, for messages.
        model: The robot, whose joints tell rad from m; None for a wrist sensor.
        inputs: Resolves and remembers the files.

    Returns:
        The recording, without intervals.

    Raises:
        MissingFileError: If the log's folder is not there.
    """
    log = parsed.recording
    if isinstance(log, log_schema.ParquetLog):
        return read_recording(inputs.below(log.path, "*.parquet", "recording.json"))
    if not (inputs.folder / log.path).is_dir():
        raise MissingFileError(f"{inputs.folder / log.path}: expected the folder of a log, there is none")
    origin = {"format": log.format, "path": log.path.as_posix()}
    if isinstance(log, log_schema.TabularLog):
        tables = [
            _read_table(f"{file}: recording.stream[{k}]", entry, log, inputs) for k, entry in enumerate(log.stream)
        ]
        return Recording(streams=_by_name(file, tables), origin=origin)
    readers = {entry.stream: entry.name for entry in parsed.sensor}
    readings = [
        reading
        for k, port in enumerate(log.stream)
        for reading in _read_port(f"{file}: recording.stream[{k}]", port, log, model, readers, inputs)
    ]
    return Recording(
        streams=_by_name(file, [reading.stream for reading in readings]),
        findings=tuple(finding for reading in readings for finding in reading.findings),
        origin=origin,
    )


def _by_name(file: Path, streams: list[Stream]) -> dict[str, Stream]:
    found: dict[str, Stream] = {}
    for stream in streams:
        if stream.name in found:
            raise ExperimentError(f"{file}: recording: two streams are named {stream.name!r}; give each its own name")
        found[stream.name] = stream
    return found


def _read_table(where: str, entry: log_schema.TabularStream, log: log_schema.TabularLog, inputs: Inputs) -> Stream:
    path = inputs.file(log.path / entry.file)
    stamp = None if entry.stamp == "row" else StampColumn(column=entry.stamp.column, unit=entry.stamp.unit)
    with stated_in(where):
        layout = TableLayout(
            delimiter=entry.delimiter,
            column_names=entry.column_names,
            stamp=stamp,
            signals=tuple(
                TableSignal(quantity=s.quantity, columns=s.columns, units=s.units, names=s.names, frame=s.frame)
                for s in entry.signal
            ),
        )
        return read_table(path, layout, stream=entry.name, clock=entry.clock)


def _read_port(
    where: str,
    port: log_schema.Port,
    log: log_schema.YarpLog,
    model: RobotModel | None,
    readers: Mapping[str, str],
    inputs: Inputs,
) -> tuple[PortReading, ...]:
    folder = inputs.below(log.path / port.port, "data.log", "data.log.gz", "info.log")
    with stated_in(where):
        if isinstance(port, log_schema.MeasuresPort):
            return read_measures(folder, sensors=[_measures_sensor(entry, readers) for entry in port.sensor])
        if isinstance(port, log_schema.InertialPort):
            return (read_inertial(folder, stream=port.name, frame=port.frame),)
        if isinstance(port, log_schema.AnalogPort):
            if port.name not in readers:
                raise ExperimentError(f"no [[sensor]] reads the stream {port.name!r}; add one or leave it out")
            return (read_analog(folder, stream=port.name, frame=readers[port.name]),)
        units = {name: model.joints[name].type.unit for name in port.joints if model and name in model.joints}
        read = read_state if isinstance(port, log_schema.StatePort) else read_state_ext
        return (read(folder, stream=port.name, joints=port.joints, joint_units=units),)


def _measures_sensor(entry: log_schema.MeasuresEntry, readers: Mapping[str, str]) -> MeasuresSensor:
    return MeasuresSensor(
        list=entry.list, index=entry.index, stream=entry.name, frame=entry.frame or readers.get(entry.name)
    )
