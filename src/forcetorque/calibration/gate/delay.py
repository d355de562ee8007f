# SPDX-License-Identifier: BSD-3-Clause
"""Whether the reading comes later or earlier than the reference."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.calibration.data_set import DataSet
from forcetorque.calibration.gate.doubt import Doubt
from forcetorque.calibration.gate.movement import Movement
from forcetorque.recording.lag import EVEN, EvenPair, residual_at_lags

_LARGEST_S = 0.5
"""Largest delay that is looked for."""

_FEWEST_LAGS = 2
"""Samples below which a delay is that of the logging itself."""

_BETTER = 0.8
"""Part of the residual's mean square that may be left without the delay for it to matter."""

_SHORTEST = 10
"""Length of a data set in largest delays, below which it is left out."""

_COARSE = 10
"""Steps in which the largest delay is searched before the best one's surroundings are, sample by sample."""


def delay_doubts(data_sets: Sequence[DataSet], prior: FloatArray | None) -> Iterator[Doubt]:
    """Look for the lag at which the reference explains most of the reading.

    Args:
        data_sets: The data; those without time stamps are left out.
        prior: Matrix that makes a force of the raw reading; shape (6, c); None to take the channels as they are.

    Yields:
        A doubt where a lag of at least two samples explains the reading clearly better than none.
    """
    timed = [data for data in data_sets if data.time_s is not None]
    long = [data for data in timed if data.time_s[-1] - data.time_s[0] > _SHORTEST * _LARGEST_S]
    if not long:
        return
    step = float(np.median(np.concatenate([np.diff(data.time_s) for data in long])))
    most = int(_LARGEST_S / step + EVEN) if step > 0.0 else 0
    if most < _FEWEST_LAGS:
        return
    even = [
        EvenPair.of(
            data.time_s,
            data.raw if prior is None else data.raw @ prior[:3].T,
            data.reference,
            step_s=step,
            most=most,
        )
        for data in long
        if data.time_s is not None
    ]
    lag = _best_lag(even, most)
    if abs(lag) < _FEWEST_LAGS:
        return
    left = [
        float(m.left(m.lasting).sum())
        for m in (Movement.of([_at_lag(pair, at) for pair in even], None) for at in (0, lag))
    ]
    if left[1] < _BETTER * left[0]:
        yield Doubt(
            kind="delay",
            message=f"the reading comes {abs(lag) * step * 1e3:.0f} ms {'later' if lag > 0 else 'earlier'} than the "
            f"reference: moved by it, {1.0 - (left[1] / left[0]) ** 0.5:.0%} less of it is left unexplained; align "
            'their clocks by [[clock]], delay_s = "estimate", or log both by one clock (stamp of '
            "[[recording.stream]]; among arrays shift joint_time_s), and look for a delay between their ports",
        )


def _at_lag(pair: EvenPair, lag: int) -> DataSet:
    return DataSet(label="", raw=pair.later(lag).T, reference=pair.reference)


def _best_lag(even: Sequence[EvenPair], most: int) -> int:
    """Lag, in samples, with the smallest residual of the reading regressed on the reference."""
    residual = residual_at_lags(even)

    def left(lag: int) -> float:
        return float(residual(lag).sum())

    width = max(most // _COARSE, 1)
    near = min(range(-(most // width) * width, most + 1, width), key=left)
    return min(range(max(near - width + 1, -most), min(near + width, most + 1)), key=left)
