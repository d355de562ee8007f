# SPDX-License-Identifier: BSD-3-Clause
"""Messages as the text of yarpdatadumper: the inverse of what the readers of ports do."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray
from forcetorque.errors import RecordingError
from forcetorque.exchange.yarp.discover import PortKind
from forcetorque.exchange.yarp.joint_units import JOINT_UNITS
from forcetorque.exchange.yarp.measures import READ_LISTS, MeasuresList, MeasuresSensor
from forcetorque.exchange.yarp.roll_pitch_yaw import angles_of
from forcetorque.exchange.yarp.written_port import DevicePort, StreamPort
from forcetorque.recording import Recording, Signal, Stream
from forcetorque.spatial import si_factor

DIGITS = 15
"""Significant digits of a number: as many as a float64 holds whatever its value."""

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
    """A list fails as a whole: NaN in all joints of a sample is its flag, NaN in some cannot be said."""
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
    factors = [si_factor(unit)[1] for unit in READ_LISTS[sensor.list].logged_units]
    logged: FloatArray = stream.signal(sensor.quantity).values / factors
    return logged


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
    degrees: FloatArray = signal.values / factors
    return degrees


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
