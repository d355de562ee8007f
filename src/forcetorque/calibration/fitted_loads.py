# SPDX-License-Identifier: BSD-3-Clause
"""Which loads were fitted: their range per component, and along their principal directions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

import numpy as np

from forcetorque.array_field import ArrayField
from forcetorque.arrays import FloatArray
from forcetorque.part import Part

_Wrench = Annotated[FloatArray, ArrayField((6,))]


class FittedLoads(Part):
    """Range of the fitted loads, as the calibration reads them: without offset and variables.

    Loads of one motion go together, such as a weight and its moment, so that a load can lie within the range of every
    component and be none that was seen. Hence the principal directions. They are of loads, not of channels: what lies
    beyond is then the least by which a load would have to change, whereas channels add up to wrenches that cancel.
    """

    minimum: _Wrench
    """Smallest load per component; N, N m."""
    maximum: _Wrench
    """Largest load per component; N, N m."""
    directions: Annotated[FloatArray, ArrayField((6, 6))]
    """Principal directions of the loads, widest first, one per row, orthonormal for forces and moments in units of the
    largest deviation of their kind; per N, per N m."""
    direction_minimum: _Wrench
    """Smallest load along each direction."""
    direction_maximum: _Wrench
    """Largest load along each direction."""

    @classmethod
    def of(cls, loads: Sequence[FloatArray], deviation: FloatArray) -> FittedLoads:
        """Sum up loads.

        Args:
            loads: Fitted loads, an array per interval; shape (n, 6) each; N, N m.
            deviation: Standard deviation of the reference; shape (6,); N, N m.

        Returns:
            Their range.
        """
        together = np.concatenate(loads)
        sizes = np.repeat([deviation[:3].max(), deviation[3:].max()], 3)
        scale = np.where(sizes > 0.0, sizes, 1.0)
        _, vectors = np.linalg.eigh(np.cov((together / scale).T, bias=True))
        directions = vectors.T[::-1] / scale
        along = together @ directions.T
        return cls(
            minimum=together.min(axis=0),
            maximum=together.max(axis=0),
            directions=directions,
            direction_minimum=along.min(axis=0),
            direction_maximum=along.max(axis=0),
        )
