# SPDX-License-Identifier: BSD-3-Clause
"""A trajectory as a folder of yarpdatadumper, which yarpdataplayer plays."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.exchange.yarp.discover import PortKind
from forcetorque.exchange.yarp.writing import write_ports
from forcetorque.exchange.yarp.written_port import StreamPort
from forcetorque.recording import Recording, Signal, Stream
from forcetorque.robot import JointMotion

PORT = "plan/state:o"
"""Folder of the port below the folder of logs."""
_START_NS = 1_000_000_000
"""First stamp: yarp takes one of 0 for none."""


def write_yarp_positions(folder: Path, time_s: FloatArray, motion: JointMotion, units: tuple[str, ...]) -> None:
    """Write positions of joints, in deg for those that turn.

    Args:
        folder: Folder of logs to make.
        time_s: Instants from the start; shape (n,); s.
        motion: Positions at them; rad or m.
        units: Unit of every joint.
    """
    signal = Signal(quantity="position", values=motion.position, columns=motion.names, units=units)
    stamps = _START_NS + np.rint(time_s * 1e9).astype(np.int64)
    stream = Stream(name="positions", clock="plan", stamp_ns=stamps, signals={"position": signal})
    port = StreamPort(path=PORT, kind=PortKind.STATE, stream="positions")
    write_ports(folder, Recording(streams={"positions": stream}), [port])
