# SPDX-License-Identifier: BSD-3-Clause
"""Files of robometry as a format of logs, and what an experiment file specifies of them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field

from forcetorque.base.errors import ForceTorqueError, FormatError, known_names
from forcetorque.base.toml_file import Table, Text
from forcetorque.formats.hdf5_file import Member, datasets, is_member, member, members, opened_hdf5, require_readable
from forcetorque.formats.log_format import LogContext, LogDescription, LogReading, LogTable, StreamReading
from forcetorque.formats.robometry.channels import (
    DESCRIPTION,
    JOINT_QUANTITIES,
    JOINTS,
    channel_paths,
    is_robometry_log,
    joint_stream,
    log_group,
    orientation_stream,
    read_channel,
    sensor_quantity,
    sensor_stream,
    texts,
)
from forcetorque.formats.specified_signals import SPECIFY_SENSE, SenseTable
from forcetorque.recording.orientation import ROLL_PITCH_YAW
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import QUANTITIES, Stream


class RobometryStream(Table):
    """One sensor of the log, or all of its joints."""

    name: Text
    """Name of the stream in the recording."""
    channel: Text
    """`joints_state`, or group and name of a sensor, such as `FTs/l_leg_ft_sensor`."""
    frame: Text | None = None
    """Link of the URDF in whose frame an IMU reads; left out for joints, temperatures and sensors of the experiment."""
    orientation: SenseTable | None = None
    """Of a channel of `orientations`, which needs it: what its rotation `Rz(y) Ry(p) Rx(r)` does."""


class RobometryLog(LogTable):
    """One file of robometry: HDF5 as MATLAB 7.3 writes it, with the group `description_list`."""

    format: Literal["robometry"]
    """Format of the recording."""
    path: Path
    """File, such as robot_logger_device_2024_01_31_10_00_00.mat."""
    units: dict[Text, Text | tuple[Text, ...]] = {}
    """Units of channels to which the file has no label, such as `"joints_state/positions" = "deg"`; one for all
    elements, or one for each."""
    stream: Annotated[tuple[RobometryStream, ...], Field(min_length=1)]
    """What is read."""


class RobometryFormat:
    """Single files that label elements and units: they are described without an experiment file."""

    table = RobometryLog
    sign = f"an HDF5 file with {DESCRIPTION}"

    def recognises(self, path: Path) -> bool:
        """Look for the names of the joints."""
        return is_robometry_log(path)

    def describe(self, path: Path) -> LogDescription:
        """Read all that is labelled; other channels are findings."""
        with opened_hdf5(path) as file:
            group = _group(file)
            require_readable(datasets(group))
            paths = tuple(channel_paths(group))
            channels = sorted(set(map(_channel_of, paths)))
            readings: dict[str, StreamReading] = {}
            unread = [_not_in_file(group, entry) for entry in members(group) if entry.not_in_file is not None]
            for channel in channels:
                try:
                    readings[channel] = _read(
                        group, paths, RobometryStream(name=channel, channel=channel, frame=channel), units={}
                    )
                except ForceTorqueError as error:
                    unread.append(Finding(stream=channel, kind="not_read", message=str(error), count=0))
            origin = {"format": "robometry", "path": str(path)} | _robot_name(group)
        if not readings:
            reason = unread[0].message if unread else "it has no channel"
            raise FormatError(f"{path}: expected a log with a channel that can be read, got none: {reason}")
        return LogDescription(
            table=RobometryLog.model_construct(
                format="robometry", path=path, units={}, stream=tuple(map(_stated, readings))
            ),
            reading=LogReading.of(readings.values(), unread=unread, origin=origin),
        )

    def read(self, specified: RobometryLog, context: LogContext) -> LogReading:
        """Read every channel that is specified."""
        path = context.file(specified.path)
        units = {channel: (unit,) if isinstance(unit, str) else unit for channel, unit in specified.units.items()}
        readings = []
        with opened_hdf5(path) as file:
            group = _group(file)
            require_readable(datasets(group))
            paths = tuple(channel_paths(group))
            _require_known(path, "units", units, paths)
            for k, entry in enumerate(specified.stream):
                with context.stated_in(f"stream[{k}]"):
                    framed = entry.model_copy(update={"frame": entry.frame or context.sensors.get(entry.name)})
                    reading = _read(group, paths, framed, units=units)
                    _require_rotary(reading.stream, context.joint_units)
                    readings.append(reading)
        return LogReading.of(readings)


def _not_in_file(group: Any, entry: Member) -> Finding:
    text = f"expected numbers in the file itself, got a {entry.not_in_file}, which is not followed"
    path = entry.path.removeprefix(group.name).strip("/")
    return Finding(stream=path, kind="not_read", message=text, count=0)


def _group(file: Any) -> Any:
    group = log_group(file)
    if group is None:
        raise FormatError(f"{file.filename}: expected a group with {DESCRIPTION}, as robometry writes it, got none")
    return group


def _channel_of(path: str) -> str:
    """All channels of the joints are one stream."""
    group, _, name = path.partition("/")
    return JOINTS if group == JOINTS and name in JOINT_QUANTITIES else path


def _read(
    group: Any, paths: Sequence[str], entry: RobometryStream, *, units: Mapping[str, Sequence[str]]
) -> StreamReading:
    file = Path(group.file.filename)
    quantity = sensor_quantity(entry.channel)
    if (quantity == "orientation") != (entry.orientation is not None):
        raise FormatError(
            f"{file}: {entry.channel}: expected {SPECIFY_SENSE} for roll, pitch and yaw, whose sense the file "
            "does not specify, and for nothing else"
        )
    if entry.channel == JOINTS:
        joints = [f"{JOINTS}/{leaf}" for leaf in JOINT_QUANTITIES if f"{JOINTS}/{leaf}" in paths]
        _require_known(file, "channel", joints[:1] or [JOINTS], paths)
        channels = [read_channel(group, joint) for joint in joints]
        return joint_stream(channels, name=entry.name, joints=texts(member(group, DESCRIPTION)), units=units)
    _require_known(file, "channel", [entry.channel], paths)
    if quantity is None:
        raise FormatError(f"{file}: {entry.channel}: expected a channel of a sensor or {JOINTS}; this is neither")
    if QUANTITIES[quantity].has_frame and entry.frame is None:
        raise FormatError(
            f"{file}: {entry.channel}: expected a frame, or a [[sensor]] that reads {entry.name!r}; specify frame"
        )
    channel = read_channel(group, entry.channel)
    if entry.orientation is not None:
        layout = entry.orientation.applied_to(ROLL_PITCH_YAW)
        return orientation_stream(channel, name=entry.name, frame=str(entry.frame), layout=layout, units=units)
    return sensor_stream(channel, name=entry.name, frame=entry.frame, units=units)


def _require_known(file: Path, key: str, wanted: Iterable[str], paths: Sequence[str]) -> None:
    for channel in wanted:
        if channel not in paths:
            names = known_names(channel, set(map(_channel_of, paths)))
            raise FormatError(f"{file}: {key}: no channel {channel!r}; {names}")


def _require_rotary(stream: Stream, joint_units: Mapping[str, str]) -> None:
    if "position" not in stream.signals:
        return
    position = stream.signals["position"]
    for joint, unit in zip(position.columns, position.units, strict=True):
        if joint_units.get(joint, unit) != unit:
            raise FormatError(
                f"{stream.name}: joint {joint}: the robot has it in {joint_units[joint]}, the log in {unit}; "
                "loggers label all joints alike, so this one is not read; use a log of its own"
            )


def _stated(channel: str) -> RobometryStream:
    # a force-torque sensor has its frame from the [[sensor]] that reads it
    quantity = sensor_quantity(channel)
    framed = quantity is not None and quantity != "wrench" and QUANTITIES[quantity].has_frame
    return RobometryStream.model_construct(name=channel, channel=channel, frame=channel if framed else None)


def _robot_name(group: Any) -> dict[str, str]:
    return {"robot": texts(member(group, "yarp_robot_name"))[0]} if is_member(group, "yarp_robot_name") else {}
