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
    unit per count (`c0_per_count`, ...) and the offset in that unit: component = coefficients raw + offset. For a
    linear variable such as temperature it also holds the coefficient (`temperature_per_degC`) and the value at
    which it contributes nothing (`temperature_reference_degC`): component += coefficient (temperature - reference).
    Every number reads back exactly; what a sensor does not have leaves cells empty.

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
    variables = list(dict.fromkeys((v.name, v.unit) for calibration in chosen for v in calibration.variables))
    named = [text for name, unit in variables for text in (f"{name}_per_{unit}", f"{name}_reference_{unit}")]
    writer.writerow(["sensor", "serial", "component", "unit", *channels, "offset", *named])
    for calibration in chosen:
        sensor, matrix, offset = calibration.sensor, calibration.matrix.tolist(), calibration.offset.tolist()
        empty = [""] * (len(channels) - len(matrix[0]))
        own = {(v.name, v.unit): v for v in calibration.variables}
        for k, (component, unit) in enumerate(zip(WRENCH_COMPONENTS, WRENCH_UNITS, strict=True)):
            cells = [sensor.name, sensor.serial, component, unit, *matrix[k], *empty, offset[k]]
            for key in variables:
                cells += [float(own[key].coefficients[k]), own[key].reference_value] if key in own else ["", ""]
            writer.writerow(cells)
    write_bytes_atomically(Path(path), text.getvalue().encode())
