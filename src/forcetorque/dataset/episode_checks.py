# SPDX-License-Identifier: BSD-3-Clause
"""One force field in one episode: dead, stuck and missing values, noise, level at rest, weight against gravity."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, array, true_runs
from forcetorque.formats.specified_signals import even_stamps
from forcetorque.recording.frozen_and_saturated_samples import flat_tops, ranges_of, white_variance

_BY_CHANCE = 1e-6
"""Chance of a run of equal values, by how often values repeat elsewhere in the episode, below which it is stuck."""
_SHORTEST_S, _SHORTEST_FRAMES = 0.2, 5
"""Runs that are shorter are no fault: a slow sensor in a faster dataset repeats its values."""
_REST_S = 0.3
"""Length of the window whose level is that at rest; s."""
_FEWEST = 12
"""Frames from which on weight and bias are separable."""
_LEAST_TURN = 0.05
"""Least standard deviation of the direction of gravity along the second of its principal axes (heuristic): where it
turns less, weight and bias are not separable."""
_ROUNDS, _TUNED, _SETTLED = 10, 1.345, 1e-6
"""Most rounds of weights by Huber, the residual, in standard deviations, from which on a frame counts less, and the
change of the slope that ends them."""
_MEDIAN_NORM = 1.538
"""Median norm of three standard normal numbers (`scipy.special.gammaincinv(1.5, 0.5)`, doubled, its root)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class EqualRun:
    """Frames in which one component repeats its value for longer than by chance."""

    component: int
    """Number of the component."""
    first: int
    """Its first frame."""
    frames: int
    """Number of frames."""
    value: float
    """The value."""
    at_end: bool
    """Whether it is the largest or the smallest value of the episode."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WeightFit(ArrayRecord):
    """What a wrench has of gravity in one episode: `force = weight d + bias`, d the unit vector downwards."""

    weight: float
    """In the unit of the force; negative where the sensor measures the reaction."""
    error: float
    """Its standard error."""
    bias: FloatArray = field(metadata=array(3))
    """Bias of the force, in its unit; shape (3,)."""
    bias_error: FloatArray = field(metadata=array(3))
    """Standard errors; shape (3,)."""
    late_frames: int
    """Frames by which the force follows gravity, by the lag that leaves least; 0 where no other leaves clearly less."""
    at_end_of_lags: bool
    """Whether that lag is the largest that was tried, so that it is none."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EpisodeField(ArrayRecord):
    """A field of k components in one episode of n frames."""

    episode: int
    """Number of the episode."""
    frames: int
    """Number n of frames."""
    missing: FloatArray = field(metadata=array("k"))
    """Frames without a finite value; shape (k,)."""
    constant: FloatArray = field(metadata=array("k"))
    """The only value of components that have one only, else NaN; shape (k,)."""
    smallest: FloatArray = field(metadata=array("k"))
    """Smallest value; NaN where there is none; shape (k,)."""
    largest: FloatArray = field(metadata=array("k"))
    """Largest value; shape (k,)."""
    noise: FloatArray = field(metadata=array("k"))
    """Standard deviation of white noise, NaN where too few frames tell; shape (k,)."""
    rest: FloatArray = field(metadata=array("k"))
    """Level in the quietest window; shape (k,)."""
    clipped: FloatArray = field(metadata=array("k"))
    """Frames at an end of the range to which the component jumped; shape (k,)."""
    runs: tuple[EqualRun, ...]
    """Runs of equal values beyond chance, of components that have other values too."""
    force_size: float
    """95 % quantile of the norm of the force, of a wrench; else NaN."""
    lever: float
    """Spread of the moment over that of the force, of a wrench; else NaN."""
    weight: WeightFit | None = None
    """What it has of gravity; None where that is not separable from the bias, or not logged."""


