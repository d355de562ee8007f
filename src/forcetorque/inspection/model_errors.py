# SPDX-License-Identifier: BSD-3-Clause
"""What errors of the robot model and of the matrix leave of a residual where the expected wrench moves.

Such errors are the same whenever the limb comes to the same load; a contact or a step of the sensor is not. So the
residual of one interval is predicted, linear in the expected wrench, from the rest of the log, and only where the rest
of the log has such loads.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, IntArray, array
from forcetorque.base.units import MAD_TO_DEVIATION
from forcetorque.base.wrench import FORCE_AND_MOMENT

_USUAL, _LARGEST = (0.2, 0.005, 0.0), (0.5, 0.02, 5.0)
"""Residual that errors of the model may leave, as a share of the movement of the expected wrench, as moment per force
that moves (m), and as force per moment (1/m): of any robot model and matrix, and where the rest of the log predicts it.
Heuristics."""
_MOST, _FEWEST = 2000, 40
"""Samples that a prediction is fitted to, evenly over the log: how many at most, and at least."""
_BEYOND = 0.2
"""Share of the range of a component by which loads may lie beyond those of the rest of the log."""
_WITH_TIME = 0.8
"""Share of time that the expected wrench explains, from which on the load moves with time alone."""
_ROUNDS = 4
"""How often the weights of the fit follow its residual."""
_TAIL = 3.0
"""Residual, in robust standard deviations, from which on a sample counts less."""


@dataclass(frozen=True, kw_only=True, eq=False)
class ModelErrors(ArrayRecord):
    """Residual and expected wrench of a log, to predict the one from the other."""

    residual: FloatArray = field(metadata=array("n", 6))
    """Residual without vibration; shape (n, 6); N, N m."""
    expected: FloatArray = field(metadata=array("n", 6))
    """Expected wrench; shape (n, 6); N, N m."""
    usable: BoolArray = field(metadata=array("n", dtype="bool"))
    """Samples in which nothing is known to touch the limb; shape (n,)."""

    def explain_level(
        self,
        first: int,
        last: int,
        size_of: Callable[[FloatArray], FloatArray],
        limit: FloatArray,
        *,
        axes: slice,
        is_moment: bool,
        margin: int,
        shortest: int,
    ) -> bool:
        """Decide whether the residual of an interval is no more than errors of the model.

        Args:
            first: First sample of the interval.
            last: Last sample of the interval.
            size_of: What counts of residuals of shape (m, 6); shape (m,); N, N m.
            limit: Size from which on it counts; shape (m,); N, N m.
            axes: Components that `size_of` depends on.
            is_moment: Whether that is a moment.
            margin: Samples before and after the interval that are no part of the rest of the log.
            shortest: Number of samples from which on they are an interval.

        Returns:
            Whether any model may leave as much, or the rest of the log predicts it.
        """
        own = slice(first, last + 1)
        size = np.abs(size_of(self.residual[own]))
        change = self.expected[own] - self._usual_load
        if (size < _tolerance(change, _USUAL, is_moment=is_moment)).all():
            return True
        predicted = self._predicted(first, last, margin, axes)
        if predicted is None:
            return False
        left = np.abs(size_of(self.residual[own] - predicted))
        beyond = (left > limit) | (size > _tolerance(change, _LARGEST, is_moment=is_moment))
        return int(np.count_nonzero(beyond)) < shortest

    def explain_step(self, size: float, axis: int, before: slice, after: slice, limit: float) -> bool:
        """Decide whether a step of the residual is no more than errors of the model, since the joints move.

        Args:
            size: The step; N, N m.
            axis: Component of the wrench.
            before: Samples before the step.
            after: Samples after the step, later than those before.
            limit: Size from which on a step counts; N, N m.

        Returns:
            Whether any model may leave as much, or the rest of the log predicts it.
        """
        change = (self.expected[after].mean(axis=0) - self.expected[before].mean(axis=0))[None]
        if abs(size) < _tolerance(change, _USUAL, is_moment=axis >= 3)[0]:
            return True
        if abs(size) > _tolerance(change, _LARGEST, is_moment=axis >= 3)[0]:
            return False
        predicted = self._predicted(before.start, after.stop - 1, 0, slice(axis, axis + 1))
        if predicted is None:
            return False
        levels = [predicted[own.start - before.start : own.stop - before.start, axis].mean() for own in (before, after)]
        return bool(abs(size - (levels[1] - levels[0])) < limit)

    def beside_load(self) -> FloatArray:
        """Take out of the residual what follows the expected wrench over the whole log.

        A residual that follows the load as well as the time is taken out where the load moves with time alone.

        Returns:
            The rest, for slow changes; shape (n, 6); N, N m.
        """
        rows = np.flatnonzero(self.usable)
        rows = _thinned(rows)
        loads = self.expected[rows]
        middle, size = loads.mean(axis=0), np.maximum(np.ptp(loads, axis=0), np.finfo(float).tiny)
        design = _design(loads, middle, size)
        time = (rows - rows.mean()) / len(self.expected)
        left = time - design @ np.linalg.lstsq(design, time)[0]
        columns = np.column_stack([design, time]) if left @ left > (1.0 - _WITH_TIME) * (time @ time) else design
        coefficients = _robust_fit(columns, self.residual[rows])[: design.shape[1]]
        return self.residual - _design(self.expected, middle, size) @ coefficients

    @cached_property
    def _usual_load(self) -> FloatArray:
        """Median of the expected wrench over the usable samples; shape (6,); N, N m."""
        return np.asarray(np.median(self.expected[self.usable], axis=0))

    def _predicted(self, first: int, last: int, margin: int, axes: slice) -> FloatArray | None:
        """Residual of an interval by the rest of the log, in `axes` alone; None where that has no such loads."""
        rest = np.array(self.usable)
        rest[max(0, first - margin) : last + margin + 1] = False
        rows = np.flatnonzero(rest)
        if len(rows) < _FEWEST:
            return None
        rows = _thinned(rows)
        loads, own = self.expected[rows], self.expected[first : last + 1]
        low, high = loads.min(axis=0), loads.max(axis=0)
        reach = _BEYOND * (high - low)
        if (own < low - reach).any() or (own > high + reach).any():
            return None
        middle, size = loads.mean(axis=0), np.maximum(high - low, np.finfo(float).tiny)
        predicted = np.zeros_like(own)
        coefficients = _robust_fit(_design(loads, middle, size), self.residual[rows, axes])
        predicted[:, axes] = _design(own, middle, size) @ coefficients
        return predicted


def _thinned(rows: IntArray) -> IntArray:
    """At most `_MOST` of them, evenly."""
    return rows[np.unique(np.linspace(0, len(rows) - 1, min(_MOST, len(rows))).round().astype(np.int64))]


def _tolerance(change: FloatArray, shares: tuple[float, float, float], *, is_moment: bool) -> FloatArray:
    """What errors of the model may leave where the expected wrench moves by `change`; shape (n,); N or N m."""
    share, moment_per_force, force_per_moment = shares
    force, moment = (np.linalg.norm(change[:, own], axis=1) for own in FORCE_AND_MOMENT)
    if is_moment:
        return np.asarray(share * moment + moment_per_force * force)
    return np.asarray(share * force + force_per_moment * moment)


def _design(loads: FloatArray, middle: FloatArray, size: FloatArray) -> FloatArray:
    return np.column_stack([(loads - middle) / size, np.ones(len(loads))])


def _robust_fit(design: FloatArray, residual: FloatArray) -> FloatArray:
    """Linear fit in which far samples count less, component by component; shape (k, 6)."""
    weights = np.ones_like(residual)
    coefficients = np.zeros((design.shape[1], residual.shape[1]))
    for _ in range(_ROUNDS):
        for axis in range(residual.shape[1]):
            root = np.sqrt(weights[:, axis])
            coefficients[:, axis] = np.linalg.lstsq(root[:, None] * design, root * residual[:, axis])[0]
        left = residual - design @ coefficients
        deviation = MAD_TO_DEVIATION * np.median(np.abs(left), axis=0) + np.finfo(float).tiny
        weights = 1.0 / (1.0 + (left / (_TAIL * deviation)) ** 2)
    return coefficients
