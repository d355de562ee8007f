# SPDX-License-Identifier: BSD-3-Clause
"""Where the offset of a validated sensor comes from, and the first second of an interval that gives it."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any, Final, Self

import numpy as np

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, IntArray, array, require_shape
from forcetorque.base.errors import ExperimentError, FitError, ShapeError, known_names
from forcetorque.base.noise.window_means import mean_error
from forcetorque.recording.recording import Interval
from forcetorque.robot.mechanics.measured_and_expected_wrench import PaddedSamples


class Offset(StrEnum):
    """Where the offset of a sensor comes from."""

    FIRST_SECOND = "first-second"
    """From the first second of every validation interval, which is then not evaluated: errors are of the matrix, as on
    a robot that starts (thesis Table 5.5)."""
    FITTED = "fitted"
    """That of the fitted data: matrix and offset are evaluated (Table 5.6)."""
    JUDGED_MEAN = "judged-mean"
    """Mean of the evaluated samples themselves: what is left when nothing constant counts; nobody has it beforehand."""
    NONE = "none"
    """None was removed: the offset of the sensor is part of the error."""
    TARE = "tare"
    """From an interval at rest, in which the sensor is to read what the model says of the load beyond it."""
    ONE_LINK_IMU = "one-link-imu"
    """From the still seconds of an interval in which the world touches one link alone, be it the foot that the robot
    stands on or the link that it hangs from; an IMU tells gravity (thesis 5.6)."""
    ONE_LINK_FIXED_FRAME = "one-link-fixed-frame"
    """The same with gravity as it is specified for that link, such as along the normal of the sole (thesis 5.6)."""


KNOWN_BEFORE = (Offset.FIRST_SECOND, Offset.FITTED)
"""Offsets that are known before an evaluation begins."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class OffsetEstimate(ArrayRecord):
    """The offset with which readings are in the mean what is demanded of them."""

    value: FloatArray = field(metadata=array(6))
    """To be added to the readings; shape (6,); N, N m."""
    half_width: FloatArray = field(metadata=array(6))
    """Half-width of its 95 % interval, of noise that is white and slow; shape (6,); N, N m; infinite where it cannot
    be told. Errors of matrix and model are not in it."""
    count: int
    """Number of samples."""

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


OFFSET_S = 1.0
"""Length of the stretch at the start of an interval from which an offset is taken, as on a robot that begins; s."""

