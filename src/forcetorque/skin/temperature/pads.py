# SPDX-License-Identifier: BSD-3-Clause
"""Thermal pads: which work in a recording, which of them a taxel follows, and the gains that a calibration keeps."""

from __future__ import annotations

from typing import Final

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.stored_model import Part
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.taxels.health import taxel_ailments

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
    return ~sound_columns(counts) | ((change == 0.0) & (np.median(change) >= LEAST_CHANGE_COUNTS))


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
    return (own[:, None] == layout.thermal_modules) & alive


class ThermalGain(Part):
    """How a taxel follows one thermal pad."""

    pad: int = Field(ge=0)
    """Column of the pad."""
    gain: float
    """Counts of the taxel by count of the pad."""
    sd: float = Field(ge=0.0)
    """Standard deviation of the gain."""
    lag_s: float = 0.0
    """By how much the pad follows heat later than its taxels; negative where it follows sooner."""


class TaxelHeat(Part):
    """What heat does to a taxel; without gains it was not sound in the warm-up."""

    gains: tuple[ThermalGain, ...] = ()
    """One for each pad that it follows; what they tell is averaged."""
    misfit_counts: float | None = Field(default=None, ge=0.0)
    """What the pads leave of its change, their lags allowed for, root mean square of means of ten seconds."""
    unexplained_counts: float = Field(default=0.0, ge=0.0)
    """Most that is left of it, beyond noise, where pads are followed as they come: a fall of less is no contact."""
    rate_counts_per_s: float | None = Field(default=None, ge=0.0)
    """Its steepest change over a minute."""


class WarmUp(Part):
    """The recording without contact that gains were learned in."""

    experiment: str
    """Name of the experiment."""
    seconds: float = Field(gt=0.0)
    """Its length."""
    pad_change_counts: float = Field(gt=0.0)
    """Median change of the living thermal pads."""
    dead_pads: tuple[int, ...] = ()
    """Columns of thermal pads that tell nothing."""
    taxels: tuple[TaxelHeat, ...]
    """Taxels in the order of their columns."""
