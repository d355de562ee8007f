# SPDX-License-Identifier: BSD-3-Clause
"""Calibrations and coefficients of linear variables as comma-separated text."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable
from pathlib import Path

from forcetorque.base.errors import FormatError
from forcetorque.base.files import write_bytes_atomically
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.experiment.calibration.artefact import Calibration


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
