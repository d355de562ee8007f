# SPDX-License-Identifier: BSD-3-Clause
"""Everything that is computed of the sensors, the skin and the joint torques of one experiment."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from pydantic import Field

from forcetorque.base.errors import ForceTorqueError
from forcetorque.calibration.joint.result import SubModelRow
from forcetorque.calibration.joint.robust_fit import PartResidual
from forcetorque.calibration.joint.untouched_interval import part_residuals
from forcetorque.collisions.collision_and_sole_events import with_collisions
from forcetorque.estimation.estimate import estimate_experiment
from forcetorque.estimation.section import FUSION
from forcetorque.estimation.torque.experiment_fusion import (
    TorqueFusion,
    TorquePicture,
    fuse_experiment,
    summarise_fusion,
    torque_picture,
)
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.offsets import corrections_of
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.inspection.inspect import FindingRow, finding_rows, inspect_segments
from forcetorque.recording.recording import Use
from forcetorque.report.sensor_assessment import (
    Assessment,
    Demands,
    IntervalOverview,
    StreamOverview,
    assess,
    interval_overviews,
    stream_overviews,
)
from forcetorque.results.table import Row
from forcetorque.skin.patches_of_experiment import PatchExperiment, is_skin_alone
from forcetorque.skin.section import PATCHES, force_patches
from forcetorque.skin.wrench.result import SkinEventPicture, SkinEventRow, skin_event_rows
from forcetorque.skin.wrench.skin_wrench import SkinWrench, skin_wrench


def assess_skin(patches: PatchExperiment | None) -> tuple[tuple[SkinWrench, ...], tuple[str, ...]]:
    """Find the contacts on every patch of an experiment.

    Args:
        patches: The patches; None without any.

    Returns:
        Contacts of every patch that has a table, and sentences about the others.
    """
    contacts, left_out = [], []
    for patch in () if patches is None else patches.patches:
        if patches is None or patch.table is None:
            left_out.append(f"{patch.name}: [[patch]] states no table, which `forcetorque skin calibrate` makes")
            continue
        try:
            contacts.append(skin_wrench(patches, patch.table, patch=patch.name))
        except ForceTorqueError as error:
            left_out.append(f"{patch.name}: {error}")
    return tuple(contacts), tuple(left_out)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TorqueAssessment:
    """Joint torques over time, by source where there are several."""

    fusion: TorqueFusion | None = None
    """What the sources come to; None without `[fusion]`."""
    picture: TorquePicture | None = None
    """Torques over time; None where there are none."""
    left_out: tuple[str, ...] = ()
    """Why there are none."""


def assess_torques(experiment: Experiment, calibrations: Mapping[str, Calibration]) -> TorqueAssessment:
    """Assess joint torques where other sources than force-torque sensors measure them too.

    Args:
        experiment: The experiment.
        calibrations: A calibration by sensor; others are read by their prior.

    Returns:
        Torques; nothing for an experiment with neither `[fusion]` nor a patch with a table, or without a robot.
    """
    if is_skin_alone(experiment.model) or (experiment.section(FUSION) is None and not force_patches(experiment)):
        return TorqueAssessment()
    try:
        corrections = corrections_of(experiment, calibrations)
        if experiment.section(FUSION) is None:
            return TorqueAssessment(picture=torque_picture(experiment, estimate_experiment(experiment, corrections)))
        fusions, frictions = fuse_experiment(experiment, corrections)
        return TorqueAssessment(
            fusion=summarise_fusion(experiment, fusions, frictions), picture=torque_picture(experiment, fusions=fusions)
        )
    except ForceTorqueError as error:
        return TorqueAssessment(left_out=(str(error),))


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
    sub_models: tuple[SubModelRow, ...] = ()
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
    """Run every analysis of the sensors of an experiment.

    Args:
        experiment: The experiment.
        calibrations: Calibrations by name of their file, by sensor; the sensors that have any are evaluated, or all if
            none has.
        file: Name of its file.
        demands: Limits and other sensors.
        runs: The sensors by name, to share what other analyses computed of them; made if left out.
        progress: Called with what is done next.

    Returns:
        The contacts.
    """
    sensors = []
    for sensor in experiment.sensors:
        if calibrations and sensor.name not in calibrations:
            continue
        if progress is not None:
            progress(f"evaluating {sensor.name}")
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
    skin, skin_left_out = assess_skin(experiment.section(PATCHES))
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
        findings=finding_rows(start, with_collisions(lambda: inspect_segments(experiment), experiment, first)),
        sensors=tuple(sensors),
        sub_models=tuple(map(SubModelRow.of, residuals)),
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