def examined(
    episode: int, values: FloatArray, rate_hz: float, *, is_wrench: bool, gravity: FloatArray | None
) -> EpisodeField:
    """Examine a field in an episode.

    Args:
        episode: Number of the episode.
        values: Its frames; shape (n, k); NaN where a value is missing.
        rate_hz: Frames per second.
        is_wrench: Whether the components are force and moment.
        gravity: Gravity along the axes of the force; shape (n, 3); m/s2; None where it is not known.

    Returns:
        What is in it.
    """
    n, width = values.shape
    finite = np.isfinite(values)
    known = finite.any(axis=0)
    shown = np.where(finite, values, np.nan)
    smallest, largest = np.full(width, np.nan), np.full(width, np.nan)
    if n and known.any():
        smallest[known], largest[known] = np.nanmin(shown[:, known], axis=0), np.nanmax(shown[:, known], axis=0)
    constant = np.where(known & (smallest == largest), smallest, np.nan)
    runs = tuple(run for k in np.flatnonzero(known & np.isnan(constant)) for run in equal_runs(int(k), shown, rate_hz))
    sound = shown.copy()  # what is stuck is neither noise nor weight, and neither are the jumps at its ends
    for run in runs:
        sound[run.first : run.first + run.frames, run.component] = np.nan
    noise = np.full(width, np.nan)
    if n:
        variance = white_variance(even_stamps(n, rate_hz=rate_hz, start_s=0.0), sound)
        noise = np.where(variance > 0.0, np.sqrt(variance), np.nan)
    weighs = gravity is not None and is_wrench and bool(np.isnan(constant[:3]).all())
    force_size, lever = _sizes(shown) if is_wrench and n and finite.all(axis=1).any() else (np.nan, np.nan)
    return EpisodeField(
        episode=episode,
        frames=n,
        missing=(~finite).sum(axis=0).astype(np.float64),
        constant=constant,
        smallest=smallest,
        largest=largest,
        noise=noise,
        rest=_rest(shown, rate_hz),
        clipped=_clipped(shown, runs),
        runs=runs,
        force_size=force_size,
        lever=lever,
        weight=weight_fit(sound, gravity) if weighs and gravity is not None else None,
    )


def equal_runs(component: int, values: FloatArray, rate_hz: float) -> list[EqualRun]:
    """Find runs of equal values that the values elsewhere in the episode make unlikely.

    Args:
        component: Number of the component.
        values: Frames of the field; shape (n, k); NaN in gaps.
        rate_hz: Frames per second.

    Returns:
        The runs, during which another component changes where there is one.
    """
    column = values[:, component]
    same = np.diff(column) == 0.0
    least = max(_SHORTEST_FRAMES, round(_SHORTEST_S * rate_hz))
    found = [(first, last + 1) for first, last in true_runs(same) if last + 2 - first >= least]
    kept = []
    for first, last in found:
        elsewhere = np.ones(len(same), dtype=bool)
        for start, end in found:
            elsewhere[start:end] = False
        if not elsewhere.any() or not _others_move(values[first : last + 1], component):
            continue
        # a share from counts, with one more of either kind, so that no repeat elsewhere is no certainty
        share = (np.count_nonzero(same & elsewhere) + 1) / (np.count_nonzero(elsewhere) + 2)
        if len(same) * share ** (last - first) < _BY_CHANCE:
            value = float(column[first])
            at_end = bool(value in (np.nanmin(column), np.nanmax(column)))
            kept.append(EqualRun(component=component, first=first, frames=last - first + 1, value=value, at_end=at_end))
    return kept


def _others_move(values: FloatArray, component: int) -> bool:
    """Whether another component of the same field changes meanwhile; a single one has none to compare with."""
    others = np.delete(values, component, axis=1)
    return not others.shape[1] or bool((ranges_of(others) > 0.0).any())


def _clipped(values: FloatArray, runs: tuple[EqualRun, ...]) -> FloatArray:
    clipped = np.zeros(values.shape[1])
    for k, column in enumerate(values.T):
        whole = column[np.isfinite(column)]
        if len(whole) > 1:
            clipped[k] = np.count_nonzero(flat_tops(whole))
    for run in runs:  # which are counted by themselves
        clipped[run.component] = max(0.0, clipped[run.component] - run.frames)
    return clipped


def _rest(values: FloatArray, rate_hz: float) -> FloatArray:
    """Mean of the window in which the field changes least, in the spread of each component."""
    size = max(_SHORTEST_FRAMES, round(_REST_S * rate_hz))
    whole = values[np.isfinite(values).all(axis=1)]
    if len(whole) <= size:
        return whole.mean(axis=0) if len(whole) else np.full(values.shape[1], np.nan)
    scale = np.maximum(whole.std(axis=0), 1e-12 * (1.0 + np.abs(whole).max(axis=0)))
    windows = np.lib.stride_tricks.sliding_window_view(whole / scale, size, axis=0)
    quietest = int(windows.var(axis=2).sum(axis=1).argmin())
    return np.asarray(whole[quietest : quietest + size].mean(axis=0))


