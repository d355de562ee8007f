# SPDX-License-Identifier: BSD-3-Clause
"""Calibrations as a plain table, for whatever reads comma-separated text."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable
from pathlib import Path

from forcetorque.atomic import write_bytes_atomically
from forcetorque.calibration import Calibration
from forcetorque.errors import FormatError
from forcetorque.spatial import WRENCH_COMPONENTS, WRENCH_UNITS


def write_calibration_table(path: Path | str, calibrations: Iterable[Calibration]) -> None:
    """Write one row per component of every sensor; on any error the file keeps what it held before.

    A row holds sensor, serial, component, unit (N or N m), the coefficient of every raw channel in that
    unit per count (`c0_per_count`, ...) and the offset in that unit: component = coefficients raw + offset.
    Every number reads back exactly; a sensor with fewer channels than another leaves cells empty.

    Args:
        path: File to write or to replace, in an existing folder.
        calibrations: Calibrations.

    Raises:
        FormatError: If there is no calibration.
    """
    chosen = list(calibrations)
    if not chosen:
        raise FormatError(f"{path}: expected at least one calibration to write, got none")
    channels = [f"c{j}_per_count" for j in range(max(calibration.matrix.shape[1] for calibration in chosen))]
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["sensor", "serial", "component", "unit", *channels, "offset"])
    for calibration in chosen:
        sensor, matrix, offset = calibration.sensor, calibration.matrix.tolist(), calibration.offset.tolist()
        empty = [""] * (len(channels) - len(matrix[0]))
        for row, component, unit, constant in zip(matrix, WRENCH_COMPONENTS, WRENCH_UNITS, offset, strict=True):
            writer.writerow([sensor.name, sensor.serial, component, unit, *row, *empty, constant])
    write_bytes_atomically(Path(path), text.getvalue().encode())
