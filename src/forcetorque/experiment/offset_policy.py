# SPDX-License-Identifier: BSD-3-Clause
"""Where the offset of a sensor comes from: as fitted, from the first second, or the mean; and which data give it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Any, Final, Self

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only, require_shape
from forcetorque.base.errors import ExperimentError, ShapeError, known_names
from forcetorque.base.noise.means import mean_error


class Offset(StrEnum):
    """Where the offset of a sensor comes from."""

    FIRST_SECOND = "first-second"
    """From the first second of every judged interval, which is then not judged: the matrix is judged, as on a robot
    that starts (thesis Table 5.5)."""
    FITTED = "fitted"
    """That of the fitted data: matrix and offset are judged (Table 5.6)."""
    JUDGED_MEAN = "judged-mean"
    """Mean of the judged samples themselves: what is left when nothing constant counts; nobody has it beforehand."""
    NONE = "none"
    """None was removed: whatever the sensor has is in the error."""
    TARE = "tare"
    """From an interval at rest, in which the sensor is to read what the model says of the load beyond it."""
    ONE_LINK_IMU = "one-link-imu"
    """From the still seconds of an interval in which the world touches one link alone, be it the foot that the robot
    stands on or the link that it hangs from; an IMU tells gravity (thesis 5.6)."""
    ONE_LINK_FIXED_FRAME = "one-link-fixed-frame"
    """The same with gravity as it is stated for that link, such as along the normal of the sole (thesis 5.6)."""


KNOWN_BEFORE = (Offset.FIRST_SECOND, Offset.FITTED)
"""Offsets that are known when the judging begins."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class OffsetEstimate:
    """The offset with which readings are in the mean what is demanded of them."""

    value: FloatArray
    """To be added to the readings; shape (6,); N, N m."""
    half_width: FloatArray
    """Half-width of its 95 % interval, of noise that is white and slow; shape (6,); N, N m; infinite where it cannot
    be told. Errors of matrix and model are not in it."""
    count: int
    """Number of samples."""

    def __post_init__(self) -> None:
        for field in ("value", "half_width"):
            object.__setattr__(self, field, read_only(getattr(self, field), name=field, shape=(6,)))

    @classmethod
    def of(cls, lacking: Any, time_s: Any) -> OffsetEstimate:
        """Estimate the offset from what readings lack.

        Args:
            lacking: What is demanded, less what is read without an offset; shape (n, 6); N, N m; all finite.
            time_s: Instants of the samples, not falling; shape (n,); s.

        Returns:
            The offset with its interval.

        Raises:
            ShapeError: If the shapes are not these, or there is no sample.
        """
        samples = np.asarray(lacking, dtype=np.float64)
        require_shape(samples, name="lacking", shape=(None, 6))
        if not len(samples):
            raise ShapeError("lacking: expected at least one sample to take an offset from, got none")
        half_width = mean_error(samples, time_s).half_width
        return cls(value=mean_offset(samples), half_width=half_width, count=len(samples))


def mean_offset(lacking: Any) -> FloatArray:
    """Give the offset with which readings are in the mean what is demanded of them.

    Args:
        lacking: What is demanded, less what is read without it; shape (n, k); a sample with a gap (NaN) is left out.

    Returns:
        To be added to the readings; shape (k,); NaN where every sample has a gap.
    """
    samples = np.asarray(lacking, dtype=np.float64)
    require_shape(samples, name="lacking", shape=(None, None))
    whole = samples[~np.isnan(samples).any(axis=1)]
    return whole.mean(axis=0) if len(whole) else np.full(samples.shape[1], np.nan)


OF_ONE_LINK: Final = (Offset.ONE_LINK_IMU, Offset.ONE_LINK_FIXED_FRAME)
"""Offsets from still seconds in which one link alone is touched."""
OF_INTERVAL: Final = (*OF_ONE_LINK, Offset.TARE)
"""Offsets that come from an interval, which must be named."""


@dataclass(frozen=True, slots=True)
class OffsetPolicy:
    """Where the offset of the sensors is to come from."""

    offset: Offset
    """The way."""
    interval: str | None = None
    """Label of the interval that gives it, for the ways that take one."""

    def __post_init__(self) -> None:
        needed = self.offset in OF_INTERVAL
        if needed is (self.interval is None):
            expected = f"{self.offset}:LABEL, of the interval that gives it" if needed else f"{self.offset} alone"
            raise ExperimentError(f"offset: expected {expected}, got {self}")

    @classmethod
    def of(cls, words: str) -> Self:
        """Understand a policy as the command line has it, such as `none` or `one-link-imu:hanging`.

        Args:
            words: The way, and for some ways a colon and the label of an interval.

        Returns:
            The policy.

        Raises:
            ExperimentError: If there is no such way, or an interval is missing or too much.
        """
        name, _, label = words.partition(":")
        if name not in tuple(Offset):
            raise ExperimentError(f"offset: no way is called {name!r}; {known_names(name, Offset)}")
        return cls(Offset(name), label or None)

    def __str__(self) -> str:
        return self.offset.value if self.interval is None else f"{self.offset}:{self.interval}"
