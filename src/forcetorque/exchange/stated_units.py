# SPDX-License-Identifier: BSD-3-Clause
"""What an experiment file states of the columns of a signal: a quantity that recordings have, and its units."""

from __future__ import annotations

from collections.abc import Sequence

from forcetorque.errors import FormatError, UnitError, known_names
from forcetorque.recording import QUANTITIES, Labels, Quantity
from forcetorque.spatial import si_factor


def stated_quantity(name: str, *, where: str, columns: int) -> Quantity:
    """Find a quantity that has as many columns as are stated.

    Args:
        name: What the file calls it.
        where: Where it is stated, for messages.
        columns: Number of columns.

    Returns:
        The quantity.

    Raises:
        FormatError: If recordings have none of that name, or it has another number of columns.
    """
    quantity = QUANTITIES.get(name)
    if quantity is None:
        raise FormatError(f"{where}: {known_names(name, QUANTITIES)}; got {name!r}")
    if quantity.labels is Labels.FIXED and columns != len(quantity.columns):
        raise FormatError(
            f"{where}: {name}: expected {len(quantity.columns)} columns ({', '.join(quantity.columns)}), got {columns}"
        )
    return quantity


def units_in_si(
    quantity: Quantity, units: Sequence[str], *, where: str, columns: Sequence[object]
) -> list[tuple[str, float]]:
    """Bring the units of columns to those that a recording keeps.

    Args:
        quantity: What the columns are of; a scalar of any unit is taken as it stands.
        units: Unit of every column, as stated.
        where: Where they are stated, for messages.
        columns: What every column is called there.

    Returns:
        SI unit of every column, and the factor from what is stated.

    Raises:
        UnitError: If a unit is not known, or none of the quantity.
    """
    fixed = quantity.labels is Labels.FIXED
    if not fixed and not quantity.units:
        return [(unit, 1.0) for unit in units]
    factors = [si_factor(unit) for unit in units]
    for k, (unit, _) in enumerate(factors):
        allowed = (quantity.units[k],) if fixed else quantity.units
        if unit not in allowed:
            raise UnitError(
                f"{where}: column {columns[k]!r}: expected a unit of {quantity.name} that converts to "
                f"{' or '.join(allowed)}, got {units[k]!r}"
            )
    return factors
