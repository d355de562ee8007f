# SPDX-License-Identifier: BSD-3-Clause
"""Regression of a measurement at constant load on temperature and time, and steps of the load."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array
from forcetorque.base.errors import FitError
from forcetorque.base.noise.slow_noise import half_width, regress
from forcetorque.base.units import MAD_TO_DEVIATION
from forcetorque.sensor.temperature.cycles import LEAST_OVERLAP, Cycles, compared_share

SAME_AS_TIME = 0.98
"""Share of the variance of a temperature that offset and time explain, from which on the two are one."""
MIXED_WITH_TIME = 0.5
"""Share of heating against cooling that offset, time and temperature explain, from which on they are hard to
separate: 0.75 for one even cycle, 0.19 for two."""
LEAST_RANGE_DEGC = 5.0
"""Range of temperatures below which little is determined of what a day, or a motor that warms up, does; degC."""

USUAL_LAG_S = 120.0
"""How late a thermometer is, or how early, as a standard deviation before the record is seen; s."""

LAG_UNTOLD_S = 0.5 * USUAL_LAG_S
"""Standard error of a lag from which on a record hardly determines it; s."""

_HOUR_S = 3600.0
_LAG_STEPS = 4
"""Steps in which a lag settles: readings are nearly linear in it."""
_SPEED_SHARE = 0.5
"""Share of the noise of a thermometer in what the other columns leave of its speed, from which on it shows no lag."""
_SPEED_MEANS = 3
"""Means to either side over which the speed of a temperature is taken."""
_NODES, _WEIGHTS = np.array([-1.0, 0.0, 1.0]) * np.sqrt(3.0), np.array([1.0, 4.0, 1.0]) / 6.0
"""Lags about the best one in standard errors, and what each counts (Gauss-Hermite)."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DriftFit(ArrayRecord):
    """Drift of k signals; half-widths are of 95 % intervals and infinite where it is not determined."""

    reference_degC: float
    """Temperature T0, the mean; degC."""
    coefficient: FloatArray = field(metadata=array("k"))
    """Change per degree; shape (k,)."""
    coefficient_error: FloatArray = field(metadata=array("k"))
    """Its standard error; shape (k,)."""
    coefficient_half_width: FloatArray = field(metadata=array("k"))
    """Shape (k,)."""
    hysteresis: FloatArray | None = field(metadata=array("k"))
    """Heating minus cooling at the same temperature; shape (k,); None where only one of them was recorded."""
    hysteresis_half_width: FloatArray | None = field(metadata=array("k"))
    """Shape (k,)."""
    drift_per_hour: FloatArray | None = field(metadata=array("k"))
    """Change with time, mean of the power-ups; shape (k,); None where it is not separable from temperature."""
    drift_half_width: FloatArray | None = field(metadata=array("k"))
    """Of the largest half-width of a power-up; shape (k,)."""
    lag_s: float
    """By how much the thermometer is later than the gauges, as determined by all signals and by what is usual; s."""
    lag_error_s: float
    """Its standard error; s: of the signal that shows it best, because noise of signals may go together; 0 where
    heating and cooling are so even that a lag is hysteresis, and changes nothing else."""
    hysteresis_share: float
    """Share of heating against cooling that offset, time and temperature explain."""
    residual: FloatArray = field(metadata=array("m", "k"))
    """What is left of the means on the branches; shape (m, k)."""
    at_temperature: FloatArray = field(metadata=array("m", "k"))
    """The same without offset and drift in time; shape (m, k)."""

    @property
    def separable_from_time(self) -> bool:
        """Whether drift with temperature was separable from drift with time."""
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
    others = [*([branch] if both else []), *([times] if apart else []), offsets]
    design = np.hstack([warmth, *others])
    if len(design) <= 2 * design.shape[1]:
        raise FitError(f"expected more than {2 * design.shape[1]} means of {cycles.window_s:.3g} s, got {len(design)}")
    lag, error = _lag(cycles, np.hstack(others)) if apart else (0.0, 0.0)
    fits, weights = [], []
    for node, weight in zip(_NODES, _WEIGHTS, strict=True):
        for late in _corrected(cycles, lag + error * node):
            fits.append(regress(cycles.line, np.hstack([late - reference, *others]), cycles.signals))
            weights.append(0.5 * weight)
    values = np.einsum("l,lkp->kp", weights, [one.coefficients for one in fits])
    spread = [one.standard_error**2 + (one.coefficients - values) ** 2 for one in fits]
    variance = np.einsum("l,lkp->kp", weights, spread)
    central = fits[2]  # without a delay of the best lag
    half = half_width(np.sqrt(variance), central.degrees_of_freedom)
    residual = cycles.signals - np.hstack([_corrected(cycles, lag)[0] - reference, *others]) @ central.coefficients.T
    first = 2 if both else 1
    slopes = slice(first, first + sessions)
    rest = np.hstack([times, offsets]) if apart else offsets
    return DriftFit(
        reference_degC=reference,
        coefficient=values[:, 0],
        coefficient_error=np.sqrt(variance[:, 0]) if apart else np.full(len(values), np.inf),
        coefficient_half_width=half[:, 0] if apart else np.full(len(values), np.inf),
        hysteresis=values[:, 1] if both else None,
        hysteresis_half_width=half[:, 1] if both else None,
        drift_per_hour=values[:, slopes].mean(axis=1) if apart else None,
        drift_half_width=half[:, slopes].max(axis=1) if apart else None,
        lag_s=lag,
        lag_error_s=error,
        hysteresis_share=_explained(branch, np.hstack([offsets, times, warmth])) if both else 1.0,
        residual=residual,
        at_temperature=cycles.signals - rest @ values[:, first:].T,
    )


