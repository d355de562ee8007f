# SPDX-License-Identifier: BSD-3-Clause
"""Write calibrations to files of robots and other programs, and state what these files do not hold."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import ArrayField, FloatArray, require_shape
from forcetorque.base.errors import ExperimentError, FormatError
from forcetorque.base.output_file import refuse_output, write_bytes_atomically
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.calibration.export.formats import ExportFormat
from forcetorque.calibration.export.ros2_parameters import raw_unit, ros2_parameters
from forcetorque.calibration.export.wholebodydynamics import from_calibration, write_groups
from forcetorque.calibration.summary import component_records
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.sensor_model import component_names, measured_components
from forcetorque.experiment.named_files import stated_in
from forcetorque.formats.icub_matrix import MatrixFile, encode_matrix, serial_number_in_name, write_matrix_file
from forcetorque.results.answer import Answer, Concern
from forcetorque.results.result import Result
from forcetorque.results.table import COMPONENTS, Row, Table, WrenchValues

_MOST_WARNINGS = 2
"""Warnings about the fit that an answer names; `warnings` has all."""


class ExportedCalibration(Row):
    """What a file holds of one calibration; per component in the order fx fy fz (N) tx ty tz (N m)."""

    calibration: str
    """Path of the calibration file."""
    sensor: str
    """Name that the sensor has in the written file, or in the calibration where the file holds no name."""
    serial: str
    """Its serial number."""
    matrix: Annotated[FloatArray, ArrayField((6, None))]
    """Matrix as the file's reader gets it: N/count and N m/count, for wholebodydynamics the secondary matrix."""
    offset: WrenchValues
    """Offset that goes with the matrix, to be added; N, N m."""
    offset_stored: bool
    """Whether the file holds the offset."""
    session: str | None = None
    """Session whose offset it is, the last one; None for a calibration of one session."""
    variables: dict[str, WrenchValues]
    """Coefficients of each linear variable that go with the matrix; N, N m per unit."""
    variables_stored: bool
    """Whether the file holds them."""
    fitted_minimum: WrenchValues | None = None
    """Smallest fitted load per component; N, N m; None where the calibration file is older and does not hold it."""
    fitted_maximum: WrenchValues | None = None
    """Largest fitted load per component; N, N m."""
    full_scale: tuple[int, ...] | None = None
    """icub-matrix: full scale; N, N m."""
    largest_rounding_error: WrenchValues | None = None
    """icub-matrix: largest error that rounding the matrix makes anywhere in the fitted raw range; N, N m."""
    fit_warnings: tuple[str, ...] = ()
    """Warnings that the calibration holds about its data, such as a fault of the bench."""

    @property
    def offset_text(self) -> str:
        """The offset of the measured components with its units."""
        if len(self.measured) < len(WRENCH_COMPONENTS):
            entries = zip(WRENCH_COMPONENTS, self.offset, WRENCH_UNITS, strict=True)
            return ", ".join(f"{name} {value:.4g} {unit}" for name, value, unit in entries if name in self.measured)
        force, moment = (", ".join(f"{value:.4g}" for value in half) for half in (self.offset[:3], self.offset[3:]))
        return f"({force}) N, ({moment}) N m"

    @property
    def measured(self) -> tuple[str, ...]:
        """The components that it measures; rows of the others are zeros, which say nothing of the load."""
        return tuple(np.array(WRENCH_COMPONENTS)[measured_components(self.matrix)])

    @property
    def fitted_text(self) -> str:
        """The fitted loads with their units; beyond them nothing was seen of the sensor."""
        if self.fitted_minimum is None or self.fitted_maximum is None:
            return f"{self.sensor}: the file does not hold which loads were fitted; fit again to know where it holds"
        ranges = [
            f"{component} {low:.3g} to {high:.3g} {unit}"
            for component, low, high, unit in zip(
                WRENCH_COMPONENTS, self.fitted_minimum, self.fitted_maximum, WRENCH_UNITS, strict=True
            )
            if component in self.measured
        ]
        return f"{self.sensor}: fitted loads, outside which it extrapolates: {', '.join(ranges)}"

    def components(self) -> Iterator[dict[str, object]]:
        """Give a flat line per measured component.

        Yields:
            The lines.
        """
        for k, (component, unit) in enumerate(zip(WRENCH_COMPONENTS, WRENCH_UNITS, strict=True)):
            if component not in self.measured:
                continue
            line: dict[str, object] = {
                "calibration": self.calibration,
                "sensor": self.sensor,
                "serial": self.serial,
                "component": component,
                "unit": unit,
            }
            line |= {f"m{j}": float(value) for j, value in enumerate(self.matrix[k])}
            line |= {"offset": float(self.offset[k]), "offset_stored": self.offset_stored}
            line |= {f"{name}_coefficient": float(values[k]) for name, values in self.variables.items()}
            if self.fitted_minimum is not None and self.fitted_maximum is not None:
                line |= {"fitted_minimum": float(self.fitted_minimum[k])}
                line |= {"fitted_maximum": float(self.fitted_maximum[k])}
            if self.full_scale is not None and self.largest_rounding_error is not None:
                error = float(self.largest_rounding_error[k])
                line |= {"full_scale": self.full_scale[k], "largest_rounding_error": error}
            yield line


