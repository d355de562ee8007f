# SPDX-License-Identifier: BSD-3-Clause
"""What was measured: streams with their own clocks, intervals, findings, and the project's own form on disk."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names

if TYPE_CHECKING:
    from forcetorque.recording.recording import Interval as Interval, Recording as Recording
    from forcetorque.recording.storage import read_recording as read_recording, write_recording as write_recording
    from forcetorque.recording.stream import Stream as Stream

__all__, __getattr__, __dir__ = lazy_names(
    __name__,
    Interval="forcetorque.recording.recording",
    Recording="forcetorque.recording.recording",
    Stream="forcetorque.recording.stream",
    read_recording="forcetorque.recording.storage",
    write_recording="forcetorque.recording.storage",
)
