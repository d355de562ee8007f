# SPDX-License-Identifier: BSD-3-Clause
"""Lines of text as samples: tables with a heading, bottles of YARP, and wrenches of `ros2 topic echo --csv`."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError, RecordingError, known_names, quoted
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.formats.yarp.measures import MeasuresList
from forcetorque.formats.yarp.message import Bottle, BottleValue, parse_bottle
from forcetorque.live.packets import NUMBERS, Packet
from forcetorque.live.sample_status import Status, status_of_device

_GRAVITY = (0.5 * STANDARD_GRAVITY, 1.5 * STANDARD_GRAVITY)
"""Least and largest free fall of a sample: a column in g, in mm/s2 or without a value lies outside; m/s2."""
STAMP_UNITS = {"s": 10**9, "ms": 10**6, "us": 10**3, "ns": 1}
"""Nanoseconds of the units that stamps may have."""
_ENVELOPE_NUMBERS = 1 << 15
"""Numbers of an envelope, `yarp::os::Stamp::getMaxCount`."""


class LineForm(Protocol):
    """Makes samples of lines."""

    @property
    def numbers(self) -> int:
        """Numbers of the packets, as of `PacketAccount`."""

    def packet(self, line: str) -> Packet | None:
        """Read a line.

        Args:
            line: The line without its end.

        Returns:
            The sample; None for a heading.

        Raises:
            FormatError: If the line is no sample.
        """


@dataclass(frozen=True, slots=True, kw_only=True)
class SensorColumns:
    """Where the numbers of one sensor are: names of columns of a table, or indices of lists of a device."""

    name: str
    """Name of the sensor."""
    channels: tuple[str, ...] = ()
    """Columns of its channels, in the order of the calibration."""
    variables: tuple[str, ...] = ()
    """Columns of its variables, or indices in the list of temperatures, in the order of the calibration."""
    status: str | None = None
    """Column with the code of the device, a `DeviceStatus`; None for none."""
    index: int = 0
    """Index in the list of force-torque sensors of a device."""


def stamp_of(text: str, unit: str) -> int:
    """Read a time exactly.

    Args:
        text: Decimal number.
        unit: Its unit, of `STAMP_UNITS`.

    Returns:
        Nanoseconds.

    Raises:
        FormatError: If it is no number, or has no place in 64 bits.
    """
    return _within_64_bits(_nanoseconds(text, unit), f"{text} {unit}")


def _within_64_bits(stamp_ns: int, text: str) -> int:
    if not -(1 << 63) <= stamp_ns < 1 << 63:
        raise FormatError(f"expected a time within 292 years of 1970, got {quoted(text)}")
    return stamp_ns


def _nanoseconds(text: str, unit: str) -> int:
    factor = STAMP_UNITS[unit]
    whole, point, fraction = text.partition(".")
    try:
        if factor > 1 and point and fraction.isascii() and fraction.isdigit():
            sign = -1 if whole.startswith("-") else 1
            digits = len(str(factor)) - 1
            return int(whole or "0") * factor + sign * int(fraction[:digits].ljust(digits, "0"))
        return int(text) * factor
    except ValueError:
        value = _number(text) * factor
        if not math.isfinite(value):
            raise FormatError(f"expected a time, got {quoted(text)}") from None
        return round(value)


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise FormatError(f"expected a number, got {quoted(text)}") from None


@dataclass(slots=True, kw_only=True)
class CsvLines:
    """A table whose first line is its heading, between commas or, where that has none, semicolons, tabs or blanks."""

    sensors: Sequence[SensorColumns]
    """Columns of the sensors."""
    stamp: tuple[str, str] | None = None
    """Column with the time, and its unit; None without."""
    sequence: str | None = None
    """Column with the number of the packet; None without."""
    gravity: tuple[str, ...] = ()
    """Columns with gravity in the frame of the reading, m/s2; none without."""
    numbers: int = NUMBERS
    """Numbers of the packets, as of `PacketAccount`."""
    _places: Mapping[str, int] = field(default_factory=dict)
    _count: int = 0
    _separator: str | None = ","

    def packet(self, line: str) -> Packet | None:
        """Read a line, as of `LineForm`; the heading must have all columns that are named.

        Args:
            line: The line.

        Returns:
            The sample; None for the heading.

        Raises:
            RecordingError: If the heading lacks a column.
            FormatError: If the line is no sample.
        """
        if not self._places:
            self._separator = next((mark for mark in (",", ";", "\t") if mark in line), None)
        cells = line.split(self._separator)
        if not self._places:
            self._read_heading([cell.strip().strip('"').removeprefix("\ufeff") for cell in cells])
            return None
        if len(cells) != self._count:
            raise FormatError(f"expected {self._count} columns, got {len(cells)}")
        width = max(len(sensor.channels) for sensor in self.sensors)
        values = np.zeros((len(self.sensors), width))
        variables = np.zeros((len(self.sensors), max(len(sensor.variables) for sensor in self.sensors)))
        for k, sensor in enumerate(self.sensors):
            values[k, : len(sensor.channels)] = [self._value(cells, name) for name in sensor.channels]
            variables[k, : len(sensor.variables)] = [self._value(cells, name) for name in sensor.variables]
        return Packet(
            values=values,
            variables=variables,
            stamp_ns=None
            if self.stamp is None
            else stamp_of(cells[self._places[self.stamp[0]]].strip(), self.stamp[1]),
            sequence=None if self.sequence is None else self._sequence_number(cells, self.sequence),
            gravity=self._free_fall(cells) if self.gravity else None,
            faults=[
                0 if one.status is None else int(status_of_device(self._integer(cells, one.status)))
                for one in self.sensors
            ],
        )

    def _read_heading(self, names: list[str]) -> None:
        wanted = [name for sensor in self.sensors for name in (*sensor.channels, *sensor.variables)]
        wanted += [sensor.status for sensor in self.sensors if sensor.status is not None]
        wanted += [*self.gravity, *([self.stamp[0]] if self.stamp else []), *([self.sequence] if self.sequence else [])]
        for name in wanted:
            if names.count(name) != 1:
                got = "twice" if name in names else "none"
                raise RecordingError(f"heading: expected one column {name!r}, got {got}; {known_names(name, names)}")
        self._places = {name: place for place, name in enumerate(names)}
        self._count = len(names)

    def _free_fall(self, cells: list[str]) -> FloatArray:
        gravity = np.array([self._value(cells, name) for name in self.gravity])
        least, largest = _GRAVITY
        size = float(np.linalg.norm(gravity))
        if size < least or size > largest:
            raise FormatError(f"gravity: expected free fall of {least:.1f} to {largest:.1f} m/s2, got {size:.3g}")
        return gravity

    def _value(self, cells: list[str], name: str) -> float:
        text = cells[self._places[name]].strip()
        return _number(text) if text else math.nan

    def _sequence_number(self, cells: list[str], name: str) -> int:
        number = self._integer(cells, name)
        if not 0 <= number < self.numbers:
            raise FormatError(
                f"column {name!r}: expected a number from 0 to {self.numbers - 1}, got {quoted(str(number))}; "
                f"state how many numbers there are by --sequence {name}:COUNT"
            )
        return number

    def _integer(self, cells: list[str], name: str) -> int:
        text = cells[self._places[name]].strip()
        try:
            return int(text)
        except ValueError:
            raise FormatError(f"column {name!r}: expected an integer, got {quoted(text)}") from None


@dataclass(frozen=True, slots=True, kw_only=True)
class YarpLines:
    """Lines of `yarp read` from the port of one sensor: its channels and nothing else."""

    channels: int
    """Channels of the sensor."""
    envelope: bool
    """Whether number and time (s) of the sender stand in front, as `yarp read PORT REMOTE envelope` writes them."""
    numbers: int = _ENVELOPE_NUMBERS
    """As of `CsvLines`."""

    def packet(self, line: str) -> Packet | None:
        """Read a line, as of `LineForm`.

        Args:
            line: The line.

        Returns:
            The sample.

        Raises:
            FormatError: If the line is no sample.
        """
        sequence, stamp_ns, rest = _envelope(line) if self.envelope else (None, None, line)
        words = rest.split()
        if len(words) != self.channels:
            raise FormatError(f"expected {self.channels} numbers, got {len(words)}")
        return Packet(values=np.array([[_number(word) for word in words]]), stamp_ns=stamp_ns, sequence=sequence)


def _envelope(line: str) -> tuple[int, int, str]:
    words = line.split(None, 2)
    if len(words) < 3 or not (words[0].isascii() and words[0].isdigit()):
        raise FormatError(f"expected number and time of the envelope, got {quoted(line)}")
    return int(words[0]), stamp_of(words[1], "s"), words[2]


@dataclass(slots=True, kw_only=True)
class MeasuresLines:
    """Lines of `yarp read` from `measures:o` of a device with several sensors: a list per kind of sensor."""

    sensors: Sequence[SensorColumns]
    """Indices of the sensors in the lists of force-torque sensors and of temperatures."""
    envelope: bool
    """As of `YarpLines`."""
    numbers: int = _ENVELOPE_NUMBERS
    """As of `CsvLines`."""
    _board_stamps: dict[str, float] = field(default_factory=dict)

    def packet(self, line: str) -> Packet | None:
        """Read a line, as of `LineForm`. A sensor whose own stamp is that of the message before is repeated.

        Args:
            line: The line.

        Returns:
            The sample; NaN for a sensor whose list is empty.

        Raises:
            FormatError: If the line is no sample.
        """
        sequence, stamp_ns, rest = _envelope(line) if self.envelope else (None, None, line)
        lists = parse_bottle(rest)
        wrenches = _sensors_in(lists, MeasuresList.SIX_AXIS_FORCE_TORQUE)
        temperatures = _sensors_in(lists, MeasuresList.TEMPERATURE)
        values = np.full((len(self.sensors), 6), math.nan)
        variables = np.full((len(self.sensors), max(len(sensor.variables) for sensor in self.sensors)), math.nan)
        faults = [0] * len(self.sensors)
        for k, sensor in enumerate(self.sensors):
            if wrenches:
                _require_index(sensor.name, sensor.index, len(wrenches))
                numbers, stamp = wrenches[sensor.index]
                if len(numbers) != 6:
                    raise FormatError(f"sensor {sensor.name!r}: expected six numbers, got {len(numbers)}")
                values[k] = numbers
                faults[k] = int(Status.REPEATED) if self._board_stamps.get(sensor.name) == stamp else 0
                self._board_stamps[sensor.name] = stamp
            for place, index in enumerate(sensor.variables):
                if temperatures:
                    _require_index(sensor.name, int(index), len(temperatures))
                    variables[k, place] = temperatures[int(index)][0][0]
        return Packet(values=values, variables=variables, stamp_ns=stamp_ns, sequence=sequence, faults=faults)


def _require_index(sensor: str, index: int, count: int) -> None:
    if index >= count:
        raise FormatError(f"sensor {sensor!r}: index {index}, the list has {count}")


def _sensors_in(lists: Bottle, kind: MeasuresList) -> list[tuple[list[float], float]]:
    """Numbers and own stamp of every sensor of a list."""
    place = tuple(MeasuresList).index(kind)
    if len(lists) <= place or not all(isinstance(entry, tuple) for entry in lists):
        raise FormatError(f"expected a list per kind of sensor, got {len(lists)} elements")
    members = lists[place]
    return [_sensor(member, kind) for member in members] if isinstance(members, tuple) else []


def _sensor(member: BottleValue, kind: MeasuresList) -> tuple[list[float], float]:
    if isinstance(member, tuple) and len(member) == 2:
        values, stamp = member
        if isinstance(values, tuple) and isinstance(stamp, int | float):
            numbers = [float(one) for one in values if isinstance(one, int | float)]
            if len(numbers) == len(values) and numbers:
                return numbers, float(stamp)
    raise FormatError(f"{kind}: expected ((numbers) stamp) of every sensor, got another form")


@dataclass(frozen=True, slots=True, kw_only=True)
class RosCsvLines:
    """Lines of `ros2 topic echo --csv` of `geometry_msgs/WrenchStamped`: stamp, frame, force in N, moment in N m."""

    frame: str | None = None
    """Frame that all messages must be in; None for any."""
    numbers: int = NUMBERS
    """As of `CsvLines`; these lines have none."""

    def packet(self, line: str) -> Packet | None:
        """Read a line, as of `LineForm`.

        Args:
            line: The line.

        Returns:
            The sample.

        Raises:
            FormatError: If the line is no sample.
        """
        cells = line.split(",")
        if len(cells) != 3 + len(WRENCH_COMPONENTS):
            raise FormatError(f"expected sec,nanosec,frame_id,fx,fy,fz,tx,ty,tz, got {len(cells)} columns")
        if self.frame is not None and cells[2].strip() != self.frame:
            raise FormatError(f"frame: expected {self.frame!r}, got {quoted(cells[2])}")
        stamp_ns = stamp_of(cells[0].strip(), "s") + stamp_of(cells[1].strip(), "ns")
        _within_64_bits(stamp_ns, f"{cells[0]},{cells[1]}")
        return Packet(values=np.array([[_number(cell) for cell in cells[3:]]]), stamp_ns=stamp_ns)
