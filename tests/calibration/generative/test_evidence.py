# SPDX-License-Identifier: BSD-3-Clause
"""The deviance of a fit against minus twice the logarithm of a Gaussian density written out."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.noise.slow_noise import CANDIDATES
from forcetorque.calibration.generative.model import Maximum, RowData, Sizes, _have_rank, infer
from forcetorque.calibration.generative.whitening import Border, Whitened, _log_determinant

ROWS, MEANS, OWN, COMMON = 3, 40, 2, 2
DEVIATIONS = np.array([0.7, 2.0])
"""Of an own unknown and of a common one."""
NO_CELLS = Border(own=np.zeros((0, 0, 0)), columns=np.zeros((0, 0)), free=np.zeros((0, 0)), response=np.zeros(0))


def _data(common: int) -> tuple[FloatArray, FloatArray]:
    """Designs and responses of rows with noise of different sizes; shapes (3, 40, 2 + common) and (3, 40)."""
    rng = np.random.default_rng(5)
    designs = rng.normal(size=(ROWS, MEANS, OWN + common))
    shared = 2.0 * rng.normal(size=common)
    noise = np.array([[0.1], [0.5], [2.0]]) * rng.normal(size=(ROWS, MEANS))
    own = 0.7 * rng.normal(size=(ROWS, OWN))
    return designs, np.stack([x @ np.r_[w, shared] for x, w in zip(designs, own, strict=True)]) + noise


def _fitted(designs: FloatArray, responses: FloatArray, common: int) -> Maximum:
    rows = [
        RowData(
            data=[
                Whitened(
                    noise=CANDIDATES[0],
                    log_determinant=0.0,
                    columns=x.T @ x,
                    shared=x.T @ y,
                    response=float(y @ y),
                    free=np.zeros((0, 0)),
                    border=NO_CELLS,
                )
            ],
            basis=np.eye(OWN),
            terms=np.arange(common),
            accuracy=0.0,
            freedom=MEANS,
        )
        for x, y in zip(designs, responses, strict=True)
    ]
    last = ROWS * OWN
    sizes = Sizes(
        places=[np.r_[OWN * k : OWN * (k + 1), last : last + common] for k in range(ROWS)],
        own=OWN,
        size=np.repeat([0, 1], [last, common]),
        expected=DEVIATIONS,
        weight=np.full(2, np.inf),
        least=np.zeros(2),
    )
    return infer(rows, sizes)


def _written_out(designs: FloatArray, responses: FloatArray, common: int, variances: FloatArray) -> float:
    design = np.zeros((ROWS * MEANS, ROWS * OWN + common))
    for k, x in enumerate(designs):
        design[MEANS * k : MEANS * (k + 1), OWN * k : OWN * (k + 1)] = x[:, :OWN]
        design[MEANS * k : MEANS * (k + 1), ROWS * OWN :] = x[:, OWN:]
    prior = np.repeat(DEVIATIONS**2, [ROWS * OWN, common])
    covariance = np.diag(np.repeat(variances, MEANS)) + design * prior @ design.T
    return float(np.linalg.slogdet(covariance)[1] + responses.ravel() @ np.linalg.solve(covariance, responses.ravel()))


@pytest.mark.parametrize("common", [0, COMMON])
def test_the_deviance_is_that_of_the_density_and_least_at_the_noise_that_was_found(common: int) -> None:
    """Of rows by themselves and of rows with common unknowns, whose noises differ twentyfold."""
    designs, responses = _data(common)
    fit = _fitted(designs, responses, common)
    variances = np.array(fit.variances)
    np.testing.assert_allclose(fit.deviance, _written_out(designs, responses, common, variances), rtol=1e-6)
    for k in range(ROWS):
        for factor in (0.8, 1.25):
            other = variances * np.where(np.arange(ROWS) == k, factor, 1.0)
            assert _written_out(designs, responses, common, other) > fit.deviance + 0.5


@pytest.mark.parametrize(("share", "moves"), [(1e-5, True), (1.5e-6, True), (1.3e-6, False), (0.0, False)])
def test_a_direction_that_moves_by_a_millionth_of_the_others_does_not_move(share: float, moves: bool) -> None:
    """Two loads that are one but for a share of another, which leaves half of its square of their products."""
    unit = np.array([1e3, 1.0, 1.0, 0.01, 0.01, 0.01])
    loads = np.linalg.qr(np.random.default_rng(3).normal(size=(50, 6)))[0]
    loads[:, 4] = loads[:, 1] + share * loads[:, 4]
    assert _have_rank((loads.T @ loads) * np.outer(unit, unit)) is moves
    # a load that is not there has no size either
    assert not _have_rank(np.diag([1.0, 1.0, 0.0, 1.0, 1.0, 1.0]))


def test_the_log_determinant_is_that_of_what_moves() -> None:
    """Of a stack in units that differ by 1e9, some columns of which are zero: by LAPACK, block by block."""
    rng = np.random.default_rng(8)
    matrices, expected = np.zeros((3, 5, 5)), 0.0
    for k, moving in enumerate(([0, 1, 2, 3, 4], [0, 2, 4], [])):
        root = rng.normal(size=(len(moving), 9)) * 10.0 ** rng.uniform(-4.5, 4.5, size=(len(moving), 1))
        matrices[np.ix_([k], moving, moving)] = root @ root.T
        expected += np.linalg.slogdet(root @ root.T)[1]
    assert _log_determinant(matrices) == pytest.approx(expected, rel=1e-9)
