# SPDX-License-Identifier: BSD-3-Clause
"""The gate before any fit: data that cannot come from a sensor under the modelled load are refused, or doubted."""

from forcetorque.calibration.gate.doubt import Doubt, DoubtKind
from forcetorque.calibration.gate.examine import examine
from forcetorque.calibration.gate.setup import ROBOT, WORKBENCH, Setup

__all__ = ["ROBOT", "WORKBENCH", "Doubt", "DoubtKind", "Setup", "examine"]
