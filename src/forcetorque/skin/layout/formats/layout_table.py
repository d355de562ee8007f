# SPDX-License-Identifier: BSD-3-Clause
"""Layouts as a table: a row per taxel, columns whose names say their unit. The form that any skin can be written in."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import FormatError, UnitError
from forcetorque.base.output_file import write_bytes_atomically
from forcetorque.base.units import parsed_number, si_factor
from forcetorque.skin.layout.layout import PatchDescription, SkinLayout
from forcetorque.skin.layout.triangular_modules import LARGEST_MESSAGE

_PRESSURE, _THERMAL = "pressure", "thermal"
_HEAD = ("patch", "frame", "columns")
_NORMAL = ("nx", "ny", "nz")


class LayoutTable:
    """Lines `# patch: NAME`, `# frame: LINK` and `# columns: NUMBER`, a header, and a row per taxel or thermal pad.

    The header has `column`, `module`, `x_m y_m z_m` or `x_mm y_mm z_mm`, and may have `kind` (pressure, thermal) and
    `nx ny nz`. A thermal pad may lack position and normal.
    """

    sign = "a table with a header that begins with `column,module`"
    """What it is recognised by."""

    def recognises(self, text: str) -> bool:
        """Whether the file has the header."""
        return re.search(r"^column,\s*module\b", text, re.MULTILINE) is not None

    def read(self, path: Path, text: str) -> PatchDescription:
        """Read a file.

        Args:
            path: File.
            text: Its content.

        Returns:
            What it says.

        Raises:
            FormatError: If a line or the header is not of the form, or a column comes twice.
        """
        head = {key: _stated(path, text, key) for key in _HEAD}
        columns = _whole(f"{path}: # columns", head["columns"])
        if not 0 < columns <= LARGEST_MESSAGE:
            raise FormatError(f"{path}: # columns: expected 1 to {LARGEST_MESSAGE} numbers of a message, got {columns}")
        rows = _Rows(path, text)
        pressure = rows.kinds == _PRESSURE
        if not pressure.any():
            raise FormatError(f"{path}: expected rows of taxels below the header, got none")
        lines = np.zeros(columns, dtype=np.int64)
        for column, line in zip(rows.columns, rows.lines, strict=True):
            if not 0 <= column < columns:
                raise FormatError(
                    f"{path}:{line}: expected a column of 0 to {columns - 1}, got {column}; see # columns"
                )
            if lines[column]:
                raise FormatError(
                    f"{path}:{line}: expected each column once, got {column} of line {lines[column]} again"
                )
            lines[column] = line
        taxels, thermal = (np.flatnonzero(kind)[np.argsort(rows.columns[kind])] for kind in (pressure, ~pressure))
        return PatchDescription(
            source=str(path),
            name=head["patch"],
            frame=head["frame"],
            columns=columns,
            lines=lines,
            taxels=rows.columns[taxels],
            modules=rows.modules[taxels],
            positions=rows.numbers(taxels, rows.axes) * rows.factor,
            normals=rows.numbers(taxels, _NORMAL) if _NORMAL[0] in rows.names else None,
            thermal_pads=rows.columns[thermal],
            thermal_modules=rows.modules[thermal],
        )


class _Rows:
    """Rows of a table below its header, as they are written."""

    def __init__(self, path: Path, text: str) -> None:
        self._path = path
        stated = [
            (line, next(csv.reader([content], skipinitialspace=True)))
            for line, content in enumerate(text.splitlines(), start=1)
            if content.strip() and not content.startswith("#")
        ]
        self._header_line, self.names = stated[0]
        self.axes, self.factor = self._positions()
        if len(set(self.names)) < len(self.names) or 0 < sum(name in self.names for name in _NORMAL) < len(_NORMAL):
            raise self._refused("each column once, and nx, ny and nz or none of them")
        self._rows = [self._row(line, words) for line, words in stated[1:]]
        self.lines = [line for line, _ in stated[1:]]
        self.columns = self._whole_numbers("column")
        self.modules = self._whole_numbers("module")
        self.kinds = self._kinds()

    def numbers(self, rows: IntArray, names: Sequence[str]) -> FloatArray:
        """Finite numbers of some rows and columns; shape (n, 3)."""
        return np.array([[self._number(int(k), name) for name in names] for k in rows]).reshape(-1, len(names))

    def _positions(self) -> tuple[tuple[str, ...], float]:
        units = {name[2:] for name in self.names if re.match(r"[xyz]_", name)}
        if len(units) == 1 and all(f"{axis}_{unit}" in self.names for axis in "xyz" for unit in units):
            (unit,) = units
            si, factor = si_factor(unit)
            if si == "m":
                return tuple(f"{axis}_{unit}" for axis in "xyz"), factor
        raise UnitError(
            f"{self._path}:{self._header_line}: expected columns of positions with their unit, x_m y_m z_m or x_mm "
            f"y_mm z_mm, got {', '.join(self.names)}"
        )

    def _refused(self, expected: str) -> FormatError:
        return FormatError(f"{self._path}:{self._header_line}: expected {expected}, got {', '.join(self.names)}")

    def _row(self, line: int, words: list[str]) -> dict[str, str]:
        if len(words) != len(self.names):
            raise FormatError(f"{self._path}:{line}: expected {len(self.names)} fields, got {len(words)}")
        return dict(zip(self.names, (word.strip() for word in words), strict=True))

    def _whole_numbers(self, name: str) -> IntArray:
        pairs = zip(self.lines, self._rows, strict=True)
        return np.array([_whole(f"{self._path}:{line}: {name}", row[name]) for line, row in pairs], dtype=np.int64)

    def _kinds(self) -> np.ndarray[tuple[int], np.dtype[np.str_]]:
        kinds = [row.get("kind", _PRESSURE) for row in self._rows]
        for line, kind in zip(self.lines, kinds, strict=True):
            if kind not in (_PRESSURE, _THERMAL):
                raise FormatError(f"{self._path}:{line}: kind: expected {_PRESSURE} or {_THERMAL}, got {kind!r}")
        return np.array(kinds, dtype=np.str_)

    def _number(self, row: int, name: str) -> float:
        number = parsed_number(self._rows[row][name])
        if not np.isfinite(number):
            raise FormatError(
                f"{self._path}:{self.lines[row]}: {name} of taxel {self.columns[row]}: expected a finite number, got "
                f"{self._rows[row][name]!r}"
            )
        return number


def write_layout_table(path: Path | str, layout: SkinLayout) -> None:
    """Write a layout as a table, which reads back bit by bit.

    Args:
        path: File to write or to replace.
        layout: Layout.
    """
    text = io.StringIO()
    for key, value in zip(_HEAD, (layout.name, layout.frame, layout.columns), strict=True):
        text.write(f"# {key}: {value}\n")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["column", "module", "kind", "x_m", "y_m", "z_m", *_NORMAL])
    for column, module, position, normal in zip(
        layout.taxels, layout.modules, layout.positions.tolist(), layout.normals.tolist(), strict=True
    ):
        writer.writerow([column, module, _PRESSURE, *map(repr, position), *map(repr, normal)])
    for column, module in zip(layout.thermal_pads, layout.thermal_modules, strict=True):
        writer.writerow([column, module, _THERMAL, *[""] * 6])
    write_bytes_atomically(Path(path), text.getvalue().encode("utf-8"))


def _stated(path: Path, text: str, key: str) -> str:
    match = re.search(rf"^# *{key} *: *(\S+) *$", text, re.MULTILINE)
    if match is None:
        raise FormatError(f"{path}: expected a line `# {key}: ...` above the header, got none; see docs/skin/layout.md")
    return match[1]


def _whole(where: str, word: str) -> int:
    try:
        return int(word)
    except ValueError:
        raise FormatError(f"{where}: expected a whole number, got {word!r}") from None
