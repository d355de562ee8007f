# SPDX-License-Identifier: BSD-3-Clause
"""How the three axes of a sensor weigh a limb that is carried around: the sphere that gravity draws, read by it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Literal

from pydantic import Field

from forcetorque.analysis.runs.added import with_recording_notes
from forcetorque.analysis.runs.applicability import by_sensor
from forcetorque.analysis.runs.named import Calibrations, named
from forcetorque.analysis.runs.sensor_run import SensorRun
from forcetorque.analysis.sphere.rows import FailureRow, SphereRow
from forcetorque.analysis.sphere.sensor_sphere import SensorSphere, sensor_spheres, sphere_intervals
from forcetorque.analysis.sphere.tables import MEANING, interval_table, mass_table, moment_table, remarks
from forcetorque.calibration import Calibration
from forcetorque.errors import ExperimentError, ForceTorqueError
from forcetorque.evaluation.sphere import RULE, TOLERANCE
from forcetorque.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.inputs import stated_in
from forcetorque.result import Result, Table

__all__ = ["SensorSphere", "SphereRow", "Spheres", "spheres", "spheres_of_sensors"]


class Spheres(Result):
    """Apparent masses of the axes of sensors, with and without the model, and what they are worth."""

    interval_uses = ()

    schema_name: Literal["forcetorque/sphere/1"] = Field(default="forcetorque/sphere/1", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment."""
    gravity_m_s2: float
    """Magnitude of gravity."""
    tolerance: float
    """Half width of an interval, relative to the mean radius, up to which a number is identifiable."""
    rule: str = Field(repr=False)
    """How it is decided what is identifiable."""
    figure: str | None
    """File of the figure."""
    rows: tuple[SphereRow, ...]
    """One per sensor and way to read it."""
    failures: tuple[FailureRow, ...]
    """Sensors that could not be analysed; the exit code is 1 if there is any, and 2 if there are no others."""
    analyses: tuple[SensorSphere, ...] = Field(default=(), exclude=True, repr=False)
    """The forces and fits behind every row, for figures."""

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
        yield from (f"FAILED: {failure.message}" for failure in self.failures)
        if self.figure is not None:
            yield f"drawn to {self.figure}"


@with_recording_notes
def spheres(run: SensorRun, calibrations: Calibrations, intervals: Sequence[str] | None = None) -> Spheres:
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
        warnings=tuple(
            f"{analysis.candidate} was fitted on {', '.join(map(repr, analysis.fitted_on))}, so the verdict on it "
            "flatters"
            for analysis in analyses
            if analysis.fitted_on
        ),
    )


@with_recording_notes
def spheres_of_sensors(
    experiment: Experiment,
    sensors: Sequence[ExperimentSensor],
    calibrations: Mapping[str, Calibration],
    intervals: Sequence[str] | None = None,
    *,
    file: str,
    progress: Callable[[str], None] | None = None,
) -> Spheres:
    """Analyse one sensor after the other; what fails does not stop the others.

    Args:
        experiment: The experiment.
        sensors: Those of its sensors that are asked for.
        calibrations: Calibrations by name, of any of its sensors.
        intervals: As `spheres` takes them.
        file: The experiment file, for messages.
        progress: Called with a line for people at every sensor.

    Returns:
        Rows of the sensors that could be analysed; failures, each with a warning, of the others.

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
            failures.append(FailureRow.of(file, sensor.name, error))
    if not results:
        raise ExperimentError("; ".join(failure.message for failure in failures))
    together = Spheres.together(results)
    failed = (f"failed: {failure.message}" for failure in failures)
    return together.model_copy(update={"failures": tuple(failures), "warnings": (*failed, *together.warnings)})
