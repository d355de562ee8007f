# SPDX-License-Identifier: BSD-3-Clause
"""Impacts and releases in a record, and frequency and damping of the free decay after each of them."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array
from forcetorque.base.errors import FitError, RecordingError
from forcetorque.base.units import MAD_TO_DEVIATION
from forcetorque.sensor.bandwidth.excited_records import EvenRecord

SLOW_S = 0.1
"""Length of the running median that is taken off; s."""
OUTSTANDING = 12.0
"""Robust deviations of the fast part from which on something struck: an arm that only moves shakes its sensor by up to
7, and the weakest of four taps on it had 31."""
APART_S = 0.25
"""Quiet that parts two events; s: what rings on without it is one."""

QUIET_SHARE = 0.3
"""Last part of the segment before an event that is taken for quiet: before it, weights may be hung up again."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Event:
    """Something that struck the sensor, or let it go."""

    onset: int
    """Sample at which it first stands out."""
    peak: int
    """Sample at which it stands out most."""
    before: int
    """First sample of the segment before it in which nothing stood out."""
    quiet: slice
    """Samples of that segment that are taken for quiet, and a weight for hanging still."""
    after: int
    """One past the last sample before the next event, or the end."""
    height: float
    """Robust deviations of the fast part by which it stands out."""
    component: int
    """Signal in which it stands out most."""


def find_events(record: EvenRecord, *, name: str) -> tuple[Event, ...]:
    """Find what struck the sensor.

    Args:
        record: Signals of the sensor.
        name: What was recorded, for messages.

    Returns:
        Events in the order of time.

    Raises:
        RecordingError: If there is none, or the record is too short.
    """
    if len(record) < 4 * SLOW_S * record.rate_hz:
        raise RecordingError(
            f"{name}: expected a record of at least {4 * SLOW_S:g} s, got {len(record) / record.rate_hz:.3g} s"
        )
    height = outstanding(record)
    over = height.max(axis=1)
    above = np.flatnonzero(over > OUTSTANDING)
    if not len(above):
        strongest = int(over.argmax())
        raise RecordingError(
            f"{name}: expected an impact or a release, got none: the fast part of the reading stands out by "
            f"{over[strongest]:.1f} of its robust deviations at most, at {record.time_s[strongest]:.3f} s, an event by "
            f"{OUTSTANDING:g}; strike harder, or name the interval that holds it"
        )
    pause = int(APART_S * record.rate_hz)
    starts = above[np.concatenate([[True], np.diff(above) > pause])]
    ends = above[np.concatenate([np.diff(above) > pause, [True]])]
    afters = [*starts[1:], len(record)]
    befores = [0, *(ends[:-1] + 1)]
    guard = int(0.5 * SLOW_S * record.rate_hz)
    return tuple(
        _event(height, int(start), int(end), int(before), int(after), guard)
        for start, end, before, after in zip(starts, ends, befores, afters, strict=True)
    )


def _event(height: FloatArray, start: int, end: int, before: int, after: int, guard: int) -> Event:
    # a slow sensor moves before it stands out
    quiet_end = max(before, start - guard)
    own = height[start : end + 1]
    peak, component = np.unravel_index(int(own.argmax()), own.shape)
    return Event(
        onset=start,
        peak=start + int(peak),
        before=before,
        quiet=slice(quiet_end - int(QUIET_SHARE * (quiet_end - before)), quiet_end),
        after=after,
        height=float(own.max()),
        component=int(component),
    )


def outstanding(record: EvenRecord) -> FloatArray:
    """Compute by how much the fast part of signals stands out.

    Args:
        record: Signals.

    Returns:
        Magnitude in robust deviations; shape (n, k).
    """
    from scipy.ndimage import median_filter

    width = 2 * int(0.5 * SLOW_S * record.rate_hz) + 1
    fast = np.abs(record.signals - median_filter(record.signals, size=(width, 1), mode="nearest"))
    scale = MAD_TO_DEVIATION * np.median(fast, axis=0)
    return fast / np.maximum(scale, _resolution(record.signals))


def _resolution(signals: FloatArray) -> FloatArray:
    """Smallest step of each signal, which a quiet one does not even reach; shape (k,)."""
    steps = np.abs(np.diff(signals, axis=0))
    least = np.where(steps > 0.0, steps, np.inf).min(axis=0)
    return np.where(np.isfinite(least), least, np.inf)


MOST_MODES = 3
"""Modes that are separated."""
LEAST_SHARE = 0.5
"""Share of what a fit leaves that a further mode must explain; slow noise alone lets modes explain a tenth."""
ABOVE_NOISE = 1.5
"""Times the level of the quiet segments beside it at which a decay ends."""
BLOCKS = 40
"""Blocks in which a decay is looked at for its end."""
MOST_DAMPING = 0.8
"""Damping from which on a mode hardly swings, and is not separable from the force that excites it."""
LEAST_SAMPLES = 50
"""Samples of a decay."""

