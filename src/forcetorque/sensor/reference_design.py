# SPDX-License-Identifier: BSD-3-Clause
"""The design that simulated sensors and the comparison of principles share: a Y-shaped element and its electronics."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.sensor.elastic import Beam, Bending, ElasticElement, GaugePlace, Material, RectangularSection
from forcetorque.sensor.electronics import HALF_BRIDGE, Adc, Bridge
from forcetorque.sensor.gauge import ResistiveGauge

_SMALL_STRAIN = 1e-7
"""Strain of a few newtons: the bridge is linear to rounding there."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Electronics:
    """What every channel of a board is made of."""

    gauge: ResistiveGauge = ResistiveGauge(gauge_factor=130.0, resistance=200.0)
    """A silicon gauge."""
    bridge: Bridge = HALF_BRIDGE
    """Gauges on both faces of an arm."""
    excitation: float = 2.5
    """Voltage across the bridge; V."""
    amplifier_gain: float = 100.0
    """Gain between bridge and converter."""
    adc: Adc = Adc(bits=16, reference=1.65, signed=True)
    """Converter."""

    @property
    def counts_per_strain(self) -> float:
        """Change of the count per strain, for small ones; 1/strain."""
        up, down = (float(self.bridge.ratio(self.gauge, sign * _SMALL_STRAIN)) for sign in (1.0, -1.0))
        return self.amplifier_gain * self.excitation * (up - down) / (2.0 * _SMALL_STRAIN) / self.adc.step


_STEEL = Material.from_poisson_ratio(200e9, 0.3)
_PLACES = tuple(
    GaugePlace(arm=arm, position=position, bending=bending)
    for arm in range(3)
    for position, bending in ((0.81e-3, Bending.IN_PLANE), (1.96e-3, Bending.OUT_OF_PLANE))
)
Y_ELEMENT = ElasticElement(
    beam=Beam(length=7.4e-3, section=RectangularSection(width=7.4e-3, height=7.0e-3), material=_STEEL),
    hub_radius=14.9e-3,
    arm_angles=np.deg2rad([0.0, 120.0, 240.0]),
    places=_PLACES,
)
"""Three arms at 120 degrees; channels 0, 2, 4 bend in the plane, 1, 3, 5 out of it."""

CHANNEL_ANGLES = Y_ELEMENT.arm_angles[[place.arm for place in _PLACES]]
"""Direction of the arm of every channel about z; shape (6,); rad."""
IN_PLANE = np.array([place.bending is Bending.IN_PLANE for place in _PLACES])
"""Whether a channel sees its arm bend in the plane; shape (6,)."""