class Export(Result):
    """What a file for a robot or another program holds."""

    schema_name: Literal["forcetorque/export/1"] = Field(default="forcetorque/export/1", alias="schema")
    """Form of the result."""
    format: ExportFormat
    """Form of the file."""
    file: str
    """The file; empty until its command has written it."""
    offset_handling: str
    """What becomes of the offset, in words."""
    calibrations: tuple[ExportedCalibration, ...]
    """One per calibration file."""
    writes: Callable[[Path], None] | None = Field(default=None, exclude=True, repr=False)
    """Writes the file; None of a result that is read from JSON."""
    inputs_sha256: frozenset[str] = Field(default=frozenset(), exclude=True, repr=False)
    """SHA-256 in hex of the inputs of the calibrations, none of which it replaces."""

    def save(self, path: Path | str, *, force: bool = False) -> None:
        """Write the file; on any error it keeps what it held before.

        Args:
            path: File to write or to replace, in an existing folder.
            force: Whether a file that is neither a result nor a figure may be replaced; an input never is.

        Raises:
            SerialNumberError: If the file is named after another sensor.
            FormatError: If the form has no file of these calibrations, or the result is read from JSON.
            OutputError: If the file must not be replaced.
        """
        if self.writes is None:
            raise FormatError(
                f"{path}: expected an export of calibrations, got its JSON, which lacks the file; export again"
            )
        refuse_output(path, inputs_sha256=self.inputs_sha256, force=force)
        self.writes(Path(path))

    def answers(self) -> Iterator[Answer]:
        """Say what was written, and what becomes of the offset.

        Yields:
            One per calibration.
        """
        for entry in self.calibrations:
            yield Answer(
                subject=f"{entry.sensor} ({entry.serial})",
                verdict=f"{'WRITTEN AS' if self.file else 'FOR'} {self.format.value}"
                f"{', WITH WARNINGS' if entry.fit_warnings else ''}",
                why=(*entry.fit_warnings[:_MOST_WARNINGS], f"offset: {self.offset_handling}", entry.fitted_text),
                written=(self.file,) if self.file else (),
                concern=Concern.UNCERTAIN if entry.fit_warnings else Concern.NONE,
            )

    def blocks(self) -> Iterator[Table | str]:
        """Give the matrices, and what becomes of the offset.

        Yields:
            Tables and sentences.
        """
        for entry in self.calibrations:
            yield _matrix_table(entry, is_secondary=self.format is ExportFormat.WHOLEBODYDYNAMICS)
            yield entry.fitted_text
        yield f"offset: {self.offset_handling}"
        if self.file:
            yield f"written to {self.file}"

    def records(self) -> list[dict[str, object]]:
        """Give the matrices as flat lines.

        Returns:
            One line per calibration and component.
        """
        return [line for entry in self.calibrations for line in entry.components()]


