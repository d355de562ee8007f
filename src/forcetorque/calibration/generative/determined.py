# SPDX-License-Identifier: BSD-3-Clause
"""Refusals: loads that do not tell a matrix that nobody knows, and data by which a sensor has lost a direction."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import FitError
from forcetorque.spatial import FORCE_AND_MOMENT, WRENCH_COMPONENTS

_RANK = 1e-6
"""Share of the largest change of load below which a direction does not move."""
_UNKNOWN = 0.5
"""Share of its response that the standard deviation of it may be, where no prior helps."""
_LEAST_GAIN = 0.3
"""Least singular value of measured over prior response; mounting takes up to half of it, not more."""


def unmoved_directions(wrench: FloatArray, lengths: Sequence[int]) -> tuple[str, ...]:
    """Name the directions that loads do not move.

    Args:
        wrench: Loads of all stretches; shape (n, 6); N, N m.
        lengths: Number of means in each stretch.

    Returns:
        Directions such as `fz`; none where the loads have rank 6.
    """
    parts = np.split(wrench, np.cumsum(lengths)[:-1])
    moved = np.concatenate([part - part.mean(axis=0) for part in parts])
    size = _load_sizes(moved)
    _, strengths, directions = np.linalg.svd(np.vstack([moved / size, np.zeros((6, 6))]), full_matrices=False)
    return tuple(direction_words(direction / size) for direction in directions[strengths < _RANK * strengths[0]])


def require_rank(wrench: FloatArray, lengths: Sequence[int]) -> None:
    """Refuse loads that do not move all six directions.

    Args:
        wrench: Loads of all stretches; shape (n, 6); N, N m.
        lengths: Number of means in each stretch.

    Raises:
        FitError: If a direction does not move; the message names it.
    """
    if weak := unmoved_directions(wrench, lengths):
        raise FitError(
            f"the loads move {6 - len(weak)} of 6 directions, not {'; '.join(weak)}; without a prior matrix all six "
            "are needed: give prior, or record a load with its centre of mass elsewhere"
        )


def require_response(response: FloatArray, covariance: FloatArray, wrench: FloatArray) -> None:
    """Refuse a matrix that is not known by half in some direction of load.

    Args:
        response: Response of every row to loads; shape (rows, 6).
        covariance: Its covariance; shape (rows, 6, 6).
        wrench: Loads, in whose sizes the direction is told; shape (n, 6); N, N m.

    Raises:
        FitError: If a direction is not known; the message names it.
    """
    inverse_root = np.linalg.inv(np.linalg.cholesky(response.T @ response))
    total = covariance.sum(axis=0)
    if np.linalg.eigvalsh(inverse_root @ total @ inverse_root.T)[-1] > _UNKNOWN**2:
        # the ratio is largest where a wild response to one load cancels that to others, so it does not name the load
        size = _load_sizes(wrench)
        # said as what hardly changes from load to load, which `unmoved_directions` says too
        least_known = np.linalg.eigh(total * np.outer(size, size))[1][:, -1] / size
        raise FitError(
            f"the loads hardly move {direction_words(least_known)}, the response to it is not known by half; without a "
            "prior matrix all six directions are needed: give prior, or record a load with its centre of mass elsewhere"
        )


def require_sensor(response: FloatArray) -> None:
    """Refuse data by which a sensor would hardly answer to some load that its prior says it answers to.

    Args:
        response: Measured over prior response, in units of the size of every row; shape (6, 6).

    Raises:
        FitError: If it is so.
    """
    _, strengths, directions = np.linalg.svd(response)
    if strengths[-1] < _LEAST_GAIN:
        raise FitError(
            f"by the data the sensor answers to {direction_words(directions[-1])} with {strengths[-1]:.2f} of what its "
            "prior says; mounting does not do that: check prior and serial, the masses of the model, measure_direction "
            "and the support"
        )


def _load_sizes(wrench: FloatArray) -> FloatArray:
    """Spread of forces and of moments, to compare both; shape (6,); N, N m."""
    moved = wrench - wrench.mean(axis=0)
    return np.repeat([max(float(moved[:, part].std()), 1e-12) for part in FORCE_AND_MOMENT], 3)


def direction_words(load: FloatArray) -> str:
    """Name a direction of load by its largest components.

    Args:
        load: The direction; shape (6,).

    Returns:
        Words such as `fx - 0.12 ty`.
    """
    scaled = load / np.abs(load).max()
    names = [(float(value), name) for value, name in zip(scaled, WRENCH_COMPONENTS, strict=True) if abs(value) > 0.05]
    sign = -1.0 if names[0][0] < 0.0 else 1.0
    words = [
        f"{'- ' if sign * value < 0.0 else '+ '}{'' if abs(value) > 0.995 else f'{abs(value):.2g} '}{name}"
        for value, name in names
    ]
    return " ".join(words).removeprefix("+ ")
