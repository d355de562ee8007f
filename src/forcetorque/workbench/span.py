# SPDX-License-Identifier: BSD-3-Clause
"""Which directions of load a set of known loads spans, and the moment that none of them ever has."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only
from forcetorque.base.errors import ShapeError
from forcetorque.base.wrench import FORCE_AND_MOMENT

RANK_TOLERANCE: Final = 1e-9
"""Share of the largest singular value below which a direction is not spanned: rounding leaves 1e-15."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MissingMoment:
    """A sum of force and moment that is zero for all loads: the moment about a line, for weights of rigid bodies.

    `axis . moment + (point x axis) . force + pitch_m axis . force`; a pitch of 0 leaves the moment about the line.
    """

    axis: FloatArray
    """Direction of the line in the sensor's frame, of length 1, its largest component positive; shape (3,)."""
    point_m: FloatArray
    """Point of the line that is nearest to the sensor's origin; shape (3,); m."""
    pitch_m: float
    """How much force along the line belongs to it; m."""
    functional: FloatArray
    """What force and moment are multiplied by to give it; shape (6,); m, 1."""

    @classmethod
    def of(cls, functional: FloatArray) -> MissingMoment | None:
        """Read a line from what vanishes.

        Args:
            functional: What force and moment are multiplied by, up to its size; shape (6,).

        Returns:
            The line; None where no moment belongs to it.
        """
        size = float(np.linalg.norm(functional[3:]))
        if size <= RANK_TOLERANCE * float(np.linalg.norm(functional[:3])):
            return None
        sign = np.sign(functional[3 + int(np.argmax(np.abs(functional[3:]).round(9)))])
        scaled = sign * functional / size
        arm, axis = scaled[:3], scaled[3:]
        return cls(
            axis=axis,
            point_m=np.cross(axis, arm),
            pitch_m=float(axis @ arm),
            functional=read_only(scaled, name="functional", shape=(6,)),
        )

    def distance_m(self, place_m: Any) -> float:
        """Say how far a place is from the line.

        Args:
            place_m: The place, in the sensor's frame; shape (3,); m.

        Returns:
            The distance; m.
        """
        return float(np.linalg.norm(np.cross(np.asarray(place_m, dtype=np.float64) - self.point_m, self.axis)))

    @property
    def words(self) -> str:
        """The line in words and numbers."""
        x, y, z = ((1e3 * self.point_m).round(6) + 0.0).tolist()
        along = ", ".join(f"{value:.3f}" for value in (self.axis.round(9) + 0.0).tolist())
        screw = "" if abs(self.pitch_m) < 1e-6 else f", with {1e3 * self.pitch_m:.3g} mm of the force along it"
        return f"the moment about the line through ({x:.1f}, {y:.1f}, {z:.1f}) mm along ({along}){screw}"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Span:
    """What loads span, force and moment each over its largest."""

    rank: int
    """Directions of load that are spanned, to a share of 1e-9."""
    strengths: FloatArray
    """Singular values of the scaled loads over the root of their number, largest first; shape (6,)."""
    functionals: FloatArray
    """What vanishes for all loads, one per direction that is not spanned; shape (6 - rank, 6)."""
    missing: tuple[MissingMoment, ...]
    """The same as moments about lines, where they are such."""

    @property
    def least_strength(self) -> float:
        """The smallest singular value."""
        return float(self.strengths[-1])

    @classmethod
    def of(cls, wrench: Any) -> Span:
        """Find what loads span.

        Args:
            wrench: Loads; shape (n, 6), n at least 6; N, N m.

        Returns:
            Rank, singular values, and what is missing.

        Raises:
            ShapeError: If there are fewer than six loads, or all are zero.
        """
        loads = read_only(wrench, name="wrench", shape=(None, 6))
        if len(loads) < 6 or not loads.any():
            raise ShapeError(f"wrench: expected at least six loads that are not all zero, got {len(loads)}")
        size = load_sizes(loads)
        _, values, directions = np.linalg.svd(loads / size, full_matrices=False)
        rank = int((values > RANK_TOLERANCE * values[0]).sum())
        functionals = directions[rank:] / size
        lines = (MissingMoment.of(functional) for functional in functionals)
        return cls(
            rank=rank,
            strengths=values / np.sqrt(len(loads)),
            functionals=functionals,
            missing=tuple(line for line in lines if line is not None),
        )


def load_sizes(wrench: FloatArray) -> FloatArray:
    """Give the largest force and the largest moment, to compare both.

    Args:
        wrench: Loads; shape (n, 6); N, N m.

    Returns:
        The force three times, then the moment, 1 where there is none; shape (6,); N, N m.
    """
    largest = [float(np.linalg.norm(wrench[:, half], axis=1).max()) for half in FORCE_AND_MOMENT]
    return np.repeat([size if size > 0.0 else 1.0 for size in largest], 3)
