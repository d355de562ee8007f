# SPDX-License-Identifier: BSD-3-Clause
"""Strain that a gauge sees on the three simple elastic elements: direct, bending, shear (thesis 1.2.1)."""

from __future__ import annotations

from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.sensor.elastic.beam import Material, RectangularSection
from forcetorque.sensor.require import require_positive


def strain_of_lengths(length: Any, *, initial_length: float) -> FloatArray:
    """Give the strain of what was stretched from one length to another, thesis (1.4).

    Args:
        length: Lengths under load; any shape; m.
        initial_length: Length without load; m.

    Returns:
        Strains, positive where it grew; same shape.

    Raises:
        SensorError: If the initial length is not a finite number above zero.
    """
    require_positive(initial_length, name="strain_of_lengths: initial_length", unit="m")
    return (np.asarray(length, dtype=np.float64) - initial_length) / initial_length


def direct_strain(force: Any, section: RectangularSection, material: Material) -> FloatArray:
    """Give the strain along a column under a force along its axis, thesis (1.3) and (1.7).

    A gauge across the axis sees this strain times minus the Poisson ratio.

    Args:
        force: Forces, positive in tension; any shape; N.
        section: Cross-section of the column.
        material: Material of the column.

    Returns:
        Normal strains along the axis; same shape.
    """
    return material.normal_strain(np.asarray(force, dtype=np.float64) / section.area)


def bending_strain(moment: Any, section: RectangularSection, material: Material) -> FloatArray:
    """Give the strain on the upper face of a beam that a moment bends in its x-z plane.

    Plane sections stay plane, so the strain grows linearly from the middle to the faces: `M z / (E I)`.

    Args:
        moment: Bending moments, positive where they stretch the upper face (z positive); any shape; N m.
        section: Cross-section of the beam.
        material: Material of the beam.

    Returns:
        Normal strains along the beam at z = height / 2; the lower face has the negative; same shape.
    """
    stress = np.asarray(moment, dtype=np.float64) * (0.5 * section.height / section.second_moment_y)
    return material.normal_strain(stress)


def shear_strain(force: Any, section: RectangularSection, material: Material) -> FloatArray:
    """Give the average shear angle of a section under a force across the beam, thesis (1.3) and (1.8).

    It is the average over the section, as in the thesis; at mid-height of a rectangle the angle is
    1.5 times larger.

    Args:
        force: Forces across the beam; any shape; N.
        section: Cross-section of the beam.
        material: Material of the beam.

    Returns:
        Shear angles; same shape; rad.
    """
    return material.shear_strain(np.asarray(force, dtype=np.float64) / section.area)


def diagonal_strain(shear_angle: Any) -> FloatArray:
    """Give what a gauge at +45 degrees to the neutral axis sees of a shear angle; one at -45 sees the negative.

    Args:
        shear_angle: Shear angles; any shape; rad.

    Returns:
        Principal normal strains, half the angle; same shape.
    """
    return 0.5 * np.asarray(shear_angle, dtype=np.float64)
