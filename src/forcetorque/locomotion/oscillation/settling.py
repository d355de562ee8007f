# SPDX-License-Identifier: BSD-3-Clause
"""How long a signal settles after a step, and how far it is from its target, with intervals."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray, require_shape
from forcetorque.base.errors import RecordingError
from forcetorque.base.noise.autocorrelation import autocorrelation
from forcetorque.base.units import NORMAL_95
from forcetorque.locomotion.oscillation.spectrum import EvenedSignal

END_SHARE = 1.0 / 3.0
"""Part of the time until the next step that tells where a signal ends, and how much it moves there anyway."""
LEAST_SAMPLES = 30
"""Samples between two steps."""
_ORDER = 3
"""Order of the polynomials that smooth."""
HELD = 0.8
"""Part of the samples over which a command that goes in steps holds its value."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Settling:
    """What a signal did after one step."""

    time_s: float
    """Instant of the step; s."""
    step: float
    """End less beginning; in the unit of the signal."""
    end: float
    """Where it ends."""
    band: float
    """Half of the band about the end within which it counts as settled."""
    settling_s: float | None
    """Time after which it stays within the band; s; None if it does not."""
    earliest_s: float
    """Lower end of the 95 % interval: what noise may have delayed; s."""
    latest_s: float
    """Upper end: infinite if noise may hide that it has not settled; s."""
    overshoot: float
    """How far it went beyond the end, over the step; 0 if it did not."""


def command_steps(time_s: FloatArray, command: FloatArray, *, name: str) -> FloatArray:
    """Find the steps of a command.

    Args:
        time_s: Instants; shape (n,); s.
        command: The command; shape (n,).
        name: What it is, for messages.

    Returns:
        Instant of each first sample of a new value; changes that follow each other without a pause are one step;
        shape (k,); s.

    Raises:
        RecordingError: If it does not go in steps.
    """
    changed = np.diff(command) != 0.0
    if not changed.any():
        raise RecordingError(f"{name}: expected a command with steps, got {command[0]:g} throughout")
    if changed.mean() > 1.0 - HELD:
        raise RecordingError(
            f"{name}: expected a command that goes in steps and holds its value between them, got one that changes in "
            f"{100.0 * float(changed.mean()):.0f} % of samples; state the instants of steps"
        )
    first = np.flatnonzero(changed & ~np.concatenate([[False], changed[:-1]]))
    return time_s[first + 1]


def settlings(signal: EvenedSignal, steps_s: Sequence[float], *, band_share: float, name: str) -> list[Settling]:
    """Tell how long a signal takes after each step until it stays where it ends.

    It ends at the mean of the last third before the next step, and is settled when it no more leaves a band of
    `band_share` of the step about that. Cubics over the time in which it first went half of the way take off what is
    faster than the motion. What noise is left moves the crossing of the edge: the interval is from where it leaves a
    band that is wider by the noise of the last third, to where it leaves one that is narrower.

    Args:
        signal: The signal.
        steps_s: Instants of the steps, rising; s.
        band_share: Half of the band over the step.
        name: What it is, for messages.

    Returns:
        What it did after each step.

    Raises:
        RecordingError: If a step lies outside, or too close to the next one, or nothing moves.
    """
    if not 0.0 < band_share < 1.0:
        raise RecordingError(f"band: expected a share of the step between 0 and 1, got {band_share:g}")
    time = signal.time_s + 0.5 / signal.rate_hz  # instants of samples are rounded: a step is between two of them
    ends = [*steps_s[1:], math.inf][: len(steps_s)]
    rows: list[Settling] = []
    begin = -math.inf
    for start, end in zip(steps_s, ends, strict=True):
        before = signal.values[(time >= begin) & (time < start)]
        after = (time >= start) & (time < end)
        if len(before) < LEAST_SAMPLES or after.sum() < LEAST_SAMPLES:
            raise RecordingError(
                f"{name}: step at {start:.3f} s: expected at least {LEAST_SAMPLES} samples before and behind it, got "
                f"{len(before)} and {int(after.sum())}"
            )
        level = float(before[-max(1, round(END_SHARE * len(before))) :].mean())
        rows.append(_settling(signal.time_s[after] - start, signal.values[after], level, start, band_share, name))
        begin = start
    return rows


