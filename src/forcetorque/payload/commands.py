# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque payload` and `forcetorque tare`, and the file for a robot that both write."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from forcetorque.base.errors import ForceTorqueError
from forcetorque.base.input_file import accept_input
from forcetorque.base.output_file import STANDARD_OUTPUT, declare_outputs
from forcetorque.payload.export.formats import LoadFormat
from forcetorque.results.terminal.command_output import (
    Format,
    drawn_to,
    refuse_figure,
    refuse_two_on_standard_output,
    show,
    show_warnings,
    start_logging,
)
from forcetorque.results.terminal.options import (
    DetailsOption,
    ExperimentArgument,
    ForceOption,
    FormatOption,
    RecordingOption,
    SensorOption,
)

if TYPE_CHECKING:
    import logging

    from forcetorque.experiment.calibration.calibration_file import Calibration
    from forcetorque.experiment.experiment import Experiment, ExperimentSensor
    from forcetorque.payload.export.load_parameters import RobotLoad


LoadFormatOption = Annotated[
    LoadFormat | None, typer.Option("--to", help="Form of the file for a robot: its program, by name.")
]
LoadFileOption = Annotated[
    Path | None, typer.Option("--output", "-o", help="File for a robot, in the form of --to; - for standard output.")
]
OverrideOption = Annotated[
    str | None,
    typer.Option("--override", help="Reason to write a load that the answer withholds; it is written with it."),
]
WorldFrameOption = Annotated[
    str | None, typer.Option("--world-frame", help="Frame of tf whose z axis points up, for gravity-filter.")
]
SensorPoseOption = Annotated[
    tuple[float, float, float, float, float, float] | None,
    typer.Option(
        "--sensor-pose",
        help="Pose x y z (m) roll pitch yaw (rad) of the sensor, as in a URDF: in its parent body for mc-rtc, in the "
        "flange for an arm.",
    ),
]


def refuse_load_file(
    output: Path | None, to: LoadFormat | None, output_format: Format, override: str | None, *, force: bool
) -> None:
    """Say what is wrong with the file before anything is estimated.

    Args:
        output: File to write; None for none.
        to: Its form.
        output_format: Form of the result.
        override: As of the option.
        force: As of `declare_outputs`.

    Raises:
        ForceTorqueError: If one of file and form is missing, or the file cannot be written.
    """
    if (output is None) != (to is None):
        raise ForceTorqueError(
            f"expected both --to, out of {', '.join(LoadFormat)}, and --output, the file, or neither of them"
        )
    if output is not None and to is not None:
        from forcetorque.payload.export.export import override_file

        refuse_two_on_standard_output(output, output_format)
        declare_outputs(output, None if override is None else override_file(output, to), force=force)


def write_load(
    load: RobotLoad,
    output: Path,
    to: LoadFormat,
    *,
    world_frame: str | None,
    sensor_pose: tuple[float, ...] | None,
    log: logging.Logger,
) -> None:
    """Write the file and say what its program does.

    Args:
        load: The load.
        output: File to write.
        to: Its form.
        world_frame: As of the option.
        sensor_pose: As of the option.
        log: Where that goes.
    """
    from forcetorque.base.pose import make_pose, rotation_from_rpy
    from forcetorque.payload.export.export import export_load

    pose = None if sensor_pose is None else make_pose(rotation_from_rpy(sensor_pose[3:]), sensor_pose[:3])
    convention = export_load(load, output, to, world_frame=world_frame, body_H_sensor=pose)
    log.info("%s, for readings of %s: %s", output, load.direction, convention)
    if load.override is not None:
        log.warning("%s", load.override)


