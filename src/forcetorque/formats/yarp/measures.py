# SPDX-License-Identifier: BSD-3-Clause
"""Ports of devices with several sensors, `measures:o`: one list per kind of sensor [1].

Each list holds one `((v1 ... vn) stamp)` per sensor. How many lists there are depends on the
version of YARP, but their order does not; which sensor is which depends on the configuration of
the device and is not in the log.

References:
    [1] YARP, src/libYARP_dev/src/idl/SensorStreamingData.thrift.
    [2] YARP, src/libYARP_dev/src/yarp/dev/MultipleAnalogSensorsInterfaces.h, IOrientationSensors.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from itertools import chain
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError, RecordingError, require_known
from forcetorque.base.units import si_factor
from forcetorque.formats.log_format import StreamReading
from forcetorque.formats.yarp.joint_and_sensor_ports import ANGLES
from forcetorque.formats.yarp.message import Bottle, BottleValue, is_number
from forcetorque.formats.yarp.port_log import PortLog, read_port_log
from forcetorque.recording.orientation import ROLL_PITCH_YAW, OrientationLayout, orientation_signals
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import QUANTITIES, Signal


class MeasuresList(StrEnum):
    """The lists of a message, in its order."""

    GYROSCOPE = "gyroscope"
    """Angular velocity in deg/s."""
    ACCELEROMETER = "accelerometer"
    """Proper acceleration in m/s2."""
    MAGNETOMETER = "magnetometer"
    """Magnetic field."""
    ORIENTATION = "orientation"
    """Roll, pitch, yaw in deg: `v_world = Rz(yaw) Ry(pitch) Rx(roll) v_sensor` [2]."""
    TEMPERATURE = "temperature"
    """Temperature in degC."""
    SIX_AXIS_FORCE_TORQUE = "six_axis_force_torque"
    """Force in N, then moment in N m; raw counts if the device is configured so."""
    CONTACT_LOAD_CELL = "contact_load_cell"
    """Arrays of load cells."""
    ENCODER = "encoder"
    """Arrays of encoders."""
    SKIN = "skin"
    """Patches of skin."""
    POSITION = "position"
    """Positions; sent by newer versions only."""
    LINEAR_VELOCITY = "linear_velocity"
    """Linear velocities; sent by newer versions only."""
    ANGULAR_ACCELERATION = "angular_acceleration"
    """Angular accelerations; sent by newer versions only."""


READ_LISTS = {
    MeasuresList.GYROSCOPE: "angular_velocity",
    MeasuresList.ACCELEROMETER: "proper_acceleration",
    MeasuresList.ORIENTATION: "orientation",
    MeasuresList.TEMPERATURE: "temperature",
    MeasuresList.SIX_AXIS_FORCE_TORQUE: "wrench",
}
"""The lists that are read, and the quantity that their sensors measure."""
_LOGGED_UNITS = {"angular_velocity": ("deg/s",) * 3, "orientation": ("deg",) * 3}
"""Units of quantities that are not logged in those of recordings."""

MIN_LISTS = 9
"""Lists in the messages of the oldest version."""
_ORDER = tuple(MeasuresList)


@dataclass(frozen=True, slots=True, kw_only=True)
class MeasuresSensor:
    """One sensor of a device: where it stands in the messages and what it is called."""

    list: MeasuresList
    """List that holds it."""
    index: int
    """Its place in that list, counted from 0."""
    stream: str
    """Name for its stream."""
    frame: str | None = None
    """Frame of the sensor, along whose axes it reports; None if its quantity has none."""
    orientation: OrientationLayout = ROLL_PITCH_YAW
    """Of an orientation what its numbers mean: YARP fixes form and sense, not in which direction things fall."""

    def __post_init__(self) -> None:
        require_known(self.list, _ORDER, RecordingError, f"{self.stream}: no list is called {self.list!r}")
        object.__setattr__(self, "list", MeasuresList(self.list))
        if self.list not in READ_LISTS:
            raise RecordingError(
                f"{self.stream}: sensors in the list {self.list} are not read; expected one of {', '.join(READ_LISTS)}"
            )
        if isinstance(self.index, bool) or not isinstance(self.index, int) or self.index < 0:
            raise RecordingError(f"{self.stream}: expected an index of 0 or more, got {self.index!r}")
        if QUANTITIES[self.quantity].has_frame != (self.frame is not None):
            wanted = "the frame of its axes" if self.frame is None else "no frame"
            raise RecordingError(f"{self.stream}: expected {wanted} for {self.quantity}, got {self.frame!r}")

    @property
    def quantity(self) -> str:
        """Name of the quantity that it measures."""
        return READ_LISTS[self.list]

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of its numbers in a message, its stamp left out."""
        return ANGLES if self.quantity == "orientation" else QUANTITIES[self.quantity].columns

    @property
    def logged_units(self) -> tuple[str, ...]:
        """Units of these numbers."""
        return _LOGGED_UNITS.get(self.quantity, QUANTITIES[self.quantity].units)


