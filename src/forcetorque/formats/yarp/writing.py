# SPDX-License-Identifier: BSD-3-Clause
"""A recording written as a folder of yarpdatadumper: ports, and messages as text."""

from __future__ import annotations

import shutil
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import TypeAlias

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.errors import MissingFileError, RecordingError
from forcetorque.base.output_file import real_path, temporary_beside
from forcetorque.base.units import si_factor
from forcetorque.formats.yarp.joint_and_sensor_ports import JOINT_UNITS, angles_of
from forcetorque.formats.yarp.log_format import PortKind
from forcetorque.formats.yarp.measures import MeasuresList, MeasuresSensor
from forcetorque.recording.recording import Recording
from forcetorque.recording.stream import Signal, Stream

_OF_ONE_STREAM = (PortKind.ANALOG, PortKind.STATE_EXT, PortKind.STATE, PortKind.INERTIAL)


@dataclass(frozen=True, slots=True, kw_only=True)
class StreamPort:
    """A port whose messages hold one stream."""

    path: str
    """Folder of the port below the folder of logs, with `/`, such as `icub/left_leg/stateExt:o`."""
    kind: PortKind
    """`analog`, `state_ext`, `state` or `inertial`."""
    stream: str
    """Stream of the recording."""

    def __post_init__(self) -> None:
        _check_path(self.path)
        if self.kind not in _OF_ONE_STREAM:
            raise RecordingError(
                f"port {self.path!r}: expected one of {', '.join(_OF_ONE_STREAM)}, got {str(self.kind)!r}; "
                "a device with several sensors is a DevicePort"
            )
        object.__setattr__(self, "kind", PortKind(self.kind))


@dataclass(frozen=True, slots=True, kw_only=True)
class DevicePort:
    """A port `measures:o` of a device with several sensors, whose streams share their stamps."""

    path: str
    """Folder of the port below the folder of logs, with `/`."""
    sensors: tuple[MeasuresSensor, ...]
    """What each sensor of the device is called and where it stands; `read_measures` takes the same."""

    def __post_init__(self) -> None:
        _check_path(self.path)
        object.__setattr__(self, "sensors", tuple(self.sensors))
        places: dict[str, list[int]] = {}
        for sensor in self.sensors:
            places.setdefault(sensor.list, []).append(sensor.index)
        if not places:
            raise RecordingError(f"port {self.path!r}: expected at least one sensor, got none")
        for name, indices in places.items():
            if sorted(indices) != list(range(len(indices))):
                raise RecordingError(
                    f"port {self.path!r}: expected the indices 0 to {len(indices) - 1} in the list {name}, each once, "
                    f"got {', '.join(map(str, indices))}; a message has no empty places"
                )


WrittenPort: TypeAlias = StreamPort | DevicePort
"""A port to write."""


def _check_path(path: str) -> None:
    parts = PurePosixPath(path).parts
    if not parts or path.startswith("/") or ".." in parts or "\\" in path:
        raise RecordingError(f"port {path!r}: expected a path below the folder of logs, such as icub/head/state:o")


DIGITS = 15
"""Significant digits of a number: as many as a float64 holds for any value."""

_OTHER_LISTS = 8
"""Lists of a stateExt message after position, velocity and acceleration, in the layout of 2017 to 2025."""


def stream_messages(recording: Recording, port: StreamPort) -> Iterator[str]:
    """Write the samples of a stream as messages of a port.

    Args:
        recording: The recording.
        port: The port.

    Returns:
        The text of each message, without sequence number and stamp.
    """
    stream = recording.stream(port.stream)
    match port.kind:
        case PortKind.STATE_EXT:
            return _board_messages(stream)
        case PortKind.STATE:
            values = _in_degrees(stream.signal("position"))
        case PortKind.INERTIAL:
            values = _inertial_values(stream)
        case _:
            values = _reading(stream).values
    return map(_numbers, _finite(stream, values).tolist())


def device_messages(recording: Recording, port: DevicePort) -> Iterator[str]:
    """Write the samples of several streams as messages of a device.

    Args:
        recording: The recording, whose streams share their stamps.
        port: The port.

    Returns:
        The text of each message, without sequence number and stamp.
    """
    lists = [
        [_sensor_texts(recording.stream(sensor.stream), sensor) for sensor in _in_place(port, name)]
        for name in MeasuresList
    ]
    n = len(recording.stream(port.sensors[0].stream))
    return (" ".join(f"({' '.join(sensor[row] for sensor in sensors)})" for sensors in lists) for row in range(n))


def stamp_text(stamp_ns: int) -> str:
    """Write a stamp to the nanosecond; the dumper itself rounds to microseconds.

    Args:
        stamp_ns: Stamp; ns.

    Returns:
        Seconds.
    """
    return f"{stamp_ns // 10**9}.{stamp_ns % 10**9:09d}"


