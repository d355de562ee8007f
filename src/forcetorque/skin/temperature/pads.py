# SPDX-License-Identifier: BSD-3-Clause
"""Thermal pads: which are alive in a recording, and which of them a taxel follows."""

from __future__ import annotations

from typing import Final

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray
from forcetorque.skin.layout import SkinLayout
from forcetorque.skin.taxels import taxel_ailments

LEAST_CHANGE_COUNTS: Final = 4.0
"""Change of pads below which they tell nothing of gains: noise of means over a second then is 5 % of it; counts."""
LEAST_SHARE: Final = 0.3
"""Change of a pad, over the median of all, below which it is dead: gains of pads differ by a quarter, not by that."""


def sound_columns(counts: FloatArray) -> BoolArray:
    """Tell which columns are at no rail, nowhere jump or wrap, and are not noisy.

    Args:
        counts: Messages of taxels or pads; shape (n, c); counts.

    Returns:
        Whether each is; shape (c,).
    """
    never_judged = np.full(counts.shape[1], np.inf)
    return np.array([not reasons for reasons in taxel_ailments(counts, never_judged)], dtype=np.bool_)


def stuck_pads(counts: FloatArray) -> BoolArray:
    """Tell which thermal pads are dead in a recording: not sound, or at one number while others change.

    Args:
        counts: Messages of the pads; shape (n, t); counts.

    Returns:
        Whether each is; shape (t,).
    """
    change = np.ptp(counts, axis=0)
    stuck: BoolArray = ~sound_columns(counts) | ((change == 0.0) & (np.median(change) >= LEAST_CHANGE_COUNTS))
    return stuck


def followed_pads(layout: SkinLayout, alive: BoolArray) -> BoolArray:
    """Choose the pads that tell the heat of each taxel.

    They are the living ones of its module; where both are dead, those of the nearest module that has one.

    Args:
        layout: The patch.
        alive: Thermal pads that can be trusted, at least one; shape (t,).

    Returns:
        Whether each taxel follows each pad; shape (n, t).
    """
    modules = np.unique(layout.modules)
    centres = np.stack([layout.positions[layout.modules == module].mean(axis=0) for module in modules])
    has_pad = np.isin(modules, layout.thermal_modules[alive])
    distance = np.linalg.norm(centres[:, None] - centres[has_pad], axis=2)
    source = modules[has_pad][distance.argmin(axis=1)]
    own = source[np.searchsorted(modules, layout.modules)]
    follows: BoolArray = (own[:, None] == layout.thermal_modules) & alive
    return follows
