# SPDX-License-Identifier: BSD-3-Clause
"""Reading and reference at even steps of time, and what the reference leaves of the reading at a lag.

The gate before every fit asks for the lag that explains most, and so does the alignment of clocks.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from forcetorque.arrays import FloatArray

EVEN = 0.01
"""Deviation from even steps, in steps, that is no reason to interpolate."""

_ROUNDING = 1e-14
"""Mean square of a direction of the reference, relative to the largest, below which it does not move."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EvenPair:
    """Reading and reference at n even steps of time, the reference without its ends."""

    reading: FloatArray
    """Reading less its mean; shape (k, n)."""
    reference: FloatArray
    """Reference; shape (n - 2 most, p)."""
    most: int
    """Samples that are left out at each end, so that as many are paired for every lag."""

    @classmethod
    def of(cls, time_s: FloatArray, reading: FloatArray, reference: FloatArray, *, step_s: float, most: int) -> Self:
        """Bring samples to even steps.

        Args:
            time_s: Instants, rising; shape (n,); s.
            reading: Reading; shape (n, k).
            reference: Reference; shape (n, p).
            step_s: Length of a step; s.
            most: Largest lag that will be asked for; steps.

        Returns:
            The pair.
        """
        time = time_s - time_s[0]
        at = step_s * np.arange(int(time[-1] / step_s + EVEN) + 1)
        both = np.hstack([reading - reading.mean(axis=0), reference])
        if len(at) != len(time) or np.abs(at - time).max() > EVEN * step_s:
            both = np.column_stack([np.interp(at, time, column) for column in both.T])
        split = reading.shape[1]
        return cls(
            reading=np.ascontiguousarray(both[:, :split].T), reference=both[most : len(at) - most, split:], most=most
        )

    def later(self, lag: int) -> FloatArray:
        """Give the reading some steps after those of the reference; shape (k, n - 2 most)."""
        return self.reading[:, self.most + lag : self.reading.shape[1] - self.most + lag]


def residual_at_lags(pairs: Sequence[EvenPair]) -> Callable[[int], FloatArray]:
    """Prepare what the reference leaves of the reading, the mean of each pair apart.

    Args:
        pairs: Stretches of the same columns.

    Returns:
        Gives the sum of squares that is left of every column of the reading at a lag; shape (k,).
    """
    centred = [pair.reference - pair.reference.mean(axis=0) for pair in pairs]
    eigenvalues, vectors = np.linalg.eigh(sum(reference.T @ reference for reference in centred))
    moving = eigenvalues > _ROUNDING * eigenvalues[-1]
    # in these columns the explained square is that of the products
    units = [reference @ (vectors[:, moving] / np.sqrt(eigenvalues[moving])) for reference in centred]

    def left(lag: int) -> FloatArray:
        readings = [pair.later(lag) for pair in pairs]
        total = sum(np.einsum("ij,ij->i", r, r) - r.shape[1] * r.mean(axis=1) ** 2 for r in readings)
        products = sum(r @ unit for r, unit in zip(readings, units, strict=True))
        squares: FloatArray = np.asarray(total) - (np.asarray(products) ** 2).sum(axis=1)
        return squares

    return left
