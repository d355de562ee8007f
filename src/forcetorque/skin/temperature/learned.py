# SPDX-License-Identifier: BSD-3-Clause
"""What a calibration keeps of a warm-up: gains from thermal pads to taxels, and where they were learned."""

from __future__ import annotations

from pydantic import Field

from forcetorque.part import Part


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
