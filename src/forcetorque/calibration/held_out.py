# SPDX-License-Identifier: BSD-3-Clause
"""Lambda chosen on held-out blocks of the fitted data, and block-wise uncertainty.

A slow motion has a few independent postures, not thousands of samples. Its blocks are contiguous
stretches of time. Each block ALONE is fitted and judged, with its own offset, on all the others:
that asks what a validation will ask, whether a fit on few postures holds on others. (Leaving one
block out asks the reverse, whether a fit on nearly everything holds in between, and trusts the data
too much.) The prior, with the offset of the same block, is judged likewise.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.calibration.fit import solve_matrix
from forcetorque.calibration.moments import Moments, pooled
from forcetorque.errors import FitError

RULE = (
    "each block of the fitted data alone is fitted and judged on all other blocks; of the lambdas with which no "
    "block's held-out mean squared error exceeds that of the prior, the one with the smallest mean; "
    "where there is none, the prior is kept"
)
"""The rule by which lambda is chosen."""

BLOCKS = 5
"""Least number of blocks in which the fitted data are divided."""

_DECADES_BELOW, _DECADES_ABOVE, _PER_DECADE = 8, 3, 4


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LambdaCurve:
    """Held-out error of every candidate lambda, and the choice."""

    regularisations: FloatArray
    """Candidates, rising, the last infinite: the prior; shape (k,); counts2."""
    held_out_error: FloatArray
    """Root mean square held-out wrench error, 1 N counted like 1 N m; shape (k,)."""
    worst_ratio: FloatArray
    """Largest ratio, over the blocks, of held-out mean squared error to that of the prior; shape (k,)."""
    chosen: float
    """Lambda that the rule takes; infinite where the prior is kept."""

    def __post_init__(self) -> None:
        for field in ("regularisations", "held_out_error", "worst_ratio"):
            object.__setattr__(self, field, read_only(getattr(self, field), name=field, shape=(None,)))


def candidate_lambdas(moments: Moments) -> FloatArray:
    """Spread candidates over all scales of the data, so that one grid serves every sensor.

    Args:
        moments: Moments of the fitted samples.

    Returns:
        Four per decade from 1e-8 to 1e3 times the largest eigenvalue of the raw second moment, then
        infinity; shape (k,); counts2.

    Raises:
        FitError: If the raw readings do not change at all.
    """
    largest = float(np.linalg.eigvalsh(moments.raw_raw)[-1])
    if not largest > 0.0:
        raise FitError("the raw readings do not change over the fitted data; expected motion of the limb")
    steps = (_DECADES_BELOW + _DECADES_ABOVE) * _PER_DECADE + 1
    finite = largest * np.logspace(-_DECADES_BELOW, _DECADES_ABOVE, steps)
    return np.append(finite, np.inf)


def choose_lambda(blocks: Sequence[Moments], prior: FloatArray) -> LambdaCurve:
    """Choose lambda by `RULE`.

    Args:
        blocks: Moments of contiguous stretches of the fitted data, at least two.
        prior: Matrix to stay close to; shape (6, c).

    Returns:
        The curve and the choice.

    Raises:
        FitError: If there are fewer than two blocks, or a block has too few samples to fit alone.
    """
    if len(blocks) < 2:
        raise FitError(f"choosing lambda: expected at least two blocks of data, got {len(blocks)}; give a lambda")
    smallest, least = min(block.count for block in blocks), blocks[0].channels + 2
    if smallest < least:
        raise FitError(
            f"choosing lambda: expected at least {least} samples in each of {len(blocks)} blocks, which are fitted "
            f"alone, got {smallest}; give more data, or a lambda"
        )
    candidates = candidate_lambdas(pooled(blocks))
    errors = np.empty((len(blocks), len(candidates)))
    for b, block in enumerate(blocks):
        others = pooled([other for o, other in enumerate(blocks) if o != b])
        for k, regularisation in enumerate(candidates):
            errors[b, k] = others.squared_error(*solve_matrix(block, prior, float(regularisation))).sum()
    mean = errors.mean(axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.nan_to_num((errors / errors[:, -1:]).max(axis=0), nan=1.0, posinf=math.inf)
    harmless = (errors <= errors[:, -1:]).all(axis=0)  # the prior itself, the last, is always so
    chosen = int(np.argmin(np.where(harmless, mean, np.inf)))
    return LambdaCurve(
        regularisations=candidates,
        held_out_error=np.sqrt(mean),
        worst_ratio=ratio,
        chosen=float(candidates[chosen]),
    )


def jackknife_error(
    blocks: Sequence[Moments], prior: FloatArray | None, regularisation: float
) -> tuple[FloatArray, FloatArray]:
    """Estimate standard errors of matrix and offset by leaving out one block at a time.

    Blocks, not samples, because neighbouring samples repeat each other. With few blocks it is a
    rough figure; a pull towards a wrong prior is not in it.

    Args:
        blocks: Moments of contiguous stretches of the fitted data, at least two.
        prior: Matrix that the fit was pulled towards; shape (6, c); None only for lambda = 0.
        regularisation: Lambda of the fit; counts2.

    Returns:
        Standard errors of the matrix, shape (6, c), and of the offset, shape (6,).
    """
    fits = [
        solve_matrix(pooled([other for o, other in enumerate(blocks) if o != b]), prior, regularisation)
        for b in range(len(blocks))
    ]
    scale = np.sqrt(len(blocks) - 1)  # of the standard deviation with divisor n
    matrices, offsets = np.stack([fit[0] for fit in fits]), np.stack([fit[1] for fit in fits])
    return scale * matrices.std(axis=0), scale * offsets.std(axis=0)
