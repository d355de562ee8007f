# SPDX-License-Identifier: BSD-3-Clause
"""Ports of force-torque and inertial sensors and of joints: plain numbers, and `stateExt:o` of control boards.

Five layouts of `stateExt:o` are in use, distinguished by their number of elements [1]. Only the positions, velocities
and accelerations of the joints are kept.

References:
    [1] YARP, src/libYARP_dev/src/idl/JointStateData.thrift and its predecessors named stateExt.thrift.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError, RecordingError, require_known
from forcetorque.base.units import si_factor
from forcetorque.formats.log_format import StreamReading
from forcetorque.formats.yarp.message import FAIL, OK, Bottle, is_number
from forcetorque.formats.yarp.port_log import PortLog, read_port_log
from forcetorque.recording.orientation import OrientationLayout, orientation_signals
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import QUANTITIES, Signal

ANGLES = ("roll", "pitch", "yaw")
"""Names of the numbers, whose meaning is `recording.orientation.ROLL_PITCH_YAW`."""


def angles_of(orientation: Signal) -> FloatArray:
    """Give the angles of rotation matrices, as sensors send them.

    Args:
        orientation: The orientation of a stream.

    Returns:
        Roll, pitch and yaw; shape (n, 3); deg; NaN where there is none.
    """
    from scipy.spatial.transform import Rotation  # here because importing it takes longer than most commands

    matrices = orientation.values.reshape(-1, 3, 3)
    known = np.isfinite(matrices).all(axis=(1, 2))
    angles = np.full((len(matrices), 3), np.nan)
    if known.any():
        angles[known] = Rotation.from_matrix(matrices[known]).as_euler("xyz", degrees=True)
    return angles


JOINT_UNITS = {
    "position": {"rad": "rad", "m": "m"},
    "velocity": {"rad": "rad/s", "m": "m/s"},
    "acceleration": {"rad": "rad/s2", "m": "m/s2"},
}
"""Quantities of joints, in the order of YARP's lists, with their unit by the unit of the joint."""


NO_JOINT = "-"
"""Stands among the joints of a board for one that the robot lacks, such as a finger of a model without hands."""

NAME_ALL = f'name all joints of this board in its order, "{NO_JOINT}" for one that the robot lacks'
"""What to do where a board has another number of joints."""


def indices_of_joints(board: Sequence[str]) -> list[int]:
    """Find the joints of the robot among those of a board.

    Args:
        board: Names of all joints of the board, in its order, `NO_JOINT` for those that the robot lacks.

    Returns:
        Their places, from 0.

    Raises:
        RecordingError: If the robot lacks all of them.
    """
    indices = [index for index, joint in enumerate(board) if joint != NO_JOINT]
    if board and not indices:
        raise RecordingError(f"joints: expected the name of at least one joint of the robot, got {list(board)}")
    return indices


def units_of_joints(joints: Sequence[str], joint_units: Mapping[str, str] | None) -> tuple[str, ...]:
    """Give the unit of each joint.

    Args:
        joints: Names of the joints.
        joint_units: `m` for prismatic joints, by name; joints that it does not name are in `rad`.

    Returns:
        `rad` or `m` for each joint.

    Raises:
        RecordingError: If `joint_units` names another joint or unit.
    """
    units = joint_units or {}
    for joint, unit in units.items():
        require_known(joint, joints, RecordingError, f"joint_units: no joint {joint!r} was named")
        if unit not in JOINT_UNITS["position"]:
            raise RecordingError(f"joint_units: expected rad or m for {joint!r}, got {unit!r}")
    return tuple(units.get(joint, "rad") for joint in joints)


def joint_signal(quantity: str, logged: FloatArray, *, joints: Sequence[str], units: Sequence[str]) -> Signal:
    """Turn logged values of joints into a signal.

    Args:
        quantity: One of `JOINT_UNITS`.
        logged: Values as logged, shape (n, k); of deg for rotary joints, of m for prismatic ones.
        joints: Names of the k joints.
        units: `rad` or `m` for each joint.

    Returns:
        The signal, of rad and m.
    """
    factors = np.where(np.array(units) == "rad", si_factor("deg")[1], 1.0)
    return Signal(
        quantity=quantity,
        values=logged * factors,
        columns=tuple(joints),
        units=tuple(JOINT_UNITS[quantity][unit] for unit in units),
    )


def expect_numbers(message: Bottle, names: Sequence[str], *, advice: str) -> range:
    """Choose all numbers of a message of plain numbers.

    Args:
        message: The message.
        names: Names of the numbers that are expected.
        advice: What to do if it holds something else.

    Returns:
        The place of every number.

    Raises:
        FormatError: If it holds something else; the message does not name the line.
    """
    numbers = sum(map(is_number, message))
    others = len(message) - numbers
    if numbers != len(names) or others:
        also = f" and {others} lists or flags" if others else ""
        raise FormatError(f"expected {len(names)} numbers {' '.join(names)}, got {numbers}{also}; {advice}")
    return range(numbers)


