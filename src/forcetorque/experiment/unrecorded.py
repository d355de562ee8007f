# SPDX-License-Identifier: BSD-3-Clause
"""Experiment files before anything is recorded: a robot, sensors, and sections such as what can be recorded."""

from __future__ import annotations

from collections.abc import Collection
from functools import cache
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field, create_model

from forcetorque.base.errors import ExperimentError
from forcetorque.base.toml_file import Table, Text, read_toml
from forcetorque.experiment.additions import read_robot
from forcetorque.experiment.calibration.sensor_model import LinearVariable
from forcetorque.experiment.calibration_section import CalibrationTable, fit_options
from forcetorque.experiment.core_tables import ProcessingTable, Sensor, processing_of
from forcetorque.experiment.experiment import Experiment, ExperimentSensor, SensorVariable
from forcetorque.experiment.file import Robot, section_fields
from forcetorque.experiment.file import Support as SupportTable
from forcetorque.experiment.input_files import Inputs
from forcetorque.experiment.intervals import read_supports
from forcetorque.experiment.section import Loading, sections
from forcetorque.experiment.sensors import declare_sensors, full_scale_of, read_prior
from forcetorque.recording.column import ScalarSource
from forcetorque.recording.recording import Recording, Support
from forcetorque.robot.model import RobotModel


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


def load_unrecorded(file: Path, stated: Collection[str]) -> Experiment:
    """Read an experiment file that lacks what was recorded.

    Args:
        file: TOML file.
        stated: Names of its tables.

    Returns:
        The experiment, without streams and intervals.

    Raises:
        MissingFileError: If a file is not there.
        FormatError: If a file does not have its form.
        ExperimentError: If the file contradicts itself or the robot.
    """
    for recipe in sorted({"clock", "transform"}.intersection(stated)):
        raise ExperimentError(
            f"{file}: expected [recording], to whose streams [[{recipe}]] is done, got none; leave it out to plan what "
            "was not recorded yet"
        )
    parsed = read_toml(file, _file_type(), what="an experiment file")
    inputs = Inputs.of(file)
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
        fit_options=fit_options(parsed.calibration),
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
