# SPDX-License-Identifier: BSD-3-Clause
"""Which samples of a sensor's stream carry no information on its load: frozen, saturated, or stamped again."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass
from typing import Self

import numpy as np
from scipy.special import erf

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray, run_edges
from forcetorque.recording.alignment import usable_samples

FROZEN_SECONDS = 0.5
"""All channels of a noisy sensor repeat one reading for no longer than this."""
SATURATION_SHARE = 0.005
"""Counts within this share of the limit of the converter are saturated."""

_BY_CHANCE = 1e-9
"""Chance of a run of equal readings, by the noise of the log, below which it is frozen."""
_WRITTEN, _COMPUTED = 2e-5, 1e-3
"""Noise relative to the range of a channel below which there is none: that of written digits; and, of readings on no
grid, what a simulation computes of a motion."""
_ON_GRID, _FINEST = 0.01, 1e-7
"""Part of a step by which changes of readings on a grid differ from whole steps; and the finest step of a converter,
relative to the range, below which the grid is that of floating point."""
_FAR_MORE = 50.0
"""Equal readings, in those of chance, or in the same change of another size, from which on the log repeats them: of
fifty one may be a measurement."""
_LONGEST_NS, _SLOWEST_NS = 150_000_000, 250_000_000
"""Time that a reading repeats, and period of the slowest sensor, of which it is twice as long; one that stays for
longer may be of a load that rests."""
_MOVES, _NEARLY_ALL = 4.0, 0.9
"""Steps by which most channels move where the load does, and the share of such changes with equal readings on either
side from which on the sensor is slower than its log."""
_RECURS = 0.01
"""Share of one change among all, from which on readings have steps; those of written digits are finer."""
_DIGITS = 8.0
"""Last digits by which changes of as many counts may differ where readings are written."""
_BESIDE = 2
"""Neighbours on either side of a sample, whose cubic follows a smooth motion and no noise."""
_NEIGHBOURS = -56.0 / 36.0
"""Mean product of what neighbouring samples have beside their cubics, in the variance of white noise: for even steps
(1, -4, 6, -4, 1) / 6 against itself."""
_ROUNDING = 1.0 / 6.0
"""Most variance that rounding looks like, in squares of a step: twice that of a signal that crosses many steps."""
_LONGEST_S = 1.0
"""Time that these neighbours may take; poses that are held for as long differ by more than noise."""
_BLOCK, _FEWEST = 64, 32
"""Samples of a block, and the fewest of all."""
_QUIETEST = 4
"""Of the quarter of the blocks that move least the usual one counts: noise that comes with motion ends with it."""

FLAT = 3
"""Equal samples in a row at an end of the range that are a limit, where the signal jumps there."""
_JUMP = 5.0
"""Resolutions by which a signal jumps to a limit; the top of a smooth wave is reached by one or two."""

Run = tuple[int, int]
"""First and last index of samples that lie behind each other."""


@dataclass(frozen=True, slots=True, kw_only=True)
class UnusableCounts:
    """How many samples of a set carry no information on the load, each counted once."""

    frozen: int = 0
    """Samples in which all channels repeat one reading although the log is noisy, or the load moves."""
    saturated: int = 0
    """Samples at the limit of the converter, or held by a board that flags it."""
    repeated: int = 0
    """Messages whose stamp does not step forward, or that repeat the reading before under a new stamp."""

    @classmethod
    def total(cls, parts: Iterable[UnusableCounts]) -> Self:
        """Add up the counts of disjoint sets of samples.

        Returns:
            Their sum.
        """
        counts = tuple(parts)
        return cls(
            frozen=sum(part.frozen for part in counts),
            saturated=sum(part.saturated for part in counts),
            repeated=sum(part.repeated for part in counts),
        )

    def __bool__(self) -> bool:
        return bool(self.frozen or self.saturated or self.repeated)

    def __str__(self) -> str:
        counts = {"frozen": self.frozen, "saturated": self.saturated, "repeated": self.repeated}
        return ", ".join(f"{count} {name}" for name, count in counts.items() if count) or "none"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SampleQuality:
    """What is wrong with each of the n samples of a stream, as far as one sensor goes."""

    frozen: BoolArray
    """Samples in which all channels repeat one reading although the log is noisy, or the load moves; shape (n,)."""
    saturated: BoolArray
    """Samples at the limit of the converter, or held by a board that flags it; shape (n,)."""
    repeated: BoolArray
    """Messages whose stamp does not step forward, or that repeat the reading before under a new stamp; shape (n,)."""

    @property
    def unusable(self) -> BoolArray:
        """Samples that belong into no fit and no evaluation; shape (n,)."""
        return self.frozen | self.saturated | self.repeated

    def counted(self, among: BoolArray) -> UnusableCounts:
        """Count the unusable samples of a set.

        Args:
            among: Which samples the set holds; shape (n,).

        Returns:
            Their numbers.
        """
        saturated = self.saturated & ~self.repeated
        return UnusableCounts(
            frozen=int(np.count_nonzero(among & self.frozen & ~saturated & ~self.repeated)),
            saturated=int(np.count_nonzero(among & saturated)),
            repeated=int(np.count_nonzero(among & self.repeated)),
        )


def repeated_samples(stamp_ns: IntArray) -> BoolArray:
    """Find messages whose stamp is that of an earlier one, or older.

    Args:
        stamp_ns: Stamps in the order of the log; shape (n,); ns.

    Returns:
        Which they are; shape (n,).
    """
    repeated = np.ones(len(stamp_ns), dtype=bool)
    repeated[usable_samples(stamp_ns)] = False
    return repeated


def at_limit(counts: FloatArray, limit_counts: float, *, recovered: bool) -> BoolArray:
    """Find readings at the limit of the converter.

    Args:
        counts: Raw samples; shape (n, c); counts.
        limit_counts: Largest magnitude that the converter gives.
        recovered: Whether the counts came through an inverse matrix; they may then lie beyond the limit.

    Returns:
        Which they are; shape (n, c). None where raw samples go beyond the limit: it is not that of their converter.
    """
    if not recovered and exceeds_limit(counts, limit_counts):
        return np.zeros(np.shape(counts), dtype=bool)
    with np.errstate(invalid="ignore"):
        reached: BoolArray = np.abs(counts) >= (1.0 - SATURATION_SHARE) * limit_counts
    return reached


def exceeds_limit(counts: FloatArray, limit_counts: float) -> bool:
    """Check whether raw samples go beyond the specified limit of their converter.

    Args:
        counts: Raw samples; shape (n, c); counts.
        limit_counts: Largest magnitude that the converter gives, by the file.

    Returns:
        Whether they do, by more than the count of a two's complement.
    """
    finite = counts[np.isfinite(counts)]
    return bool(finite.size and np.abs(finite).max() > limit_counts + 1.0)


def equal_runs(stamp_ns: IntArray, values: FloatArray) -> list[Run]:
    """Find the runs in which all channels repeat one reading for longer than `FROZEN_SECONDS`.

    Args:
        stamp_ns: Stamps in the order of the log; shape (n,); ns.
        values: Readings; shape (n, c); NaN in gaps, which end a run.

    Returns:
        The runs; messages with an old stamp neither make one nor end it.
    """
    usable = usable_samples(stamp_ns)
    same = (np.diff(values[usable], axis=0) == 0.0).all(axis=1)
    runs = usable[run_edges(same)].tolist()
    return [(first, last) for first, last in runs if stamp_ns[last] - stamp_ns[first] > round(FROZEN_SECONDS * 1e9)]


def noisy_runs(stamp_ns: IntArray, values: FloatArray, runs: Collection[Run]) -> list[Run]:
    """Pick the runs of equal readings that the noise of the same log does not let happen.

    What counts as noise changes from sample to sample and back, by more than rounding does: a motion, and a sensor that
    holds each reading for several samples of a faster log, do not. Where noise is below the step of the converter,
    a load at rest gives equal readings, and no run is picked.

    Args:
        stamp_ns: Stamps in the order of the log; shape (n,); ns.
        values: Readings; shape (n, c).
        runs: Runs of equal readings, as of `equal_runs`.

    Returns:
        Runs that are frozen.
    """
    if not runs:
        return []
    usable = usable_samples(stamp_ns)
    elsewhere = ~mask_of(runs, len(stamp_ns))[usable]
    samples, stamps = values[usable], stamp_ns[usable]
    changes = np.diff(samples, axis=0)
    moving = elsewhere[1:] & elsewhere[:-1] & np.isfinite(changes).all(axis=1)
    changed = int(np.count_nonzero(changes[moving].any(axis=1)))
    if not changed:
        return []
    per_reading = _log_chance_of_equal(stamps, np.where(elsewhere[:, None], samples, np.nan), changes[moving], values)
    held = np.count_nonzero(moving) / changed  # samples for which the log repeats a reading that the sensor gave once
    counts = np.cumsum(np.isin(np.arange(len(stamp_ns)), usable))
    chance = held * np.log(_BY_CHANCE)
    return [(first, last) for first, last in runs if (counts[last] - counts[first]) * per_reading < chance]


def _log_chance_of_equal(stamps: IntArray, samples: FloatArray, changes: FloatArray, values: FloatArray) -> float:
    """Estimate how seldom noise gives one reading twice in a row.

    Args:
        stamps: Stamps, which increase; shape (m,); ns.
        samples: Readings of which the noise counts; shape (m, c); NaN where none is to count.
        changes: Changes from one of them to the next; shape (k, c).
        values: All readings of the log, which tell resolution and range; shape (n, c).

    Returns:
        Logarithm of the chance.
    """
    variance = white_variance(stamps, samples)
    step = smallest_steps(values)
    noise = np.sqrt(np.maximum(variance - _ROUNDING * step**2, 0.0))
    ranges = ranges_of(values)
    of_converter = _are_of_converter(changes, step, ranges)
    least = np.where(of_converter, _WRITTEN, _COMPUTED) * ranges
    noise[np.sqrt(variance) <= least] = 0.0
    # a reading that lies in the middle of a step stays there longest
    stays = np.ones(len(noise))
    stays[noise > 0.0] = erf(step[noise > 0.0] / (noise[noise > 0.0] * 8.0**0.5))
    with np.errstate(divide="ignore"):
        return float(np.log(stays).sum())


def repeated_readings(stamp_ns: IntArray, values: FloatArray) -> BoolArray:
    """Find samples that repeat the reading before them in all channels under a new stamp.

    They are of a sensor that is slower than its log, or of messages that were lost and replaced; at a load that moves
    they are late. They count where noise gives far fewer of them, or nearly every reading stays while the load moves
    by more than four steps of the converter from reading to reading;
    up to 0.15 s, of a sensor of at least 4 Hz up to twice the usual time between its readings.

    Args:
        stamp_ns: Stamps in the order of the log; shape (n,); ns.
        values: Readings; shape (n, c); NaN in gaps.

    Returns:
        Which they are; shape (n,).
    """
    usable = usable_samples(stamp_ns)
    same = (np.diff(values[usable], axis=0) == 0.0).all(axis=1)
    marks, count = np.zeros(len(stamp_ns), dtype=bool), int(np.count_nonzero(same))
    if not count or count == len(same):
        return marks
    first = np.concatenate([[True], ~same])
    samples = values[usable][first]
    changes = np.diff(samples, axis=0)
    changes = changes[np.isfinite(changes).all(axis=1)]
    if not len(changes):
        return marks
    step, ranges = smallest_steps(values), ranges_of(values)
    of_grid = _are_of_converter(changes, step, ranges)
    changed = changes != 0.0
    by_one = (changed & (np.abs(changes) < 1.5 * step)).sum(axis=0) > _RECURS * changed.sum(axis=0)
    if not (of_grid & by_one)[step > 0.0].all():
        # wrenches of a converter's counts: their steps are not known, but small changes come again and again
        finest = np.maximum(np.where(of_grid, _DIGITS * step, _FINEST * ranges), np.finfo(np.float64).tiny)
        whole = np.rint(changes / finest)
        often = int(np.unique(whole, axis=0, return_counts=True)[1].max())
        if often > max(_RECURS * len(changes), 1.0) or count <= _FAR_MORE * often:
            return marks
    longest_ns = 2 * _period_of_slow_sensor(stamp_ns[usable], values[usable], same, step)
    if not longest_ns:
        chance = np.exp(_log_chance_of_equal(stamp_ns[usable][first], samples, changes, values))
        longest_ns = _LONGEST_NS if count > _FAR_MORE * len(same) * chance else 0
    if longest_ns:
        for start, end in _noisy_at_ends(stamp_ns[usable], values[usable], same, longest_ns):
            marks[usable[start + 1 : end + 1]] = True
    return marks


def _period_of_slow_sensor(stamps: IntArray, samples: FloatArray, same: BoolArray, step: FloatArray) -> int:
    """Usual time between the readings of a log where nearly every one moves and stays; ns; 0 of others."""
    # noise is not needed for it: a load that moves goes on from one sample to the next
    many = np.count_nonzero(np.abs(np.diff(samples, axis=0)) > _MOVES * step, axis=1) >= 0.5 * samples.shape[1]
    moves = np.flatnonzero(many[1:-1]) + 1
    if len(moves) < _FEWEST or np.mean(same[moves - 1] & same[moves + 1]) < _NEARLY_ALL:
        return 0
    changes = np.flatnonzero(~same)
    between = many[changes[1:]] & many[changes[:-1]]
    period = float(np.median(np.diff(stamps[changes])[between])) if between.any() else 0.0
    return int(period) if period <= _SLOWEST_NS else 0


def _noisy_at_ends(stamps: IntArray, samples: FloatArray, same: BoolArray, longest_ns: int) -> Iterator[Run]:
    """Short runs of equal readings that most channels enter and leave by a change; a load at rest does not."""
    for start, end in run_edges(same).tolist():
        if stamps[end] - stamps[start] > longest_ns:
            continue
        beside = [k for k in (start - 1, end) if 0 <= k < len(same)]
        if all(np.count_nonzero(samples[k + 1] != samples[k]) >= 0.5 * samples.shape[1] for k in beside):
            yield start, end


def smallest_steps(values: FloatArray) -> FloatArray:
    """Give the resolution of readings: the smallest change from one sample to the next.

    Args:
        values: Readings; shape (n, c); NaN in gaps.

    Returns:
        The step of each channel, 0 where none changes; shape (c,).
    """
    sizes = np.abs(np.diff(values, axis=0))
    smallest: FloatArray = np.min(sizes, axis=0, where=sizes > 0.0, initial=np.inf)
    return np.where(np.isfinite(smallest), smallest, 0.0)


def mask_of(runs: Collection[Run], count: int) -> BoolArray:
    """Mark the samples of runs.

    Args:
        runs: First and last index of each.
        count: Number n of all samples.

    Returns:
        Which lie in one; shape (n,).
    """
    mask = np.zeros(count, dtype=bool)
    for first, last in runs:
        mask[first : last + 1] = True
    return mask


def white_variance(stamp_ns: IntArray, values: FloatArray) -> FloatArray:
    """Estimate the variance of white noise: of what changes from sample to sample and back, where the load moves least.

    Args:
        stamp_ns: Stamps, which increase; shape (n,); ns.
        values: Readings; shape (n, c); NaN where none is to count.

    Returns:
        Variance of every channel, 0 where too few samples lie close together; shape (c,).
    """
    none = np.zeros(values.shape[1])
    if len(values) < 2 * _BESIDE + 2:
        return none
    left = _beside_cubic(stamp_ns, values)
    products = left[1:] * left[:-1]
    near = stamp_ns[2 * _BESIDE + 1 :] - stamp_ns[: -2 * _BESIDE - 1] <= round(_LONGEST_S * 1e9)
    chosen = near & np.isfinite(products).all(axis=1)
    count = int(np.count_nonzero(chosen))
    if count < _FEWEST:
        return none
    parts = max(count // _BLOCK, 1)
    means = np.array([block.mean(axis=0) for block in np.array_split(products[chosen], parts)])
    moved = np.array([_moved(block) for block in np.array_split(values[_BESIDE : -_BESIDE - 1][chosen], parts)])
    quietest = np.argsort(moved, axis=0)[: -(-parts // _QUIETEST)]
    usual: FloatArray = np.median(np.take_along_axis(means, quietest, axis=0), axis=0) / _NEIGHBOURS
    return np.maximum(usual, 0.0)


def _are_of_converter(changes: FloatArray, step: FloatArray, ranges: FloatArray) -> BoolArray:
    """Whether the readings of every channel are on a grid that is not that of floating point; shape (c,)."""
    return (step > _FINEST * ranges) & _are_on_grid(changes, step)


def _are_on_grid(changes: FloatArray, step: FloatArray) -> BoolArray:
    """Whether the changes of every channel are whole numbers of its steps, as those of a converter; shape (c,)."""
    changed = (changes != 0.0) & (step > 0.0)
    steps = np.divide(changes, step, out=np.zeros_like(changes), where=changed)
    whole = changed & (np.abs(steps - np.round(steps)) < _ON_GRID)
    return whole.sum(axis=0) > 0.5 * changed.sum(axis=0)


def _beside_cubic(stamp_ns: IntArray, values: FloatArray) -> FloatArray:
    """What each sample has beside the cubic through two neighbours on either side; shape (n - 4, c)."""
    count = len(values) - 2 * _BESIDE
    places = [offset for offset in range(-_BESIDE, _BESIDE + 1) if offset]
    middle = slice(_BESIDE, _BESIDE + count)
    # even steps would take the jitter of the stamps, where the load moves, for noise
    away = {k: (stamp_ns[_BESIDE + k : _BESIDE + k + count] - stamp_ns[middle]) * 1e-9 for k in places}
    left = values[middle].copy()
    for k in places:
        weight = np.prod([away[other] / (away[other] - away[k]) for other in places if other != k], axis=0)
        left -= weight[:, None] * values[_BESIDE + k : _BESIDE + k + count]
    return left


def _moved(block: FloatArray) -> FloatArray:
    """By how much the mean of a block's second half differs from that of its first; shape (c,)."""
    half = len(block) // 2
    return np.abs(block[half:].mean(axis=0) - block[:half].mean(axis=0))


