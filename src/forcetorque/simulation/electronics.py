# SPDX-License-Identifier: BSD-3-Clause
"""From strain to counts: gauge, bridge, amplifier and converter of one channel."""

from __future__ import annotations

from dataclasses import dataclass

from forcetorque.sensor.adc import Adc
from forcetorque.sensor.bridge import HALF_BRIDGE, Bridge
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
