# SPDX-License-Identifier: BSD-3-Clause
"""Heat on skin: what thermal pads tell of it, learned in a warm-up or by the firmware's rule."""

from forcetorque.skin.temperature.drift import TaxelDrift
from forcetorque.skin.temperature.gains import HeatGains, HeatRule, require_pads
from forcetorque.skin.temperature.learned import TaxelHeat, ThermalGain, WarmUp
from forcetorque.skin.temperature.pad_filter import PadFilter
from forcetorque.skin.temperature.pads import followed_pads, stuck_pads
from forcetorque.skin.temperature.warm_up import fit_warm_up

__all__ = [
    "HeatGains",
    "HeatRule",
    "PadFilter",
    "TaxelDrift",
    "TaxelHeat",
    "ThermalGain",
    "WarmUp",
    "fit_warm_up",
    "followed_pads",
    "require_pads",
    "stuck_pads",
]
