# SPDX-License-Identifier: BSD-3-Clause
"""Drift with temperature: linear, with a lag between gauges, and with hysteresis (thesis 4.3.3)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray, read_only, require_shape
from forcetorque.errors import ShapeError
from forcetorque.simulation.effects.lag import lagging


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ThermalDrift:
    """Change of every channel with the temperature of the sensor.

    Three parts add up: `slope (T - T0)`; a part proportional to the difference between gauges,
    which is the temperature minus a copy of it that lags by a time constant; and a play of a
    given width, so that heating and cooling take different paths.
    """

    slope: FloatArray
    """Linear part; shape (c,); counts/degC."""
    reference_degC: float
    """Temperature without drift; degC."""
    gradient_slope: FloatArray | None = None
    """Part with the difference between gauges; shape (c,); counts/degC; None for none."""
    lag_s: float = 60.0
    """Time constant of the gauges that follow later; s."""
    hysteresis_slope: FloatArray | None = None
    """Part with the play; shape (c,); counts/degC; None for none."""
    play_degC: float = 2.0
    """Half the width of the play; degC."""

    def __post_init__(self) -> None:
        slope = read_only(self.slope, name="slope", shape=(None,))
        object.__setattr__(self, "slope", slope)
        for field in ("gradient_slope", "hysteresis_slope"):
            values = getattr(self, field)
            if values is not None:
                object.__setattr__(self, field, read_only(values, name=field, shape=slope.shape))
        if not (self.lag_s > 0.0 and self.play_degC >= 0.0):
            raise ShapeError(
                f"thermal drift: expected lag_s > 0 and play_degC >= 0, got {self.lag_s}, {self.play_degC}"
            )

    def drift(self, temperature_degC: FloatArray, *, rate_hz: float) -> FloatArray:
        """Give the drift of evenly spaced samples.

        Args:
            temperature_degC: Temperature of the sensor; shape (n,); degC.
            rate_hz: Rate of the samples; Hz.

        Returns:
            What is added to every channel; shape (n, c); counts.
        """
        require_shape(temperature_degC, name="temperature_degC", shape=(None,))
        change = np.outer(temperature_degC - self.reference_degC, self.slope)
        if self.gradient_slope is not None:
            late = lagging(temperature_degC, self.lag_s, rate_hz=rate_hz)
            change = change + np.outer(temperature_degC - late, self.gradient_slope)
        if self.hysteresis_slope is not None:
            change = change + np.outer(self._play(temperature_degC) - self.reference_degC, self.hysteresis_slope)
        return change

    def _play(self, temperature: FloatArray) -> FloatArray:
        """Play operator: a follower that is pushed only when the temperature reaches the end of its play."""
        # while the temperature rises, or falls, the follower stays until it is pushed
        turns = np.flatnonzero(np.diff(np.sign(np.diff(temperature)))) + 2
        followed, position = [], temperature[0]
        for stretch in np.split(temperature, turns):
            followed.append(position.clip(stretch - self.play_degC, stretch + self.play_degC))
            position = followed[-1][-1]
        return np.concatenate(followed)
