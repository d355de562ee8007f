# SPDX-License-Identifier: BSD-3-Clause
"""Amplifiers with one gain and one offset per channel."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, read_only, require_last_axis
from forcetorque.errors import SensorError, ShapeError

_SAME_GAIN = 1e-6
"""Relative difference up to which a gain is one of the allowed ones: lists print a few digits."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Amplifier:
    """`output = amplifier_gain input + offset`, channel by channel; limits are those of what follows."""

    amplifier_gain: FloatArray
    """Gain of each channel, above zero; shape (c,)."""
    offset: FloatArray
    """Output without input; shape (c,); V."""
    allowed_gains: tuple[float, ...] | None = None
    """Gains that the electronics can be set to; any if left out."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "amplifier_gain", read_only(self.amplifier_gain, name="amplifier_gain", shape=(None,)))
        object.__setattr__(self, "offset", read_only(self.offset, name="offset", shape=(None,)))
        if self.offset.shape != self.amplifier_gain.shape:
            raise ShapeError(
                f"Amplifier: expected one offset per gain, got {len(self.offset)} and {len(self.amplifier_gain)}"
            )
        if not (np.isfinite(self.offset).all() and np.isfinite(self.amplifier_gain).all()):
            raise SensorError("Amplifier: expected finite gains and offsets in V")
        for channel, gain in enumerate(self.amplifier_gain):
            if not gain > 0.0:
                raise SensorError(f"Amplifier: channel {channel}: expected a gain above 0, got {gain:g}")
            if (
                self.allowed_gains is not None
                and not np.isclose(gain, self.allowed_gains, rtol=_SAME_GAIN, atol=0).any()
            ):
                known = ", ".join(f"{allowed:g}" for allowed in sorted(self.allowed_gains))
                raise SensorError(f"Amplifier: channel {channel}: gain {gain:g} is not one of {known}")

    def output(self, voltage: Any) -> FloatArray:
        """Amplify.

        Args:
            voltage: Voltages at the input; shape (..., c); V.

        Returns:
            Voltages at the output; same shape; V.

        Raises:
            ShapeError: If there is not one voltage per channel.
        """
        volts = np.asarray(voltage, dtype=np.float64)
        require_last_axis(volts, name="voltage", length=len(self.amplifier_gain))
        amplified: FloatArray = self.amplifier_gain * volts + self.offset
        return amplified

    def input(self, output: Any) -> FloatArray:
        """Give the input that an output tells.

        Args:
            output: Voltages at the output; shape (..., c); V.

        Returns:
            Voltages at the input; same shape; V.

        Raises:
            ShapeError: If there is not one voltage per channel.
        """
        volts = np.asarray(output, dtype=np.float64)
        require_last_axis(volts, name="output", length=len(self.amplifier_gain))
        before: FloatArray = (volts - self.offset) / self.amplifier_gain
        return before
