# SPDX-License-Identifier: BSD-3-Clause
"""Corrected samples as a bag of ROS 2 in one MCAP file, for PlotJuggler, Foxglove and readers of bags."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from forcetorque.formats.ros.bag import mcap_writer, typestore
from forcetorque.formats.ros.messages import WRENCH_TYPE
from forcetorque.formats.ros.wrench_message import encoder_of, has_time_for
from forcetorque.live.outputs import CorrectedRow
from forcetorque.live.sample_status import FAULTS, status_text

_TEXT_TYPE = "std_msgs/msg/String"


class McapOutput:
    """Topics of every sensor: `/SENSOR/wrench`, `/SENSOR/half_width_95`, and `/SENSOR/status` whenever it changes."""

    def __init__(self, writer: Any, types: Any, frames: Mapping[str, str], *, with_faults: bool) -> None:
        """Begin.

        Args:
            writer: Writer of rosbags.
            types: Types of messages of ROS 2.
            frames: Frame of the header by sensor.
            with_faults: Whether samples with a fault have a wrench too.
        """
        self._writer, self._types, self._with_faults = writer, types, with_faults
        self._frames = frames
        self._topics = {
            (sensor, name): writer.add_connection(f"/{sensor}/{name}", kind, typestore=types)
            for sensor in frames
            for name, kind in (("wrench", WRENCH_TYPE), ("half_width_95", WRENCH_TYPE), ("status", _TEXT_TYPE))
        }
        self._statuses: dict[str, int] = {}
        self.lost = 0
        """Samples whose stamp a message does not hold."""

    def write(self, row: CorrectedRow) -> None:
        """Write messages, as of `Output`."""
        if not has_time_for(row.stamp_ns):
            self.lost += 1
            return
        if self._with_faults or not row.status & FAULTS:
            encoder = encoder_of(self._frames[row.sensor])
            for name, values in (("wrench", row.values[:6]), ("half_width_95", row.values[6:])):
                if not math.isnan(values[0]):
                    message = encoder.encode(row.stamp_ns, values)
                    self._writer.write(self._topics[row.sensor, name], row.stamp_ns, message)
        if self._statuses.get(row.sensor) != row.status:
            self._statuses[row.sensor] = row.status
            text = self._types.types[_TEXT_TYPE](data=status_text(row.status))
            message = self._types.serialize_cdr(text, _TEXT_TYPE)
            self._writer.write(self._topics[row.sensor, "status"], row.stamp_ns, message)

    def flush(self) -> None:
        """Do nothing: chunks are written when they are full."""


@contextmanager
def mcap_file(path: Path, frames: Mapping[str, str], *, with_faults: bool) -> Iterator[McapOutput]:
    """Write an MCAP file under a temporary name, and rename it at the end; on an error there is none.

    Args:
        path: File to write or to replace.
        frames: Frame of the header by sensor.
        with_faults: Whether samples with a fault have a wrench too.

    Yields:
        The output.
    """
    types = typestore(path)
    with mcap_writer(path) as writer:
        yield McapOutput(writer, types, frames, with_faults=with_faults)
