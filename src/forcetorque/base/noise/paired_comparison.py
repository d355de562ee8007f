# SPDX-License-Identifier: BSD-3-Clause
"""Whether one calibration under test errs less than another, by the ratio of their errors over independent segments.

A ratio has the power that a difference lacks: errors grow and shrink with the load for both, and a calibration under
test that errs a third in every segment is better however unlike the segments are. Neighbouring samples repeat each
other where a limb moves slowly, so that segments are no more than the ratio is worth independent ones.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal, Protocol, Self

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray, require_shape
from forcetorque.base.errors import ShapeError
from forcetorque.base.noise.autocorrelation import autocorrelation
from forcetorque.base.rows_on_disk import in_blocks
from forcetorque.base.wrench import FORCE, FORCE_AND_MOMENT, MOMENT

CONFIDENCE = 0.95
"""Probability with which the interval holds the ratio: one side of it is passed by chance half as often as 1 in 20,
which leaves room for what neighbouring segments still have in common."""

ALIKE = (0.8, 1.25)
"""Ratios between which two calibrations under test are no different for any use."""

MOST_SEGMENTS = 10
"""Segments of one recording; more would add little to Student's t, and be short against slow errors."""

FEWEST_SEGMENTS = 3
"""Segments, of all recordings together, below which there is no interval."""

BLOCKS = 40
"""Blocks of a recording whose ratios show how long it repeats itself: four per segment, so that what lasts as long as a
segment is seen, and each long enough that fast noise, which hides slow errors, is averaged away."""

_OVERRATED = 7.0
"""The effective number k of a short signal is overrated, by some 4 where it is 5 to 30: `k^2 / (k + 7)` makes up for
it (a heuristic, by simulation of AR(1) processes)."""

_LEAST = 1e-9
"""Share of the larger error below which an error counts as this share: none has a logarithm."""

_WIDEST = 300.0
"""Half an interval of logarithms, beyond which its end is no number."""

Conclusion = Literal["better", "worse", "no difference", "inconclusive"]
"""What a comparison comes to: `no difference` is known to be small, `inconclusive` may be large."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ErrorRatio:
    """Error of the first calibration under test over that of the second, and what is known of it."""

    ratio: float
    """Geometric mean over the segments; below 1 where the first errs less."""
    low: float
    """Lower end of the 95 % interval; 0 where it is undetermined."""
    high: float
    """Upper end; infinity where it is undetermined."""
    segments: int
    """Number of independent segments, of all recordings."""
    conclusion: Conclusion
    """Of the first calibration under test: better or worse, no different, or not enough data."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PairedErrors:
    """Errors of two calibrations under test at the same n instants of one recording, in the order of time."""

    squares: FloatArray
    """Squared norms of the errors of the first and of the second, of force and moment; shape (2, 2, n); N2, N2 m2."""
    mean: FloatArray
    """Mean error of the first; shape (6,); N, N m; 0 without a sample."""

    @classmethod
    def of(cls, first: Any, second: Any, reference: Any) -> Self:
        """Take the errors of two calibrations under test; samples in which either is not finite are left out.

        Args:
            first: Wrenches by one calibration under test, in the order of time; shape (n, 6); N, N m.
            second: Wrenches by the other at the same instants; shape (n, 6); N, N m.
            reference: Wrenches that mechanics demands; shape (n, 6); N, N m.

        Returns:
            Their errors where both are finite.

        Raises:
            ShapeError: If the shapes are not these.
        """
        truth = np.asarray(reference, dtype=np.float64)
        require_shape(truth, name="reference", shape=(None, 6))
        wrenches = [np.asarray(given, dtype=np.float64) for given in (first, second)]
        for name, values in zip(("first", "second"), wrenches, strict=True):
            require_shape(values, name=name, shape=truth.shape)
        squares, total, count = [], np.zeros(6), 0
        for expected, *measured in in_blocks(truth, *wrenches):
            errors = [values - expected for values in measured]
            whole = np.isfinite(np.hstack(errors)).all(axis=1)
            errors = [error[whole] for error in errors]
            squares.append([[(error[:, axes] ** 2).sum(axis=1) for axes in FORCE_AND_MOMENT] for error in errors])
            total, count = total + errors[0].sum(axis=0), count + len(errors[0])
        return cls(squares=np.concatenate(squares, axis=2), mean=total / max(count, 1))

    @property
    def samples(self) -> int:
        """Number of samples."""
        return self.squares.shape[2]

    def of_quantity(self, axes: slice) -> SquaredErrors:
        """Give the squared norms of the errors of force or moment.

        Args:
            axes: `FORCE` or `MOMENT`.

        Returns:
            Them, a block per sample.
        """
        squares = self.squares[:, FORCE_AND_MOMENT.index(axes)]
        return SquaredErrors(ends=np.arange(1, self.samples + 1), sums=squares)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SquaredErrors:
    """Squared norms of the errors of two calibrations under test, summed over contiguous blocks of one recording."""

    ends: IntArray
    """Index behind the last sample of every block; shape (b,)."""
    sums: FloatArray
    """Sums of the squared norms over every block; shape (2, b)."""

    @property
    def samples(self) -> int:
        """Number of samples."""
        return int(self.ends[-1])

    def log_ratios(self, count: int, least: float) -> FloatArray:
        """Give the log ratios of root mean squares in contiguous parts of equally many samples, at most one each.

        Args:
            count: Number of parts; a block ends where a part does.
            least: Mean square below which an error counts as this.

        Returns:
            Log ratios; shape (count or n,).
        """
        ends = np.array(part_ends(self.samples, count))
        starts = np.concatenate([[0], np.searchsorted(self.ends, ends[:-1]) + 1])
        sizes = np.diff(ends, prepend=0)
        means = np.maximum(np.add.reduceat(self.sums, starts, axis=1) / sizes, least)
        return np.asarray(0.5 * np.log(means[0] / means[1]), dtype=np.float64)


