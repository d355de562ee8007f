# SPDX-License-Identifier: BSD-3-Clause
"""Where a fit is supported by data."""

from __future__ import annotations

from typing import Annotated

from forcetorque.array_field import ArrayField
from forcetorque.arrays import FloatArray
from forcetorque.calibration.fitted_loads import FittedLoads
from forcetorque.part import Part


class Validity(Part):
    """Where the fit is supported by data."""

    raw_minimum_counts: Annotated[FloatArray, ArrayField((None,))]
    """Smallest fitted reading per channel; counts."""
    raw_maximum_counts: Annotated[FloatArray, ArrayField((None,))]
    """Largest fitted reading per channel; counts."""
    reference_deviation: Annotated[FloatArray, ArrayField((6,), minimum=0.0)]
    """Standard deviation of the reference wrench; N, N m."""
    rank: int
    """Number of raw directions that moved at all."""
    condition: float | None
    """Ratio of the largest to the smallest deviation over the raw directions; None if infinite."""
    directions: Annotated[FloatArray, ArrayField((None, None))]
    """Raw directions, strongest first, one per row; shape (c, c)."""
    variance_counts2: Annotated[FloatArray, ArrayField((None,), minimum=0.0)]
    """Variance of the raw reading along each direction; counts2."""
    explained: Annotated[FloatArray, ArrayField((None,))]
    """Share of each variance that the reference explains."""
    excited: tuple[bool, ...]
    """Whether the loads move the direction more than anything else does."""
    loads: FittedLoads | None = None
    """Range of the fitted loads; None in files of earlier versions, where the ranges of the channels stand for it."""
