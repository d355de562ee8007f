# SPDX-License-Identifier: BSD-3-Clause
"""A use that a sensor is meant for: the loads to come, and the error that is allowed there."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Final

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.errors import SensorError
from forcetorque.read_only_mapping import read_only_mapping

ALLOWED_SHARE: Final = 0.05
"""Error that is allowed where nobody states it, as a share of the loads: root mean square over root mean square."""
_LEAST_LEVER_M: Final = 1e-9
"""Lever below which a moment is rounding; m."""


class UseOffset(StrEnum):
    """What offset the readings of a use are taken with."""

    FITTED = "fitted"
    """That of the calibration: the sensor is used without being switched off."""
    TARED = "tared"
    """One that is taken anew just before use, under the load of the fitted data; readings are changes from there."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LoadCase:
    """Loads to come, as what they add to the mean load of the fitted data."""

    name: str
    """Name."""
    words: str
    """What the loads are, in words."""
    wrench: FloatArray
    """The loads, each as likely as any other, in the sensor's frame and direction; shape (n, 6); N, N m."""
    offset: UseOffset = UseOffset.FITTED
    """Offset that the readings are taken with."""
    changes: Mapping[str, float] = field(default_factory=dict)
    """How far variables such as temperature are from where the offset holds, root mean square, by name."""
    allowed_force_N: float | None = None
    """Root mean square of the force error that the use allows; None for a share of the loads."""
    allowed_moment_Nm: float | None = None
    """The same of the moment error."""
    is_stated: bool = True
    """Whether anybody stated it; else it is what is taken for granted."""

    def __post_init__(self) -> None:
        # a bare word would fail every `is`, and so read as the other one
        object.__setattr__(self, "offset", UseOffset(self.offset))
        object.__setattr__(self, "wrench", read_only(self.wrench, name=f"{self.name}: wrench", shape=(None, 6)))
        object.__setattr__(self, "changes", read_only_mapping(self.changes))
        if not len(self.wrench) or not np.isfinite(self.wrench).all() or not self.wrench.any():
            raise SensorError(f"load case {self.name!r}: expected loads of finite size, and not all of them zero")
        for unit, allowed in (("N", self.allowed_force_N), ("N m", self.allowed_moment_Nm)):
            if allowed is not None and not 0.0 < allowed < np.inf:
                raise SensorError(f"load case {self.name!r}: expected an allowed error above 0 {unit}, got {allowed:g}")

    @property
    def force_N(self) -> float:
        """Root mean square of the forces."""
        return _root_mean_square(self.wrench[:, :3])

    @property
    def moment_Nm(self) -> float:
        """Root mean square of the moments."""
        size = _root_mean_square(self.wrench[:, 3:])
        # a force through the sensor has a moment of rounding, of which nothing can be a share
        return size if size > _LEAST_LEVER_M * self.force_N else 0.0

    @property
    def states_requirement(self) -> bool:
        """Whether anybody stated what error is allowed."""
        return self.allowed_force_N is not None or self.allowed_moment_Nm is not None

    @property
    def requirement(self) -> tuple[float, float]:
        """Error that is allowed: of the force in N, of the moment in N m; infinite for what is not judged.

        Where nobody states any, both are `ALLOWED_SHARE` of the loads; where one is stated the other is free.
        """
        if not self.states_requirement:
            return ALLOWED_SHARE * self.force_N or np.inf, ALLOWED_SHARE * self.moment_Nm or np.inf
        force, moment = self.allowed_force_N, self.allowed_moment_Nm
        return np.inf if force is None else force, np.inf if moment is None else moment


def _root_mean_square(vectors: FloatArray) -> float:
    return float(np.sqrt((vectors**2).sum(axis=1).mean()))
