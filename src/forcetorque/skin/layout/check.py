# SPDX-License-Identifier: BSD-3-Clause
"""Check a layout of skin: what is wrong with it, on which taxels, and what to do."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.experiment.named_files import stated_in
from forcetorque.results.number_text import counted
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Table
from forcetorque.skin.layout.defects import (
    duplicates,
    gaps,
    normal_directions,
    normal_lengths,
    off_template,
    overlaps,
    representatives,
)
from forcetorque.skin.layout.finding import LayoutFindingRow, PatchShape, shape_of
from forcetorque.skin.layout.formats.layout_table import write_layout_table
from forcetorque.skin.layout.layout import PatchDescription
from forcetorque.skin.layout.normals import patch_normals

_CHECKS: tuple[Callable[[PatchShape], Iterator[LayoutFindingRow]], ...] = (
    representatives,
    duplicates,
    off_template,
    overlaps,
    normal_lengths,
    normal_directions,
    gaps,
)


def shape_findings(shape: PatchShape) -> tuple[LayoutFindingRow, ...]:
    """Check a layout whose shape is known.

    Args:
        shape: Patch.

    Returns:
        Findings; none where it is valid.
    """
    return tuple(finding for check in _CHECKS for finding in check(shape))


_MOST = 6
"""Ranges of numbers that a table shows; JSON and CSV have all numbers."""


class SkinCheck(DrawnResult):
    """What is wrong with a layout of skin."""

    drawn_by: ClassVar[str] = "forcetorque.skin.figures:skin_layout_figure"
    drawn_fields: ClassVar[tuple[str, ...]] = ("positions", "normals")
    answered_by: ClassVar[str | None] = "forcetorque.skin.answers:skin_check_answer"

    schema_name: Literal["forcetorque/skin_check/1"] = Field(default="forcetorque/skin_check/1", alias="schema")
    """Form of the result."""
    source: str
    """File."""
    patch: str
    """Patch."""
    frame: str
    """Frame of positions and normals."""
    message_columns: int
    """Numbers in one message of counts."""
    taxels: int
    """Pressure taxels."""
    modules: int
    """Modules with taxels."""
    thermal_pads: int
    """Thermal pads."""
    findings: tuple[LayoutFindingRow, ...]
    """What is wrong."""
    positions: Annotated[FloatArray, ArrayField((None, 3))] = Field(exclude=True)
    """Taxels; shape (n, 3); m. For the figure."""
    repaired_file: str | None = Field(default=None, exclude=True, repr=False)
    """File of the layout with rebuilt normals; None where none was written."""
    description: PatchDescription = Field(exclude=True, repr=False)
    """What the file says, for `--repaired`."""
    normals: dict[str, Annotated[FloatArray, ArrayField((None, 3))]] = Field(exclude=True)
    """Normals `as written` and `rebuilt`, as far as there are any; shape (n, 3) each. For the figure."""

    @property
    def passed(self) -> bool:
        """Whether nothing is wrong."""
        return not self.findings

    def blocks(self) -> Iterator[Table | str]:
        """Give a table of findings, and a sentence for each.

        Yields:
            The table and sentences.
        """
        if self.findings:
            yield Table(
                caption=self.source,
                headings=("finding", "taxels", "which", "modules"),
                rows=tuple(
                    (row.defect, str(len(row.taxels)), _ranges(row.taxels), _ranges(row.modules))
                    for row in self.findings
                ),
            )
        for row in self.findings:
            yield f"{row.defect}: {row.message}. {row.remedy[:1].upper()}{row.remedy[1:]}."
        yield (
            f"{self.patch} in {self.frame}: {self.taxels} taxels on {self.modules} modules, {self.thermal_pads} "
            f"thermal pads, {self.message_columns} numbers in a message; {counted(len(self.findings), 'finding')}"
        )

    def columns(self) -> list[str]:
        """Name the columns of the CSV.

        Returns:
            The keys of a finding, also where there is none.
        """
        return list(LayoutFindingRow.model_fields)


def check_patch(patch: PatchDescription) -> SkinCheck:
    """Check what a file says of a patch.

    Args:
        patch: Patch.

    Returns:
        What is wrong with it.
    """
    shape = shape_of(patch)
    normals = {"as written": patch.normals, "rebuilt": shape.normals}
    return SkinCheck(
        source=patch.source,
        patch=patch.name,
        frame=patch.frame,
        message_columns=patch.columns,
        taxels=len(patch),
        modules=len(set(patch.modules.tolist())),
        thermal_pads=len(patch.thermal_pads),
        findings=shape_findings(shape),
        positions=patch.positions,
        description=patch,
        normals={name: values for name, values in normals.items() if values is not None},
    )


def save_repaired_layout(result: SkinCheck, path: Path) -> None:
    """Write a layout with normals that are rebuilt from its positions, as a table.

    Args:
        result: The layout, checked.
        path: File to write or to replace.
    """
    with stated_in(result.source):
        write_layout_table(path, result.description.layout(patch_normals(result.description)))


def _ranges(numbers: tuple[int, ...]) -> str:
    """Whole numbers as text, such as `0-5, 7`."""
    ranges: list[list[int]] = []
    for number in sorted(set(numbers)):
        if ranges and number == ranges[-1][1] + 1:
            ranges[-1][1] = number
        else:
            ranges.append([number, number])
    texts = [f"{first}" if first == last else f"{first}-{last}" for first, last in ranges]
    return ", ".join(texts[:_MOST]) + (", ..." if len(texts) > _MOST else "")
