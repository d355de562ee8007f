# SPDX-License-Identifier: BSD-3-Clause
"""Linear variables: what moves the reading of a sensor beside the load, temperature first."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only
from forcetorque.base.errors import FitError


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LinearVariable:
    """A variable that a fit may add to the raw readings (thesis 5.9)."""

    name: str
    """Name, such as `temperature`."""
    unit: str
    """Unit."""
    reference_value: float | None = None
    """Value at which it contributes nothing; None to take that of the first sample."""
    prior: FloatArray | None = None
    """Coefficients to stay close to; shape (6,); N, N m per unit; None for no penalty."""
    prior_deviation: FloatArray | None = None
    """How far the coefficients may be from them; shape (6,); N, N m per unit; None for 0.5 % of full scale per degree,
    and for any other unit one full scale over the range that was seen. Only the generative model asks."""

    def __post_init__(self) -> None:
        if self.prior_deviation is not None:
            deviation = read_only(self.prior_deviation, name=f"variable {self.name!r}: prior_deviation", shape=(6,))
            if not (np.isfinite(deviation).all() and (deviation > 0.0).all()):
                raise FitError(
                    f"variable {self.name!r}: expected six prior deviations above 0, got {deviation.tolist()}"
                )
            object.__setattr__(self, "prior_deviation", deviation)
        if self.prior is not None:
            prior = read_only(self.prior, name=f"variable {self.name!r}: prior", shape=(6,))
            if not np.isfinite(prior).all():
                raise FitError(f"variable {self.name!r}: expected six finite prior coefficients, got {prior.tolist()}")
            object.__setattr__(self, "prior", prior)
        if self.reference_value is not None and not np.isfinite(self.reference_value):
            raise FitError(f"variable {self.name!r}: expected a finite reference value, got {self.reference_value}")
