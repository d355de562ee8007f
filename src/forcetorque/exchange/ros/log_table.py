# SPDX-License-Identifier: BSD-3-Clause
"""How an experiment file states a bag of ROS."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field

from forcetorque.exchange.log_format import LogTable
from forcetorque.exchange.signal_table import WorldTable
from forcetorque.recording import OrientationSense
from forcetorque.toml_table import Table, Text


class RosOrientation(WorldTable):
    """The world of an orientation, and what the message does not say of it."""

    sense: OrientationSense | None = None
    """Of Imu and QuaternionStamped, which need it: `sensor_to_world` where the quaternion turns vectors along the
    frame's axes to the world's, as REP 145 asks of drivers, else `world_to_sensor`. Poses and tf have the former."""


class RosStream(Table):
    """One topic of the bag, or one transform of tf."""

    name: Text
    """Name of the stream in the recording."""
    topic: Text
    """Topic; its type of message says what it holds."""
    frame: Text | None = None
    """Frame of the readings; that of the `[[sensor]]` which reads the stream, or else of the messages, if left out. Of
    poses, tf and quaternions, which need it, the frame whose orientation is wanted."""
    world: Text | None = None
    """Of poses and tf, which need it: the frame in which `frame` is seen."""
    orientation: RosOrientation | None = None
    """Of Imu its orientation, in place of what else it measures; of poses and tf the gravity of the world, where its z
    axis does not point up."""


class RosLog(LogTable):
    """A bag: a file `.bag`, `.mcap` or `.db3`, or the folder of a bag of ROS 2."""

    format: Literal["ros"]
    """Format of the recording."""
    path: Path
    """File or folder."""
    stream: Annotated[tuple[RosStream, ...], Field(min_length=1)]
    """What is read."""
