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


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Evidence:
    """What one candidate measured on judged data, against what mechanics demands there."""

    force: MeasuredError
    """Of the force; N."""
    moment: MeasuredError
    """Of the moment; N m."""
    reference: FloatArray
    """The reference, in means of a second; shape (n, 6); N, N m."""
    moved: FloatArray
    """The reference about its mean in each recording; shape (n, 6); N, N m."""


def evidence(recordings: Sequence[tuple[FloatArray, FloatArray, FloatArray]]) -> Evidence:
    """Sum up the errors of one candidate in any number of recordings.

    Args:
        recordings: Of each the instants, not falling, shape (n,), s; the wrenches that it measured, shape (n, 6); and
            those that mechanics demands, shape (n, 6); N, N m.

    Returns:
        The errors. The constant part is that of the recording in which it is largest: of two that cancel each other
        either would hurt. What is left is about the mean of each recording.
    """
    instants, errors, references = [], [], []
    for time_s, measured, reference in recordings:
        time, columns, _ = means_over(time_s, np.hstack([measured - reference, reference]))
        instants.append(time)
        errors.append(columns[:, :6])
        references.append(columns[:, 6:])
    line = one_after_another(instants)
    left, moved = (np.concatenate([own - own.mean(axis=0) for own in parts]) for parts in (errors, references))
    squares = np.column_stack([(left[:, part] ** 2).sum(axis=1) for part in _PARTS])
    widths = mean_error(squares, line).half_width
    constants = [
        (own.mean(axis=0), mean_error(own, time).half_width) for time, own in zip(instants, errors, strict=True)
    ]
    force, moment = (
        _measured(
            [(float(np.linalg.norm(mean[part])), float(np.linalg.norm(width[part]))) for mean, width in constants],
            squares[:, k],
            float(widths[k]),
        )
        for k, part in enumerate(_PARTS)
    )
    return Evidence(
        force=force,
        moment=moment,
        reference=np.concatenate(references),
        moved=moved,
    )


def _measured(constants: Sequence[tuple[float, float]], square: FloatArray, square_half_width: float) -> MeasuredError:
    rest = float(square.mean())
    least = rest - square_half_width
    return MeasuredError(
        constant=max(size for size, _ in constants),
        constant_at_least=max(max(size - half_width, 0.0) for size, half_width in constants),
        rest=float(np.sqrt(rest)),
        rest_at_least=float(np.sqrt(least)) if least > 0.0 else 0.0,
    )