class PairedBlocks(Protocol):
    """Errors of two calibrations under test in one recording, as samples or summed over blocks."""

    @property
    def samples(self) -> int:
        """Number of samples."""

    def of_quantity(self, axes: slice) -> SquaredErrors:
        """Give the squared norms of the errors of force or moment.

        Args:
            axes: `FORCE` or `MOMENT`.

        Returns:
            Them.
        """


@dataclass(frozen=True, slots=True, kw_only=True)
class PairedComparison:
    """Errors of one calibration under test against those of another in the same samples."""

    count: int
    """Number of samples."""
    force: ErrorRatio
    """Of the force errors."""
    moment: ErrorRatio
    """Of the moment errors."""


def compare_errors(recordings: Sequence[PairedBlocks]) -> PairedComparison:
    """Test whether one calibration under test errs less than another.

    A recording is cut into contiguous segments of equally many samples, as many as the log ratio of the errors is
    worth independent ones, at most ten; one that is too short, or never changes, is one segment. The root mean square
    errors of a segment have a log ratio, and these, of all recordings together, a mean and Student's interval. Its
    standard error is that of the segments, of the recordings as wholes, or by the autocorrelation of the ratio,
    whichever is the largest. `better` and `worse` need an interval beyond 1, and root mean square errors over all
    samples that agree with it; `no difference` needs an interval between .8 and 1.25.

    Error rates, by simulation of 2000 campaigns each with two calibrations under test of equal errors: `better` (and
    as often `worse`) is concluded in less than 5 % of them, whether errors are white or AR(1) processes with
    correlation times of a hundredth to a fifth of the recording, alone, over white noise of a third to three times
    their deviation, over a process or a constant that both have in common, and pooled over two and five recordings. A
    level that each recording draws for itself is no different from an improvement in that recording: if the log ratio
    of recordings scatters by .4 and far less within, `better` is concluded wrongly in some 15 % of campaigns of two
    recordings, 9 % of three, 6 % of five, 4 % of ten. Nor does any recording show what lasts longer than it.

    Of improvements by a third, over ten independent segments whose log ratio scatters by .4, 81 % are called `better`,
    and 88 % if these are ten recordings. Within one recording it has first to be found out that they are independent:
    97 % if errors forget themselves within a fiftieth of it, 87 % within three hundredths, but 47 % if the ratio keeps
    one value for each tenth of it. Of improvements by two thirds, 91 % where errors last for a tenth and 70 % where
    they last for a fifth of the recording.

    Args:
        recordings: Errors of every recording.

    Returns:
        Ratios of force and moment errors, with their intervals, and the conclusions.

    Raises:
        ShapeError: If no recording has a sample in which everything is finite.
    """
    whole = [recording for recording in recordings if recording.samples]
    if not whole:
        raise ShapeError("expected at least one sample in which everything is finite, got none")
    return PairedComparison(
        count=sum(recording.samples for recording in whole),
        force=_ratio(whole, FORCE),
        moment=_ratio(whole, MOMENT),
    )


