# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque evaluate`, `accept`, `compare`, `sphere` and `validate`."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from forcetorque.results.terminal.options import (
    CalibrationsOption,
    ComparedCalibrationsOption,
    ExperimentArgument,
    ExperimentsArgument,
    FormatOption,
    PopulationOption,
    SensorOption,
    SphereIntervalOption,
)
from forcetorque.results.terminal.output import (
    Format,
    OtherSensorsChoice,
    TrialsChoice,
    show,
    start_logging,
    stop_at_failures,
)

if TYPE_CHECKING:
    from forcetorque.evaluation.trials.comparison import Comparison


def evaluate(
    experiments: ExperimentsArgument,
    calibration: Annotated[
        list[Path], typer.Option("--calibration", "-c", help="Calibration file; repeat to compare several.")
    ],
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Judge calibrations on the validation intervals, prior against new.

    Example: forcetorque evaluate experiment.toml --calibration right_leg.json

    Python: `run.evaluate(calibration)`, over experiments `evaluation.evaluate([run, other["arm_ft"]],
    calibration)`
    """
    from forcetorque.evaluation.evaluation import Evaluation, evaluate
    from forcetorque.experiment.applicability import by_sensor
    from forcetorque.experiment.input_files import stated_in
    from forcetorque.results.terminal.reading import campaign_of, read_calibrations, read_experiments

    log = start_logging()
    calibrations = read_calibrations(calibration)
    contents = read_experiments(experiments, log)
    results = []
    for sensor, group in by_sensor(next(iter(contents.values())), calibrations).items():
        log.info("judging %s", sensor)
        campaign = campaign_of(contents, sensor)
        with stated_in(f"{experiments[0]}: sensor {sensor!r}" if len(experiments) == 1 else f"sensor {sensor!r}"):
            results.append(evaluate(campaign, group))
    show(Evaluation.together(results), output_format)


def accept(
    experiments: ExperimentsArgument,
    spec: Annotated[
        Path, typer.Option("--spec", help="Acceptance file (TOML) with the limits; see docs/evaluation/acceptance.md.")
    ],
    calibration: CalibrationsOption = None,
    population: PopulationOption = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Accept or reject sensors by limits; exit code 1 if one fails.

    Example: forcetorque accept experiment.toml --spec limits.toml -c leg.json

    Python: `run.accept("limits.toml", calibration)`
    """
    from forcetorque.evaluation.acceptance.acceptance import Acceptance, accept
    from forcetorque.evaluation.acceptance.acceptance_file import read_acceptance
    from forcetorque.experiment.applicability import one_per_sensor, read_population
    from forcetorque.experiment.input_files import stated_in
    from forcetorque.results.terminal.reading import campaign_of, read_calibrations, read_experiments

    log = start_logging()
    stated = read_acceptance(spec)
    calibrations = read_calibrations(calibration)
    matrices = read_population(population) if population else None
    contents = read_experiments(experiments, log)
    content = next(iter(contents.values()))
    chosen = one_per_sensor(content, calibrations)
    results = []
    for sensor in content.sensors:
        if chosen and sensor.name not in chosen:
            continue
        log.info("judging %s", sensor.name)
        others = {name: other for place, (name, other) in chosen.items() if place != sensor.name}
        campaign, judged = campaign_of(contents, sensor.name), chosen.get(sensor.name)
        with stated_in(str(spec)):
            results.append(accept(campaign, stated, judged, others=others, population=matrices))
    result = Acceptance.together(results)
    show(result, output_format)
    if not result.accepted:
        sys.exit(1)


def compare(
    experiments: Annotated[
        list[Path],
        typer.Argument(help="Experiment files (TOML), in the order of the trials; see docs/evaluation/sphere.md."),
    ],
    sensor: SensorOption = None,
    calibration: ComparedCalibrationsOption = None,
    interval: SphereIntervalOption = None,
    trials: Annotated[
        TrialsChoice,
        typer.Option("--trials", help="Whether a trial is a file with all its intervals, or each interval."),
    ] = TrialsChoice.FILES,
    figure: Annotated[
        Path | None, typer.Option("--figure", help="PNG of the indices of trials, their mean and the pooled fit.")
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Compare the spheres of many sensors, mountings and trials.

    Example: forcetorque compare first.toml second.toml third.toml

    Python: `evaluation.compare(["first.toml", "second.toml"])`
    """
    from forcetorque.evaluation.trials.comparison import compare
    from forcetorque.results.terminal.output import refuse_figure
    from forcetorque.results.terminal.reading import read_calibrations

    log = start_logging()
    refuse_figure(figure)
    result = compare(
        experiments,
        sensors=sensor,
        calibrations=read_calibrations(calibration),
        intervals=interval,
        by_interval=trials is TrialsChoice.INTERVALS,
        progress=log.info,
    )
    if figure is not None and result.analyses:
        result = _drawn(result, figure)
    show(result, output_format)
    stop_at_failures(result.failures)


def _drawn(result: Comparison, figure: Path) -> Comparison:
    """Draw the figure, and name it if it was drawn; what fails then must not cost the result."""
    from forcetorque.base.errors import ForceTorqueError
    from forcetorque.base.output_file import write_bytes_atomically
    from forcetorque.evaluation.figures.sphere import index_figure
    from forcetorque.evaluation.sphere.result import FailureRow
    from forcetorque.results.figures import png_bytes

    try:
        write_bytes_atomically(figure, png_bytes(index_figure(result.analyses)))
    except (ForceTorqueError, OSError) as error:
        failure = FailureRow(file=str(figure), sensor=None, message=" ".join(str(error).split()))
        return result.model_copy(update={"failures": (*result.failures, failure)})
    return result.model_copy(update={"figure": str(figure)})


def sphere(
    experiment: ExperimentArgument,
    sensor: SensorOption = None,
    calibration: ComparedCalibrationsOption = None,
    interval: SphereIntervalOption = None,
    figure: Annotated[
        Path | None, typer.Option("--figure", help="PNG of the forces, the ellipsoids and the weight by the model.")
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Compare how the three axes weigh a limb that is carried around.

    Example: forcetorque sphere experiment.toml --interval grid

    Python: `run.sphere(calibration)`
    """
    from forcetorque.base.output_file import write_bytes_atomically
    from forcetorque.evaluation.sphere.sphere import spheres_of_sensors
    from forcetorque.results.terminal.output import refuse_figure
    from forcetorque.results.terminal.reading import read_calibrations, read_experiment, refuse_left_out, sensors_named

    log = start_logging()
    refuse_figure(figure)
    calibrations = read_calibrations(calibration)
    content = read_experiment(experiment, log)
    chosen = sensors_named(content, sensor)
    refuse_left_out(content, chosen, calibrations)
    result = spheres_of_sensors(content, chosen, calibrations, interval, file=str(experiment), progress=log.info)
    if figure is not None:
        from forcetorque.evaluation.figures.sphere import sphere_figure
        from forcetorque.results.figures import png_bytes

        write_bytes_atomically(figure, png_bytes(sphere_figure(result.analyses)))
        result = result.model_copy(update={"figure": str(figure)})
    show(result, output_format)
    stop_at_failures(result.failures)


def validate(
    experiments: ExperimentsArgument,
    calibration: CalibrationsOption = None,
    sensor: Annotated[
        list[str] | None,
        typer.Option(
            "--sensor", help="Sensor to judge; repeat for more. Default: those of the calibrations, else all."
        ),
    ] = None,
    sub_model: Annotated[
        str | None,
        typer.Option(
            "--sub-model",
            help="Part of the robot that nothing touches, by the sensor at its base or the root link. Default: that "
            "beyond the sensor.",
        ),
    ] = None,
    contact: Annotated[
        str | None,
        typer.Option("--contact", help="Link at whose origin the contact is estimated. Default: that on the sensor."),
    ] = None,
    others: Annotated[
        OtherSensorsChoice,
        typer.Option("--others", help="What the other sensors of the part read: what the model expects, or measured."),
    ] = OtherSensorsChoice.MODEL,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Judge calibrations by contact force and joint torques where nothing touches.

    Example: forcetorque validate experiment.toml -c right_leg.json

    Python: `run.validate(calibration)`
    """
    from forcetorque.evaluation.validation.validation import Validation, validate
    from forcetorque.experiment.applicability import by_sensor, one_per_sensor
    from forcetorque.experiment.free_sub_model import OtherSensors
    from forcetorque.experiment.input_files import stated_in
    from forcetorque.results.terminal.reading import campaign_of, read_calibrations, read_experiments

    log = start_logging()
    calibrations = read_calibrations(calibration)
    contents = read_experiments(experiments, log)
    content = next(iter(contents.values()))
    groups = by_sensor(content, calibrations)
    names = sensor or groups or [known.name for known in content.sensors]
    results = []
    for name in dict.fromkeys(content.sensor(known).name for known in names):
        log.info("validating %s", name)
        rest = {file: one for other, group in groups.items() if other != name for file, one in group.items()}
        if others is OtherSensorsChoice.MEASURED:
            one_per_sensor(content, rest)
        campaign = campaign_of(contents, name)
        with stated_in(f"{experiments[0]}: sensor {name!r}" if len(experiments) == 1 else f"sensor {name!r}"):
            validation = validate(
                campaign,
                groups.get(name, {}),
                others=rest,
                other_sensors=OtherSensors(others.value),
                sub_model=sub_model,
                contact=contact,
            )
        results.append(validation)
    show(Validation.together(results), output_format)
