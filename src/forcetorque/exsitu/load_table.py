# SPDX-License-Identifier: BSD-3-Clause
"""Tables of weights as CSV, units in the headings, and the one of thesis Table 6.1, which is bundled as geometry."""

from __future__ import annotations

import csv
import re
from importlib import resources
from pathlib import Path
from typing import Final

import numpy as np

from forcetorque.errors import FormatError, UnitError, known_names
from forcetorque.exsitu.loads import BenchLoads, Weights
from forcetorque.input_file import read_text
from forcetorque.spatial import MeasureDirection

THESIS_TABLE: Final = "thesis-6.1"
"""Name of the bundled table: direction and place of its 24 positions, not its printed labels, which follow no rule."""

_MASS_UNITS: Final = {"kg": 1.0, "g": 1e-3}
_LENGTH_UNITS: Final = {"m": 1.0, "mm": 1e-3, "cm": 1e-2}
_DIRECTION: Final = ("dx", "dy", "dz")
_GRAVITY: Final = re.compile(r"^# *gravity_m_per_s2 *: *(\S+) *$", re.MULTILINE)


def read_loads(source: Path | str, *, measure_direction: MeasureDirection) -> BenchLoads:
    """Read a table of weights: `# gravity_m_per_s2: 9.81`, a heading, and a row per position.

    The heading has `name`, `mass_kg`, `x_m y_m z_m`, `dx dy dz` (where gravity points in the sensor's frame), and may
    have `structure_kg` and `series`; masses may be in g, places in mm or cm, one unit for all three.

    Args:
        source: File, or `thesis-6.1` for the bundled table.
        measure_direction: Who acts on whom in the reading; the load is the child.

    Returns:
        The loads.

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If a line is not of this form.
    """
    if str(source) == THESIS_TABLE:
        where, text = "Table 6.1", resources.files("forcetorque.exsitu").joinpath("table_6_1.csv").read_text("utf-8")
    else:
        where, text = str(source), read_text(Path(source), f"a table of loads, or {THESIS_TABLE!r} for the bundled one")
    gravity = _GRAVITY.search(text)
    if gravity is None:
        raise FormatError(f"{where}: expected a line `# gravity_m_per_s2: 9.81` above the heading, got none")
    return _Table(where, text).loads(_number(f"{where}: gravity_m_per_s2", gravity[1]), measure_direction)


class _Table:
    """Rows of a table below its heading."""

    def __init__(self, where: str, text: str) -> None:
        self._where = where
        stated = [
            (line, [word.strip() for word in next(csv.reader([content]))])
            for line, content in enumerate(text.splitlines(), start=1)
            if content.strip() and not content.startswith("#")
        ]
        if len(stated) < 2:
            raise FormatError(f"{where}: expected a heading and a row per position, got {len(stated)} lines")
        (self._heading_line, self._heading), self._rows = stated[0], stated[1:]
        for line, words in self._rows:
            if len(words) != len(self._heading):
                raise FormatError(f"{where}:{line}: expected {len(self._heading)} fields, got {len(words)}")

    def loads(self, gravity: float, measure_direction: MeasureDirection) -> BenchLoads:
        """The table as loads."""
        mass, kilograms = self._with_unit("mass", _MASS_UNITS)
        structure = self._with_unit("structure", _MASS_UNITS, optional=True)
        axes = [self._with_unit(axis, _LENGTH_UNITS) for axis in "xyz"]
        if len({factor for _, factor in axes}) > 1:
            raise UnitError(
                f"{self._where}:{self._heading_line}: expected x, y and z in one unit, got "
                f"{', '.join(name for name, _ in axes)}"
            )
        weights = Weights(
            mass_kg=kilograms * self._column(mass),
            structure_kg=structure[1] * self._column(structure[0]) if structure[0] else np.zeros(len(self._rows)),
            position_m=axes[0][1] * np.column_stack([self._column(name) for name, _ in axes]),
            direction=np.column_stack([self._column(name) for name in _DIRECTION]),
            gravity=gravity,
        )
        series = self._words("series") if "series" in self._heading else ()
        return BenchLoads.of_weights(self._words("name"), weights, measure_direction=measure_direction, series=series)

    def _with_unit(self, name: str, units: dict[str, float], *, optional: bool = False) -> tuple[str, float]:
        headings = [word for word in self._heading if word.startswith(f"{name}_")]
        if optional and not headings:
            return "", 1.0
        unit = headings[0].removeprefix(f"{name}_") if len(headings) == 1 else ""
        if unit not in units:
            raise UnitError(
                f"{self._where}:{self._heading_line}: expected one column {' or '.join(f'{name}_{u}' for u in units)}, "
                f"got {', '.join(headings) or 'none'}"
            )
        return headings[0], units[unit]

    def _words(self, name: str) -> list[str]:
        if name not in self._heading:
            raise FormatError(
                f"{self._where}:{self._heading_line}: expected a column {name!r}; {known_names(name, self._heading)}"
            )
        place = self._heading.index(name)
        return [words[place] for _, words in self._rows]

    def _column(self, name: str) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
        words = zip(self._rows, self._words(name), strict=True)
        return np.array([_number(f"{self._where}:{line}: {name}", word) for (line, _), word in words])


def _number(where: str, word: str) -> float:
    try:
        number = float(word)
    except ValueError:
        number = np.nan
    if not np.isfinite(number):
        raise FormatError(f"{where}: expected a finite number, got {word!r}")
    return number
