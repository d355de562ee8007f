# SPDX-License-Identifier: BSD-3-Clause
"""Regress a reading at constant load on temperature, on time, and on heating against cooling.

    reading = offset_p + drift_p (t - t_p) + coefficient (T - T0) + hysteresis / 2 (1 heating, -1 cooling) + noise

in power-up p, under noise that is white and slow (`forcetorque.noise`). Hysteresis is the mean difference between
heating and cooling at the same temperature. A delay between thermometer and gauges shows as hysteresis too.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.errors import FitError
from forcetorque.evaluation.thermal.branches import LEAST_OVERLAP, compared_share
from forcetorque.evaluation.thermal.cycles import Cycles
from forcetorque.noise import regress

SAME_AS_TIME = 0.98
"""Share of the variance of a temperature that offset and time explain, from which on the two are one."""
MIXED_WITH_TIME = 0.5
"""Share of heating against cooling that offset, time and temperature explain, from which on they are hard to tell
apart: 0.75 for one even cycle, 0.19 for two."""
LEAST_RANGE_DEGC = 5.0
"""Range of temperatures below which little is told of what a day, or a motor that warms up, does; degC."""

_HOUR_S = 3600.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DriftFit:
    """Drift of k signals; half-widths are of 95 % intervals and infinite where nothing tells."""

    reference_degC: float
    """Temperature T0, the mean; degC."""
    coefficient: FloatArray
    """Change per degree; shape (k,)."""
    coefficient_error: FloatArray
    """Its standard error; shape (k,)."""
    coefficient_half_width: FloatArray
    """Shape (k,)."""
    hysteresis: FloatArray | None
    """Heating minus cooling at the same temperature; shape (k,); None where only one of them was recorded."""
    hysteresis_half_width: FloatArray | None
    """Shape (k,)."""
    drift_per_hour: FloatArray | None
    """Change with time, mean of the power-ups; shape (k,); None where it cannot be told from temperature."""
    drift_half_width: FloatArray | None
    """Of the largest half-width of a power-up; shape (k,)."""
    time_share: float
    """Share of the variance of the temperature that offset and time explain."""
    hysteresis_share: float
    """Share of heating against cooling that offset, time and temperature explain."""
    residual: FloatArray
    """What is left of the means on the branches; shape (m, k)."""
    at_temperature: FloatArray
    """The same without offset and drift in time; shape (m, k)."""

    def __post_init__(self) -> None:
        k = len(self.coefficient)
        for field in ("coefficient", "coefficient_error", "coefficient_half_width", "hysteresis"):
            self._freeze(field, (k,))
        for field in ("hysteresis_half_width", "drift_per_hour", "drift_half_width"):
            self._freeze(field, (k,))
        for field in ("residual", "at_temperature"):
            self._freeze(field, (None, k))

    def _freeze(self, field: str, shape: tuple[int | None, ...]) -> None:
        if getattr(self, field) is not None:
            object.__setattr__(self, field, read_only(getattr(self, field), name=field, shape=shape))

    @property
    def told_from_time(self) -> bool:
        """Whether drift with temperature was told from drift with time."""
        return self.drift_per_hour is not None


def fit_drift(cycles: Cycles) -> DriftFit:
    """Fit the drift of every signal.

    Args:
        cycles: Means of a record, those near turns left out (`Cycles.on_branches`).

    Returns:
        Coefficients with intervals.

    Raises:
        FitError: If the temperature does not change, or there are too few means.
    """
    temperature = cycles.temperature_degC
    if not cycles.range_degC > 0.0:
        raise FitError(f"temperature: expected one that changes, got {temperature[0]:g} degC throughout")
    offsets, times = _power_ups(cycles)
    sessions = offsets.shape[1]
    reference = float(temperature.mean())
    both = compared_share(temperature, cycles.heating) >= LEAST_OVERLAP
    branch = 0.5 * cycles.heating[:, None]
    warmth = (temperature - reference)[:, None]
    time_share = _explained(warmth, np.hstack([offsets, times]))
    apart = time_share < SAME_AS_TIME
    columns = [warmth, *([branch] if both else []), *([times] if apart else []), offsets]
    design = np.hstack(columns)
    if len(design) <= 2 * design.shape[1]:
        raise FitError(f"expected more than {2 * design.shape[1]} means of {cycles.window_s:.3g} s, got {len(design)}")
    fit = regress(cycles.line, design, cycles.signals)
    values, half = fit.coefficients, fit.half_width
    first = 2 if both else 1
    slopes = slice(first, first + sessions)
    rest = np.hstack([times, offsets]) if apart else offsets
    return DriftFit(
        reference_degC=reference,
        coefficient=values[:, 0],
        coefficient_error=fit.standard_error[:, 0] if apart else np.full(len(values), np.inf),
        coefficient_half_width=half[:, 0] if apart else np.full(len(values), np.inf),
        hysteresis=values[:, 1] if both else None,
        hysteresis_half_width=half[:, 1] if both else None,
        drift_per_hour=values[:, slopes].mean(axis=1) if apart else None,
        drift_half_width=half[:, slopes].max(axis=1) if apart else None,
        time_share=time_share,
        hysteresis_share=_explained(branch, np.hstack([offsets, times, warmth])) if both else 1.0,
        residual=cycles.signals - design @ values.T,
        at_temperature=cycles.signals - rest @ values[:, first:].T,
    )


def _power_ups(cycles: Cycles) -> tuple[FloatArray, FloatArray]:
    """Offset and time of each power-up as columns; shapes (m, p); time in hours from the mean of the power-up."""
    number = cycles.line.recording
    offsets = (number[:, None] == np.unique(number)).astype(np.float64)
    hours = cycles.time_s / _HOUR_S
    middle = (offsets.T @ hours) / offsets.sum(axis=0)
    return offsets, offsets * (hours[:, None] - middle)


def _explained(column: FloatArray, others: FloatArray) -> float:
    """Share of the variance of a column, about its mean, that others explain."""
    left = column - others @ np.linalg.lstsq(others, column, rcond=None)[0]
    total = float(((column - column.mean()) ** 2).sum())
    return 1.0 - float((left**2).sum()) / total if total > 0.0 else 1.0
