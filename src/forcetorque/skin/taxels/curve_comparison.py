# SPDX-License-Identifier: BSD-3-Clause
"""Curves of all taxels of a patch, and forms of curves compared on recordings that were not fitted."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from operator import add

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.errors import FitError
from forcetorque.skin.taxels.patch_calibration_and_pressure_table import ROWS, CalibratedTaxel
from forcetorque.skin.taxels.pressure_cycles import REST_SHARE, TOP_SHARE, PatchRecording
from forcetorque.skin.taxels.result import CandidateRow, in_kPa, recording_name
from forcetorque.skin.taxels.taxel_curve import CurveKind, TaxelCurve, fit_curve
from forcetorque.skin.taxels.taxel_faults import TaxelFault


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FittedSamples:
    """Samples of the recordings that are fitted, up to the highest pressure that is to be fitted."""

    fall: FloatArray
    """Counts below rest; shape (n, c)."""
    pressure: FloatArray
    """Pressure above that at rest; shape (n,); Pa."""
    unloading: BoolArray
    """Whether each was reached from above; shape (n,)."""
    faults: tuple[tuple[TaxelFault, ...], ...]
    """What is wrong with each taxel in any of the recordings."""
    highest: float
    """Highest fitted pressure; Pa."""

    def fit(self, kind: CurveKind) -> list[TaxelCurve | None]:
        """Fit a curve to every taxel that is valid.

        Args:
            kind: Form of the curves.

        Returns:
            A curve per taxel; None for one that is not valid.
        """
        reach = self.fall[self.pressure >= TOP_SHARE * self.highest].mean(axis=0)
        # long rest would outweigh the first counts of the rise, and make noise of them; what a load leaves as it goes
        # is hysteresis, stated apart: half of it in the curve would make every load that comes read too low
        loaded = (self.pressure > REST_SHARE * self.highest) & ~self.unloading
        return [
            None
            if reasons
            else fit_curve(kind, self.fall[loaded, k], self.pressure[loaded], range_counts=float(reach[k]))
            for k, reasons in enumerate(self.faults)
        ]


def fitted_samples(recordings: Sequence[PatchRecording], highest: float | None) -> FittedSamples:
    """Put the recordings that are fitted together.

    Args:
        recordings: Recordings for calibration, at least one.
        highest: Highest pressure above rest to fit; Pa; None for all.

    Returns:
        Their samples.

    Raises:
        FitError: If no pressure is that low, or no taxel is valid.
    """
    pressure = np.concatenate([recording.cycle.pressure for recording in recordings])
    used = np.ones(len(pressure), dtype=bool) if highest is None else pressure <= highest
    if not used.any() or pressure[used].max() <= 0.0:
        raise FitError(f"highest pressure to fit: expected one of up to {pressure.max():.0f} Pa, got {highest} Pa")
    by_taxel = zip(*(recording.faults for recording in recordings), strict=True)
    faults = tuple(tuple(name for name in TaxelFault if any(name in log for log in logs)) for logs in by_taxel)
    if all(faults):
        reasons = ", ".join(name for name in TaxelFault if any(name in taxel for taxel in faults))
        raise FitError(f"expected a valid taxel to fit, got none of {len(faults)}: they are {reasons}")
    return FittedSamples(
        fall=np.concatenate([recording.cycle.fall for recording in recordings])[used],
        pressure=pressure[used],
        unloading=np.concatenate([recording.cycle.unloading for recording in recordings])[used],
        faults=faults,
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
    """Evaluate curves on a recording that was not fitted.

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


