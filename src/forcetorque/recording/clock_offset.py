# SPDX-License-Identifier: BSD-3-Clause
"""By how much one clock is later than another, from what both streams must show."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import RecordingError
from forcetorque.base.noise.slow_noise import half_width
from forcetorque.recording.alignment import GAP_PERIODS
from forcetorque.recording.delay_equation import DelayEquation, even_means, smoothed

EVEN = 0.01
"""Deviation from even steps, in steps, that is no reason to interpolate."""

_ROUNDING = 1e-14
"""Mean square of a direction of the reference, relative to the largest, below which it does not move."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ResampledPair:
    """Reading and reference at n even steps of time, the reference without its ends."""

    reading: FloatArray
    """Reading less its mean; shape (k, n)."""
    reference: FloatArray
    """Reference; shape (n - 2 most, p)."""
    most: int
    """Samples that are left out at each end, so that as many are paired for every lag."""

    @classmethod
    def of(cls, time_s: FloatArray, reading: FloatArray, reference: FloatArray, *, step_s: float, most: int) -> Self:
        """Bring samples to even steps.

        Args:
            time_s: Instants, rising; shape (n,); s.
            reading: Reading; shape (n, k).
            reference: Reference; shape (n, p).
            step_s: Length of a step; s.
            most: Largest lag that will be requested; steps.

        Returns:
            The pair.
        """
        time = time_s - time_s[0]
        at = step_s * np.arange(int(time[-1] / step_s + EVEN) + 1)
        both = np.hstack([reading - reading.mean(axis=0), reference])
        if len(at) != len(time) or np.abs(at - time).max() > EVEN * step_s:
            both = np.column_stack([np.interp(at, time, column) for column in both.T])
        split = reading.shape[1]
        return cls(
            reading=np.ascontiguousarray(both[:, :split].T), reference=both[most : len(at) - most, split:], most=most
        )

    def at_lag(self, lag: int) -> FloatArray:
        """Give the reading some steps after those of the reference; shape (k, n - 2 most)."""
        return self.reading[:, self.most + lag : self.reading.shape[1] - self.most + lag]


def residual_at_lags(pairs: Sequence[ResampledPair]) -> Callable[[int], FloatArray]:
    """Prepare what the reference leaves of the reading, the mean of each pair apart.

    Args:
        pairs: Segments of the same columns.

    Returns:
        Gives the sum of squares that is left of every column of the reading at a lag; shape (k,).
    """
    centred = [pair.reference - pair.reference.mean(axis=0) for pair in pairs]
    eigenvalues, vectors = np.linalg.eigh(sum(reference.T @ reference for reference in centred))
    moving = eigenvalues > _ROUNDING * eigenvalues[-1]
    # in these columns the explained square is that of the products
    units = [reference @ (vectors[:, moving] / np.sqrt(eigenvalues[moving])) for reference in centred]

    def residual(lag: int) -> FloatArray:
        readings = [pair.at_lag(lag) for pair in pairs]
        total = sum(np.einsum("ij,ij->i", r, r) - r.shape[1] * r.mean(axis=1) ** 2 for r in readings)
        products = sum(r @ unit for r, unit in zip(readings, units, strict=True))
        return np.asarray(total) - (np.asarray(products) ** 2).sum(axis=1)

    return residual


BLOCKS = 20
"""Segments of equal information that count as independent where two delays are compared."""

_SURE = 4.0
"""Standard errors by which the best delay must beat every other, and none at all."""
_NEAR_STEPS = 2.0
"""Steps of time within which a delay lies from where it is best on the grid."""
_MOST_STEPS = 20_000
"""Steps of time that are compared; of longer or denser logs means are taken."""
_SHORTEST = 10.0
"""Length of a segment that both saw, in largest delays, below which it is left out."""
_WIDEST = 0.2
"""Half-width of the interval, in largest delays, beyond which a delay is undetermined."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Delay:
    """By how much stamps come later than those of another clock, with half-widths of 95 % intervals."""

    delay_s: float
    """At the requested instant; s; positive where its stamps are later."""
    delay_half_width_s: float
    """Half of its interval; s."""
    drift: float
    """Seconds by which it grows in a second; 0 where it was not requested."""
    drift_not_requested: float
    """Drift of the solution with drift."""
    drift_half_width: float
    """Half of the interval of that."""
    explained: float
    """Share of the reading's movement that the reference explains, in the column where that is largest."""
    seconds: float
    """Length of what both saw; s."""

    @property
    def drifts(self) -> bool:
        """Whether the recording shows that the delay changes."""
        return abs(self.drift_not_requested) > self.drift_half_width


