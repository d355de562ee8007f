# SPDX-License-Identifier: BSD-3-Clause
"""Moments of an interval in blocks, which add up to those of the interval, so that a fit can leave blocks out."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.rows_on_disk import concatenated
from forcetorque.experiment.calibration.moments import DataSet, Moments
from forcetorque.experiment.calibration.stored_moments import IntervalMoments, end_samples
from forcetorque.recording.frozen_and_saturated_samples import UnusableCounts

BLOCK_S = 60.0
"""Longest block; s."""


def in_blocks(whole: IntervalMoments, data: DataSet, longest_s: float = BLOCK_S) -> tuple[IntervalMoments, ...]:
    """Divide the moments of an interval.

    Blocks end where windows end, so that `joined` gives the windows of the interval bit by bit.

    Args:
        whole: Moments of the interval.
        data: The samples that it was made of.
        longest_s: Longest block; s.

    Returns:
        Moments of every block, in the order of time; samples that were left out are counted in the first.
    """
    number = np.floor((whole.time_s - whole.time_s[0]) / longest_s)
    starts = np.flatnonzero(np.diff(number, prepend=-1.0)).tolist()
    if len(starts) == 1:
        return (whole,)
    samples = np.concatenate([[0.0], np.cumsum(whole.count)]).astype(np.int64)
    ends = end_samples(data, whole.moments)
    blocks = []
    for first, last in zip(starts, [*starts[1:], len(whole.time_s)], strict=True):
        own = slice(int(samples[first]), int(samples[last]))
        blocks.append(_block(whole, data, slice(first, last), own, ends[(ends >= own.start) & (ends < own.stop)]))
    return tuple(blocks)


def _block(whole: IntervalMoments, data: DataSet, windows: slice, own: slice, ends: IntArray) -> IntervalMoments:
    raw, variables = data.raw[own], data.variables[own]
    moments = Moments.of(raw, data.reference[own], variables)
    left_out = {} if windows.start == 0 else {"dropped": 0, "unusable": UnusableCounts()}
    names = ("time_s", "count", "raw", "reference", "flattening")
    return whole.model_copy(
        update={
            **left_out,
            **{name: getattr(whole, name)[windows] for name in names},
            "samples": moments.count,
            "raw_minimum_counts": raw.min(axis=0),
            "raw_maximum_counts": raw.max(axis=0),
            "variable_minimum": variables.min(axis=0),
            "variable_maximum": variables.max(axis=0),
            "mean": moments.mean,
            "second_moment": moments.second,
            "variables": whole.variables[windows] if whole.variables.size else whole.variables,
            "extreme_raw": data.raw[ends],
            "extreme_variables": data.variables[ends] if variables.shape[1] else np.zeros((0, 0)),
            "model": None if whole.model is None else whole.model[windows],
        }
    )


def joined(blocks: Sequence[IntervalMoments]) -> tuple[IntervalMoments, ...]:
    """Put blocks together.

    Args:
        blocks: Blocks of any number of intervals, those of one interval one after the other, in the order of time;
            some may be left out.

    Returns:
        Moments of every interval.
    """
    groups = groupby(blocks, key=lambda block: (block.recording, block.interval.label))
    return tuple(_joined(list(group)) for _, group in groups)


def _joined(blocks: Sequence[IntervalMoments]) -> IntervalMoments:
    if len(blocks) == 1:
        return blocks[0]
    moments = pairwise_sum([block.moments for block in blocks])
    names = ("time_s", "count", "raw", "reference", "flattening", "variables", "extreme_raw", "extreme_variables")
    together = {name: _stacked([getattr(block, name) for block in blocks]) for name in (*names, "model")}
    return blocks[0].model_copy(
        update={
            **together,
            "samples": moments.count,
            "dropped": sum(block.dropped for block in blocks),
            "unusable": UnusableCounts.total(block.unusable for block in blocks),
            "raw_minimum_counts": np.min([block.raw_minimum_counts for block in blocks], axis=0),
            "raw_maximum_counts": np.max([block.raw_maximum_counts for block in blocks], axis=0),
            "variable_minimum": np.min([block.variable_minimum for block in blocks], axis=0),
            "variable_maximum": np.max([block.variable_maximum for block in blocks], axis=0),
            "mean": moments.mean,
            "second_moment": moments.second,
        }
    )


def _stacked(arrays: Sequence[FloatArray | None]) -> FloatArray | None:
    # a file does not keep how wide an array without rows is
    present = [array for array in arrays if array is not None]
    return concatenated([array for array in present if array.size] or present[:1]) if present else None


def pairwise_sum(parts: Sequence[Moments]) -> Moments:
    """Add moments in pairs, then the sums in pairs: rounding grows with the logarithm of their number.

    Args:
        parts: Moments of one sensor, at least one.

    Returns:
        Their sum; the same to the last bit for the same parts in the same order.
    """
    level = list(parts)
    while len(level) > 1:
        pairs = [one + other for one, other in zip(level[::2], level[1::2], strict=False)]
        level = pairs + level[2 * len(pairs) :]
    return level[0]
