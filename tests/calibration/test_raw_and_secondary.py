# SPDX-License-Identifier: BSD-3-Clause
"""Raw counts recovered through the prior, and the matrix that corrects a calibrated stream."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.calibration import recover_raw, secondary_matrix
from forcetorque.errors import FitError, ShapeError

PRIOR = 0.02 * (np.diag([1, 1, 1, 0.02, 0.02, 0.02]) @ (np.eye(6) + 0.2 * np.random.default_rng(1).normal(size=(6, 6))))


def test_counts_come_back() -> None:
    """Counts that went through the prior come back, whatever the rows' units."""
    counts = np.random.default_rng(2).integers(-20000, 20000, size=(50, 6)).astype(float)
    np.testing.assert_allclose(recover_raw(counts @ PRIOR.T, PRIOR), counts, rtol=0, atol=1e-6)


def test_the_secondary_matrix_corrects_what_the_prior_made() -> None:
    """Correcting prior readings equals applying the new matrix to the counts."""
    new = PRIOR * (1 + 0.1 * np.random.default_rng(3).normal(size=(6, 6)))
    counts = np.random.default_rng(4).normal(size=(50, 6)) * 1000
    corrected = (counts @ PRIOR.T) @ secondary_matrix(new, PRIOR).T
    np.testing.assert_allclose(corrected, counts @ new.T, rtol=1e-9, atol=1e-9)
    wrong = (counts @ PRIOR.T) @ np.linalg.solve(PRIOR, new).T  # C_prior^-1 C instead of C C_prior^-1
    assert not np.allclose(wrong, counts @ new.T, rtol=1e-3)


def test_singular_and_misshapen_priors_are_refused() -> None:
    """A prior that cannot be inverted, or has not six channels, is an error."""
    singular = PRIOR.copy()
    singular[5] = singular[4]
    with pytest.raises(FitError, match="singular"):
        recover_raw(np.zeros((3, 6)), singular)
    with pytest.raises(ShapeError, match="prior"):
        recover_raw(np.zeros((3, 6)), PRIOR[:, :5])
    with pytest.raises(ShapeError, match="matrix"):
        secondary_matrix(PRIOR[:, :5], PRIOR)
    with pytest.raises(FitError, match="singular"):
        secondary_matrix(PRIOR, np.zeros((6, 6)))
