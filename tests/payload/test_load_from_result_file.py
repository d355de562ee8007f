# SPDX-License-Identifier: BSD-3-Clause
"""A load of an earlier result is known as well as that result says, and no better than anything is weighed."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError
from forcetorque.payload.load_from_result_file import SCHEMA, read_load_from_file

INERTIAL = [1.5, 0.03, 0.0, 0.15, 4e-3, 0.0, 0.0, 4e-3, 0.0, 3e-3]


def _written(folder: Path, covariance: FloatArray) -> Path:
    load = {"load": "tool", "estimated": True, "mass_kg": INERTIAL[0], "link": "hand", "inertial": INERTIAL}
    file = folder / "payload.json"
    content = {"schema": SCHEMA, "serial": "FT1", "loads": [load | {"covariance": covariance.tolist()}]}
    file.write_text(json.dumps(content), encoding="utf-8")
    return file


def test_the_precision_is_that_of_the_covariance(tmp_path: Path) -> None:
    """With correlations, of standard deviations far above what is rounded."""
    root = np.diag([0.02, *[0.005] * 3, *[0.001] * 6]) @ np.random.default_rng(2).normal(size=(10, 10))
    covariance = root @ root.T
    found = read_load_from_file(_written(tmp_path, 0.5 * (covariance + covariance.T)), "tool", "hand")
    np.testing.assert_allclose(found.load.precision @ covariance, np.eye(10), atol=1e-2)
    np.testing.assert_array_equal(found.load.expected, INERTIAL)
    assert (found.serial, found.known_loads) == ("FT1", ())


def test_a_stated_load_is_as_exact_as_anything_is_weighed(tmp_path: Path) -> None:
    """Without a deviation: 0.1 g, 10 g mm, 1 kg mm2, and no singular matrix."""
    found = read_load_from_file(_written(tmp_path, np.zeros((10, 10))), "tool", "hand")
    deviations = 1.0 / np.sqrt(np.diag(found.load.precision))
    np.testing.assert_allclose(deviations, [1e-4, *[1e-5] * 3, *[1e-6] * 6])


@pytest.mark.parametrize("covariance", [-np.eye(10), np.eye(10) + np.eye(10, k=1)])
def test_a_matrix_that_is_no_covariance_is_refused(tmp_path: Path, covariance: FloatArray) -> None:
    """Negative, or without symmetry."""
    with pytest.raises(FormatError, match="covariance: expected a symmetric positive matrix of 'tool'"):
        read_load_from_file(_written(tmp_path, covariance), "tool", "hand")
