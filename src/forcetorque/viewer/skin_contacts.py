# SPDX-License-Identifier: BSD-3-Clause
"""Contacts on skin as arrays of a scene, with what one standard deviation of a force is."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.viewer.block import Block
from forcetorque.viewer.scene import SkinContactFrames


def contact_frames(
    block: Block,
    *,
    time_s: FloatArray,
    hold_s: float,
    places: Sequence[FloatArray],
    forces: Sequence[FloatArray],
    identities: Sequence[IntArray],
    covariances: Sequence[FloatArray] | None = None,
) -> SkinContactFrames:
    """Put the contacts of k frames into the block of a scene.

    Args:
        block: Takes the arrays.
        time_s: Start of each frame; shape (k,); s.
        hold_s: How long a frame is shown; s.
        places: Centres of pressure in each frame; shape (c, 3); m.
        forces: What the contacts do to the link, or a heuristic of it; shape (c, 3).
        identities: Numbers that contacts keep; shape (c,).
        covariances: Covariances of the forces; shape (c, 3, 3); N^2; None where nobody knows them.

    Returns:
        Where the arrays are.
    """
    first = np.concatenate([[0], np.cumsum([len(place) for place in places])])
    spread = None if covariances is None else half_axes(np.concatenate([np.zeros((0, 3, 3)), *covariances]))
    return SkinContactFrames(
        time_s=block.add(time_s, "float64"),
        hold_s=hold_s,
        first=block.add(first, "uint32"),
        place=block.add(np.concatenate([np.zeros((0, 3)), *places]), "float32"),
        force=block.add(np.concatenate([np.zeros((0, 3)), *forces]), "float32"),
        spread=None if spread is None else block.add(spread.reshape(-1, 9), "float32"),
        identity=block.add(np.concatenate([np.zeros(0, dtype=np.int64), *identities]), "uint32"),
    )


def half_axes(covariances: FloatArray) -> FloatArray:
    """Give the half axes of the ellipsoids of one standard deviation.

    Args:
        covariances: Covariances; shape (m, 3, 3); NaN where unknown.

    Returns:
        Matrices A whose columns are the half axes, A A^T = covariance; shape (m, 3, 3).
    """
    known = np.isfinite(covariances).all(axis=(1, 2))
    axes = np.full(covariances.shape, np.nan)
    variances, directions = np.linalg.eigh(covariances[known])
    axes[known] = directions * np.sqrt(np.maximum(variances, 0.0))[:, None, :]
    return axes
