# SPDX-License-Identifier: BSD-3-Clause
"""Experiment files of what was not recorded yet: a robot, a sensor, its uses, and what can be recorded."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.errors import ExperimentError, ForceTorqueError
from forcetorque.base.toml_file import Table, Text, read_toml, toml_content
from forcetorque.calibration.section import CalibrationTable
from forcetorque.evaluation.load_cases.section import LoadCaseTable, read_load_cases
from forcetorque.experiment import file as schema
from forcetorque.experiment.additions import read_robot
from forcetorque.experiment.calibration.linear_variable import LinearVariable
from forcetorque.experiment.experiment import Experiment, ExperimentSensor, SensorVariable
from forcetorque.experiment.input_files import Inputs
from forcetorque.experiment.intervals import read_supports
from forcetorque.experiment.loading import fit_options, load_experiment, processing_of
from forcetorque.experiment.prior import full_scale_of, read_prior
from forcetorque.experiment.processing_section import ProcessingTable
from forcetorque.experiment.sensor_section import Sensor
from forcetorque.experiment.sensors import declare_sensors
from forcetorque.planning.section import PlanTable, read_plan
from forcetorque.recording.column import ScalarSource
from forcetorque.recording.recording import Recording, Support
from forcetorque.robot.model import RobotModel


class PlannedSensor(Sensor):
    """A sensor of which nothing was recorded yet."""

    stream: Text = "none"
    """Stream that will hold its reading; may be left out."""


class PlannedFile(Table):
    """An experiment file without recording, streams and intervals, which only `forcetorque plan` reads."""

    schema_name: Literal["forcetorque/experiment/1"] = Field(alias="schema")
    """Form of the file."""
    name: Text
    """Name of the experiment."""
    robot: schema.Robot
    """The robot model."""
    sensor: Annotated[tuple[PlannedSensor, ...], Field(min_length=1)]
    """Sensors."""
    support: Annotated[tuple[schema.Support, ...], Field(min_length=1)]
    """Support frames."""
    processing: ProcessingTable = ProcessingTable()
    """How samples will be processed."""
    calibration: CalibrationTable = CalibrationTable()
    """How the sensor will be fitted."""
    load_case: tuple[LoadCaseTable, ...] = ()
    """What the sensors are to be used for."""
    plan: PlanTable | None = None
    """What can be recorded."""


def load_planned(path: Path | str) -> Experiment:
    """Read an experiment file that may lack what was recorded.

    Args:
        path: TOML file.

    Returns:
        The experiment; without streams and intervals where the file has neither `[recording]` nor `[[interval]]`.

    Raises:
        MissingFileError: If a file is not there.
        FormatError: If a file does not have its form.
        ExperimentError: If the file contradicts itself or the robot.
    """
    file = Path(path)
    tables = _tables(file)
    if tables is None or {"recording", "interval", "load"} & tables:
        return load_experiment(file)
    for recipe in sorted({"clock", "transform"} & tables):
        raise ExperimentError(
            f"{file}: expected [recording], to whose streams [[{recipe}]] is done, got none; leave it out to plan what "
            "was not recorded yet"
        )
    parsed = read_toml(file, PlannedFile, what="an experiment file")
    inputs = Inputs(file.parent)
    inputs.file(Path(file.name))
    model = declare_sensors(parsed.sensor, file, read_robot(parsed.robot, file, inputs))
    for index, entry in enumerate(parsed.support):
        if entry.imu is not None:
            raise ExperimentError(
                f"{file}: support[{index}]: expected gravity_direction, a support at rest, got imu; nothing can be "
                "planned on a support that moves"
            )
    nothing = Recording(streams={})
    supports = read_supports(parsed.support, file, nothing, model)
    sensors = tuple(_sensor(f"{file}: sensor[{k}]", entry, model, inputs) for k, entry in enumerate(parsed.sensor))
    return Experiment(
        name=parsed.name,
        file=file,
        model=model,
        recording=nothing,
        sensors=sensors,
        contacts=(),
        length_scale=None,
        processing=processing_of(parsed.processing, gravity=parsed.robot.gravity),
        regularisation=parsed.calibration.lambda_counts2,
        fit_options=fit_options(parsed.calibration),
        sphere_intervals=None,
        roles={},
        inputs_sha256=inputs.sha256(),
        load_cases=read_load_cases(parsed.load_case, file, model),
        supports=tuple(support for support in supports.values() if isinstance(support, Support)),
        plan=read_plan(parsed.plan, file, model, supports.values()),
    )


def _tables(file: Path) -> set[str] | None:
    """What the file states; None of one that cannot be read, which is left to the reader that says why."""
    try:
        return set(toml_content(file)[1])
    except (ForceTorqueError, OSError, ValueError, RecursionError):
        return None


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
    return ExperimentSensor(
        name=model.sensor(entry.name).name,
        serial=entry.serial,
        stream=entry.stream,
        quantity="raw",
        prior=None if prior is None else prior.matrix,
        prior_source=None if prior is None else prior.source,
        limit_counts=entry.limit_counts,
        full_scale=full_scale_of(entry, prior),
        variables=tuple(variables),
    )