def estimate_delay(
    time_s: FloatArray,
    reading: FloatArray,
    reference_time_s: FloatArray,
    reference: FloatArray,
    *,
    around_s: float = 0.0,
    within_s: float = 0.5,
    with_drift: bool = False,
    middle_s: float | None = None,
) -> Delay:
    """Find how much later the stamps of a reading are than those of a reference that it follows linearly.

    Args:
        time_s: Stamps of the reading, rising; shape (n,); s.
        reading: Reading, finite; shape (n, k).
        reference_time_s: Stamps of the reference, rising, from the same zero; shape (m,); s.
        reference: What the reading must follow by some matrix, finite; shape (m, p).
        around_s: Delay about which it is looked for; s.
        within_s: How far from there it is looked for; s.
        with_drift: Whether it may grow evenly with time.
        middle_s: Instant of which the delay is wanted; s; the middle of the reading if left out.

    Returns:
        The delay and its interval.

    Raises:
        RecordingError: If both saw too short a time together, or the delay is not identifiable: too little
            motion, or motion that repeats itself.
    """
    middle = 0.5 * float(time_s[0] + time_s[-1]) if middle_s is None else middle_s
    shifted = reference_time_s + around_s
    spans = _common_spans(time_s, shifted, within_s)
    seconds = sum(end - begin for begin, end in spans)
    step = max(float(np.median(np.diff(time_s))), float(np.median(np.diff(shifted))), seconds / _MOST_STEPS)
    most = int(within_s / step)
    if most < 2:
        raise RecordingError(f"expected within_s of at least two steps of {step:.3g} s, got {within_s:.3g} s")
    grids = [_grid(begin, end, step) for begin, end in spans]
    sampled = [
        (at, smoothed(even_means(time_s, reading, at, step)), smoothed(even_means(shifted, reference, at, step)))
        for at in grids
    ]
    pairs = [ResampledPair.of(at, values, other, step_s=step, most=most) for at, values, other in sampled]
    residual = residual_at_lags(pairs)
    lags = np.arange(-most, most + 1)
    cost = np.array([np.log(np.maximum(residual(lag), np.finfo(float).tiny)).sum() for lag in lags.tolist()])
    best = int(lags[np.argmin(cost)])
    if abs(best) == most:
        raise RecordingError(
            f"the delay that explains most lies at the end of what was looked through, {around_s + best * step:.3g} s; "
            "specify around_s, where it is to be looked for, or a larger within_s"
        )
    equation = DelayEquation(
        [at[most:-most] for at in grids],
        [values[most:-most] for _, values, _ in sampled],
        reference_time_s=np.concatenate(grids),
        reference=np.concatenate([other for _, _, other in sampled]),
        step_s=step,
        middle_s=middle,
    )
    drifting, steady = (equation.solve(best * step, with_drift=drift) for drift in (True, False))
    root = drifting if with_drift else steady
    delay, half = root.values[0], half_width(root.standard_error, root.degrees_of_freedom)
    most_s = _WIDEST * within_s
    if not half[0] <= most_s or abs(delay - best * step) > max(_NEAR_STEPS * step, 2.0 * half[0]):
        raise RecordingError(
            f"the delay is not identifiable from the common motion: its 95 % interval is ± {half[0]:.3g} s, "
            f"where ± {most_s:.3g} s is the limit; record faster motion, or specify delay_s"
        )
    rivals = [lag for lag in _minima(cost, lags) if abs(lag * step - delay) > max(2.0 * half[0], step)]
    _require_unique_delay(equation, float(steady.values[0]), [lag * step for lag in rivals], around_s)
    own = half_width(drifting.standard_error, drifting.degrees_of_freedom)
    return Delay(
        delay_s=around_s + float(delay),
        delay_half_width_s=float(half[0]),
        drift=float(root.values[1]) if with_drift else 0.0,
        drift_not_requested=float(drifting.values[1]),
        drift_half_width=float(own[1]),
        explained=root.explained,
        seconds=seconds,
    )


def _common_spans(first: FloatArray, second: FloatArray, within_s: float) -> list[tuple[float, float]]:
    """Spans of both without a gap in either."""
    begin, end = max(first[0], second[0]), min(first[-1], second[-1])
    gaps = sorted(gap for times in (first, second) for gap in _gaps(times))
    spans, start = [], float(begin)
    for gap_begin, gap_end in [*gaps, (float(end), np.inf)]:
        if min(gap_begin, end) - start >= _SHORTEST * within_s:
            spans.append((start, float(min(gap_begin, end))))
        start = max(start, gap_end)
    if not spans:
        raise RecordingError(
            f"expected {_SHORTEST * within_s:.3g} s without a gap that both saw, {_SHORTEST:g} times within_s, got "
            f"{max(float(end - begin), 0.0):.3g} s in all; look within less, or around another delay"
        )
    return spans


def _grid(begin: float, end: float, step: float) -> FloatArray:
    return begin + step * np.arange(int((end - begin) / step) + 1, dtype=np.float64)


def _gaps(times: FloatArray) -> Iterator[tuple[float, float]]:
    steps = np.diff(times)
    for place in np.flatnonzero(steps > GAP_PERIODS * np.median(steps)):
        yield float(times[place]), float(times[place + 1])


def _minima(cost: FloatArray, lags: IntArray) -> list[int]:
    """Lags at which less is left than at both neighbours."""
    padded = np.concatenate([[np.inf], cost, [np.inf]])
    least = (padded[1:-1] < padded[:-2]) & (padded[1:-1] <= padded[2:])
    return [int(lag) for lag in lags[least]]


def _refined_rival(equation: DelayEquation, rival: float, best: float) -> float:
    """A rival at its own best: on the grid alone, the one that happens to lie nearer to a step would win."""
    refined = float(equation.solve(rival, with_drift=False).values[0])
    if abs(refined - rival) <= _NEAR_STEPS * equation.step:
        return refined
    # steps that run away from it may end at the best of all, which is no rival of itself
    near = rival + equation.step * np.linspace(-_NEAR_STEPS, _NEAR_STEPS, 17)
    return float(min(near, key=lambda at: equation.advantage(best, at, blocks=BLOCKS)))


def _require_unique_delay(equation: DelayEquation, best: float, rivals: list[float], around_s: float) -> None:
    """Refuse a delay that others explain as well, or nothing does."""
    for rival in (None, *(_refined_rival(equation, rival, best) for rival in rivals)):
        if equation.advantage(best, rival, blocks=BLOCKS) < _SURE:
            other = "none at all" if rival is None else f"one of {around_s + rival:.3g} s"
            raise RecordingError(
                f"the delay is not identifiable from the common motion: one of {around_s + best:.3g} s explains it no "
                f"more surely than {other}; record motion of all directions that does not repeat itself, or specify "
                "delay_s"
            )
