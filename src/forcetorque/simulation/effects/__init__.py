# SPDX-License-Identifier: BSD-3-Clause
"""What spoils a real sensor's reading, each effect by itself: noise, temperature, creep, cross-talk, mounting."""

from forcetorque.simulation.effects.creep import Creep
from forcetorque.simulation.effects.crosstalk import Crosstalk
from forcetorque.simulation.effects.mounting import ScrewPattern, mounted
from forcetorque.simulation.effects.noise import Noise
from forcetorque.simulation.effects.thermal import ThermalDrift

__all__ = ["Creep", "Crosstalk", "Noise", "ScrewPattern", "ThermalDrift", "mounted"]
