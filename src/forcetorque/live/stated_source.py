# SPDX-License-Identifier: BSD-3-Clause
"""From what is stated of a live run to its source and its correctors."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from forcetorque.base.errors import RecordingError, known_names
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.live.choices import HeldQuantity, Input, OffsetSource
from forcetorque.live.corrector import Corrector, CorrectorOptions
from forcetorque.live.joint_gravity import JointGravity, JointPositions
from forcetorque.live.net_ft import CountUnits, NetFtSource, fetch_units
from forcetorque.live.packets import NUMBERS
from forcetorque.live.replay import ReplayedGroup, ReplaySource, replayed_groups
from forcetorque.live.ros_topics import RosSession, RosSource, require_topic
from forcetorque.live.settings import Settings, by_sensor, corrector_options, numbers_of, refuse
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
from forcetorque.robot.urdf import read_urdf

_OF_LINES = ("channels", "variables", "status", "index", "stamp", "sequence", "gravity", "envelope", "frame")
"""What is stated of lines alone."""
_OF_TOPICS = ("publish", "domain", "router", "robot", "joints", "base_gravity")
"""What is stated of topics alone."""
_ALONG_BASE = ("actual_TCP_force", "O_F_ext_hat_K")
"""Fields of Universal Robots and Franka whose wrench is along the axes of the base, whatever the arm does."""
_ON_EARTH = (9.7, 9.9)
"""Range of the acceleration of free fall anywhere on earth, with a margin; m/s2."""


def make_run(
    settings: Settings,
    calibrations: Sequence[Calibration],
    *,
    descriptor: int,
    warn: Callable[[str], None],
    clock: Callable[[], float] = time.monotonic,
    ros: RosSession | None = None,
) -> tuple[Source, tuple[Corrector, ...]]:
    """Make source and correctors.

    Args:
        settings: What is stated.
        calibrations: A calibration per sensor.
        descriptor: Descriptor of standard input.
        warn: Called with what a person should know.
        clock: Gives seconds.
        ros: What carries messages of ROS 2; None without topics.

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
    stated = {
        "--input": settings.form,
        "--replay": settings.replay,
        "--ati": settings.ati,
        "--ros2": settings.ros2 or None,
    }
    if sum(value is not None for value in stated.values()) != 1:
        got = ", ".join(name for name, value in stated.items() if value is not None) or "none"
        raise RecordingError(
            f"expected one of --input FORM of the lines on standard input, --replay, --ati and --ros2, got {got}"
        )
    if settings.replay is None:
        refuse(settings, "speed")
    if settings.ati is None:
        refuse(settings, "ati_port", "ati_force", "ati_torque")
    if not settings.ros2:
        refuse(settings, *_OF_TOPICS)
    if settings.offset is not OffsetSource.TRACKED:
        refuse(settings, "random_walk", "tracking_noise", "with_temperature", of=f"--offset {settings.offset}")
    if settings.offset is OffsetSource.FITTED:
        refuse(settings, "tare_s", of=f"--offset {settings.offset}")
    if settings.replay is not None:
        refuse(settings, *_OF_LINES)
        return _replayed(settings, calibrations, clock)
    if settings.ros2:
        if ros is None:
            raise RecordingError("--ros2: expected a session that carries messages, got none")
        refuse(settings, *(name for name in _OF_LINES if name != "frame"), "rate_hz")
        return _topics(settings, calibrations, ros, clock, warn)
    if settings.ati is not None:
        refuse(settings, *_OF_LINES, "rate_hz")
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
        refuse(settings, "tool_mass_kg", of="--offset fitted without --take-tool-off")


def _require_stamps(settings: Settings, there: bool, option: str) -> None:
    if settings.rate_hz is not None and not there:
        raise RecordingError(f"--rate: gaps in time need the time of the sender: expected {option} too, got none")


def ros_topics(settings: Settings, names: Sequence[str]) -> tuple[dict[str, str], dict[str, str]]:
    """Give the topics that are heard and sent.

    Args:
        settings: What is stated.
        names: Names of the sensors.

    Returns:
        Topics of wrenches, and of corrected wrenches, by sensor; of the latter not every sensor must have one.

    Raises:
        RecordingError: If a sensor has no topic, or a topic is stated twice.
    """
    heard, sent = (
        {name: require_topic(option, topic) for name, topic in by_sensor(option, entries, names).items()}
        for option, entries in (("--ros2", settings.ros2), ("--publish", settings.publish))
    )
    if missing := [name for name in names if name not in heard]:
        raise RecordingError(f"--ros2: expected a topic of every sensor, got none of {', '.join(missing)}")
    topics = [*heard.values(), *sent.values()]
    if len(set(topics)) < len(topics):
        raise RecordingError(f"--ros2 and --publish: expected every topic once, got {', '.join(topics)}")
    return {name: heard[name] for name in names}, sent


def _topics(
    settings: Settings,
    calibrations: Sequence[Calibration],
    ros: RosSession,
    clock: Callable[[], float],
    warn: Callable[[str], None],
) -> tuple[Source, tuple[Corrector, ...]]:
    if settings.quantity is HeldQuantity.RAW:
        raise RecordingError("--quantity raw: messages of --ros2 hold wrenches")
    if not 0 <= settings.domain < 233:
        raise RecordingError(f"--domain: expected ROS_DOMAIN_ID, from 0 to 232, got {settings.domain}")
    heard, _ = ros_topics(settings, [one.sensor.name for one in calibrations])
    correctors = tuple(Corrector(one, corrector_options(settings, HeldQuantity.WRENCH)) for one in calibrations)
    for corrector in correctors:
        if corrector.variables[0]:
            raise RecordingError(
                f"--ros2: the calibration needs {', '.join(corrector.variables[0])}, which such messages lack; take "
                "--input csv"
            )
    gravity = None if is_robot_shown_alone(settings) else _joint_gravity(settings, len(calibrations))
    source = RosSource(
        ros,
        heard,
        domain=settings.domain,
        clock=clock,
        frame=settings.frame,
        gravity=gravity,
        positions=_joint_positions(settings),
        joints_topic=settings.joints and require_topic("--joints", settings.joints),
        warn=warn,
    )
    return source, correctors


