# SPDX-License-Identifier: BSD-3-Clause
"""A matrix among others: positions by hand, and which defects stand out in which feature."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import SensorError, ShapeError
from forcetorque.evaluation.matrix_checks import (
    LEAST_POPULATION,
    FeaturePosition,
    matrix_features,
    most_unusual,
    position_in_population,
)
from forcetorque.simulation.simulated_sensor import distorted_by_mounting, y_shaped_matrix

TYPE = y_shaped_matrix(arm_m=0.02, counts_per_newton=25.0)
USUAL, UNUSUAL = 6.0, 12.0
"""Robust z-scores: of 19 features of a sensor like the others the largest stays below, a defect is above."""


def _sensor(seed: int) -> FloatArray:
    return distorted_by_mounting(TYPE, relative=0.03, rng=np.random.default_rng(seed))


POPULATION = {f"SN{seed:03}": _sensor(seed) for seed in range(30)}


def _z(position: tuple[FeaturePosition, ...]) -> dict[str, float]:
    return {each.feature: each.robust_z for each in position}


def test_positions_by_hand() -> None:
    """Rows of 1 to 5 units: 2.5 has two of five below it, and stands half a unit below the median 3."""
    population = {str(k): k * np.eye(6) for k in (1.0, 2.0, 3.0, 4.0, 5.0)}
    position = position_in_population(2.5 * np.eye(6), population)
    features = {each.feature: each for each in position}
    assert len(features) == len(position) == 19
    row = features["row_norm.fz"]
    assert (row.value, row.median, row.quantile) == (2.5, 3.0, 0.4)
    assert row.robust_z == pytest.approx(-0.5 / 1.4826, rel=1e-12)
    same = features["condition"]  # all are 1: no scatter, in the middle
    assert (same.value, same.quantile) == (1.0, 0.5)
    assert np.isnan(same.robust_z)
    assert most_unusual(position).feature.startswith("row_norm.")
    equal = {str(k): np.eye(6) for k in range(5)}
    with pytest.raises(SensorError, match="no scatter"):
        _ = most_unusual(position_in_population(np.eye(6), equal))


def test_features_by_hand() -> None:
    """Two rows at 60 degrees have a coupling of 0.5; a turned sign gives an alignment of -1."""
    matrix = np.eye(6)
    matrix[1] = [0.5, np.sqrt(0.75), 0.0, 0.0, 0.0, 0.0]
    matrix[5, 5] = -2.0
    features = matrix_features(matrix, {"a": np.eye(6), "b": 3.0 * np.eye(6)})
    assert features["coupling.fx"] == features["coupling.fy"] == pytest.approx(0.5, rel=1e-12)
    assert (features["coupling.fz"], features["row_norm.tz"], features["alignment.tz"]) == (0.0, 2.0, -1.0)
    assert features["alignment.fy"] == pytest.approx(np.sqrt(0.75), rel=1e-12)


def test_a_sensor_of_the_same_type_is_usual() -> None:
    """Other draws of the family stay near the others."""
    worst = [abs(most_unusual(position_in_population(_sensor(seed), POPULATION)).robust_z) for seed in range(100, 120)]
    assert len(worst) == 20
    assert max(worst) < USUAL


def test_defects_stand_out_where_they_are() -> None:
    """A double range only in the norms, a turned channel and swapped ones in the alignment, a dead axis in its row."""
    good = _sensor(200)
    plain, double = (_z(position_in_population(matrix, POPULATION)) for matrix in (good, 2.0 * good))
    assert max(abs(z) for z in plain.values()) < USUAL
    assert {name.partition(".")[0] for name, z in double.items() if abs(z) > UNUSUAL} == {"row_norm"}
    np.testing.assert_allclose(
        [z for name, z in double.items() if not name.startswith("row_norm")],
        [z for name, z in plain.items() if not name.startswith("row_norm")],
        rtol=1e-6,
    )
    swapped = good[:, [1, 0, 2, 3, 4, 5]]
    turned = good * np.array([1.0, 1.0, 1.0, -1.0, 1.0, 1.0])
    for matrix in (swapped, turned):
        worst = most_unusual(position_in_population(matrix, POPULATION))
        assert worst.feature.startswith("alignment.")
        assert worst.robust_z < -UNUSUAL
    singular = np.array(good)
    singular[4] = singular[3]
    worst = most_unusual(position_in_population(singular, POPULATION))
    assert (worst.feature, worst.robust_z) == ("condition", np.inf)
    weak = np.array(good)
    weak[2] *= 0.3
    found = _z(position_in_population(weak, POPULATION))
    assert [name for name, z in found.items() if abs(z) > UNUSUAL] == ["row_norm.fz"]


def test_the_order_of_the_population_does_not_matter() -> None:
    """The same sensors in another order give the same positions."""
    first = _z(position_in_population(_sensor(50), POPULATION))
    second = _z(position_in_population(_sensor(50), dict(reversed(POPULATION.items()))))
    np.testing.assert_allclose(list(first.values()), list(second.values()), rtol=1e-6)


def test_what_cannot_be_compared_is_refused() -> None:
    """Too few sensors, other channels, a row of zeros."""
    few = dict(list(POPULATION.items())[: LEAST_POPULATION - 1])
    with pytest.raises(SensorError, match="expected at least 5 other sensors, got 4"):
        position_in_population(_sensor(0), few)
    with pytest.raises(ShapeError, match="matrix of 'SN000'"):
        position_in_population(np.ones((6, 8)), POPULATION)
    empty = _sensor(0) * np.array([1.0, 1.0, 0.0, 1.0, 1.0, 1.0])[:, None]
    with pytest.raises(SensorError, match="one of zeros"):
        position_in_population(empty, POPULATION)
