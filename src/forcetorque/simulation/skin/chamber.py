# SPDX-License-Identifier: BSD-3-Clause
"""A simulated pressure chamber: even pressure on all taxels, up and down, as they are calibrated."""

from __future__ import annotations

from typing import Final

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.simulation.skin.response import REFERENCE_PA, TaxelResponses

_REST_ROWS: Final = 100
"""Messages before the pressure rises."""


def chamber_log(
    taxels: TaxelResponses, rng: np.random.Generator, *, highest_Pa: float = REFERENCE_PA, rows: int = 400
) -> tuple[FloatArray, FloatArray]:
    """Press all taxels evenly: nothing, then up to a pressure, then down again.

    Args:
        taxels: The taxels, n of them.
        rng: Source of noise.
        highest_Pa: Highest pressure.
        rows: Messages while it rises, and as many while it falls.

    Returns:
        Counts of every message, shape (k, n), and the pressure at it, shape (k,); counts, Pa.
    """
    number = len(taxels.rest)
    rise = np.linspace(0.0, highest_Pa, rows)
    pressure = np.concatenate([np.zeros(_REST_ROWS), rise, rise[::-1]])
    peak = np.full(number, highest_Pa)
    counts = [
        taxels.counts(np.full(number, one), rng, frames=1, peak=peak if row >= _REST_ROWS + rows else None)[0]
        for row, one in enumerate(pressure)
    ]
    return np.array(counts, dtype=np.float64), pressure
