# SPDX-License-Identifier: BSD-3-Clause
"""From an experiment file to a robot, a recording with intervals, and sensors with their priors.

Before anything is recorded, `forcetorque plan` reads a file of robot, sensors and sections alone. What a command
has read is kept for what follows it in the same run.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import replace
from enum import Enum
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np
from pydantic import Field, create_model

from forcetorque.base.errors import ExperimentError, ForceTorqueError, known_names
from forcetorque.base.toml_file import Table, Text, checked_tables, read_toml, toml_content
from forcetorque.experiment.calibration.robot_model_error import EXACT
from forcetorque.experiment.calibration.sensor_model import LinearVariable
from forcetorque.experiment.contacts import read_contacts
from forcetorque.experiment.experiment import Experiment, ExperimentSensor, Role, SensorVariable
from forcetorque.experiment.experiment_file import (
    ExperimentFile,
    Robot,
    Support as SupportTable,
    experiment_file,
    parse_experiment,
    section_fields,
)
from forcetorque.experiment.experiment_file_tables import (
    CalibrationTable,
    MountTable,
    ProcessingTable,
    Sensor,
    fit_options,
    processing_of,
)
from forcetorque.experiment.intervals import read_intervals, read_supports, with_intervals_of_files
from forcetorque.experiment.named_files import InMemory, Inputs, stated_in
from forcetorque.experiment.robot_and_streams import read_robot, read_streams
from forcetorque.experiment.section import NO_ROBOT, Loading, StandIn, sections
from forcetorque.experiment.sensor_mount import SensorMount
from forcetorque.experiment.sensors import full_scale_of, prior_deviation_of, read_prior, read_sensors
from forcetorque.recording.named_columns import ScalarSource
from forcetorque.recording.recording import Recording, Support, Use
from forcetorque.robot.mechanics.measured_and_expected_wrench import Processing
from forcetorque.robot.model import RobotModel

if TYPE_CHECKING:
    from forcetorque.results.result import Result

    Accept = Callable[[Path, Experiment], None]
    Finished = Callable[[Path, Experiment, Result], None]


_KEPT: ContextVar[dict[Path, Experiment] | None] = ContextVar("forcetorque_kept_experiments", default=None)
_ACCEPT: ContextVar[Accept | None] = ContextVar("forcetorque_accept", default=None)
_FINISHED: ContextVar[Finished | None] = ContextVar("forcetorque_finished", default=None)
_ASKED_BY: ContextVar[str] = ContextVar("forcetorque_experiments_asked_by", default="")


@contextmanager
def kept_experiments(
    asked_by: str, accept: Accept | None = None, finished: Finished | None = None
) -> Iterator[Mapping[Path, Experiment]]:
    """Keep every experiment that is read in the body, so that its log need not be read again.

    Args:
        asked_by: Option that needs them, with its value, for messages.
        accept: Called with file and experiment when it was read; raises where it cannot be used.
        finished: Called with file, experiment and result of each experiment by a command that reads more recordings
            than memory holds; then none is kept.

    Yields:
        Experiments by their file, or by the log that one was made of; empty until they are read.
    """
    experiments: dict[Path, Experiment] = {}
    token, option = _KEPT.set(experiments if finished is None else None), _ASKED_BY.set(asked_by)
    accepted, done = _ACCEPT.set(accept), _FINISHED.set(finished)
    try:
        yield experiments
    finally:
        _KEPT.reset(token)
        _ASKED_BY.reset(option)
        _ACCEPT.reset(accepted)
        _FINISHED.reset(done)


def experiments_asked_by() -> str:
    """Option that needs an experiment of every file, with its value; empty if none does."""
    return _ASKED_BY.get()


def keep_experiment(path: Path, experiment: Experiment) -> Experiment:
    """Keep an experiment if someone asked for it, and see first that it can be used.

    Args:
        path: Its file, or the log that it was made of.
        experiment: The experiment.

    Returns:
        The same.
    """
    accept, kept = _ACCEPT.get(), _KEPT.get()
    if accept is not None:
        accept(path, experiment)
    if kept is not None:
        kept[path] = experiment
    return experiment


def experiment_finished(path: Path, experiment: Experiment, result: Result) -> None:
    """Hand on an experiment before the next one is read.

    Args:
        path: Its file.
        experiment: The experiment.
        result: What the command says of it.
    """
    finished = _FINISHED.get()
    if finished is not None:
        finished(path, experiment, result)


class PlannedSensor(Sensor):
    """A sensor of which nothing was recorded yet."""

    stream: Text = "none"
    """Stream that will hold its reading; may be left out."""


class UnrecordedFile(Table):
    """An experiment file without recording, streams and intervals, which only `forcetorque plan` reads."""

    schema_name: Literal["forcetorque/experiment/1"] = Field(alias="schema")
    """Form of the file."""
    name: Text
    """Name of the experiment."""
    robot: Robot
    """The robot model."""
    sensor: Annotated[tuple[PlannedSensor, ...], Field(min_length=1)]
    """Sensors."""
    support: Annotated[tuple[SupportTable, ...], Field(min_length=1)]
    """Support frames."""
    processing: ProcessingTable = ProcessingTable()
    """How samples will be processed."""
    calibration: CalibrationTable = CalibrationTable()
    """How the sensor will be fitted."""


@cache
def _file_type() -> type[UnrecordedFile]:
    """The core tables, and the sections that a file may have before anything is recorded."""
    return create_model(
        "UnrecordedFile", __base__=UnrecordedFile, __doc__=UnrecordedFile.__doc__, **section_fields(of_plan=True)
    )


def load_unrecorded(file: Path, specified: Collection[str]) -> Experiment:
    """Read an experiment file that lacks what was recorded.

    Args:
        file: TOML file.
        specified: Names of its tables.

    Returns:
        The experiment, without streams and intervals.

    Raises:
        MissingFileError: If a file is not there.
        FormatError: If a file does not have its form.
        ExperimentError: If the file contradicts itself or the robot.
    """
    for recipe in sorted({"clock", "transform"}.intersection(specified)):
        raise ExperimentError(
            f"{file}: expected [recording], to whose streams [[{recipe}]] is done, got none; leave it out to plan what "
            "was not recorded yet"
        )
    parsed = read_toml(file, _file_type(), what="an experiment file")
    inputs = Inputs.of(file)
    model, tolerance = read_robot(parsed.robot, parsed.sensor, file, inputs)
    for index, entry in enumerate(parsed.support):
        if entry.imu is not None:
            raise ExperimentError(
                f"{file}: support[{index}]: expected gravity_direction, a support at rest, got imu; nothing can be "
                "planned on a support that moves"
            )
    nothing = Recording(streams={})
    supports = read_supports(parsed.support, file, nothing, model)
    sensors = tuple(_sensor(f"{file}: sensor[{k}]", entry, model, inputs) for k, entry in enumerate(parsed.sensor))
    loading = Loading(
        parsed=parsed, file=file, inputs=inputs, recording=nothing, model=model, sensors=sensors, supports=supports
    )
    return Experiment(
        name=parsed.name,
        file=file,
        model=model,
        recording=nothing,
        sensors=sensors,
        contacts=(),
        processing=processing_of(parsed.processing, gravity=parsed.robot.gravity),
        fit_options=replace(fit_options(parsed.calibration), tolerance=tolerance),
        roles={},
        inputs_sha256=inputs.sha256(),
        supports=tuple(support for support in supports.values() if isinstance(support, Support)),
        sections={one.key: one.read(getattr(parsed, one.key), loading) for one in sections() if one.of_plan},
    )


def _sensor(where: str, entry: PlannedSensor, model: RobotModel, inputs: Inputs) -> ExperimentSensor:
    variables = [
        SensorVariable(
            linear=LinearVariable(
                name=variable.name,
                unit="degC" if variable.quantity == "temperature" else "",
                reference_value=variable.reference_value,
                prior=variable.prior_coefficients,
                prior_deviation=None if variable.prior_deviation is None else np.array(variable.prior_deviation),
            ),
            source=ScalarSource(
                stream=variable.stream or entry.stream,
                quantity=variable.quantity,
                column=variable.column or variable.name,
            ),
        )
        for variable in entry.variable
    ]
    prior = read_prior(where, entry, inputs)
    full_scale = full_scale_of(entry, prior)
    return ExperimentSensor(
        name=model.sensor(entry.name).name,
        serial=entry.serial,
        stream=entry.stream,
        quantity="raw",
        prior=None if prior is None else prior.matrix,
        prior_source=None if prior is None else prior.source,
        limit_counts=entry.limit_counts,
        full_scale=full_scale,
        prior_deviation=prior_deviation_of(where, entry, prior, full_scale),
        variables=tuple(variables),
    )


class Purpose(Enum):
    """What an experiment file is read for, which says what it may lack."""

    SENSORS = "sensors"
    """Questions to force-torque sensors; it has at least one."""
    FORCES = "forces"
    """Contact forces; a robot with calibrated skin may have no sensor."""
    MOTION = "motion"
    """What the motion of joints and IMU demands; a robot with a support needs no sensor."""
    DISPLAY = "display"
    """To show it; it may have skin alone, of patches or of contacts that a skinManager saw. Without a robot the links
    that skin is on stand side by side. Intervals without support are shown, as if their use were `ignore`."""
    PLANNING = "planning"
    """What to record next; it may lack recording, streams and intervals."""


def load_experiment(path: Path | str, purpose: Purpose = Purpose.SENSORS) -> Experiment:
    """Read an experiment file and everything that it points to.

    Args:
        path: TOML file; the paths in it are relative to its folder.
        purpose: What it is read for.

    Returns:
        The experiment.

    Raises:
        MissingFileError: If a file is not there.
        FormatError: If a file does not have its form.
        ExperimentError: If it lacks what the purpose needs, or contradicts itself, the robot or the recording.
    """
    file = Path(path)
    return keep_experiment(file, _loaded(file, purpose))


def _loaded(file: Path, purpose: Purpose) -> Experiment:
    specified = _tables(file) if purpose is Purpose.PLANNING else None
    if specified is not None and not {"recording", "interval", "load"} & specified:
        return load_unrecorded(file, specified)
    parsed = parse_experiment(file)
    if parsed.sensor:
        return _load(parsed, file, Inputs.of(file))
    if purpose is Purpose.DISPLAY:
        spans = tuple(
            one if one.support or one.contact_links else one.model_copy(update={"use": Use.IGNORE})
            for one in parsed.interval
        )
        return _load(parsed.model_copy(update={"interval": spans}), file, Inputs.of(file))
    gives_forces = purpose is Purpose.MOTION or any(one.gives_forces(parsed.table(one)) for one in sections())
    if purpose not in (Purpose.FORCES, Purpose.MOTION) or parsed.robot is None or not gives_forces:
        raise ExperimentError(_lacks_sensors(parsed, file))
    if not parsed.support and not any(one.contact_links for one in parsed.interval):
        raise ExperimentError(
            f"{file}: expected [[support]], the link whose motion is known, got none: at rest with gravity_direction, "
            "or moving with imu, the streams of an IMU; without it the motion of the robot is unknown, with skin too"
        )
    return _load(parsed, file, Inputs.of(file))


def load_tables(tables: dict[str, Any], in_memory: InMemory, *, folder: Path) -> Experiment:
    """Make an experiment of the tables of an experiment file, without the file.

    Args:
        tables: The tables, as a parser of TOML gives them.
        in_memory: What stands in place of files that they name.
        folder: Folder that the paths in them are relative to.

    Returns:
        The experiment; its `file` is named after it.

    Raises:
        MissingFileError: If a file is not there.
        FormatError: If the tables, or a file, do not have their form.
        ExperimentError: If they have no sensor, or contradict themselves, the robot or the recording.
    """
    name = tables.get("name")
    file = folder / (name if isinstance(name, str) and name else "experiment")
    parsed = checked_tables(tables, experiment_file(), file)
    if not parsed.sensor:
        raise ExperimentError(_lacks_sensors(parsed, file))
    return _load(parsed, file, Inputs(folder, in_memory))


def _tables(file: Path) -> set[str] | None:
    """Names of the tables of a file; None for a file that cannot be read, which its reader reports."""
    try:
        return set(toml_content(file)[1])
    except (ForceTorqueError, OSError, ValueError, RecursionError):
        return None


def _lacks_sensors(parsed: ExperimentFile, file: Path) -> str:
    nothing = "none", "a load cell or a sensor of three axes is one too, with components"
    if parsed.recording.format == "yarp":
        nothing = "none", "`forcetorque inspect`, `view` and `report` read one of a skinManager's contacts alone"
    makes_sense = (one.without_sensors for one in sections() if one.without_sensors and parsed.table(one))
    known, readers = next(makes_sense, nothing)
    return (
        f"{file}: expected [[sensor]], a force-torque sensor, got {known}; {readers}; `forcetorque estimate` does "
        "with [robot] and a patch's table"
    )


def _load(parsed: ExperimentFile, file: Path, inputs: Inputs) -> Experiment:
    robot, tolerance = None, EXACT
    if parsed.robot is not None:
        robot, tolerance = read_robot(parsed.robot, parsed.sensor, file, inputs)
    before = inputs.names()
    streams = read_streams(parsed, file, robot, inputs)
    logs = inputs.names() - before
    parsed = with_intervals_of_files(parsed, file, streams)
    loading = Loading(parsed=parsed, file=file, inputs=inputs, recording=streams, model=robot or NO_ROBOT, supports={})
    if robot is None:
        stand_in = _stand_in(loading)
        loading = replace(loading, model=stand_in.model, stand_in=stand_in)
    loading = replace(loading, supports=read_supports(parsed.support, file, streams, loading.model))
    loads = None if loading.stand_in is None else loading.stand_in.supports
    intervals = read_intervals(
        parsed, file, streams, loading.supports, None if loads is not None else loading.model, loads=loads
    )
    for section in sections():
        intervals = list(section.place(parsed.table(section), loading, intervals))
    with stated_in(str(file)):
        loading = replace(loading, recording=streams.with_intervals(intervals))
    loading = replace(loading, sensors=read_sensors(parsed, file, loading.model, loading.recording, inputs))
    contents = {
        one.key: one.read(parsed.table(one), loading) for one in sections() if loads is None or not one.of_robot
    }
    hashes = inputs.sha256()
    return Experiment(
        name=parsed.name,
        file=file,
        model=loading.model,
        recording=loading.recording,
        sensors=loading.sensors,
        contacts=read_contacts(parsed, file, loading.model, loading.recording),
        processing=processing_of(
            parsed.processing, gravity=Processing().gravity if parsed.robot is None else parsed.robot.gravity
        ),
        fit_options=replace(
            fit_options(parsed.calibration),
            sphere_intervals=_sphere_intervals(parsed, file),
            tolerance=tolerance,
        ),
        roles=_roles(parsed),
        inputs_sha256=hashes,
        log_sha256=frozenset(hashes[name] for name in logs),
        supports=tuple(support for support in loading.supports.values() if isinstance(support, Support)),
        sections=contents,
        mounts={
            sensor.name: SensorMount(rotation_deg=entry.mount.rotation_deg, shift_mm=entry.mount.shift_mm)
            for sensor, entry in zip(loading.sensors, parsed.sensor, strict=True)
            if isinstance(entry.mount, MountTable)
        },
    )


def _stand_in(loading: Loading) -> StandIn:
    """What a section gives in place of a robot."""
    for section in sections():
        stand_in = section.stand_in(loading.parsed.table(section), loading)
        if stand_in is not None:
            return stand_in
    raise ExperimentError(
        f"{loading.file}: expected [robot], or skin on links of some name: a [[patch]] with link or layout, or a "
        "stream of skin_events; got neither"
    )


def _sphere_intervals(parsed: ExperimentFile, file: Path) -> tuple[str, ...] | None:
    labels = [span.label for span in parsed.interval if span.use is Use.CALIBRATION]
    for label in parsed.calibration.sphere_intervals or ():
        if label not in labels:
            raise ExperimentError(
                f"{file}: calibration: sphere_intervals: no calibration interval is labelled {label!r}; "
                f"{known_names(label, labels)}"
            )
    return parsed.calibration.sphere_intervals


def _roles(parsed: ExperimentFile) -> dict[str, Role]:
    return {span.label: Role(kind=span.kind or span.label, session=span.session) for span in parsed.interval}
