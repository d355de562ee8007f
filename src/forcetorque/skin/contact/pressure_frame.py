# SPDX-License-Identifier: BSD-3-Clause
"""From counts to frames of pressure at one instant."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from typing import Final, Self

import numpy as np

from forcetorque.base.arrays import (
    ArrayRecord,
    BoolArray,
    FloatArray,
    array,
    check_arrays,
    require_last_axis,
    require_shape,
)
from forcetorque.base.errors import SkinError
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.taxels.patch_calibration_and_pressure_table import PressureTable
from forcetorque.skin.temperature.taxel_temperature_drift import TaxelDrift


def _none() -> BoolArray:
    return np.zeros(0, dtype=np.bool_)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PressureFrame:
    """Pressures of one instant and what they are worth; n taxels, in the order of the layout."""

    pressures: FloatArray
    """Pressure on each taxel; of taxels that are not live any number; shape (n,); Pa."""
    active: BoolArray
    """Taxels that feel something; shape (n,)."""
    live: BoolArray = field(default_factory=_none)
    """Taxels that can be trusted; all by default; shape (n,)."""
    beyond_range: BoolArray = field(default_factory=_none)
    """Taxels that read more than they were calibrated for; none by default; shape (n,)."""
    sd_Pa: FloatArray = field(default_factory=partial(np.zeros, 0))
    """Standard deviation of each pressure, from noise and calibration; 0 by default; shape (n,)."""
    hysteresis_Pa: FloatArray = field(default_factory=partial(np.zeros, 0))
    """How much more each reads while pressure is taken off than while it is put on; 0 by default; shape (n,)."""
    drift_Pa: FloatArray = field(default_factory=partial(np.zeros, 0))
    """How much heat through a contact may add to each; NaN, not known, by default; shape (n,)."""

    def __post_init__(self) -> None:
        count = len(self.pressures)
        if not len(self.live):
            object.__setattr__(self, "live", np.ones(count, dtype=np.bool_))
        if not len(self.beyond_range):
            object.__setattr__(self, "beyond_range", np.zeros(count, dtype=np.bool_))
        for name in ("sd_Pa", "hysteresis_Pa"):
            if not len(getattr(self, name)):
                object.__setattr__(self, name, np.zeros(count))
        if not len(self.drift_Pa):
            object.__setattr__(self, "drift_Pa", np.full(count, np.nan))
        for name in ("pressures", "active", "live", "beyond_range", "sd_Pa", "hysteresis_Pa", "drift_Pa"):
            require_shape(getattr(self, name), name=name, shape=(count,))
        felt = np.where(self.live, self.pressures, 0.0)
        if not np.isfinite(felt).all():
            raise SkinError(
                f"pressures: expected finite numbers of live taxels, got {felt[~np.isfinite(felt)][0]} at the "
                f"{np.flatnonzero(~np.isfinite(felt))[0]}th from 0 of the layout; leave that taxel out by live"
            )
        object.__setattr__(self, "pressures", felt)
        object.__setattr__(self, "active", self.active & self.live)


WAKING: Final = 3.8
"""Fall over its standard deviation from which a taxel feels something: of 14 000 idle ones, one does by chance."""
_ROUNDING: Final = 1.0 / np.sqrt(12.0)
"""Standard deviation of what rounding to whole counts leaves; counts."""
_FEWEST_AT_REST: Final = 10
"""Messages that show rest and noise."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PatchReader(ArrayRecord):
    """What turns the counts of one patch, since it was last switched on, into pressures; n taxels."""

    table: PressureTable
    """Pressures by counts below rest."""
    rest: FloatArray = field(metadata=array("columns"))
    """Counts of a message at rest; shape (columns,)."""
    noise: FloatArray = field(metadata=array("columns"))
    """Standard deviation of one message from the next at rest, of each column; shape (columns,); counts."""
    rest_messages: int
    """Messages that `rest` is the mean of."""
    live: BoolArray = field(metadata=array("n", dtype="bool"))
    """Taxels that can be trusted; shape (n,)."""

    def __post_init__(self) -> None:
        require_shape(np.asarray(self.rest), name="rest", shape=(self.table.columns,))
        require_shape(np.asarray(self.live), name="live", shape=(len(self.table),))
        object.__setattr__(self, "live", np.asarray(self.live, dtype=np.bool_) & self.table.live)
        check_arrays(self)

    @classmethod
    def at_rest(cls, table: PressureTable, counts: FloatArray, *, live: BoolArray | None = None) -> Self:
        """Take rest and noise from messages while nothing touches the patch.

        Args:
            table: Its table.
            counts: Messages; shape (k, columns); counts.
            live: Taxels that can be trusted; all that have a table by default; shape (n,).

        Returns:
            The reader.

        Raises:
            SkinError: If there are too few messages.
        """
        require_last_axis(counts, name=f"patch {table.patch!r}: counts", length=table.columns)
        if counts.ndim != 2 or len(counts) < _FEWEST_AT_REST:
            raise SkinError(
                f"patch {table.patch!r}: counts at rest: expected at least {_FEWEST_AT_REST} messages, got "
                f"{len(np.atleast_2d(counts))}; take a longer time in which nothing touches the patch"
            )
        spread = counts.std(axis=0, ddof=1)
        return cls(
            table=table,
            rest=counts.mean(axis=0),
            noise=np.maximum(spread, _ROUNDING),
            rest_messages=len(counts),
            live=table.live if live is None else live,
        )

    def require_layout(self, layout: SkinLayout) -> None:
        """Refuse the layout of another patch.

        Args:
            layout: Layout.

        Raises:
            SkinError: If its taxels are not those of the table.
        """
        if layout.columns != self.table.columns or not np.array_equal(layout.taxels, self.table.taxels):
            raise SkinError(
                f"table of patch {self.table.patch!r}: expected the layout of its {len(self.table)} taxels in "
                f"{self.table.columns} columns, got {layout.name!r} with {len(layout)} in {layout.columns}; every "
                "patch has its own table, which is fitted with the layout stated in [[patch]]"
            )

    def frame(self, counts: FloatArray, *, drift: TaxelDrift | None = None) -> PressureFrame:
        """Read one message, or the mean of several.

        Args:
            counts: A message, shape (columns,), or messages that are averaged, shape (k, columns); counts.
            drift: What of that is no pressure; nothing if None.

        Returns:
            Pressures, and which taxels feel something.
        """
        number = len(counts) if counts.ndim == 2 else 1
        table = self.table
        fall = table.fall(counts if counts.ndim == 1 else counts.mean(axis=0), self.rest)
        noise = self.noise[table.taxels] * np.sqrt(1.0 / number + 1.0 / self.rest_messages)
        if drift is not None:
            fall, noise = fall - drift.fall, np.hypot(noise, drift.sd)
        active = (fall > WAKING * noise) & self.live
        pressures, slopes = table.look_up(fall)
        return PressureFrame(
            pressures=pressures,
            active=active,
            live=self.live,
            beyond_range=active & (fall > table.range_counts),
            sd_Pa=np.sqrt((slopes * noise) ** 2 + (active * table.error) ** 2),
            hysteresis_Pa=active * np.minimum(table.hysteresis, pressures),
            drift_Pa=np.full(len(fall), np.nan) if drift is None else slopes * drift.limit,
        )
