# SPDX-License-Identifier: BSD-3-Clause
"""Whether data show quadratic terms of a sensor, by the evidence of fits with and without them."""

from __future__ import annotations

from typing import Final

from forcetorque.base.stored_model import StoredTable

DECISIVE: Final = 20.0
"""Difference of deviance per channel from which a sensor is taken as linear: odds of e^10.

On simulated sensors without quadratic terms it is 34 to 75, on those of `icub-insitu`, which have some, 12 at most.
"""


class LinearityTest(StoredTable):
    """Evidence of two fits without an assumed error of the expected wrench, with quadratic terms and without."""

    channels: int
    """Number of channels."""
    quadratic_deviance: float
    """Minus twice the logarithm of the evidence of the fit with quadratic terms, less a constant."""
    linear_deviance: float
    """The same without them."""

    @property
    def is_linear(self) -> bool:
        """Whether the fit without quadratic terms is kept."""
        return self.quadratic_deviance - self.linear_deviance > DECISIVE * self.channels

    @property
    def message(self) -> str:
        """Which fit is kept, and by what evidence."""
        difference = (self.quadratic_deviance - self.linear_deviance) / self.channels
        kept = "without quadratic terms" if self.is_linear else "the default, with quadratic terms of the load"
        return (
            f"fit kept: {kept}; deviance per channel is {difference:+.1f} lower without them, decisive from "
            f"{DECISIVE:g} on"
        )
