# SPDX-License-Identifier: BSD-3-Clause
"""Headings of tables that specify a unit, such as `fx [N]`, `time_s` or `elbow (rad)`; none is inferred for others."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

_BRACKETED = re.compile(r"^(?P<name>.*?)\s*[\[(](?P<unit>[^\[\]()]*)[\])]\s*$")
_SPELLINGS = {
    "n": "N",
    "mn": "mN",
    "kn": "kN",
    "nm": "N m",
    "n m": "N m",
    "n.m": "N m",
    "n-m": "N m",
    "n*m": "N m",
    "n·m": "N m",
    "nmm": "N mm",
    "n mm": "N mm",
    "n-mm": "N mm",
    "lbf": "lbf",
    "lbfin": "lbf in",
    "lbf in": "lbf in",
    "lbf-in": "lbf in",
    "lbfft": "lbf ft",
    "lbf ft": "lbf ft",
    "lbf-ft": "lbf ft",
    "kgf": "kgf",
    "gf": "gf",
    "kgfcm": "kgf cm",
    "kgf cm": "kgf cm",
    "kgf-cm": "kgf cm",
    "kgf*cm": "kgf cm",
    "rad": "rad",
    "deg": "deg",
    "°": "deg",
    "rad/s": "rad/s",
    "radps": "rad/s",
    "deg/s": "deg/s",
    "rad/s2": "rad/s2",
    "rad/s^2": "rad/s2",
    "m/s2": "m/s2",
    "m/s^2": "m/s2",
    "m/s²": "m/s2",
    "mps2": "m/s2",
    "m/s": "m/s",
    "m": "m",
    "mm": "mm",
    "g": "g",
    "s": "s",
    "sec": "s",
    "ms": "ms",
    "us": "us",
    "µs": "us",
    "ns": "ns",
    "a": "A",
    "ma": "mA",
    "pa": "Pa",
    "kpa": "kPa",
    "bar": "bar",
    "degc": "degC",
    "°c": "degC",
    "v": "V",
    "count": "counts",
    "counts": "counts",
}
"""How people write units, in small letters, and how experiment files do."""
_BEHIND_LOW_LINE = {
    "n",
    "mn",
    "kn",
    "nm",
    "nmm",
    "kgf",
    "gf",
    "kgfcm",
    "lbf",
    "lbfin",
    "lbfft",
    "rad",
    "deg",
    "radps",
    "mps2",
    "degc",
    "counts",
    "ms",
    "us",
    "ns",
    "ma",
    "pa",
    "kpa",
}
"""Spellings that are a unit behind a low line too: a single letter may be part of a name, as in `force_a`."""
_TIMES = {"s", "sec"}
_TIME_NAMES = {"t", "time", "stamp", "timestamp", "seconds"}


@dataclass(frozen=True, slots=True)
class Heading:
    """A heading of a table, taken apart."""

    text: str
    """As the table has it."""
    name: str
    """Without its unit."""
    unit: str | None
    """Unit that it states, as experiment files spell it; None for none."""
    bracketed: str | None = None
    """What stands in brackets at its end, a unit that is known or not; None without."""


def read_heading(text: str) -> Heading:
    """Take a heading apart.

    Args:
        text: As the table has it.

    Returns:
        Name and unit.
    """
    plain = _unquoted(text)
    short, inside = without_bracket(text)
    if inside is not None:
        unit = _SPELLINGS.get(inside.lower())
        return Heading(text, short if unit else plain, unit, inside)
    name, _, last = plain.rpartition("_")
    small = last.lower()
    # `_N` is newton and `_n` may be a number
    specified = small in _BEHIND_LOW_LINE and (small != "n" or last == "N")
    if name and (specified or (small in _TIMES and name.lower() in _TIME_NAMES)):
        return Heading(text, name, _SPELLINGS[small])
    return Heading(text, plain, None)


def without_bracket(text: str) -> tuple[str, str | None]:
    """Take the bracket at the end of a heading off, whether or not a unit is in it.

    Args:
        text: As the table has it.

    Returns:
        What is before it, and what is in it; None where there is none.
    """
    bracketed = _BRACKETED.match(_unquoted(text))
    return (_unquoted(text), None) if bracketed is None else (bracketed["name"], bracketed["unit"].strip())


def _unquoted(text: str) -> str:
    return text.strip().strip("\"'")  # some programs put headings in quotes, which readers take as they are


def headings_of(names: Sequence[str], units: Sequence[str]) -> tuple[str, ...] | None:
    """Make headings with units of a line of names and one of units.

    Args:
        names: Cells of the one line.
        units: Cells of the other.

    Returns:
        The headings; None where the lines are not that: names that come twice, or less than two units that are known.
    """
    known = [_SPELLINGS.get(unit.strip(" []()").lower()) for unit in units]
    if len(names) != len(units) or len(set(names)) < len(names) or "" in names or len(known) - known.count(None) < 2:
        return None
    return tuple(name if unit is None else f"{name} [{unit}]" for name, unit in zip(names, known, strict=True))


def named_columns(headings: Sequence[str]) -> tuple[str, ...]:
    """Name columns by their headings.

    Args:
        headings: Cells of the line of headings.

    Returns:
        The headings; the number of the column, from 1, for each that is empty.
    """
    return tuple(heading or str(k) for k, heading in enumerate(headings, start=1))


def repeated_heading_message(file: Path, line: int, headings: Sequence[str]) -> str:
    """Report that a heading comes twice.

    Args:
        file: The table.
        line: Line of the headings.
        headings: The headings, of which one does.

    Returns:
        Which, where, and what to do.
    """
    name = next(heading for heading in headings if heading and headings.count(heading) > 1)
    places = " and ".join(str(k) for k, heading in enumerate(headings, start=1) if heading == name)
    return (
        f"{file}:{line}: expected every heading once, got {name!r} in columns {places}; give each its own name there, "
        f"or specify skip_rows = {line} and column_names"
    )


def is_time_name(name: str) -> bool:
    """Check whether a column is called like a time.

    Args:
        name: Its name, without the unit.

    Returns:
        Whether it is.
    """
    return name.lower().strip(" #%") in _TIME_NAMES


def names_a_time(name: str) -> bool:
    """Check whether a word of a name is one for a time, as in `t_pose` or `imu.stamp`.

    Args:
        name: Its name, without the unit.

    Returns:
        Whether it is.
    """
    return not _TIME_NAMES.isdisjoint(re.split(r"[^a-z]+", name.lower()))
