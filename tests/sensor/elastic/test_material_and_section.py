# SPDX-License-Identifier: BSD-3-Clause
"""Moduli of materials, and moments of sections, by hand and by tables."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.errors import SensorError
from forcetorque.sensor.elastic_element import (
    Material,
    RectangularSection,
)

STEEL = Material(young_modulus=200e9, shear_modulus=80e9)
SECTION = RectangularSection(width=0.02, height=0.01)

ROUNDING = 1e-14
"""Relative rounding of a few products."""


def test_poisson_ratio_ties_the_moduli() -> None:
    """E = 2 G (1 + nu): 200 and 80 GPa have nu = 0.25, and the ratio gives the modulus back."""
    assert STEEL.poisson_ratio == pytest.approx(0.25, rel=ROUNDING)
    assert Material.from_poisson_ratio(200e9, 0.25).shear_modulus == pytest.approx(80e9, rel=ROUNDING)


@pytest.mark.parametrize(("young", "shear"), [(80e9, 200e9), (200e9, 80.0), (200.0, 80e9)])
def test_swapped_or_mixed_moduli_are_refused(young: float, shear: float) -> None:
    """Moduli that no solid of a spring has point to a swap or to mixed units."""
    with pytest.raises(SensorError, match="check their order and units"):
        Material(young_modulus=young, shear_modulus=shear)


@pytest.mark.parametrize("ratio", [0.0, 0.5])
def test_the_ends_of_the_range_of_poisson_ratios_are_materials(ratio: float) -> None:
    """Cork and rubber are accepted, whatever rounding does to their shear modulus."""
    assert Material.from_poisson_ratio(1.1e7, ratio).poisson_ratio == pytest.approx(ratio, abs=1e-12)


@pytest.mark.parametrize("ratio", [-0.1, 0.51, float("nan")])
def test_impossible_poisson_ratios_are_refused(ratio: float) -> None:
    """A ratio above 0.5 grows under pressure; springs are not made of what gets thicker when pulled."""
    with pytest.raises(SensorError, match="Poisson ratio"):
        Material.from_poisson_ratio(200e9, ratio)


def test_second_moments_are_integrals_over_the_section() -> None:
    """Second moments equal a sum over small pieces of the section."""
    count = 400
    y = (np.arange(count) + 0.5) / count * SECTION.width - SECTION.width / 2
    z = (np.arange(count) + 0.5) / count * SECTION.height - SECTION.height / 2
    piece = SECTION.area / count**2
    midpoint_rule = 2.0 / count**2
    assert count * piece * (z**2).sum() == pytest.approx(SECTION.second_moment_y, rel=midpoint_rule)
    assert count * piece * (y**2).sum() == pytest.approx(SECTION.second_moment_z, rel=midpoint_rule)
    assert SECTION.second_moment_z == pytest.approx(4.0 * SECTION.second_moment_y, rel=ROUNDING)


@pytest.mark.parametrize(
    ("ratio", "factor"), [(1.0, 0.1406), (2.0, 0.2287), (5.0, 0.2913), (10.0, 0.3123)]
)  # Timoshenko and Goodier, table of torsion of rectangular bars
def test_torsion_constant_is_that_of_the_tables(ratio: float, factor: float) -> None:
    """The constant of a rectangle is the tabulated factor times long side times short side cubed, either way round."""
    printed_digits = 6e-4
    upright = RectangularSection(width=0.01, height=0.01 * ratio).torsion_constant
    assert upright == pytest.approx(factor * 0.01 * ratio * 0.01**3, rel=printed_digits)
    assert RectangularSection(width=0.01 * ratio, height=0.01).torsion_constant == pytest.approx(upright, rel=ROUNDING)


def test_sections_without_extent_are_refused() -> None:
    """A width or height of zero, or not finite, is an error that says which."""
    with pytest.raises(SensorError, match="width: expected a finite number above 0 m, got 0"):
        RectangularSection(width=0.0, height=0.01)
    with pytest.raises(SensorError, match="height: expected a finite number above 0 m, got inf"):
        RectangularSection(width=0.01, height=float("inf"))