def _matrix_table(entry: ExportedCalibration, *, is_secondary: bool) -> Table:
    columns = WRENCH_COMPONENTS if is_secondary else [f"ch{j}" for j in range(entry.matrix.shape[1])]
    shown = entry.matrix if is_secondary else 1000.0 * entry.matrix
    rounding = [] if entry.full_scale is None else ["full scale", "rounding at most"]
    lines = []
    for k, component in enumerate(COMPONENTS):
        if WRENCH_COMPONENTS[k] not in entry.measured:
            continue
        line = [component, *(f"{value:.3f}" for value in shown[k]), f"{entry.offset[k]:.3f}"]
        if entry.full_scale is not None and entry.largest_rounding_error is not None:
            line += [str(entry.full_scale[k]), f"{entry.largest_rounding_error[k]:.1e}"]
        lines.append(tuple(line))
    return Table(
        caption=f"{entry.sensor} ({entry.serial})",
        headings=("secondary matrix" if is_secondary else "per 1000 counts", *columns, "offset", *rounding),
        rows=tuple(lines),
    )


def write_calibration_table(path: Path | str, calibrations: Iterable[Calibration]) -> None:
    """Write one row per measured component of every sensor; on any error the file keeps what it held before.

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
    variables = dict.fromkeys((v.name, v.unit) for calibration in chosen for v in calibration.variables)
    named = [text for name, unit in variables for text in (f"{name}_per_{unit}", f"{name}_reference_{unit}")]
    rows = [
        record
        for one in chosen
        for record, measured in zip(component_records(one), measured_components(one.matrix), strict=True)
        if measured
    ]
    _write_rows(path, ["sensor", "serial", "component", "unit", *channels, "offset", *named], rows)


def _write_rows(path: Path | str, names: Sequence[str], rows: Iterable[Mapping[str, object]]) -> None:
    text = io.StringIO(newline="")
    writer = csv.DictWriter(text, names, restval="", extrasaction="ignore", lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    write_bytes_atomically(Path(path), text.getvalue().encode())


def write_coefficient_table(path: Path | str, calibrations: Iterable[Calibration]) -> None:
    """Write one row per variable of every sensor; on any error the file keeps what it held before.

    A row holds sensor, serial, variable, unit, reference_value and what one unit above that value adds to
    fx fy fz (N) and tx ty tz (N m), empty for a component that it does not measure. Every number reads back exactly.
    A sensor without variables has no row: its coefficients are zero.

    Args:
        path: File to write or to replace, in an existing folder.
        calibrations: Calibrations.

    Raises:
        FormatError: If no calibration has a variable.
    """
    head = ("sensor", "serial", "variable", "unit", "reference_value")
    rows = [
        dict(zip(head, (c.sensor.name, c.sensor.serial, v.name, v.unit, v.reference_value), strict=True))
        | dict(zip(np.array(WRENCH_COMPONENTS)[own], v.coefficients[own].tolist(), strict=True))
        for c in calibrations
        for own in [measured_components(c.matrix)]
        for v in c.variables
    ]
    if not rows:
        raise FormatError(f"{path}: expected a calibration with a linear variable such as temperature, got none")
    _write_rows(path, [*head, *WRENCH_COMPONENTS], rows)


def exported(
    calibrations: Mapping[str, Calibration],
    form: ExportFormat,
    *,
    full_scale: Sequence[int] | None,
    sensor_name: str | None,
    frame_ids: Sequence[str],
    stream: Calibration | None,
) -> Export:
    """Compute what a file holds of calibrations; the options are those of the command."""
    _require_linear(calibrations, form)
    if form in {ExportFormat.ICUB_MATRIX, ExportFormat.WHOLEBODYDYNAMICS, ExportFormat.ROS2}:
        _require_six_components(calibrations, form)
    writes: Callable[[Path], None]
    if form is ExportFormat.ICUB_MATRIX:
        entries, writes = _icub_matrix(*next(iter(calibrations.items())), full_scale)
    elif form is ExportFormat.WHOLEBODYDYNAMICS:
        entries, writes = _groups(calibrations, sensor_name, stream)
    elif form is ExportFormat.ROS2:
        entries, writes = _ros2_parameters(calibrations, frame_ids, sensor_name)
    else:
        stored, given = form is not ExportFormat.COEFFICIENTS, tuple(calibrations.values())
        entries = [_entry(name, one, matrix=one.matrix, offset_stored=stored) for name, one in calibrations.items()]
        writes = {
            ExportFormat.CSV: partial(write_calibration_table, calibrations=given),
            ExportFormat.COEFFICIENTS: partial(write_coefficient_table, calibrations=given),
            ExportFormat.NUMPY: partial(write_archive, calibration=given[0]),
        }[form]
    inputs = {digest for one in calibrations.values() for digest in one.provenance.inputs_sha256.values()}
    return Export(
        format=form,
        file="",
        offset_handling=form.offset_handling,
        calibrations=tuple(entries),
        writes=writes,
        inputs_sha256=frozenset(inputs),
        warnings=tuple(sentence for entry in entries for sentence in _doubts(form, entry)),
    )


_Entries = tuple[list[ExportedCalibration], Callable[[Path], None]]


def _icub_matrix(name: str, calibration: Calibration, full_scale: Sequence[int] | None) -> _Entries:
    """The matrix file of a sensor's DSP, which has no place for an offset."""
    with stated_in(name):
        if calibration.prior is not None and calibration.prior.source == "identity":
            raise ExperimentError(
                'its prior is "identity": the matrix corrects a calibrated stream and is not per count; '
                "use --to wholebodydynamics, from Python export_calibrations"
            )
        file = encode_matrix(calibration.matrix, full_scale=full_scale)
        error = _largest_in_range(file.matrix - calibration.matrix, calibration)
    entry = _entry(name, calibration, matrix=file.matrix, offset_stored=False, variables_stored=False)
    rounding = {"full_scale": tuple(file.full_scale), "largest_rounding_error": error}
    write = partial(_write_matrix, name=name, calibration=calibration, file=file)
    return [entry.model_copy(update=rounding)], write


