# SPDX-License-Identifier: BSD-3-Clause
"""Plans of iCub's patches: `app/skinGui/conf/skinGui/*.ini` of icub-main, in the plane of a drawing."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np

from forcetorque.base.errors import FormatError
from forcetorque.base.input_file import read_text
from forcetorque.skin.layout.layout import PatchDescription
from forcetorque.skin.layout.modules import LARGEST_MESSAGE, MODULE_COLUMNS, modular_patch
from forcetorque.skin.layout.plan import PlannedModule, placed_on_paper

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
        """Look for a line of a module."""
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
