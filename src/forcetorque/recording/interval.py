# SPDX-License-Identifier: BSD-3-Clause
"""Intervals: spans of a recording with a support frame and a use."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from operator import index

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray, IntArray, read_only
from forcetorque.errors import RecordingError, known_names

_UNIT = 4.0 * float(np.finfo(np.float64).eps)
"""A direction this close to unit length is left as it is, so that a stored one reads back bit by bit."""


class Use(StrEnum):
    """What an interval is for."""

    CALIBRATION = "calibration"
    """Its samples are fitted."""
    VALIDATION = "validation"
    """Its samples judge a calibration and are never fitted."""
    IGNORE = "ignore"
    """Its samples are neither fitted nor judged, also where another interval covers them."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Support:
    """A frame that stands still in the world while it is the only unknown contact."""

    frame: str
    """Link of the robot model."""
    gravity_direction: FloatArray
    """Unit vector along which things fall, in the axes of the frame; shape (3,)."""

    def __post_init__(self) -> None:
        direction = read_only(self.gravity_direction, name="gravity_direction", shape=(3,))
        norm = float(np.linalg.norm(direction))
        if not np.isfinite(norm) or norm == 0.0:
            raise RecordingError(
                f"support frame {self.frame!r}: expected a gravity_direction other than zero, got {direction.tolist()}"
            )
        if abs(norm - 1.0) > _UNIT:
            direction = read_only(direction / norm, name="gravity_direction", shape=(3,))
        object.__setattr__(self, "gravity_direction", direction)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MovingSupport:
    """A frame that is the only unknown contact while an IMU tells how the robot moves."""

    frame: str
    """Link of the robot model; it need not stand still."""
    motion_streams: tuple[str, ...]
    """Streams with the IMU's signals: proper acceleration or gravity, and angular velocity."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "motion_streams", tuple(self.motion_streams))
        if not self.motion_streams:
            raise RecordingError(f"support frame {self.frame!r}: expected the streams of an IMU, got none")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Interval:
    """A span of time, start included and end excluded."""

    label: str
    """Name of the interval, unique in its recording."""
    start_ns: int
    """First instant; ns on the recording's clock."""
    end_ns: int
    """First instant after it; ns on the recording's clock."""
    use: Use
    """What it is for."""
    support: Support | MovingSupport | None
    """Support frame; None only where the use is `ignore`."""

    def __post_init__(self) -> None:
        # NumPy integers become plain ones, which a file can hold; the text of a use becomes the use
        try:
            object.__setattr__(self, "start_ns", index(self.start_ns))
            object.__setattr__(self, "end_ns", index(self.end_ns))
        except TypeError as error:
            raise RecordingError(
                f"interval {self.label!r}: expected whole nanoseconds, got {self.start_ns!r} to {self.end_ns!r}"
            ) from error
        try:
            object.__setattr__(self, "use", Use(self.use))
        except ValueError as error:
            known = known_names(str(self.use), Use)
            raise RecordingError(f"interval {self.label!r}: no use is called {self.use!r}; {known}") from error
        if not self.start_ns < self.end_ns:
            raise RecordingError(
                f"interval {self.label!r}: expected an end after its start, "
                f"got a length of {(self.end_ns - self.start_ns) * 1e-9:g} s"
            )
        if self.support is None and self.use is not Use.IGNORE:
            raise RecordingError(f"interval {self.label!r}: its use is {self.use}, which needs a support frame")

    def holds(self, stamp_ns: IntArray) -> BoolArray:
        """Tell which instants lie in the interval.

        Args:
            stamp_ns: Instants; shape (n,); ns on the recording's clock.

        Returns:
            Whether each does; shape (n,).
        """
        inside: BoolArray = (stamp_ns >= self.start_ns) & (stamp_ns < self.end_ns)
        return inside
