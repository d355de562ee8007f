# SPDX-License-Identifier: BSD-3-Clause
"""C3D files as a format of logs: the wrench of every force plate, and markers as points.

The sign of a wrench is that of the file, which the format does not fix: some systems write the force of the plate on
the body, others the opposite. `measure_direction` of an experiment states it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import FormatError
from forcetorque.base.toml_file import checked_tables
from forcetorque.formats.c3d.c3d_file import C3dFile, is_c3d, read_c3d
from forcetorque.formats.c3d.force_platform import ForcePlate, force_plates, plate_names, undetermined_keys, zero_frames
from forcetorque.formats.c3d.plate_conventions import (
    QUESTIONS,
    C3dLog,
    factor_of,
    require_open,
    stated_unit,
    unanswered,
)
from forcetorque.formats.log_format import LogContext, LogDescription, LogReading
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import Signal, Stream

_CLOCK = "frames"
"""Name of the clock of frames and samples, which the file counts and does not stamp."""
_UNITS = ("length_unit", "force_unit", "moment_unit")
"""Keys without which there is no wrench."""


class C3dFormat:
    """Files of motion capture with force plates of types 1 to 4."""

    table = C3dLog
    sign = "a C3D file (second byte 80)"

    def recognises(self, path: Path) -> bool:
        """Look at the magic byte and the code of the processor."""
        return is_c3d(path)

    def describe(self, path: Path) -> LogDescription:
        """Read all of it; without wrenches where a unit is open, about the sensor where the sign of ORIGIN is."""
        return self.describe_specified(path, {})

    def describe_specified(self, path: Path, specified: Mapping[str, object]) -> LogDescription:
        """Read all of it, with keys of the table that the file leaves open."""
        file = read_c3d(path)
        table = checked_tables({"format": "c3d", "path": path, **specified}, C3dLog, path)
        require_open(table, undetermined_keys(file))
        undetermined = {key: QUESTIONS[key] for key in unanswered(table, undetermined_keys(file))}
        reading = _reading(file, table, undetermined)
        read = {stream.name for stream in reading.streams}
        return LogDescription(
            table=table,
            reading=reading,
            undetermined=undetermined,
            sensors_apart=True,
            unread_wrenches=tuple(name for name in plate_names(file) if name not in read),
        )

    def read(self, specified: C3dLog, context: LogContext) -> LogReading:
        """Read the wrenches about the centres of the surfaces, and the markers."""
        return _reading(determined_file(context.file(specified.path), specified), specified, {})


def determined_file(path: Path, table: C3dLog) -> C3dFile:
    """Read a file of which nothing is left open.

    Args:
        path: The file.
        table: What the file does not determine.

    Returns:
        The file.

    Raises:
        FormatError: If a key lacks, or one is stated that the file determines.
    """
    file = read_c3d(path)
    keys = undetermined_keys(file)
    require_open(table, keys)
    for key in unanswered(table, keys):
        raise FormatError(
            f"{path}: {key}: expected {QUESTIONS[key]}; got none: state it by {key} of [recording] "
            f"in an experiment file, by --recording {key}=VALUE of a command without one"
        )
    return file


def _reading(file: C3dFile, table: C3dLog, undetermined: Mapping[str, str]) -> LogReading:
    plates = () if set(_UNITS) & set(undetermined) else force_plates(file, table)
    streams = [_plate_stream(file, plate) for plate in plates]
    length = factor_of(stated_unit(file.length_unit) or table.length_unit, "m")
    if length is not None:
        streams += _marker_streams(file, length, {stream.name for stream in streams})
    return LogReading(
        streams=tuple(streams),
        findings=tuple(_findings(file, plates, undetermined)),
        origin={"format": "c3d", **{f"{plate.name}_corners_m": _corner_text(plate) for plate in plates}},
    )


def _stamps(count: int, rate_hz: float) -> IntArray:
    return np.round(np.arange(count) * (1e9 / rate_hz)).astype(np.int64)


def _plate_stream(file: C3dFile, plate: ForcePlate) -> Stream:
    return Stream(
        name=plate.name,
        clock=_CLOCK,
        stamp_ns=_stamps(len(plate.wrench), file.analog_rate_hz),
        signals={"wrench": Signal.of_fixed("wrench", plate.wrench, frame=plate.frame)},
    )


def _marker_streams(file: C3dFile, length: float, taken: set[str]) -> Iterator[Stream]:
    """A stream of each marker that was seen; one without a label, or with that of another one, has its number."""
    stamp_ns = _stamps(len(file.markers), file.frame_rate_hz)
    for k, label in enumerate(file.marker_labels):
        positions: FloatArray = length * file.markers[:, k]
        name = label if label and label not in taken else f"marker{k + 1}"
        if name in taken or not np.isfinite(positions).any():
            continue
        taken.add(name)
        signal = Signal.of_fixed("translation", positions, frame=name)
        yield Stream(name=name, clock=_CLOCK, stamp_ns=stamp_ns, signals={"translation": signal})


def _corner_text(plate: ForcePlate) -> str:
    if plate.corners_m is None:
        return "none"
    return "; ".join(" ".join(f"{value:.4f}" for value in corner) for corner in plate.corners_m)


def _findings(file: C3dFile, plates: tuple[ForcePlate, ...], undetermined: Mapping[str, str]) -> Iterator[Finding]:
    first = plates[0].name if plates else "plate1"
    for key, words in undetermined.items():
        message = f"{key}: neither log nor format says: {words}"
        yield Finding(stream=first, kind="undetermined", message=message, count=1)
    if (zero := zero_frames(file)) is not None and plates:
        message = f"the mean of frames {zero[0]} to {zero[1]} is subtracted, as FORCE_PLATFORM:ZERO states"
        yield Finding(stream=first, kind="zeroed", message=message, count=len(file.analog))
    for plate in plates:
        if plate.corners_m is None:
            message = f"plate {plate.number}: CORNERS are those of no rectangle: it has no place among the markers"
            yield Finding(stream=plate.name, kind="corners", message=message, count=1)
    if "FORCE_PLATFORM:FPCOPPOLY" in file.parameters and any(plate.type == 3 for plate in plates):
        message = "FPCOPPOLY, the correction of the centre of pressure by its maker, is not applied"
        yield Finding(stream=first, kind="not_applied", message=message, count=1)