def _sizes(values: FloatArray) -> tuple[float, float]:
    whole = values[np.isfinite(values).all(axis=1)]
    spread = [float(np.sqrt(whole[:, part].var(axis=0).sum())) for part in (slice(0, 3), slice(3, 6))]
    force = float(np.quantile(np.linalg.norm(whole[:, :3], axis=1), 0.95))
    return force, spread[1] / spread[0] if spread[0] > 0.0 else np.nan


_LAGS = 10
"""Largest lag that is tried; frames."""
_CLEARLY = 0.8
"""A lag counts where it leaves less than this share of the residual without one."""


def weight_fit(wrench: FloatArray, gravity: FloatArray) -> WeightFit | None:
    """Separate weight and bias of a force by the turning of gravity.

    Args:
        wrench: Force and moment; shape (n, 6).
        gravity: Along the axes of the force; shape (n, 3).

    Returns:
        Weight, bias and lag; None where gravity turns too little, or there are too few frames.
    """
    size = np.linalg.norm(gravity, axis=1, keepdims=True)
    usable: BoolArray = np.asarray(np.isfinite(np.hstack([wrench, gravity])).all(axis=1))
    if np.count_nonzero(usable) < _FEWEST or not _turns(gravity[usable] / size[usable]):
        return None
    down = gravity / size
    weight, error, bias, bias_error, weights, left = _fitted(wrench[usable, :3], down[usable])
    of_frames = np.zeros(len(down))
    of_frames[usable] = weights
    lags = range(-min(_LAGS, len(down) // 4), min(_LAGS, len(down) // 4) + 1)
    residuals = {0: left}
    for lag in lags if weight != 0.0 else ():
        ahead, behind = down[max(0, -lag) : len(down) - max(0, lag)], slice(max(0, lag), len(down) + min(0, lag))
        both = usable[behind] & np.isfinite(ahead).all(axis=1)
        if np.count_nonzero(both) >= _FEWEST and _turns(ahead[both]):
            residuals[lag] = float(np.median(_line(wrench[behind, :3][both], ahead[both], of_frames[behind][both])[3]))
    best = min(residuals, key=lambda lag: (residuals[lag], abs(lag)))
    late = best if residuals[best] < _CLEARLY * left else 0
    return WeightFit(
        weight=weight,
        error=error,
        bias=bias,
        bias_error=bias_error,
        late_frames=late,
        at_end_of_lags=late != 0 and late in (min(residuals), max(residuals)),
    )


def _turns(down: FloatArray) -> bool:
    return bool(np.linalg.svd(down - down.mean(axis=0), compute_uv=False)[1] > _LEAST_TURN * np.sqrt(len(down)))


def _line(force: FloatArray, down: FloatArray, weights: FloatArray) -> tuple[float, FloatArray, float, FloatArray]:
    """Weight and bias by least squares, the sum of squares that determines the weight, and sizes of what is left."""
    share = weights / weights.sum()
    mean_down, mean_force = share @ down, share @ force
    turned = down - mean_down
    moment = float(weights @ (turned**2).sum(axis=1))
    slope = float(weights @ (turned * (force - mean_force)).sum(axis=1)) / moment
    bias = mean_force - slope * mean_down
    return slope, bias, moment, np.linalg.norm(force - slope * down - bias, axis=1)


def _fitted(force: FloatArray, down: FloatArray) -> tuple[float, float, FloatArray, FloatArray, FloatArray, float]:
    """Weight, its error, bias, its errors, weights of the frames, and the median size of what is left."""
    weights = np.ones(len(force))
    slope, bias, moment, left = _line(force, down, weights)
    scale = float(np.median(left)) / _MEDIAN_NORM
    for _ in range(_ROUNDS if scale > 0.0 else 0):
        weights = np.minimum(1.0, _TUNED * np.sqrt(3.0) * scale / np.maximum(left, 1e-300))
        before = slope
        slope, bias, moment, left = _line(force, down, weights)
        scale = float(np.median(left)) / _MEDIAN_NORM
        if abs(slope - before) <= _SETTLED * abs(slope):
            break
    # neighbouring frames go together where contacts last: fewer of them count
    residual = force - slope * down - bias
    products = float((residual[1:] * residual[:-1]).sum()) / max(float((residual**2).sum()), 1e-300)
    together = min(max(products, 0.0), 0.95)
    inflated = scale * np.sqrt((1.0 + together) / (1.0 - together))
    error = inflated / np.sqrt(moment)
    total = float(weights.sum())
    bias_error = inflated * np.sqrt(1.0 / total + (weights @ down / total) ** 2 / moment)
    return slope, float(error), bias, np.asarray(bias_error), weights, float(np.median(left))
