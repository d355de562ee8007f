# SPDX-License-Identifier: BSD-3-Clause
"""A jump of the bias within a session, as a sensor makes it that was zeroed or switched off in between."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.loads.fit import Fit
from forcetorque.noise import SlowNoise

_FALSE_ALARMS = 1e-3
"""Share of problems without a jump in which one is named."""
_PLACES = 400
"""Places at which a jump is looked for, at most; a jump is a row or two off then, in long recordings."""
_LEAST_LEFT = 1e-3
"""A step of which the fit leaves less than this part cannot be told from bias, drift and load."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Jump:
    """Where the bias jumps."""

    row: int
    """The first row after it."""
    axis: int
    """Component in which it shows most."""
    deviations: float
    """How many standard deviations of chance it is."""


def strongest_jump(fitted: Fit) -> Jump | None:
    """Look for a step of one axis at every row.

    Args:
        fitted: The fit.

    Returns:
        The strongest step, if chance hardly makes it.
    """
    from scipy.special import ndtri  # here because importing it takes longer than most commands

    rows = fitted.problem.rows
    basis, covariance = fitted.directions.basis, fitted.estimate.covariance
    best, tried = Jump(row=0, axis=0, deviations=0.0), 0
    pairs = zip(fitted.groups, fitted.estimate.shapes, fitted.estimate.variances, strict=True)
    for number, (group, noise, variance) in enumerate(pairs):
        known = group.line.solve(group.design @ basis, noise)[0] / variance
        left = group.line.solve(group.values[:, None], noise)[0][:, 0] / variance
        for axis in range(3):
            for session in np.unique(rows.session):
                mine = np.flatnonzero(rows.session[group.order[: len(rows)]] == session)
                block = axis * len(rows) + mine
                after = _places(len(mine))
                tried += len(after)
                steps = (np.arange(len(mine))[:, None] >= after).astype(np.float64)
                worth = _worth(fitted, number, block, steps, noise) / variance
                seen = steps.T @ known[block]
                own = worth - np.einsum("kr,rs,ks->k", seen, covariance, seen)
                told_apart = own > _LEAST_LEFT * worth
                strength = np.where(
                    told_apart, np.abs(steps.T @ left[block]) / np.sqrt(np.where(told_apart, own, 1.0)), 0.0
                )
                if len(strength) and strength.max() > best.deviations:
                    k = int(strength.argmax())
                    row = int(group.order[mine[after[k]]])
                    best = Jump(row=row, axis=3 * number + axis, deviations=float(strength[k]))
    limit = -float(ndtri(0.5 * _FALSE_ALARMS / max(tried, 1)))
    return best if best.deviations > limit else None


def _places(count: int) -> np.ndarray:
    """Rows before which a step may be: not the first and last two, which any row that disagrees would be."""
    places = np.arange(3, count - 2)
    return places[:: max(1, len(places) // _PLACES)]


def _worth(fitted: Fit, number: int, block: np.ndarray, steps: FloatArray, noise: SlowNoise) -> FloatArray:
    """`s' V^-1 s` of steps within one axis of one session; shape (k,)."""
    line = fitted.groups[number].line
    part = type(line).of(line.time_s[block], share=line.share[block])
    worth: FloatArray = (steps * part.solve(steps, noise)[0]).sum(axis=0)
    return worth
