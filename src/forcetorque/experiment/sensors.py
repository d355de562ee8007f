# SPDX-License-Identifier: BSD-3-Clause
"""The sensors of an experiment: matched to the robot, to a stream, and to a prior matrix from any known file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.units import NORMAL_95
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.experiment import experiment_file as schema
from forcetorque.experiment.calibration.sensor_model import LinearVariable, component_names, measured_components
from forcetorque.experiment.experiment import ExperimentSensor, SensorVariable
from forcetorque.experiment.experiment_file_tables import PriorTable, Sensor, Variable
from forcetorque.experiment.named_files import Inputs, stated_in
from forcetorque.formats.icub_matrix import serial_number_in_name
from forcetorque.formats.icub_wrench_steps import full_scales_of_steps, is_in_steps
from forcetorque.formats.prior.prior_file import PriorFile, RawUnit
from forcetorque.formats.prior.registry import read_prior_file
from forcetorque.recording.named_columns import ScalarSource
from forcetorque.recording.recording import Recording
from forcetorque.robot.model import RobotModel, SensorFrame

IDENTITY = "identity"
"""Prior of a sensor whose calibrated reading, a wrench already, takes the place of counts."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SpecifiedPrior:
    """The prior matrix of a sensor."""

    matrix: FloatArray
    """Shape (6, c); N/count, N m/count."""
    source: str
    """Its file, as the experiment names it; `identity` where the reading itself takes the place of counts."""
    full_scale: FloatArray | None = None
    """Full scale by the maker; shape (6,); N, N m; None to take it from the counts that a channel can have."""
    board_scale: FloatArray | None = None
    """Full scales in whose steps a board sends wrenches; shape (6,); N, N m; None where it sends none."""


def read_prior(where: str, entry: Sensor, inputs: Inputs) -> SpecifiedPrior | None:
    """Read the prior matrix of a sensor.

    Args:
        where: File and table, for messages.
        entry: The sensor.
        inputs: Resolves and remembers the files.

    Returns:
        The matrix; None where the file specifies none.

    Raises:
        ExperimentError: If it is that of another sensor, or takes something else than counts.
    """
    if entry.prior is None:
        return None
    given = inputs.in_memory.priors.get(entry.name)
    if given is not None:
        return SpecifiedPrior(matrix=given, source="given as an array")
    if entry.prior == IDENTITY:
        return SpecifiedPrior(matrix=np.eye(6)[:, measured_by(entry)], source=IDENTITY)
    specified = entry.prior if isinstance(entry.prior, PriorTable) else PriorTable(path=Path(entry.prior))
    with stated_in(where):
        _require_serial(serial_number_in_name(specified.path), entry, specified.path)
        file = read_prior_file(
            inputs.file(specified.path), force_unit=specified.force_unit, moment_unit=specified.moment_unit
        )
        _require_serial(file.serial, entry, specified.path)
        scale = _volts_per_count(file, specified)
    maker = file.raw_unit is RawUnit.VOLTS
    return SpecifiedPrior(
        matrix=file.matrix * scale,
        source=specified.path.as_posix(),
        # counts that a board's channel can have say its full scale; volts that a card may see do not
        full_scale=file.full_scale if maker else None,
        board_scale=None if maker else file.full_scale,
    )


def measured_by(entry: Sensor) -> BoolArray:
    """Tell which components of a wrench a sensor measures.

    Returns:
        Whether it measures each; shape (6,).
    """
    return np.isin(WRENCH_COMPONENTS, WRENCH_COMPONENTS if entry.components is None else entry.components)


def _require_components(where: str, entry: Sensor, prior: SpecifiedPrior | None, quantity: str, channels: int) -> None:
    """Refuse a matrix, or channels, of other components than those that are stated."""
    measured = measured_by(entry)
    if quantity == "raw" and prior is not None and prior.source == IDENTITY and channels != measured.sum():
        raise ExperimentError(
            f'{where}: expected a channel for each of {measured.sum()} components with the prior "identity", got '
            f"{channels}; name the components that are logged as components"
        )
    # a matrix of zeros is refused where it is inverted
    if prior is not None and prior.matrix.any() and (wrong := measured_components(prior.matrix) != measured).any():
        raise ExperimentError(
            f"{where}: expected a prior whose rows are zero just where components names none, got otherwise for "
            f"{component_names(wrong)}; write components for the rows that are not zero"
        )
    if quantity == "wrench" and not measured.all():
        raise ExperimentError(
            f"{where}: expected all six components of a stream of wrenches, got components of {int(measured.sum())}; "
            'log the columns that are measured as raw, with the prior "identity" where they are in N and N m'
        )


def full_scale_of(entry: Sensor, prior: SpecifiedPrior | None) -> FloatArray | None:
    """Give the full scale of a sensor.

    Args:
        entry: The sensor.
        prior: Its prior; None for none.

    Returns:
        What the file states, else the maker; shape (6,); N, N m; None where neither does.
    """
    if entry.full_scale is not None:
        return np.array(entry.full_scale)
    return None if prior is None else prior.full_scale


