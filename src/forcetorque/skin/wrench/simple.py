# SPDX-License-Identifier: BSD-3-Clause
"""Every taxel stands for the same area, (7.13)."""

from __future__ import annotations

import math

import numpy as np

from forcetorque.arrays import BoolArray
from forcetorque.errors import SkinError
from forcetorque.skin.layout import SkinLayout
from forcetorque.skin.wrench.operator import WrenchMethod, WrenchOperator, summed_weights


def simple_operator(layout: SkinLayout, live: BoolArray, *, taxel_area_m2: float) -> WrenchOperator:
    """Let every live taxel press with its pressure on a stated area, along its normal.

    Args:
        layout: The patch.
        live: Taxels that count; shape (n,).
        taxel_area_m2: Area of a taxel.

    Returns:
        The operator.

    Raises:
        SkinError: If the area is not above 0.
    """
    if not 0.0 < taxel_area_m2 < math.inf:
        raise SkinError(f"taxel_area_m2: expected the area of a taxel above 0 m², got {taxel_area_m2:g}")
    taxels = np.flatnonzero(live)
    weights, areas = summed_weights(
        layout.positions[taxels],
        taxel_area_m2 * layout.normals[taxels],
        taxels[:, None],
        np.ones((len(taxels), 1)),
        len(layout),
    )
    return WrenchOperator(method=WrenchMethod.SIMPLE, live=live, weights=weights, areas=areas)