def read_measures(port_dir: str | Path, *, sensors: Sequence[MeasuresSensor]) -> tuple[StreamReading, ...]:
    """Read the log of a device with several sensors.

    Angular velocities are logged in deg/s and given in rad/s, orientations as roll, pitch and yaw in deg and given as
    rotation matrix and gravity. The messages do not specify whether the
    device calibrates its force-torque sensors: that they hold N and N m is assumed.

    Where messages carry the sender's and the dumper's stamp, the sender's is taken if it is
    positive and else the dumper's, as the dumper itself does where it writes only one.

    Args:
        port_dir: Folder with `data.log` or `data.log.gz`, and `info.log`.
        sensors: The sensors that are wanted; at least one.

    Returns:
        For each sensor a stream with its quantity, of an orientation `gravity` too, and `device_stamp`,
        the stamp of the sensor's own clock, and what was found in the log.

    Raises:
        MissingFileError: If the folder or its log is not there.
        FormatError: If the log is not one of such a device, or the device lacks one of the sensors.
        RecordingError: If no sensor is wanted, or two have one name or one place.
    """
    _check_sensors(sensors)
    log = read_port_log(port_dir, stream=sensors[0].stream, choose=_DeviceMessages(sensors=tuple(sensors)))
    widths = [len(sensor.columns) + 1 for sensor in sensors]
    parts = np.split(log.values, np.cumsum(widths)[:-1], axis=1)
    return tuple(_reading(sensor, values, log) for sensor, values in zip(sensors, parts, strict=True))


def sensor_sizes(message: Bottle) -> list[list[int]]:
    """Count the numbers of each sensor in each list of a message.

    Args:
        message: The message.

    Returns:
        Numbers of each sensor, its stamp included, for each list that the message has.

    Raises:
        FormatError: If it is not a message of such a device; the message does not name the line.
    """
    lists = [element for element in message if isinstance(element, tuple)]
    if len(lists) != len(message) or len(lists) < MIN_LISTS:
        raise FormatError(
            f"expected at least {MIN_LISTS} lists and nothing else, got {len(message)} elements of which {len(lists)} "
            "are lists; is this the measures port of a device?"
        )
    return [[_size(sensor, place) for sensor in sensors] for place, sensors in enumerate(lists)]


def _check_sensors(sensors: Sequence[MeasuresSensor]) -> None:
    if not sensors:
        raise RecordingError("sensors: expected at least one, got none")
    names: set[str] = set()
    places: dict[tuple[str, int], str] = {}
    for sensor in sensors:
        if sensor.stream in names:
            raise RecordingError(f"sensors: two of them are called {sensor.stream!r}; give each its own name")
        other = places.setdefault((sensor.list, sensor.index), sensor.stream)
        if other != sensor.stream:
            raise RecordingError(
                f"sensors: {other!r} and {sensor.stream!r} are both {sensor.list}[{sensor.index}]; keep one"
            )
        names.add(sensor.stream)


@dataclass(slots=True, kw_only=True)
class _DeviceMessages:
    """Chooses the numbers of the wanted sensors and holds all messages to the lists of the first."""

    sensors: tuple[MeasuresSensor, ...]
    """The wanted sensors."""
    counts: list[int] | None = None
    """Sensors in each list of the first message."""

    def __call__(self, message: Bottle) -> list[int]:
        sizes = sensor_sizes(message)
        counts = [len(sensors) for sensors in sizes]
        if self.counts not in (None, counts):
            raise FormatError(
                f"expected lists of {_show(self.counts)} sensors as in the lines before, got {_show(counts)}; "
                "split the log here, or delete the line"
            )
        starts = np.cumsum([0, *chain(*sizes)]).tolist()
        firsts = np.cumsum([0, *counts]).tolist()
        chosen: list[int] = []
        for sensor in self.sensors:
            place = _ORDER.index(sensor.list)
            if sensor.index >= counts[place]:
                raise FormatError(
                    f"expected the sensor {sensor.stream!r} at {sensor.list}[{sensor.index}], got a list of "
                    f"{counts[place]} sensors; the indices count from 0"
                )
            columns = sensor.columns
            size = sizes[place][sensor.index]
            if size != len(columns) + 1:
                raise FormatError(
                    f"expected the {len(columns)} numbers {' '.join(columns)} of the sensor {sensor.stream!r} at "
                    f"{sensor.list}[{sensor.index}], got {size - 1}; is that the sensor that is meant?"
                )
            start = starts[firsts[place] + sensor.index]
            chosen.extend(range(start, start + size))
        self.counts = counts
        return chosen


def _show(counts: Sequence[int] | None) -> str:
    return " ".join(map(str, counts or ()))


def _size(sensor: BottleValue, place: int) -> int:
    match sensor:
        case (tuple() as vector, stamp) if is_number(stamp) and all(map(is_number, vector)):
            return len(vector) + 1
    name = _ORDER[place] if place < len(_ORDER) else f"number {place + 1}"
    raise FormatError(
        f"expected ((v1 ... vn) stamp) for each sensor in the list {name}, got something else; "
        "is this the measures port of a device?"
    )


def _reading(sensor: MeasuresSensor, values: FloatArray, log: PortLog) -> StreamReading:
    ticks = Signal.of_fixed("device_stamp", values[:, -1:])
    signals, findings = _signals(sensor, values[:, :-1])
    of_sensor = replace(log, findings=tuple(replace(finding, stream=sensor.stream) for finding in log.findings))
    return of_sensor.reading(sensor.stream, {**signals, ticks.quantity: ticks}, findings=findings)


def _signals(sensor: MeasuresSensor, values: FloatArray) -> tuple[dict[str, Signal], tuple[Finding, ...]]:
    if sensor.quantity == "orientation":
        return orientation_signals(
            values, sensor.orientation, unit=sensor.logged_units[0], frame=str(sensor.frame), stream=sensor.stream
        )
    scaled = values * [si_factor(unit)[1] for unit in sensor.logged_units]
    return {sensor.quantity: Signal.of_fixed(sensor.quantity, scaled, frame=sensor.frame)}, ()
