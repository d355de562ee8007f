# SPDX-License-Identifier: BSD-3-Clause
"""How long a signal settles after a step, and how far it is from its target, with intervals."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Annotated

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import RecordingError
from forcetorque.base.noise.autocorrelation import autocorrelation
from forcetorque.base.units import NORMAL_95
from forcetorque.locomotion.logged_signals import MotionSignal
from forcetorque.locomotion.oscillation.spectrum import ResampledSignal
from forcetorque.results.table import Row, Shown

END_SHARE = 1.0 / 3.0
"""Part of the time until the next step that shows where a signal ends, and how much it moves there anyway."""
LEAST_SAMPLES = 30
"""Samples between two steps."""
_ORDER = 3
"""Order of the polynomials that smooth."""
HELD = 0.8
"""Part of the samples over which a command that goes in steps holds its value."""


class SettlingRow(Row):
    """What a column did after one step."""

    interval: Annotated[str, Shown("interval")]
    """Label of the interval."""
    column: Annotated[str, Shown("column")]
    """Name of the column."""
    step_at_s: Annotated[float, Shown("step at", "s", digits=3)]
    """Instant of the step, from the start of the recording."""
    step: Annotated[float, Shown("step", digits=5)]
    """How far it went, in `unit`."""
    unit: Annotated[str, Shown("unit")]
    """Unit of the column."""
    settling_s: Annotated[float | None, Shown("settles in", "s", digits=3)]
    """Time after which it stays within the band; null if it does not before the next step."""
    earliest_s: Annotated[float, Shown("from", "s", digits=3)]
    """Lower end of its 95 % interval."""
    latest_s: Annotated[float | None, Shown("to", "s", digits=3)]
    """Upper end; null if noise may hide that it has not settled."""
    band: float
    """Half of the band about the end, in `unit`."""
    overshoot_percent: Annotated[float, Shown("overshoot", "%", digits=1)]
    """How far it went beyond its end, of the step."""
    left_error: Annotated[float | None, Shown("left error", digits=5)]
    """Where it ended less what was wanted there, in `unit`; null where nothing says what was wanted."""


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


def settlings(
    signal: MotionSignal, even: ResampledSignal, steps_s: Sequence[float], *, band_share: float
) -> list[SettlingRow]:
    """Measure how long a signal takes after each step until it stays where it ends.

    It ends at the mean of the last third before the next step, and is settled when it no more leaves a band of
    `band_share` of the step about that. Cubics over the time in which it first went half of the way take off what is
    faster than the motion. What noise is left moves the crossing of the edge: the interval is from where it leaves a
    band that is wider by the noise of the last third, to where it leaves one that is narrower.

    Args:
        signal: The signal as logged, with what was desired of it.
        even: Its values at even instants.
        steps_s: Instants of the steps, rising; s.
        band_share: Half of the band over the step.

    Returns:
        Settling time, overshoot and final error after each step.

    Raises:
        RecordingError: If a step lies outside, or too close to the next one, or nothing moves.
    """
    if not 0.0 < band_share < 1.0:
        raise RecordingError(f"band: expected a share of the step between 0 and 1, got {band_share:g}")
    time = even.time_s + 0.5 / even.rate_hz  # instants of samples are rounded: a step is between two of them
    ends = [*steps_s[1:], math.inf][: len(steps_s)]
    rows: list[SettlingRow] = []
    begin = -math.inf
    for start, end in zip(steps_s, ends, strict=True):
        before = even.values[(time >= begin) & (time < start)]
        after = (time >= start) & (time < end)
        if len(before) < LEAST_SAMPLES or after.sum() < LEAST_SAMPLES:
            raise RecordingError(
                f"{signal.name}: step at {start:.3f} s: expected at least {LEAST_SAMPLES} samples before and behind "
                f"it, got {len(before)} and {int(after.sum())}"
            )
        level = float(before[-max(1, round(END_SHARE * len(before))) :].mean())
        rows.append(_settling(signal, even.time_s[after] - start, even.values[after], level, start, band_share))
        begin = start
    return rows


def _settling(
    signal: MotionSignal, since: FloatArray, values: FloatArray, level: float, start: float, band_share: float
) -> SettlingRow:
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
            f"{signal.name}: step at {start:.3f} s: expected a signal that goes somewhere, got {step:.3g} where it "
            f"moves by {noise:.3g} anyway; choose another column, or another instant"
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
    desired = _desired_after(signal, start)
    return SettlingRow(
        interval=signal.interval,
        column=signal.column,
        step_at_s=start,
        step=step,
        unit=signal.unit,
        settling_s=settles if settles <= settled_by else None,
        earliest_s=min(leaves(band + doubt), float(since[-1])),
        latest_s=latest if latest <= settled_by and math.isfinite(latest) else None,
        band=band,
        overshoot_percent=100.0 * max(0.0, beyond),
        left_error=None if desired is None else end - desired,
    )


def _desired_after(signal: MotionSignal, start: float) -> float | None:
    """Value that the command holds after a step: the first that it keeps for more than one sample."""
    if signal.desired_values is None:
        return None
    command = signal.desired_values[np.isfinite(signal.desired_values) & (signal.time_s >= start)]
    if not len(command):
        return None
    changes = np.flatnonzero(np.diff(command) != 0.0)
    edges = np.concatenate([[-1], changes, [len(command) - 1]])
    held = np.diff(edges)
    return float(command[edges[1 + int((held > 1).argmax())]])


def _smooth(values: FloatArray, window: int) -> FloatArray:
    from scipy.signal import savgol_filter  # here because importing it takes longer than most commands

    odd = window // 2 * 2 + 1
    if odd <= _ORDER + 1:
        return values
    return savgol_filter(values, min(odd, len(values) // 2 * 2 - 1), _ORDER)


_ROUNDING = 1e-12
"""Part of the error below which its variance is rounding: a constant error has no interval."""


class TrackingRow(Row):
    """How far a column is from what was wanted of it."""

    interval: Annotated[str, Shown("interval")]
    """Label of the interval."""
    column: Annotated[str, Shown("column")]
    """Name of the column."""
    desired: Annotated[str, Shown("desired")]
    """Column of what was wanted."""
    rms: Annotated[float, Shown("RMS error", digits=5)]
    """Root mean square of the difference, in `unit`."""
    rms_lower_95: Annotated[float, Shown("from", digits=5)]
    """Lower end of its 95 % interval."""
    rms_upper_95: Annotated[float, Shown("to", digits=5)]
    """Upper end."""
    mean_error: Annotated[float, Shown("mean error", digits=5)]
    """Mean of the difference."""
    unit: Annotated[str, Shown("unit")]
    """Unit of both."""
    samples: Annotated[int, Shown("samples")]
    """Samples with both."""
    effective_samples: Annotated[float, Shown("worth", digits=0)]
    """Independent samples with a mean as well known."""


def tracking_error(signal: MotionSignal) -> TrackingRow:
    """Compute the root mean square of a tracking error.

    The mean square is taken for a multiple of chi-square, whose degrees of freedom are those of its variance [1]. For
    errors of mean m, variance v and autocorrelation rho, were they Gaussian, that is

        (2 v^2 sum rho^2 + 4 m^2 v sum rho) / n

    with sums over both sides. Where few independent samples are left, their own variance and correlation are known
    badly: the variance is made up for the mean, the degrees of freedom are divided by 1 + 4 sum rho / n (a heuristic).

    Args:
        signal: Measured and desired values; samples where either is no finite number do not count.

    Returns:
        The error; its interval is as wide as the record is short.

    Raises:
        RecordingError: If fewer than two samples have both.

    References:
        [1] F. E. Satterthwaite, An approximate distribution of estimates of variance components, Biometrics 2 (1946).
    """
    from scipy.special import chdtri  # here because importing it takes longer than most commands

    desired = np.full(len(signal.values), np.nan) if signal.desired_values is None else signal.desired_values
    error = signal.values - desired
    known = np.isfinite(error)
    if known.sum() < 2:
        raise RecordingError(
            f"{signal.name}: expected samples with both a desired and a measured value, got {known.sum()}"
        )
    mean_square, variance = float((error[known] ** 2).mean()), float(error[known].var())
    rms, mean, count = math.sqrt(mean_square), float(error[known].mean()), int(known.sum())
    lower, upper, effective = rms, rms, float(count)
    if variance > (_ROUNDING * rms) ** 2:
        correlation = autocorrelation(error, signal.time_s)
        effective = correlation.effective_count
        part = min(1.0 / effective, 0.5)
        rho = correlation.rho[1 : max(correlation.window, 1)]
        variance /= 1.0 - part
        squared = (1.0 + 2.0 * float(rho @ rho)) / count
        of_square = 2.0 * variance**2 * squared + 4.0 * mean**2 * variance * part
        freedom = 2.0 * mean_square**2 / of_square / (1.0 + 4.0 * part)
        lower, upper = (rms * math.sqrt(freedom / float(chdtri(freedom, tail))) for tail in (0.025, 0.975))
    return TrackingRow(
        interval=signal.interval,
        column=signal.column,
        desired=signal.desired or "",
        rms=rms,
        rms_lower_95=lower,
        rms_upper_95=upper,
        mean_error=mean,
        unit=signal.unit,
        samples=count,
        effective_samples=effective,
    )
