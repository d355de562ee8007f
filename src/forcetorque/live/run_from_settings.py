# SPDX-License-Identifier: BSD-3-Clause
"""A live run from its settings: its source of samples and its correctors."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from forcetorque.base.errors import RecordingError, require_known
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.live.corrector import Corrector
from forcetorque.live.gravity_and_tool_weight import JointGravity, JointPositions
from forcetorque.live.lines_from_settings import OF_LINES, line_source, message_frames, one_corrector, require_gravity
from forcetorque.live.net_ft import CountUnits, NetFtSource, fetch_units
from forcetorque.live.option_values import HeldQuantity, OffsetSource
from forcetorque.live.ros_topics import RosSession, RosSource, require_topic
from forcetorque.live.settings import Settings, by_sensor, corrector_options, numbers_of, refuse
from forcetorque.live.sources import ReplayedGroup, ReplaySource, Source, replayed_groups
from forcetorque.robot.urdf import read_urdf

_OF_TOPICS = ("publish", "domain", "router", "robot", "joints", "base_gravity")
"""What is stated of topics alone."""
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
        refuse(settings, *OF_LINES, "frame")
        return _replayed(settings, calibrations, clock)
    if settings.ros2:
        if ros is None:
            raise RecordingError("--ros2: expected a session that carries messages, got none")
        refuse(settings, *OF_LINES, "rate_hz")
        return _topics(settings, calibrations, ros, clock, warn)
    if settings.ati is not None:
        refuse(settings, *OF_LINES, "frame", "rate_hz")
        if settings.quantity is HeldQuantity.RAW:
            raise RecordingError("--quantity raw: a box sends wrenches")
        corrector = one_corrector(calibrations, "a box", corrector_options(settings, HeldQuantity.WRENCH))
        require_gravity(settings, None)
        return _box(settings, clock), (corrector,)
    return line_source(settings, calibrations, descriptor, warn)


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
    frames = message_frames(settings, calibrations)
    correctors = tuple(Corrector(one, corrector_options(settings, HeldQuantity.WRENCH)) for one in calibrations)
    for corrector in correctors:
        if corrector.variables[0]:
            raise RecordingError(
                f"--ros2: the calibration needs {', '.join(corrector.variables[0])}, which such messages lack; take "
                "--input csv"
            )
    gravity = None if is_robot_shown_alone(settings) else _joint_gravity(settings, frames)
    source = RosSource(
        ros,
        heard,
        domain=settings.domain,
        clock=clock,
        frames=frames,
        gravity=gravity,
        positions=_joint_positions(settings, frames),
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


def _joint_positions(settings: Settings, frames: Mapping[str, str]) -> JointPositions | None:
    if settings.robot is None and settings.joints is not None and is_robot_shown_alone(settings):
        raise RecordingError("--joints: a page needs the URDF that they are of: expected --robot too, got none")
    if not settings.shown or settings.robot is None:
        return None
    if settings.joints is None:
        raise RecordingError("--robot: a page needs --joints too, the topic of JointState")
    model = read_urdf(settings.robot)
    for frame in frames.values():
        require_known(frame, model.links, RecordingError, f"--frame {frame}: expected a link of {model.name!r}")
    return JointPositions([name for name, joint in model.joints.items() if joint.type.moves and joint.mimic is None])


def _joint_gravity(settings: Settings, frames: Mapping[str, str]) -> JointGravity | None:
    stated = {
        "--robot": settings.robot,
        "--joints": settings.joints,
        "--base-gravity": settings.base_gravity,
        "--tool-mass": settings.tool_mass_kg,
    }
    if all(value is None for value in stated.values()):
        return None
    if lacking := [name for name, value in stated.items() if value is None]:
        raise RecordingError(f"a tool on a robot of ROS needs {', '.join(stated)}: got none of {', '.join(lacking)}")
    require_gravity(settings, settings.joints, len(frames))
    gravity = np.array(numbers_of("--base-gravity", settings.base_gravity or "", 3))
    low, high = _ON_EARTH
    if not low <= (magnitude := float(np.linalg.norm(gravity))) <= high:
        raise RecordingError(
            f"--base-gravity {settings.base_gravity}: expected a free fall of {low} to {high} m/s2, "
            f"got one of {magnitude:g}"
        )
    return JointGravity(read_urdf(settings.robot or ""), next(iter(frames.values())), gravity)


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
    require_gravity(settings, "recorded", len(calibrations))
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