_FEWEST = 10
"""Least number of samples of that stretch, and of the rest."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ValidationSet(ArrayRecord):
    """Readings and reference of one stretch of time that was not fitted."""

    label: str
    """Label of the interval."""
    session: str
    """Session that it is of."""
    time_s: FloatArray = field(metadata=array("n"))
    """Time of every sample since the start of the recording; shape (n,); s."""
    raw: FloatArray = field(metadata=array("n", None))
    """Raw readings; shape (n, c); counts."""
    reference: FloatArray = field(metadata=array("n", 6))
    """Wrench that the sensor must read where nothing touches; shape (n, 6); N, N m."""
    variables: FloatArray = field(metadata=array("n", None))
    """Linear variables; shape (n, v)."""

    def for_offset(self) -> BoolArray:
        """Mark the first second, from which an offset is taken.

        Returns:
            Whether a sample is of it; shape (n,).

        Raises:
            FitError: If there are too few samples to take an offset from, or to evaluate.
        """
        first: BoolArray = self.time_s < self.time_s[0] + OFFSET_S
        count, rest = int(first.sum()), int((~first).sum())
        if min(count, rest) < _FEWEST:
            raise FitError(
                f"validation interval {self.label!r}: expected at least {_FEWEST} samples in its first {OFFSET_S:g} s, "
                f"for the offset, and as many after it, to evaluate, got {count} and {rest}"
            )
        return first


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class IntervalStart:
    """The first sample of an interval, and the offsets that its first second gives."""

    stamp_ns: int
    """Its stamp."""
    offsets: dict[Hashable, FloatArray] = field(default_factory=dict)
    """Offsets by what errs; shape (k,) each; filled by the first part of the interval."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EvaluatedInstants:
    """Instants of one interval: filters, and tells its first second from what is evaluated."""

    samples: PaddedSamples
    """Instants of the interval, with those around it that the filter of all that is evaluated takes."""
    start: IntervalStart | None = None
    """Start of an interval whose parts are looked at one after the other; that of these samples if None."""

    @property
    def at_ns(self) -> IntArray:
        """Instants at which errors are wanted, also those around the interval; shape (n,); ns."""
        return self.samples.stamp_ns

    @property
    def first(self) -> BoolArray:
        """Samples of the first second of the interval, which give an offset and are not evaluated; shape (m,)."""
        stamps = self.at_ns[self.samples.inside]
        start_ns = stamps[0] if self.start is None else self.start.stamp_ns
        return np.asarray(stamps < start_ns + round(OFFSET_S * 1e9))

    @property
    def judged_ns(self) -> IntArray:
        """Instants of the later samples, which are evaluated; shape (m,); ns."""
        return self.at_ns[self.samples.inside][~self.first]

    def with_offset(self, error: FloatArray, source: Offset, of: Hashable) -> FloatArray:
        """Take off the mean error of the first second where the offset is to come from there.

        Args:
            error: Errors, not filtered; shape (n, k); NaN in gaps.
            source: Which offset is wanted.
            of: What errs; alike in all parts of an interval.

        Returns:
            Errors, not filtered; all NaN where every sample of the first second has a gap: the offset is not known.
        """
        if source is Offset.FITTED:
            return error
        return error + self._offset(self.samples.smoothed(error), of)

    def judged(self, error: FloatArray) -> FloatArray:
        """Filter errors as readings and references are elsewhere, and leave out the first second.

        Args:
            error: Errors, not filtered; shape (n, k).

        Returns:
            Filtered errors of the later samples; shape (m, k).
        """
        return self.samples.smoothed(error)[~self.first]

    def judged_with_both(self, error: FloatArray, of: Hashable) -> dict[Offset, FloatArray]:
        """Give what is evaluated with either offset.

        Args:
            error: Errors with the fitted offset, not filtered; shape (n, k).
            of: As of `with_offset`.

        Returns:
            Filtered errors of the later samples by offset; shape (m, k).
        """
        filtered = self.samples.smoothed(error)
        later = filtered[~self.first]
        return {Offset.FITTED: later, Offset.FIRST_SECOND: later + self._offset(filtered, of)}

    def _offset(self, filtered: FloatArray, of: Hashable) -> FloatArray:
        if self.start is None:
            return mean_offset(-filtered[self.first])
        if of not in self.start.offsets:
            self.start.offsets[of] = mean_offset(-filtered[self.first])
        return self.start.offsets[of]


class LeftOut:
    """What cannot be evaluated of intervals: short ones, and those of which gaps leave nothing, with either offset."""

    def __init__(self) -> None:
        """Begin."""
        self._stated: dict[str, None] = {}
        self._known: dict[tuple[str, str], dict[Offset, bool]] = {}

    def add(self, texts: Iterable[str]) -> None:
        """State what else is left out.

        Args:
            texts: Each once, however often it is stated.
        """
        self._stated |= dict.fromkeys(texts)

    def is_short(self, instants: EvaluatedInstants, interval: Interval) -> bool:
        """Whether an interval is too short to be evaluated, which is then stated."""
        if not instants.first.all():
            return False
        self.add(
            [f"interval {interval.label!r}: it ends within its first {OFFSET_S:g} s, after which it would be evaluated"]
        )
        return True

    def add_errors(self, what: str, interval: Interval, judged: Mapping[Offset, FloatArray]) -> None:
        """Look for gaps in an interval, or in the next part of one.

        Args:
            what: What is evaluated, in words.
            interval: The interval.
            judged: Errors with either offset; shape (m,) or (m, k); a sample with a NaN is not evaluated.
        """
        known = self._known.setdefault((what, interval.label), dict.fromkeys(judged, False))
        for offset, errors in judged.items():
            known[offset] |= not np.isnan(errors.reshape(len(errors), -1)).any(axis=1).all()

    def texts(self) -> tuple[str, ...]:
        """Give what was stated, then what gaps leave out; nothing of what can be evaluated with both offsets."""
        return (*self._stated, *dict.fromkeys(self._gaps()))

    def _gaps(self) -> Iterator[str]:
        for (what, label), known in self._known.items():
            if not known.get(Offset.FITTED, True):
                yield f"{what} over {label!r}: every evaluated sample has a gap"
            elif not all(known.values()):
                offset = Offset.FIRST_SECOND.value
                yield f"{what} over {label!r}, offset {offset}: every sample of its first second has a gap"