def _corrected(cycles: Cycles, lag_s: float) -> tuple[FloatArray, FloatArray]:
    """Temperature without a delay, and without a first-order lag, less what the mean speeds make; shapes (m, 1)."""
    speed = _speed(cycles, 0.0)
    taken = lag_s * _mean_speed(cycles, speed)
    first_order = cycles.temperature_degC + lag_s * speed
    return (cycles.temperature_after(lag_s) - taken)[:, None], (first_order - taken)[:, None]


def _speed(cycles: Cycles, lag_s: float) -> FloatArray:
    """How fast the temperature changes after a lag; shape (m,); degC/s."""
    beside = _SPEED_MEANS * cycles.window_s
    ahead, behind = (cycles.temperature_after(lag_s + side * beside) for side in (1.0, -1.0))
    return (ahead - behind) / (2.0 * beside)


def _speed_noise(cycles: Cycles) -> float:
    """Standard deviation of the noise of a speed, by how temperatures jump about their neighbours; degC/s."""
    bent = np.concatenate([np.diff(degrees, n=2) for _, degrees in cycles.recorded])
    noise = MAD_TO_DEVIATION * float(np.median(np.abs(bent))) / np.sqrt(6.0) if len(bent) else np.inf
    return float(noise / (np.sqrt(2.0) * _SPEED_MEANS * cycles.window_s))


def _mean_speed(cycles: Cycles, speed: FloatArray) -> FloatArray:
    """Mean of a speed over heating, or over cooling; shape (m,)."""
    mean = np.zeros(len(speed))
    for sign in (-1.0, 1.0):
        mine = cycles.heating == sign
        mean[mine] = speed[mine].mean() if mine.any() else 0.0
    return mean


def _lag(cycles: Cycles, others: FloatArray) -> tuple[float, float]:
    """Lag of the thermometer and its standard error; s."""
    lag, usual = 0.0, USUAL_LAG_S**-2
    for _ in range(_LAG_STEPS):
        speed = _speed(cycles, lag) - _mean_speed(cycles, _speed(cycles, 0.0))
        warmth = _corrected(cycles, lag)[0]
        design = np.hstack([warmth - warmth.mean(), speed[:, None], others])
        rest = np.delete(design, 1, axis=1)
        left = speed - rest @ np.linalg.lstsq(rest, speed, rcond=None)[0]
        noise = _speed_noise(cycles) ** 2
        if noise > _SPEED_SHARE * float((speed**2).mean()):
            return 0.0, 0.0  # heated and cooled evenly: a lag is hysteresis, and changes nothing else
        if noise > _SPEED_SHARE * float((left**2).mean()):
            return 0.0, USUAL_LAG_S
        fit = regress(cycles.line, design, cycles.signals)
        slope, change = fit.coefficients[:, 0], fit.coefficients[:, 1]
        variance = fit.covariance[:, 1, 1]
        known = np.isfinite(variance) & (variance > 0.0)
        precision = slope[known] ** 2 / variance[known]
        sides = (slope[known] * change[known] / variance[known]).sum() - usual * lag
        lag += float(sides / (precision.sum() + usual))
    return lag, float((precision.max(initial=0.0) + usual) ** -0.5)


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


BESIDE = 5
"""Means on either side of a step that are compared."""
STEP_DEVIATIONS = 8.0
"""Robust deviations of such differences from which on one is a step, not noise: by simulation of white and slow noise
no record of 200 had one."""


def find_load_step(cycles: Cycles, residual: FloatArray) -> tuple[float, int, float] | None:
    """Find a step in the residual of a fit.

    Args:
        cycles: Means that were fitted.
        residual: What the fit left; shape (m, k).

    Returns:
        Of the step that stands out most when it is, s, which signal it is of, from 0, and how large it is, in the unit
        of the signal; None where none does.
    """
    if len(residual) <= 4 * BESIDE:
        return None
    sums = np.cumsum(np.vstack([np.zeros(residual.shape[1]), residual]), axis=0)
    means = (sums[BESIDE:] - sums[:-BESIDE]) / BESIDE
    difference = means[BESIDE:] - means[:-BESIDE]  # of the mean from BESIDE + i on to the one before
    number = cycles.line.recording
    difference[number[BESIDE:][: len(difference)] != number[: len(difference)]] = (
        0.0  # a new power-up has its own offset
    )
    scale = MAD_TO_DEVIATION * np.median(np.abs(difference), axis=0)
    outstanding = np.abs(difference) / np.where(scale > 0.0, scale, np.inf)
    at, signal = np.unravel_index(int(outstanding.argmax()), outstanding.shape)
    if outstanding[at, signal] < STEP_DEVIATIONS:
        return None
    return float(cycles.time_s[at + BESIDE]), int(signal), float(abs(difference[at, signal]))
