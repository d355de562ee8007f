# SPDX-License-Identifier: BSD-3-Clause
"""What data that were not fitted say of a use: errors in means of a second, their constant part and the rest."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.noise import mean_error, means_over, one_after_another

_PARTS = (slice(0, 3), slice(3, 6))


@dataclass(frozen=True, slots=True, kw_only=True)
class MeasuredError:
    """Error of one quantity, force or moment, on judged data."""

    constant: float
    """Norm of the mean error; N or N m."""
    constant_at_least: float
    """What is left of it when the half-width of its 95 % interval is taken off."""
    rest: float
    """Root mean square of what is left without the mean; N or N m."""
    rest_at_least: float
    """Lower end of its 95 % interval; 0 where the data are too few to tell."""

    @property
    def total(self) -> float:
        """Root mean square error."""
        return float(np.hypot(self.constant, self.rest))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Evidence:
    """What one candidate measured on judged data, against what mechanics demands there."""

    force: MeasuredError
    """Of the force; N."""
    moment: MeasuredError
    """Of the moment; N m."""
    reference: FloatArray
    """The reference, in means of a second; shape (n, 6); N, N m."""
    samples: int
    """Number of judged samples."""


def evidence(recordings: Sequence[tuple[FloatArray, FloatArray, FloatArray]]) -> Evidence:
    """Sum up the errors of one candidate in any number of recordings.

    Args:
        recordings: Of each the instants, not falling, shape (n,), s; the wrenches that it measured, shape (n, 6); and
            those that mechanics demands, shape (n, 6); N, N m.

    Returns:
        The errors. The mean is taken over all recordings, what is left is about the mean of each.
    """
    instants, errors, references = [], [], []
    for time_s, measured, reference in recordings:
        time, columns, _ = means_over(time_s, np.hstack([measured - reference, reference]))
        instants.append(time)
        errors.append(columns[:, :6])
        references.append(columns[:, 6:])
    line = one_after_another(instants)
    error, wanted = np.concatenate(errors), np.concatenate(references)
    left = np.concatenate([own - own.mean(axis=0) for own in errors])
    squares = np.column_stack([(left[:, part] ** 2).sum(axis=1) for part in _PARTS])
    known = mean_error(np.hstack([error, squares]), line).half_width
    force, moment = (
        _measured(error[:, part], known[part], squares[:, k], float(known[6 + k])) for k, part in enumerate(_PARTS)
    )
    samples = sum(len(time_s) for time_s, _, _ in recordings)
    return Evidence(force=force, moment=moment, reference=wanted, samples=samples)


def _measured(error: FloatArray, half_width: FloatArray, square: FloatArray, square_half_width: float) -> MeasuredError:
    constant, rest = float(np.linalg.norm(error.mean(axis=0))), float(square.mean())
    least = rest - square_half_width
    return MeasuredError(
        constant=constant,
        constant_at_least=max(constant - float(np.linalg.norm(half_width)), 0.0),
        rest=float(np.sqrt(rest)),
        rest_at_least=float(np.sqrt(least)) if least > 0.0 else 0.0,
    )
