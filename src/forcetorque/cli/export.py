# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque export`: from calibration files to the files that robots and other programs read."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field
from rich.table import Table

from forcetorque.arrays import FloatArray, require_shape
from forcetorque.atomic import STANDARD_OUTPUT, refuse_unwritable
from forcetorque.calibration import Calibration, read_calibration
from forcetorque.cli.output import (
    ExportFormat,
    Format,
    console,
    print_result,
    refuse_two_on_standard_output,
    start_logging,
    table,
)
from forcetorque.errors import ExperimentError, ForceTorqueError
from forcetorque.exchange.calibration_table import write_calibration_table
from forcetorque.exchange.coefficient_table import write_coefficient_table
from forcetorque.exchange.icub import encode_matrix, serial_number_in_name, write_matrix_file
from forcetorque.exchange.wholebodydynamics import from_calibration, write_groups
from forcetorque.experiment.inputs import stated_in
from forcetorque.paths import real_path
from forcetorque.spatial import WRENCH_COMPONENTS, WRENCH_UNITS

_OFFSET_HANDLING = {
    ExportFormat.ICUB_MATRIX: "not stored, a matrix file has no place for it: add it to what the sensor sends",
    ExportFormat.WHOLEBODYDYNAMICS: "stored as FT_OFFSET, which the device ADDS, and only after the RPC command "
    "usePreEstimatedOffset",
    ExportFormat.CSV: "stored: add it to the product of matrix and raw counts",
    ExportFormat.COEFFICIENTS: "not stored, the file is for the variables: store it with the matrix",
}


class ExportedCalibration(BaseModel):
    """What a file holds of one calibration; per component in the order fx fy fz (N) tx ty tz (N m)."""

    calibration: str
    """Path of the calibration file."""
    sensor: str
    """Name that the sensor has in the written file, or in the calibration where the file holds no name."""
    serial: str
    """Its serial number."""
    matrix: list[list[float]]
    """Matrix as the file's reader gets it: N/count and N m/count, for wholebodydynamics the secondary matrix."""
    offset: list[float]
    """Offset that goes with the matrix, to be added; N, N m."""
    offset_stored: bool
    """Whether the file holds the offset."""
    variables: dict[str, list[float]]
    """Coefficients of each linear variable that go with the matrix; N, N m per unit."""
    variables_stored: bool
    """Whether the file holds them."""
    full_scale: list[int] | None = None
    """icub-matrix: full scale; N, N m."""
    largest_rounding_error: list[float] | None = None
    """icub-matrix: largest error that rounding the matrix makes anywhere in the fitted raw range; N, N m."""


class ExportResult(BaseModel):
    """What `forcetorque export` wrote."""

    model_config = ConfigDict(populate_by_name=True)

    schema_name: Literal["forcetorque/export/1"] = Field(default="forcetorque/export/1", alias="schema")
    """Form of the result."""
    format: ExportFormat
    """Form of the file."""
    file: str
    """The file."""
    offset_handling: str
    """What becomes of the offset, in words."""
    calibrations: list[ExportedCalibration]
    """One per calibration file."""


def run(
    paths: list[Path],
    *,
    to: ExportFormat,
    output: Path,
    full_scale: Sequence[int] | None,
    sensor_name: str | None,
    stream: Path | None,
    output_format: Format,
) -> None:
    """Write calibrations in another program's format.

    Args:
        paths: Calibration files.
        to: Format of the file.
        output: File to write or to replace; `-` is standard output, which then takes no result.
        full_scale: Full scales for fx, fy, fz, tx, ty, tz of icub-matrix; N, N m; None to choose them.
        sensor_name: Name of the sensor for wholebodydynamics; that of the calibration if None.
        stream: Calibration that the robot's stream is already made with, for wholebodydynamics.
        output_format: Form of the result.
    """
    log = start_logging()
    _require_consistent(paths, to=to, full_scale=full_scale, sensor_name=sensor_name, stream=stream)
    _refuse_output(output, paths, output_format)
    loaded = {path: read_calibration(path) for path in paths}
    made_with = None if stream is None else read_calibration(stream)
    writers: dict[ExportFormat, Callable[[], list[ExportedCalibration]]] = {
        ExportFormat.ICUB_MATRIX: lambda: _to_icub_matrix(loaded, output, full_scale),
        ExportFormat.WHOLEBODYDYNAMICS: lambda: _to_wholebodydynamics(loaded, output, sensor_name, made_with),
        ExportFormat.CSV: lambda: _to_csv(loaded, output),
        ExportFormat.COEFFICIENTS: lambda: _to_coefficients(loaded, output),
    }
    result = ExportResult(format=to, file=str(output), offset_handling=_OFFSET_HANDLING[to], calibrations=writers[to]())
    for entry in result.calibrations:
        report = log.info if entry.offset_stored else log.warning
        report("%s: offset %s: %s", entry.calibration, _offset_text(entry.offset), result.offset_handling)
        if entry.variables and not entry.variables_stored:
            names = ", ".join(entry.variables)
            log.warning("%s: the coefficients of %s are not in this file: --to coefficients", entry.calibration, names)
        if to is ExportFormat.WHOLEBODYDYNAMICS and not any(entry.offset):
            log.warning("%s: the device ignores an FT_OFFSET of six zeros and keeps its own", entry.calibration)
    if output == STANDARD_OUTPUT:  # the file itself went there
        return
    rows = [row for entry in result.calibrations for row in _rows(entry)]
    print_result(result.model_dump(mode="json", by_alias=True), rows, output_format, show=lambda: _show(result))


