# SPDX-License-Identifier: BSD-3-Clause
"""The phase of a motion: how much of its path is behind, whatever the time that it took.

Two runs of one motion differ in their speeds and rests, so instants of one are not those of the other. Lengths along
the path are: a rest adds none, and neither does what jitters by less than a step of it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from forcetorque.arrays import FloatArray, IntArray, read_only
from forcetorque.errors import RecordingError

STEP_RAD = 0.05
"""What moves less than this from the last point of the path stands still: more than encoders and IMUs jitter; rad."""

TOLERANCE_RAD = math.radians(5.0)
"""Largest difference at equal phases between two runs of one motion; rad."""

_SHIFTS = np.linspace(-1.0, 1.0, 9)
"""By how much phases of two runs may be apart; phases."""

_LEAST_STEPS = 5
"""Steps of a path below which nothing moved."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MotionPath:
    """The path of one run of a motion."""

    names: tuple[str, ...]
    """What moves: joints, or components of the direction of gravity."""
    phase: FloatArray
    """Phase of every sample, from 0 to 1, not falling; shape (n,)."""
    length: FloatArray
    """Phases of the points of the path; shape (v,)."""
    points: FloatArray
    """The points; shape (v, k); rad, m, or 1 for directions."""

    @classmethod
    def of(cls, names: Sequence[str], positions: Any) -> Self:
        """Follow a motion.

        Args:
            names: What moves.
            positions: Where it is at n instants, in the order of time; shape (n, k); rad, m, or 1 for directions.

        Returns:
            Its path.

        Raises:
            RecordingError: If nothing moves.
        """
        values = read_only(positions, name="positions", shape=(None, len(tuple(names))))
        corners = _corners(values)
        points = values[corners]
        behind = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
        if len(corners) <= _LEAST_STEPS:
            raise RecordingError(
                f"motion: expected {', '.join(names)} to move by more than {_LEAST_STEPS * STEP_RAD:g} rad, got "
                f"{behind[-1]:.2g}; a contest needs a motion to tell phases by"
            )
        last = np.searchsorted(corners, np.arange(len(values)), side="right") - 1
        beyond = np.linalg.norm(values - points[last], axis=1)
        ends = np.append(behind[1:], behind[-1])
        phase = np.minimum(behind[last] + beyond, ends[last]) / behind[-1]
        return cls(
            names=tuple(names),
            phase=read_only(np.maximum.accumulate(phase), name="phase", shape=(len(values),)),
            length=read_only(behind / behind[-1], name="length", shape=(len(corners),)),
            points=read_only(points, name="points", shape=(len(corners), len(tuple(names)))),
        )

    def at(self, phase: FloatArray) -> FloatArray:
        """Give where the path is at phases.

        Args:
            phase: Phases from 0 to 1; shape (p,).

        Returns:
            Positions; shape (p, k).
        """
        return np.stack([np.interp(phase, self.length, column) for column in self.points.T], axis=1)


def _corners(values: FloatArray) -> IntArray:
    """Samples that are each a step farther than the one before: what lies between jitters."""
    corners, point = [0], values[0]
    for k, value in enumerate(values):
        step = value - point
        if float(step @ step) > STEP_RAD**2:
            corners.append(k)
            point = value
    return np.asarray(corners, dtype=np.int64)


def require_same_motion(paths: Mapping[str, MotionPath], *, phases: int) -> None:
    """Refuse runs that do not go the same way phase by phase.

    Args:
        paths: Paths by name of the run, at least one.
        phases: Number of phases that are compared.

    Raises:
        RecordingError: If two move other joints, or lie farther than `TOLERANCE_RAD` from each other at a phase.
    """
    (first, wanted), *others = paths.items()
    middles = (np.arange(phases) + 0.5) / phases
    # jitter adds a little to the length of a path, so that a phase may be off by a part of itself
    expected = np.stack([wanted.at(middles + shift / phases) for shift in _SHIFTS])
    for name, path in others:
        if path.names != wanted.names:
            raise RecordingError(
                f"{name}: expected the motion of {', '.join(wanted.names)} as in {first}, got {', '.join(path.names)}; "
                "judge runs of one motion"
            )
        away = np.abs(path.at(middles) - expected)
        nearest = np.take_along_axis(away, away.max(axis=2).argmin(axis=0)[None, :, None], axis=0)[0]
        phase, k = np.unravel_index(int(nearest.argmax()), nearest.shape)
        if nearest[phase, k] > TOLERANCE_RAD:
            raise RecordingError(
                f"{name}: expected the motion of {first} phase by phase, got {path.names[k]} "
                f"{nearest[phase, k]:.2f} rad (or m) away from it at {100.0 * middles[phase]:.0f} % of the path; "
                "repeat the same motion, from its start to its end"
            )
