# SPDX-License-Identifier: BSD-3-Clause
"""Raw counts recovered through the prior, and the matrix that corrects a calibrated stream."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from forcetorque.base.errors import FitError, ShapeError
from forcetorque.experiment.calibration.sensor_model import WrenchModel, recover_raw, secondary_matrix, secondary_model

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


def _model(seed: int, reference_value: float) -> WrenchModel:
    rng = np.random.default_rng(seed)
    return WrenchModel(
        matrix=np.eye(6) + 0.3 * rng.normal(size=(6, 6)),
        offset=rng.normal(size=6),
        coefficients=rng.normal(size=(6, 1)),
        reference_values=np.array([reference_value]),
    )


def test_a_calibrated_stream_is_corrected_with_offset_and_temperature() -> None:
    """F = S f_in + c_s (t - t0) + o_s gives the new calibration, with c_w, o_w not zero and t_w other than t0."""
    new, stream = _model(1, 29.0), _model(2, 22.5)
    rng = np.random.default_rng(3)
    raw, temperature = rng.normal(size=(50, 6)), rng.uniform(20.0, 45.0, size=(50, 1))
    f_in = stream.wrench(raw, temperature)
    secondary = secondary_model(new, stream)
    wanted = new.wrench(raw, temperature)
    np.testing.assert_allclose(secondary.wrench(f_in, temperature), wanted, rtol=1e-11, atol=1e-11)
    assert secondary.reference_values.tolist() == [29.0]
    # negative control: the offset of the new model is not that of its correction
    naive = replace(secondary, offset=new.offset)
    assert not np.allclose(naive.wrench(f_in, temperature), wanted, atol=0.1)


def test_a_stream_without_temperature_is_corrected_too() -> None:
    """Where the stream knows no temperature the coefficients are the new ones as they are."""
    new = _model(1, 29.0)
    stream = WrenchModel(matrix=_model(2, 0.0).matrix, offset=np.arange(6.0))
    raw, temperature = np.random.default_rng(4).normal(size=(20, 6)), np.full((20, 1), 35.0)
    secondary = secondary_model(new, stream)
    np.testing.assert_allclose(
        secondary.wrench(stream.wrench(raw), temperature), new.wrench(raw, temperature), rtol=1e-11, atol=1e-11
    )
    np.testing.assert_array_equal(secondary.coefficients, new.coefficients)
    with pytest.raises(ShapeError, match="expected the 0 variables of the new model or none, got 1"):
        secondary_model(stream, new)