def ranges_of(values: FloatArray) -> FloatArray:
    """Give how far readings go.

    Args:
        values: Readings; shape (n, c); NaN in gaps.

    Returns:
        Largest less smallest reading of every channel, 0 where there is none; shape (c,).
    """
    finite = np.isfinite(values)
    largest = np.max(values, axis=0, where=finite, initial=-np.inf)
    smallest = np.min(values, axis=0, where=finite, initial=np.inf)
    return np.where(largest > smallest, largest - smallest, 0.0)


def flat_tops(values: FloatArray) -> BoolArray:
    """Find where a signal stays at an end of its range after it jumped there.

    Args:
        values: The signal; shape (n,).

    Returns:
        Whether each sample is of such a top; shape (n,).
    """
    steps = np.abs(np.diff(values))
    flat = np.zeros(len(values), dtype=bool)
    if not steps.any():
        return flat
    jump = _JUMP * max(float(np.min(steps[steps > 0.0])), float(np.median(steps)))
    for end in (values.max(), values.min()):
        edges = np.flatnonzero(np.diff(np.concatenate([[0], (values == end).astype(np.int64), [0]])))
        for first, after in edges.reshape(-1, 2):
            # a weight that hangs still is an end of the range too, but it was hung on slowly, and jumps only away
            if after - first >= FLAT and first > 0 and steps[first - 1] > jump:
                flat[first:after] = True
    return flat
