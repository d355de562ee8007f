# SPDX-License-Identifier: BSD-3-Clause
"""Ports of control boards, `stateExt:o`: one list per quantity, with one element per joint of the board.

Five layouts are in use, distinguished by their number of elements [1]. Only the positions, velocities
and accelerations of the joints are kept.

References:
    [1] YARP, src/libYARP_dev/src/idl/JointStateData.thrift and its predecessors named stateExt.thrift.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError
from forcetorque.formats.log_format import StreamReading
from forcetorque.formats.yarp.message import FAIL, OK, Bottle, is_number
from forcetorque.formats.yarp.plain_ports import JOINT_UNITS, NAME_ALL, indices_of_joints, joint_signal, units_of_joints
from forcetorque.formats.yarp.port_log import PortLog, read_port_log
from forcetorque.recording.recording import Finding

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
