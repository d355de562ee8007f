# SPDX-License-Identifier: BSD-3-Clause
"""Whether the three axes of a sensor measure the same weight of a limb that is carried around."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import ClassVar, Literal

from pydantic import Field

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, ForceTorqueError
from forcetorque.evaluation.sphere.ellipsoid import RULE, TOLERANCE
from forcetorque.evaluation.sphere.result import EllipsoidRow, FailureRow, SphereRow
from forcetorque.evaluation.sphere.sensor_sphere import SensorSphere, sensor_spheres, sphere_intervals
from forcetorque.experiment.applicability import by_sensor
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibrations_under_test import Calibrations, named
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.named_files import stated_in
from forcetorque.experiment.recording_notes import with_recording_notes
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.results.number_text import interval, number
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Table, short_names

MEANING = (
    "mass: where an axis leaves the ellipsoid, over gravity; error: that force minus the weight by the model; "
    "index: standard deviation of the three masses; known: whether they are worth comparing"
)
"""What the columns of the masses are."""


def mass_table(rows: Sequence[SphereRow], caption: str) -> Table:
    """Show masses, errors and index in the form of thesis Table 4.1, with and without the model.

    Args:
        rows: Spheres of one sensor.
        caption: What the table shows.

    Returns:
        A line per candidate and fit.
    """
    return Table(
        caption=caption,
        headings=("calibration", "fit", "x, kg", "y, kg", "z, kg", "error x, N", "y, N", "z, N", "index, kg", "known"),
        rows=tuple(
            (candidate, words, *_three(fit.mass_kg, 3), *_three(fit.error_N, 2), number(fit.index_kg, 3),
             _known(fit.identifiable))
            for candidate, words, _, fit in _fits(rows)
        ),
    )  # fmt: skip


def interval_table(rows: Sequence[SphereRow]) -> Table:
    """Show what the recording allows masses and index to be.

    Args:
        rows: Spheres of one sensor.

    Returns:
        A line per candidate and fit.
    """
    return Table(
        caption="what the recording allows: intervals of 95 %, which with the model take its masses and the joint "
        "angles as exact",
        headings=("calibration", "fit", "x, kg", "y, kg", "z, kg", "index, kg", "fitted on"),
        rows=tuple(
            (candidate, words,
             *(interval(low, high, digits=3) for low, high in zip(fit.mass_low_kg, fit.mass_high_kg, strict=True)),
             interval(fit.index_low_kg, fit.index_high_kg, digits=3), ", ".join(row.fitted_on) or "nothing of these")
            for candidate, words, row, fit in _fits(rows)
        ),
    )  # fmt: skip


def moment_table(rows: Sequence[SphereRow]) -> Table | None:
    """Show how far moments reach while the force goes over its sphere.

    Args:
        rows: Spheres of one sensor.

    Returns:
        Three lines per candidate; None where nothing was compared with the model.
    """
    names = short_names([row.calibration for row in rows])
    lines: list[tuple[str, ...]] = []
    for row in rows:
        fit, name = row.moment_with_model, names[row.calibration]
        if fit is not None:
            ends = (interval(low, high, digits=3) for low, high in zip(fit.low_Nm, fit.high_Nm, strict=True))
            measured = (*_three(fit.half_width_Nm, 3), number(fit.index_Nm, 3), _known(fit.identifiable))
            lines.append((name, "measured", *measured))
            lines.append((name, "interval", *ends, "", ""))
            lines.append((name, "by the model", *_three(fit.expected_half_width_Nm, 3), "", ""))
    if not lines:
        return None
    return Table(
        caption="largest moment about each axis while the force goes over its sphere",
        headings=("calibration", "moment", "x, N m", "y, N m", "z, N m", "index, N m", "known"),
        rows=tuple(lines),
    )


def remarks(rows: Sequence[SphereRow], gravity: float) -> Iterator[str]:
    """Say what the masses rest on, and why something is not known.

    Args:
        rows: Spheres of one sensor, at least one.
        gravity: Magnitude of gravity; m/s2.

    Yields:
        Sentences.
    """
    first, names = rows[0], short_names([row.calibration for row in rows])
    if first.model_mass_kg is not None:
        yield f"the model has {first.model_mass_kg:.3f} kg on the sensor; gravity {gravity:g} m/s2"
    if first.no_model is not None:
        yield f"no fit with the model: {first.no_model}"
    for row in rows:
        name, one = names[row.calibration], row.one_radius
        mass = "none" if one.geometric_mass_kg is None else f"{one.geometric_mass_kg:.3f} kg"
        verdict = "" if one.identifiable else f", not identifiable: {'; '.join(one.why)}"
        yield f"{name}, one radius: {mass}, {interval(one.mass_low_kg, one.mass_high_kg, digits=2)} kg{verdict}"
        if row.with_model is not None and row.with_model.why:
            yield f"{name}, with the model: not identifiable: {'; '.join(row.with_model.why)}"
        if row.without_model.why:
            share = row.directions_covered
            covered = "" if share is None else f", {100.0 * share:.0f} % of all directions"
            yield f"{name}, without: a {row.form}{covered}; not identifiable: {'; '.join(row.without_model.why)}"
        if row.moment_with_model is not None and row.moment_with_model.why:
            yield f"{name}, moments: not identifiable: {'; '.join(row.moment_with_model.why)}"
        for words, fit in (("with the model", row.with_model), ("without", row.without_model)):
            if fit is not None and fit.identifiable and not fit.tilt_identifiable:
                yield f"{name}, {words}: half-widths and principal radii, which lie between the axes, are not known"


def _fits(rows: Sequence[SphereRow]) -> Iterator[tuple[str, str, SphereRow, EllipsoidRow]]:
    names = short_names([row.calibration for row in rows])
    for row in rows:
        for words, fit in (("with model", row.with_model), ("without", row.without_model)):
            if fit is not None:
                yield names[row.calibration], words, row, fit


def _three(values: FloatArray | None, digits: int) -> tuple[str, ...]:
    return ("-",) * 3 if values is None else tuple(number(value, digits) for value in values)


def _known(identifiable: bool) -> str:
    return "yes" if identifiable else "no"


__all__ = ["SensorSphere", "SphereRow", "Spheres", "spheres", "spheres_of_sensors"]


class Spheres(DrawnResult):
    """Apparent masses of the axes of sensors, with and without the model, and what they are worth."""

    answered_by: ClassVar[str | None] = "forcetorque.evaluation.sphere.answers:sphere_answers"
    drawn_by: ClassVar[str] = "forcetorque.evaluation.figures.sphere:sphere_figure"
    drawn_fields: ClassVar[tuple[str, ...]] = ("analyses",)

    interval_uses = ()

    schema_name: Literal["forcetorque/sphere/2"] = Field(default="forcetorque/sphere/2", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment."""
    gravity_m_s2: float
    """Magnitude of gravity."""
    tolerance: float
    """Half width of an interval, relative to the mean radius, up to which a number is identifiable."""
    rule: str = Field(repr=False)
    """How it is decided what is identifiable."""
    rows: tuple[SphereRow, ...]
    """One per sensor and way to read it."""
    failures: tuple[FailureRow, ...]
    """Sensors that could not be analysed; the exit code is 1 if there is any, and 2 if there are no others."""
    analyses: tuple[SensorSphere, ...] = Field(default=(), exclude=True, repr=False)
    """The forces and fits behind every row, for figures."""

    @property
    def passed(self) -> bool:
        """Whether no sensor failed."""
        return all(failure.skipped for failure in self.failures)

    def blocks(self) -> Iterator[Table | str]:
        """Give masses, intervals and moments of every sensor.

        Yields:
            Tables and sentences.
        """
        for sensor in dict.fromkeys(row.sensor for row in self.rows):
            rows = [row for row in self.rows if row.sensor == sensor]
            samples = f"{rows[0].samples} samples of {', '.join(rows[0].intervals)}"
            yield mass_table(rows, f"{self.experiment}: {sensor} ({rows[0].serial}), {samples}")
            yield interval_table(rows)
            yield from remarks(rows, self.gravity_m_s2)
            moments = moment_table(rows)
            if moments is not None:
                yield moments
        yield MEANING
        yield from (failure.sentence for failure in self.failures)


