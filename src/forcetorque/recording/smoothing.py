# SPDX-License-Identifier: BSD-3-Clause
"""Savitzky-Golay smoothing and derivatives of streams, interval by interval between gaps."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise
from typing import Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import RecordingError
from forcetorque.recording.alignment import gap_limit_ns, seconds_since, usable_samples


@lru_cache(maxsize=64)  # a segment between gaps has a step of its own
def _window_of(length: int, order: int, derivative: int, step: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Powers of a window, what reads off its polynomial at each sample, and weights of the sample in its middle."""
    half = length // 2
    # half a window counts as 1, so that the powers of all orders are of one size
    unit = max(half, 1)
    powers = np.vander(np.arange(-half, half + 1) / unit, order + 1, increasing=True)
    read_off = np.zeros_like(powers)
    factors = [math.perm(power, derivative) for power in range(derivative, order + 1)]
    read_off[:, derivative:] = powers[:, : order + 1 - derivative] * factors / (unit * step) ** derivative
    return powers, read_off, np.linalg.lstsq(powers.T, read_off[half], rcond=None)[0]


def polynomials_through_windows(
    values: FloatArray,
    length: int,
    order: int,
    *,
    derivative: int,
    step: float,
    at_ends: tuple[bool, bool] = (True, True),
) -> FloatArray:
    """Fit a polynomial to the window around every sample, and read it or its derivative off at the sample.

    Samples less than half a window from an end are read off the polynomial of the first or last full window.

    Args:
        values: Evenly spaced samples, at least as many as a window holds; shape (n, k).
        length: Samples in a window, an odd number above the order.
        order: Order of the polynomials.
        derivative: 0 to smooth, 1 for the rate, 2 for the second derivative; at most the order.
        step: Time from one sample to the next; s.
        at_ends: Whether samples close to the first and to the last one are wanted; else they are NaN.

    Returns:
        Filtered samples; shape (n, k); the unit of `values` per s ** derivative.
    """
    half = length // 2
    powers, read_off, weights = _window_of(length, order, derivative, step)
    result = np.empty(values.shape)
    for k, column in enumerate(values.T):
        result[half : len(values) - half, k] = np.correlate(column, weights, mode="valid")
    if half:
        first, last = slice(half), slice(len(values) - half, None)
        result[first] = result[last] = np.nan
        if at_ends[0]:
            result[first] = read_off[:half] @ np.linalg.lstsq(powers, values[:length], rcond=None)[0]
        if at_ends[1]:
            result[last] = read_off[-half:] @ np.linalg.lstsq(powers, values[-length:], rcond=None)[0]
    return result


