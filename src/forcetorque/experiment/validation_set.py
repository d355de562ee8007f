# SPDX-License-Identifier: BSD-3-Clause
"""Data to judge candidates on, and the few samples at its start that an offset is taken from."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, read_only
from forcetorque.base.errors import FitError

OFFSET_S = 1.0
"""Length of the stretch at the start of an interval from which an offset is taken, as on a robot that begins; s."""

_FEWEST = 10
"""Least number of samples of that stretch, and of the rest."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ValidationSet:
    """Readings and reference of one stretch of time that was not fitted."""

    label: str
    """Label of the interval."""
    session: str
    """Session that it is of."""
    time_s: FloatArray
    """Time of every sample since the start of the recording; shape (n,); s."""
    raw: FloatArray
    """Raw readings; shape (n, c); counts."""
    reference: FloatArray
    """Wrench that the sensor must read where nothing touches; shape (n, 6); N, N m."""
    variables: FloatArray
    """Linear variables; shape (n, v)."""

    def __post_init__(self) -> None:
        n = len(np.asarray(self.time_s))
        for name, shape in (
            ("time_s", (n,)),
            ("raw", (n, None)),
            ("reference", (n, 6)),
            ("variables", (n, None)),
        ):
            object.__setattr__(self, name, read_only(getattr(self, name), name=name, shape=shape))

    def for_offset(self) -> BoolArray:
        """Mark the first second, from which an offset is taken.

        Returns:
            Whether a sample is of it; shape (n,).

        Raises:
            FitError: If there are too few samples to take an offset from, or to judge.
        """
        first: BoolArray = self.time_s < self.time_s[0] + OFFSET_S
        count, rest = int(first.sum()), int((~first).sum())
        if min(count, rest) < _FEWEST:
            raise FitError(
                f"validation interval {self.label!r}: expected at least {_FEWEST} samples in its first {OFFSET_S:g} s, "
                f"for the offset, and as many after it, to judge, got {count} and {rest}"
            )
        return first