def payload(
    experiments: Annotated[
        list[Path],
        typer.Argument(
            help="Experiment files (TOML) with the same sensor, logs of arms whose format fixes frame and sign, or "
            "bags of ROS with tf; see docs/payload/payload.md."
        ),
    ],
    to: LoadFormatOption = None,
    output: LoadFileOption = None,
    world_frame: WorldFrameOption = None,
    sensor_pose: SensorPoseOption = None,
    override: OverrideOption = None,
    recording: RecordingOption = None,
    save_experiment: Annotated[
        Path | None,
        typer.Option("--save-experiment", help="Experiment file to write of a log; - for standard output."),
    ] = None,
    figure: Annotated[
        Path | None, typer.Option("--figure", help="PNG, SVG or PDF of mass and centre of mass with their intervals.")
    ] = None,
    force: ForceOption = False,
    details: DetailsOption = False,
    output_format: FormatOption = Format.TABLE,
) -> Any:
    """Estimate mass, centre of mass and bias of a wrist sensor's load.

    Example: forcetorque payload wrist.toml --to ft-tools -o load.yaml

    Of an arm by Universal Robots or Franka the log is enough: `forcetorque payload record.csv`; of another one a bag of
    ROS with wrenches and tf.

    Python: `run.payload()`, over experiments `payload.weigh_load([run, other["arm_ft"]])`; `--to`: loads of
    robots (docs/payload/robot_load.md)

    Returns:
        The `Result` that is shown.
    """
    from forcetorque.base.output_file import write_bytes_atomically
    from forcetorque.experiment.campaign_intervals import refuse_a_file_twice
    from forcetorque.experiment.loading import keep_experiment, load_experiment
    from forcetorque.experiment.named_files import stated_in
    from forcetorque.experiment.sensor_run import SensorRun
    from forcetorque.formats.decoded_parts_cache import parts_kept
    from forcetorque.formats.specified_keys import specified_keys
    from forcetorque.payload.export.export import require_agreeing_logs, robot_load
    from forcetorque.payload.identify import weigh_load, weighing_sensor
    from forcetorque.payload.log_without_experiment import (
        described_log,
        experiment_of_description,
        is_experiment_file,
        load_of_torque_logs,
        refuse_a_log_twice,
    )

    log = start_logging()
    _declare_experiment_file(experiments, save_experiment, output, output_format, force=force)
    refuse_load_file(output, to, output_format, override, force=force)
    refuse_figure(figure, force=force)
    refuse_a_file_twice(experiments)
    specified = specified_keys(recording or ())
    logs = [path for path in experiments if not is_experiment_file(path)]
    _refuse_without_log(logs, specified, save_experiment)
    refuse_a_log_twice(logs)
    runs, arms, torques = [], [], {}
    for path in experiments:
        log.info("reading %s", path)
        if path in logs:
            at = Path() if save_experiment in (None, STANDARD_OUTPUT) else save_experiment.parent
            with parts_kept():
                description = described_log(path, specified)
                if description.torques is not None:
                    torques[path] = description.torques
                    continue
                made, text, arm = experiment_of_description(path, description, specified, at)
            arms.append(arm)
            content = keep_experiment(path, made)
            if save_experiment is not None:
                write_bytes_atomically(save_experiment, text.encode())
        else:
            content = load_experiment(path)
        runs.append(SensorRun(content, weighing_sensor(content)))
    if torques:
        _refuse_beside_torques(experiments, torques, save_experiment, to)
        _refuse_places(next(iter(torques)), world_frame, sensor_pose)
        held = load_of_torque_logs(torques, specified)
        if output is not None and to is not None:
            with stated_in(", ".join(str(path) for path in experiments)):
                robot = held.robot_load(override=override)
            write_load(robot, output, to, world_frame=None, sensor_pose=None, log=log)
            held = held.model_copy(update={"robot_file": str(output)})
        if figure is not None:
            held = drawn_to(held, figure)
        if output == STANDARD_OUTPUT:
            show_warnings(held)
        else:
            show(held, output_format, details=details, experiments=experiments)
        return held
    with stated_in(", ".join(str(path) for path in experiments)):
        load = weigh_load(runs).model_copy(update={"arms": tuple(arms)})
        if output is not None and to is not None:
            require_agreeing_logs(load)
            robot = robot_load(runs[-1], load.sessions[-1].bias, weighed=load, override=override)
            log.info("the bias is that of %r, the last power-up; tare before use", load.sessions[-1].session)
            write_load(robot, output, to, world_frame=world_frame, sensor_pose=sensor_pose, log=log)
            load = load.model_copy(update={"robot_file": str(output)})
        if figure is not None:
            load = drawn_to(load, figure)
    if STANDARD_OUTPUT in (output, save_experiment):  # the file itself went there
        show_warnings(load)
    else:
        show(load, output_format, details=details, experiments=experiments)
    return load


def _declare_experiment_file(
    experiments: Sequence[Path],
    save_experiment: Path | None,
    output: Path | None,
    output_format: Format,
    *,
    force: bool,
) -> None:
    """Say what is wrong with the experiment file to write before anything is read; no input is replaced by it."""
    if save_experiment is None:
        return
    if save_experiment == output == STANDARD_OUTPUT:
        raise ForceTorqueError("--save-experiment -: expected a file beside --output -, got standard output for both")
    refuse_two_on_standard_output(save_experiment, output_format)
    declare_outputs(save_experiment, force=force)
    for path in experiments:
        accept_input(path)


def _refuse_without_log(logs: Sequence[Path], specified: Mapping[str, object], save_experiment: Path | None) -> None:
    if specified and not logs:
        raise ForceTorqueError("--recording: expected a log, got experiment files; state the keys in their [recording]")
    if save_experiment is not None and len(logs) != 1:
        raise ForceTorqueError(f"--save-experiment {save_experiment}: expected one log, got {len(logs)}")


