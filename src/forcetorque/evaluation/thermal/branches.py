# SPDX-License-Identifier: BSD-3-Clause
"""Heating and cooling: where a temperature turns."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray

TURN_SHARE = 0.1
"""Share of the range by which a temperature has to go back before it has turned: less is noise of a thermometer, or a
fan that starts. So far from a turn, and by this share of the time between turns, the reading is taken to have changed
its branch: a thermometer that is late turns after it."""
LEAST_OVERLAP = 0.5
"""Share of the range that heating and cooling must both have gone through to be compared."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Branches:
    """Whether it was getting warmer or colder."""

    heating: FloatArray
    """1 while it is heated, -1 while it cools, of every mean; shape (m,)."""
    settled: BoolArray
    """Whether it is far enough from the temperature of a turn to be on one branch; shape (m,)."""
    turns: int
    """How often it turned."""

    @property
    def cycles(self) -> float:
        """Cycles of heating and cooling: one for two branches."""
        return 0.5 * (self.turns + 1)


def find_branches(temperature_degC: FloatArray, threshold_degC: float) -> Branches:
    """Divide a record where its temperature turns.

    Args:
        temperature_degC: Temperatures in the order of time; shape (m,); degC.
        threshold_degC: How far it has to go back to have turned; degC.

    Returns:
        The branches.
    """
    turns = _turning_points(temperature_degC.tolist(), threshold_degC)
    edges = np.array([0, *turns, len(temperature_degC) - 1])
    heating, settled = np.empty(len(temperature_degC)), np.ones(len(temperature_degC), dtype=bool)
    for first, last in zip(edges[:-1], edges[1:], strict=True):
        branch = temperature_degC[first : last + 1]
        heating[first : last + 1] = 1.0 if branch[-1] >= branch[0] else -1.0
        place = np.arange(first, last + 1)
        for turn in (k for k in (first, last) if k in turns):
            settled[first : last + 1] &= np.abs(branch - temperature_degC[turn]) > threshold_degC
            settled[first : last + 1] &= np.abs(place - turn) > TURN_SHARE * (last - first)
    return Branches(heating=heating, settled=settled, turns=len(turns))


def compared_share(temperature_degC: FloatArray, heating: FloatArray) -> float:
    """Tell how much of the range of temperature was gone through in both directions.

    Args:
        temperature_degC: Temperatures; shape (m,); degC.
        heating: 1 and -1, as of `Branches`; shape (m,).

    Returns:
        Share of the range.
    """
    up, down = temperature_degC[heating > 0.0], temperature_degC[heating < 0.0]
    extent = float(np.ptp(temperature_degC)) if len(temperature_degC) else 0.0
    if not len(up) or not len(down) or extent == 0.0:
        return 0.0
    return max(float(min(up.max(), down.max()) - max(up.min(), down.min())), 0.0) / extent


def _turning_points(temperature: list[float], threshold: float) -> list[int]:
    """Indices of extremes from which it went back by the threshold."""
    turns: list[int] = []
    highest = lowest = 0
    direction = 0
    for k, value in enumerate(temperature):
        highest = k if value > temperature[highest] else highest
        lowest = k if value < temperature[lowest] else lowest
        if direction >= 0 and value < temperature[highest] - threshold:
            turns += [highest] if direction else []
            direction, lowest, highest = -1, k, k
        elif direction <= 0 and value > temperature[lowest] + threshold:
            turns += [lowest] if direction else []
            direction, lowest, highest = 1, k, k
    return turns
