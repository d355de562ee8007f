# SPDX-License-Identifier: BSD-3-Clause
"""The correction finds the load whose reading it is given, everywhere, and is constant beyond its limits."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError
from forcetorque.experiment.calibration.calibration_file import read_calibration, write_calibration
from forcetorque.experiment.calibration.quadratic_correction import STEEPEST, QuadraticCorrection, steepness
from forcetorque.experiment.calibration.sensor_model import WrenchModel
from tests.experiment.calibration.quadratic_sensor import LIMIT_COUNTS, correction_of_steepness
from tests.scenes.calibrations import FACTORY, MOUNTED, OFFSET, make_calibration

ROUND_TRIP = 1e-6
"""Relative to the load; what the iteration may leave, with rounding to spare."""
CORRECTION = correction_of_steepness(0.45)


def _loads(reach: float) -> FloatArray:
    """Loads with shares of full scale up to a reach; shape (500, 6); N, N m."""
    shares = np.random.default_rng(9).uniform(-reach, reach, size=(500, 6))
    return (CORRECTION.centre + shares) * LIMIT_COUNTS @ FACTORY.T


@pytest.mark.parametrize("reach", [0.02, 0.3, 3.0])
def test_the_load_that_was_read_comes_back(reach: float) -> None:
    """At the largest slope but a tenth, within the limits and far beyond; the reading itself is another wrench."""
    load = _loads(reach)
    reading = load + CORRECTION.added(load)
    size = np.linalg.norm(load, axis=1, keepdims=True)
    assert np.abs((CORRECTION.corrected(reading) - load) / size).max() < ROUND_TRIP
    assert np.abs((reading - load) / size).max() > 100.0 * ROUND_TRIP
    # negative control: one step from the reading is not enough
    assert np.abs((reading - CORRECTION.added(reading) - load) / size).max() > 10.0 * ROUND_TRIP


def test_beyond_the_limits_the_correction_stays_and_is_flagged() -> None:
    """Twice as far beyond along one direction changes nothing; within, it does, and nothing is flagged."""
    directions, middle = CORRECTION.directions, 0.5 * (CORRECTION.minimum + CORRECTION.maximum)
    for k in range(6):
        places = np.tile(middle, (4, 1))
        places[:, k] = CORRECTION.maximum[k] * np.array([0.5, 1.0, 1.5, 3.0])
        load = (CORRECTION.centre + places @ directions) * LIMIT_COUNTS @ FACTORY.T
        half, edge, beyond, far = CORRECTION.added(load)
        assert np.allclose(beyond, edge, rtol=1e-9, atol=1e-9)
        assert np.allclose(far, edge, rtol=1e-9, atol=1e-9)
        assert np.abs(half - edge).max() > 1e-3 * np.abs(edge).max()
        assert CORRECTION.beyond(load).tolist() == [False, False, True, True]


def test_the_steepness_is_that_of_the_steepest_place() -> None:
    """No difference of two loads is corrected by more than that, and a corner comes near it."""
    rng = np.random.default_rng(3)
    at = np.where(rng.random((2000, 6)) < 0.5, CORRECTION.minimum, CORRECTION.maximum) * rng.uniform(size=(2000, 1))
    step = 1e-6 * rng.standard_normal((2000, 6))
    ends = [(CORRECTION.centre + (at + sign * step) @ CORRECTION.directions) for sign in (-1.0, 1.0)]
    added = [CORRECTION.added(share * LIMIT_COUNTS @ FACTORY.T) @ CORRECTION.to_full_scale.T for share in ends]
    slopes = np.linalg.norm(added[1] - added[0], axis=1) / np.linalg.norm(2.0 * step, axis=1)
    assert 0.5 * CORRECTION.steepness < slopes.max() <= CORRECTION.steepness * (1.0 + 1e-6)
    doubled = steepness(
        CORRECTION.to_full_scale @ CORRECTION.coefficients,
        CORRECTION.directions,
        2.0 * CORRECTION.minimum,
        2.0 * CORRECTION.maximum,
    )
    assert doubled == pytest.approx(2.0 * CORRECTION.steepness)


def test_a_correction_that_is_too_steep_is_none() -> None:
    """The iteration would not find the load."""
    correction_of_steepness(0.99 * STEEPEST)
    with pytest.raises(ValidationError, match=r"expected a correction that changes by at most 0\.5"):
        correction_of_steepness(1.01 * STEEPEST)


def test_a_gap_stays_a_gap() -> None:
    """A reading that is not there corrects to nothing, and leaves the others alone."""
    load = _loads(0.1)
    gap = load.copy()
    gap[3] = np.nan
    corrected = CORRECTION.corrected(gap)
    assert np.isnan(corrected[3]).all()
    assert np.array_equal(np.delete(corrected, 3, axis=0), np.delete(CORRECTION.corrected(load), 3, axis=0))


def test_everything_that_reads_counts_corrects_them() -> None:
    """Model and calibration alike, and with reference values of zero."""
    model = WrenchModel(matrix=MOUNTED, offset=OFFSET, quadratic=CORRECTION)
    load = _loads(0.2)
    raw = np.linalg.solve(MOUNTED, (load + CORRECTION.added(load) - OFFSET).T).T
    calibration = make_calibration().model_copy(update={"quadratic": CORRECTION})
    for wrench in (
        model.wrench(raw),
        model.counted_from_zero(0).wrench(raw),
        calibration.apply(raw, serial="SN001"),
    ):
        assert np.allclose(wrench, load, rtol=0.0, atol=ROUND_TRIP * np.abs(load).max())
    assert np.array_equal(calibration.beyond_limits(raw), CORRECTION.beyond(load))
    assert 0 < calibration.beyond_limits(raw).sum() < len(raw)
    linear = make_calibration()
    assert np.abs(linear.apply(raw, serial="SN001") - load).max() > 1e-3 * np.abs(load).max()
    assert not linear.beyond_limits(raw).any()


def test_the_file_keeps_it(tmp_path: Path) -> None:
    """Every number reads back; a file without the key is linear."""
    write_calibration(tmp_path / "c.json", make_calibration().model_copy(update={"quadratic": CORRECTION}))
    read = read_calibration(tmp_path / "c.json").quadratic
    assert read is not None
    for name in QuadraticCorrection.model_fields:
        assert np.array_equal(getattr(read, name), getattr(CORRECTION, name))
    content = json.loads((tmp_path / "c.json").read_text())
    del content["quadratic"]
    (tmp_path / "c.json").write_text(json.dumps(content))
    assert read_calibration(tmp_path / "c.json").quadratic is None


@pytest.mark.parametrize(
    ("key", "value", "message"),
    [
        ("directions", (2.0 * np.eye(6)).tolist(), "orthonormal"),
        ("minimum", (1.1 * CORRECTION.maximum).tolist(), "minimum of at most the maximum"),
        ("coefficients", (9.0 * CORRECTION.coefficients).tolist(), "changes by at most 0.5"),
        ("coefficients", [[1.0] * 20] * 6, "21"),
    ],
)
def test_a_damaged_correction_is_refused(tmp_path: Path, key: str, value: Any, message: str) -> None:
    """One line that names file and key."""
    write_calibration(tmp_path / "c.json", make_calibration().model_copy(update={"quadratic": CORRECTION}))
    content = json.loads((tmp_path / "c.json").read_text())
    content["quadratic"][key] = value
    (tmp_path / "c.json").write_text(json.dumps(content))
    with pytest.raises(FormatError, match=rf"c\.json: (quadratic|array).*{message}") as refusal:
        read_calibration(tmp_path / "c.json")
    assert "\n" not in str(refusal.value)
