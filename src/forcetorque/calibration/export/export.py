# SPDX-License-Identifier: BSD-3-Clause
"""Write calibrations to the files that robots and other programs read, and say what these do not hold."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray, require_shape
from forcetorque.base.errors import ExperimentError, FormatError
from forcetorque.base.output_file import refuse_output
from forcetorque.calibration.export.csv import write_calibration_table, write_coefficient_table
from forcetorque.calibration.export.formats import ExportFormat
from forcetorque.calibration.export.result import Export, ExportedCalibration
from forcetorque.calibration.export.wholebodydynamics.correction import from_calibration
from forcetorque.calibration.export.wholebodydynamics.file import write_groups
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.experiment.input_files import stated_in
from forcetorque.formats.icub_matrix import encode_matrix, serial_number_in_name, write_matrix_file


def export_icub_matrix(
    name: str,
    calibration: Calibration,
    output: Path | str,
    *,
    full_scale: Sequence[int] | None = None,
    force: bool = False,
) -> Export:
    """Write the matrix file of a sensor's DSP, which has no place for an offset.

    Args:
        name: Name of the calibration, for messages.
        calibration: The calibration.
        output: File to write or to replace.
        full_scale: Full scales for fx, fy, fz, tx, ty, tz; N, N m; None to choose them.
        force: Whether a file that is neither a result nor a figure may be replaced; an input never is.

    Returns:
        What the file holds.

    Raises:
        SerialNumberError: If the file is named after another sensor.
        ExperimentError: If the matrix is not per count.
        FormatError: If a full scale cannot hold its row.
    """
    _refuse_output(output, [calibration], force=force)
    _require_linear({name: calibration}, ExportFormat.ICUB_MATRIX)
    with stated_in(name):
        if (serial := serial_number_in_name(output)) is not None:
            calibration.require_serial(serial)
        if calibration.prior is not None and calibration.prior.source == "identity":
            raise ExperimentError(
                'its prior is "identity": the matrix corrects a calibrated stream and is not per count; '
                "use --to wholebodydynamics, from Python export_wholebodydynamics"
            )
        file = encode_matrix(calibration.matrix, full_scale=full_scale)
        error = _largest_in_range(file.matrix - calibration.matrix, calibration)
    write_matrix_file(output, file)
    entry = _entry(name, calibration, matrix=file.matrix, offset_stored=False, variables_stored=False)
    rounding = {"full_scale": tuple(file.full_scale), "largest_rounding_error": error}
    return _export(ExportFormat.ICUB_MATRIX, output, [entry.model_copy(update=rounding)])


def export_wholebodydynamics(
    calibrations: Mapping[str, Calibration],
    output: Path | str,
    *,
    sensor_name: str | None = None,
    stream: Calibration | None = None,
    force: bool = False,
) -> Export:
    """Write the groups of a wholebodydynamics configuration, which correct streams that are calibrated already.

    Args:
        calibrations: Calibrations of different sensors by name.
        output: File to write or to replace.
        sensor_name: Name of the sensor in the robot's configuration; that of the calibration if None.
        stream: Calibration that the robot's stream is already made with; the prior matrix alone if None.
        force: Whether a file that is neither a result nor a figure may be replaced; an input never is.

    Returns:
        What the file holds.
    """
    _refuse_output(output, calibrations.values(), force=force)
    _require_linear(calibrations, ExportFormat.WHOLEBODYDYNAMICS)
    if stream is not None:
        _require_linear({"the stream's calibration": stream}, ExportFormat.WHOLEBODYDYNAMICS)
    corrections = {}
    for name, calibration in calibrations.items():
        with stated_in(name):
            corrections[name] = from_calibration(calibration, sensor_name=sensor_name, stream=stream)
    write_groups(output, corrections.values())
    entries = []
    for name, correction in corrections.items():
        entry = _entry(name, calibrations[name], matrix=correction.secondary_matrix)
        changed: dict[str, object] = {"sensor": correction.sensor, "offset": correction.offset}
        if correction.temperature_coefficients is not None:
            changed["variables"] = dict.fromkeys(entry.variables, correction.temperature_coefficients)
        entries.append(entry.model_copy(update=changed))
    return _export(ExportFormat.WHOLEBODYDYNAMICS, output, entries)


def export_table(calibrations: Mapping[str, Calibration], output: Path | str, *, force: bool = False) -> Export:
    """Write matrices, offsets and coefficients into a plain table.

    Args:
        calibrations: Calibrations by name.
        output: File to write or to replace.
        force: Whether a file that is neither a result nor a figure may be replaced; an input never is.

    Returns:
        What the file holds.
    """
    _refuse_output(output, calibrations.values(), force=force)
    _require_linear(calibrations, ExportFormat.CSV)
    write_calibration_table(output, calibrations.values())
    entries = [_entry(name, calibration, matrix=calibration.matrix) for name, calibration in calibrations.items()]
    return _export(ExportFormat.CSV, output, entries)


def export_coefficients(calibrations: Mapping[str, Calibration], output: Path | str, *, force: bool = False) -> Export:
    """Write the coefficients of temperature and other variables by themselves.

    Args:
        calibrations: Calibrations by name, one of them with a variable.
        output: File to write or to replace.
        force: Whether a file that is neither a result nor a figure may be replaced; an input never is.

    Returns:
        What the file holds.
    """
    _refuse_output(output, calibrations.values(), force=force)
    _require_linear(calibrations, ExportFormat.COEFFICIENTS)
    write_coefficient_table(output, calibrations.values())
    entries = [
        _entry(name, calibration, matrix=calibration.matrix, offset_stored=False)
        for name, calibration in calibrations.items()
    ]
    return _export(ExportFormat.COEFFICIENTS, output, entries)


def _refuse_output(output: Path | str, calibrations: Iterable[Calibration], *, force: bool) -> None:
    inputs = {digest for calibration in calibrations for digest in calibration.provenance.inputs_sha256.values()}
    refuse_output(output, inputs_sha256=inputs, force=force)


def _require_linear(calibrations: Mapping[str, Calibration], form: ExportFormat) -> None:
    """Refuse what the file has no place for: without its quadratic terms such a calibration reads wrongly."""
    for name, calibration in calibrations.items():
        if calibration.quadratic is not None:
            raise FormatError(
                f"{name}: expected a linear calibration for --to {form}, which has no place for quadratic terms; "
                "fit again with `calibrate --linear`, from Python with nonlinear=False"
            )


def _largest_in_range(matrix: FloatArray, calibration: Calibration) -> FloatArray:
    """Largest value of each row of a matrix times any raw reading within the fitted range of every channel."""
    low, high = calibration.validity.raw_minimum_counts, calibration.validity.raw_maximum_counts
    for name, limits in (("raw_minimum_counts", low), ("raw_maximum_counts", high)):
        require_shape(limits, name=name, shape=(matrix.shape[1],))
    ends = np.stack([matrix * low, matrix * high])  # (2, 6, c)
    return np.maximum(ends.max(axis=0).sum(axis=1), -ends.min(axis=0).sum(axis=1))


def _entry(
    name: str,
    calibration: Calibration,
    *,
    matrix: FloatArray,
    offset_stored: bool = True,
    variables_stored: bool = True,
) -> ExportedCalibration:
    return ExportedCalibration(
        calibration=name,
        sensor=calibration.sensor.name,
        serial=calibration.sensor.serial,
        matrix=matrix,
        offset=calibration.offset,
        offset_stored=offset_stored,
        session=calibration.sessions[-1].name if len(calibration.sessions) > 1 else None,
        variables={variable.name: variable.coefficients for variable in calibration.variables},
        variables_stored=variables_stored,
        fitted_minimum=None if calibration.validity.loads is None else calibration.validity.loads.minimum,
        fitted_maximum=None if calibration.validity.loads is None else calibration.validity.loads.maximum,
    )


def _export(form: ExportFormat, output: Path | str, entries: Sequence[ExportedCalibration]) -> Export:
    return Export(
        format=form,
        file=str(output),
        offset_handling=form.offset_handling,
        calibrations=tuple(entries),
        warnings=tuple(sentence for entry in entries for sentence in _doubts(form, entry)),
    )


def _doubts(form: ExportFormat, entry: ExportedCalibration) -> Iterator[str]:
    """What the file does not hold, or the robot does not take from it."""
    if not entry.offset_stored:
        yield f"{entry.calibration}: offset {entry.offset_text}: {form.offset_handling}"
    if entry.session is not None:
        yield f"{entry.calibration}: its offset is of the last session, {entry.session!r}; others have their own"
    if entry.variables and not entry.variables_stored:
        names = ", ".join(entry.variables)
        yield (
            f"{entry.calibration}: the coefficients of {names} are not in this file: --to coefficients, from Python "
            "export_coefficients, has them"
        )
    if form is ExportFormat.WHOLEBODYDYNAMICS and not entry.offset.any():
        yield f"{entry.calibration}: the device ignores an FT_OFFSET of six zeros and keeps its own"