def _ratio(recordings: Sequence[PairedBlocks], axes: slice) -> ErrorRatio:
    squares = [recording.of_quantity(axes) for recording in recordings]
    totals = np.sum([pair.sums.sum(axis=1) for pair in squares], axis=0)
    least = _LEAST**2 * float(totals.max()) / sum(pair.samples for pair in squares)
    if least == 0.0 or all(np.array_equal(*pair.sums) for pair in squares):
        count = sum(independent_segments(np.zeros(min(BLOCKS, pair.samples)))[0] for pair in squares)
        return ErrorRatio(ratio=1.0, low=1.0, high=1.0, segments=count, conclusion="no difference")
    segments, errors = [], []
    for pair in squares:
        count, error = independent_segments(pair.log_ratios(BLOCKS, least))
        segments.append(pair.log_ratios(count, least))
        errors.append(error)
    return ratio_over(segments, errors, pooled=0.5 * math.log(max(totals[0], least) / max(totals[1], least)))


def ratio_over(
    segments: Sequence[FloatArray], errors: Sequence[float], *, pooled: float, confidence: float = CONFIDENCE
) -> ErrorRatio:
    """Test log ratios over independent segments.

    Args:
        segments: Log ratio of the errors in every segment, recording by recording; shapes (k,).
        errors: Standard errors of their means by the autocorrelation within each recording; 0 where not known.
        pooled: Log ratio of the root mean square errors over all samples.
        confidence: Probability with which the interval is to hold the ratio; more than usual where several are tested.

    Returns:
        The ratio, its interval, and the conclusion.
    """
    logs = np.concatenate(segments)
    count, mean = len(logs), float(logs.mean())
    half = math.inf
    if count >= FEWEST_SEGMENTS:
        from scipy.special import stdtrit  # here because importing it takes longer than most commands

        half = float(stdtrit(count - 1, 0.5 + 0.5 * confidence)) * _standard_error(segments, errors, mean)
    low, high = mean - half, mean + half
    return ErrorRatio(
        ratio=math.exp(mean),
        low=math.exp(low) if half < _WIDEST else 0.0,
        high=math.exp(high) if half < _WIDEST else math.inf,
        segments=count,
        conclusion=_conclusion(low, high, pooled),
    )


def _conclusion(low: float, high: float, pooled: float) -> Conclusion:
    if high < 0.0 and pooled < 0.0:
        return "better"
    if low > 0.0 and pooled > 0.0:
        return "worse"
    alike = math.log(ALIKE[0]) <= low and high <= math.log(ALIKE[1])
    return "no difference" if alike else "inconclusive"


def _standard_error(segments: Sequence[FloatArray], errors: Sequence[float], mean: float) -> float:
    """Largest of three: by the scatter of all segments, of the recordings, and by the autocorrelation within these."""
    logs = np.concatenate(segments)
    count, recordings = len(logs), len(segments)
    scatter = float(logs.std(ddof=1)) / math.sqrt(count)
    within = math.hypot(*(len(log) * error for log, error in zip(segments, errors, strict=True))) / count
    between = 0.0
    if recordings > 1:
        apart = math.hypot(*(float((log - mean).sum()) for log in segments))
        between = math.sqrt(recordings / (recordings - 1)) * apart / count
    return max(scatter, within, between)


def independent_segments(blocks: FloatArray) -> tuple[int, float]:
    """Give how many independent segments a recording is worth, and the standard error of its mean log ratio.

    Args:
        blocks: Log ratios over contiguous blocks of it, in the order of time; shape (k,).

    Returns:
        The number, at most `MOST_STRETCHES`, and the standard error; 0 where nothing changes.
    """
    if np.ptp(blocks) < _LEAST:  # what never changes has been seen once
        return 1, 0.0
    effective = autocorrelation(blocks, np.arange(len(blocks), dtype=np.float64)).effective_count
    fewer = effective**2 / (effective + _OVERRATED)
    return min(max(round(fewer), 1), MOST_SEGMENTS), float(blocks.std(ddof=1)) / math.sqrt(fewer)


def part_ends(samples: int, count: int) -> list[int]:
    """Cut a recording into contiguous parts of equally many samples; the first parts have one more where it must be.

    Args:
        samples: Number of samples, at least 1.
        count: Number of parts; as many as there are samples where these are fewer.

    Returns:
        Index behind the last sample of every part.
    """
    size, longer = divmod(samples, min(count, samples))
    return [size * number + min(number, longer) for number in range(1, min(count, samples) + 1)]
