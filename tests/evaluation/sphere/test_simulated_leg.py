# SPDX-License-Identifier: BSD-3-Clause
"""What the thesis measured on a leg (Tables 4.1, 4.3, 4.4), on simulated sensors with noise, temperature and screws."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from forcetorque.evaluation.sphere.sensor_sphere import SphereAnalysis
from tests.evaluation.sphere.simulated_leg import GRAVITY, JUDGED, SCREWS, Leg, leg, screwed

SEEDS = range(1, 11)
pytestmark = pytest.mark.long

SOME = pytest.mark.parametrize("seeds", [range(1, 6), SEEDS], ids=["5", "10"])
LEG_MASS = 4.734
"""What the model of this robot has beyond the sensor; the thesis has 4.733; kg."""
ACCELERATIONS = 0.002
"""What they add to the mean force; kg."""


def _indices(found: SphereAnalysis) -> tuple[float, float]:
    """With the model and without; kg. Both must be identifiable."""
    assert found.mapped is not None
    assert found.mapped.fit.identifiable
    assert found.free.identifiable
    return found.mapped.fit.index / GRAVITY, found.free.index / GRAVITY


@cache
def _leg(seed: int) -> Leg:
    """A sensor whose workbench matrix errs like that of thesis Table 5.7."""
    return leg(seed)


@cache
def _screwed(seed: int, screws: str) -> Leg:
    return screwed(seed, screws)


@SOME
def test_before_in_situ_calibration(seeds: range) -> None:
    """Table 4.1 has 0.5 to 1.24 kg with the model and 0.5 to 2.4 without: eight of ten sensors fall into that."""
    found = np.array([_indices(_leg(seed).analysed("grid", _leg(seed).workbench)) for seed in seeds])
    assert ((found > 0.45) & (found < 1.65)).all()
    assert np.count_nonzero(found[:, 0] < 1.3) >= 0.6 * len(seeds)
    assert 0.5 < np.median(found[:, 0]) < 1.3
    # the model brings little here: the grid covers enough, and nothing but the sensor is wrong
    np.testing.assert_allclose(found[:, 0], found[:, 1], atol=0.1)


@SOME
def test_after_in_situ_calibration(seeds: range) -> None:
    """Without temperature, as in Table 4.1, below 0.2 kg, where that has 0.12 and 0.13; with it below 0.1 kg."""
    plain = np.array([_indices(_leg(seed).calibrated(temperature=False)) for seed in seeds])
    compensated = np.array([_indices(_leg(seed).calibrated(temperature=True)) for seed in seeds])
    assert plain.max() < 0.2
    assert plain[:, 0].max() > 0.1
    assert compensated.max() < 0.1
    assert np.median(compensated[:, 0]) < 0.5 * np.median(plain[:, 0])


@SOME
def test_the_calibrated_errors_hold_the_true_weight(seeds: range) -> None:
    """The masses of the true matrix are that of the leg, within their intervals, on every seed."""
    held = 0
    for seed in seeds:
        found = _leg(seed).analysed(JUDGED, _leg(seed).truth)
        assert found.mass == pytest.approx(LEG_MASS, abs=ACCELERATIONS)
        assert found.radius.identifiable
        weight = LEG_MASS * GRAVITY
        held += int(((found.free.low < weight) & (weight < found.free.high)).sum())
        # motion adds accelerations, which the model knows and a sphere does not
        masses = found.masses(found.free)
        assert masses is not None
        assert np.abs(masses - LEG_MASS).max() < 0.15
    assert held >= 0.9 * 3 * len(seeds)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_mixed_screws(seed: int) -> None:
    """Tables 4.3 and 4.4: about 0.8 kg with loose screws along x, 1.1 kg with loose ones elsewhere, which is worse."""
    along_x, elsewhere = (
        _indices(_screwed(seed, name).analysed("grid", _screwed(seed, name).workbench))[0]
        for name in ("mixed1", "mixed2")
    )
    assert 0.7 < along_x < 1.1
    assert 1.0 < elsewhere < 1.25
    assert along_x < elsewhere


def test_even_screws_change_nothing_here() -> None:
    """Where the simulation fails: the thesis has 0.5 to 1.1 kg with even screws, most with loose ones."""
    for name in ("2 N m", "0.5 N m"):
        assert SCREWS[name] == (SCREWS[name][0],) * 6
        assert _indices(_screwed(1, name).analysed("grid", _screwed(1, name).workbench))[0] < 0.08


def test_temperature_hardly_moves_the_index() -> None:
    """The cold grid and the warm one, 13 degrees apart, give one index: an offset is no deformation."""
    for seed in SEEDS[:2]:
        cold, warm = (
            np.array(_indices(_leg(seed).analysed(name, _leg(seed).workbench))) for name in ("grid", "grid_2")
        )
        centres = []
        for name in ("grid", "grid_2"):
            mapped = _leg(seed).analysed(name, _leg(seed).workbench).mapped
            assert mapped is not None
            centres.append(mapped.centre)
        np.testing.assert_allclose(cold, warm, atol=0.05)
        assert np.abs(centres[0] - centres[1]).max() > 1.0


def test_coverage_decides() -> None:
    """A tenth of the grid is one row: without the model the ellipsoid is then unknown, and its interval holds."""
    for seed in SEEDS[:3]:
        sensor = _leg(seed)
        whole = sensor.analysed("grid", sensor.truth)
        count = whole.samples
        weight = LEG_MASS * GRAVITY
        rows = sensor.analysed("grid", sensor.truth, slice(0, count // 10))
        assert whole.directions is not None
        assert rows.directions is not None
        assert rows.directions < 0.5 * whole.directions
        assert whole.free.identifiable
        assert not rows.free.identifiable
        assert (rows.free.low < weight).all()
        assert (rows.free.high > weight).all()
