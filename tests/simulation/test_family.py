# SPDX-License-Identifier: BSD-3-Clause
"""Families of sensors: built from an elastic element, and scattered like the workbench matrices of real ones."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.stats import ks_2samp

from forcetorque.formats.icub_matrix import read_matrix_file
from forcetorque.sensor.electronics import CHANNEL_ANGLES, IN_PLANE, Y_ELEMENT
from forcetorque.simulation.sensor_family import FAMILIES

SPECIMENS = 300
SIGNIFICANCE = 0.05
"""Of all comparisons of a group together, by Holm's rule."""
DOUBLE, STIFF = ("SN163", "SN270", "SN271"), ("SN282", "SN292", "SN293", "SN294")
LENGTH_M = 0.02
"""Moment that weighs as much as one newton where both are compared; about the size of the sensor."""


def _real(data_dir: Path) -> dict[str, list[np.ndarray]]:
    groups: dict[str, list[np.ndarray]] = {"standard": [], "double range": [], "stiff in z": []}
    for file in sorted((data_dir / "icub_workbench_matrices").glob("matrix_SN*.txt")):
        serial = file.stem.removeprefix("matrix_")
        group = "double range" if serial in DOUBLE else "stiff in z" if serial in STIFF else "standard"
        groups[group].append(read_matrix_file(file).matrix)
    return groups


def _figures(matrix: np.ndarray) -> dict[str, float]:
    """Row norms, conditions, and how far the responses to two components are from being at right angles."""
    rows = np.linalg.norm(matrix, axis=1)
    lengths = np.array([1.0, 1.0, 1.0, LENGTH_M, LENGTH_M, LENGTH_M])
    response = np.linalg.inv(matrix) / lengths
    response /= np.linalg.norm(response, axis=0)
    couplings = np.abs(response.T @ response)
    return {
        **{f"row {k}": float(rows[k]) for k in range(6)},
        "condition": float(np.linalg.cond(matrix)),
        "scaled condition": float(np.linalg.cond(matrix / lengths[:, None])),
        **{f"coupling {i}{j}": float(couplings[i, j]) for i in range(6) for j in range(i + 1, 6)},
    }


def _drawn(name: str, *, factor: float = 1.0) -> dict[str, np.ndarray]:
    rng = np.random.default_rng(1)
    drawn = [_figures(np.linalg.inv(FAMILIES[name].draw(rng)) * factor) for _ in range(SPECIMENS)]
    return {key: np.array([figures[key] for figures in drawn]) for key in drawn[0]}


def _rejected(real: dict[str, np.ndarray], simulated: dict[str, np.ndarray]) -> list[str]:
    """Figures whose two samples differ, by Holm's rule over all of them."""
    values = sorted((float(ks_2samp(real[key], simulated[key]).pvalue), key) for key in real)
    found = []
    for rank, (value, key) in enumerate(values):
        if value > SIGNIFICANCE / (len(values) - rank):
            break
        found.append(key)
    return found


@pytest.mark.real_data
@pytest.mark.parametrize("name", FAMILIES)
def test_specimens_scatter_like_real_sensors(name: str, data_dir: Path) -> None:
    """No figure's two-sample test rejects; a matrix twice as large is rejected (the tests are not blind)."""
    matrices = _real(data_dir)[name]
    assert len(matrices) == {"standard": 25, "double range": 3, "stiff in z": 4}[name]
    figures = [_figures(matrix) for matrix in matrices]
    real = {key: np.array([entry[key] for entry in figures]) for key in figures[0]}
    assert _rejected(real, _drawn(name)) == []
    assert set(_rejected(real, _drawn(name, factor=2.0))) >= {"row 0"}


@pytest.mark.real_data
def test_the_middle_specimen_is_inside_the_real_quantiles(data_dir: Path) -> None:
    """For every figure of the usual family the median lies between the 5 and 95 % quantiles of 25 real sensors."""
    figures = [_figures(matrix) for matrix in _real(data_dir)["standard"]]
    simulated = _drawn("standard")
    for key in figures[0]:
        low, high = np.quantile([entry[key] for entry in figures], [0.05, 0.95])
        assert low <= np.median(simulated[key]) <= high, key
    assert len(simulated) == 23


@pytest.mark.parametrize("name", FAMILIES)
def test_the_design_is_its_elastic_element(name: str) -> None:
    """Channels in the plane strain as the element does; those across also see forces in the plane, by the height."""
    family = FAMILIES[name]
    nominal, strain = family.nominal(), Y_ELEMENT.strain_matrix()
    scale = nominal[0, 1] / strain[0, 1]
    assert scale == pytest.approx(family.electronics.counts_per_strain)
    np.testing.assert_allclose(nominal[IN_PLANE], scale * strain[IN_PLANE], rtol=1e-9, atol=1e-9 * scale)
    gains = np.array(family.out_of_plane)[:, None]
    np.testing.assert_allclose(nominal[~IN_PLANE, 3:], gains * scale * strain[~IN_PLANE, 3:], atol=1e-6 * scale)
    # a force along an arm acts at the frame's height above it
    along = np.column_stack([np.cos(CHANNEL_ANGLES), np.sin(CHANNEL_ANGLES)])
    across = np.column_stack([-np.sin(CHANNEL_ANGLES), np.cos(CHANNEL_ANGLES)])
    lever = (nominal[:, :2] * along).sum(axis=1) / (nominal[:, 3:5] * across).sum(axis=1).clip(None, -1e-9)
    np.testing.assert_allclose(lever[~IN_PLANE], family.height_m, rtol=1e-6)


def test_specimens_are_the_same_for_the_same_seed() -> None:
    """Drawing is a function of the generator alone, and different draws differ."""
    family = FAMILIES["standard"]
    first, again = (family.draw(np.random.default_rng(5)) for _ in range(2))
    np.testing.assert_array_equal(first, again)
    assert not np.allclose(first, family.draw(np.random.default_rng(6)), rtol=1e-3)
