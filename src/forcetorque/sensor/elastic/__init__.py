# SPDX-License-Identifier: BSD-3-Clause
"""From load to strain: Hooke's law, sections, beams, and elements made of beams (thesis 1.2)."""

from forcetorque.sensor.elastic.beam import Beam
from forcetorque.sensor.elastic.element import (
    Bending,
    ElasticElement,
    GaugePlace,
    cross_shaped_element,
    y_shaped_element,
)
from forcetorque.sensor.elastic.material import Material
from forcetorque.sensor.elastic.section import RectangularSection
from forcetorque.sensor.elastic.strain import (
    bending_strain,
    diagonal_strain,
    direct_strain,
    shear_strain,
    strain_of_lengths,
)

__all__ = [
    "Beam",
    "Bending",
    "ElasticElement",
    "GaugePlace",
    "Material",
    "RectangularSection",
    "bending_strain",
    "cross_shaped_element",
    "diagonal_strain",
    "direct_strain",
    "shear_strain",
    "strain_of_lengths",
    "y_shaped_element",
]
