# SPDX-License-Identifier: BSD-3-Clause
"""Elements with equal arms around a hub, with gauges at one distance."""

from __future__ import annotations

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.sensor.elastic import Beam, Bending, ElasticElement, GaugePlace, Material, RectangularSection


def bending_strain(moment: float, section: RectangularSection, material: Material) -> float:
    """Strain of the upper face by a moment that bends along z, `M h / (2 E I_y)`."""
    return moment * 0.5 * section.height / (material.young_modulus * section.width * section.height**3 / 12.0)


def y_shaped_element(*, beam: Beam, hub_radius: float, position: float) -> ElasticElement:
    """Give three arms at 120 degrees with two gauge places each: six channels, as in the FTsense.

    Args:
        beam: Each arm.
        hub_radius: Distance of the arms' inner ends from the axis; m.
        position: Distance of the gauges from the hub; m. At half the arm's length a guided arm has no
            bending, so gauges there would not see forces.

    Returns:
        The element; channels 0, 2, 4 see the arms bend in the plane, channels 1, 3, 5 out of it.
    """
    return _spokes(beam, hub_radius, position, np.deg2rad([0.0, 120.0, 240.0]))


def cross_shaped_element(*, beam: Beam, hub_radius: float, position: float) -> ElasticElement:
    """Give four arms at 90 degrees with two half-bridges each: eight channels.

    Args:
        beam: Each arm.
        hub_radius: Distance of the arms' inner ends from the axis; m.
        position: Distance of the gauges from the hub; m; not half the arm's length, as for the Y.

    Returns:
        The element; even channels see the arms bend in the plane, odd ones out of it.
    """
    return _spokes(beam, hub_radius, position, np.deg2rad([0.0, 90.0, 180.0, 270.0]))


def _spokes(beam: Beam, hub_radius: float, position: float, angles: FloatArray) -> ElasticElement:
    places = tuple(
        GaugePlace(arm=arm, position=position, bending=bending)
        for arm in range(len(angles))
        for bending in (Bending.IN_PLANE, Bending.OUT_OF_PLANE)
    )
    return ElasticElement(beam=beam, hub_radius=hub_radius, arm_angles=angles, places=places)
