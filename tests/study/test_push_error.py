# SPDX-License-Identifier: BSD-3-Clause
"""Pushes around a sensor, by which a matrix is judged at loads that were not recorded."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.study.candidate_errors import LEVER_M, PUSH_N, push_error, pushes

TRUTH = 0.02 * (np.eye(6) + 0.2 * np.random.default_rng(1).normal(size=(6, 6)))
EXACT = 1e-12
"""Relative rounding of double precision times the condition of the matrix, some ten."""


def test_pushes_have_one_size_every_direction_and_a_lever() -> None:
    """50 N each, alike in all axes, and no moment along the force nor beyond the longest lever."""
    force, moment = np.split(pushes(), 2, axis=1)
    np.testing.assert_allclose(np.linalg.norm(force, axis=1), PUSH_N, rtol=EXACT)
    np.testing.assert_allclose(force.std(axis=0), PUSH_N / np.sqrt(3.0), rtol=0.05)
    assert np.abs((force * moment).sum(axis=1)).max() < EXACT * PUSH_N**2
    longest = np.linalg.norm(moment, axis=1).max()
    assert 0.9 * PUSH_N * LEVER_M < longest <= PUSH_N * LEVER_M


def test_an_error_of_the_gain_is_that_share_of_every_push() -> None:
    """Three per cent of 50 N are 1.5 N; the true matrix errs by nothing, with eight channels too."""
    assert push_error(1.03 * TRUTH, TRUTH).force_N == pytest.approx(1.5, rel=1e-9)
    moment = np.linalg.norm(pushes()[:, 3:], axis=1).mean()
    assert push_error(1.03 * TRUTH, TRUTH).moment_Nm == pytest.approx(0.03 * moment, rel=1e-9)
    wide = np.random.default_rng(2).normal(size=(6, 8))
    for truth in (TRUTH, wide):
        error = push_error(truth, truth)
        assert max(error.force_N, error.moment_Nm) < 1e-9
    assert push_error(wide + 0.01, wide).force_N > 0.01


def test_errors_are_compared_by_the_worse_of_force_and_moment() -> None:
    """A row of moments that is twice as wrong is not made up for by one of forces that is right."""
    before = push_error(1.03 * TRUTH, TRUTH)
    after = push_error(np.vstack([TRUTH[:3], 1.06 * TRUTH[3:]]), TRUTH)
    assert after.over(before) == pytest.approx(2.0, rel=1e-9)
    assert after.force_N < 1e-9