def _board_messages(stream: Stream) -> Iterator[str]:
    """Quantities that the stream lacks are zeros, as of boards that do not estimate them."""
    position = stream.signal("position")
    columns = []
    for quantity in JOINT_UNITS:
        signal = stream.signals.get(quantity)
        if signal is not None and signal.columns != position.columns:
            raise RecordingError(
                f"stream {stream.name!r}: expected the {quantity} of {', '.join(position.columns)} as of the position, "
                f"got {', '.join(signal.columns)}"
            )
        columns.append(np.zeros_like(position.values) if signal is None else _in_degrees(signal))
    rest = " ".join([_list([0.0] * len(position.columns))] * (_OTHER_LISTS - 2))
    modes = " ".join([f"({' '.join('0' * len(position.columns))}) [ok]"] * 2)
    texts = [_list_texts(stream, quantity, values) for quantity, values in zip(JOINT_UNITS, columns, strict=True)]
    return (f"{' '.join(lists)} {rest} {modes}" for lists in zip(*texts, strict=True))


def _list_texts(stream: Stream, quantity: str, values: FloatArray) -> list[str]:
    """A list fails as a whole: NaN in all joints of a sample is its flag, NaN in some has no notation."""
    failed: BoolArray = np.logical_and.reduce(np.isnan(values), axis=1)
    whole = _finite(stream, np.where(failed[:, None], 0.0, values), what=f"the {quantity} of some joints")
    return [_list(row, flag="fail" if bad else "ok") for row, bad in zip(whole.tolist(), failed.tolist(), strict=True)]


def _list(row: list[float], *, flag: str = "ok") -> str:
    return f"({_numbers(row)}) [{flag}]"


def _sensor_texts(stream: Stream, sensor: MeasuresSensor) -> list[str]:
    if "device_stamp" in stream.signals:
        ticks = _finite(stream, stream.signal("device_stamp").values)[:, 0].tolist()
        stamps = [_number(tick) for tick in ticks]
    else:
        stamps = [stamp_text(stamp) for stamp in stream.stamp_ns.tolist()]
    values = _finite(stream, _sensor_values(stream, sensor)).tolist()
    return [f"(({_numbers(row)}) {stamp})" for row, stamp in zip(values, stamps, strict=True)]


def _sensor_values(stream: Stream, sensor: MeasuresSensor) -> FloatArray:
    if sensor.quantity == "wrench":
        return _reading(stream).values
    if sensor.quantity == "orientation":
        return angles_of(stream.signal("orientation"))
    factors = [si_factor(unit)[1] for unit in sensor.logged_units]
    return stream.signal(sensor.quantity).values / factors


def _in_place(port: DevicePort, name: MeasuresList) -> list[MeasuresSensor]:
    return sorted((sensor for sensor in port.sensors if sensor.list == name), key=lambda sensor: sensor.index)


def _reading(stream: Stream) -> Signal:
    """The wrench, or the counts of a board that is configured not to calibrate: six numbers either way."""
    present = [stream.signals[name] for name in ("wrench", "raw") if name in stream.signals]
    if len(present) != 1 or len(present[0].columns) != 6:
        got = " and ".join(f"{len(signal.columns)} columns of {signal.quantity}" for signal in present) or "neither"
        raise RecordingError(f"stream {stream.name!r}: expected a wrench or six channels of raw, got {got}")
    return present[0]


def _inertial_values(stream: Stream) -> FloatArray:
    acceleration = stream.signal("proper_acceleration").values
    degrees = stream.signal("angular_velocity").values / si_factor("deg/s")[1]
    unknown = np.zeros((len(stream), 3))  # as of devices that measure neither orientation nor magnetic field
    orientation = stream.signals.get("orientation")
    angles = unknown if orientation is None else angles_of(orientation)
    return np.hstack([angles, acceleration, degrees, unknown])


def _in_degrees(signal: Signal) -> FloatArray:
    factors = np.where([unit.startswith("rad") for unit in signal.units], si_factor("deg")[1], 1.0)
    return signal.values / factors


def _finite(stream: Stream, values: FloatArray, *, what: str = "a value") -> FloatArray:
    rows = np.flatnonzero(~np.isfinite(values).all(axis=1))
    if len(rows):
        raise RecordingError(
            f"stream {stream.name!r}: sample {rows[0]} and {len(rows) - 1} more lack {what}, which such a message "
            "cannot say; leave these samples out, as messages that were never sent"
        )
    return values


def _numbers(row: list[float]) -> str:
    return " ".join(map(_number, row))


def _number(value: float) -> str:
    text = f"{value:.{DIGITS}g}"
    # the dumper writes every float64 with a point or an exponent
    return text if "." in text or "e" in text else text + ".0"