def _refuse_beside_torques(
    experiments: Sequence[Path], torques: Collection[Path], save_experiment: Path | None, to: LoadFormat | None
) -> None:
    from forcetorque.experiment.loading import experiments_asked_by
    from forcetorque.payload.export.arm_controllers_and_simulators import ARMS

    first = next(iter(torques))
    if option := experiments_asked_by():
        raise ForceTorqueError(
            f"{option}: expected a log with a wrench, got joint torques: {first}; leave --view out, or log "
            "O_F_ext_hat_K and O_T_EE too"
        )
    others = [path for path in experiments if path not in torques]
    if others:
        raise ForceTorqueError(f"{first}: expected logs of joint torques alone beside it, got {others[0]}")
    if save_experiment is not None:
        raise ForceTorqueError(
            f"--save-experiment {save_experiment}: expected a log with a wrench, got joint torques: {first}"
        )
    if to is not None and to not in ARMS:
        raise ForceTorqueError(
            f"--to {to}: expected a form without the bias of a sensor, {', '.join(ARMS)}, since {first} has no wrench"
        )


def _refuse_places(log: Path, world_frame: str | None, sensor_pose: tuple[float, ...] | None) -> None:
    for option, value in (("--world-frame", world_frame), ("--sensor-pose", sensor_pose)):
        if value is not None:
            raise ForceTorqueError(
                f"{option}: expected a log with a wrench, got joint torques, by which the load is in the flange: "
                f"{log}; leave the option out"
            )


def tare(
    experiment: ExperimentArgument,
    interval: Annotated[str, typer.Option("--interval", help="Label of an interval in which nothing moves.")],
    sensor: SensorOption = None,
    calibration: Annotated[
        list[Path] | None,
        typer.Option("--calibration", "-c", help="Calibration that reads a sensor; repeat for more. Default: none."),
    ] = None,
    to: LoadFormatOption = None,
    output: LoadFileOption = None,
    world_frame: WorldFrameOption = None,
    sensor_pose: SensorPoseOption = None,
    override: OverrideOption = None,
    figure: Annotated[
        Path | None, typer.Option("--figure", help="PNG, SVG or PDF of offset and error, before and after.")
    ] = None,
    force: ForceOption = False,
    details: DetailsOption = False,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Find the offset that keeps the weight of a load, from a stretch at rest.

    Example: forcetorque tare wrist.toml --interval still

    Python: `run.tare("at rest", calibration)`
    """
    from forcetorque.experiment.named_files import stated_in
    from forcetorque.experiment.sensor_run import SensorRun
    from forcetorque.payload.export.export import robot_load
    from forcetorque.payload.tare_offset import Tare, tare
    from forcetorque.results.terminal.command_inputs import (
        read_calibrations,
        read_experiment,
        refuse_left_out,
        sensors_named,
    )

    log = start_logging()
    refuse_load_file(output, to, output_format, override, force=force)
    refuse_figure(figure, force=force)
    calibrations = read_calibrations(calibration, sensor)
    content = read_experiment(experiment, log)
    chosen = sensors_named(content, sensor)
    if to is not None:
        _require_one_sensor(experiment, chosen)
    refuse_left_out(content, chosen, calibrations)
    by_sensor = _one_for_each(content, calibrations)
    runs = [SensorRun(content, one) for one in chosen]
    names = [by_sensor.get(run.sensor.name) for run in runs]
    with stated_in(str(experiment)):
        result = Tare.together(
            tare(run, interval, {name: calibrations[name]} if name else None)
            for run, name in zip(runs, names, strict=True)
        )
    if output is not None and to is not None:
        doubt = next(iter(result.warnings), None)
        load = robot_load(runs[0], result.sensors[0].bias, doubt=doubt, override=override)
        write_load(load, output, to, world_frame=world_frame, sensor_pose=sensor_pose, log=log)
    if figure is not None:
        result = drawn_to(result, figure)
    if output == STANDARD_OUTPUT:
        show_warnings(result)
    else:
        show(result, output_format, details=details, experiments=[experiment])


def _require_one_sensor(experiment: Path, chosen: Sequence[ExperimentSensor]) -> None:
    """Refuse several sensors, of which one would be written."""
    if len(chosen) != 1:
        names = ", ".join(repr(one.name) for one in chosen)
        raise ForceTorqueError(f"{experiment}: expected one sensor with --to, got {names}; name it by --sensor")


def _one_for_each(content: Experiment, calibrations: Mapping[str, Calibration]) -> dict[str, str]:
    """Names of calibrations by the sensors that they read."""
    names: dict[str, str] = {}
    for name, calibration in calibrations.items():
        other = names.setdefault(content.sensor(calibration.sensor.name).name, name)
        if other != name:
            raise ForceTorqueError(f"{name}: calibrates the sensor of {other}; expected one calibration for each")
    return names
