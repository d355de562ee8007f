# SPDX-License-Identifier: BSD-3-Clause
"""The first second of a judged interval, which gives an offset and is judged by none, and what it leaves out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.experiment.offset_policy import Offset, mean_offset
from forcetorque.experiment.validation_set import OFFSET_S
from forcetorque.recording.recording import Interval
from forcetorque.robot.mechanics.samples import PaddedSamples


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class JudgedInstants:
    """Instants of one interval: filters, and tells its first second from what is judged."""

    samples: PaddedSamples
    """Instants of the interval, with those around it that the filter of all that is judged takes."""

    @property
    def at_ns(self) -> IntArray:
        """Instants at which errors are wanted, also those around the interval; shape (n,); ns."""
        return self.samples.stamp_ns

    @property
    def first(self) -> BoolArray:
        """Samples of the first second of the interval, which give an offset and are not judged; shape (m,)."""
        stamps = self.at_ns[self.samples.inside]
        return stamps < stamps[0] + round(OFFSET_S * 1e9)

    @property
    def judged_ns(self) -> IntArray:
        """Instants of the later samples, which are judged; shape (m,); ns."""
        return self.at_ns[self.samples.inside][~self.first]

    def with_offset(self, error: FloatArray, source: Offset) -> FloatArray:
        """Take off the mean error of the first second where the offset is to come from there.

        Args:
            error: Errors, not filtered; shape (n, k); NaN in gaps.
            source: Which offset is wanted.

        Returns:
            Errors, not filtered; all NaN where every sample of the first second has a gap: the offset is not known.
        """
        if source is Offset.FITTED:
            return error
        return error + self._offset(self.samples.smoothed(error))

    def judged(self, error: FloatArray) -> FloatArray:
        """Filter errors as readings and references are elsewhere, and leave out the first second.

        Args:
            error: Errors, not filtered; shape (n, k).

        Returns:
            Filtered errors of the later samples; shape (m, k).
        """
        return self.samples.smoothed(error)[~self.first]

    def judged_with_both(self, error: FloatArray) -> dict[Offset, FloatArray]:
        """Give what is judged with either offset.

        Args:
            error: Errors with the fitted offset, not filtered; shape (n, k).

        Returns:
            Filtered errors of the later samples by offset; shape (m, k).
        """
        filtered = self.samples.smoothed(error)
        later = filtered[~self.first]
        return {Offset.FITTED: later, Offset.FIRST_SECOND: later + self._offset(filtered)}

    def _offset(self, filtered: FloatArray) -> FloatArray:
        return mean_offset(-filtered[self.first])


def nothing_left(instants: JudgedInstants, interval: Interval) -> str | None:
    """Tell whether an interval is too short to be judged.

    Args:
        instants: Its instants.
        interval: The interval.

    Returns:
        What is left out, in words; None where there are samples to judge.
    """
    if not instants.first.all():
        return None
    return f"interval {interval.label!r}: it ends within its first {OFFSET_S:g} s, after which it would be judged"


def gap_words(what: str, interval: Interval, judged: Mapping[Offset, FloatArray]) -> str | None:
    """Tell whether gaps leave nothing to judge in an interval, with either offset or with that of the first second.

    Args:
        what: What is judged, in words.
        interval: The interval.
        judged: Errors with either offset; shape (m,) or (m, k); a sample with a NaN is not judged.

    Returns:
        What is left out, in words; None where both can be judged.
    """
    unknown = [
        offset for offset, errors in judged.items() if np.isnan(errors.reshape(len(errors), -1)).any(axis=1).all()
    ]
    if Offset.FITTED in unknown:
        return f"{what} over {interval.label!r}: every judged sample has a gap"
    if unknown:
        offset = Offset.FIRST_SECOND.value
        return f"{what} over {interval.label!r}, offset {offset}: every sample of its first second has a gap"
    return None
