# SPDX-License-Identifier: BSD-3-Clause
"""What temperature does to a taxel: its drift with heat, and the compensation by gains from thermal pads."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum
from typing import Final, Self

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, IntArray, array
from forcetorque.base.errors import SkinError
from forcetorque.base.stored_table import StoredTable
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.taxels.taxel_faults import taxel_faults

LEAST_CHANGE_COUNTS: Final = 4.0
"""Change of pads below which they show nothing of gains: noise of means over a second then is 5 % of it; counts."""
LEAST_SHARE: Final = 0.3
"""Change of a pad, over the median of all, below which it is dead: gains of pads differ by a quarter, not by that."""


def valid_columns(counts: FloatArray) -> BoolArray:
    """Find the columns that are at no rail, do not jump or wrap, and are not noisy.

    Args:
        counts: Messages of taxels or pads; shape (n, c); counts.

    Returns:
        Whether each is; shape (c,).
    """
    never_judged = np.full(counts.shape[1], np.inf)
    return np.array([not reasons for reasons in taxel_faults(counts, never_judged)], dtype=np.bool_)


def stuck_pads(counts: FloatArray) -> BoolArray:
    """Find the dead thermal pads of a recording: faulty ones, and constant ones while others change.

    Args:
        counts: Messages of the pads; shape (n, t); counts.

    Returns:
        Whether each is; shape (t,).
    """
    change = np.ptp(counts, axis=0)
    return ~valid_columns(counts) | ((change == 0.0) & (np.median(change) >= LEAST_CHANGE_COUNTS))


def followed_pads(layout: SkinLayout, alive: BoolArray) -> BoolArray:
    """Choose the pads that measure the heat of each taxel.

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


class ThermalGain(StoredTable):
    """How a taxel follows one thermal pad."""

    pad: int = Field(ge=0)
    """Column of the pad."""
    gain: float
    """Counts of the taxel by count of the pad."""
    sd: float = Field(ge=0.0)
    """Standard deviation of the gain."""
    lag_s: float = 0.0
    """By how much the pad follows heat later than its taxels; negative where it follows sooner."""


class TaxelHeat(StoredTable):
    """What heat does to a taxel; without gains it was not valid in the warm-up."""

    gains: tuple[ThermalGain, ...] = ()
    """One for each pad that it follows; what they show is averaged."""
    misfit_counts: float | None = Field(default=None, ge=0.0)
    """What the pads leave of its change, their lags allowed for, root mean square of means of ten seconds."""
    unexplained_counts: float = Field(default=0.0, ge=0.0)
    """Most that is left of it, beyond noise, where pads are followed as they come: a fall of less is no contact."""
    rate_counts_per_s: float | None = Field(default=None, ge=0.0)
    """Its steepest change over a minute."""


class WarmUp(StoredTable):
    """The recording without contact that gains were estimated in."""

    experiment: str
    """Name of the experiment."""
    seconds: float = Field(gt=0.0)
    """Its length."""
    pad_change_counts: float = Field(gt=0.0)
    """Median change of the living thermal pads."""
    dead_pads: tuple[int, ...] = ()
    """Columns of thermal pads that show nothing."""
    taxels: tuple[TaxelHeat, ...]
    """Taxels in the order of their columns."""


