# SPDX-License-Identifier: BSD-3-Clause
"""Noise that is white plus a slowly wandering offset, as drift, creep and a wrong model make it.

    cov(t, t') = s^2 (1 [t = t'] + ratio exp(-|t - t'| / time constant))

The second term is an Ornstein-Uhlenbeck process. Who takes neighbouring means for independent fits its wandering as if
it were load.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

from forcetorque.errors import FitError


@dataclass(frozen=True, slots=True, kw_only=True)
class SlowNoise:
    """Shape of the noise of means; its size s is another matter."""

    time_constant_s: float
    """How long the offset takes to forget itself; s; 0 where there is none."""
    ratio: float
    """Variance of the offset over that of the white part; 0 where there is none."""

    def __post_init__(self) -> None:
        if not (self.ratio >= 0.0 and self.time_constant_s >= 0.0) or (self.ratio > 0.0) != (
            self.time_constant_s > 0.0
        ):
            raise FitError(
                "slow noise: expected a time constant and a ratio above 0, or both 0, got "
                f"{self.time_constant_s:g} s and {self.ratio:g}"
            )

    @property
    def is_white(self) -> bool:
        """Whether there is no slow part."""
        return self.ratio == 0.0


CANDIDATES = (
    SlowNoise(time_constant_s=0.0, ratio=0.0),
    *(
        SlowNoise(time_constant_s=time, ratio=ratio)
        for time, ratio in product((2.0, 5.0, 15.0, 50.0, 200.0), (0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0))
    ),
)
"""Shapes that are tried, white noise first: what lasts shorter than 2 s averages out, what lasts longer than 200 s is
an offset to recordings of minutes."""