def _require_consistent(
    paths: list[Path],
    *,
    to: ExportFormat,
    full_scale: Sequence[int] | None,
    sensor_name: str | None,
    stream: Path | None,
) -> None:
    if to is ExportFormat.ICUB_MATRIX and len(paths) != 1:
        raise ForceTorqueError(
            f"--to {to}: a file holds one matrix, got {len(paths)} calibrations; export each by itself"
        )
    if full_scale is not None and to is not ExportFormat.ICUB_MATRIX:
        raise ForceTorqueError(
            f"--full-scale: only files of --to {ExportFormat.ICUB_MATRIX} hold full scales, not {to}"
        )
    for_one = "--sensor-name" if sensor_name is not None else None if stream is None else "--stream"
    if for_one is not None and (to is not ExportFormat.WHOLEBODYDYNAMICS or len(paths) != 1):
        raise ForceTorqueError(
            f"{for_one}: expected --to {ExportFormat.WHOLEBODYDYNAMICS} and one calibration, "
            f"got --to {to} and {len(paths)}"
        )


def _refuse_output(output: Path, paths: Sequence[Path], output_format: Format) -> None:
    refuse_two_on_standard_output(output, output_format)
    refuse_unwritable(output)
    if real_path(output) in [real_path(path) for path in paths]:
        raise ForceTorqueError(f"--output {output}: expected another file, got a calibration that is to be exported")


def _to_icub_matrix(
    loaded: Mapping[Path, Calibration], output: Path, full_scale: Sequence[int] | None
) -> list[ExportedCalibration]:
    ((path, calibration),) = loaded.items()
    with stated_in(str(path)):
        if (serial := serial_number_in_name(output)) is not None:
            calibration.require_serial(serial)
        if calibration.prior is not None and calibration.prior.source == "identity":
            raise ExperimentError(
                'its prior is "identity": the matrix corrects a calibrated stream and is not per count; '
                "use --to wholebodydynamics"
            )
        file = encode_matrix(calibration.matrix, full_scale=full_scale)
        error = _largest_in_range(file.matrix - calibration.matrix, calibration)
    write_matrix_file(output, file)
    entry = _entry(path, calibration, matrix=file.matrix, offset_stored=False, variables_stored=False)
    rounding = {"full_scale": list(file.full_scale), "largest_rounding_error": error.tolist()}
    return [entry.model_copy(update=rounding)]


def _largest_in_range(matrix: FloatArray, calibration: Calibration) -> FloatArray:
    """Largest value of each row of a matrix times any raw reading within the fitted range of every channel."""
    low, high = calibration.validity.raw_minimum_counts, calibration.validity.raw_maximum_counts
    for name, limits in (("raw_minimum_counts", low), ("raw_maximum_counts", high)):
        require_shape(limits, name=name, shape=(matrix.shape[1],))
    ends = np.stack([matrix * low, matrix * high])  # (2, 6, c)
    largest: FloatArray = np.maximum(ends.max(axis=0).sum(axis=1), -ends.min(axis=0).sum(axis=1))
    return largest