def prior_deviation_of(
    where: str, entry: Sensor, prior: SpecifiedPrior | None, full_scale: FloatArray | None
) -> FloatArray | None:
    """Give how far readings by the prior matrix are off, as the file states it.

    Args:
        where: File and table, for messages.
        entry: The sensor.
        prior: Its prior; None for none.
        full_scale: Its full scale; shape (6,); N, N m; None if it is not known.

    Returns:
        Standard deviation; shape (6,); N, N m; None where nothing is stated.

    Raises:
        ExperimentError: If the sensor has not six channels, or there is no full scale that it is a share of.
    """
    if entry.prior_uncertainty_percent is None or prior is None:
        return None
    if prior.matrix.shape[1] != len(WRENCH_COMPONENTS):
        raise ExperimentError(
            f"{where}: expected a sensor of six channels for prior_uncertainty_percent, got {prior.matrix.shape[1]}; "
            "delete it: errors of more channels do not belong to single components"
        )
    if full_scale is None:
        raise ExperimentError(
            f"{where}: expected full_scale, of which prior_uncertainty_percent is a share: six numbers, N and N m, as "
            "the certificate has them"
        )
    return np.array(entry.prior_uncertainty_percent) / 100.0 * full_scale / NORMAL_95


def _require_serial(serial: str | None, entry: Sensor, path: Path) -> None:
    if serial is not None and serial != entry.serial:
        raise ExperimentError(
            f"expected the prior matrix of the sensor {entry.serial!r}, got that of {serial!r} ({path}); every sensor "
            "has its own"
        )


def _volts_per_count(file: PriorFile, specified: PriorTable) -> float:
    """What makes the matrix per count."""
    if file.raw_unit is RawUnit.WRENCH:
        raise ExperimentError(
            f"prior: expected a matrix that takes counts, got {file.form}, which corrects wrenches of another "
            'calibration; apply it to the log, or leave it out, and specify prior = "identity" for a stream of wrenches'
        )
    if file.raw_unit is RawUnit.COUNTS:
        if specified.volts_per_count is not None:
            raise ExperimentError(f"prior: expected no volts_per_count: {file.form} is per count; delete it")
        return 1.0
    if specified.volts_per_count is None:
        raise ExperimentError(
            f"prior: expected volts_per_count, for {file.form} is per volt; write prior = {{ path = "
            f'"{specified.path.as_posix()}", volts_per_count = ... }}: the span of the converter over its steps, 1.0 '
            "for a log in volts"
        )
    return specified.volts_per_count


def declare_sensors(sensors: Sequence[Sensor], file: Path, model: RobotModel) -> RobotModel:
    """Check that the robot has the sensors with a tag, and declare those without.

    Args:
        sensors: Sensors of the experiment file.
        file: The experiment file, for messages.
        model: The robot.

    Returns:
        The robot with all sensors.
    """
    for index, entry in enumerate(sensors):
        with stated_in(f"{file}: sensor[{index}]"):
            if entry.joint is None or entry.measure_direction is None:
                model.sensor(entry.name)
            else:
                model = model.with_sensor(
                    entry.name,
                    joint=entry.joint,
                    direction=entry.measure_direction,
                    frame=entry.frame or SensorFrame.CHILD,
                )
    return model


def read_sensors(
    parsed: schema.ExperimentFile, file: Path, model: RobotModel, recording: Recording, inputs: Inputs
) -> tuple[ExperimentSensor, ...]:
    """Match every sensor to its stream and read its prior matrix.

    Args:
        parsed: Content of the experiment file.
        file: The experiment file, for messages.
        model: The robot with all sensors.
        recording: The streams.
        inputs: Resolves and remembers the files.

    Returns:
        The sensors in the order of the file.

    Raises:
        ExperimentError: If two entries are one sensor or share a stream.
    """
    sensors: list[ExperimentSensor] = []
    for index in range(len(parsed.sensor)):
        sensor = _sensor(parsed, file, index, model, recording, inputs)
        for earlier in sensors:
            if sensor.name == earlier.name:
                raise ExperimentError(f"{file}: sensor[{index}]: {sensor.name!r} is listed twice; keep one")
            if sensor.stream == earlier.stream:
                raise ExperimentError(
                    f"{file}: sensor[{index}]: {sensor.name!r} reads the stream {sensor.stream!r}, as does "
                    f"{earlier.name!r}; every sensor has its own"
                )
        sensors.append(sensor)
    return tuple(sensors)


