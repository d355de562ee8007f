# SPDX-License-Identifier: BSD-3-Clause
"""From an experiment file to a robot, a recording with intervals, and sensors with their priors."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from forcetorque.arrays import FloatArray
from forcetorque.errors import ExperimentError, MissingFileError, known_names
from forcetorque.estimation import Processing
from forcetorque.exchange.icub import read_matrix_file
from forcetorque.exchange.yarp import PortReading, read_analog, read_state_ext
from forcetorque.experiment import schema
from forcetorque.experiment.inputs import Inputs, stated_in
from forcetorque.experiment.parse import parse_experiment
from forcetorque.recording import Interval, Recording, SavitzkyGolay, Support, Use, read_recording
from forcetorque.robot import RobotModel, SensorFrame, read_urdf


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ExperimentSensor:
    """A sensor of the experiment, matched to the robot and to a stream."""

    name: str
    """Name in the robot model."""
    serial: str
    """Serial number."""
    stream: str
    """Stream that holds its reading."""
    quantity: str
    """`raw` or `wrench`."""
    prior: FloatArray | None
    """Prior matrix; shape (6, c); N/count, N m/count."""
    prior_source: str | None
    """Its file, as the experiment names it."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Experiment:
    """Everything that an experiment file points to."""

    name: str
    """Name of the experiment."""
    model: RobotModel
    """The robot."""
    recording: Recording
    """What was measured, with the file's intervals."""
    sensors: tuple[ExperimentSensor, ...]
    """Sensors in the order of the file."""
    processing: Processing
    """Filters and gravity."""
    regularisation: float | None
    """Lambda; counts2; None to choose it on held-out blocks."""
    inputs_sha256: dict[str, str]
    """SHA-256 of every input file, by its path as the experiment names it."""

    def sensor(self, name: str) -> ExperimentSensor:
        """Find a sensor of the experiment.

        Args:
            name: Its name, or another one that the robot model has for it.

        Returns:
            The sensor.

        Raises:
            ExperimentError: If the experiment has none of that name.
        """
        for sensor in self.sensors:
            if name in (sensor.name, *self.model.sensor(sensor.name).aliases):
                return sensor
        raise ExperimentError(
            f"experiment {self.name!r} has no sensor {name!r}; {known_names(name, (s.name for s in self.sensors))}"
        )

    def intervals(self, use: Use) -> tuple[Interval, ...]:
        """Give the intervals of one use.

        Args:
            use: The use.

        Returns:
            Intervals in the order of the file.

        Raises:
            ExperimentError: If there is none.
        """
        found = tuple(interval for interval in self.recording.intervals if interval.use is use)
        if not found:
            raise ExperimentError(f'experiment {self.name!r}: expected an interval with use = "{use}", it has none')
        return found


def load_experiment(path: Path | str) -> Experiment:
    """Read an experiment file and everything that it points to.

    Args:
        path: TOML file; the paths in it are relative to its folder.

    Returns:
        The experiment.

    Raises:
        MissingFileError: If a file is not there.
        FormatError: If a file does not have its form.
        ExperimentError: If the file contradicts itself, the robot or the recording.
    """
    file = Path(path)
    parsed = parse_experiment(file)
    inputs = Inputs(file.parent)
    model = _declare_sensors(parsed, file, read_urdf(inputs.file(parsed.robot.urdf)))
    streams = _read_streams(parsed, file, model, inputs)
    intervals = _intervals(parsed, file, streams, model)
    with stated_in(str(file)):
        recording = streams.with_intervals(intervals)
    return Experiment(
        name=parsed.name,
        model=model,
        recording=recording,
        sensors=_sensors(parsed, file, model, recording, inputs),
        processing=_processing(parsed),
        regularisation=parsed.calibration.lambda_counts2,
        inputs_sha256=inputs.sha256(),
    )


def _declare_sensors(parsed: schema.ExperimentFile, file: Path, model: RobotModel) -> RobotModel:
    for index, entry in enumerate(parsed.sensor):
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


def _read_streams(parsed: schema.ExperimentFile, file: Path, model: RobotModel, inputs: Inputs) -> Recording:
    log = parsed.recording
    origin = {"format": log.format, "path": log.path.as_posix(), "robot": model.name}
    if isinstance(log, schema.ParquetLog):
        return read_recording(inputs.below(log.path, "*.parquet", "recording.json"))
    if not (inputs.folder / log.path).is_dir():
        raise MissingFileError(f"{inputs.folder / log.path}: expected the folder of a log, there is none")
    readers = {entry.stream: entry.name for entry in parsed.sensor}
    readings: dict[str, PortReading] = {}
    for index, port in enumerate(log.stream):
        where = f"{file}: recording.stream[{index}]"
        if port.name in readings:
            raise ExperimentError(f"{where}: the name {port.name!r} is taken by an earlier stream")
        folder = inputs.below(log.path / port.port, "data.log", "data.log.gz", "info.log")
        if isinstance(port, schema.StateExtPort):
            units = {name: model.joints[name].type.unit for name in port.joints if name in model.joints}
            with stated_in(where):
                readings[port.name] = read_state_ext(folder, stream=port.name, joints=port.joints, joint_units=units)
        elif port.name in readers:
            with stated_in(where):
                readings[port.name] = read_analog(folder, stream=port.name, frame=readers[port.name])
        else:
            raise ExperimentError(f"{where}: no [[sensor]] reads the stream {port.name!r}; add one or leave it out")
    return Recording(
        streams={name: reading.stream for name, reading in readings.items()},
        findings=tuple(finding for reading in readings.values() for finding in reading.findings),
        origin=origin,
    )