def _settling(
    since: FloatArray, values: FloatArray, level: float, start: float, band_share: float, name: str
) -> Settling:
    last = slice(len(values) - max(1, round(END_SHARE * len(values))), None)
    end = float(values[last].mean())
    step = end - level
    halfway = np.abs(values - level) >= 0.5 * abs(step)
    values = _smooth(values, int(halfway.argmax()))
    noise = float(values[last].std())
    apart = np.abs(values - end)
    band = band_share * abs(step)
    if not abs(step) > 0.0 or abs(step) < NORMAL_95 * noise:
        raise RecordingError(
            f"{name}: step at {start:.3f} s: expected a signal that goes somewhere, got {step:.3g} where it moves by "
            f"{noise:.3g} anyway; choose another column, or another instant"
        )
    worth = autocorrelation(values[last], since[last]).effective_count if noise > 0.0 else math.inf
    doubt = NORMAL_95 * noise * math.sqrt(1.0 + 1.0 / max(worth, 1.0))

    def leaves(edge: float) -> float:
        outside = np.flatnonzero(apart > edge) if edge > 0.0 else np.array([len(apart) - 1])
        if not len(outside):
            return 0.0
        k = int(outside[-1])
        return float(since[k + 1]) if k + 1 < len(since) else math.inf

    settles, latest, settled_by = leaves(band), leaves(band - doubt), float(since[last][0])
    beyond = float(((values - end) * math.copysign(1.0, step)).max()) / abs(step)
    return Settling(
        time_s=start,
        step=step,
        end=end,
        band=band,
        settling_s=settles if settles <= settled_by else None,
        earliest_s=min(leaves(band + doubt), float(since[-1])),
        latest_s=latest if latest <= settled_by else math.inf,
        overshoot=max(0.0, beyond),
    )


def _smooth(values: FloatArray, window: int) -> FloatArray:
    from scipy.signal import savgol_filter  # here because importing it takes longer than most commands

    odd = window // 2 * 2 + 1
    if odd <= _ORDER + 1:
        return values
    return savgol_filter(values, min(odd, len(values) // 2 * 2 - 1), _ORDER)


_ROUNDING = 1e-12
"""Part of the error below which its variance is rounding: a constant error has no interval."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TrackingError:
    """Errors of following a desired value."""

    rms: float
    """Root mean square; in the unit of both."""
    lower: float
    """Lower end of its 95 % interval."""
    upper: float
    """Upper end."""
    mean: float
    """Mean error, measured less desired: what an offset of the sensor or friction leaves."""
    count: int
    """Samples."""
    effective_count: float
    """Independent samples that have a mean as well known."""


def tracking_error(time_s: Any, desired: Any, measured: Any, *, name: str) -> TrackingError:
    """Tell the root mean square of a tracking error.

    The mean square is taken for a multiple of chi-square, whose degrees of freedom are those of its variance [1]. For
    errors of mean m, variance v and autocorrelation rho, were they Gaussian, that is

        (2 v^2 sum rho^2 + 4 m^2 v sum rho) / n

    with sums over both sides. Where few independent samples are left, their own variance and correlation are known
    badly: the variance is made up for the mean, the degrees of freedom are divided by 1 + 4 sum rho / n (a heuristic).

    Args:
        time_s: Instants, not falling; shape (n,); s.
        desired: What was wanted; shape (n,).
        measured: What came; shape (n,). Samples where either is no finite number do not count.
        name: What it is, for messages.

    Returns:
        The error; its interval is as wide as the record is short.

    Raises:
        RecordingError: If no sample has both.

    References:
        [1] F. E. Satterthwaite, An approximate distribution of estimates of variance components, Biometrics 2 (1946).
    """
    from scipy.special import chdtri  # here because importing it takes longer than most commands

    error = np.asarray(measured, dtype=np.float64) - np.asarray(desired, dtype=np.float64)
    require_shape(error, name="measured", shape=np.shape(time_s))
    known = np.isfinite(error)
    if known.sum() < 2:
        raise RecordingError(f"{name}: expected samples with both a desired and a measured value, got {known.sum()}")
    mean_square, variance = float((error[known] ** 2).mean()), float(error[known].var())
    rms, mean, count = math.sqrt(mean_square), float(error[known].mean()), int(known.sum())
    lower, upper, effective = rms, rms, float(count)
    if variance > (_ROUNDING * rms) ** 2:
        correlation = autocorrelation(error, time_s)
        effective = correlation.effective_count
        part = min(1.0 / effective, 0.5)
        rho = correlation.rho[1 : max(correlation.window, 1)]
        variance /= 1.0 - part
        squared = (1.0 + 2.0 * float(rho @ rho)) / count
        of_square = 2.0 * variance**2 * squared + 4.0 * mean**2 * variance * part
        freedom = 2.0 * mean_square**2 / of_square / (1.0 + 4.0 * part)
        lower, upper = (rms * math.sqrt(freedom / float(chdtri(freedom, tail))) for tail in (0.025, 0.975))
    return TrackingError(
        rms=rms,
        lower=lower,
        upper=upper,
        mean=mean,
        count=count,
        effective_count=effective,
    )
