# SPDX-License-Identifier: BSD-3-Clause
"""What a joint calibration is made from: readings of several sensors and the motion of the robot, in one stretch."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.errors import ShapeError
from forcetorque.read_only_mapping import read_only_mapping
from forcetorque.robot import BodyTree, JointMotion, RootMotion


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Stretch:
    """A stretch of a recording in which the same links touch the world; n samples."""

    label: str
    """Label of the interval."""
    recording: str
    """Recording that it is of: the noise of its readings is its own."""
    session: str
    """Stretch of time in which sensors keep their offsets."""
    time_s: FloatArray
    """Instants, rising; shape (n,); s."""
    tree: BodyTree
    """The robot, rooted at the link whose motion is known: that of an IMU, or one that stands still."""
    joints: JointMotion
    """Motion of the joints; those that were not logged are absent; NaN in gaps."""
    root: RootMotion
    """Motion of the root link's frame."""
    readings: Mapping[str, FloatArray]
    """Wrenches of the sensors by their prior matrices, without offset; shape (n, 6) each; N, N m; NaN in gaps."""
    touched: tuple[str, ...]
    """Links that touch, or may touch, the world: nothing is asked of the parts that they are of."""

    def __post_init__(self) -> None:
        n = len(self.joints)
        object.__setattr__(self, "time_s", read_only(self.time_s, name="time_s", shape=(n,)))
        if not (np.isfinite(self.time_s).all() and (np.diff(self.time_s) > 0.0).all()):
            raise ShapeError(f"stretch {self.label!r}: time_s: expected finite instants that rise")
        readings = {
            name: read_only(values, name=f"readings of {name!r}", shape=(n, 6))
            for name, values in self.readings.items()
        }
        object.__setattr__(self, "readings", read_only_mapping(readings))
        object.__setattr__(self, "touched", tuple(self.touched))

    def __len__(self) -> int:
        return len(self.time_s)

    def pieces(self, length_s: float) -> Iterator[Stretch]:
        """Cut the stretch.

        Args:
            length_s: Longest time that a piece takes; s.

        Yields:
            Pieces of one length that follow each other; none of a stretch without samples.
        """
        if not len(self):
            return
        start, duration = self.time_s[0], self.time_s[-1] - self.time_s[0]
        count = max(int(np.ceil(duration / length_s)), 1)
        edges = np.searchsorted(self.time_s, start + duration / count * np.arange(1, count))
        for first, last in zip([0, *edges], [*edges, len(self)], strict=True):
            block = slice(int(first), int(last))
            if block.start < block.stop:
                yield replace(
                    self,
                    time_s=self.time_s[block],
                    joints=self.joints.samples(block),
                    root=self.root.samples(block),
                    readings={name: values[block] for name, values in self.readings.items()},
                )