def is_robot_shown_alone(settings: Settings) -> bool:
    """Say whether the robot of ROS is there for a page and not for a tool.

    Args:
        settings: What is stated.

    Returns:
        Whether a page shows the run, and neither tool nor gravity is stated.
    """
    return settings.shown and settings.tool_mass_kg is None and settings.base_gravity is None


def _joint_positions(settings: Settings) -> JointPositions | None:
    if settings.robot is None and settings.joints is not None and is_robot_shown_alone(settings):
        raise RecordingError("--joints: a page needs the URDF that they are of: expected --robot too, got none")
    if not settings.shown or settings.robot is None:
        return None
    if settings.joints is None or settings.frame is None:
        raise RecordingError("--robot: a page needs --joints and --frame too, the link that the reading is in")
    model = read_urdf(settings.robot)
    if settings.frame not in model.links:
        raise RecordingError(
            f"--frame {settings.frame}: expected a link of {model.name!r}; {known_names(settings.frame, model.links)}"
        )
    return JointPositions([name for name, joint in model.joints.items() if joint.type.moves and joint.mimic is None])


def _joint_gravity(settings: Settings, sensors: int) -> JointGravity | None:
    stated = {
        "--robot": settings.robot,
        "--joints": settings.joints,
        "--base-gravity": settings.base_gravity,
        "--frame": settings.frame,
        "--tool-mass": settings.tool_mass_kg,
    }
    if all(value is None for name, value in stated.items() if name != "--frame"):
        return None
    if lacking := [name for name, value in stated.items() if value is None]:
        raise RecordingError(f"a tool on a robot of ROS needs {', '.join(stated)}: got none of {', '.join(lacking)}")
    _require_gravity(settings, settings.joints, sensors)
    gravity = np.array(numbers_of("--base-gravity", settings.base_gravity or "", 3))
    low, high = _ON_EARTH
    if not low <= (magnitude := float(np.linalg.norm(gravity))) <= high:
        raise RecordingError(
            f"--base-gravity {settings.base_gravity}: expected a free fall of {low} to {high} m/s2, "
            f"got one of {magnitude:g}"
        )
    return JointGravity(read_urdf(settings.robot or ""), settings.frame or "", gravity)


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

    if settings.replay is None or settings.speed < 0.0:
        raise RecordingError(f"--speed: expected 0 or more, got {settings.speed}")
    experiment = load_experiment(settings.replay)
    groups = replayed_groups(experiment, calibrations)
    if settings.tool_mass_kg is not None and len(calibrations) == 1 and groups[0].gravity is None:
        raise RecordingError(
            f"--tool-mass: a tool needs gravity in the stream of its sensor, in the frame of the samples: "
            f"{settings.replay} has none there"
        )
    _require_gravity(settings, "recorded", len(calibrations))
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
        groups,
        speed=settings.speed or math.inf,
        rate_hz=settings.rate_hz,
        clock=clock,
        sleep=time.sleep,
        experiment=experiment,
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
        refuse(settings, *_OF_LINES[:7], "envelope" if form is Input.ROS2_CSV else "frame")
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
            refuse(settings, "index", "envelope", "frame")
            _require_gravity(settings, settings.gravity, len(calibrations))
            gravity = () if settings.gravity is None else tuple(settings.gravity.split(","))
            if len(gravity) not in (0, 3):
                raise RecordingError(f"--gravity: expected three columns between commas, got {settings.gravity!r}")
            _require_stamps(settings, settings.stamp is not None, "--stamp")
            sequence, numbers = _sequence(settings.sequence)
            reader = CsvLines(
                sensors=sensors, stamp=_stamp(settings.stamp), sequence=sequence, gravity=gravity, numbers=numbers
            )
        else:
            refuse(settings, "channels", "status", "stamp", "sequence", "gravity", "frame")
            _require_gravity(settings, None)
            _require_stamps(settings, settings.envelope, "--envelope")
            reader = MeasuresLines(sensors=sensors, envelope=settings.envelope)
    return LineSource(descriptor, reader, rate_hz=settings.rate_hz, warn=warn), (corrector,)


def _sequence(text: str | None) -> tuple[str | None, int]:
    column, colon, count = (text or "").rpartition(":")
    if not colon:
        return text, NUMBERS
    if not _is_index(count) or int(count) < 2:
        raise RecordingError(f"--sequence: expected COLUMN or COLUMN:COUNT, how many numbers there are, got {text!r}")
    return column, int(count)


def _stamp(text: str | None) -> tuple[str, str] | None:
    if text is None:
        return None
    column, colon, unit = text.rpartition(":")
    if not colon or unit not in STAMP_UNITS:
        raise RecordingError(f"--stamp: expected COLUMN:UNIT with one of {', '.join(STAMP_UNITS)}, got {text!r}")
    return column, unit


def _sensor_columns(settings: Settings, calibrations: Sequence[Calibration]) -> list[SensorColumns]:
    names = [one.sensor.name for one in calibrations]
    channels = by_sensor("--channels", settings.channels, names)
    status = by_sensor("--status", settings.status, names)
    index = by_sensor("--index", settings.index, names)
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
