# SPDX-License-Identifier: BSD-3-Clause
"""What a curve is worth: its error while loading, and what hysteresis adds while unloading."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray
from forcetorque.skin.taxels.curve import TaxelCurve

BINS = 20
"""Levels of pressure at which loading and unloading are compared."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TaxelResponse:
    """What the curve of one taxel is worth on the samples that it was fitted to."""

    rmse_pa: float
    """Root mean square error of all samples, noise and hysteresis included; Pa."""
    error_pa: float
    """Root mean square over levels of pressure of the mean error while loading: neither noise nor hysteresis; Pa."""
    hysteresis_pa: float
    """Mean over levels of how much higher the same pressure reads while unloading than while loading; Pa."""
    hysteresis_share: float
    """The same in counts, as a share of the range."""


def taxel_response(curve: TaxelCurve, fall: FloatArray, pressure: FloatArray, unloading: BoolArray) -> TaxelResponse:
    """Judge a curve on the samples that it was fitted to.

    Args:
        curve: The curve.
        fall: Counts below rest; shape (n,).
        pressure: Pressure above that at rest; shape (n,); Pa.
        unloading: Whether each sample was reached from above; shape (n,).

    Returns:
        Errors and hysteresis; no hysteresis where no level was loaded and unloaded.
    """
    reading = curve.pressure(fall)
    highest = float(pressure.max())
    level = np.clip((pressure / highest * BINS).astype(np.int64), 0, BINS - 1)
    up, down = (_means(level, chosen, reading, fall, pressure) for chosen in (~unloading, unloading))
    loaded, both = np.isfinite(up[0]), np.isfinite(up[0]) & np.isfinite(down[0])
    error = (up[0] - up[2])[loaded]
    # at one level loading and unloading have not quite the same mean pressure
    lag = (down[0] - down[2] - up[0] + up[2])[both]
    counts = (down[1] - up[1])[both] - (down[2] - up[2])[both] * curve.range_counts / highest
    return TaxelResponse(
        rmse_pa=float(np.sqrt(np.mean((reading - pressure) ** 2))),
        error_pa=float(np.sqrt(np.mean(error**2))),
        hysteresis_pa=float(lag.mean()) if both.any() else 0.0,
        hysteresis_share=float(counts.mean()) / curve.range_counts if both.any() else 0.0,
    )


def _means(level: np.ndarray, chosen: BoolArray, *values: FloatArray) -> tuple[FloatArray, ...]:
    number = np.bincount(level[chosen], minlength=BINS)
    with np.errstate(invalid="ignore"):
        return tuple(np.bincount(level[chosen], weights=one[chosen], minlength=BINS) / number for one in values)