_COINCIDENCE = 1e-6
"""A sample this close to an instant of the grid, in steps, is at it: places are rounded."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SavitzkyGolay:
    """A polynomial fitted to the samples of a window around each instant."""

    window_s: float
    """Length of the window; s."""
    order: int
    """Order of the polynomial."""
    least_samples: int = 0
    """Samples that the window holds at least where it is widened for a slow stream."""
    widest_s: float = 0.0
    """Length to which it may be widened; s; 0 for a window that is not."""

    def doubled(self) -> SavitzkyGolay:
        """Give the window of twice the length, by which flattening is estimated.

        Returns:
            The window, with twice the length wherever it is widened too.
        """
        return replace(
            self,
            window_s=2.0 * self.window_s,
            least_samples=2 * self.least_samples - 1 if self.least_samples else 0,
            widest_s=2.0 * self.widest_s,
        )

    def __post_init__(self) -> None:
        if not 0.0 < self.window_s < math.inf or self.order < 0:
            raise RecordingError(
                f"Savitzky-Golay: expected a finite window above 0 s and an order of at least 0, "
                f"got {self.window_s:g} s and {self.order}"
            )


DERIVATIVE_WINDOW: Final = SavitzkyGolay(window_s=0.3, order=3, least_samples=5, widest_s=2.0)
"""Window of derivatives where the experiment file specifies none: of streams below 10 Hz it is as long as the fewest
samples that leave a residual, down to 2 Hz; slower stamps are poses at rest, or in another unit."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EvenGrid:
    """Even instants between the gaps of a stream: it is filtered on them, whichever of its samples are looked at."""

    period_s: float
    """Median period of the stream; s."""
    gap_ns: int
    """A longer pause is a gap; ns."""
    start_ns: IntArray
    """First sample of every segment between gaps; shape (k,); ns."""
    end_ns: IntArray
    """Last sample of every segment; shape (k,); ns."""

    @classmethod
    def of(cls, stamp_ns: IntArray) -> EvenGrid:
        """Lay a grid over a stream.

        Args:
            stamp_ns: At least two increasing stamps; shape (n,); ns.

        Returns:
            Its grid.
        """
        steps, limit = np.diff(stamp_ns), gap_limit_ns(stamp_ns)
        last = np.flatnonzero(steps > limit)
        return cls(
            # of the whole stream: a short segment has too few samples for it
            period_s=float(np.median(steps)) * 1e-9,
            gap_ns=limit,
            start_ns=stamp_ns[np.concatenate([[0], last + 1])],
            end_ns=stamp_ns[np.concatenate([last, [len(stamp_ns) - 1]])],
        )

    def length_of(self, window: SavitzkyGolay) -> int:
        """Count how many instants a window holds.

        Args:
            window: A filter.

        Returns:
            An odd number.

        Raises:
            RecordingError: If they cannot carry the order of the filter.
        """
        length = 2 * int(round(0.5 * window.window_s / self.period_s)) + 1
        if (window.least_samples - 1) * self.period_s <= window.widest_s:
            length = max(length, window.least_samples)
        if length <= window.order:
            raise RecordingError(
                f"Savitzky-Golay: a window of {window.window_s:g} s holds {length} sample(s) of {self.period_s:.4g} s, "
                f"which cannot carry order {window.order}; lengthen the window, or specify the stamps in their unit, "
                'or as "row" where each row is a pose at rest'
            )
        return length

    def positions(self, stamp_ns: IntArray) -> tuple[FloatArray, float]:
        """Give the positions of samples of one segment.

        Args:
            stamp_ns: Stamps of samples of one segment; shape (n,); ns.

        Returns:
            Their places, in steps from the first instant of the segment, shape (n,); length of a step, s.
        """
        segment = int(np.searchsorted(self.start_ns, stamp_ns[0], side="right")) - 1
        start, end = int(self.start_ns[segment]), int(self.end_ns[segment])
        length = (end - start) * 1e-9
        # both ends of a segment are instants of the grid
        step = length / max(round(length / self.period_s), 1) if end > start else self.period_s
        return seconds_since(stamp_ns, start) / step, step


def smooth(
    stamp_ns: IntArray,
    values: FloatArray,
    window: SavitzkyGolay,
    *,
    derivative: int = 0,
    grid: EvenGrid | None = None,
) -> FloatArray:
    """Smooth or differentiate samples in time.

    Stamps jitter, so every segment between gaps is brought to an even grid of the stream's median
    period, filtered there, and read off at its own stamps. Ends of a segment use the polynomial of
    the last full window. A segment shorter than the window gives NaN. A sample with a NaN in any
    column gives NaN and counts as missing: too many in a row are a gap, fewer are bridged.

    Args:
        stamp_ns: Stamps in the order of the log; shape (n,); ns.
        values: Samples; shape (n, k).
        window: Length and order of the filter.
        derivative: 0 to smooth, 1 for the rate, 2 for the second derivative.
        grid: Grid of the stream that the samples are a part of; None for that of the complete samples themselves.

    Returns:
        Filtered samples at the same stamps; shape (n, k); the unit of `values` per
        s ** derivative.
    """
    (result,) = FilteredColumns(stamp_ns, values, window, derivatives=(derivative,), together=True, grid=grid).all()
    return result