def read_analog(port_dir: str | Path, *, stream: str, frame: str) -> StreamReading:
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
    choose = partial(expect_numbers, names=QUANTITIES["wrench"].columns, advice="is this the port of such a sensor?")
    log = read_port_log(port_dir, stream=stream, choose=choose)
    return log.reading(stream, {"wrench": Signal.of_fixed("wrench", log.values, frame=frame)})


INERTIAL_COLUMNS = (*ANGLES, "ax", "ay", "az", "gx", "gy", "gz", "mx", "my", "mz")
_TURN = slice(0, 3)
_MOTION = slice(3, 9)


def read_inertial(
    port_dir: str | Path, *, stream: str, frame: str, orientation: OrientationLayout | None = None
) -> StreamReading:
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
    kept = _MOTION if orientation is None else _TURN

    def choose(message: Bottle) -> range:
        return expect_numbers(message, INERTIAL_COLUMNS, advice="is this the port of an inertial sensor?")[kept]

    log = read_port_log(port_dir, stream=stream, choose=choose)
    if orientation is not None:
        signals, findings = orientation_signals(log.values, orientation, unit="deg", frame=frame, stream=stream)
        return log.reading(stream, signals, findings=findings)
    motion = {"proper_acceleration": log.values[:, :3], "angular_velocity": log.values[:, 3:] * si_factor("deg/s")[1]}
    return log.reading(stream, {name: Signal.of_fixed(name, values, frame=frame) for name, values in motion.items()})


def read_state(
    port_dir: str | Path, *, stream: str, joints: Sequence[str], joint_units: Mapping[str, str] | None = None
) -> StreamReading:
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
    indices = indices_of_joints(joints)
    names = [joints[index] for index in indices]
    units = units_of_joints(names, joint_units)

    def choose(message: Bottle) -> list[int]:
        numbers = expect_numbers(message, joints, advice=NAME_ALL)
        return [numbers[index] for index in indices]

    log = read_port_log(port_dir, stream=stream, choose=choose)
    return log.reading(stream, {"position": joint_signal("position", log.values, joints=names, units=units)})


_MOTOR = ("motor position", "motor velocity", "motor acceleration")
_MODES = ("control mode", "interaction mode")
_2014 = (*JOINT_UNITS, "torque", "controller output", *_MODES)
_2015 = (*JOINT_UNITS, *_MOTOR, "torque", "controller output", *_MODES)
_2017 = (*JOINT_UNITS, *_MOTOR, "torque", "duty cycle", "current", *_MODES)
_LAYOUTS: dict[int, tuple[str, ...]] = {7: _2014, 10: _2015, 20: _2015, 22: _2017, 24: (*_2017, "temperature")}
"""Names of the lists by number of elements; those of twenty and more have a flag after each list."""

_FIRST_WITH_FLAGS = 20


def read_state_ext(
    port_dir: str | Path, *, stream: str, joints: Sequence[str], joint_units: Mapping[str, str] | None = None
) -> StreamReading:
    """Read the log of a control board's port.

    Rotary joints are logged in deg and given in rad; prismatic ones are logged and given in m.
    Boards that do not estimate accelerations log zeros: a signal of zeros is left out, the velocity
    only if the positions change.

    Where messages carry the sender's and the dumper's stamp, the sender's is taken if it is
    positive and else the dumper's, as the dumper itself does where it writes only one.

    Args:
        port_dir: Folder with `data.log` or `data.log.gz`, and `info.log`.
        stream: Name for the stream.
        joints: Names of all joints of the board, in its order, `-` for those that the robot lacks.
        joint_units: `m` for prismatic joints, by name; joints that it does not name are in `rad`.

    Returns:
        A stream with the signals `position`, `velocity` and `acceleration`, NaN where the board
        flagged a failure, and what was found in the log.

    Raises:
        MissingFileError: If the folder or its log is not there.
        FormatError: If the log is not one of a control board with so many joints.
        RecordingError: If a joint is named twice, or `joint_units` names another joint or unit.
    """
    names = [joints[place] for place in indices_of_joints(joints)]
    units = units_of_joints(names, joint_units)
    log = read_port_log(port_dir, stream=stream, choose=_BoardMessages(joints=tuple(joints)))
    findings: list[Finding] = []
    logged: dict[str, FloatArray] = {}
    for name, values in zip(JOINT_UNITS, np.split(log.values, len(JOINT_UNITS), axis=1), strict=True):
        findings.extend(_failures(stream, name, values, log))
        if _is_not_estimated(name, values, logged):
            findings.append(_not_estimated(stream, name, log))
        else:
            logged[name] = values
    signals = {name: joint_signal(name, values, joints=names, units=units) for name, values in logged.items()}
    return log.reading(stream, signals, findings=findings)


