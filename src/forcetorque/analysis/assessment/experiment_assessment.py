# SPDX-License-Identifier: BSD-3-Clause
"""Everything that can be said about the sensors of one experiment."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from pydantic import Field

from forcetorque.analysis.assessment.assessment import Assessment, Demands, assess
from forcetorque.analysis.assessment.overview import (
    IntervalOverview,
    StreamOverview,
    interval_overviews,
    stream_overviews,
)
from forcetorque.analysis.assessment.skin import assess_skin
from forcetorque.analysis.assessment.torques import assess_torques
from forcetorque.analysis.calibration.joint_rows import PartRow
from forcetorque.analysis.estimate.torque_picture import TorquePicture
from forcetorque.analysis.inspect.findings import inspect_experiment
from forcetorque.analysis.inspect.inspect import FindingRow, finding_rows
from forcetorque.analysis.joint.part_residuals import part_residuals
from forcetorque.analysis.runs.sensor_run import SensorRun
from forcetorque.analysis.skin.event_rows import SkinEventPicture, SkinEventRow, skin_event_rows
from forcetorque.analysis.skin.wrench import SkinWrench
from forcetorque.analysis.torque.fusion import TorqueFusion
from forcetorque.calibration import Calibration
from forcetorque.calibration.joint import PartResidual
from forcetorque.experiment import Experiment
from forcetorque.recording import Use
from forcetorque.result import Row


class ExperimentAssessment(Row):
    """Everything about one experiment."""

    experiment: str
    """Its name."""
    file: str
    """Its file."""
    robot: str
    """Name of the robot."""
    duration_s: float
    """Time from the earliest to the latest stamp."""
    streams: tuple[StreamOverview, ...]
    """Streams of the recording."""
    intervals: tuple[IntervalOverview, ...]
    """Its intervals."""
    findings: tuple[FindingRow, ...]
    """What is wrong with the recording."""
    sensors: tuple[Assessment, ...]
    """Its sensors."""
    parts: tuple[PartRow, ...] = ()
    """What the first calibration of every sensor leaves of parts that nothing touches, on data that was not fitted."""
    part_residuals: tuple[PartResidual, ...] = Field(default=(), exclude=True, repr=False)
    """The same window by window."""
    skin: tuple[SkinWrench, ...] = ()
    """Contacts on every patch of skin that states a table."""
    skin_left_out: tuple[str, ...] = ()
    """Why there are none of the other patches."""
    skin_events: tuple[SkinEventRow, ...] = ()
    """Contacts that a skinManager saw."""
    skin_event_pictures: tuple[SkinEventPicture, ...] = Field(default=(), exclude=True, repr=False)
    """The same over time."""
    fusion: TorqueFusion | None = None
    """Joint torques of several sources, with the first calibration of every sensor; None without `[fusion]`."""
    torque_picture: TorquePicture | None = Field(default=None, exclude=True, repr=False)
    """Joint torques over time, where there is skin or `[fusion]`."""
    torques_left_out: tuple[str, ...] = ()
    """Why there are none."""
    inputs_sha256: dict[str, str]
    """SHA-256 of every input file."""


def assess_experiment(
    experiment: Experiment,
    calibrations: Mapping[str, Mapping[str, Calibration]],
    *,
    file: str,
    demands: Demands,
    runs: Mapping[str, SensorRun] | None = None,
    progress: Callable[[str], None] | None = None,
) -> ExperimentAssessment:
    """Ask every question about the sensors of an experiment.

    Args:
        experiment: The experiment.
        calibrations: Calibrations by name of their file, by sensor; the sensors that have any are judged, or all if
            none has.
        file: Name of its file.
        demands: Limits and other sensors.
        runs: The sensors to judge by name, where other questions share what they have computed; made if left out.
        progress: Called with what is done next.

    Returns:
        The answers.
    """
    sensors = []
    for sensor in experiment.sensors:
        if calibrations and sensor.name not in calibrations:
            continue
        if progress is not None:
            progress(f"judging {sensor.name}")
        others = {
            name: calibration
            for other, group in calibrations.items()
            if other != sensor.name
            for name, calibration in group.items()
        }
        run = SensorRun(experiment, sensor) if runs is None else runs[sensor.name]
        sensors.append(assess(run, calibrations.get(sensor.name, {}), others=others, demands=demands))
    first = {name: next(iter(group.values())) for name, group in calibrations.items() if group}
    residuals = part_residuals(experiment, first, Use.VALIDATION)
    skin, skin_left_out = assess_skin(experiment.skin)
    skin_events, skin_event_pictures = skin_event_rows(experiment.recording)
    torques = assess_torques(experiment, first)
    start, end = experiment.recording.span_ns
    return ExperimentAssessment(
        experiment=experiment.name,
        file=file,
        robot=experiment.model.name,
        duration_s=(end - start) * 1e-9,
        streams=stream_overviews(experiment.recording),
        intervals=interval_overviews(experiment.recording),
        findings=finding_rows(start, inspect_experiment(experiment)),
        sensors=tuple(sensors),
        parts=tuple(map(PartRow.of, residuals)),
        part_residuals=tuple(residuals),
        skin=skin,
        skin_left_out=skin_left_out,
        skin_events=skin_events,
        skin_event_pictures=skin_event_pictures,
        fusion=torques.fusion,
        torque_picture=torques.picture,
        torques_left_out=torques.left_out,
        inputs_sha256=dict(experiment.inputs_sha256),
    )
