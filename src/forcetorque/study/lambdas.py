# SPDX-License-Identifier: BSD-3-Clause
"""The lambdas of a sweep, in the thesis' count and in that of its equation (5.4)."""

from __future__ import annotations

from typing import Final

from forcetorque.calibration import Moments
from forcetorque.errors import FitError

TABLE_LAMBDAS: Final = (
    0.0, 1.0, 5.0, 10.0, 50.0, 100.0, 1000.0, 5000.0, 10000.0, 50000.0, 100000.0, 500000.0, 1000000.0,
)  # fmt: skip
"""The thirteen lambdas of thesis Tables 5.5 and 5.6, as printed there; counts2."""

TABLE_FACTOR: Final = 6.0
"""Lambda of equation (5.4) per lambda of the tables: their program took the mean over the six axes too."""

SWEEP_LAMBDAS: Final = tuple(TABLE_FACTOR * value for value in TABLE_LAMBDAS)
"""The same thirteen as equation (5.4) has them, which is how `calibrate` counts; counts2."""

CONVENTION: Final = "thesis (5.4): mean squared residual norm + lambda |C - C_prior|^2"
"""How every lambda is counted, unless it is called one of the tables; unit counts2."""


def relative_lambda(regularisation: float, moments: Moments) -> float:
    """Express a lambda in the scale of the sensor's own readings, so that sensors can be compared.

    Args:
        regularisation: Lambda of (5.4); counts2.
        moments: Moments of the fitted samples.

    Returns:
        Lambda over the mean variance of the raw channels; 1.

    Raises:
        FitError: If no raw channel ever changes.
    """
    variance = float(moments.raw_raw.trace()) / moments.channels
    if not variance > 0.0:
        raise FitError("raw readings: expected some that change, all channels hold one value; the sensor was not read")
    return regularisation / variance


def lambda_text(regularisation: float) -> str:
    """Write a lambda in full, 1000000 and not 1e+06.

    Args:
        regularisation: Lambda; counts2.

    Returns:
        All its digits that a person would type.
    """
    return f"{regularisation:.12g}"
