# SPDX-License-Identifier: BSD-3-Clause
"""How much of all directions a cloud covers, seen from a point."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

import numpy as np

from forcetorque.arrays import FloatArray

if TYPE_CHECKING:
    from scipy.spatial import cKDTree

CELLS = 200
"""Parts, all alike, into which the directions are divided: some 16 degrees across."""


def share_of_directions(cloud: FloatArray, centre: FloatArray) -> float:
    """Find the share of all directions in which there is a point.

    Args:
        cloud: Points; shape (n, 3).
        centre: Where they are looked at from; shape (3,).

    Returns:
        Share of equal parts of the sphere of directions with at least one point, those at the edge counted whole;
        from 0 to 1.
    """
    away = cloud - centre
    length = np.linalg.norm(away, axis=1)
    directions = away[length > 0.0] / length[length > 0.0, None]
    if not len(directions):
        return 0.0
    _, nearest = _cells().query(directions)
    return len(np.unique(nearest)) / CELLS


@cache
def _cells() -> cKDTree:
    """Middles of the parts: a spiral from pole to pole by the golden angle."""
    from scipy.spatial import cKDTree  # here because importing it takes longer than most commands

    index = np.arange(CELLS) + 0.5
    z = 1.0 - 2.0 * index / CELLS
    turn = np.pi * (3.0 - np.sqrt(5.0)) * index
    across = np.sqrt(1.0 - z**2)
    return cKDTree(np.column_stack([across * np.cos(turn), across * np.sin(turn), z]))
