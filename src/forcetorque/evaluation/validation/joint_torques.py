# SPDX-License-Identifier: BSD-3-Clause
"""Joint torques that a sensor's candidates lead to, against those of the rigid-body model (thesis 2.4.3, 5.6)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Annotated, ClassVar, Literal

import numpy as np

from forcetorque.evaluation.validation.joint_torque_errors import (
    TorqueErrors,
    TorqueErrorSamples,
    pooled_torque_errors,
    torque_error_samples,
    torque_errors,
)
from forcetorque.experiment.additions import with_recording_notes
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.experiment.calibrations_under_test import EvaluatedRow
from forcetorque.experiment.campaign import Campaign, Runs
from forcetorque.experiment.free_sub_model import OtherSensors, SubModelChoice
from forcetorque.results.result import Result
from forcetorque.results.table import Shown, Table, table_of
from forcetorque.robot.model import JointType


class EstimatedJointRow(EvaluatedRow):
    """The joint of an estimated torque, and the calibration that reads the sensor."""

    joint: Annotated[str, Shown("joint")]
    """A joint whose torque depends on the sensor."""
    unit: Annotated[Literal["N m", "N"], Shown("unit")]
    """Unit of its torque: N for a prismatic joint."""


class JointTorqueErrors(TorqueErrors, EstimatedJointRow):
    """Estimated torque of one joint less that of the rigid-body model, by one calibration under test."""

    logged_samples: int | None
    """Number of samples with a logged torque; null where none can be compared."""
    logged_rmse: Annotated[float | None, Shown("RMSE from logged", digits=3, error="logged_rmse_half_width_95")]
    """Root mean square of estimated torque less the logged one."""
    logged_rmse_error: float | None
    """Standard error of that root; none for one sample."""
    logged_rmse_half_width_95: float | None
    """Half-width of its 95 % interval; none where the samples do not determine it."""


class RecordingJointTorques(JointTorqueErrors):
    """The same on one of several recordings."""

    recording: str
    """Name of the recording, unique in the campaign: that of the experiment, with the file where several have it."""


class JointTorques(Result):
    """Joint torques that depend on one sensor, by all its candidates."""

    answered_by: ClassVar[str | None] = "forcetorque.evaluation.validation.answers:torque_answers"

    verdicts: tuple[JointTorqueErrors, ...]
    """One per calibration, offset and joint, joints from the support outwards."""
    left_out: tuple[str, ...]
    """Torques that the log does not allow to estimate, or to evaluate in an interval, in words."""

    def blocks(self) -> Iterator[Table | str]:
        """Give a table per sensor.

        Yields:
            Tables, or a sentence where there is nothing to show.
        """
        for sensor in dict.fromkeys(row.sensor for row in self.verdicts):
            yield joint_torque_table([row for row in self.verdicts if row.sensor == sensor])
        if not self.verdicts:
            yield "no joint torque is estimated from the sensor"


@with_recording_notes
def joint_torques(
    runs: Runs,
    calibrations: Mapping[str, Calibration],
    *,
    others: Mapping[str, Calibration] | None = None,
    other_sensors: OtherSensors = OtherSensors.MODEL,
    sub_model: str | None = None,
    contact: str | None = None,
) -> JointTorques:
    """Evaluate calibrations of a sensor by the joint torques that are estimated from it.

    The contacts are those of `estimate_experiment`: the support, and a full wrench at the sensor at the base of every
    other sub-model; `contact` moves that of the free one. The model's torques are those of the support as the only
    contact.

    Args:
        runs: The sensor in one recording, or in several, whose errors are pooled; the validation intervals are used.
        calibrations: Calibrations of that sensor by name; their priors are evaluated too, or that of the experiment
            where there is none.
        others: Calibrations of the other sensors by name, for the mode `measured`; where there is none, their prior.
        other_sensors: Whether the other sensors read what the model expects or what they measured.
        sub_model: The free sub-model, by the sensor at its base or the root link; None for that outboard of the sensor.
        contact: Link of the free sub-model that takes up its contact wrench; None for that at its base.

    Returns:
        For every candidate, with its own offset and with one from each interval's first second, the errors per joint.

    Raises:
        ExperimentError: If an interval has no support.
    """
    campaign = Campaign.of(runs)
    choice = SubModelChoice(others=others, other_sensors=other_sensors, sub_model=sub_model, contact=contact)
    recordings = choice.in_campaign(campaign, lambda free: torque_error_samples(free, calibrations))
    return joint_torques_of(campaign, pooled_torque_errors(recordings))


def joint_torques_of(campaign: Campaign, torques: TorqueErrorSamples) -> JointTorques:
    """Evaluate calibrations of a sensor by given errors of joint torques.

    Args:
        campaign: The sensor.
        torques: Errors by every candidate.

    Returns:
        The same as `joint_torques`.
    """
    return JointTorques(
        verdicts=tuple(_rows(campaign, torques)),
        left_out=torques.left_out,
        warnings=tuple(f"left out: {words}" for words in torques.left_out),
    )


def joint_torque_table(rows: Sequence[JointTorqueErrors]) -> Table:
    """Show the joint torques of one sensor, candidates of a joint with one offset under each other.

    Args:
        rows: The rows, at least one.

    Returns:
        The table.
    """
    ordered = sorted(rows, key=_place(rows))
    return table_of(
        ordered,
        f"{rows[0].sensor} ({rows[0].serial}): joint torques estimated from it, less those of the model; "
        "± half a 95 % interval",
        leave_out={"logged_rmse"} if all(row.logged_rmse is None for row in rows) else (),
    )


def _place(rows: Sequence[JointTorqueErrors]) -> Callable[[JointTorqueErrors], tuple[int, int]]:
    joints = list(dict.fromkeys(row.joint for row in rows))
    offsets = list(dict.fromkeys(row.offset for row in rows))
    return lambda row: (joints.index(row.joint), offsets.index(row.offset))


def _rows(campaign: Campaign, torques: TorqueErrorSamples) -> Iterator[JointTorqueErrors]:
    joints = {name: joint for run in campaign.runs for name, joint in run.experiment.model.joints.items()}
    for key, samples in torques.samples.items():
        if np.isnan(samples.from_model).all():
            continue
        candidate, errors = torques.candidates[key.candidate], torque_errors(samples.from_model, samples.time_s)
        none_logged = np.isnan(samples.from_logged).all()
        logged = None if none_logged else torque_errors(samples.from_logged, samples.logged_time_s)
        prismatic = joints[key.joint].type is JointType.PRISMATIC
        yield JointTorqueErrors(
            sensor=campaign.sensor.name,
            serial=campaign.sensor.serial,
            calibration=candidate.name,
            offset=candidate.offset(key.offset),
            offset_source=candidate.offset_source(key.offset),
            prior=candidate.prior,
            joint=key.joint,
            unit="N" if prismatic else "N m",
            **dict(errors),
            logged_samples=None if logged is None else logged.samples,
            logged_rmse=None if logged is None else logged.rmse,
            logged_rmse_error=None if logged is None else logged.rmse_error,
            logged_rmse_half_width_95=None if logged is None else logged.rmse_half_width_95,
        )
