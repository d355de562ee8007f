# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque sphere`: the ellipsoid that a sensor makes of the sphere that gravity draws."""

from __future__ import annotations

import logging
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import typer

from forcetorque.analysis import SensorSphere, analyse_sensor, sphere_intervals
from forcetorque.analysis.applicability import by_sensor
from forcetorque.atomic import write_bytes_atomically
from forcetorque.cli.figure_file import refuse_figure
from forcetorque.cli.output import Format, console, print_result, start_logging, table
from forcetorque.cli.reading import read_calibrations, read_experiment, refuse_left_out, sensors_named
from forcetorque.cli.sphere_result import EllipsoidRow, FailureRow, SphereResult, SphereRow, flat_row, sphere_row
from forcetorque.errors import ExperimentError, ForceTorqueError
from forcetorque.evaluation.sphere import RULE, TOLERANCE
from forcetorque.experiment.inputs import stated_in
from forcetorque.result.names import short_names

if TYPE_CHECKING:
    from rich.table import Table

    from forcetorque.calibration import Calibration
    from forcetorque.experiment import Experiment, ExperimentSensor
    from forcetorque.recording import Interval


def run(
    path: Path,
    *,
    sensors: list[str] | None,
    calibrations: list[Path] | None,
    intervals: list[str] | None,
    figure: Path | None,
    output_format: Format,
) -> None:
    """Analyse the spheres of the sensors of an experiment.

    Args:
        path: Experiment file.
        sensors: Names of sensors; None for all.
        calibrations: Calibration files to compare with the prior.
        intervals: Labels or kinds of the intervals whose motion draws the sphere; None for what the file says.
        figure: PNG file to draw.
        output_format: Form of the result.

    Raises:
        ForceTorqueError: If a name or a file is not what it should be.
        ExperimentError: If no sensor can be analysed.
        Exit: With code 1 if a sensor failed; the result has the others.
    """
    log = start_logging()
    refuse_figure(figure)
    loaded = read_calibrations(calibrations)
    experiment = read_experiment(path, log)
    chosen = sensors_named(experiment, sensors)
    refuse_left_out(experiment, chosen, loaded)
    groups = by_sensor(experiment, loaded)
    with stated_in(str(path)):
        spans = sphere_intervals(experiment, intervals)
    found, failures = _analysed(str(path), experiment, chosen, spans, groups, log)
    if not found:
        raise ExperimentError("; ".join(failure.message for failure in failures))
    for failure in failures:
        log.warning("failed: %s", failure.message)
    for each in found:
        if each.fitted_on:
            labels = ", ".join(map(repr, each.fitted_on))
            log.warning("%s was fitted on %s, so the verdict on it flatters", each.candidate, labels)
    if figure is not None:
        from forcetorque.report.figures import sphere_figure

        write_bytes_atomically(figure, sphere_figure(found))
    result = SphereResult(
        experiment=experiment.name,
        gravity_m_s2=experiment.processing.gravity,
        tolerance=TOLERANCE,
        rule=RULE,
        figure=None if figure is None else str(figure),
        rows=[sphere_row(each) for each in found],
        failures=failures,
    )
    rows = [flat_row(row) for row in result.rows]
    print_result(result.model_dump(mode="json", by_alias=True), rows, output_format, show=lambda: _show(result))
    if failures:
        raise typer.Exit(1)


def _analysed(
    file: str,
    experiment: Experiment,
    sensors: Iterable[ExperimentSensor],
    spans: Sequence[Interval],
    calibrations: Mapping[str, Mapping[str, Calibration]],
    log: logging.Logger,
) -> tuple[list[SensorSphere], list[FailureRow]]:
    """Analyse one sensor after the other; what fails does not stop the others."""
    found: list[SensorSphere] = []
    failures: list[FailureRow] = []
    for sensor in sensors:
        log.info("analysing %s", sensor.name)
        try:
            found += analyse_sensor(experiment, sensor, spans, calibrations.get(sensor.name, {}))
        except (ForceTorqueError, np.linalg.LinAlgError) as error:
            message = " ".join(str(error).split())
            named = message if sensor.name in message else f"sensor {sensor.name!r}: {message}"
            failures.append(FailureRow(file=file, sensor=sensor.name, message=f"{file}: {named}"))
    return found, failures


