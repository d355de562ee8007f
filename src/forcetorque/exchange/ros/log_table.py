# SPDX-License-Identifier: BSD-3-Clause
"""How an experiment file states a bag of ROS."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field

from forcetorque.exchange.log_format import LogTable
from forcetorque.toml_table import Table, Text


class RosStream(Table):
    """One topic of the bag, or one transform of tf."""

    name: Text
    """Name of the stream in the recording."""
    topic: Text
    """Topic; its type of message says what it holds."""
    frame: Text | None = None
    """Frame of the readings; that of the `[[sensor]]` which reads the stream, or else of the messages, if left out. Of
    tf the frame whose orientation is wanted."""
    world: Text | None = None
    """Of tf, which needs it: the frame in which `frame` is seen, and whose z axis points up."""


class RosLog(LogTable):
    """A bag: a file `.bag`, `.mcap` or `.db3`, or the folder of a bag of ROS 2."""

    format: Literal["ros"]
    """Format of the recording."""
    path: Path
    """File or folder."""
    stream: Annotated[tuple[RosStream, ...], Field(min_length=1)]
    """What is read."""
