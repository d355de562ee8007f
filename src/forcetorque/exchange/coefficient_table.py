# SPDX-License-Identifier: BSD-3-Clause
"""Coefficients of linear variables by themselves, for robots that store them apart from the matrix (thesis 5.5.3)."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable
from pathlib import Path

from forcetorque.atomic import write_bytes_atomically
from forcetorque.calibration import Calibration
from forcetorque.errors import FormatError
from forcetorque.spatial import WRENCH_COMPONENTS


def write_coefficient_table(path: Path | str, calibrations: Iterable[Calibration]) -> None:
    """Write one row per variable of every sensor; on any error the file keeps what it held before.

    A row holds sensor, serial, variable, unit, reference_value and what one unit above that value adds to
    fx fy fz (N) and tx ty tz (N m). Every number reads back exactly. A sensor without variables has no row:
    its coefficients are zero.

    Args:
        path: File to write or to replace, in an existing folder.
        calibrations: Calibrations.

    Raises:
        FormatError: If no calibration has a variable.
    """
    rows = [
        [c.sensor.name, c.sensor.serial, v.name, v.unit, v.reference_value, *v.coefficients.tolist()]
        for c in calibrations
        for v in c.variables
    ]
    if not rows:
        raise FormatError(f"{path}: expected a calibration with a linear variable such as temperature, got none")
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["sensor", "serial", "variable", "unit", "reference_value", *WRENCH_COMPONENTS])
    writer.writerows(rows)
    write_bytes_atomically(Path(path), text.getvalue().encode())
