# SPDX-License-Identifier: BSD-3-Clause
"""From the pressures of taxels to a wrench on the link: one linear operator for each mask of live taxels."""

from forcetorque.skin.wrench.elements import SkinElements, skin_elements
from forcetorque.skin.wrench.kriging import kriging_operator
from forcetorque.skin.wrench.linear import linear_operator
from forcetorque.skin.wrench.operator import WrenchMethod, WrenchOperator
from forcetorque.skin.wrench.patch import SkinPatch
from forcetorque.skin.wrench.simple import simple_operator
from forcetorque.skin.wrench.thesis import thesis_operator

__all__ = [
    "SkinElements",
    "SkinPatch",
    "WrenchMethod",
    "WrenchOperator",
    "kriging_operator",
    "linear_operator",
    "simple_operator",
    "skin_elements",
    "thesis_operator",
]
