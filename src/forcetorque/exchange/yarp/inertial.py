# SPDX-License-Identifier: BSD-3-Clause
"""Ports of the older inertial sensors: twelve plain numbers.

They are the orientation as roll, pitch, yaw in deg, the proper acceleration in m/s2, the angular
velocity in deg/s and the magnetic field. Acceleration and angular velocity are kept.
"""

from __future__ import annotations

from pathlib import Path

from forcetorque.exchange.yarp.bottle import Bottle
from forcetorque.exchange.yarp.plain_numbers import expect_numbers
from forcetorque.exchange.yarp.port_log import read_port_log
from forcetorque.exchange.yarp.reading import CLOCK, PortReading
from forcetorque.recording import Signal, Stream
from forcetorque.spatial import si_factor

_COMPONENTS = ("roll", "pitch", "yaw", "ax", "ay", "az", "gx", "gy", "gz", "mx", "my", "mz")
_KEPT = slice(3, 9)


def read_inertial(port_dir: str | Path, *, stream: str, frame: str) -> PortReading:
    """Read the log of an inertial sensor's port.

    Where messages carry the sender's and the dumper's stamp, the sender's is taken if it is
    positive and else the dumper's, as the dumper itself does where it writes only one.

    Args:
        port_dir: Folder with `data.log` or `data.log.gz`, and `info.log`.
        stream: Name for the stream.
        frame: Frame of the sensor, along whose axes it reports.

    Returns:
        A stream with the signals `proper_acceleration`, m/s2, and `angular_velocity`, rad/s, and
        what was found in the log.

    Raises:
        MissingFileError: If the folder or its log is not there.
        FormatError: If the log is anything but one message of twelve numbers per line.
    """
    log = read_port_log(port_dir, stream=stream, choose=_choose)
    logged = {"proper_acceleration": log.values[:, :3], "angular_velocity": log.values[:, 3:] * si_factor("deg/s")[1]}
    signals = {name: Signal.of_fixed(name, values, frame=frame) for name, values in logged.items()}
    return PortReading(
        stream=Stream(name=stream, clock=CLOCK, stamp_ns=log.stamp_ns, signals=signals, sequence=log.sequence),
        findings=log.findings,
    )


def _choose(message: Bottle) -> range:
    return expect_numbers(message, _COMPONENTS, advice="is this the port of an inertial sensor?")[_KEPT]
