# SPDX-License-Identifier: BSD-3-Clause
"""Curves of all taxels of a patch, and their errors where they were not fitted."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.analysis.skin.recording import PatchRecording
from forcetorque.arrays import BoolArray, FloatArray
from forcetorque.errors import FitError
from forcetorque.skin.taxels import Ailment, CurveKind, TaxelCurve, fit_curve
from forcetorque.skin.taxels.cycle import REST_SHARE, TOP_SHARE


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FittedSamples:
    """Samples of the recordings that are fitted, up to the highest pressure that is to be fitted."""

    fall: FloatArray
    """Counts below rest; shape (n, c)."""
    pressure: FloatArray
    """Pressure above that at rest; shape (n,); Pa."""
    unloading: BoolArray
    """Whether each was reached from above; shape (n,)."""
    ailments: tuple[tuple[Ailment, ...], ...]
    """What is wrong with each taxel in any of the recordings."""
    highest: float
    """Highest fitted pressure; Pa."""

    def fit(self, kind: CurveKind) -> list[TaxelCurve | None]:
        """Fit a curve to every taxel that is sound.

        Args:
            kind: Form of the curves.

        Returns:
            A curve per taxel; None for one that is not sound.
        """
        reach = self.fall[self.pressure >= TOP_SHARE * self.highest].mean(axis=0)
        # long rest would outweigh the first counts of the rise, and make noise of them; what a load leaves as it goes
        # is hysteresis, stated apart: half of it in the curve would make every load that comes read too low
        loaded = (self.pressure > REST_SHARE * self.highest) & ~self.unloading
        return [
            None
            if reasons
            else fit_curve(kind, self.fall[loaded, k], self.pressure[loaded], range_counts=float(reach[k]))
            for k, reasons in enumerate(self.ailments)
        ]


def fitted_samples(recordings: Sequence[PatchRecording], highest: float | None) -> FittedSamples:
    """Put the recordings that are fitted together.

    Args:
        recordings: Recordings for calibration, at least one.
        highest: Highest pressure above rest to fit; Pa; None for all.

    Returns:
        Their samples.

    Raises:
        FitError: If no pressure is that low, or no taxel is sound.
    """
    pressure = np.concatenate([recording.cycle.pressure for recording in recordings])
    used = np.ones(len(pressure), dtype=bool) if highest is None else pressure <= highest
    if not used.any() or pressure[used].max() <= 0.0:
        raise FitError(f"highest pressure to fit: expected one of up to {pressure.max():.0f} Pa, got {highest} Pa")
    by_taxel = zip(*(recording.ailments for recording in recordings), strict=True)
    ailments = tuple(tuple(name for name in Ailment if any(name in log for log in logs)) for logs in by_taxel)
    if all(ailments):
        reasons = ", ".join(name for name in Ailment if any(name in taxel for taxel in ailments))
        raise FitError(f"expected a sound taxel to fit, got none of {len(ailments)}: they are {reasons}")
    return FittedSamples(
        fall=np.concatenate([recording.cycle.fall for recording in recordings])[used],
        pressure=pressure[used],
        unloading=np.concatenate([recording.cycle.unloading for recording in recordings])[used],
        ailments=ailments,
        highest=float(pressure[used].max()),
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class HeldOutErrors:
    """Squared errors of every taxel on one recording that was not fitted, or on several."""

    squares: FloatArray
    """Sums of squares at fitted pressures and at higher ones; shape (2, c); Pa2; NaN for a taxel without a curve."""
    numbers: FloatArray
    """Samples at fitted pressures and at higher ones; shape (2, c)."""

    def __add__(self, other: HeldOutErrors) -> HeldOutErrors:
        return HeldOutErrors(squares=self.squares + other.squares, numbers=self.numbers + other.numbers)

    def of(self, chosen: BoolArray) -> HeldOutErrors:
        """Leave taxels out.

        Args:
            chosen: Taxels to keep; shape (c,).

        Returns:
            The errors without samples of the others.
        """
        return HeldOutErrors(squares=np.where(chosen, self.squares, 0.0), numbers=np.where(chosen, self.numbers, 0.0))

    @property
    def rmse(self) -> FloatArray:
        """Root mean square error of every taxel, inside and above; shape (2, c); Pa; NaN where there is none."""
        with np.errstate(invalid="ignore", divide="ignore"):
            return np.sqrt(self.squares / self.numbers)

    def median(self) -> tuple[float | None, float | None]:
        """Median over the taxels that have an error, inside and above.

        Returns:
            Pa; None where no taxel has one.
        """
        inside, above = (row[np.isfinite(row)] for row in self.rmse)
        return (
            float(np.median(inside)) if len(inside) else None,
            float(np.median(above)) if len(above) else None,
        )


def held_out_errors(curves: Sequence[TaxelCurve | None], recording: PatchRecording, highest: float) -> HeldOutErrors:
    """Judge curves on a recording that was not fitted.

    Args:
        curves: A curve per taxel; None for one that was left out.
        recording: The recording.
        highest: Highest fitted pressure above rest; Pa.

    Returns:
        Errors of all taxels with a curve, sound in the recording or not.
    """
    pressure = recording.cycle.pressure
    inside = pressure <= highest
    squares = np.full((2, len(curves)), np.nan)
    for k, curve in enumerate(curves):
        if curve is not None:
            square = (curve.pressure(recording.cycle.fall[:, k]) - pressure) ** 2
            squares[:, k] = square[inside].sum(), square[~inside].sum()
    samples = np.array([np.count_nonzero(inside), np.count_nonzero(~inside)], dtype=np.float64)
    return HeldOutErrors(squares=squares, numbers=np.repeat(samples[:, None], len(curves), axis=1))