def count_joints(message: Bottle) -> int:
    """Count the joints of a board.

    Args:
        message: One of its messages.

    Returns:
        Length of the first list that is not empty.

    Raises:
        FormatError: If it is no message of a board or all its lists are empty; the message does not name the line.
    """
    lists, _ = _split_flags(message)
    lengths = [len(numbers) for numbers in lists if numbers]
    if not lengths:
        raise FormatError("expected the numbers of at least one joint, got empty lists only")
    return lengths[0]


@dataclass(slots=True, kw_only=True)
class _BoardMessages:
    """Chooses the kept numbers of a message and holds all messages to the layout of the first."""

    joints: tuple[str, ...]
    """Names of all joints of the board, and what stands for those that the robot lacks."""
    n_elements: int = 0
    """Elements of the first message."""
    lengths: list[int | None] = field(default_factory=list)
    """Lengths of its lists; None where only empty lists that failed were seen so far."""

    def __call__(self, message: Bottle) -> list[int | None]:
        lists, failed = _split_flags(message)
        lengths = [None if bad and not numbers else len(numbers) for numbers, bad in zip(lists, failed, strict=True)]
        self._compare(len(message), lengths)
        for name, length in zip(JOINT_UNITS, lengths, strict=False):
            if length not in (None, len(self.joints)):
                raise FormatError(
                    f"expected {len(self.joints)} numbers of {name} because so many joints were named "
                    f"({', '.join(self.joints)}), got {length}; {NAME_ALL}"
                )
        starts, indices = np.cumsum([0, *map(len, lists)]).tolist(), indices_of_joints(self.joints)
        return [None if failed[i] else starts[i] + joint for i in range(len(JOINT_UNITS)) for joint in indices]

    def _compare(self, n_elements: int, lengths: list[int | None]) -> None:
        if not self.lengths:
            self.n_elements, self.lengths = n_elements, lengths
        fits = self.n_elements == n_elements and all(
            old == new or old is None or new is None for old, new in zip(self.lengths, lengths, strict=True)
        )
        if not fits:
            raise FormatError(
                f"expected {_show(self.n_elements, self.lengths)} as in the lines before, "
                f"got {_show(n_elements, lengths)}; split the log here, or delete the line"
            )
        self.lengths = [new if old is None else old for old, new in zip(self.lengths, lengths, strict=True)]


def _split_flags(message: Bottle) -> tuple[list[Bottle], list[bool]]:
    """Split a message into its lists and whether each of them is flagged as failed."""
    has_flags = len(message) >= _FIRST_WITH_FLAGS
    elements, flags = (message[::2], message[1::2]) if has_flags else (message, ())
    lists = [element for element in elements if isinstance(element, tuple)]
    if len(message) not in _LAYOUTS or len(lists) != len(elements) or not all(flag in (OK, FAIL) for flag in flags):
        raise FormatError(
            f"expected 7 or 10 lists, or 10, 11 or 12 lists with [ok] or [fail] after each, "
            f"got {len(message)} elements of which {sum(isinstance(e, tuple) for e in message)} are lists; "
            "is this the stateExt port of a board?"
        )
    for name, numbers in zip(_LAYOUTS[len(message)], lists, strict=True):
        if not all(map(is_number, numbers)):
            raise FormatError(f"expected only numbers in the list of {name}, got a flag or a list; delete the line")
    return lists, [flag == FAIL for flag in flags] if has_flags else [False] * len(lists)


def _show(n_elements: int, lengths: list[int | None]) -> str:
    flags = " with flags" if n_elements >= _FIRST_WITH_FLAGS else ""
    return f"{len(lengths)} lists{flags} of {' '.join('?' if n is None else str(n) for n in lengths)} numbers"


def _failures(stream: str, name: str, values: FloatArray, log: PortLog) -> list[Finding]:
    rows = np.flatnonzero(np.isnan(values[:, :1]).any(axis=1))  # a list fails as a whole
    if not len(rows):
        return []
    text = f"{len(rows)} of {len(values)} messages flag the {name} with [fail]; it is NaN there"
    ends = rows[[0, -1]].tolist()
    return [Finding.over(stream, log.stamp_ns, "failed_group", text, *ends, count=len(rows), channel=name)]


def _is_not_estimated(name: str, values: FloatArray, logged: Mapping[str, FloatArray]) -> bool:
    present = values[~np.isnan(values[:, :1]).any(axis=1)]
    if name == "position" or not present.size or present.any():
        return False
    if name == "acceleration":
        return True
    positions = logged["position"]
    positions = positions[~np.isnan(positions[:, :1]).any(axis=1)]
    return bool((positions != positions[:1]).any())


def _not_estimated(stream: str, name: str, log: PortLog) -> Finding:
    text = f"the board does not estimate the {name}: all {len(log.stamp_ns)} messages hold zeros; it is left out"
    return Finding.over(stream, log.stamp_ns, "not_estimated", text, channel=name)
