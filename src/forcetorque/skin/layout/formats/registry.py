# SPDX-License-Identifier: BSD-3-Clause
"""The forms of layouts that are known: to add one, write its file and add its line to `LAYOUT_FORMATS`."""

from __future__ import annotations

from pathlib import Path
from typing import Protocol

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError, SkinError
from forcetorque.base.input_file import read_text
from forcetorque.skin.layout.formats.icub_skin_gui import IcubPositions, SkinGuiPlan
from forcetorque.skin.layout.formats.layout_table import LayoutTable
from forcetorque.skin.layout.formats.taxel_array import TaxelArrayMessage
from forcetorque.skin.layout.formats.urdf_frames import UrdfFrames
from forcetorque.skin.layout.layout import PatchDescription, SkinLayout
from forcetorque.skin.layout.normals import patch_normals

FARTHEST = 1e4
"""Largest coordinate of a taxel, m, and component of a normal; what is off by a unit is still smaller."""


class LayoutFormat(Protocol):
    """A form of layouts, recognised by the content of the file."""

    @property
    def sign(self) -> str:
        """What it is recognised by, for the message where nothing is."""

    def recognises(self, text: str) -> bool:
        """Check whether a file has this format.

        Args:
            text: Its content.

        Returns:
            Whether it is.
        """

    def read(self, path: Path, text: str) -> PatchDescription:
        """Read a file.

        Args:
            path: File.
            text: Its content.

        Returns:
            What it says, valid or not.
        """


LAYOUT_FORMATS: tuple[LayoutFormat, ...] = (
    IcubPositions(),
    SkinGuiPlan(),
    LayoutTable(),
    TaxelArrayMessage(),
    UrdfFrames(),
)
"""Forms of layouts, of which exactly one must recognise a file."""


def describe_patch(path: Path | str) -> PatchDescription:
    """Read what a file of any known form says of a patch, valid or not.

    Args:
        path: File.

    Returns:
        What it says.

    Raises:
        MissingFileError: If there is none.
        FormatError: If it is of no known form, or of several, or not what its form has.
    """
    file = Path(path)
    text = read_text(file, "a file with a layout of skin")
    known = [form for form in LAYOUT_FORMATS if form.recognises(text)]
    if len(known) != 1:
        signs = "; or ".join(form.sign for form in (known or LAYOUT_FORMATS))
        raise FormatError(f"{file}: expected {signs}; got {'several' if known else 'none of them'}")
    patch = known[0].read(file, text)
    _require_near(patch)
    return patch


def _require_near(patch: PatchDescription) -> None:
    """Refuse taxels farther off than any unit explains, and such normals: their distances would overflow."""
    for name, vectors in (("position, m,", patch.positions), ("normal", patch.normals)):
        if vectors is None:
            continue
        for taxel in np.flatnonzero((np.abs(vectors) > FARTHEST).any(axis=1))[:1]:
            column = patch.taxels[taxel]
            line = f":{patch.lines[column]}" if patch.lines[column] else ""
            raise FormatError(
                f"{patch.source}{line}: {name} of taxel {column}: expected numbers up to {FARTHEST:g}, got "
                f"{' '.join(f'{value:g}' for value in vectors[taxel])}; correct the file"
            )


def read_layout(path: Path | str, *, rebuild_normals: bool = False, outward: FloatArray | None = None) -> SkinLayout:
    """Read the layout of a patch, which must be valid.

    Args:
        path: File of any known form.
        rebuild_normals: Whether to find the normals from the positions instead of taking those of the file.
        outward: Rough outward direction in the link, for a flat patch without boards; shape (3,).

    Returns:
        The layout.

    Raises:
        SkinError: If it is not valid; `forcetorque skin check` lists the defects.
    """
    patch = describe_patch(path)
    try:
        return patch.layout(patch_normals(patch, outward) if rebuild_normals else None)
    except SkinError as error:
        raise SkinError(f"{path}: {error}") from error