def smooth_columns(stamp_ns: IntArray, values: FloatArray, window: SavitzkyGolay, *, derivative: int = 0) -> FloatArray:
    """Smooth or differentiate columns as if each were a stream of its own: a NaN in one takes nothing from another.

    Args:
        stamp_ns: Stamps in the order of the log; shape (n,); ns.
        values: Samples; shape (n, k).
        window: Length and order of the filter.
        derivative: 0 to smooth, 1 for the rate, 2 for the second derivative.

    Returns:
        Filtered samples at the same stamps, as `smooth` gives them; shape (n, k); the unit of `values` per
        s ** derivative.
    """
    (result,) = FilteredColumns(stamp_ns, values, window, derivatives=(derivative,)).all()
    return result


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Columns:
    """Columns that lack the same samples."""

    columns: list[int]
    rows: IntArray
    """Rows that step forward in time and lack nothing."""
    stamp_ns: IntArray
    """Their stamps."""
    grid: EvenGrid
    length: int
    """Instants of the grid in a window."""
    segment: IntArray
    """Number of the segment between gaps that each of the rows lies in."""

    def is_gap_before(self, place: int) -> bool:
        """Whether a segment begins at a place among the rows, or the last one ended."""
        return place in (0, len(self.rows)) or self.segment[place] != self.segment[place - 1]

    def around(self, places: IntArray) -> IntArray:
        """Places of the samples that the filter takes for results at some increasing places."""
        # two windows: where a segment ends, the last whole one is used, and steps of the grid are near its period
        reach = round(2.0 * (self.length + 1) * self.grid.period_s * 1e9) + self.grid.gap_ns
        stamps = self.stamp_ns[places]
        apart = np.flatnonzero(np.diff(stamps) > 2 * reach)
        first = np.searchsorted(self.stamp_ns, stamps[np.concatenate([[0], apart + 1])] - reach, side="left")
        after = np.searchsorted(self.stamp_ns, stamps[np.concatenate([apart, [-1]])] + reach, side="right")
        return np.concatenate([np.arange(a, b) for a, b in zip(first.tolist(), after.tolist(), strict=True)])