def _sensor(
    parsed: schema.ExperimentFile, file: Path, index: int, model: RobotModel, recording: Recording, inputs: Inputs
) -> ExperimentSensor:
    where, entry = f"{file}: sensor[{index}]", parsed.sensor[index]
    with stated_in(where):
        stream = recording.stream(entry.stream)
    present = [quantity for quantity in ("raw", "wrench") if quantity in stream.signals]
    if not present:
        raise ExperimentError(
            f"{where}: expected a stream with raw or wrench, {entry.stream!r} holds {', '.join(stream.signals)}"
        )
    if present[0] == "wrench" and entry.prior is None:
        raise ExperimentError(
            f"{where}: expected prior, the matrix file that {entry.stream!r} was calibrated with; "
            'raw counts cannot be recovered without it; "identity" where that matrix is not known'
        )
    if present[0] == "wrench":
        _require_own_frame(where, entry, model, stream.signal("wrench").frame, of_load=bool(parsed.loaded_links))
    channels = len(stream.signals[present[0]].columns)
    if entry.amplifier_gain is not None and len(entry.amplifier_gain) != channels:
        raise ExperimentError(
            f"{where}: expected amplifier_gain of {channels} numbers, one per channel of {entry.stream!r}, "
            f"got {len(entry.amplifier_gain)}"
        )
    prior = read_prior(where, entry, inputs)
    full_scale = full_scale_of(entry, prior)
    if present[0] == "wrench" and prior is not None:
        _require_own_steps(where, entry, prior, stream.signal("wrench").values)
    _require_components(where, entry, prior, present[0], channels)
    return ExperimentSensor(
        name=model.sensor(entry.name).name,
        serial=entry.serial,
        stream=entry.stream,
        quantity=present[0],
        prior=None if prior is None else prior.matrix,
        prior_source=None if prior is None else prior.source,
        limit_counts=entry.limit_counts,
        full_scale=full_scale,
        prior_deviation=prior_deviation_of(where, entry, prior, full_scale),
        measurement_noise=None if entry.measurement_noise is None else np.array(entry.measurement_noise),
        measurement_offset_sd=None if entry.measurement_offset_sd is None else np.array(entry.measurement_offset_sd),
        amplifier_gain=entry.amplifier_gain,
        allowed_gains=entry.allowed_gains,
        mount_is_unknown=entry.mount == "unknown",
        measured=measured_by(entry),
        variables=tuple(
            _variable(f"{where}: variable[{k}]", variable, entry, recording)
            for k, variable in enumerate(entry.variable)
        ),
    )


def _require_own_steps(where: str, entry: Sensor, prior: SpecifiedPrior, wrench: FloatArray) -> None:
    """Refuse the matrix of another sensor than the one that sent a log: counts recovered through it are wrong."""
    if prior.board_scale is None or is_in_steps(wrench, prior.board_scale):
        return
    scales = full_scales_of_steps(wrench)
    if scales is None:  # of another device, or moved to another frame: nothing shows the matrix
        return
    ratios = {full / one for full, one in zip(prior.board_scale, scales, strict=True) if one is not None}
    if len(ratios) == 1:  # means of as many messages have as much smaller steps
        return
    sent, named = (", ".join("-" if one is None else f"{one:g}" for one in row) for row in (scales, prior.board_scale))
    raise ExperimentError(
        f"{where}: expected the matrix by which {entry.stream!r} was sent, in the steps of the full scales {sent} "
        f"N, N m, got {prior.source} with {named}; name the matrix file that has these, and its serial number"
    )


def _require_own_frame(where: str, entry: Sensor, model: RobotModel, frame: str | None, *, of_load: bool) -> None:
    """Refuse a wrench in a frame that is known not to be the sensor's: nothing would move it there."""
    joint = model.joints[model.sensor(entry.name).joint]
    if frame in {None, entry.name, entry.stream, joint.parent, joint.child}:
        return
    if of_load or frame in model.links:  # other names are those of ports and devices
        raise ExperimentError(
            f"{where}: expected a wrench in the frame of {entry.name!r}, {joint.parent!r} or {joint.child!r}, got one "
            f"in {frame!r} from the stream {entry.stream!r}; specify [[transform]] to move it, or "
            "the frame that it is in"
        )


def _variable(where: str, variable: Variable, entry: Sensor, recording: Recording) -> SensorVariable:
    if [other.name for other in entry.variable].count(variable.name) > 1:
        raise ExperimentError(f"{where}: the name {variable.name!r} comes twice; name the variables apart")
    with stated_in(where):
        signal = recording.stream(variable.stream or entry.stream).signal(variable.quantity)
        if variable.column is None and len(signal.columns) > 1:
            raise ExperimentError(f"expected column, one of {', '.join(signal.columns)}")
        source = ScalarSource(
            stream=variable.stream or entry.stream,
            quantity=variable.quantity,
            column=variable.column or signal.columns[0],
        )
        linear = LinearVariable(
            name=variable.name,
            unit=source.unit(recording),
            reference_value=variable.reference_value,
            prior=variable.prior_coefficients,
            prior_deviation=None if variable.prior_deviation is None else np.array(variable.prior_deviation),
        )
    return SensorVariable(linear=linear, source=source)
