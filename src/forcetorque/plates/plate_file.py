# SPDX-License-Identifier: BSD-3-Clause
"""A C3D file whose force plates are all determined, by the file and by what is stated beside it."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FormatError
from forcetorque.base.toml_file import checked_tables
from forcetorque.formats.c3d.c3d_file import C3dFile
from forcetorque.formats.c3d.force_platform import EDGE_M, ForcePlate, force_plates
from forcetorque.formats.c3d.log_format import determined_file
from forcetorque.formats.c3d.plate_conventions import C3dLog, factor_of, stated_unit
from forcetorque.formats.specified_keys import specified_keys


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PlateFile:
    """Force plates of a C3D file."""

    file: C3dFile
    """The file."""
    table: C3dLog
    """What was stated beside it."""
    plates: tuple[ForcePlate, ...]
    """Its plates, at least one."""

    @property
    def time_s(self) -> FloatArray:
        """Instants of the samples of the plates from the first one; shape (n,); s."""
        return np.arange(len(self.file.analog), dtype=np.float64) / self.file.analog_rate_hz

    def plate(self, number: int | None) -> ForcePlate:
        """Find a plate.

        Args:
            number: Its number, from 1; None for the only one.

        Returns:
            The plate.

        Raises:
            ExperimentError: If there is no such plate, or there are several and none is named.
        """
        numbers = [plate.number for plate in self.plates]
        if number is None and len(numbers) == 1:
            return self.plates[0]
        if number not in numbers:
            got = "none" if number is None else str(number)
            raise ExperimentError(
                f"{self.file.path}: --plate: expected one of {', '.join(map(str, numbers))}, got {got}"
            )
        return self.plates[numbers.index(number)]


def read_plates(path: Path | str, stated: Collection[str] = ()) -> PlateFile:
    """Read the force plates of a C3D file.

    Args:
        path: The file.
        stated: What the file leaves open, each as `origin_from=surface`.

    Returns:
        File and plates.

    Raises:
        FormatError: If the file is damaged, has no plate, leaves something open that is not stated, or the unit of
            length that is stated makes no edge one of a plate.
    """
    content = {"format": "c3d", "path": Path(path), **specified_keys(stated)}
    table = checked_tables(content, C3dLog, Path(path))
    file = determined_file(Path(path), table)
    plates = force_plates(file, table)
    if not plates:
        raise FormatError(f"{path}: expected force plates, FORCE_PLATFORM:USED is 0: export the trial with its plates")
    _require_length_unit(file, table)
    return PlateFile(file=file, table=table, plates=plates)


def _require_length_unit(file: C3dFile, table: C3dLog) -> None:
    """Refuse a stated unit that no edge of a plate can have; a file without corners has none to compare."""
    if factor_of(stated_unit(file.length_unit), "m") is not None or table.length_unit is None:
        return
    factor, corners = factor_of(table.length_unit, "m"), file.numbers("FORCE_PLATFORM:CORNERS", 3, 4, None)
    if factor is None or corners is None or not corners.any():
        return
    edges = factor * np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=0)
    if not ((edges > EDGE_M[0]) & (edges < EDGE_M[1])).any():
        raise FormatError(
            f"{file.path}: --recording length_unit={table.length_unit}: expected edges of {EDGE_M[0]:g} to "
            f"{EDGE_M[1]:g} m between CORNERS, got {edges.min():g} to {edges.max():g} m: state the unit of the file"
        )