class FilteredColumns:
    """Columns of a stream, which are filtered where they are looked at as if all of the stream were filtered.

    The rows around those that are looked at are filtered with them, no more: the effort does not depend on the length
    of the stream.
    """

    def __init__(
        self,
        stamp_ns: IntArray,
        values: FloatArray,
        window: SavitzkyGolay,
        *,
        columns: Sequence[int] | None = None,
        derivatives: tuple[int, ...],
        together: bool = False,
        grid: EvenGrid | None = None,
    ) -> None:
        """Lay grids over the stream.

        Args:
            stamp_ns: Stamps in the order of the log; shape (n,); ns.
            values: Samples; shape (n, k).
            window: Length and order of the filter.
            columns: Columns to filter; all if None.
            derivatives: For each result 0 to smooth, 1 for the rate, 2 for the second derivative.
            together: Whether a sample with a NaN in any column counts as missing in all; else each column is as a
                stream of its own.
            grid: Grid of the stream that the samples are a part of; None for that of the complete samples themselves.

        Raises:
            RecordingError: If the order is too low for a derivative, or the window holds too few samples.
        """
        if window.order < max(derivatives):
            raise RecordingError(
                f"Savitzky-Golay: derivative {max(derivatives)} needs a polynomial of at least that order, got "
                f"{window.order}"
            )
        self._values, self._order, self._derivatives = values, window.order, derivatives
        self._columns = list(range(values.shape[1]) if columns is None else columns)
        usable = usable_samples(stamp_ns)
        self._groups = []
        for own, complete in self._complete(usable, together=together):
            rows = usable[complete]
            if len(rows) < 2:
                continue
            stamps = stamp_ns[rows]
            own_grid = EvenGrid.of(stamps) if grid is None else grid
            length = own_grid.length_of(window)
            segment = np.concatenate([[0], np.cumsum(np.diff(stamps) > own_grid.gap_ns)])
            group = _Columns(columns=own, rows=rows, stamp_ns=stamps, grid=own_grid, length=length, segment=segment)
            self._groups.append(group)

    def _complete(self, usable: IntArray, *, together: bool) -> Iterable[tuple[list[int], BoolArray]]:
        """Positions of columns that lack the same samples, with marks of usable samples that they do not lack."""
        everything = list(range(len(self._columns)))
        if together:
            complete = np.ones(len(usable), dtype=bool)
            for column in self._columns:
                complete &= np.isfinite(self._values[usable, column])
            return [(everything, complete)]
        groups: dict[bytes, tuple[list[int], BoolArray]] = {}  # they may be filtered at once
        for k, column in enumerate(self._columns):
            complete = np.isfinite(self._values[usable, column])
            groups.setdefault(np.packbits(complete).tobytes(), ([], complete))[0].append(k)
        return groups.values()

    def all(self) -> list[FloatArray]:
        """Filter all rows.

        Returns:
            Filtered samples of every derivative; shape (n, k); the unit of the values per s ** derivative; NaN for rows
            that are missing, or in a segment between gaps that is shorter than the window.
        """
        results = [np.full((len(self._values), len(self._columns)), np.nan) for _ in self._derivatives]
        for group in self._groups:
            filtered = self._filtered(group, np.arange(len(group.rows)))
            for result, values in zip(results, filtered, strict=True):
                result[group.rows[:, None], group.columns] = values
        return results

    def at(self, rows: IntArray) -> list[FloatArray]:
        """Filter some rows.

        Args:
            rows: Increasing rows of the stream; shape (m,).

        Returns:
            As of `all`, in these rows; shape (m, k).
        """
        results = [np.full((len(rows), len(self._columns)), np.nan) for _ in self._derivatives]
        for group in self._groups:
            places = np.minimum(np.searchsorted(group.rows, rows), len(group.rows) - 1)
            present = np.flatnonzero(group.rows[places] == rows)
            if not len(present):
                continue
            wanted = places[present]
            around = group.around(wanted)
            filtered = self._filtered(group, around)
            for result, values in zip(results, filtered, strict=True):
                result[present[:, None], group.columns] = values[np.searchsorted(around, wanted)]
        return results

    def _filtered(self, group: _Columns, places: IntArray) -> list[FloatArray]:
        """Filter ranges of the complete samples of a group; what is close to their ends is right only at gaps."""
        columns = [self._columns[k] for k in group.columns]
        samples = self._values[group.rows[places][:, None], columns]
        results = [np.full(samples.shape, np.nan) for _ in self._derivatives]
        ends = [0, *(np.flatnonzero(np.diff(group.segment[places])) + 1).tolist(), len(places)]
        for start, end in pairwise(ends):
            own = places[start:end]
            positions, step = group.grid.positions(group.stamp_ns[own])
            even = _instants(positions, np.flatnonzero(np.diff(own) > 1) + 1)
            if len(even) < max(group.length, 2):
                continue
            at_ends = (group.is_gap_before(int(own[0])), group.is_gap_before(int(own[-1]) + 1))
            on_grid = np.column_stack([np.interp(even, positions, column) for column in samples[start:end].T])
            for derivative, result in zip(self._derivatives, results, strict=True):
                filtered = polynomials_through_windows(
                    on_grid, group.length, self._order, derivative=derivative, step=step, at_ends=at_ends
                )
                result[start:end] = _off_grid(even, positions, filtered)
        return results


def _instants(positions: FloatArray, holes: IntArray) -> FloatArray:
    """Instants of a grid between positions, without those in holes; their windows are not looked at."""
    first = np.ceil(positions[np.concatenate([[0], holes])] - _COINCIDENCE)
    last = np.floor(positions[np.concatenate([holes - 1, [-1]])] + _COINCIDENCE)
    return np.concatenate([np.arange(a, b + 1.0) for a, b in zip(first.tolist(), last.tolist(), strict=True)])


def _off_grid(grid: FloatArray, positions: FloatArray, filtered: FloatArray) -> FloatArray:
    """Read filtered instants of a grid off at samples; shape (n, k)."""
    result = np.column_stack([np.interp(positions, grid, column) for column in filtered.T])
    # a part of a segment may begin and end between instants of the grid
    before, after = positions - grid[0], positions - grid[-1]
    for outside, distance, slope in (
        (before < 0.0, before, filtered[1] - filtered[0]),
        (after > 0.0, after, filtered[-1] - filtered[-2]),
    ):
        result[outside] += np.outer(distance[outside], slope)
    return result
