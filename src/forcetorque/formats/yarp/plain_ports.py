# SPDX-License-Identifier: BSD-3-Clause
"""Ports whose messages are plain numbers: force-torque sensors, older inertial sensors, joint positions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError
from forcetorque.base.units import si_factor
from forcetorque.formats.yarp.message import Bottle, is_number
from forcetorque.formats.yarp.port_log import read_port_log
from forcetorque.formats.yarp.port_reading import (
    ANGLES,
    CLOCK,
    NAME_ALL,
    PortReading,
    joint_signal,
    places_of_joints,
    units_of_joints,
)
from forcetorque.recording.orientation import OrientationLayout, orientation_signals
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import QUANTITIES, Signal, Stream


def expect_numbers(message: Bottle, names: Sequence[str], *, advice: str) -> range:
    """Choose all numbers of a message of plain numbers.

    Args:
        message: The message.
        names: Names of the numbers that are expected.
        advice: What to do if it holds something else.

    Returns:
        The place of every number.

    Raises:
        FormatError: If it holds something else; the text does not say where.
    """
    numbers = sum(map(is_number, message))
    others = len(message) - numbers
    if numbers != len(names) or others:
        also = f" and {others} lists or flags" if others else ""
        raise FormatError(f"expected {len(names)} numbers {' '.join(names)}, got {numbers}{also}; {advice}")
    return range(numbers)


def read_analog(port_dir: str | Path, *, stream: str, frame: str) -> PortReading:
    """Read the log of a force-torque sensor's port.

    Where messages carry the sender's and the dumper's stamp, the sender's is taken if it is
    positive and else the dumper's, as the dumper itself does where it writes only one.

    Args:
        port_dir: Folder with `data.log` or `data.log.gz`, and `info.log`.
        stream: Name for the stream.
        frame: Frame of the sensor, along whose axes it reports.

    Returns:
        A stream with the signal `wrench`, N and N m, and what was found in the log.

    Raises:
        MissingFileError: If the folder or its log is not there.
        FormatError: If the log is anything but one message of six numbers per line.
    """
    log = read_port_log(port_dir, stream=stream, choose=_choose_wrench)
    quantity = QUANTITIES["wrench"]
    wrench = Signal(
        quantity=quantity.name, values=log.values, columns=quantity.columns, units=quantity.units, frame=frame
    )
    return PortReading(
        stream=Stream(
            name=stream, clock=CLOCK, stamp_ns=log.stamp_ns, signals={wrench.quantity: wrench}, sequence=log.sequence
        ),
        findings=log.findings,
    )


def _choose_wrench(message: Bottle) -> range:
    return expect_numbers(message, QUANTITIES["wrench"].columns, advice="is this the port of such a sensor?")


_COMPONENTS = (*ANGLES, "ax", "ay", "az", "gx", "gy", "gz", "mx", "my", "mz")
_TURN = slice(0, 3)
_MOTION = slice(3, 9)


def read_inertial(
    port_dir: str | Path, *, stream: str, frame: str, orientation: OrientationLayout | None = None
) -> PortReading:
    """Read the log of an inertial sensor's port.

    Where messages carry the sender's and the dumper's stamp, the sender's is taken if it is
    positive and else the dumper's, as the dumper itself does where it writes only one.

    Args:
        port_dir: Folder with `data.log` or `data.log.gz`, and `info.log`.
        stream: Name for the stream.
        frame: Frame of the sensor, along whose axes it reports.
        orientation: What roll, pitch and yaw mean, to read these in place of the other numbers.

    Returns:
        A stream with the signals `proper_acceleration`, m/s2, and `angular_velocity`, rad/s, or with `orientation` and
        `gravity`, and what was found in the log.

    Raises:
        MissingFileError: If the folder or its log is not there.
        FormatError: If the log is anything but one message of twelve numbers per line.
    """
    log = read_port_log(
        port_dir, stream=stream, choose=partial(_choose_inertial, _MOTION if orientation is None else _TURN)
    )
    doubts: tuple[Finding, ...] = ()
    if orientation is None:
        signals = _motion(log.values, frame)
    else:
        signals, doubts = orientation_signals(log.values, orientation, unit="deg", frame=frame, stream=stream)
    return PortReading(
        stream=Stream(name=stream, clock=CLOCK, stamp_ns=log.stamp_ns, signals=signals, sequence=log.sequence),
        findings=(*log.findings, *doubts),
    )


def _motion(values: FloatArray, frame: str) -> dict[str, Signal]:
    logged = {"proper_acceleration": values[:, :3], "angular_velocity": values[:, 3:] * si_factor("deg/s")[1]}
    return {name: Signal.of_fixed(name, numbers, frame=frame) for name, numbers in logged.items()}


def _choose_inertial(kept: slice, message: Bottle) -> range:
    return expect_numbers(message, _COMPONENTS, advice="is this the port of an inertial sensor?")[kept]


def read_state(
    port_dir: str | Path, *, stream: str, joints: Sequence[str], joint_units: Mapping[str, str] | None = None
) -> PortReading:
    """Read the log of a control board's port of positions.

    Rotary joints are logged in deg and given in rad; prismatic ones are logged and given in m.

    Where messages carry the sender's and the dumper's stamp, the sender's is taken if it is
    positive and else the dumper's, as the dumper itself does where it writes only one.

    Args:
        port_dir: Folder with `data.log` or `data.log.gz`, and `info.log`.
        stream: Name for the stream.
        joints: Names of all joints of the board, in its order, `-` for those that the robot lacks.
        joint_units: `m` for prismatic joints, by name; joints that it does not name are in `rad`.

    Returns:
        A stream with the signal `position` and what was found in the log.

    Raises:
        MissingFileError: If the folder or its log is not there.
        FormatError: If the log is anything but one message of so many numbers per line.
        RecordingError: If no joint is named or one twice, or `joint_units` names another joint or unit.
    """
    places = places_of_joints(joints)
    names = [joints[place] for place in places]
    units = units_of_joints(names, joint_units)
    log = read_port_log(port_dir, stream=stream, choose=partial(_choose_state, tuple(joints), places))
    position = joint_signal("position", log.values, joints=names, units=units)
    return PortReading(
        stream=Stream(
            name=stream,
            clock=CLOCK,
            stamp_ns=log.stamp_ns,
            signals={position.quantity: position},
            sequence=log.sequence,
        ),
        findings=log.findings,
    )


def _choose_state(board: Sequence[str], places: Sequence[int], message: Bottle) -> list[int]:
    numbers = expect_numbers(message, board, advice=NAME_ALL)
    return [numbers[place] for place in places]