ALL = "all"
"""Name of all recordings together, where squares of a taxel are pooled before they are averaged."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CurveComparison:
    """What every form of curve is worth where it was not fitted."""

    rows: tuple[CandidateRow, ...]
    """A row for each form and recording, and for each form and all recordings."""
    pooled: Mapping[CurveKind, HeldOutErrors]
    """Errors of each form over the recordings in which a taxel is valid; empty without recordings."""
    taxels: int
    """Number of taxels."""

    def rmse(self, kind: CurveKind) -> list[list[float]]:
        """Give the errors of every taxel.

        Args:
            kind: Form of the curves.

        Returns:
            Errors at fitted pressures, and at higher ones; Pa; NaN where there is none.
        """
        errors = self.pooled.get(kind)
        nothing: FloatArray = np.full((2, self.taxels), np.nan)
        return (nothing if errors is None else errors.rmse).tolist()

    @property
    def least_inside(self) -> str | None:
        """Form with the least error at fitted pressures; None where nothing was kept back."""
        return _least({row.curve: row.inside_kPa for row in self.rows if row.recording == ALL})

    @property
    def least_above(self) -> str | None:
        """Form with the least error at higher ones, among those that nowhere fall."""
        return _least({row.curve: row.above_kPa for row in self.rows if row.recording == ALL and not row.falling})


def compare_curves(
    curves: Mapping[CurveKind, Sequence[TaxelCurve | None]], held_out: Sequence[PatchRecording], highest: float
) -> CurveComparison:
    """Evaluate forms of curves on recordings that were not fitted.

    Args:
        curves: Curves of every taxel by their forms.
        held_out: The recordings.
        highest: Highest fitted pressure above rest; Pa.

    Returns:
        The comparison.
    """
    rows: list[CandidateRow] = []
    pooled = {}
    for kind, own in curves.items():
        falling = _falling(own)
        errors = [held_out_errors(own, log, highest) for log in held_out]
        valid = [error.of(log.valid) for error, log in zip(errors, held_out, strict=True)]
        for log, error, kept in zip(held_out, errors, valid, strict=True):
            rows.append(_row(kind, recording_name(log), kept, error, falling))
        if held_out:
            pooled[kind] = reduce(add, valid)
            rows.append(_row(kind, ALL, pooled[kind], reduce(add, errors), falling))
    return CurveComparison(rows=tuple(rows), pooled=pooled, taxels=len(next(iter(curves.values()))))


def _falling(curves: Sequence[TaxelCurve | None]) -> int:
    fall = np.arange(float(ROWS))
    return sum(bool(np.any(np.diff(curve.pressure(fall)) < 0.0)) for curve in curves if curve is not None)


def _row(kind: CurveKind, name: str, kept: HeldOutErrors, errors: HeldOutErrors, falling: int) -> CandidateRow:
    taxels = int(np.count_nonzero(np.isfinite(kept.rmse).any(axis=0)))
    inside, above = kept.median()
    inside_any, above_any = errors.median()
    return CandidateRow(
        curve=kind.value,
        recording=name,
        taxels=taxels,
        left_out=kept.squares.shape[1] - taxels,
        inside_kPa=in_kPa(inside),
        above_kPa=in_kPa(above),
        inside_any_kPa=in_kPa(inside_any),
        above_any_kPa=in_kPa(above_any),
        falling=falling,
    )


def _least(errors: Mapping[str, float | None]) -> str | None:
    known = {name: error for name, error in errors.items() if error is not None}
    return min(known, key=known.__getitem__) if known else None


BINS = 20
"""Levels of pressure at which loading and unloading are compared."""


def calibrated_taxel(
    taxel: int, curve: TaxelCurve, fall: FloatArray, pressure: FloatArray, unloading: BoolArray
) -> CalibratedTaxel:
    """Evaluate a curve on the samples that it was fitted to.

    Args:
        taxel: Column of the taxel.
        curve: The curve.
        fall: Counts below rest; shape (n,).
        pressure: Pressure above that at rest; shape (n,); Pa.
        unloading: Whether each sample was reached from above; shape (n,).

    Returns:
        The taxel with its curve, errors and hysteresis; no hysteresis where no level was loaded and unloaded.
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
    return CalibratedTaxel(
        taxel=taxel,
        coefficients=curve.coefficients,
        range_counts=curve.range_counts,
        rmse_pa=float(np.sqrt(np.mean((reading - pressure) ** 2))),
        error_pa=float(np.sqrt(np.mean(error**2))),
        hysteresis_pa=float(lag.mean()) if both.any() else 0.0,
        hysteresis_share=float(counts.mean()) / curve.range_counts if both.any() else 0.0,
    )


def _means(level: np.ndarray, chosen: BoolArray, *values: FloatArray) -> tuple[FloatArray, ...]:
    number = np.bincount(level[chosen], minlength=BINS)
    with np.errstate(invalid="ignore"):
        return tuple(np.bincount(level[chosen], weights=one[chosen], minlength=BINS) / number for one in values)
