# SPDX-License-Identifier: BSD-3-Clause
"""What the taxels of a patch say at one instant."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray, require_shape
from forcetorque.errors import SkinError


def _nothing() -> FloatArray:
    return np.zeros(0)


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
    sd_Pa: FloatArray = field(default_factory=_nothing)
    """Standard deviation of each pressure, from noise and calibration; 0 by default; shape (n,)."""
    hysteresis_Pa: FloatArray = field(default_factory=_nothing)
    """How much more each reads while pressure is taken off than while it is put on; 0 by default; shape (n,)."""
    drift_Pa: FloatArray = field(default_factory=_nothing)
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
