# SPDX-License-Identifier: BSD-3-Clause
"""From an experiment file to a robot, a recording with intervals, and sensors with their priors."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from forcetorque.base.errors import ExperimentError, known_names
from forcetorque.base.inertia import Inertia
from forcetorque.calibration.section import CalibrationTable
from forcetorque.estimation.motors import require_motors
from forcetorque.evaluation.load_cases.section import read_load_cases
from forcetorque.experiment import file as schema
from forcetorque.experiment.additions import read_robot
from forcetorque.experiment.calibration.estimation_type import ESTIMATION_TYPES, OffsetStrategy
from forcetorque.experiment.contacts import read_contacts
from forcetorque.experiment.experiment import Experiment, FitOptions, Role
from forcetorque.experiment.file import parse_experiment
from forcetorque.experiment.input_files import Inputs, stated_in
from forcetorque.experiment.intervals import read_intervals, read_supports
from forcetorque.experiment.processing_section import ProcessingTable
from forcetorque.experiment.sensors import declare_sensors, read_sensors
from forcetorque.experiment.streams import read_streams
from forcetorque.locomotion.soles import read_soles
from forcetorque.payload.link_loads import read_link_loads, with_loads_named
from forcetorque.payload.wrist_load import load_model, read_loads
from forcetorque.planning.section import read_plan
from forcetorque.recording.recording import MovingSupport, Recording, Support, Use
from forcetorque.recording.smoothing import SavitzkyGolay
from forcetorque.robot.mechanics.samples import Processing
from forcetorque.robot.model import RobotModel
from forcetorque.skin.experiment import links_side_by_side, skin_frames_of, skin_of_robot


def load_experiment(path: Path | str) -> Experiment:
    """Read an experiment file and everything that it points to.

    Args:
        path: TOML file; the paths in it are relative to its folder.

    Returns:
        The experiment.

    Raises:
        MissingFileError: If a file is not there.
        FormatError: If a file does not have its form.
        ExperimentError: If it has no sensor, or contradicts itself, the robot or the recording.
    """
    file = Path(path)
    parsed = parse_experiment(file)
    if not parsed.sensor:
        known, readers = "patches of skin only", "`forcetorque skin`, `inspect`, `view` and `report` read such a file"
        if not parsed.patch:
            known, readers = (
                "none",
                "`forcetorque inspect`, `view` and `report` read one of a skinManager's contacts alone",
            )
        if parsed.sole:
            known, readers = "soles only", "`forcetorque balance` reads one of vertical forces alone"
        raise ExperimentError(
            f"{file}: expected [[sensor]], a force-torque sensor, got {known}; {readers}; `forcetorque estimate` does "
            "with [robot] and a patch's table"
        )
    return _of_wrist(parsed, file) if parsed.wrist_load else _of_robot(parsed, file)


def load_touched_robot(path: Path | str) -> Experiment:
    """Read an experiment file whose robot may have skin in place of force-torque sensors.

    Args:
        path: TOML file; the paths in it are relative to its folder.

    Returns:
        The experiment, without sensors where the file has none.

    Raises:
        MissingFileError: If a file is not there.
        FormatError: If a file does not have its form.
        ExperimentError: If it has neither a sensor nor a patch with a table, or contradicts itself, the robot or the
            recording.
    """
    file = Path(path)
    parsed = parse_experiment(file)
    alone = not parsed.sensor and parsed.robot is not None and any(patch.table for patch in parsed.patch)
    if alone and not parsed.support and not any(one.touched for one in parsed.interval):
        raise ExperimentError(
            f"{file}: expected [[support]], the link whose motion is known, got none: at rest with gravity_direction, "
            "or moving with imu, the streams of an IMU; without it nobody knows what moves the robot, skin or not"
        )
    return _of_robot(parsed, file) if alone else load_experiment(file)


def load_shown(path: Path | str) -> Experiment:
    """Read an experiment file to show it: also one of skin alone, of patches or of contacts that a skinManager saw.

    Without a robot the links that skin is on stand side by side (`links_side_by_side`). Intervals of skin alone need no
    support; those without one are shown, and nothing is estimated in them, as if their use were `ignore`.

    Args:
        path: TOML file; the paths in it are relative to its folder.

    Returns:
        The experiment, without sensors where the file has none.

    Raises:
        MissingFileError: If a file is not there.
        FormatError: If a file does not have its form.
        ExperimentError: If it has neither sensor nor skin, or contradicts itself, the robot or the recording.
    """
    file = Path(path)
    parsed = parse_experiment(file)
    if parsed.sensor:
        return load_experiment(file)
    spans = tuple(
        one if one.support or one.touched else one.model_copy(update={"use": Use.IGNORE}) for one in parsed.interval
    )
    return _of_robot(parsed.model_copy(update={"interval": spans}), file)


def _of_robot(parsed: schema.ExperimentFile, file: Path) -> Experiment:
    inputs = Inputs(file.parent)
    inputs.file(Path(file.name))
    urdf = None if parsed.robot is None else read_robot(parsed.robot, file, inputs)
    robot = None if urdf is None else declare_sensors(parsed.sensor, file, urdf)
    before = inputs.names()
    streams = read_streams(parsed, file, robot, inputs)
    logs = inputs.names() - before
    model = _side_by_side(parsed, file, streams, inputs) if robot is None else robot
    supports = read_supports(parsed.support, file, streams, model)
    intervals, hung = with_loads_named(
        read_intervals(parsed, file, streams, supports, model, loads=None),
        [span.load for span in parsed.interval],
        parsed.link_load,
    )
    with stated_in(str(file)):
        recording = streams.with_intervals(intervals)
    sensors = read_sensors(parsed, file, model, recording, inputs)
    link_loads = read_link_loads(parsed.link_load, file, model, sensors, hung, inputs)
    skin = skin_of_robot(parsed, file, model, recording, inputs)
    hashes = inputs.sha256()
    return Experiment(
        name=parsed.name,
        file=file,
        model=model,
        recording=recording,
        sensors=sensors,
        contacts=read_contacts(parsed, file, model, recording),
        length_scale=parsed.estimation.length_scale_m,
        processing=processing_of(
            parsed.processing, gravity=Processing().gravity if parsed.robot is None else parsed.robot.gravity
        ),
        regularisation=parsed.calibration.lambda_counts2,
        fit_options=fit_options(parsed.calibration),
        sphere_intervals=_sphere_intervals(parsed, file),
        roles=_roles(parsed),
        inputs_sha256=hashes,
        log_sha256=frozenset(hashes[name] for name in logs),
        condition=parsed.trial.condition,
        trial=parsed.trial.number,
        load_cases=read_load_cases(parsed.load_case, file, model),
        supports=tuple(support for support in supports.values() if isinstance(support, Support)),
        motors=require_motors(parsed.motor, file, model, recording),
        fusion=parsed.fusion,
        plan=read_plan(parsed.plan, file, model, supports.values()),
        soles=read_soles(parsed.sole, file, model, recording, sensed=bool(parsed.sensor)),
        link_loads=link_loads,
        skin=skin,
    )


def _side_by_side(parsed: schema.ExperimentFile, file: Path, streams: Recording, inputs: Inputs) -> RobotModel:
    """Links of skin alone."""
    frames = skin_frames_of(parsed, streams, inputs)
    if not frames:
        raise ExperimentError(
            f"{file}: expected [robot], or skin on links of some name: a [[patch]] with link or layout, or a stream of "
            "skin_events; got neither"
        )
    return links_side_by_side(frames)


def _of_wrist(parsed: schema.ExperimentFile, file: Path) -> Experiment:
    """A wrist sensor: the robot is its load, whose motion is logged and whose mass may be estimated."""
    loads = parsed.wrist_load
    load, name, inputs = loads[0], parsed.sensor[0].name, Inputs(file.parent)
    inputs.file(Path(file.name))
    before = inputs.names()
    streams = read_streams(parsed, file, None, inputs)
    logs = inputs.names() - before
    supports = {one.name: MovingSupport(frame=load.frame, motion_streams=load.streams) for one in loads}
    with stated_in(f"{file}: load"):
        for stream in load.streams:
            streams.stream(stream)
        if load.applied is not None:
            streams.stream(load.applied).signal("applied_wrench")
    intervals = read_intervals(parsed, file, streams, {}, None, loads=supports)
    (sensor,) = read_sensors(parsed, file, load_model(load, name, Inertia.zero()), streams, inputs)
    wrist = read_loads(loads, file, supports, sensor)
    processing = processing_of(parsed.processing, gravity=Processing().gravity)
    with stated_in(str(file)):
        recording = streams.with_intervals(intervals)
    loaded = load_model(load, name, wrist.stated_inertia())
    skin, hashes = skin_of_robot(parsed, file, loaded, recording, inputs), inputs.sha256()
    return Experiment(
        name=parsed.name,
        file=file,
        model=loaded,
        recording=recording,
        sensors=(sensor,),
        contacts=read_contacts(parsed, file, loaded, recording),
        length_scale=parsed.estimation.length_scale_m,
        processing=processing,
        regularisation=parsed.calibration.lambda_counts2,
        fit_options=fit_options(parsed.calibration),
        sphere_intervals=_sphere_intervals(parsed, file),
        roles=_roles(parsed),
        wrist=wrist,
        inputs_sha256=hashes,
        log_sha256=frozenset(hashes[name] for name in logs),
        condition=parsed.trial.condition,
        trial=parsed.trial.number,
        load_cases=read_load_cases(parsed.load_case, file, loaded),
        skin=skin,
    )


def processing_of(table: ProcessingTable, *, gravity: float) -> Processing:
    """Settle how samples are processed.

    Args:
        table: What the file says.
        gravity: Magnitude of gravity; m/s2.

    Returns:
        Filters and gravity.
    """
    derivatives, smoothing = table.derivatives, table.smoothing
    default = Processing()
    return Processing(
        derivative_window=default.derivative_window
        if derivatives == "logged"
        else SavitzkyGolay(window_s=derivatives.window_s, order=derivatives.order),
        logged_derivatives=derivatives == "logged",
        smoothing=None if smoothing is None else SavitzkyGolay(window_s=smoothing.window_s, order=smoothing.order),
        gravity=gravity,
    )


def fit_options(table: CalibrationTable) -> FitOptions:
    """Settle the estimator.

    Args:
        table: What the file says.

    Returns:
        The estimator, as far as the file settles it.
    """
    if table.type in ESTIMATION_TYPES:
        kind = ESTIMATION_TYPES[table.type]
        return FitOptions(
            generative=False,
            offset=kind.offset,
            with_variables=kind.with_variables,
            from_reference=kind.from_reference,
        )
    accuracy = table.accuracy
    return FitOptions(
        generative=table.generative,
        accuracy=None if accuracy is None else np.repeat([accuracy.force_N, accuracy.moment_Nm], 3),
        repeatability=table.repeatability,
        drift=table.drift,
        nonlinear=table.nonlinear,
        offset=table.offset or OffsetStrategy.ONE_SHOT,
        with_variables=table.with_variables,
        from_reference=table.from_reference,
    )


def _sphere_intervals(parsed: schema.ExperimentFile, file: Path) -> tuple[str, ...] | None:
    labels = [span.label for span in parsed.interval if span.use is Use.CALIBRATION]
    for label in parsed.calibration.sphere_intervals or ():
        if label not in labels:
            raise ExperimentError(
                f"{file}: calibration: sphere_intervals: no calibration interval is labelled {label!r}; "
                f"{known_names(label, labels)}"
            )
    return parsed.calibration.sphere_intervals


def _roles(parsed: schema.ExperimentFile) -> dict[str, Role]:
    return {span.label: Role(kind=span.kind or span.label, session=span.session) for span in parsed.interval}
