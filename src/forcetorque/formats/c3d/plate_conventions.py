# SPDX-License-Identifier: BSD-3-Clause
"""What a C3D file may leave open about its force plates: units, and the sign of ORIGIN."""

from __future__ import annotations

import re
from collections.abc import Iterator
from enum import StrEnum
from pathlib import Path
from typing import Literal

from forcetorque.base.errors import FormatError
from forcetorque.base.units import SI_FACTORS
from forcetorque.formats.log_format import LogTable


class OriginFrom(StrEnum):
    """Where the vector in FORCE_PLATFORM:ORIGIN begins."""

    SENSOR = "sensor"
    """At the origin of the sensor; it ends at the centre of the surface, as the format defines it."""
    SURFACE = "surface"
    """At the centre of the surface; it ends at the origin of the sensor, as data sheets have it."""


class C3dLog(LogTable):
    """A C3D file with force plates."""

    format: Literal["c3d"]
    """Format of the recording."""
    path: Path
    """The file."""
    length_unit: Literal["m", "mm"] | None = None
    """Unit of corners, origins and markers, of a file without POINT:UNITS."""
    force_unit: Literal["N", "kN"] | None = None
    """Unit of forces, of plates for which the file states none."""
    moment_unit: Literal["N m", "N mm"] | None = None
    """Unit of moments, likewise."""
    origin_from: OriginFrom | None = None
    """Where ORIGIN begins, of plates whose ORIGIN does not have z below 0, as the format defines it: `sensor` where it
    is as defined, `surface` where it has the opposite sign."""


QUESTIONS = {
    "length_unit": "unit of corners, origins and markers, m or mm: POINT:UNITS states neither; mm where an edge of a "
    "plate is some hundreds",
    "force_unit": "unit of forces of the plates, N or kN: the file states none that is of a force",
    "moment_unit": "unit of moments of the plates, N m or N mm: the file states none that is of a moment",
    "origin_from": "where ORIGIN begins: the format defines it from the sensor to the surface, z below 0 as z points "
    "down, which is not so here; surface if it has the opposite sign, as data sheets have it, sensor if it is as "
    "defined",
}
"""Question for every key that a file may leave open."""


def stated_unit(text: str) -> str | None:
    """Give a unit by one of the spellings of C3D files.

    Args:
        text: As the file has it, such as `Nmm`, `N.mm` or `N*mm`.

    Returns:
        Its name in `SI_FACTORS`; None where it is none of a length, force or moment.
    """
    letters = re.sub(r"[\s.*·_-]", "", text)
    return next((unit for unit in ("m", "mm", "N", "kN", "N m", "N mm") if unit.replace(" ", "") == letters), None)


def factor_of(unit: str | None, dimension: str) -> float | None:
    """Give the factor of a unit.

    Args:
        unit: Name in `SI_FACTORS`; None for none.
        dimension: SI unit that it has to be of.

    Returns:
        Factor to that SI unit; None where the unit is of something else.
    """
    if unit is None or SI_FACTORS[unit][0] != dimension:
        return None
    return SI_FACTORS[unit][1]


def require_open(table: C3dLog, undetermined: set[str]) -> None:
    """Refuse keys that state what the file determines.

    Args:
        table: The table.
        undetermined: Keys that the file leaves open.

    Raises:
        FormatError: If a key is stated that the file determines.
    """
    for key in QUESTIONS:
        if getattr(table, key) is not None and key not in undetermined:
            raise FormatError(f"{table.path}: {key}: expected none, the file determines it; leave the key out")


def unanswered(table: C3dLog, undetermined: set[str]) -> Iterator[str]:
    """Give the keys that are still to be stated.

    Args:
        table: The table.
        undetermined: Keys that the file leaves open.

    Yields:
        Those that the table does not state.
    """
    yield from (key for key in QUESTIONS if key in undetermined and getattr(table, key) is None)
