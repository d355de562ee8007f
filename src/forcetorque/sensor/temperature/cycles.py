# SPDX-License-Identifier: BSD-3-Clause
"""Temperature cycles as means over windows, divided into heating and cooling."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, array, check_arrays, require_shape
from forcetorque.base.errors import FitError
from forcetorque.base.noise.slow_noise import Timeline
from forcetorque.base.noise.window_means import WINDOW_S, means_over

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
    """Compute the share of the range of temperature that was covered in both directions.

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


MEANS = 400.0
"""Means of a record: offsets that wander within half of it are then among the shapes of noise that are tried."""
_END = 5
"""Means at either end of a power-up that say how its temperature goes on."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Cycles(ArrayRecord):
    """Means of temperature and signals over windows, in one or several power-ups."""

    line: Timeline
    """When they were taken, in windows, by power-up."""
    window_s: float
    """Length of a window; s."""
    temperature_degC: FloatArray = field(metadata=array("m"))
    """Shape (m,); degC."""
    signals: FloatArray = field(metadata=array("m", None))
    """Shape (m, k)."""
    heating: FloatArray = field(metadata=array("m"))
    """1 while it is heated, -1 while it cools; shape (m,)."""
    settled: BoolArray = field(metadata=array("m", dtype="bool"))
    """Whether it is on one of the branches, not near a turn; shape (m,)."""
    cycles: float
    """Cycles of heating and cooling, of all power-ups together."""
    recorded: tuple[tuple[FloatArray, FloatArray], ...]
    """Instants, s, and temperatures, degC, of all means of every power-up, those near turns too."""

    def __post_init__(self) -> None:
        check_arrays(self)
        require_shape(self.temperature_degC, name="temperature_degC", shape=(len(self.line),))

    @property
    def time_s(self) -> FloatArray:
        """Instants; shape (m,); s."""
        return self.line.time_s * self.window_s

    def on_branches(self) -> Cycles:
        """Leave out what is near a turn, where the reading changes its branch.

        Returns:
            The other means.
        """
        kept = self.settled
        line = Timeline.of(self.line.time_s[kept], self.line.recording[kept], self.line.share[kept])
        return replace(
            self,
            line=line,
            temperature_degC=self.temperature_degC[kept],
            signals=self.signals[kept],
            heating=self.heating[kept],
            settled=kept[kept],
        )

    def temperature_after(self, lag_s: float) -> FloatArray:
        """Give the temperature that the thermometer reads later, continued evenly beyond the ends of a power-up.

        Args:
            lag_s: By how much later; s.

        Returns:
            Shape (m,); degC.
        """
        later, time_s = np.empty(len(self.line)), self.time_s + lag_s
        for number, (instants, degrees) in enumerate(self.recorded):
            mine = self.line.recording == number
            end = min(_END, len(instants) - 1)
            within = np.clip(time_s[mine], instants[0], instants[-1])
            before, after = np.minimum(time_s[mine] - within, 0.0), np.maximum(time_s[mine] - within, 0.0)
            later[mine] = np.interp(within, instants, degrees)
            later[mine] += before * (degrees[end] - degrees[0]) / (instants[end] - instants[0]) if end else 0.0
            later[mine] += (
                after * (degrees[-1] - degrees[-1 - end]) / (instants[-1] - instants[-1 - end]) if end else 0.0
            )
        return later

    @property
    def range_degC(self) -> float:
        """How far the temperature went; degC."""
        return float(np.ptp(self.temperature_degC))


def cycles_of(sessions: Sequence[tuple[Any, Any, Any]]) -> Cycles:
    """Average a record.

    Args:
        sessions: Of each power-up instants, shape (n,), s, not falling; temperatures, shape (n,), degC; and signals,
            shape (n, k); all finite.

    Returns:
        The means.

    Raises:
        FitError: If there are fewer than ten samples.
    """
    samples = sum(len(time) for time, _, _ in sessions)
    recorded = sum(float(time[-1] - time[0]) for time, _, _ in sessions if len(time))
    if samples < 10 or not recorded > 0.0:
        raise FitError(f"expected a record of at least ten samples, got {samples} over {recorded:.3g} s")
    window = max(WINDOW_S, recorded / MEANS)
    parts = [means_over(time, np.column_stack([degrees, signals]), window) for time, degrees, signals in sessions]
    means = np.concatenate([part[1] for part in parts])
    counts = np.concatenate([part[2] for part in parts])
    number = np.repeat(np.arange(len(parts)), [len(part[0]) for part in parts])
    threshold = TURN_SHARE * float(np.ptp(means[:, 0]))
    branches = [find_branches(part[1][:, 0], threshold) for part in parts]
    return Cycles(
        recorded=tuple((part[0], part[1][:, 0]) for part in parts),
        line=Timeline.of(
            np.concatenate([part[0] for part in parts]) / window, number, share=counts / np.median(counts)
        ),
        window_s=window,
        temperature_degC=means[:, 0],
        signals=means[:, 1:],
        heating=np.concatenate([branch.heating for branch in branches]),
        settled=np.concatenate([branch.settled for branch in branches]),
        cycles=sum(branch.cycles for branch in branches),
    )
