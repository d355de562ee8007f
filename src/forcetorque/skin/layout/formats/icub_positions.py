# SPDX-License-Identifier: BSD-3-Clause
"""Position files of iCub's skin: `app/skinGui/conf/positions/*.txt` of icub-main."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import FormatError
from forcetorque.skin.layout.layout import PatchDescription
from forcetorque.skin.layout.modules import MODULE_COLUMNS, MODULE_THERMAL

_SIGN = "[calibration]"
_THERMAL_ENTRY = -2
"""What `taxel2Repr` has for a thermal pad."""


class IcubPositions:
    """Lines `name`, `spatial_sampling` and `taxel2Repr`, then a row x y z nx ny nz (m, link frame) per column.

    A row of zeros is no taxel: a thermal pad where its module has taxels, else a dummy. A column that `taxel2Repr`
    calls a thermal pad is one, whatever its row says: its counts are no pressure. Where else the two disagree, rows
    are believed.
    """

    sign = "a text with the line [calibration]"
    """What it is recognised by."""

    def recognises(self, text: str) -> bool:
        """Look for its line."""
        return _SIGN in text

    def read(self, path: Path, text: str) -> PatchDescription:
        """Read a file.

        Args:
            path: File; the patch is called like it.
            text: Its content.

        Returns:
            What it says.

        Raises:
            FormatError: If a line is not what the form has, or no row is a taxel.
        """
        head, _, body = text.partition(_SIGN)
        rows, lines = _rows(path, body, first_line=head.count("\n") + 1)
        entries = _representatives(path, head)
        columns = np.arange(len(rows))
        placed = rows.any(axis=1)
        taxel = placed & ~np.isin(columns, np.flatnonzero(entries == _THERMAL_ENTRY))
        if not taxel.any():
            raise FormatError(f"{path}: expected rows x y z nx ny nz of taxels below {_SIGN}, got none but zeros")
        sampling = _word(path, head, "spatial_sampling")
        if sampling != "taxel":
            raise FormatError(f"{path}: spatial_sampling: expected taxel, a row for each, got {sampling!r}")
        modules = columns // MODULE_COLUMNS
        thermal = ~taxel & np.isin(columns % MODULE_COLUMNS, MODULE_THERMAL) & np.isin(modules, modules[taxel])
        return PatchDescription(
            source=str(path),
            name=path.stem,
            frame=_word(path, head, "name"),
            columns=len(rows),
            lines=lines,
            taxels=columns[taxel],
            modules=modules[taxel],
            positions=rows[taxel, :3],
            normals=rows[taxel, 3:],
            thermal_pads=columns[thermal],
            thermal_modules=modules[thermal],
            representatives=entries,
            placed=columns[placed],
        )


def _word(path: Path, head: str, key: str) -> str:
    match = re.search(rf"^{key}[ \t]+(\S+)[ \t\r]*$", head, re.MULTILINE)
    if match is None:
        raise FormatError(f"{path}: expected a line `{key} ...` above {_SIGN}, got none; see docs/skin_layout.md")
    return match[1]


def _representatives(path: Path, head: str) -> IntArray:
    match = re.search(r"^taxel2Repr\s*\(([^)]*)\)", head, re.MULTILINE)
    if match is None:
        raise FormatError(f"{path}: expected a line `taxel2Repr ( ... )` above {_SIGN}, got none")
    try:
        return np.array([int(word) for word in match[1].split()], dtype=np.int64)
    except ValueError as error:
        raise FormatError(f"{path}: taxel2Repr: expected whole numbers, got {error}") from error


def _rows(path: Path, body: str, *, first_line: int) -> tuple[FloatArray, IntArray]:
    """Rows of six numbers, and the line of each."""
    stated = [(first_line + k, line.split()) for k, line in enumerate(body.split("\n")) if line.strip()]
    values = [_six(f"{path}:{line}", words) for line, words in stated]
    return np.array(values).reshape(-1, 6), np.array([line for line, _ in stated], dtype=np.int64)


def _six(where: str, words: list[str]) -> list[float]:
    try:
        numbers = [float(word) for word in words]
    except ValueError:
        numbers = []
    if len(numbers) != 6 or not np.isfinite(numbers).all():
        raise FormatError(f"{where}: expected six finite numbers x y z nx ny nz, got {' '.join(words)!r}")
    return numbers
