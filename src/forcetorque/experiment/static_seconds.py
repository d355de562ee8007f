# SPDX-License-Identifier: BSD-3-Clause
"""Still seconds: those of an interval in which no logged joint moves."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import ExperimentError
from forcetorque.recording.recording import Interval, Recording

STILL_RAD = 0.02
"""How far a joint may move in a second that counts as still; rad, m where it is prismatic. The weight of a robot turns
by as much in the axes of its sensors: about a degree."""

_SECOND_NS, _STEP_NS = 1_000_000_000, 250_000_000
"""Length of a second, and how far apart seconds begin."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class StillSeconds:
    """Seconds of an interval, also ones that overlap, in which no logged joint moves."""

    start_ns: IntArray
    """When they begin; shape (k,); ns."""

    @property
    def count(self) -> int:
        """How many there are."""
        return len(self.start_ns)

    def hold(self, stamp_ns: IntArray) -> BoolArray:
        """Tell which instants lie in them.

        Args:
            stamp_ns: Instants; shape (n,); ns.

        Returns:
            Whether each does; shape (n,).
        """
        if not self.count:
            return np.zeros(len(stamp_ns), dtype=bool)
        place = np.searchsorted(self.start_ns, stamp_ns, side="right") - 1
        return (place >= 0) & (stamp_ns - self.start_ns[place] < _SECOND_NS)


def still_seconds(recording: Recording, interval: Interval) -> StillSeconds:
    """Find the seconds of an interval in which the robot is still.

    Args:
        recording: The recording; joints that it does not hold are taken to be at rest.
        interval: The interval.

    Returns:
        Its still seconds, at least one.

    Raises:
        ExperimentError: If there is none: where nothing is still, matrix and inertia speak with the offset.
    """
    span = interval.end_ns - interval.start_ns
    starts = interval.start_ns + _STEP_NS * np.arange(max(0, (span - _SECOND_NS) // _STEP_NS + 1))
    moved, joint = np.zeros(len(starts)), np.full(len(starts), "", dtype=object)
    for name, stamps, position in _logged(recording):
        travel = np.array([_travel(position[(stamps >= t) & (stamps < t + _SECOND_NS)]) for t in starts])
        joint[travel > moved] = name
        moved = np.maximum(moved, travel)
    still: IntArray = starts[moved <= STILL_RAD].astype(np.int64)
    if len(still):
        return StillSeconds(start_ns=still)
    words = (
        f"it lasts {span * 1e-9:g} s"
        if not len(starts)
        else f"in the stillest {joint[moved.argmin()]!r} moves by {moved.min():.3f}"
    )
    raise ExperimentError(
        f"interval {interval.label!r}: expected a second in which no joint moves by more than {STILL_RAD:g} rad or m, "
        f"but {words}; name an interval in which the robot holds still"
    )


def _logged(recording: Recording) -> Iterator[tuple[str, IntArray, FloatArray]]:
    for joint, (stream, signal) in recording.joint_signals("position").items():
        yield joint, stream.stamp_ns, signal.values[:, signal.columns.index(joint)]


def _travel(position: FloatArray) -> float:
    """Distance of the extreme positions; infinite where there is none."""
    known = position[np.isfinite(position)]
    return float(np.ptp(known)) if len(known) else np.inf