def _to_wholebodydynamics(
    loaded: Mapping[Path, Calibration], output: Path, sensor_name: str | None, stream: Calibration | None
) -> list[ExportedCalibration]:
    corrections = {}
    for path, calibration in loaded.items():
        with stated_in(str(path)):
            corrections[path] = from_calibration(calibration, sensor_name=sensor_name, stream=stream)
    write_groups(output, corrections.values())
    entries = []
    for path, one in corrections.items():
        entry = _entry(path, loaded[path], matrix=one.secondary_matrix, sensor=one.sensor, offset=one.offset)
        if one.temperature_coefficients is not None:
            coefficients = dict.fromkeys(entry.variables, one.temperature_coefficients.tolist())
            entry = entry.model_copy(update={"variables": coefficients})
        entries.append(entry)
    return entries


def _to_csv(loaded: Mapping[Path, Calibration], output: Path) -> list[ExportedCalibration]:
    write_calibration_table(output, loaded.values())
    return [_entry(path, one, matrix=one.matrix) for path, one in loaded.items()]


def _to_coefficients(loaded: Mapping[Path, Calibration], output: Path) -> list[ExportedCalibration]:
    write_coefficient_table(output, loaded.values())
    return [_entry(path, one, matrix=one.matrix, offset_stored=False) for path, one in loaded.items()]


def _entry(
    path: Path,
    calibration: Calibration,
    *,
    matrix: FloatArray,
    sensor: str | None = None,
    offset: FloatArray | None = None,
    offset_stored: bool = True,
    variables_stored: bool = True,
) -> ExportedCalibration:
    return ExportedCalibration(
        calibration=str(path),
        sensor=calibration.sensor.name if sensor is None else sensor,
        serial=calibration.sensor.serial,
        matrix=matrix.tolist(),
        offset=(calibration.offset if offset is None else offset).tolist(),
        offset_stored=offset_stored,
        variables={variable.name: variable.coefficients.tolist() for variable in calibration.variables},
        variables_stored=variables_stored,
    )


def _offset_text(offset: list[float]) -> str:
    force, moment = (", ".join(f"{value:.4g}" for value in half) for half in (offset[:3], offset[3:]))
    return f"({force}) N, ({moment}) N m"


def _rows(entry: ExportedCalibration) -> list[dict[str, object]]:
    rows: list[dict[str, object]] = []
    for k, (component, unit) in enumerate(zip(WRENCH_COMPONENTS, WRENCH_UNITS, strict=True)):
        row: dict[str, object] = {
            "calibration": entry.calibration,
            "sensor": entry.sensor,
            "serial": entry.serial,
            "component": component,
            "unit": unit,
        }
        row |= {f"m{j}": value for j, value in enumerate(entry.matrix[k])}
        row |= {"offset": entry.offset[k], "offset_stored": entry.offset_stored}
        row |= {f"{name}_coefficient": values[k] for name, values in entry.variables.items()}
        if entry.full_scale is not None and entry.largest_rounding_error is not None:
            row |= {"full_scale": entry.full_scale[k], "largest_rounding_error": entry.largest_rounding_error[k]}
        rows.append(row)
    return rows


def _show(result: ExportResult) -> None:
    screen = console()
    for entry in result.calibrations:
        screen.print(_table(result.format, entry))
    screen.print(f"offset: {result.offset_handling}", soft_wrap=True)
    screen.print(f"written to {result.file}", soft_wrap=True)


def _table(to: ExportFormat, entry: ExportedCalibration) -> Table:
    secondary = to is ExportFormat.WHOLEBODYDYNAMICS
    first = "secondary matrix" if secondary else "per 1000 counts"
    columns = WRENCH_COMPONENTS if secondary else [f"ch{j}" for j in range(len(entry.matrix[0]))]
    rounded = [] if entry.full_scale is None else ["full scale", "rounding at most"]
    made = table(first, *columns, "offset", *rounded, title=f"{entry.sensor} ({entry.serial})")
    for k, (component, unit) in enumerate(zip(WRENCH_COMPONENTS, WRENCH_UNITS, strict=True)):
        cells = [f"{value if secondary else 1000 * value:.3f}" for value in entry.matrix[k]]
        cells.append(f"{entry.offset[k]:.3f}")
        if entry.full_scale is not None and entry.largest_rounding_error is not None:
            cells += [str(entry.full_scale[k]), f"{entry.largest_rounding_error[k]:.1e}"]
        made.add_row(f"{component}, {unit}", *cells)
    return made
