# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque evaluate`, `accept`, `compare`, `sphere` and `validate`."""

from collections.abc import Collection, Sequence
from contextlib import nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from forcetorque.results.command import SENSORS, Option, command

if TYPE_CHECKING:
    from collections.abc import Mapping

    from forcetorque.base.progress import Progress
    from forcetorque.evaluation.acceptance.acceptance import Acceptance
    from forcetorque.evaluation.acceptance.acceptance_file import AcceptanceFile
    from forcetorque.evaluation.evaluation import Evaluation
    from forcetorque.evaluation.sphere.sphere import Spheres
    from forcetorque.evaluation.trials.comparison import Comparison
    from forcetorque.evaluation.validation.validation import Validation
    from forcetorque.experiment.applicability import Population
    from forcetorque.experiment.calibration.calibration_file import Calibration
    from forcetorque.experiment.calibrations_under_test import Calibrations, OneCalibration, OtherCalibrations
    from forcetorque.experiment.campaign import Runs
    from forcetorque.experiment.experiment import Experiment
    from forcetorque.experiment.free_sub_model import OtherSensors

_COMPARED_CALIBRATIONS = Option(
    "Calibration file to compare with the prior.",
    "--calibration",
    "-c",
    typed=list[Path],
    reads="forcetorque.results.terminal.command_inputs:read_calibrations",
)
_SPHERE_INTERVALS = Option(
    "Label or kind of an interval whose motion draws a sphere. Default: the sphere intervals of each file, else all.",
    "--interval",
)


@command(figure="the predicted errors at the loads of use, of calibration and prior matrix")
def evaluate(
    run: Annotated[
        "Runs", Option("Sensor in one recording or in several; their validation intervals are evaluated.", "--sensor")
    ],
    calibrations: Annotated[
        "Calibrations | None",
        Option("Calibration of the sensor, several to compare, or a folder of them.", required=True),
    ] = None,
) -> "Evaluation":
    """Evaluate calibrations on the validation intervals, prior against new.

    Example: forcetorque evaluate experiment.toml --calibration right_leg.json

    Python: `run.evaluate(calibration)`, over experiments `evaluation.evaluate([run, other["arm_ft"]],
    calibration)`

    Returns:
        For every calibration and prior the errors with the offset of the fitted data, and with the mean of the
        validation data of each recording removed; a prior that several calibrations share comes once. Errors of several
        recordings are pooled before anything is averaged. And whether each may be used for the load cases.

    Raises:
        SerialNumberError: If a calibration is of another sensor.
        ExperimentError: If a validation interval was fitted, two recordings have the same readings, the robot now
            reads the sensor in another frame or sign, or a load case cannot occur at the sensor.
        FitError: If a load case changes a variable that a calibration does not know.
        ShapeError: If a matrix does not have one column per channel of the sensor.
    """
    from forcetorque.evaluation.evaluation import validation_errors
    from forcetorque.evaluation.load_cases.verdict import use_verdicts
    from forcetorque.experiment.calibrations_under_test import named
    from forcetorque.experiment.campaign import Campaign

    campaign, by_name = Campaign.of(run), named(calibrations)
    errors = validation_errors(campaign, by_name)
    return errors.model_copy(update={"load_cases": use_verdicts(campaign, by_name)})


@command("every criterion as a share of its limit")
def accept(
    run: Annotated["Runs", Option("Sensor in one recording or in several, whose errors are pooled.", "--sensor")],
    spec: Annotated[
        "AcceptanceFile | Path | str",
        Option("Acceptance file (TOML) with the limits; see docs/evaluation/acceptance.md.", "--spec"),
    ],
    calibration: Annotated["OneCalibration | None", Option("Calibration of the sensor. Default: its prior.")] = None,
    *,
    others: Annotated[
        "OtherCalibrations | None", Option("Calibrations of the other sensors by name, as of `validate`.")
    ] = None,
    population: Annotated[
        "Population | None",
        Option(
            "Matrix of another sensor by serial number; a matrix file, a calibration, or a folder of them.",
            typed=list[Path],
            reads="forcetorque.experiment.applicability:read_population",
        ),
    ] = None,
) -> "Acceptance":
    """Accept or reject sensors by limits; exit code 1 if one fails.

    Example: forcetorque accept experiment.toml --spec limits.toml -c leg.json

    Python: `run.accept("limits.toml", calibration)`

    Returns:
        Criteria in the order of the acceptance file, each with what was measured, and static checks.

    Raises:
        ForceTorqueError: If a limit is specified for what cannot be measured; the message names its table.
    """
    from forcetorque.evaluation.acceptance.acceptance import accept
    from forcetorque.evaluation.acceptance.acceptance_file import AcceptanceFile, read_acceptance
    from forcetorque.experiment.calibrations_under_test import one_named
    from forcetorque.experiment.named_files import stated_in

    limits = spec if isinstance(spec, AcceptanceFile) else read_acceptance(spec)
    name, reader = one_named(calibration)
    chosen = None if name is None or reader is None else (name, reader)
    with nullcontext() if isinstance(spec, AcceptanceFile) else stated_in(str(spec)):
        return accept(run, limits, chosen, others=others, population=population)


