# SPDX-License-Identifier: BSD-3-Clause
"""What a fit estimates beside the matrix: how the offset goes, which variables count and from which values."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from forcetorque.arrays import FloatArray, read_only
from forcetorque.calibration.estimation_type import EstimationType, OffsetStrategy
from forcetorque.calibration.linear_variable import LinearVariable
from forcetorque.errors import FitError


def _no_values() -> FloatArray:
    return np.zeros(0)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Estimation:
    """Settings of a fit, the same for every lambda and every part of the data."""

    kind: EstimationType = EstimationType()
    """Offset strategy and use of variables."""
    prior: FloatArray | None = None
    """Matrix to stay close to; shape (6, c); N/count, N m/count; None only for lambda = 0."""
    variables: tuple[LinearVariable, ...] = ()
    """Variables of the data, in the order of their columns; types without variables leave them out."""
    reference_values: FloatArray = field(default_factory=_no_values)
    """Values at which the variables contribute nothing; shape (v,)."""
    raw_offset: FloatArray | None = None
    """Raw reading without load, for the sphere types; shape (c,); counts."""

    def __post_init__(self) -> None:
        variables = len(self.variables)
        values = read_only(self.reference_values, name="reference_values", shape=(variables,))
        object.__setattr__(self, "reference_values", values)
        if self.prior is not None:
            object.__setattr__(self, "prior", read_only(self.prior, name="prior", shape=(6, None)))
        if self.raw_offset is not None:
            object.__setattr__(self, "raw_offset", read_only(self.raw_offset, name="raw_offset", shape=(None,)))
        if self.kind.with_variables and not variables:
            raise FitError(f"type {self.kind.name}: expected a linear variable such as temperature, the data have none")
        if (self.kind.offset is OffsetStrategy.SPHERE) is (self.raw_offset is None):
            raise FitError(f"type {self.kind.name}: a raw offset belongs to the sphere types, which need it")
