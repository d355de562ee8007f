# SPDX-License-Identifier: BSD-3-Clause
"""Forces and moments of all rows, axis after axis, each over the size of its noise."""

from __future__ import annotations

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.loads.expected import instants
from forcetorque.loads.mixture import Estimate
from forcetorque.loads.rows import LoadRows
from forcetorque.loads.stacked import Group
from forcetorque.noise import Timeline
from forcetorque.spatial import FORCE_AND_MOMENT

_LEAST_SIZE = 0.1
"""Noise of an axis counts as at least this part of that of the noisiest: three axes do not tell it from few rows."""


def groups_of(
    rows: LoadRows, design: FloatArray, values: FloatArray, sizes: FloatArray, weight: FloatArray
) -> tuple[Group, Group]:
    """Stack forces and moments.

    Args:
        rows: The rows.
        design: Change with every unknown; shape (n, 6, p).
        values: Reading less what is expected; shape (n, 6).
        sizes: Size of the noise of each axis; shape (6,).
        weight: What each row counts; shape (n,).

    Returns:
        Forces, and moments.
    """
    sorted_rows = np.argsort(rows.session, kind="stable")
    time = instants(rows)[sorted_rows]
    steps = np.diff(time)[np.diff(rows.session[sorted_rows]) == 0]
    unit = float(np.median(steps[steps > 0.0])) if (steps > 0.0).any() else 1.0
    count = len(rows)
    line = Timeline.of(
        np.tile(time / unit, 3),
        np.repeat(np.arange(3), count) * (int(rows.session.max(initial=0)) + 1) + np.tile(rows.session[sorted_rows], 3),
        np.tile((rows.share * weight)[sorted_rows], 3),
    )
    forces, moments = (
        Group(
            line=line,
            design=(design[sorted_rows][:, axes].transpose(1, 0, 2) / sizes[axes][:, None, None]).reshape(
                3 * count, design.shape[2]
            ),
            values=(values[sorted_rows][:, axes].T / sizes[axes][:, None]).reshape(3 * count),
            order=np.tile(sorted_rows, 3),
        )
        for axes in (np.arange(3), np.arange(3, 6))
    )
    return forces, moments


def noise_sizes(residual: FloatArray) -> FloatArray:
    """Give the size of the noise of each axis, forces and moments apart.

    Args:
        residual: Residuals; shape (n, 6); N, N m.

    Returns:
        Shape (6,); N, N m; those of exact rows are 1.
    """
    size = np.sqrt((residual**2).mean(axis=0)) if len(residual) else np.ones(6)
    for axes in FORCE_AND_MOMENT:
        largest = float(size[axes].max())
        size[axes] = np.maximum(size[axes], _LEAST_SIZE * largest) if largest > 0.0 else 1.0
    return size


def sizes_under(groups: tuple[Group, Group], estimate: Estimate, sizes: FloatArray, rounding: FloatArray) -> FloatArray:
    """Give the size of the noise of each axis as it is where slow noise counts as little as it is worth.

    Args:
        groups: Forces and moments, with what is left as values.
        estimate: Shape of the noise.
        sizes: Sizes that the groups are over; shape (6,); N, N m.
        rounding: Noise that exact rows have of rounding; shape (6,); N, N m.

    Returns:
        Shape (6,); N, N m.
    """
    squares = []
    for group, noise in zip(groups, estimate.shapes, strict=True):
        solved, _ = group.line.solve(group.values[:, None], noise)
        squares.append((group.values * solved[:, 0]).reshape(3, -1).mean(axis=1))
    return noise_sizes(np.hypot(np.sqrt(np.maximum(np.concatenate(squares), 0.0)) * sizes, rounding)[None])