def write_ports(folder: Path | str, recording: Recording, ports: Sequence[WrittenPort]) -> None:
    """Write streams of a recording as logs of ports.

    Angles are written in deg. The samples stand in the order of the stream, each with its sequence
    number, counted from 0 where the stream has none, and its stamp as that of the sender. All ports
    are there at the end, or none.

    Args:
        folder: Folder of logs; made if it is not there. What it holds already is left alone.
        recording: The recording.
        ports: Which streams go where; what the kind of a port cannot carry is not written.

    Raises:
        RecordingError: If a port is there already, two share a folder or lie in each other, or a stream
            does not hold what its port sends.
        MissingFileError: If the folder that the folder of logs is to be made in does not exist.
    """
    target = real_path(folder)
    if not target.parent.is_dir():
        raise MissingFileError(f"{folder}: expected an existing folder to write to, got none; create {target.parent}")
    _check_places(target, ports)
    with temporary_beside(target, folder=True) as fresh:
        for port in ports:
            _write_port(fresh / port.path, recording, port)
        _move(fresh, target, ports)


def _check_places(target: Path, ports: Sequence[WrittenPort]) -> None:
    if not ports:
        raise RecordingError("ports: expected at least one, got none")
    paths = [PurePosixPath(port.path) for port in ports]
    for k, path in enumerate(paths):
        for other in paths[:k]:
            if path == other or path in other.parents or other in path.parents:
                raise RecordingError(f"ports: {str(other)!r} and {str(path)!r} lie in each other; give each its own")
        if (target / path).exists():
            raise RecordingError(
                f"{target / path}: exists; a log is never written over, choose a new folder; nothing was written"
            )
        for parent in (target, *(target / above for above in path.parents)):
            if parent.exists() and not parent.is_dir():
                raise RecordingError(f"{parent}: expected a folder or nothing, got a file; nothing was written")


def _write_port(folder: Path, recording: Recording, port: WrittenPort) -> None:
    if isinstance(port, DevicePort):
        stream = _shared_messages(recording, port)
        texts = device_messages(recording, port)
    else:
        stream = recording.stream(port.stream)
        texts = stream_messages(recording, port)
    sequence = np.arange(len(stream)) if stream.sequence is None else stream.sequence
    _check_envelopes(port, stream)
    folder.mkdir(parents=True)
    with (folder / "data.log").open("w", encoding="ascii", newline="\n") as log:
        log.writelines(
            f"{number} {stamp_text(stamp)} {text}\n"
            for number, stamp, text in zip(sequence.tolist(), stream.stamp_ns.tolist(), texts, strict=True)
        )
    first, last = (stamp_text(int(stamp)) for stamp in (stream.stamp_ns.min(), stream.stamp_ns.max()))
    info = f"Type: Bottle;\nStamp: tx;\n[{first}] /{port.path} [connected]\n[{last}] /{port.path} [disconnected]\n"
    (folder / "info.log").write_text(info, encoding="utf-8", newline="\n")


def _shared_messages(recording: Recording, port: DevicePort) -> Stream:
    """Give the stream whose stamps are those of all streams of a device."""
    first, *others = (recording.stream(sensor.stream) for sensor in port.sensors)
    for other in others:
        same_sequence = (
            first.sequence is other.sequence
            if first.sequence is None or other.sequence is None
            else np.array_equal(first.sequence, other.sequence)
        )
        if not same_sequence or not np.array_equal(first.stamp_ns, other.stamp_ns):
            raise RecordingError(
                f"port {port.path!r}: expected the streams {first.name!r} and {other.name!r} to share their stamps and "
                "sequence numbers, because they are sent in the same messages; give each its own port"
            )
    return first


def _check_envelopes(port: WrittenPort, stream: Stream) -> None:
    if not len(stream):
        raise RecordingError(f"port {port.path!r}: the stream {stream.name!r} holds no sample; leave the port out")
    if (stream.stamp_ns <= 0).any():
        raise RecordingError(
            f"port {port.path!r}: expected stamps after the epoch, got {int(stream.stamp_ns.min())} ns in the stream "
            f"{stream.name!r}; others mean that the sender gave none"
        )
    if stream.sequence is not None and ((stream.sequence < 0) | (stream.sequence >= 10**18)).any():
        raise RecordingError(
            f"port {port.path!r}: expected sequence numbers from 0 to 18 digits in the stream {stream.name!r}, got "
            f"{int(stream.sequence.min())} to {int(stream.sequence.max())}; a negative one means that there was none"
        )


def _move(fresh: Path, target: Path, ports: Sequence[WrittenPort]) -> None:
    """Put the ports where they belong: the whole folder at once if it is new, else one by one or none."""
    if not target.exists():
        fresh.rename(target)
        return
    new_folders: list[Path] = []
    placed: list[Path] = []
    try:
        for port in ports:
            place = target / port.path
            for parent in reversed([above for above in place.parents if not above.exists()]):
                parent.mkdir()
                new_folders.append(parent)
            (fresh / port.path).rename(place)
            placed.append(place)
    except BaseException:
        for path in placed:
            shutil.rmtree(path)
        for path in reversed(new_folders):
            path.rmdir()
        raise