def _write_matrix(path: Path, *, name: str, calibration: Calibration, file: MatrixFile) -> None:
    with stated_in(name):
        if (serial := serial_number_in_name(path)) is not None:
            calibration.require_serial(serial)
    write_matrix_file(path, file)


def _groups(calibrations: Mapping[str, Calibration], sensor_name: str | None, stream: Calibration | None) -> _Entries:
    """The groups of a wholebodydynamics configuration, which correct streams that are calibrated already."""
    if stream is not None:
        _require_linear({"the stream's calibration": stream}, ExportFormat.WHOLEBODYDYNAMICS)
    corrections, entries = [], []
    for name, calibration in calibrations.items():
        with stated_in(name):
            correction = from_calibration(calibration, sensor_name=sensor_name, stream=stream)
        corrections.append(correction)
        entry = _entry(name, calibration, matrix=correction.secondary_matrix)
        changed: dict[str, object] = {"sensor": correction.sensor, "offset": correction.offset}
        if correction.temperature_coefficients is not None:
            changed["variables"] = dict.fromkeys(entry.variables, correction.temperature_coefficients)
        entries.append(entry.model_copy(update=changed))
    return entries, partial(write_groups, corrections=corrections)


def _ros2_parameters(
    calibrations: Mapping[str, Calibration], frame_ids: Sequence[str], sensor_name: str | None
) -> _Entries:
    """Parameters of a ROS 2 node."""
    if len(frame_ids) != len(calibrations):
        frames = ", ".join(f"{one.sensor.name}: its {one.sensor.frame} frame" for one in calibrations.values())
        raise ExperimentError(
            f"--frame-id, from Python frame_ids: expected the frame of tf that each sensor reads in ({frames}), "
            f"got {len(frame_ids)} for "
            f"{len(calibrations)}; --frame-id names it, once for each calibration in their order"
        )
    by_sensor = {sensor_name or one.sensor.name: one for one in calibrations.values()}
    if len(by_sensor) != len(calibrations):
        raise FormatError("--to ros2: expected calibrations of different sensors, got a name twice; export each alone")
    text = ros2_parameters(by_sensor, dict(zip(by_sensor, frame_ids, strict=True)))
    entries = [
        _entry(name, one, matrix=one.matrix).model_copy(update={"sensor": sensor})
        for (name, one), sensor in zip(calibrations.items(), by_sensor, strict=True)
    ]
    return entries, partial(write_bytes_atomically, data=text.encode())