@command("contact force and joint torques by calibration, with their intervals")
def validate(
    run: Annotated[
        "Runs", Option("Sensor in one recording or in several; their validation intervals are evaluated.", "--sensor")
    ],
    calibrations: Annotated["Calibrations | None", Option("Calibration of the sensor. Default: its prior.")] = None,
    *,
    others: Annotated[
        "OtherCalibrations | None",
        Option("Calibrations of the other sensors by name, for `measured`; their priors where there is none."),
    ] = None,
    other_sensors: Annotated[
        "OtherSensors | str",
        Option(
            "What the other sensors of the sub-model read: what the model expects, or measured.",
            "--others",
            choices=("model", "measured"),
        ),
    ] = "model",
    sub_model: Annotated[
        str | None,
        Option(
            "Sub-model that nothing touches, by the sensor at its base or the root link. Default: that beyond the "
            "sensor."
        ),
    ] = None,
    contact: Annotated[
        str | None, Option("Link at whose origin the contact is estimated. Default: that on the sensor.")
    ] = None,
) -> "Validation":
    """Evaluate calibrations by contact force and joint torques without contact.

    Example: forcetorque study validate experiment.toml -c right_leg.json

    Python: `run.validate(calibration)`

    Returns:
        Contact forces and joint torques of every calibration and prior.

    Raises:
        ExperimentError: If there is no validation interval, or one has no support.
    """
    from forcetorque.evaluation.validation.validation import validation
    from forcetorque.experiment.calibrations_under_test import named
    from forcetorque.experiment.campaign import Campaign
    from forcetorque.experiment.free_sub_model import OtherSensors, SubModelChoice

    mode = OtherSensors(other_sensors)
    choice = SubModelChoice(others=others, other_sensors=mode, sub_model=sub_model, contact=contact)
    return validation(Campaign.of(run), named(calibrations), choice)


@command("the indices of trials, their mean and the pooled fit")
def compare(
    experiments: Annotated[
        "Sequence[Path | str]",
        Option("Experiment files (TOML), in the order of the trials; see docs/evaluation/sphere.md.", typed=list[Path]),
    ],
    *,
    sensors: Annotated[Collection[str], SENSORS] = (),
    calibrations: Annotated["Mapping[str, Calibration] | None", _COMPARED_CALIBRATIONS] = None,
    intervals: Annotated[Collection[str], _SPHERE_INTERVALS] = (),
    by_interval: Annotated[
        bool,
        Option(
            "Whether a trial is a file with all its intervals, or each interval. Default: files.",
            "--trials",
            choices=("files", "intervals"),
            reads=lambda choice: choice == "intervals",
        ),
    ] = False,
    progress: Annotated[
        "Progress", Option("Called with a line for people at every file, and at every group that is pooled.")
    ] = lambda _: None,
) -> "Comparison":
    """Compare the spheres of many sensors, mountings and trials.

    Example: forcetorque study compare first.toml second.toml third.toml

    Python: `evaluation.compare(["first.toml", "second.toml"])`

    Returns:
        Trials sorted by sensor, condition and way of reading, and what failed, which does not stop the others.

    Raises:
        MissingFileError: If a file is not there; nothing has been read then.
        ExperimentError: If a file is named twice.
    """
    from forcetorque.evaluation.trials.comparison import Comparison
    from forcetorque.evaluation.trials.trials import read_trials

    trials, failures = read_trials(
        experiments,
        sensors=sensors or None,
        calibrations=calibrations,
        intervals=tuple(intervals) or None,
        by_interval=by_interval,
        progress=progress,
    )
    return Comparison.of(trials, failures, progress)


@command("the forces, the ellipsoids and the weight by the model")
def sphere(
    experiment: Annotated["Experiment", Option("Experiment in which a limb is carried around.")],
    sensors: Annotated[Collection[str], SENSORS] = (),
    calibrations: Annotated["Mapping[str, Calibration] | None", _COMPARED_CALIBRATIONS] = None,
    intervals: Annotated[Collection[str], _SPHERE_INTERVALS] = (),
    *,
    progress: Annotated["Progress", Option("Called with a line for people at every sensor.")] = lambda _: None,
) -> "Spheres":
    """Compare how the three axes weigh a limb that is carried around.

    Example: forcetorque study sphere experiment.toml --interval grid

    Python: `run.sphere(calibration)`

    Returns:
        Rows of the sensors that could be analysed; failures, each with a warning, of the others.

    Raises:
        ExperimentError: If an interval is not there, a calibration is of no sensor, or of one that is not named, or no
            sensor can be analysed.
    """
    from forcetorque.evaluation.sphere.sphere import spheres_of_sensors
    from forcetorque.results.terminal.command_inputs import refuse_left_out, sensors_named

    chosen, by_name = sensors_named(experiment, sensors), dict(calibrations or {})
    refuse_left_out(experiment, chosen, by_name)
    file = str(experiment.file)
    return spheres_of_sensors(
        experiment,
        chosen,
        by_name,
        tuple(intervals) or None,
        file=file,
        named_by_caller=bool(sensors),
        progress=progress,
    )