def _sensors(
    parsed: schema.ExperimentFile, file: Path, model: RobotModel, recording: Recording, inputs: Inputs
) -> tuple[ExperimentSensor, ...]:
    found: list[ExperimentSensor] = []
    for index, entry in enumerate(parsed.sensor):
        sensor = _sensor(file, index, entry, model, recording, inputs)
        for earlier in found:
            if sensor.name == earlier.name:
                raise ExperimentError(f"{file}: sensor[{index}]: {sensor.name!r} is listed twice; keep one")
            if sensor.stream == earlier.stream:
                raise ExperimentError(
                    f"{file}: sensor[{index}]: {sensor.name!r} reads the stream {sensor.stream!r}, as does "
                    f"{earlier.name!r}; every sensor has its own"
                )
        found.append(sensor)
    return tuple(found)


def _sensor(
    file: Path, index: int, entry: schema.Sensor, model: RobotModel, recording: Recording, inputs: Inputs
) -> ExperimentSensor:
    where = f"{file}: sensor[{index}]"
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
            "raw counts cannot be recovered from a calibrated stream without it"
        )
    return ExperimentSensor(
        name=model.sensor(entry.name).name,
        serial=entry.serial,
        stream=entry.stream,
        quantity=present[0],
        prior=None if entry.prior is None else read_matrix_file(inputs.file(entry.prior)).matrix,
        prior_source=None if entry.prior is None else entry.prior.as_posix(),
    )


def _intervals(parsed: schema.ExperimentFile, file: Path, recording: Recording, model: RobotModel) -> list[Interval]:
    supports: dict[str, Support] = {}
    for index, entry in enumerate(parsed.support):
        if entry.frame not in model.links:
            raise ExperimentError(
                f"{file}: support[{index}]: robot {model.name!r} has no link {entry.frame!r}; "
                f"{known_names(entry.frame, model.links)}"
            )
        if entry.frame in supports:
            raise ExperimentError(f"{file}: support[{index}]: the frame {entry.frame!r} is listed twice; keep one")
        with stated_in(f"{file}: support[{index}]"):
            supports[entry.frame] = Support(frame=entry.frame, gravity_direction=entry.gravity_direction)
    with stated_in(f"{file}: recording"):
        start, end = recording.span_ns
    log_s = (end - start) // 1_000_000 / 1000  # rounded down, so that who copies it from the message stays inside
    found = []
    for index, span in enumerate(parsed.interval):
        where = f"{file}: interval[{index}] {span.label!r}"
        if span.support is not None and span.support not in supports:
            raise ExperimentError(
                f"{where}: no [[support]] has the frame {span.support!r}; {known_names(span.support, supports)}"
            )
        if span.start_s < 0.0 or max(span.start_s, span.end_s) * 1e9 > end - start + 1.5:
            raise ExperimentError(
                f"{where}: expected a span inside the log, 0 to {log_s:.3f} s, got {span.start_s:g} to {span.end_s:g} s"
            )
        with stated_in(f"{file}: interval[{index}]"):
            interval = Interval(
                label=span.label,
                start_ns=start + round(span.start_s * 1e9),
                end_ns=start + round(span.end_s * 1e9),
                use=span.use,
                support=None if span.support is None else supports[span.support],
            )
        found.append(interval)
    _refuse_overlap(file, found)
    return found


def _refuse_overlap(file: Path, intervals: list[Interval]) -> None:
    """Refuse samples that would be fitted and judged, or fitted twice."""
    used = [interval for interval in intervals if interval.use is not Use.IGNORE]
    for k, first in enumerate(used):
        for second in used[k + 1 :]:
            if first.start_ns < second.end_ns and second.start_ns < first.end_ns:
                raise ExperimentError(
                    f"{file}: the intervals {first.label!r} ({first.use}) and {second.label!r} ({second.use}) overlap; "
                    "a sample is fitted or judged once"
                )


def _processing(parsed: schema.ExperimentFile) -> Processing:
    derivatives, smoothing = parsed.processing.derivatives, parsed.processing.smoothing
    default = Processing()
    return Processing(
        derivative_window=default.derivative_window
        if derivatives == "logged"
        else SavitzkyGolay(window_s=derivatives.window_s, order=derivatives.order),
        logged_derivatives=derivatives == "logged",
        smoothing=None if smoothing is None else SavitzkyGolay(window_s=smoothing.window_s, order=smoothing.order),
        gravity=parsed.robot.gravity,
    )