def write_archive(path: Path, calibration: Calibration) -> None:
    """Write an archive of NumPy (`.npz`), which holds numbers and text and no pickled objects.

    `sensor = np.load(path)`, then `raw @ sensor["matrix"].T + sensor["offset"]` is the wrench; with variables
    `(values - sensor["reference_values"]) @ sensor["coefficients"].T` is added, values of shape (n, v). The wrench has
    the components that the sensor measures, named in `components`.

    Args:
        path: File to write or to replace.
        calibration: The calibration.
    """
    model, sensor, content = calibration.model, calibration.sensor, io.BytesIO()
    measured = measured_components(model.matrix)
    np.savez(
        content,
        matrix=model.matrix[measured],
        offset=model.offset[measured],
        coefficients=model.coefficients[measured],
        reference_values=model.reference_values,
        variables=np.array([variable.name for variable in calibration.variables], dtype=np.str_),
        variable_units=np.array([variable.unit for variable in calibration.variables], dtype=np.str_),
        components=np.array(WRENCH_COMPONENTS)[measured],
        units=np.array(WRENCH_UNITS)[measured],
        raw_unit=np.array(raw_unit(calibration)),
        sensor=np.array(sensor.name),
        serial=np.array(sensor.serial),
        frame=np.array(sensor.frame),
        measure_direction=np.array(sensor.measure_direction.value),
    )
    write_bytes_atomically(path, content.getvalue())


def _require_linear(calibrations: Mapping[str, Calibration], form: ExportFormat) -> None:
    """Refuse what the file has no place for: without its quadratic terms such a calibration reads wrongly."""
    for name, calibration in calibrations.items():
        if calibration.quadratic is not None:
            raise FormatError(
                f"{name}: expected a linear calibration for --to {form}, which has no place for quadratic terms; "
                "fit again with `calibrate --linear`, from Python with nonlinear=False"
            )


def _require_six_components(calibrations: Mapping[str, Calibration], form: ExportFormat) -> None:
    """Refuse what would be read as a load of zero."""
    for name, calibration in calibrations.items():
        measured = measured_components(calibration.matrix)
        if not measured.all():
            raise FormatError(
                f"{name}: expected a sensor of six components for --to {form}, whose readers take the others for zero, "
                f"got {component_names(measured)}; --to csv and --to numpy name the components"
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
        fit_warnings=calibration.warnings,
        fitted_minimum=None if calibration.validity.loads is None else calibration.validity.loads.minimum,
        fitted_maximum=None if calibration.validity.loads is None else calibration.validity.loads.maximum,
    )


def _doubts(form: ExportFormat, entry: ExportedCalibration) -> Iterator[str]:
    """What was wrong with the fitted data, and what the file does not hold or the robot does not take from it."""
    yield from (f"{entry.calibration}: fitted with the warning: {warning}" for warning in entry.fit_warnings)
    if not entry.offset_stored:
        yield f"{entry.calibration}: offset {entry.offset_text}: {form.offset_handling}"
    if entry.session is not None:
        yield f"{entry.calibration}: its offset is of the last session, {entry.session!r}; others have their own"
    if entry.variables and not entry.variables_stored:
        names = ", ".join(entry.variables)
        yield (
            f"{entry.calibration}: the coefficients of {names} are not in this file: --to coefficients, from Python "
            "export_calibrations, has them"
        )
    if form is ExportFormat.WHOLEBODYDYNAMICS and not entry.offset.any():
        yield f"{entry.calibration}: the device ignores an FT_OFFSET of six zeros and keeps its own"
