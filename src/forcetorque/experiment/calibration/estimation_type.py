# SPDX-License-Identifier: BSD-3-Clause
"""The nine estimation types of thesis 5.1.4, and what a fit estimates beside the matrix."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum
from functools import partial

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only
from forcetorque.base.errors import FitError, require_known
from forcetorque.experiment.calibration.sensor_model import LinearVariable


class OffsetStrategy(StrEnum):
    """How the offset gets out of the way of the matrix (thesis 5.1.2)."""

    SPHERE = "sphere"
    """In raw counts, from a motion in which gravity draws a sphere; then a fit without intercept."""
    CENTRALISED = "centralised"
    """The means of readings, variables and reference are taken off."""
    ONE_SHOT = "one-shot"
    """A constant is estimated together with the matrix; gives the same as `centralised` (theorem 5.1)."""


_INITIAL = {OffsetStrategy.SPHERE: "S", OffsetStrategy.CENTRALISED: "C", OffsetStrategy.ONE_SHOT: "O"}


@dataclass(frozen=True, slots=True, kw_only=True)
class EstimationType:
    """One of the nine: three offset strategies, each without variables, with them, and with their reference value."""

    offset: OffsetStrategy = OffsetStrategy.ONE_SHOT
    """How the offset is found."""
    with_variables: bool = False
    """Whether linear variables, temperature first, are fitted with the matrix."""
    from_reference: bool = False
    """Whether variables count from their reference value, else from zero."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "offset", OffsetStrategy(self.offset))
        if self.from_reference and not self.with_variables:
            raise FitError("estimation type: a reference value (rTO) belongs to a type with variables (wT), got nT")

    @property
    def name(self) -> str:
        """Name in the thesis: offset strategy, no or with temperature, without or with removal of its offset."""
        temperature = "wT" if self.with_variables else "nT"
        return f"{_INITIAL[self.offset]}{temperature}{'rTO' if self.from_reference else 'dTO'}"


ESTIMATION_TYPES = {
    kind.name: kind
    for kind in (
        EstimationType(offset=offset, with_variables=with_variables, from_reference=from_reference)
        for offset in OffsetStrategy
        for with_variables, from_reference in ((False, False), (True, False), (True, True))
    )
}
"""The nine types by name."""


def estimation_type(name: str) -> EstimationType:
    """Find an estimation type.

    Args:
        name: Its name in the thesis, such as `OwTrTO`.

    Returns:
        The type.

    Raises:
        FitError: If none is called so.
    """
    require_known(name, ESTIMATION_TYPES, FitError, f"no estimation type is called {name!r}")
    return ESTIMATION_TYPES[name]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Estimation:
    """Settings of a fit, the same for every lambda and every part of the data."""

    kind: EstimationType = EstimationType()
    """Offset strategy and use of variables."""
    prior: FloatArray | None = None
    """Matrix to stay close to; shape (6, c); N/count, N m/count; None only for lambda = 0."""
    variables: tuple[LinearVariable, ...] = ()
    """Variables of the data, in the order of their columns; types without variables leave them out."""
    reference_values: FloatArray = field(default_factory=partial(np.zeros, 0))
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
