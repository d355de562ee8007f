# SPDX-License-Identifier: BSD-3-Clause
"""Reflected intensity and fibre Bragg gratings: by hand, limits."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from forcetorque.base.errors import SensorError
from forcetorque.sensor.gauges import FibreBraggGrating, ReflectedIntensity

FIBRE = ReflectedIntensity(core_radius=1e-4, cone_angle=np.arctan(0.5), contact_intensity=8.0)
GRATING = FibreBraggGrating(
    wavelength=1.55e-6,
    photoelastic_coefficient=0.22,
    thermal_expansion=0.55e-6,
    refractive_index=1.45,
    thermo_optic_coefficient=8.7e-6,
)

ROUNDING = 1e-13
"""Relative rounding of a few products, one of them with a difference."""


def test_intensity_by_hand() -> None:
    """A cone of tangent 1/2 at 0.1 mm is twice as wide as the core when it is back: a quarter of the light."""
    np.testing.assert_allclose(FIBRE.intensity([0.0, 1e-4, 3e-4]), [8.0, 2.0, 0.5], rtol=ROUNDING)


def test_far_away_intensity_falls_with_the_square() -> None:
    """Ten times as far, a hundredth of the light: the cone's base grows with the square."""
    near, far = FIBRE.intensity([1.0, 10.0])
    assert near / far == pytest.approx(100.0, rel=1e-3)  # the core's radius is 1e-4 of the distance


def test_a_mirror_inside_the_fibre_is_refused() -> None:
    """A mirror inside the fibre, or an angle in degrees."""
    with pytest.raises(SensorError, match="distance: expected at least 0 m"):
        FIBRE.intensity(-1e-6)
    with pytest.raises(SensorError, match="is it in degrees"):
        dataclasses.replace(FIBRE, cone_angle=12.0)


def test_shift_by_hand() -> None:
    """1e-3 of strain shifts 1550 nm by 0.78e-3 of it, 1.209 nm; a degree by 0.78 * 0.55 + 6 = 6.429 millionths."""
    assert GRATING.shift(1e-3) == pytest.approx(1.209e-9, rel=ROUNDING)
    assert GRATING.shift(0.0, 1.0) == pytest.approx(1.55e-6 * 6.429e-6, rel=ROUNDING)


def test_a_photoelastic_coefficient_per_pascal_is_refused() -> None:
    """The coefficient is dimensionless and below 1, else strain would not lengthen the wave."""
    with pytest.raises(SensorError, match="dimensionless photoelastic_coefficient below 1"):
        dataclasses.replace(GRATING, photoelastic_coefficient=1.0)
    with pytest.raises(SensorError, match="wavelength: expected a finite number above 0 m"):
        dataclasses.replace(GRATING, wavelength=0.0)
    with pytest.raises(SensorError, match="thermo_optic_coefficient: expected a finite number"):
        dataclasses.replace(GRATING, thermo_optic_coefficient=float("inf"))
