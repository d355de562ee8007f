# SPDX-License-Identifier: BSD-3-Clause
"""Lambda chosen on held-out blocks of the fitted data, and block-wise uncertainty.

A slow motion has a few independent postures, not thousands of samples. Its blocks are contiguous stretches of
time, or whole recordings where there are several, which differ in motion, day and temperature. Each block ALONE is
fitted and judged, with its own offset, on all the others: that asks what a validation will ask, whether a fit on few
postures holds on others. (Leaving one block out asks the reverse, whether a fit on nearly everything holds in
between, and trusts the data too much.) The prior, with the offset of the same block, is judged likewise.
Coefficients of variables, which a block alone does not know, are those that all fitted data have with the matrix.

Blocks of one motion cannot see what the matrix does along directions that this motion does not load. There
the readings hold noise alone, and the fit is the prior times lambda / (noise variance + lambda): lost, not
kept, where lambda is small. So lambda has a floor far above that variance.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array
from forcetorque.base.errors import FitError
from forcetorque.calibration.thesis.regression import Regression, solve
from forcetorque.experiment.calibration.estimation_type import Estimation
from forcetorque.experiment.calibration.moments import Moments, pooled, symmetric_pseudo_inverse
from forcetorque.experiment.calibration.sensor_model import WrenchModel

FLOOR = 50.0
"""Least lambda that is chosen, over the variance of the readings that nothing explains.

