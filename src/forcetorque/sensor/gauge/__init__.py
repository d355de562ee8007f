# SPDX-License-Identifier: BSD-3-Clause
"""From strain, displacement or force to an electrical or optical signal (thesis 1.3)."""

from forcetorque.sensor.gauge.capacitive import ParallelPlates
from forcetorque.sensor.gauge.fibre_bragg import FibreBraggGrating
from forcetorque.sensor.gauge.materials import GAUGE_MATERIALS, GaugeMaterial
from forcetorque.sensor.gauge.optical import ReflectedIntensity
from forcetorque.sensor.gauge.piezoelectric import PiezoelectricGauge
from forcetorque.sensor.gauge.quartz import QuartzResonator
from forcetorque.sensor.gauge.resistive import ResistiveGauge

__all__ = [
    "GAUGE_MATERIALS",
    "FibreBraggGrating",
    "GaugeMaterial",
    "ParallelPlates",
    "PiezoelectricGauge",
    "QuartzResonator",
    "ReflectedIntensity",
    "ResistiveGauge",
]