class HeatRule(StrEnum):
    """How heat is taken out of readings."""

    LEARNED = "learned"
    """By a gain for every taxel from a warm-up, and a baseline of idle taxels."""
    FIRMWARE = "firmware"
    """The mean change of the pads of a module is subtracted from its taxels, thesis A.2.3."""
    NONE = "none"
    """Not at all."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class HeatGains(ArrayRecord):
    """How n taxels follow t thermal pads."""

    pads: IntArray = field(metadata=array("t", dtype="int"))
    """Columns of the pads; shape (t,)."""
    follows: BoolArray = field(metadata=array("n", "t", dtype="bool"))
    """Whether each taxel follows each pad; shape (n, t)."""
    gains: FloatArray = field(metadata=array("n", "t"))
    """Counts of the taxel by count of the pad; shape (n, t)."""
    sd: FloatArray = field(metadata=array("n", "t"))
    """Standard deviations of the gains; shape (n, t)."""
    rates: FloatArray = field(metadata=array("n"))
    """Steepest change by heat that was learned; NaN where none was; shape (n,); counts/s."""
    lags: FloatArray = field(metadata=array("t"))
    """Lag of each pad behind its taxels, negative where it leads; shape (t,); s."""
    unexplained: FloatArray = field(metadata=array("n"))
    """Most that pads, followed as they come, left of each taxel beyond noise; shape (n,); counts."""

    @classmethod
    def of_firmware(cls, layout: SkinLayout) -> Self:
        """Give the rule of the firmware: every taxel changes as the pads of its module do, gain 1.

        Args:
            layout: The patch.

        Returns:
            The gains.

        Raises:
            SkinError: If the patch has no thermal pads.
        """
        require_pads(layout)
        follows = followed_pads(layout, np.ones(len(layout.thermal_pads), dtype=np.bool_))
        return cls(
            pads=layout.thermal_pads,
            follows=follows,
            gains=follows.astype(np.float64),
            sd=np.zeros(follows.shape),
            rates=np.full(len(layout), np.nan),
            lags=np.zeros(follows.shape[1]),
            unexplained=np.zeros(len(layout)),
        )

    @classmethod
    def learned(cls, taxels: Sequence[TaxelHeat]) -> Self:
        """Take the gains of a warm-up.

        Args:
            taxels: What was estimated of each taxel, in their order.

        Returns:
            The gains.
        """
        pads = np.unique(np.array([gain.pad for taxel in taxels for gain in taxel.gains], dtype=np.int64))
        gains, sd = np.zeros((2, len(taxels), len(pads)))
        lags = np.zeros(len(pads))
        follows = np.zeros(gains.shape, dtype=np.bool_)
        for k, taxel in enumerate(taxels):
            columns = np.searchsorted(pads, [gain.pad for gain in taxel.gains])
            follows[k, columns] = True
            gains[k, columns] = [gain.gain for gain in taxel.gains]
            sd[k, columns] = [gain.sd for gain in taxel.gains]
            lags[columns] = [gain.lag_s for gain in taxel.gains]
        rates = [np.nan if taxel.rate_counts_per_s is None else taxel.rate_counts_per_s for taxel in taxels]
        return cls(
            pads=pads,
            follows=follows,
            gains=gains,
            sd=sd,
            rates=np.array(rates),
            lags=lags,
            unexplained=np.array([taxel.unexplained_counts for taxel in taxels]),
        )

    def without(self, dead: BoolArray) -> HeatGains:
        """Leave pads out that are dead in a recording.

        Args:
            dead: Which ones; shape (t,).

        Returns:
            The gains of the others.
        """
        return replace(self, follows=self.follows & ~dead)

    @property
    def has_pad(self) -> BoolArray:
        """Taxels that follow a pad; shape (n,)."""
        return np.asarray(self.follows.any(axis=1))

    def fall(self, pad_fall: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give what taxels read of heat: the mean of what their pads measure.

        Args:
            pad_fall: Counts of the pads below their rest; shape (t,).

        Returns:
            Counts below rest, 0 where a taxel follows no pad, and their standard deviation; shape (n,) each.
        """
        number = np.maximum(self.follows.sum(axis=1), 1)
        change = np.where(self.follows, pad_fall, 0.0)
        fall: FloatArray = (self.gains * change).sum(axis=1) / number
        # where a taxel does not follow its pads, those of one module err together: their number lowers nothing
        sd: FloatArray = (self.sd * np.abs(change)).sum(axis=1) / number
        return fall, sd

    def noise(self, pad_sd: FloatArray) -> FloatArray:
        """Give what noise of the pads makes of the drift of taxels.

        Args:
            pad_sd: Standard deviation of the fall of each pad, one independent of the other; shape (t,); counts.

        Returns:
            Standard deviation; shape (n,); counts.
        """
        number = np.maximum(self.follows.sum(axis=1), 1)
        return np.sqrt(((self.gains * np.where(self.follows, pad_sd, 0.0)) ** 2).sum(axis=1)) / number


def require_pads(layout: SkinLayout) -> None:
    """Refuse a patch without thermal pads.

    Args:
        layout: The patch.

    Raises:
        SkinError: If it has none.
    """
    if not len(layout.thermal_pads):
        raise SkinError(
            f"patch {layout.name!r}: thermal_pads: expected at least one, got none in its layout; without them heat "
            "cannot be separated from pressure"
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TaxelDrift(ArrayRecord):
    """Fall of n taxels that is known to be no pressure, and how much more may be none."""

    fall: FloatArray = field(metadata=array("n"))
    """Counts below rest that are no pressure; shape (n,)."""
    sd: FloatArray = field(metadata=array("n"))
    """Standard deviation of that; shape (n,); counts."""
    limit: FloatArray = field(metadata=array("n"))
    """Further counts that heat through a contact may add, which no pad measures; NaN if not known; shape (n,)."""