_CALM = 3
"""Blocks in a row without swing that end a decay."""
_LAGS = 3
"""Part of a segment up to which its autocovariance is taken, tapered."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RingDown(ArrayRecord):
    """Free decay behind one event."""

    start: int
    """First sample that is fitted."""
    frequency_hz: float
    """Natural frequency of the strongest mode; Hz."""
    damping: float
    """Damping ratio of that mode."""
    error: FloatArray = field(metadata=array(2))
    """Standard errors of frequency and damping; shape (2,)."""
    modes: int
    """Modes that were separated."""
    level: float
    """Level in the middle of the decay."""
    level_error: float
    """Its standard error."""
    fitted: FloatArray = field(metadata=array(None))
    """What was fitted; shape (m,)."""
    left: float
    """Share of the variance of the decay that the fit leaves."""


def ring_downs(record: EvenRecord, events: tuple[Event, ...], *, name: str) -> list[RingDown | FitError]:
    """Fit the free decay behind every event.

    Args:
        record: One signal; shape (n, 1).
        events: Events in the order of time.
        name: What was recorded, for messages.

    Returns:
        Frequency and damping of the strongest mode behind each event; what stands against it where there is none.
    """
    values = record.signals[:, 0]
    spans = [_span(values, event) for event in events]
    noise = quiet_noise(values, events, spans)
    decays: list[RingDown | FitError] = []
    for event, span in zip(events, spans, strict=True):
        where = f"{name}: the event at {record.time_s[event.peak]:.3f} s"
        try:
            decays.append(_ring_down(values, span, record.rate_hz, noise, where))
        except FitError as error:
            decays.append(error)
    return decays


def quiet_noise(
    values: FloatArray, events: tuple[Event, ...], spans: list[tuple[int, int]] | None = None
) -> FloatArray | None:
    """Estimate the autocovariance of a signal where nothing rings.

    Args:
        values: The signal; shape (n,).
        events: Events in the order of time.
        spans: First sample and one past the last of the decay behind each; found if None.

    Returns:
        Autocovariance from lag 0 on, tapered; None where nothing is quiet.
    """
    ends = [0, *(end for _, end in spans or [_span(values, event) for event in events])]
    stretches = [
        values[max(end, event.quiet.start) : event.quiet.stop] for end, event in zip(ends, events, strict=False)
    ]
    long = [stretch for stretch in stretches if len(stretch) >= LEAST_SAMPLES]
    return _autocovariance(long) if long else None


def _ring_down(
    values: FloatArray, span: tuple[int, int], rate: float, noise: FloatArray | None, where: str
) -> RingDown:
    decay = values[slice(*span)]
    if len(decay) < LEAST_SAMPLES:
        raise FitError(f"{where}: expected a decay of at least {LEAST_SAMPLES} samples behind it, got {len(decay)}")
    time: FloatArray = (np.arange(len(decay), dtype=np.float64) - 0.5 * (len(decay) - 1)) / rate
    best = _fit(time, decay, 1)
    for count in range(2, MOST_MODES + 1):
        if noise is not None and best.left < noise[0] / LEAST_SHARE:
            break
        richer = _fit(time, decay, count)
        best = richer if richer.left < (1.0 - LEAST_SHARE) * best.left else best
    strongest = _strongest(best, time)
    if strongest is None:
        raise FitError(
            f"{where}: expected a vibration that decays behind it, got none within {time[-1] - time[0]:.3g} s; choose "
            "the component that it shakes, or leave it out of the interval"
        )
    frequency, damping, gradient = strongest
    residual = decay - best.model(best.parameters)
    own = _autocovariance([residual * math.sqrt(len(decay) / (len(decay) - len(best.parameters)))])
    # what the fit leaves beyond the noise, such as further modes, makes it uncertain too
    known = own if noise is None or own[0] > noise[0] else noise
    covariance = _covariance(_jacobian(best.model, best.parameters), known)
    return RingDown(
        start=span[0],
        frequency_hz=frequency,
        damping=damping,
        error=np.sqrt(np.maximum(np.einsum("ip,pq,iq->i", gradient, covariance, gradient), 0.0)),
        modes=(len(best.parameters) - 2) // 4,
        level=float(best.parameters[0]),
        level_error=math.sqrt(max(covariance[0, 0], 0.0)),
        fitted=decay - residual,
        left=float(residual.var() / decay.var()),
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Fit:
    parameters: FloatArray
    """Level, slope, then cosine, sine, frequency (Hz) and decay (1/s) of every mode."""
    model: Callable[[FloatArray], FloatArray]
    """What is read of parameters; shape (m,)."""
    left: float
    """Mean square of what the fit leaves, by its degrees of freedom."""


def error_of_mean(count: int, noise: FloatArray) -> float:
    """Give the standard error of the mean of neighbouring samples.

    Args:
        count: How many.
        noise: Autocovariance from lag 0 on; shape (lags,); square of the unit of the signal.

    Returns:
        The error, in that unit.
    """
    return math.sqrt(max(float(_covariance(np.ones((count, 1)), noise)[0, 0]), 0.0))


def _span(values: FloatArray, event: Event) -> tuple[int, int]:
    """First sample of the free decay, half a period behind the peak, and one past its end in the noise."""
    behind = values[event.peak : event.after]
    if len(behind) < LEAST_SAMPLES:
        return event.peak, event.after
    blocks = max(len(behind) // BLOCKS, 4)
    last = behind[-max(blocks, int(QUIET_SHARE * len(behind))) :]
    quiet = max(float(np.std(_detrended(one))) for one in (values[event.quiet], last) if len(one) >= blocks)
    rows = behind[: len(behind) // blocks * blocks].reshape(-1, blocks)
    trend = np.median(rows, axis=1)
    swing = np.sqrt(((rows - trend[:, None]) ** 2).mean(axis=1))
    calm = np.lib.stride_tricks.sliding_window_view(swing <= ABOVE_NOISE * quiet, _CALM).all(axis=1)
    end = (int(calm.argmax()) + _CALM) * blocks if calm.any() else len(behind)
    half = _half_swing(behind[:end])
    return event.peak + half, event.peak + end


def _half_swing(decay: FloatArray) -> int:
    """Samples of half a period of what is strongest in a decay."""
    if len(decay) < LEAST_SAMPLES:
        return 1
    power = np.abs(np.fft.rfft(_detrended(decay) * np.hanning(len(decay)), 4 * len(decay))) ** 2
    strongest = int(power[4:].argmax()) + 4
    return max(2, min(len(decay) // 4, round(2.0 * len(decay) / strongest)))


def _fit(time: FloatArray, decay: FloatArray, count: int) -> _Fit:
    from scipy.optimize import least_squares

    rate = (len(time) - 1) / (time[-1] - time[0])
    poles = _poles(_detrended(decay), count, rate)

    def design(shape: FloatArray) -> FloatArray:
        since = time - time[0]
        columns = [np.ones_like(time), time]
        for frequency, rate_of_decay in shape.reshape(-1, 2):
            envelope = np.exp(-rate_of_decay * since)
            angle = 2.0 * np.pi * frequency * since
            columns += [envelope * np.cos(angle), envelope * np.sin(angle)]
        return np.column_stack(columns)

    def left(shape: FloatArray) -> FloatArray:
        columns = design(shape)
        return decay - columns @ np.linalg.lstsq(columns, decay, rcond=None)[0]

    lower, upper = np.tile([0.0, 0.0], count), np.tile([0.5 * rate, rate], count)
    start = np.clip(poles, lower + 1e-6, 0.99 * upper)
    solved = least_squares(left, start, bounds=(lower, upper), x_scale="jac")
    linear = np.linalg.lstsq(design(solved.x), decay, rcond=None)[0]
    parameters = np.concatenate([linear[:2], np.hstack([linear[2:].reshape(-1, 2), solved.x.reshape(-1, 2)]).ravel()])

    def model(at: FloatArray) -> FloatArray:
        modes = at[2:].reshape(-1, 4)
        return design(modes[:, 2:].ravel()) @ np.concatenate([at[:2], modes[:, :2].ravel()])

    return _Fit(parameters=parameters, model=model, left=2.0 * float(solved.cost) / (len(decay) - len(parameters)))


def _poles(decay: FloatArray, count: int, rate: float) -> FloatArray:
    """Frequencies and decays to start from, by the matrix pencil; shape (2 count,)."""
    step = max(1, len(decay) // 600)
    thinned = decay if step == 1 else decay[: len(decay) // step * step].reshape(-1, step).mean(axis=1)
    half = len(thinned) // 2
    windows = np.lib.stride_tricks.sliding_window_view(thinned, half)
    _, _, axes = np.linalg.svd(windows, full_matrices=False)
    axes = axes[: 2 * count].T
    roots = np.linalg.eigvals(np.linalg.lstsq(axes[:-1], axes[1:], rcond=None)[0])
    logs = np.log(np.where(np.abs(roots) > 0.0, roots, 1e-6).astype(np.complex128)) * rate / step
    kept = np.resize(logs[np.argsort(-np.abs(logs.imag))][::2], count)
    return np.column_stack([np.abs(kept.imag) / (2.0 * np.pi), np.maximum(-kept.real, 1e-3)]).ravel()


def _strongest(fit: _Fit, time: FloatArray) -> tuple[float, float, FloatArray] | None:
    """Natural frequency and damping of the mode with most energy, and their gradient by the parameters; or none."""
    modes = fit.parameters[2:].reshape(-1, 4)
    turns, decays = 2.0 * np.pi * modes[:, 2], modes[:, 3]
    natural = np.hypot(turns, decays)
    # what does not die away behind the event was there before it, and what does not swing is the event itself
    rings = (decays * (time[-1] - time[0]) > 1.0) & (decays < MOST_DAMPING * natural)
    if not rings.any():
        return None
    energy = np.where(rings, (modes[:, 0] ** 2 + modes[:, 1] ** 2) / np.maximum(decays, 1e-9), 0.0)
    best = int(energy.argmax())
    turn, decay, size = float(turns[best]), float(decays[best]), float(natural[best])
    gradient = np.zeros((2, len(fit.parameters)))
    at = 2 + 4 * best
    gradient[0, at + 2], gradient[0, at + 3] = turn / size, decay / size / (2.0 * np.pi)
    gradient[1, at + 2] = -decay * turn / size**3 * 2.0 * np.pi
    gradient[1, at + 3] = turn**2 / size**3
    return size / (2.0 * np.pi), decay / size, gradient


def _jacobian(model: Callable[[FloatArray], FloatArray], at: FloatArray) -> FloatArray:
    steps = 1e-6 * np.maximum(np.abs(at), 1e-3)
    columns = [(model(at + step) - model(at - step)) / (2.0 * step.sum()) for step in np.diag(steps)]
    return np.column_stack(columns)


def _detrended(values: FloatArray) -> FloatArray:
    from scipy.signal import detrend

    return detrend(values)


def _autocovariance(stretches: list[FloatArray]) -> FloatArray:
    """Autocovariance at lags from 0 on, tapered so that no sum of noise has a negative variance."""
    from scipy.signal import correlate

    lags = max(1, max(map(len, stretches)) // _LAGS)
    products = np.zeros(lags)
    for stretch in stretches:
        noise = _detrended(stretch)
        own = correlate(noise, noise, method="fft")[len(noise) - 1 :][:lags]
        products[: len(own)] += own
    return products / sum(map(len, stretches)) * (1.0 - np.arange(lags) / lags)


def _covariance(jacobian: FloatArray, autocovariance: FloatArray) -> FloatArray:
    from scipy.signal import fftconvolve

    scale = np.sqrt((jacobian**2).sum(axis=0))
    columns = jacobian / scale
    symmetric = np.concatenate([autocovariance[:0:-1], autocovariance])
    noisy = fftconvolve(columns, symmetric[:, None], mode="full", axes=0)[len(autocovariance) - 1 :][: len(columns)]
    spread = np.linalg.pinv(columns.T @ columns, hermitian=True)
    return spread @ (columns.T @ noisy) @ spread / np.outer(scale, scale)


SETTLED = 0.3
"""Part of the segment behind an event that is averaged for the first look at a step, before weights hang again."""


def step_direction(record: EvenRecord, events: tuple[Event, ...]) -> FloatArray:
    """Find the direction of the force that weights took off.

    Args:
        record: Wrenches; shape (n, 6).
        events: Releases.

    Returns:
        Of the mean step, against which the weights pulled; force of size 1, no moment; shape (6,).
    """
    steps = [_step(record.signals[:, :3], event) for event in events]
    mean = np.mean(steps, axis=0)
    return np.concatenate([mean / max(float(np.linalg.norm(mean)), np.finfo(np.float64).tiny), np.zeros(3)])


def gains(
    record: EvenRecord, events: tuple[Event, ...], decays: Sequence[RingDown], weight_N: float
) -> tuple[FloatArray, FloatArray]:
    """Compute the measurement per newton of each released weight.

    Args:
        record: One signal; shape (n, 1).
        events: Releases.
        decays: The decay behind each.
        weight_N: Force that was let go; N.

    Returns:
        Gains, of one sign with the step, and their standard errors under coloured noise; shapes (k,).
    """
    values = record.signals[:, 0]
    noise = quiet_noise(values, events)
    steps, errors = [], []
    for event, decay in zip(events, decays, strict=True):
        held = values[event.quiet]
        error = 0.0 if noise is None else error_of_mean(len(held), noise)
        steps.append(decay.level - float(held.mean()))
        errors.append(np.hypot(decay.level_error, error))
    return np.array(steps) / weight_N, np.array(errors) / weight_N


def _step(force: FloatArray, event: Event) -> FloatArray:
    behind = force[event.peak : event.after]
    return behind[: max(1, int(SETTLED * len(behind)))].mean(axis=0) - force[event.quiet].mean(axis=0)
