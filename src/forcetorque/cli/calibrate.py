# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque calibrate`: from an experiment file to calibration files."""

from __future__ import annotations

import math
from dataclasses import replace
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from typing import Literal
from urllib.parse import quote

import typer
from pydantic import BaseModel, ConfigDict, Field
from rich.table import Table

from forcetorque.analysis import SensorRun, calibrate_sensor, doubtful_spans
from forcetorque.arrays import FloatArray
from forcetorque.calibration import Calibration, estimation_type, write_calibration
from forcetorque.cli.output import (
    Format,
    console,
    print_result,
    refuse_standard_output,
    report_error,
    start_logging,
    table,
)
from forcetorque.cli.reading import read_experiment, sensors_named
from forcetorque.errors import ExperimentError, FitError, ForceTorqueError
from forcetorque.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.inputs import stated_in
from forcetorque.recording import Use
from forcetorque.spatial import WRENCH_COMPONENTS, WRENCH_UNITS


class WrittenCalibration(BaseModel):
    """One calibration and the file that holds it."""

    file: str
    """Path of the file."""
    calibration: Calibration
    """Its content."""
    secondary_matrix: list[list[float]] | None
    """`C C_prior^-1`, for a stream that is calibrated with the prior."""


class CalibrateResult(BaseModel):
    """What `forcetorque calibrate` found."""

    model_config = ConfigDict(populate_by_name=True)

    schema_name: Literal["forcetorque/calibrate/1"] = Field(default="forcetorque/calibrate/1", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment."""
    calibrations: list[WrittenCalibration]
    """One per sensor that could be fitted."""


def run(
    path: Path,
    *,
    output: Path,
    sensors: list[str] | None,
    regularisation: str | None,
    kind: str | None,
    output_format: Format,
) -> None:
    """Fit every sensor that was asked for, then write the files of those that can be fitted.

    Args:
        path: Experiment file.
        output: A .json file for one sensor, else a folder.
        sensors: Names of the sensors; all if None.
        regularisation: Lambda, or `held-out`; None for what the experiment says.
        kind: Estimation type by name; None for what the experiment says.
        output_format: Form of the result.

    Raises:
        typer.Exit: With code 2, if a sensor cannot be fitted; the others have their files.
    """
    log = start_logging()
    refuse_standard_output("--output", output)
    chosen_kind = None if kind is None else estimation_type(kind)
    experiment = read_experiment(path, log)
    chosen = sensors_named(experiment, sensors)
    if experiment.payload is not None:
        log.warning(
            "the load's mass was estimated with this sensor's own reading, so a wrong gain cannot be seen; "
            "give mass_kg and centre_of_mass_m to judge it"
        )
    files = _files(output, chosen)
    start_ns = experiment.recording.start_ns
    for interval, finding in doubtful_spans(replace(experiment, sensors=tuple(chosen)), Use.CALIBRATION):
        span = [((ns or 0) - start_ns) * 1e-9 for ns in (finding.start_ns, finding.end_ns)]
        log.warning(
            "interval %r: %s %s at %.2f-%.2f s: %s",
            interval.label,
            finding.stream,
            finding.kind,
            *span,
            finding.message,
        )
    given = _lambda(regularisation, experiment)
    created = datetime.now(UTC).isoformat(timespec="seconds")
    written, refused = [], []
    for sensor, file in zip(chosen, files, strict=True):
        log.info("fitting %s (%s)", sensor.name, sensor.serial)
        try:
            with stated_in(f"{path}: sensor {sensor.name!r}"):
                calibration = calibrate_sensor(
                    SensorRun(experiment, sensor),
                    code_version=version("forcetorque"),
                    created=created,
                    regularisation=given,
                    kind=chosen_kind,
                )
                secondary = calibration.secondary_matrix()
        except ForceTorqueError as error:  # a limb that stands still says nothing against the others
            refused.append(error)
            continue
        reversed_axes = () if secondary is None else _reversed_axes(secondary)
        if reversed_axes:
            log.warning(
                "%s: %s come(s) out with the sign of the prior reversed; "
                "is gravity_direction or measure_direction the right way round?",
                sensor.name,
                ", ".join(reversed_axes),
            )
        unexcited = calibration.validity.excited.count(False)
        if unexcited:
            log.warning(
                "%s: the loads leave %d of %d raw directions unexcited; along them the matrix is the prior's or noise",
                sensor.name,
                unexcited,
                len(calibration.validity.excited),
            )
        written.append(
            WrittenCalibration(
                file=str(file),
                calibration=calibration,
                secondary_matrix=None if secondary is None else secondary.tolist(),
            )
        )
    for entry in written:
        file = Path(entry.file)
        file.parent.mkdir(parents=True, exist_ok=True)
        write_calibration(file, entry.calibration)
    if written:
        result = CalibrateResult(experiment=experiment.name, calibrations=written)
        rows = [row for entry in written for row in _rows(entry)]
        print_result(result.model_dump(mode="json", by_alias=True), rows, output_format, show=lambda: _show(written))
    for refusal in refused:
        report_error(refusal)
    if refused:
        raise typer.Exit(2)


def _files(output: Path, sensors: list[ExperimentSensor]) -> list[Path]:
    if output.suffix == ".json":
        if len(sensors) != 1:
            raise ExperimentError(
                f"--output {output}: one file for {len(sensors)} sensors; name a folder, or one sensor with --sensor"
            )
        return [output]
    if output.exists() and not output.is_dir():
        raise ExperimentError(f"--output {output}: expected a folder or a .json file, got another file")
    # quoted, because a name or a serial number may hold a slash
    return [output / f"{quote(f'{sensor.name}_{sensor.serial}', safe=' ')}.json" for sensor in sensors]


def _lambda(text: str | None, experiment: Experiment) -> float | None:
    if text is None:
        return experiment.regularisation
    if text == "held-out":
        return None
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not value >= 0.0:
        raise FitError(f"--lambda: expected a number of at least 0 counts2 or `held-out`, got {text!r}")
    return value


def _reversed_axes(secondary: FloatArray) -> tuple[str, ...]:
    """Components that the new matrix reads with the opposite sign of the prior."""
    return tuple(name for name, own in zip(WRENCH_COMPONENTS, secondary.diagonal(), strict=True) if own < 0.0)


def _rows(entry: WrittenCalibration) -> list[dict[str, object]]:
    calibration = entry.calibration
    rows: list[dict[str, object]] = []
    for k, component in enumerate(WRENCH_COMPONENTS):
        row: dict[str, object] = {
            "sensor": calibration.sensor.name,
            "serial": calibration.sensor.serial,
            "component": component,
            "unit": WRENCH_UNITS[k],
        }
        row |= {f"c{j}_per_count": float(value) for j, value in enumerate(calibration.matrix[k])}
        for v in calibration.variables:
            row |= {
                f"{v.name}_per_{v.unit}": float(v.coefficients[k]),
                f"{v.name}_reference_{v.unit}": v.reference_value,
            }
        row |= {"offset": float(calibration.offset[k]), "residual_rms": float(calibration.residual_rms[k])}
        rows.append(row | {"lambda_counts2": calibration.lambda_counts2, "samples": calibration.provenance.samples})
    return rows


def _show(written: list[WrittenCalibration]) -> None:
    screen = console()
    for entry in written:
        calibration = entry.calibration
        source = calibration.provenance
        screen.print(
            f"{calibration.sensor.name} ({calibration.sensor.serial}): {source.samples} samples of "
            f"{', '.join(interval.label for interval in source.intervals)}, {source.dropped} left out; "
            f"{calibration.estimation_type}, lambda {_lambda_text(calibration)}"
        )
        screen.print(_matrix_table(calibration))
        if calibration.variables:
            screen.print(_variable_table(calibration))
        screen.print(_excitation_table(calibration))
        screen.print(f"written to {entry.file}", soft_wrap=True)


def _matrix_table(calibration: Calibration) -> Table:
    channels = [f"ch{j}" for j in range(calibration.matrix.shape[1])]
    spread = calibration.offset_standard_error
    made = table("per 1000 counts", *channels, "offset", "± by blocks", "residual RMS", title="matrix and offset")
    for k, (component, unit) in enumerate(zip(WRENCH_COMPONENTS, WRENCH_UNITS, strict=True)):
        made.add_row(
            f"{component}, {unit}",
            *(f"{1000 * value:.3f}" for value in calibration.matrix[k]),
            f"{calibration.offset[k]:.3f}",
            "-" if spread is None else f"{spread[k]:.3f}",
            f"{calibration.residual_rms[k]:.3f}",
        )
    return made


def _variable_table(calibration: Calibration) -> Table:
    headings = [f"{component}, {unit}" for component, unit in zip(WRENCH_COMPONENTS, WRENCH_UNITS, strict=True)]
    made = table("variable", "from", "fitted range", *headings, title="what one unit of a variable adds, ± by blocks")
    for variable in calibration.variables:
        spread = variable.standard_error
        cells = [f"{value:.4f}" for value in variable.coefficients]
        if spread is not None:
            cells = [f"{cell} ±{error:.4f}" for cell, error in zip(cells, spread, strict=True)]
        made.add_row(
            f"{variable.name}, {variable.unit}",
            f"{variable.reference_value:.2f}",
            f"{variable.minimum:.2f} to {variable.maximum:.2f}",
            *cells,
        )
    return made


def _lambda_text(calibration: Calibration) -> str:
    value = calibration.lambda_counts2
    if value is None:
        return "by row"
    text = "infinite: the prior matrix was kept" if math.isinf(value) else f"{value:.4g} counts2"
    return f"{text} ({'given' if calibration.selection.rule == 'given' else 'chosen on held-out blocks'})"


def _excitation_table(calibration: Calibration) -> Table:
    """Show each raw direction as the wrench that one standard deviation of it means."""
    validity = calibration.validity
    condition = "infinite" if validity.condition is None else f"{validity.condition:.3g}"
    headings = [f"{component}, {unit}" for component, unit in zip(WRENCH_COMPONENTS, WRENCH_UNITS, strict=True)]
    made = table(
        "excited",
        "explained by loads",
        "counts",
        *headings,
        title=f"motion along each raw direction, one deviation: rank {validity.rank} of {len(validity.explained)}, "
        f"condition {condition}",
    )
    for direction, variance, explained, excited in zip(
        validity.directions, validity.variance_counts2, validity.explained, validity.excited, strict=True
    ):
        deviation = math.sqrt(variance)
        wrench = calibration.matrix @ direction * deviation
        made.add_row(
            "yes" if excited else "NO",
            f"{100 * explained:.0f} %",
            f"{deviation:.1f}",
            *(f"{value:+.3f}" for value in wrench),
        )
    return made
