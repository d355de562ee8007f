# SPDX-License-Identifier: BSD-3-Clause
"""The nine estimation types of thesis 5.1.4: how the offset is found, and what becomes of linear variables."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from forcetorque.errors import FitError, known_names


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
    if name not in ESTIMATION_TYPES:
        raise FitError(f"no estimation type is called {name!r}; {known_names(name, ESTIMATION_TYPES)}")
    return ESTIMATION_TYPES[name]
