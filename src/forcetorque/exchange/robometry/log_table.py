# SPDX-License-Identifier: BSD-3-Clause
"""How an experiment file states a log of robometry."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field

from forcetorque.exchange.log_format import LogTable
from forcetorque.exchange.signal_table import SenseTable
from forcetorque.toml_table import Table, Text


class RobometryStream(Table):
    """One sensor of the log, or all of its joints."""

    name: Text
    """Name of the stream in the recording."""
    channel: Text
    """`joints_state`, or group and name of a sensor, such as `FTs/l_leg_ft_sensor`."""
    frame: Text | None = None
    """Link of the URDF in whose frame an IMU reads; left out for joints, temperatures and sensors of the experiment."""
    orientation: SenseTable | None = None
    """Of a channel of `orientations`, which needs it: what its rotation `Rz(y) Ry(p) Rx(r)` does."""


class RobometryLog(LogTable):
    """One file of robometry: HDF5 as MATLAB 7.3 writes it, with the group `description_list`."""

    format: Literal["robometry"]
    """Format of the recording."""
    path: Path
    """File, such as robot_logger_device_2024_01_31_10_00_00.mat."""
    units: dict[Text, Text | tuple[Text, ...]] = {}
    """Units of channels to which the file has no label, such as `"joints_state/positions" = "deg"`; one for all
    elements, or one for each."""
    stream: Annotated[tuple[RobometryStream, ...], Field(min_length=1)]
    """What is read."""