def _show(result: SphereResult) -> None:
    screen = console()
    names = short_names([row.candidate for row in result.rows])
    for sensor in dict.fromkeys(row.sensor for row in result.rows):
        rows = [row for row in result.rows if row.sensor == sensor]
        first = rows[0]
        screen.print(
            f"{result.experiment}: {sensor} ({first.serial}), {first.samples} samples of {', '.join(first.intervals)}",
            soft_wrap=True,
        )
        screen.print(_mass_table(rows, names))
        screen.print(_interval_table(rows, names))
        for line in _remarks(rows, names, result.gravity_m_s2):
            screen.print(line, soft_wrap=True)
        moments = [row for row in rows if row.moment_with_reference is not None]
        if moments:
            screen.print(_moment_table(moments, names))
    screen.print(
        "mass: where an axis leaves the ellipsoid, over gravity; error: that force minus the weight by the model; "
        "index: standard deviation of the three masses; known: whether they are worth comparing",
        soft_wrap=True,
    )
    for failure in result.failures:
        screen.print(f"FAILED: {failure.message}", soft_wrap=True)
    if result.figure is not None:
        screen.print(f"drawn to {result.figure}", soft_wrap=True)


def _mass_table(rows: Iterable[SphereRow], names: Mapping[str, str]) -> Table:
    made = table("candidate", "fit", "x, kg", "y, kg", "z, kg", "error x, N", "y, N", "z, N", "index, kg", "known")
    for candidate, label, fit in _fits(rows, names):
        masses = ["-"] * 3 if fit.mass_kg is None else [f"{mass:.3f}" for mass in fit.mass_kg]
        errors = ["-"] * 3 if fit.error_N is None else [f"{error:.2f}" for error in fit.error_N]
        index = "-" if fit.index_kg is None else f"{fit.index_kg:.3f}"
        made.add_row(candidate, label, *masses, *errors, index, _known(fit.identifiable))
    return made


def _interval_table(rows: Iterable[SphereRow], names: Mapping[str, str]) -> Table:
    made = table("candidate", "fit", "x, kg", "y, kg", "z, kg", "index, kg", title="what the recording allows")
    for candidate, label, fit in _fits(rows, names):
        ends = zip(fit.mass_low_kg, fit.mass_high_kg, strict=True)
        index = _interval(fit.index_low_kg, fit.index_high_kg)
        made.add_row(candidate, label, *(_interval(low, high) for low, high in ends), index)
    return made


def _fits(rows: Iterable[SphereRow], names: Mapping[str, str]) -> Iterator[tuple[str, str, EllipsoidRow]]:
    for row in rows:
        for label, fit in (("with model", row.with_reference), ("without", row.without_reference)):
            if fit is not None:
                yield names[row.candidate], label, fit


def _remarks(rows: list[SphereRow], names: Mapping[str, str], gravity: float) -> Iterator[str]:
    first = rows[0]
    if first.model_mass_kg is not None:
        yield f"the model has {first.model_mass_kg:.3f} kg on the sensor; gravity {gravity:g} m/s2"
    if first.no_reference is not None:
        yield f"no fit with the model: {first.no_reference}"
    for row in rows:
        name, one = names[row.candidate], row.one_radius
        mass = "none" if one.geometric_mass_kg is None else f"{one.geometric_mass_kg:.3f} kg"
        verdict = "" if one.identifiable else f", not identifiable: {'; '.join(one.why)}"
        yield f"{name}, one radius: {mass}, {_interval(one.mass_low_kg, one.mass_high_kg)} kg{verdict}"
        if row.with_reference is not None and row.with_reference.why:
            yield f"{name}, with the model: not identifiable: {'; '.join(row.with_reference.why)}"
        if row.without_reference.why:
            share = row.directions_covered
            covered = "" if share is None else f", {100.0 * share:.0f} % of all directions"
            yield f"{name}, without: a {row.form}{covered}; not identifiable: {'; '.join(row.without_reference.why)}"
        if row.moment_with_reference is not None and row.moment_with_reference.why:
            yield f"{name}, moments: not identifiable: {'; '.join(row.moment_with_reference.why)}"
        yield from _tilt_remark(row, name)


def _tilt_remark(row: SphereRow, name: str) -> Iterator[str]:
    for label, fit in (("with the model", row.with_reference), ("without", row.without_reference)):
        if fit is not None and fit.identifiable and not fit.tilt_identifiable:
            yield f"{name}, {label}: half-widths and principal radii, which lie between the axes, are not known"


def _moment_table(rows: Iterable[SphereRow], names: Mapping[str, str]) -> Table:
    made = table(
        "candidate", "x, N m", "y, N m", "z, N m", "model x, N m", "y, N m", "z, N m", "known",
        title="largest moment while the force goes over its sphere",
    )  # fmt: skip
    for row in rows:
        fit = row.moment_with_reference
        if fit is not None:
            made.add_row(
                names[row.candidate],
                *(f"{value:.3f}" for value in fit.half_width_Nm),
                *(f"{value:.3f}" for value in fit.expected_half_width_Nm),
                _known(fit.identifiable),
            )
    return made


def _interval(low: float, high: float | None) -> str:
    return f"{low:.2f} to {'any' if high is None else f'{high:.2f}'}"


def _known(identifiable: bool) -> str:
    return "yes" if identifiable else "no"
