# SPDX-License-Identifier: BSD-3-Clause
"""The source and the corrector of lines on standard input, from the settings of a live run."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from forcetorque.base.errors import RecordingError, known_names
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.formats.headings import read_heading
from forcetorque.live.corrector import Corrector, CorrectorOptions
from forcetorque.live.option_values import HeldQuantity, Input, OffsetSource
from forcetorque.live.packets import NUMBERS
from forcetorque.live.settings import Settings, by_sensor, corrector_options, refuse
from forcetorque.live.sources import LineSource, Source
from forcetorque.live.text_lines import (
    STAMP_UNITS,
    CsvLines,
    LineForm,
    MeasuresLines,
    RosCsvLines,
    SensorColumns,
    YarpLines,
)

OF_LINES = ("channels", "variables", "status", "index", "stamp", "sequence", "gravity", "envelope")
"""What is stated of lines alone."""
_ALONG_BASE = ("actual_TCP_force", "O_F_ext_hat_K")
"""Fields of Universal Robots and Franka whose wrench is along the axes of the base, whatever the arm does."""
_OTHER_SPELLINGS = {"degC": {"C"}, "counts": {"LSB", "raw"}, "1": {"-"}}
"""How a unit that is expected may be written in brackets too, where it cannot be mistaken."""
_UNIT_ENDINGS = {"kn", "gf", "kgf", "lbf", "mnm", "knm", "ncm", "lbfin", "lbfft", "mv", "degf", "kelvin", "min"}
"""What is a unit behind a low line beside those that `read_heading` knows; also K and V, in capitals."""


def one_corrector(calibrations: Sequence[Calibration], what: str, options: CorrectorOptions) -> Corrector:
    """Make the corrector of a source of one sensor.

    Args:
        calibrations: What is stated.
        what: Name of the source.
        options: How samples are corrected.

    Returns:
        The corrector.

    Raises:
        RecordingError: If there is not one calibration.
    """
    if len(calibrations) != 1:
        raise RecordingError(f"{what} is one sensor: expected one calibration, got {len(calibrations)}")
    return Corrector(calibrations, options)


def require_gravity(settings: Settings, gravity: str | None, sensors: int = 1) -> None:
    """Check that a tool has gravity, and does something.

    Args:
        settings: What is stated.
        gravity: What gives gravity; None for nothing.
        sensors: How many sensors there are.

    Raises:
        RecordingError: If it has none, or does nothing.
    """
    if settings.tool_mass_kg is not None and sensors > 1:
        raise RecordingError(f"--tool-mass: the tool is of one sensor: expected one calibration, got {sensors}")
    if settings.tool_mass_kg is not None and gravity is None:
        raise RecordingError(
            "--tool-mass: a tool needs --gravity, three columns of a table (--input csv) with gravity in the frame of "
            "the reading; got none"
        )
    if settings.offset is OffsetSource.FITTED and not settings.take_tool_off:
        refuse(settings, "tool_mass_kg", of="--offset fitted without --take-tool-off")


def message_frames(settings: Settings, calibrations: Sequence[Calibration]) -> dict[str, str]:
    """Give the frame that messages of ROS 2 must have, by sensor: they name theirs, a calibration does not know it.

    Args:
        settings: What is stated.
        calibrations: A calibration per sensor.

    Returns:
        Frames by sensor.

    Raises:
        RecordingError: If a sensor has none.
    """
    frames = by_sensor("--frame", settings.frame, [one.sensor.name for one in calibrations])
    for one in calibrations:
        if one.sensor.name not in frames:
            raise RecordingError(
                f"sensor {one.sensor.name!r}: expected --frame, the frame_id of messages of its reading, along the "
                f"axes of the {one.sensor.frame} frame of its calibration, {one.sensor.measure_direction}; got none"
            )
    return frames


def _require_calibrated_frame(settings: Settings, calibrations: Sequence[Calibration]) -> None:
    """Check what is stated of the axes of columns, which a table does not name."""
    frames = by_sensor("--frame", settings.frame, [one.sensor.name for one in calibrations])
    for one in calibrations:
        got = frames.get(one.sensor.name)
        if got != one.sensor.frame:
            raise RecordingError(
                f"sensor {one.sensor.name!r}: expected --frame {one.sensor.frame}, the frame of its calibration: "
                f"columns are along its axes, {one.sensor.measure_direction}, by the prior matrix; got {got or 'none'}"
            )


def line_source(
    settings: Settings, calibrations: Sequence[Calibration], descriptor: int, warn: Callable[[str], None]
) -> tuple[Source, tuple[Corrector, ...]]:
    """Make the source of lines, and its corrector.

    Args:
        settings: What is stated.
        calibrations: A calibration per sensor.
        descriptor: Descriptor of standard input.
        warn: Called with the reason for the first line that is no sample.

    Returns:
        The source, and the corrector.

    Raises:
        RecordingError: If something is not stated that is needed, or stated that is not.
    """
    form = settings.form
    if settings.quantity is None:
        raise RecordingError("expected --quantity raw (counts) or wrench (by the prior matrix; N, N m), got none")
    if form is Input.ROS2_CSV and settings.quantity is not HeldQuantity.WRENCH:
        raise RecordingError("--input ros2-csv: expected --quantity wrench, which such messages hold")
    options = corrector_options(settings, settings.quantity)
    reader: LineForm
    if form in (Input.YARP, Input.ROS2_CSV):
        corrector = one_corrector(calibrations, f"--input {form}", options)
        refuse(settings, *OF_LINES[:7], "envelope" if form is Input.ROS2_CSV else "frame")
        require_gravity(settings, None)
        if corrector.variables[0]:
            raise RecordingError(
                f"--input {form}: the calibration needs {', '.join(corrector.variables[0])}, which such lines lack; "
                "take --input csv or yarp-measures"
            )
        if form is Input.ROS2_CSV:
            (frame,) = message_frames(settings, calibrations).values()
            reader = RosCsvLines(frame=frame)
        else:
            _require_stamps(settings, settings.envelope, "--envelope")
            reader = YarpLines(channels=corrector.channels, envelope=settings.envelope)
    else:
        corrector = Corrector(calibrations, options)
        sensors = _sensor_columns(settings, calibrations)
        if form is Input.CSV:
            refuse(settings, "index", "envelope")
            if settings.quantity is HeldQuantity.RAW:
                refuse(settings, "frame", of="--quantity raw, which has no axes")
            else:
                _require_calibrated_frame(settings, calibrations)
            require_gravity(settings, settings.gravity, len(calibrations))
            gravity = () if settings.gravity is None else tuple(settings.gravity.split(","))
            if len(gravity) not in (0, 3):
                raise RecordingError(f"--gravity: expected three columns between commas, got {settings.gravity!r}")
            for column in gravity:
                _require_unit("--gravity", column, "m/s2")
            _require_stamps(settings, settings.stamp is not None, "--stamp")
            sequence, numbers = _sequence(settings.sequence)
            reader = CsvLines(
                sensors=sensors, stamp=_stamp(settings.stamp), sequence=sequence, gravity=gravity, numbers=numbers
            )
        else:
            refuse(settings, "channels", "status", "stamp", "sequence", "gravity", "frame")
            require_gravity(settings, None)
            _require_stamps(settings, settings.envelope, "--envelope")
            reader = MeasuresLines(sensors=sensors, envelope=settings.envelope)
    return LineSource(descriptor, reader, rate_hz=settings.rate_hz, warn=warn), (corrector,)


def _require_stamps(settings: Settings, there: bool, option: str) -> None:
    if settings.rate_hz is not None and not there:
        raise RecordingError(f"--rate: gaps in time need the time of the sender: expected {option} too, got none")


def _require_unit(option: str, column: str, expected: str) -> None:
    """Refuse a column whose heading states another unit, known or not; one that states none is what the option says."""
    heading = read_heading(column)
    unit = heading.unit or heading.bracketed
    if unit is None:
        ending = column.strip().rpartition("_")[2]
        unit = ending if ending.lower() in _UNIT_ENDINGS or ending in ("K", "V") else None
    elif unit.isdigit():  # the place in an array
        unit = None
    if unit and unit != expected and unit not in _OTHER_SPELLINGS.get(expected, ()):
        raise RecordingError(
            f"{option} {column}: expected {expected}, got a heading with the unit {unit}; convert the column, or "
            "correct its heading"
        )


def _sequence(text: str | None) -> tuple[str | None, int]:
    if text is None:
        return None, NUMBERS
    column, colon, count = text.rpartition(":")
    if not colon:
        column, count = text, str(NUMBERS)
    if not column or not _is_index(count, digits=19) or int(count) < 2:
        raise RecordingError(f"--sequence: expected COLUMN or COLUMN:COUNT, how many numbers there are, got {text!r}")
    return column, int(count)


def _stamp(text: str | None) -> tuple[str, str] | None:
    if text is None:
        return None
    column, colon, unit = text.rpartition(":")
    if not colon or unit not in STAMP_UNITS:
        raise RecordingError(f"--stamp: expected COLUMN:UNIT with one of {', '.join(STAMP_UNITS)}, got {text!r}")
    _require_unit("--stamp", column, unit)
    return column, unit


def _sensor_columns(settings: Settings, calibrations: Sequence[Calibration]) -> list[SensorColumns]:
    names = [one.sensor.name for one in calibrations]
    channels = by_sensor("--channels", settings.channels, names)
    status = by_sensor("--status", settings.status, names)
    index = by_sensor("--index", settings.index, names)
    variables = _variables(settings.variables, calibrations)
    own_columns = {name: tuple(part.strip() for part in text.split(",")) for name, text in channels.items()}
    every = [column for own in own_columns.values() for column in own]
    if twice := [column for column in every if every.count(column) > 1]:
        raise RecordingError(f"--channels: expected every column once, got {twice[0]!r} {every.count(twice[0])} times")
    sensors = []
    for one in calibrations:
        name, count = one.sensor.name, one.matrix.shape[1]
        own = own_columns.get(name, ())
        if settings.form is Input.CSV and len(own) != count:
            raise RecordingError(
                f"sensor {name!r}: expected --channels with {count} columns, in the order of its calibration, got "
                f"{len(own)}"
            )
        units = ("counts",) * count if settings.quantity is HeldQuantity.RAW else ("N",) * 3 + ("N m",) * 3
        for column, unit in zip(own, units, strict=False):
            _require_unit("--channels", column, unit)
        if turned := [column for column in own if any(field in column for field in _ALONG_BASE)]:
            raise RecordingError(
                f"--channels {turned[0]}: expected columns along the axes of sensor {name!r}, got a field of the "
                "arm along the axes of the base; take --replay EXPERIMENT, which turns them to the flange "
                "(`payload LOG --save-experiment EXPERIMENT` writes it)"
            )
        if settings.form is Input.YARP_MEASURES and not _is_index(index.get(name, "")):
            raise RecordingError(
                f"sensor {name!r}: expected --index, its index from 0 in the list of force-torque sensors: the order "
                f"is of the configuration of the device; got {index.get(name)!r}"
            )
        if settings.form is Input.YARP_MEASURES and not all(map(_is_index, variables[name])):
            raise RecordingError(
                f"sensor {name!r}: expected --variable NAME=INDEX, an index from 0 in the list of temperatures, got "
                f"{', '.join(variables[name])}"
            )
        sensors.append(
            SensorColumns(
                name=name,
                channels=own,
                variables=variables[name],
                status=status.get(name),
                index=int(index.get(name, 0)),
            )
        )
    return sensors


def _is_index(text: str, digits: int = 9) -> bool:
    return text.isascii() and text.isdigit() and len(text) <= digits


def _variables(entries: Sequence[str], calibrations: Sequence[Calibration]) -> Mapping[str, tuple[str, ...]]:
    units = {(one.sensor.name, variable.name): variable.unit for one in calibrations for variable in one.variables}
    wanted = {(one.sensor.name, variable.name): "" for one in calibrations for variable in one.variables}
    for entry in entries:
        name, _, column = entry.partition("=")
        sensor, dot, variable = name.rpartition(".")
        keys = [key for key in wanted if key[1] == variable and (not dot or key[0] == sensor)]
        if not keys or not column:
            known = known_names(name, [f"{one}.{other}" for one, other in wanted])
            raise RecordingError(f"--variable {entry}: expected [SENSOR.]NAME=COLUMN; {known}")
        wanted |= dict.fromkeys(keys, column)
    for (sensor, variable), column in wanted.items():
        if not column:
            raise RecordingError(
                f"sensor {sensor!r}: its calibration needs {variable!r}; expected --variable {variable}=COLUMN"
            )
        _require_unit("--variable", column, units[sensor, variable])
    return {
        one.sensor.name: tuple(wanted[one.sensor.name, variable.name] for variable in one.variables)
        for one in calibrations
    }
