# SPDX-License-Identifier: BSD-3-Clause
"""What data that were not fitted say of a use: errors in means of a second, their constant part and the rest.

The sensor has one offset in a session, so a mean is that of a session: between two recordings of one session the
load moves, and what a wrong matrix makes of that shows; between two sessions the offset would take it up.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.noise import mean_error, means_over, one_after_another
from forcetorque.spatial import FORCE_AND_MOMENT


@dataclass(frozen=True, slots=True, kw_only=True)
class MeasuredError:
    """Error of one quantity, force or moment, on judged data."""

    constant: float
    """Norm of the mean error in the session in which it is largest; N or N m."""
    constant_at_least: float
    """What is left of a mean error, at most, when the half-width of its 95 % interval is taken off."""
    rest: float
    """Root mean square of what is left without the means; N or N m."""
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
    """The reference about its mean in each session; shape (n, 6); N, N m."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class JudgedStretch:
    """What one candidate measured in a recording, or in as much of it as belongs to one session."""

    session: str
    """Name of the session."""
    time_s: FloatArray
    """Instants, not falling; shape (n,); s."""
    measured: FloatArray
    """What was measured; shape (n, 6); N, N m."""
    reference: FloatArray
    """What mechanics demands; shape (n, 6); N, N m."""


def evidence(stretches: Sequence[JudgedStretch]) -> Evidence:
    """Sum up the errors of one candidate in any number of recordings.

    Args:
        stretches: What it measured in each, at least one.

    Returns:
        The errors. The constant part is that of the session in which it is largest: of two that cancel each other
        either would hurt. What is left is about the mean of each session.
    """
    instants, errors, references = [], [], []
    in_session = sorted(stretches, key=lambda stretch: stretch.session)
    for _, session in groupby(in_session, key=lambda stretch: stretch.session):
        means = [means_over(one.time_s, np.hstack([one.measured - one.reference, one.reference])) for one in session]
        instants.append(one_after_another([time for time, _, _ in means]))
        columns = np.concatenate([columns for _, columns, _ in means])
        errors.append(columns[:, :6])
        references.append(columns[:, 6:])
    line = one_after_another(instants)
    left, moved = (np.concatenate([own - own.mean(axis=0) for own in parts]) for parts in (errors, references))
    squares = np.column_stack([(left[:, part] ** 2).sum(axis=1) for part in FORCE_AND_MOMENT])
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
        for k, part in enumerate(FORCE_AND_MOMENT)
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
