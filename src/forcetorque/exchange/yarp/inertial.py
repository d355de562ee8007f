# SPDX-License-Identifier: BSD-3-Clause
"""Ports of the older inertial sensors: twelve plain numbers.

They are the orientation as roll, pitch, yaw in deg, the proper acceleration in m/s2, the angular
velocity in deg/s and the magnetic field. Acceleration and angular velocity are kept, or the orientation.
"""

from __future__ import annotations

from functools import partial
from pathlib import Path

from forcetorque.arrays import FloatArray
from forcetorque.exchange.yarp.bottle import Bottle
from forcetorque.exchange.yarp.plain_numbers import expect_numbers
from forcetorque.exchange.yarp.port_log import read_port_log
from forcetorque.exchange.yarp.reading import CLOCK, PortReading
from forcetorque.exchange.yarp.roll_pitch_yaw import ANGLES
from forcetorque.recording import Finding, OrientationLayout, Signal, Stream, orientation_signals
from forcetorque.spatial import si_factor

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
    log = read_port_log(port_dir, stream=stream, choose=partial(_choose, _MOTION if orientation is None else _TURN))
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


def _choose(kept: slice, message: Bottle) -> range:
    return expect_numbers(message, _COMPONENTS, advice="is this the port of an inertial sensor?")[kept]
