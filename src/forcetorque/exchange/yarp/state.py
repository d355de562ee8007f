# SPDX-License-Identifier: BSD-3-Clause
"""Ports of control boards, `state:o`: the positions of the joints as plain numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path

from forcetorque.exchange.yarp.bottle import Bottle
from forcetorque.exchange.yarp.joint_units import NAME_ALL, joint_signal, places_of_joints, units_of_joints
from forcetorque.exchange.yarp.plain_numbers import expect_numbers
from forcetorque.exchange.yarp.port_log import read_port_log
from forcetorque.exchange.yarp.reading import CLOCK, PortReading
from forcetorque.recording import Stream


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
    log = read_port_log(port_dir, stream=stream, choose=partial(_choose, tuple(joints), places))
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


def _choose(board: Sequence[str], places: Sequence[int], message: Bottle) -> list[int]:
    numbers = expect_numbers(message, board, advice=NAME_ALL)
    return [numbers[place] for place in places]
