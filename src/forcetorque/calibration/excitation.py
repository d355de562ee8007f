# SPDX-License-Identifier: BSD-3-Clause
"""Excitation: which directions of the raw readings the loads of a data set have moved.

The second moment of the raw readings is split in what the reference wrench explains and the rest
(noise, drift, steps). Least squares shrinks the matrix along a direction by the explained share, so
a direction of which less than half is explained carries more disturbance than load and counts as
not excited. The share is adjusted for the number of samples, as if they were independent.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.calibration.moments import Moments
from forcetorque.spatial import WRENCH_COMPONENTS

EXPLAINED_SHARE = 0.5
"""A direction is excited if the reference explains at least this share of its variance."""

_RANK_TOLERANCE = 1e-12
"""Eigenvalues below this part of the largest are rounding of double precision moments."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Excitation:
    """Eigenvectors of the raw second moment, strongest first, and how far loads explain them."""

    variance: FloatArray
    """Variance of the raw readings along each direction; shape (c,); counts2."""
    directions: FloatArray
    """Unit directions in the space of raw channels, one per row; shape (c, c)."""
    explained: FloatArray
    """Share of each variance that the reference wrench explains, 0 to 1; shape (c,)."""
    reference_deviation: FloatArray
    """Standard deviation of the reference wrench per component; shape (6,); N, N m."""

    def __post_init__(self) -> None:
        channels = len(np.asarray(self.variance))
        for field, shape in (
            ("variance", (channels,)),
            ("directions", (channels, channels)),
            ("explained", (channels,)),
            ("reference_deviation", (6,)),
        ):
            object.__setattr__(self, field, read_only(getattr(self, field), name=field, shape=shape))

    @property
    def rank(self) -> int:
        """Number of directions whose variance is not zero to rounding."""
        return int(np.count_nonzero(self.variance > _RANK_TOLERANCE * self.variance[0]))

    @property
    def condition(self) -> float:
        """Ratio of the largest to the smallest standard deviation over the directions."""
        smallest = float(self.variance[-1])
        return float(np.sqrt(self.variance[0] / smallest)) if smallest > 0.0 else float("inf")

    @property
    def excited(self) -> tuple[bool, ...]:
        """Whether the loads move each direction more than anything else does."""
        nonzero = self.variance > _RANK_TOLERANCE * self.variance[0]
        return tuple(bool(n and e >= EXPLAINED_SHARE) for n, e in zip(nonzero, self.explained, strict=True))

    def describe_unexcited(self, *, channel_names: tuple[str, ...]) -> str:
        """Name the directions that are not excited.

        Args:
            channel_names: Names of the raw channels.

        Returns:
            Text such as `0.92 ch3 - 0.39 ch5 (12 counts, 8 % explained)`; empty if all are excited.
        """
        texts = []
        for ok, direction, variance, explained in zip(
            self.excited, self.directions, self.variance, self.explained, strict=True
        ):
            if not ok:
                texts.append(
                    f"{_combination(direction, channel_names)} "
                    f"({np.sqrt(max(variance, 0.0)):.3g} counts, {100 * explained:.0f} % explained)"
                )
        return "; ".join(texts)

    def unmoved_components(self) -> tuple[str, ...]:
        """Name the components of the reference wrench that hardly change over the data set.

        Returns:
            Components whose standard deviation is below 1 % of the largest of their kind (force or moment).
        """
        forces, moments = self.reference_deviation[:3], self.reference_deviation[3:]
        limits = np.repeat([0.01 * forces.max(), 0.01 * moments.max()], 3)
        low = self.reference_deviation <= limits
        return tuple(name for name, is_low in zip(WRENCH_COMPONENTS, low, strict=True) if is_low)


def _combination(direction: FloatArray, names: tuple[str, ...]) -> str:
    """Write a direction as a sum of the channels that make up most of it."""
    order = [int(k) for k in np.argsort(-np.abs(direction)) if abs(direction[k]) >= 0.2 * np.abs(direction).max()]
    lead = np.sign(direction[order[0]])
    terms = [f"{'- ' if lead * direction[k] < 0 else '+ '}{abs(direction[k]):.2f} {names[k]}" for k in order]
    return " ".join(terms).removeprefix("+ ")


def excitation_of(moments: Moments) -> Excitation:
    """Split the raw second moment in directions, and each in load and disturbance.

    Args:
        moments: Moments of a data set.

    Returns:
        The excitation of its directions, strongest first.
    """
    eigenvalues, vectors = np.linalg.eigh(moments.raw_raw)
    variance = np.maximum(eigenvalues[::-1], 0.0)
    directions = vectors.T[::-1]
    # pseudo-inverse: components of the reference that never change explain nothing
    explained_matrix = (
        moments.reference_raw.T
        @ np.linalg.pinv(moments.reference_reference, rcond=_RANK_TOLERANCE, hermitian=True)
        @ moments.reference_raw
    )
    load = np.einsum("ij,jk,ik->i", directions, explained_matrix, directions)
    share = np.divide(load, variance, out=np.zeros_like(load), where=variance > 0.0)
    # six regressors explain part of any few samples: the share is adjusted for them, as adjusted R2 is
    free = moments.count - 1 - int(np.linalg.matrix_rank(moments.reference_reference, hermitian=True))
    share = 1.0 - (1.0 - share) * (moments.count - 1) / free if free > 0 else np.zeros_like(share)
    return Excitation(
        variance=variance,
        directions=directions,
        explained=np.clip(share, 0.0, 1.0),
        # a component that stands still far from zero may be rounded below it
        reference_deviation=np.sqrt(np.maximum(np.diag(moments.reference_reference), 0.0)),
    )
