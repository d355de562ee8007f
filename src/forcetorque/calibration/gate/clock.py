# SPDX-License-Identifier: BSD-3-Clause
"""Refusal of a channel that is a clock or a counter, which a matrix without a prior would take for a gauge."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.calibration.data_set import DataSet
from forcetorque.calibration.moments import Moments, symmetric_pseudo_inverse
from forcetorque.errors import FitError
from forcetorque.spatial import FORCE_AND_MOMENT

_FEWEST = 20
"""Changes of a channel below which it may rise all the while by chance."""

_ONE_WAY = 0.99
"""Share of a channel's changes that go one way in a clock; the others are those of a counter that starts again.

Of a gauge half do: its noise changes it at every sample. Under a load that goes one way, or smoothed, more do.
"""

_FOLLOWS = 0.9
"""Share of a channel that such a load explains; of a clock swings explain some tenths, and a slow sweep nearly all."""

_STRAIGHT, _BENT = 1e-4, 1e-2
"""Shares of their movement that a channel lacks, and the load has, off a straight line in time, where the channel is a
clock although the load explains it: no gauge is straighter than all that it measures."""


def require_gauges(data_sets: Sequence[DataSet], moments: Moments) -> None:
    """Refuse a channel that rises, or falls, whatever the load does.

    Args:
        data_sets: The data, of at least two samples each.
        moments: Their moments.

    Raises:
        FitError: If there is one; the message names it.
    """
    steps = np.concatenate([np.diff(data.raw, axis=0) for data in data_sets])
    up, down = np.count_nonzero(steps > 0.0, axis=0), np.count_nonzero(steps < 0.0, axis=0)
    one_way = (up + down >= _FEWEST) & (np.maximum(up, down) >= _ONE_WAY * (up + down))
    channels, load = _off_line(data_sets)
    straight = (channels < _STRAIGHT) & (load > _BENT)
    clocks = np.flatnonzero(one_way & (straight | (_explained(moments) < _FOLLOWS)))
    if len(clocks):
        channel = int(clocks[0])
        way = "rises" if up[channel] > down[channel] else "falls"
        raise FitError(
            f"channel ch{channel}, column {channel + 1} of {moments.channels} of the raw reading, {way} from sample to "
            "sample whatever the load does, as a clock or a counter; leave it out of the reading's columns"
        )


def _off_line(data_sets: Sequence[DataSet]) -> tuple[FloatArray, float]:
    """Share of their movement that channels, shape (c,), and the load have off a straight line in time."""
    moved, left = np.zeros((2, data_sets[0].raw.shape[1] + 6))
    for data in data_sets:
        time = np.arange(float(len(data.raw))) if data.time_s is None else data.time_s
        time = time - time.mean()
        values = np.hstack([data.raw, data.reference])
        values = values - values.mean(axis=0)
        moved += (values**2).sum(axis=0)
        left += ((values - np.outer(time, time @ values) / max(time @ time, np.finfo(float).tiny)) ** 2).sum(axis=0)
    load = [_share(left[-6:][part].sum(), moved[-6:][part].sum()) for part in FORCE_AND_MOMENT]
    return _share(left[:-6], moved[:-6]), float(min(load))


def _explained(moments: Moments) -> FloatArray:
    """Share of the movement of every channel that the reference explains; shape (c,)."""
    to_raw = moments.reference_raw
    square = np.einsum("ik,ij,jk->k", to_raw, symmetric_pseudo_inverse(moments.reference_reference), to_raw)
    return _share(square, np.diag(moments.raw_raw))


def _share(part: FloatArray, whole: FloatArray) -> FloatArray:
    """Of what does not move it is all."""
    shares: FloatArray = np.divide(part, whole, out=np.ones(np.shape(whole)), where=whole > 0.0)
    return shares
