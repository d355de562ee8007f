# SPDX-License-Identifier: BSD-3-Clause
"""From counts of taxels to pressure: which taxels are sound, how they respond, and what that is worth."""

from forcetorque.skin.taxels.curve import CurveKind, TaxelCurve, fit_curve
from forcetorque.skin.taxels.cycle import PressureCycle, pressure_cycle
from forcetorque.skin.taxels.health import Ailment, taxel_ailments
from forcetorque.skin.taxels.response import TaxelResponse, taxel_response

__all__ = [
    "Ailment",
    "CurveKind",
    "PressureCycle",
    "TaxelCurve",
    "TaxelResponse",
    "fit_curve",
    "pressure_cycle",
    "taxel_ailments",
    "taxel_response",
]
