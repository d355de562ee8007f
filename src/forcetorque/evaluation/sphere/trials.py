# SPDX-License-Identifier: BSD-3-Clause
"""Several trials of one sensor: the plain mean of their indices, and the drift from one to another."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, read_only
from forcetorque.base.errors import ForceTorqueError
from forcetorque.evaluation.sphere.findings import EllipsoidFit
from forcetorque.evaluation.sphere.resampling import BLOCKS

_UPPER = 0.975
"""Quantile at the upper end of a 95 % interval."""
_JUDGED = 7
"""Numbers that a drift is told by: index, three intersections, three coordinates of the centre."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TrialMean:
    """Plain mean of the indices of trials, the `Average Std` of thesis Tables 4.3 and 4.4."""

    count: int
    """Number of trials."""
    mean: float
    """Their mean, in the unit of the indices."""
    low: float
    """Lower end of its 95 % interval from the scatter between trials, by Student's t, not below 0; 0 with one trial."""
    high: float
    """Upper end; infinite with one trial."""


def mean_of_trials(indices: Sequence[float]) -> TrialMean:
    """Average the indices of trials, each as much as the others.

    Args:
        indices: Performance indices; any unit.

    Returns:
        Their mean, with what it is worth.

    Raises:
        ForceTorqueError: If there is none, or one is no number.
    """
    from scipy.special import stdtrit  # here because importing it takes longer than most commands

    values = np.asarray(indices, dtype=np.float64)
    if values.ndim != 1 or not len(values) or not np.isfinite(values).all():
        raise ForceTorqueError(f"indices: expected at least one number, all finite, got {list(indices)}")
    mean, count = float(values.mean()), len(values)
    if count == 1:
        return TrialMean(count=1, mean=mean, low=0.0, high=np.inf)
    margin = float(stdtrit(count - 1, _UPPER) * values.std(ddof=1) / np.sqrt(count))
    return TrialMean(count=count, mean=mean, low=max(0.0, mean - margin), high=mean + margin)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Drift:
    """What changed from one fit to another, last minus first.

    Margins are for all seven numbers at once: where nothing changed, one trial in twenty has any number beyond its own.
    """

    index: float
    """Change of the index; N."""
    index_margin: float
    """Its margin; N."""
    intersections: FloatArray
    """Change of the axis intersections; shape (3,); N."""
    intersection_margin: FloatArray
    """Their margins; shape (3,); N."""
    centre: FloatArray
    """Change of the centre; shape (3,); N."""
    centre_margin: FloatArray
    """Its margins; shape (3,); N."""
    identifiable: bool
    """Whether both fits are: else nothing is said to have changed."""

    def __post_init__(self) -> None:
        for name in ("intersections", "intersection_margin", "centre", "centre_margin"):
            object.__setattr__(self, name, read_only(getattr(self, name), name=name, shape=(3,)))

    @property
    def index_exceeds(self) -> bool:
        """Whether the index changed by more than the intervals of both fits explain."""
        return self.identifiable and abs(self.index) > self.index_margin

    @property
    def intersections_exceed(self) -> BoolArray:
        """The same for each axis intersection; shape (3,)."""
        return self.identifiable & (np.abs(self.intersections) > self.intersection_margin)

    @property
    def centre_exceeds(self) -> BoolArray:
        """The same for the centre along each axis; shape (3,)."""
        return self.identifiable & (np.abs(self.centre) > self.centre_margin)


def drift_between(first: EllipsoidFit, last: EllipsoidFit) -> Drift | None:
    """Compare two trials.

    The margin of a difference has the halves of the two intervals that face each other as its sides, and is wider by
    what it takes for all seven numbers to be within theirs with 95 % where nothing changed.

    Args:
        first: Fit to the first trial.
        last: Fit to the last trial.

    Returns:
        The change; None where one has no ellipsoid.
    """
    if first.ellipsoid is None or last.ellipsoid is None:
        return None
    before, after = first.ellipsoid.axis_intersections, last.ellipsoid.axis_intersections
    index, index_margin = _change(
        [first.index], [last.index], [first.index_low], [first.index_high], [last.index_low], [last.index_high]
    )
    wider = _wider_together()
    change, margin = _change(before, after, first.low, first.high, last.low, last.high)
    return Drift(
        index=float(index[0]),
        index_margin=wider * float(index_margin[0]),
        intersections=change,
        intersection_margin=wider * margin,
        centre=last.ellipsoid.centre - first.ellipsoid.centre,
        centre_margin=wider * np.hypot(first.centre_margin, last.centre_margin),
        identifiable=first.identifiable and last.identifiable,
    )


def _wider_together() -> float:
    """How much wider margins are that hold for all judged numbers at once with 95 %, by Bonferroni: 1.5."""
    from scipy.special import stdtrit  # here because importing it takes longer than most commands

    return float(stdtrit(BLOCKS - 1, 1.0 - (1.0 - _UPPER) / _JUDGED) / stdtrit(BLOCKS - 1, _UPPER))


def _change(
    first: Sequence[float] | FloatArray,
    last: Sequence[float] | FloatArray,
    first_low: Sequence[float] | FloatArray,
    first_high: Sequence[float] | FloatArray,
    last_low: Sequence[float] | FloatArray,
    last_high: Sequence[float] | FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """Differences, and the margins on the sides that face each other."""
    a, b = np.asarray(first), np.asarray(last)
    change = b - a
    up = np.hypot(np.asarray(first_high) - a, b - np.asarray(last_low))
    down = np.hypot(a - np.asarray(first_low), np.asarray(last_high) - b)
    return change, np.where(change >= 0.0, up, down)
