# SPDX-License-Identifier: BSD-3-Clause
"""Finite elements of an elastic layer against what is known of them, and the library's wrenches against both."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.skin.simulation.objects_on_skin import Sphere
from forcetorque.skin.wrench.pressure_to_wrench import WrenchMethod
from tests.skin.contact_trials import ContactTrial, PatchTrials, errors
from tests.skin.elastic_layer import STIFFNESS_PA_PER_M, ElasticLayer, LayerMaterial, Pressing
from tests.skin.layer_trials import CASES, LEAST_PA, TAXEL_AREA_M2, held, lattice_patch, layer_truths

pytestmark = pytest.mark.long
pytest.importorskip("skfem")

SIDE = np.array([0.018, 0.018])
CONTACTS, SEED = 30, 7


def _flat(places: FloatArray) -> tuple[FloatArray, FloatArray]:
    up = np.broadcast_to([0.0, 0.0, 1.0], (*places.shape[:-1], 3))
    return np.concatenate([places, np.zeros((*places.shape[:-1], 1))], axis=-1), up


def _layer(material: LayerMaterial, cell_m: float = 1e-3) -> ElasticLayer:
    return ElasticLayer.on(_flat, -SIDE, SIDE, material, cell_m=cell_m, cells=2)


@pytest.mark.parametrize("poisson", [0.0, 0.3])
def test_even_pressure_compresses_by_the_confined_modulus(poisson: float) -> None:
    """Away from the sides no material moves sideways: pressure over stiffness, for both ratios of Poisson."""
    layer = _layer(LayerMaterial(poisson=poisson), 2e-3)
    middle = layer.even[7:-7, 7:-7]
    assert middle.size > 10
    np.testing.assert_allclose(middle, 1.0 / STIFFNESS_PA_PER_M, rtol=0.01)


def test_a_ball_on_a_thin_layer_is_borne_as_by_springs() -> None:
    """A layer of 1 mm that does not swell, under a far wider contact: force pi k R d^2."""
    layer, ball, depth = _layer(LayerMaterial(thickness_m=1e-3, poisson=0.0), 0.75e-3), Sphere(radius_m=0.1), 5e-4
    told = layer.press(Pressing(thing=ball, place=np.zeros(2), spin=0.0, depth_m=depth), np.zeros((1, 2)))
    springs = np.pi * STIFFNESS_PA_PER_M * ball.radius_m * depth**2
    assert told.normal_force_N == pytest.approx(springs, rel=0.1)
    assert told.gap < 0.02
    assert (told.forces_N > 0.0).all()
    np.testing.assert_allclose(told.wrench[:3], [0.0, 0.0, -told.normal_force_N], atol=1e-6)
    np.testing.assert_allclose(told.centre[:2], 0.0, atol=5e-5)
    # the pad below the middle is pressed by all of the depth
    assert told.compressions[0] == pytest.approx(STIFFNESS_PA_PER_M * depth, rel=0.05)


def test_slip_adds_the_tangential_force() -> None:
    """A third of the normal force along the stated direction, and pads that hardly change."""
    layer = _layer(LayerMaterial(), 1.5e-3)
    pads = np.array([[0.0, 0.0], [0.004, 0.0]])
    still, slipping = (
        layer.press(
            Pressing(thing=Sphere(radius_m=0.05), place=np.zeros(2), spin=0.0, depth_m=5e-4, friction=mu, slip=0.5),
            pads,
        )
        for mu in (0.0, 0.3)
    )
    push = slipping.normal_force_N
    np.testing.assert_allclose(slipping.wrench[:2], 0.3 * push * np.array([np.cos(0.5), np.sin(0.5)]), rtol=1e-6)
    np.testing.assert_allclose(slipping.compressions, still.compressions, rtol=0.05)


def _trials(case: str) -> Sequence[ContactTrial]:
    patch = lattice_patch(CASES[case].material, holes=CASES[case].holes)
    truths = list(layer_truths(patch, np.random.default_rng(SEED), CONTACTS))
    trials = PatchTrials(patch.layout, patch.drawing, SEED, simple_area_m2=TAXEL_AREA_M2, least_pa=LEAST_PA)
    return trials.trials(truths)


@pytest.mark.parametrize("case", ["tiling", "holes"])
def test_forces_of_a_layer_are_told(case: str) -> None:
    """Within 6 % of the load on average, and within what is predicted, by equations that share nothing with ours."""
    trials = _trials(case)
    assert errors(trials, WrenchMethod.KRIGING).over_load < 0.06
    kept = held(trials)
    assert kept.number >= 5
    assert kept.force >= 0.9
    assert kept.centre_m < 5e-4


def test_rubber_reads_too_much() -> None:
    """Negative control: a layer that swells beside a contact is softer there than in the chamber of its calibration."""
    assert errors(_trials("rubber"), WrenchMethod.KRIGING).bias > 0.1
