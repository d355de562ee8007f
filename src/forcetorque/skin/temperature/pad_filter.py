# SPDX-License-Identifier: BSD-3-Clause
"""What thermal pads read, brought to the instant at which their taxels read the same heat, frame after frame."""

from __future__ import annotations

from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only

PADS_S: Final = 2.0
"""Time constant over which pads are averaged at least: their noise is common to ten taxels, and heat is slow; s."""
LATE_PADS: Final = 1.25
"""Time constant over which a pad that lags is averaged, over the square root of its lag; sqrt(s).

The trend that makes up for the lag then has the same noise whatever the lag."""


class PadFilter:
    """Follows t thermal pads: those that lead are held back, those that lag are continued along their trend.

    A first-order lag is made up for; until a trend is seen, which takes about `LATE_PADS` sqrt(lag), it is not.
    """

    def __init__(self, lags: FloatArray) -> None:
        """Begin with nothing.

        Args:
            lags: Lag of each pad behind its taxels, negative where it leads; shape (t,); s.
        """
        self.lags = read_only(lags, name="lags", shape=(None,))
        self._constants = np.maximum(PADS_S, np.where(lags > 0.0, LATE_PADS * np.sqrt(np.maximum(lags, 0.0)), -lags))
        self._once: FloatArray | None = None
        self._twice: FloatArray | None = None

    def follow(self, passed: float, now: FloatArray) -> FloatArray:
        """Take the next readings.

        Args:
            passed: Time since the ones before; s.
            now: Readings; shape (t,); counts.

        Returns:
            What the pads would read if they followed heat when their taxels do; shape (t,); counts.
        """
        if self._once is None or self._twice is None:
            self._once = self._twice = now
        share = self._share(passed)
        self._once = self._once + share * (now - self._once)
        self._twice = self._twice + share * (self._once - self._twice)
        ahead = self._once + (1.0 + self._lead(passed)) * (self._once - self._twice)
        return np.where(self.lags > 0.0, ahead, self._once)

    def noise(self, passed: float, sd: FloatArray) -> FloatArray:
        """Give the noise of what follows pads that lag; that of others is less than their own, and taken as none.

        Args:
            passed: Time from one reading to the next; s.
            sd: Standard deviation of each reading; shape (t,); counts.

        Returns:
            Standard deviation; shape (t,); counts.
        """
        share = self._share(passed)
        kept = 1.0 - (1.0 - share) ** 2
        once, twice = 2.0 + self._lead(passed), 1.0 + self._lead(passed)
        with np.errstate(divide="ignore", invalid="ignore"):
            variance = (
                once**2 * share**2 / kept
                - 2.0 * once * twice * share**3 / kept**2
                + twice**2 * share**4 * (2.0 - kept) / kept**3
            )
        return np.where((self.lags > 0.0) & (share > 0.0), sd * np.sqrt(np.maximum(variance, 0.0)), 0.0)

    def _share(self, passed: float) -> FloatArray:
        return -np.expm1(-passed / self._constants)

    def _lead(self, passed: float) -> FloatArray:
        """Lag of each pad, over the time by which one average is behind the other."""
        share = self._share(passed)
        behind = np.where(
            share > 0.0, passed * (1.0 - share) / np.maximum(share, np.finfo(float).tiny), self._constants
        )
        return np.maximum(self.lags, 0.0) / np.maximum(behind, np.finfo(float).tiny)
