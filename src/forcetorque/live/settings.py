# SPDX-License-Identifier: BSD-3-Clause
"""From what is stated on the command line to the source and the correctors of a live run."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any

import numpy as np

from forcetorque.base.errors import ForceTorqueError, RecordingError, known_names
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.live.bias_tracking import Tracking
from forcetorque.live.choices import FaultPolicy, HeldQuantity, Input, OffsetSource
from forcetorque.live.corrector import Corrector, CorrectorOptions
from forcetorque.live.net_ft import RDT_PORT, CountUnits, NetFtSource, fetch_units
from forcetorque.live.replay import ReplayedGroup, ReplaySource, replayed_groups
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
from forcetorque.live.tool import Tool


@dataclass(frozen=True, slots=True, kw_only=True)
class Settings:
    """What is stated of a live run; every option of the command by its name."""

    form: Input | None = None
    """Form of the lines on standard input."""
    quantity: HeldQuantity | None = None
    """What samples hold."""
    channels: Sequence[str] = ()
    """`[SENSOR=]COLUMN,COLUMN,...`."""
    variables: Sequence[str] = ()
    """`[SENSOR.]NAME=COLUMN`, or an index in the list of temperatures."""
    status: Sequence[str] = ()
    """`[SENSOR=]COLUMN`."""
    index: Sequence[str] = ()
    """`[SENSOR=]INDEX` in the list of force-torque sensors."""
    stamp: str | None = None
    """`COLUMN:UNIT`."""
    sequence: str | None = None
    """Column of packet numbers."""
    gravity: str | None = None
    """Three columns."""
    envelope: bool = False
    """Whether lines of YARP begin with number and time."""
    frame: str | None = None
    """Frame of the messages of ROS 2."""
    rate_hz: float | None = None
    """Rate of the sender; Hz."""
    replay: Path | None = None
    """Experiment file."""
    speed: float = 1.0
    """Times as fast as it was recorded; 0 for as fast as possible."""
    ati: str | None = None
    """Address of a box."""
    ati_port: int = RDT_PORT
    """Its port."""
    ati_force: str | None = None
    """Unit of a count of force."""
    ati_torque: str | None = None
    """Unit of a count of moment."""
    offset: OffsetSource = OffsetSource.FITTED
    """Where the offset comes from."""
    session: str | None = None
    """Power cycle that gives the fitted offset."""
    tare_s: float = 1.0
    """Time that a tare takes; s."""
    tool_mass_kg: float | None = None
    """Mass of the tool; kg."""
    tool_centre_m: str | None = None
    """Its centre of mass in the frame of the reading; x,y,z; m."""
    take_tool_off: bool = False
    """Whether its weight is taken off."""
    random_walk: str | None = None
    """Random walk of the bias in an hour; N,N m."""
    tracking_noise: str | None = None
    """Noise that is neither bias nor load; N,N m."""
    with_temperature: bool = False
    """Whether a part of the tracked bias is linear in temperature."""
    policy: FaultPolicy = FaultPolicy.FLAG
    """What becomes of samples with a fault."""
    limit_counts: float | None = None
    """Limit of the converter; counts."""
    frozen_after_s: float = 0.5
    """Time for which channels may repeat a reading; s; 0 for any."""


def corrector_options(settings: Settings, quantity: HeldQuantity) -> CorrectorOptions:
    """Give the options of the correctors.

    Args:
        settings: What is stated.
        quantity: What samples hold.

    Returns:
        The options.

    Raises:
        RecordingError: If a number is out of range, or mass or centre of the tool is missing.
    """
    if (settings.tool_mass_kg is None) != (settings.tool_centre_m is None):
        raise RecordingError("expected both --tool-mass and --tool-centre, or neither of them")
    tool = None
    if settings.tool_mass_kg is not None and settings.tool_centre_m is not None:
        tool = Tool(
            mass_kg=settings.tool_mass_kg, centre_m=np.array(_numbers("--tool-centre", settings.tool_centre_m, 3))
        )
    tracking = Tracking(with_temperature=settings.with_temperature)
    if settings.random_walk is not None:
        force, moment = _numbers("--random-walk", settings.random_walk, 2)
        tracking = replace(tracking, random_walk_N=force, random_walk_Nm=moment)
    if settings.tracking_noise is not None:
        force, moment = _numbers("--tracking-noise", settings.tracking_noise, 2)
        tracking = replace(tracking, noise_N=force, noise_Nm=moment)
    return CorrectorOptions(
        quantity=quantity,
        session=settings.session,
        offset=settings.offset,
        tare_s=settings.tare_s,
        policy=settings.policy,
        limit_counts=settings.limit_counts,
        frozen_after_s=settings.frozen_after_s or math.inf,
        tool=tool,
        take_tool_off=settings.take_tool_off,
        tracking=tracking,
    )


def _numbers(option: str, text: str, count: int) -> list[float]:
    try:
        values = [float(part) for part in text.split(",")]
    except ValueError:
        values = []
    if len(values) != count or not all(map(math.isfinite, values)):
        raise RecordingError(f"{option}: expected {count} numbers between commas, got {text!r}")
    return values


def make_run(
    settings: Settings,
    calibrations: Sequence[Calibration],
    *,
    descriptor: int,
    warn: Callable[[str], None],
    clock: Callable[[], float] = time.monotonic,
) -> tuple[Source, tuple[Corrector, ...]]:
    """Make source and correctors.

    Args:
        settings: What is stated.
        calibrations: A calibration per sensor.
        descriptor: Descriptor of standard input.
        warn: Called with what a person should know.
        clock: Gives seconds.

    Returns:
        The source, and a corrector for each of its groups.

    Raises:
        RecordingError: If something is not stated that is needed, or stated that is not.
    """
    names = [one.sensor.name for one in calibrations]
    if len(set(names)) < len(names):
        raise RecordingError(f"expected one calibration per sensor, got {', '.join(names)}")
    if settings.rate_hz is not None and not settings.rate_hz > 0.0:
        raise RecordingError(f"--rate: expected a number above 0, got {settings.rate_hz:g}")
    if not 0 < settings.ati_port < 1 << 16:
        raise RecordingError(f"--ati-port: expected a port from 1 to 65535, got {settings.ati_port}")
    stated = {"--input": settings.form, "--replay": settings.replay, "--ati": settings.ati}
    if sum(value is not None for value in stated.values()) != 1:
        got = ", ".join(name for name, value in stated.items() if value is not None) or "none"
        raise RecordingError(
            f"expected one of --input FORM of the lines on standard input, --replay and --ati, got {got}"
        )
    if settings.replay is None:
        _refuse(settings, "speed")
    if settings.ati is None:
        _refuse(settings, "ati_port", "ati_force", "ati_torque")
    if settings.offset is not OffsetSource.TRACKED:
        _refuse(settings, "random_walk", "tracking_noise", "with_temperature", of=f"--offset {settings.offset}")
    if settings.offset is OffsetSource.FITTED:
        _refuse(settings, "tare_s", of=f"--offset {settings.offset}")
    if settings.replay is not None:
        _refuse(settings, *_OF_LINES)
        return _replayed(settings, calibrations, clock)
    if settings.ati is not None:
        _refuse(settings, *_OF_LINES, "rate_hz")
        if settings.quantity is HeldQuantity.RAW:
            raise RecordingError("--quantity raw: a box sends wrenches")
        corrector = _only(calibrations, "a box", corrector_options(settings, HeldQuantity.WRENCH))
        _require_gravity(settings, None)
        return _box(settings, clock), (corrector,)
    return _lines(settings, calibrations, descriptor, warn)


def _require_gravity(settings: Settings, gravity: str | None, sensors: int = 1) -> None:
    if settings.tool_mass_kg is not None and sensors > 1:
        raise RecordingError(f"--tool-mass: the tool is of one sensor: expected one calibration, got {sensors}")
    if settings.tool_mass_kg is not None and gravity is None:
        raise RecordingError(
            "--tool-mass: a tool needs --gravity, three columns of a table (--input csv) with gravity in the frame of "
            "the reading; got none"
        )
    if settings.offset is OffsetSource.FITTED and not settings.take_tool_off:
        _refuse(settings, "tool_mass_kg", of="--offset fitted without --take-tool-off")


def _require_stamps(settings: Settings, there: bool, option: str) -> None:
    if settings.rate_hz is not None and not there:
        raise RecordingError(f"--rate: gaps in time need the time of the sender: expected {option} too, got none")


def _only(calibrations: Sequence[Calibration], what: str, options: CorrectorOptions) -> Corrector:
    if len(calibrations) != 1:
        raise RecordingError(f"{what} is one sensor: expected one calibration, got {len(calibrations)}")
    return Corrector(calibrations, options)


def _box(settings: Settings, clock: Callable[[], float]) -> NetFtSource:
    host = settings.ati or ""
    if (settings.ati_force is None) != (settings.ati_torque is None):
        raise RecordingError("expected both --ati-force and --ati-torque, or neither of them to ask the box")
    if settings.ati_force is not None and settings.ati_torque is not None:
        units = CountUnits.of(settings.ati_force, settings.ati_torque)
    else:
        units = fetch_units(host)
    return NetFtSource(host, units, clock=clock, port=settings.ati_port)


def _replayed(
    settings: Settings, calibrations: Sequence[Calibration], clock: Callable[[], float]
) -> tuple[Source, tuple[Corrector, ...]]:
    from forcetorque.experiment.loading import load_experiment

    _require_gravity(settings, None)
    if settings.replay is None or settings.speed < 0.0:
        raise RecordingError(f"--speed: expected 0 or more, got {settings.speed}")
    experiment = load_experiment(settings.replay)
    groups = replayed_groups(experiment, calibrations)
    for group in groups:
        if settings.quantity not in (None, group.quantity):
            raise RecordingError(f"--quantity {settings.quantity}: the recording holds {group.quantity}")
    if settings.session is None:
        # offline takes the offset of the power cycle that was recorded
        names = experiment.session_names(None)
        correctors = [_in_session_of(group, names, settings) for group in groups]
    else:
        correctors = [Corrector(group.calibrations, corrector_options(settings, group.quantity)) for group in groups]
    source = ReplaySource(
        groups, speed=settings.speed or math.inf, rate_hz=settings.rate_hz, clock=clock, sleep=time.sleep
    )
    return source, tuple(correctors)


def _in_session_of(group: ReplayedGroup, names: Sequence[str], settings: Settings) -> Corrector:
    fitted = [{session.name for session in one.sessions} for one in group.calibrations]
    session = next((name for name in names if all(name in known for known in fitted)), None)
    return Corrector(group.calibrations, replace(corrector_options(settings, group.quantity), session=session))


def _lines(
    settings: Settings, calibrations: Sequence[Calibration], descriptor: int, warn: Callable[[str], None]
) -> tuple[Source, tuple[Corrector, ...]]:
    form = settings.form
    if settings.quantity is None:
        raise RecordingError("expected --quantity raw (counts) or wrench (by the prior matrix; N, N m), got none")
    if form is Input.ROS2_CSV and settings.quantity is not HeldQuantity.WRENCH:
        raise RecordingError("--input ros2-csv: expected --quantity wrench, which such messages hold")
    options = corrector_options(settings, settings.quantity)
    reader: LineForm
    if form in (Input.YARP, Input.ROS2_CSV):
        corrector = _only(calibrations, f"--input {form}", options)
        _refuse(settings, *_OF_LINES[:7], "envelope" if form is Input.ROS2_CSV else "frame")
        _require_gravity(settings, None)
        if corrector.variables[0]:
            raise RecordingError(
                f"--input {form}: the calibration needs {', '.join(corrector.variables[0])}, which such lines lack; "
                "take --input csv or yarp-measures"
            )
        if form is Input.ROS2_CSV:
            reader = RosCsvLines(frame=settings.frame)
        else:
            _require_stamps(settings, settings.envelope, "--envelope")
            reader = YarpLines(channels=corrector.channels, envelope=settings.envelope)
    else:
        corrector = Corrector(calibrations, options)
        sensors = _sensor_columns(settings, calibrations)
        if form is Input.CSV:
            _refuse(settings, "index", "envelope", "frame")
            _require_gravity(settings, settings.gravity, len(calibrations))
            gravity = () if settings.gravity is None else tuple(settings.gravity.split(","))
            if len(gravity) not in (0, 3):
                raise RecordingError(f"--gravity: expected three columns between commas, got {settings.gravity!r}")
            _require_stamps(settings, settings.stamp is not None, "--stamp")
            reader = CsvLines(
                sensors=sensors, stamp=_stamp(settings.stamp), sequence=settings.sequence, gravity=gravity
            )
        else:
            _refuse(settings, "channels", "status", "stamp", "sequence", "gravity", "frame")
            _require_gravity(settings, None)
            _require_stamps(settings, settings.envelope, "--envelope")
            reader = MeasuresLines(sensors=sensors, envelope=settings.envelope)
    return LineSource(descriptor, reader, rate_hz=settings.rate_hz, warn=warn), (corrector,)


_OF_LINES = ("channels", "variables", "status", "index", "stamp", "sequence", "gravity", "envelope", "frame")
"""What is stated of lines alone."""


_OPTIONS = {"variables": "variable", "rate_hz": "rate", "tool_mass_kg": "tool-mass"}
"""Options that are not called as their settings."""


def _refuse(settings: Settings, *names: str, of: str | None = None) -> None:
    of = of or (
        "--replay"
        if settings.replay is not None
        else "--ati"
        if settings.ati is not None
        else f"--input {settings.form}"
    )
    defaults = {entry.name: entry.default for entry in fields(settings)}
    for name in names:
        value = getattr(settings, name)
        if value != defaults[name] and value != []:
            raise RecordingError(f"--{_OPTIONS.get(name, name.replace('_', '-'))}: not of {of}")


def _stamp(text: str | None) -> tuple[str, str] | None:
    if text is None:
        return None
    column, colon, unit = text.rpartition(":")
    if not colon or unit not in STAMP_UNITS:
        raise RecordingError(f"--stamp: expected COLUMN:UNIT with one of {', '.join(STAMP_UNITS)}, got {text!r}")
    return column, unit


def _by_sensor(option: str, entries: Sequence[str], names: Sequence[str]) -> dict[str, str]:
    """What is stated for every sensor, as `SENSOR=...`; of one sensor without its name."""
    values: dict[str, str] = {}
    for entry in entries:
        name, equals, value = entry.partition("=")
        if not equals and len(names) == 1:
            name, value = names[0], entry
        if name not in names or name in values:
            raise RecordingError(f"{option} {entry}: expected SENSOR=... once per sensor; {known_names(name, names)}")
        values[name] = value
    return values


def _sensor_columns(settings: Settings, calibrations: Sequence[Calibration]) -> list[SensorColumns]:
    names = [one.sensor.name for one in calibrations]
    channels = _by_sensor("--channels", settings.channels, names)
    status = _by_sensor("--status", settings.status, names)
    index = _by_sensor("--index", settings.index, names)
    variables = _variables(settings.variables, calibrations)
    sensors = []
    for one in calibrations:
        name, count = one.sensor.name, one.matrix.shape[1]
        own = tuple(part.strip() for part in channels[name].split(",")) if name in channels else ()
        if settings.form is Input.CSV and len(own) != count:
            raise RecordingError(
                f"sensor {name!r}: expected --channels with {count} columns, in the order of its calibration, got "
                f"{len(own)}"
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


def _is_index(text: str) -> bool:
    return text.isascii() and text.isdigit() and len(text) < 10


def _variables(entries: Sequence[str], calibrations: Sequence[Calibration]) -> Mapping[str, tuple[str, ...]]:
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
    return {
        one.sensor.name: tuple(wanted[one.sensor.name, variable.name] for variable in one.variables)
        for one in calibrations
    }


def read_settings(values: Mapping[str, Any]) -> Settings:
    """Take what was typed.

    Args:
        values: Options by name; None for those that were not typed.

    Returns:
        The settings.

    Raises:
        ForceTorqueError: If a number is not finite.
    """
    for name, value in values.items():
        if isinstance(value, float) and not math.isfinite(value):
            raise ForceTorqueError(f"--{name.replace('_', '-')}: expected a finite number, got {value}")
    return Settings(**{name: value for name, value in values.items() if value is not None})
