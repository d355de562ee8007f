# SPDX-License-Identifier: BSD-3-Clause
"""Position files and plans of iCub's patches: `app/skinGui/conf` of icub-main."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import FormatError
from forcetorque.base.input_file import read_text
from forcetorque.base.units import parsed_numbers
from forcetorque.skin.layout.layout import PatchDescription
from forcetorque.skin.layout.triangular_modules import (
    LARGEST_MESSAGE,
    MODULE_COLUMNS,
    MODULE_THERMAL,
    PlannedModule,
    modular_patch,
    placed_on_paper,
)

_SIGN = "[calibration]"
_THERMAL_ENTRY = -2
"""What `taxel2Repr` has for a thermal pad."""


class IcubPositions:
    """Lines `name`, `spatial_sampling` and `taxel2Repr`, then a row x y z nx ny nz (m, link frame) per column.

    A row of zeros is no taxel: a thermal pad where its module has taxels, else a dummy. A column that `taxel2Repr`
    calls a thermal pad is one, independently of its row: its counts are no pressure. Where else the two disagree, rows
    are believed.
    """

    sign = "a text with the line [calibration]"
    """What it is recognised by."""

    def recognises(self, text: str) -> bool:
        """Whether the file has its line."""
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
        raise FormatError(f"{path}: expected a line `{key} ...` above {_SIGN}, got none; see docs/skin/layout.md")
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
    numbers = parsed_numbers(words)
    if len(numbers) != 6 or not np.isfinite(numbers).all():
        raise FormatError(f"{where}: expected six finite numbers x y z nx ny nz, got {' '.join(words)!r}")
    return numbers


PAPER = "u-v plane"
"""Frame of a patch that is only drawn."""
_MODULE = "triangle_10pad"
_MM = 1e-3


class SkinGuiPlan:
    """A line `robotPart`, then a line `triangle_10pad number X Y degrees gain mirror` per module; X and Y in mm.

    The patch lies in a plane: it is no layout of a link, but says how its modules are beside each other.
    """

    sign = f"a plan with lines {_MODULE}"
    """What it is recognised by."""

    def recognises(self, text: str) -> bool:
        """Whether the file has a line of a module."""
        return re.search(rf"^{_MODULE}\s", text, re.MULTILINE) is not None

    def read(self, path: Path, text: str) -> PatchDescription:
        """Read a file.

        Args:
            path: File.
            text: Its content.

        Returns:
            The patch in the plane of the drawing, with normals out of the link.
        """
        plan = planned_modules(path, text)
        return modular_patch(
            source=str(path),
            name=_part(path, text),
            frame=PAPER,
            modules=[module.number for module in plan],
            poses=placed_on_paper(plan),
            lines=[module.line for module in plan],
            mirrored=[False] * len(plan),  # its image is the board as it is seen from behind
        )


def read_plan(path: Path | str) -> tuple[PlannedModule, ...]:
    """Read the modules of a plan.

    Args:
        path: File of skinGui.

    Returns:
        The modules, in the order of the file.

    Raises:
        MissingFileError: If there is none.
        FormatError: If it is no text, or no such plan.
    """
    file = Path(path)
    return planned_modules(file, read_text(file, "a plan of a patch"))


def planned_modules(path: Path, text: str) -> tuple[PlannedModule, ...]:
    """Read the modules of a plan.

    Args:
        path: File, for messages.
        text: Its content.

    Returns:
        The modules, in the order of the file.

    Raises:
        FormatError: If a line is not of the form, is of a sensor that is no triangle, or repeats a module.
    """
    _, sign, body = text.partition("[SENSORS]")
    if not sign:
        raise FormatError(f"{path}: expected a section [SENSORS], got none")
    first = text[: text.index(sign)].count("\n") + 1
    modules: dict[int, PlannedModule] = {}
    for line, content in enumerate(body.split("\n"), start=first):
        words = content.partition("#")[0].split()
        if not words:
            continue
        module = _planned(f"{path}:{line}", line, words)
        if module.number in modules:
            raise FormatError(
                f"{path}:{line}: expected each module once, got {module.number} of line {modules[module.number].line} "
                "again; correct one of the two"
            )
        modules[module.number] = module
    if not modules:
        raise FormatError(f"{path}: expected lines {_MODULE} below [SENSORS], got none")
    return tuple(modules.values())


def _planned(where: str, line: int, words: list[str]) -> PlannedModule:
    if words[0] != _MODULE:
        raise FormatError(f"{where}: expected {_MODULE}, got {words[0]!r}, whose taxels are not known; leave it out")
    try:
        number, mirror = int(words[1]), int(words[6]) if len(words) > 6 else None
        u, v, degrees = (float(word) for word in words[2:5])
    except (ValueError, IndexError):
        number, mirror, u, v, degrees = -1, None, 0.0, 0.0, 0.0
    if (
        not 0 <= number < LARGEST_MESSAGE // MODULE_COLUMNS
        or mirror not in (0, 1)
        or not np.isfinite([u, v, degrees]).all()
    ):
        raise FormatError(f"{where}: expected {_MODULE} number X Y degrees gain mirror, got {' '.join(words)!r}")
    return PlannedModule(
        number=number, u_m=_MM * u, v_m=_MM * v, angle_rad=math.radians(degrees), mirrored=mirror == 1, line=line
    )


def _part(path: Path, text: str) -> str:
    match = re.search(r"^robotPart[ \t]+(\S+)", text, re.MULTILINE)
    if match is None:
        raise FormatError(f"{path}: expected a line `robotPart PATCH`, got none")
    return match[1]