Along a direction without load the fit then keeps 50 / 51 of the prior. Of 240 simulated calibrations some 60 make a
push that was not recorded read worse than the prior by more than 5 % without a floor, some 30 with 10, one or two with
50 and none with 200, where the median error is 1.4 times larger.
"""

RULE = (
    "each block of the fitted data alone is fitted and judged on all other blocks; of the lambdas with which no "
    "block's held-out mean squared error exceeds that of the prior, the one with the smallest mean, "
    f"but at least {FLOOR:g} times the mean variance of the readings that reference, offset and variables do not "
    "explain; where there is none, the prior is kept"
)
"""The rule by which lambda is chosen."""

BLOCKS = 5
"""Least number of blocks in which the fitted data are divided."""

_DECADES_BELOW, _DECADES_ABOVE, _PER_DECADE = 8, 3, 4


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LambdaCurve(ArrayRecord):
    """Held-out error of every candidate lambda, and the choice."""

    regularisations: FloatArray = field(metadata=array("k"))
    """Candidates, rising, the last infinite: the prior; shape (k,); counts2."""
    held_out_error: FloatArray = field(metadata=array("k"))
    """Root mean square held-out wrench error, 1 N counted like 1 N m; shape (k,)."""
    worst_ratio: FloatArray = field(metadata=array("k"))
    """Largest ratio, over the blocks, of held-out mean squared error to that of the prior; shape (k,)."""
    floor: float
    """Least lambda that the rule takes; one of the candidates, unless it is below all of them; counts2."""
    chosen: float
    """Lambda that the rule takes; infinite where the prior is kept."""


def fewest_samples(channels: int) -> int:
    """Tell how many samples a block needs at least to be fitted alone.

    Args:
        channels: Number of raw channels.

    Returns:
        One more than matrix and offset have unknowns in a row.
    """
    return channels + 2


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


def lambda_floor(moments: Moments) -> float:
    """Find the lambda below which noise alone would change the matrix where no load speaks.

    Args:
        moments: Moments of the fitted samples, without what fitted variables explain.

    Returns:
        `FLOOR` times the variance of the raw readings, mean over the channels, that is left by a regression on
        the reference and a constant; counts2.
    """
    shared = moments.reference_raw
    explained = shared.T @ symmetric_pseudo_inverse(moments.reference_reference) @ shared
    left = float(np.diag(moments.raw_raw - explained).mean())
    return FLOOR * max(left, 0.0)  # readings that follow the reference exactly may leave a rounding below zero


def choose_lambda(blocks: Sequence[Moments], estimation: Estimation) -> LambdaCurve:
    """Choose lambda by `RULE`.

    Args:
        blocks: Moments of contiguous stretches of the fitted data, or of its recordings, at least two.
        estimation: Offset strategy, variables and prior, which must be given.

    Returns:
        The curve and the choice.

    Raises:
        FitError: If there are fewer than two blocks, or a block has too few samples to fit alone.
    """
    if len(blocks) < 2:
        raise FitError(f"choosing lambda: expected at least two blocks of data, got {len(blocks)}; give a lambda")
    smallest, least = min(block.count for block in blocks), fewest_samples(blocks[0].channels)
    if smallest < least:
        raise FitError(
            f"choosing lambda: expected at least {least} samples in each of {len(blocks)} blocks, which are fitted "
            f"alone, got {smallest}; give more data, or a lambda"
        )
    total = pooled(blocks)
    fitted = total.without_variables() if estimation.kind.with_variables else total
    candidates, floor = candidate_lambdas(fitted), lambda_floor(fitted)
    if floor > candidates[0]:
        candidates = np.unique(np.append(candidates, floor))
    everything = Regression.of(total, estimation)
    errors = np.empty((len(blocks), len(candidates)))
    for b, block in enumerate(blocks):
        others = pooled([other for o, other in enumerate(blocks) if o != b])
        alone = Regression.of(block, estimation)
        for k, regularisation in enumerate(candidates):
            model = _with_common_coefficients(alone.at(float(regularisation)), block, everything)
            errors[b, k] = others.squared_error(model).sum()
    mean = errors.mean(axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.nan_to_num((errors / errors[:, -1:]).max(axis=0), nan=1.0, posinf=math.inf)
    harmless = (errors <= errors[:, -1:]).all(axis=0)  # the prior itself, the last, is always so
    best = int(np.argmin(np.where(harmless, mean, np.inf)))
    return LambdaCurve(
        regularisations=candidates,
        held_out_error=np.sqrt(mean),
        worst_ratio=ratio,
        floor=floor,
        chosen=max(float(candidates[best]), floor),
    )


def _with_common_coefficients(model: WrenchModel, block: Moments, everything: Regression) -> WrenchModel:
    """A model of one block, with the coefficients of variables that all data have with its matrix."""
    # temperature hardly changes within a block, so a block alone does not know them
    if not model.coefficients.shape[1]:
        return model
    coefficients = everything.completed(model.matrix).coefficients
    if everything.estimation.raw_offset is not None:
        return replace(model, coefficients=coefficients)
    change = (coefficients - model.coefficients) @ (block.variable_mean - model.reference_values)
    return replace(model, coefficients=coefficients, offset=model.offset - change)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class StandardErrors:
    """Standard errors by leaving out one block at a time."""

    matrix: FloatArray
    """Of the matrix; shape (6, c); N/count, N m/count."""
    offset: FloatArray
    """Of the offset; shape (6,); N, N m."""
    coefficients: FloatArray
    """Of the coefficients of variables; shape (6, v); N, N m per unit."""


def jackknife_errors(blocks: Sequence[Moments], estimation: Estimation, regularisation: float) -> StandardErrors:
    """Estimate standard errors by leaving out one block at a time.

    Blocks, not samples, because neighbouring samples repeat each other. With few blocks it is a
    rough figure; a pull towards a wrong prior is not in it.

    Args:
        blocks: Moments of contiguous stretches of the fitted data, at least two.
        estimation: Offset strategy, variables and prior.
        regularisation: Lambda of the fit; counts2.

    Returns:
        The standard errors.
    """
    fits = [
        solve(pooled([other for o, other in enumerate(blocks) if o != b]), estimation, regularisation)
        for b in range(len(blocks))
    ]
    scale = np.sqrt(len(blocks) - 1)  # of the standard deviation with divisor n
    return StandardErrors(
        matrix=scale * np.stack([fit.matrix for fit in fits]).std(axis=0),
        offset=scale * np.stack([fit.offset for fit in fits]).std(axis=0),
        coefficients=scale * np.stack([fit.coefficients for fit in fits]).std(axis=0),
    )
