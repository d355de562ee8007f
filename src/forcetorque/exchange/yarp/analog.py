# SPDX-License-Identifier: BSD-3-Clause
"""Ports of force-torque sensors: `fx fy fz tx ty tz`, already calibrated, in N and N m."""

from __future__ import annotations

from pathlib import Path

from forcetorque.exchange.yarp.bottle import Bottle
from forcetorque.exchange.yarp.plain_numbers import expect_numbers
from forcetorque.exchange.yarp.port_log import read_port_log
from forcetorque.exchange.yarp.reading import CLOCK, PortReading
from forcetorque.recording import QUANTITIES, Signal, Stream


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