@with_recording_notes
def spheres(
    run: SensorRun, calibrations: Calibrations | None = None, intervals: Sequence[str] | None = None
) -> Spheres:
    """Compare how the three axes of a sensor weigh the limb that is carried around.

    Args:
        run: The sensor.
        calibrations: Its calibrations by name, or one, to compare with its prior.
        intervals: Labels or kinds of the intervals whose motion draws the sphere; None for the sphere intervals of the
            experiment file, else all.

    Returns:
        A row for the prior and for every calibration, on the same samples.

    Raises:
        ForceTorqueError: If a fit fails.
        ExperimentError: If an interval is not there, there is no way to read the sensor, a calibration may not be
            applied, or the supports of the intervals are on both sides of the sensor.
    """
    analyses = sensor_spheres(run, named(calibrations), sphere_intervals(run.experiment, intervals))
    return Spheres(
        experiment=run.experiment.name,
        gravity_m_s2=run.experiment.processing.gravity,
        tolerance=TOLERANCE,
        rule=RULE,
        figure=None,
        rows=tuple(SphereRow.of(analysis) for analysis in analyses),
        failures=(),
        analyses=analyses,
        warnings=tuple(dict.fromkeys(words for analysis in analyses for words in analysis.doubts())),
    )


@with_recording_notes
def spheres_of_sensors(
    experiment: Experiment,
    sensors: Sequence[ExperimentSensor],
    calibrations: Mapping[str, Calibration],
    intervals: Sequence[str] | None = None,
    *,
    file: str,
    named_by_caller: bool = True,
    progress: Callable[[str], None] | None = None,
) -> Spheres:
    """Analyse one sensor after the other; what fails does not stop the others.

    Args:
        experiment: The experiment.
        sensors: Those of its sensors that are asked for.
        calibrations: Calibrations by name, of any of its sensors.
        intervals: As `spheres` takes them.
        file: The experiment file, for messages.
        named_by_caller: Whether somebody named these sensors; of all of a file those that nothing turned are left out.
        progress: Called with a line for people at every sensor.

    Returns:
        Rows of the sensors that could be analysed; of the others failures, each with a warning, or that nothing turned
        them.

    Raises:
        ExperimentError: If an interval is not there, a calibration is of no sensor of the experiment, or no sensor can
            be analysed.
    """
    groups = by_sensor(experiment, calibrations)
    with stated_in(file):
        sphere_intervals(experiment, intervals)  # a wrong name is no failure of a sensor
    results: list[Spheres] = []
    failures: list[FailureRow] = []
    for sensor in sensors:
        if progress is not None:
            progress(f"analysing {sensor.name}")
        try:
            results.append(spheres(SensorRun(experiment, sensor), groups.get(sensor.name, {}), intervals))
        except ForceTorqueError as error:
            failures.append(FailureRow.of(file, sensor.name, error, named=named_by_caller))
    if not results:
        raise ExperimentError("; ".join(failure.message for failure in failures))
    together = Spheres.together(results)
    failed = (failure.sentence for failure in failures if not failure.skipped)
    return together.model_copy(update={"failures": tuple(failures), "warnings": (*failed, *together.warnings)})
