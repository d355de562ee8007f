# SPDX-License-Identifier: BSD-3-Clause
"""Evaluate a sensor where nothing touches: by the contact force that it reports, and by joint torques."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.errors import ForceTorqueError
from forcetorque.evaluation.evaluation import smoothing_text
from forcetorque.evaluation.load_cases.verdict import LoadCaseVerdict, use_verdicts, verdict_texts
from forcetorque.evaluation.validation.contact_force_errors import (
    BestCalibration,
    ContactForceErrors,
    RecordingContactForces,
    contact_force_blocks,
    contact_force_rows,
    contact_forces_of,
)
from forcetorque.evaluation.validation.contact_wrenches import ContactRows, ContactWrenches, add_segments
from forcetorque.evaluation.validation.joint_torque_errors import (
    TorqueErrors,
    TorqueErrorSamples,
    TorqueRows,
    pooled_torque_errors,
    torque_error_samples,
    torque_errors,
)
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibrations_under_test import EvaluatedRow
from forcetorque.experiment.campaign import Campaign, Runs
from forcetorque.experiment.free_sub_model import BEYOND_SENSOR, FreeSubModel, SubModelChoice
from forcetorque.experiment.seen_and_outside_samples import SamplesOutside, readings_outside, sentences
from forcetorque.experiment.validation_offset import Offset
from forcetorque.recording.recording import Use
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Shown, Table, table_of
from forcetorque.robot.model import JointType


class EstimatedJointRow(EvaluatedRow):
    """The joint of an estimated torque, and the calibration that reads the sensor."""

    joint: Annotated[str, Shown("joint")]
    """A joint whose torque depends on the sensor."""
    unit: Annotated[Literal["N", "N m"], Shown("unit")]
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


def joint_torques(
    runs: Runs,
    calibrations: Mapping[str, Calibration],
    choice: SubModelChoice = BEYOND_SENSOR,
) -> tuple[tuple[JointTorqueErrors, ...], tuple[str, ...]]:
    """Evaluate calibrations of a sensor by the joint torques that are estimated from it.

    The contacts are those of `estimate_experiment`: the support, and a full wrench at the sensor at the base of every
    other sub-model; `choice` may move that of the free one. The model's torques are those of the support as the only
    contact.

    Args:
        runs: The sensor in one recording, or in several, whose errors are pooled; the validation intervals are used.
        calibrations: Calibrations of that sensor by name; their priors are evaluated too, or that of the experiment
            where there is none.
        choice: Which sub-model nothing touches, and what the other sensors read.

    Returns:
        For every candidate, with its own offset and with one from each interval's first second, the errors per joint,
        joints from the support outwards; and the torques that the log does not allow to estimate, or to evaluate.

    Raises:
        ExperimentError: If an interval has no support.
    """
    campaign = Campaign.of(runs)
    recordings = choice.in_campaign(campaign, lambda free: torque_error_samples(free, calibrations))
    pooled = pooled_torque_errors(recordings)
    return joint_torques_of(campaign, pooled), pooled.left_out


def joint_torques_of(campaign: Campaign, torques: TorqueErrorSamples) -> tuple[JointTorqueErrors, ...]:
    """Evaluate calibrations of a sensor by given errors of joint torques.

    Args:
        campaign: The sensor.
        torques: Errors by every candidate.

    Returns:
        The errors of `joint_torques`.
    """
    return tuple(_rows(campaign, torques))


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


class Validation(DrawnResult):
    """Contact forces and joint torques of sensors, by their calibrations and the priors that those came from."""

    drawn_by: ClassVar[str] = "forcetorque.evaluation.figures.acceptance_and_contact_forces:validation_figure"

    answered_by: ClassVar[str | None] = "forcetorque.evaluation.validation.answers:validation_answers"

    of_several: ClassVar[tuple[str, ...]] = ("recordings", "recording_torques")

    interval_uses = ()

    schema_name: Literal["forcetorque/validate/2"] = Field(default="forcetorque/validate/2", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment; of several recordings their names, apart by semicolons."""
    other_sensors: Literal["model", "measured"]
    """What the other sensors of the sub-model were taken to read."""
    contact_forces: tuple[ContactForceErrors, ...]
    """One per sensor, calibration and offset."""
    best: tuple[BestCalibration, ...]
    """One per sensor and offset."""
    joint_torques: tuple[JointTorqueErrors, ...]
    """One per sensor, calibration, offset and joint that depends on the sensor."""
    recordings: tuple[RecordingContactForces, ...] = ()
    """Contact forces of every recording by itself; none where there is one."""
    recording_torques: tuple[RecordingJointTorques, ...] = ()
    """Joint torques of every recording by itself; none where there is one."""
    left_out: tuple[str, ...]
    """Torques that the log does not allow to estimate, and what gaps and short intervals leave out, in words."""
    smoothing: tuple[str, ...] = ()
    """Whether measured and expected wrench were smoothed, as text; of several recordings one per way."""
    validity: tuple[SamplesOutside, ...] = ()
    """One per calibration: how far the validation samples lie outside what it was fitted on."""

    load_cases: tuple[LoadCaseVerdict, ...] = ()
    """One per calibration and load case: whether it may be used."""

    def blocks(self) -> Iterator[Table | str]:
        """Give tables of contact forces, who is best, and tables of joint torques.

        Yields:
            Tables and sentences.
        """
        yield from contact_force_blocks(self.contact_forces, self.best, self.recordings)
        for sensor in dict.fromkeys(row.sensor for row in self.contact_forces):
            yield from self._without_offset(sensor)
            torques = [row for row in self.joint_torques if row.sensor == sensor]
            yield joint_torque_table(torques) if torques else f"{sensor}: no joint torque is estimated from it"
        yield from verdict_texts(self.load_cases)
        others = "the model expects" if self.other_sensors == "model" else "they measured"
        yield "; ".join((f"other sensors: as {others}", *self.smoothing))

    def records(self) -> list[dict[str, object]]:
        """Give contact forces and joint torques as flat lines.

        Returns:
            One line per row; `what` says which it is, and `recording`, where there are several, on which: empty where
            they are pooled.
        """
        pooled: dict[str, object] = {"recording": ""} if self.recordings else {}
        forces: list[dict[str, object]] = [{"what": "contact_force", **row.flat()} for row in self.recordings]
        torques: list[dict[str, object]] = [{"what": "joint_torque", **row.flat()} for row in self.recording_torques]
        return [
            *({"what": "contact_force", **pooled, **row.flat()} for row in self.contact_forces),
            *forces,
            *({"what": "joint_torque", **pooled, **row.flat()} for row in self.joint_torques),
            *torques,
        ]

    def _without_offset(self, sensor: str) -> Iterator[str]:
        """List the candidates whose wrenches keep the unknown offset of the sensor, with what reads them."""
        for row in self.contact_forces:
            if row.sensor == sensor and row.offset is Offset.NONE:
                yield f"{sensor}, {row.calibration}, offset {row.offset}: read by {row.offset_source}"


def validation(campaign: Campaign, calibrations: Mapping[str, Calibration], choice: SubModelChoice) -> Validation:
    """Evaluate calibrations of a sensor by contact force and joint torques where nothing touches.

    Args:
        campaign: The sensor in one recording, or in several, whose errors are pooled.
        calibrations: Calibrations of that sensor by name; their priors are evaluated too, or that of the experiment
            where there is none.
        choice: Which sub-model nothing touches, and what the other sensors read.

    Returns:
        What `contact_forces` and `joint_torques` give, from one motion of the robot.

    Raises:
        ExperimentError: If there is no validation interval, or one has no support.
    """
    results = choice.in_campaign(campaign, lambda free: _torques_and_contacts(free, calibrations))
    torques = {name: result[0] for name, result in results.items()}
    contacts = {name: result[1] for name, result in results.items()}
    pooled = pooled_torque_errors(torques)
    forces = contact_forces_of(campaign.sensor, contacts)
    name = campaign.sensor.name
    validity, unknown = _validity(campaign, calibrations)
    uses, undecided = _uses(campaign, calibrations)
    reasons = (*forces.left_out, *pooled.left_out, *unknown, *undecided)
    left_out = tuple(dict.fromkeys(f"{name}: {words}" for words in reasons))
    several = len(campaign.runs) > 1
    return Validation(
        experiment="; ".join(campaign.recordings),
        other_sensors=choice.other_sensors.value,
        contact_forces=forces.verdicts,
        best=forces.best,
        joint_torques=joint_torques_of(campaign, pooled),
        recordings=tuple(_forces_apart(campaign, contacts)) if several else (),
        recording_torques=tuple(_torques_apart(campaign, torques)) if several else (),
        left_out=left_out,
        smoothing=tuple(dict.fromkeys(map(smoothing_text, campaign.runs_with(Use.VALIDATION)))),
        validity=validity,
        load_cases=uses,
        warnings=(*sentences(validity), *(f"left out: {words}" for words in left_out)),
    )


def _torques_and_contacts(
    free: FreeSubModel, calibrations: Mapping[str, Calibration]
) -> tuple[TorqueErrorSamples, ContactWrenches]:
    """Torques first: they need the motion of more joints, in which that of the contact force is found."""
    candidates = free.whole.candidates(calibrations)
    torques, contacts = TorqueRows(candidates), ContactRows(candidates)
    add_segments(free, torques, contacts)
    return torques.samples(), contacts.wrenches()


def _validity(
    campaign: Campaign, calibrations: Mapping[str, Calibration]
) -> tuple[tuple[SamplesOutside, ...], tuple[str, ...]]:
    """How far readings lie outside what was fitted; else why that is not known: joints beyond the sensor may lack."""
    try:
        return readings_outside(campaign, calibrations), ()
    except ForceTorqueError as error:
        return (), (f"whether readings lie within what was fitted: {error}",)


def _uses(
    campaign: Campaign, calibrations: Mapping[str, Calibration]
) -> tuple[tuple[LoadCaseVerdict, ...], tuple[str, ...]]:
    """Whether calibrations may be used; else why that cannot be told, such as that one has seen the validation data."""
    try:
        return use_verdicts(campaign, calibrations), ()
    except ForceTorqueError as error:
        return (), (f"whether it may be used: {error}",)


def _forces_apart(campaign: Campaign, recordings: Mapping[str, ContactWrenches]) -> Iterator[RecordingContactForces]:
    for name, contacts in recordings.items():
        for row in contact_force_rows(campaign.sensor, contacts):
            yield RecordingContactForces(recording=name, **dict(row))


def _torques_apart(campaign: Campaign, recordings: Mapping[str, TorqueErrorSamples]) -> Iterator[RecordingJointTorques]:
    for name, torques in recordings.items():
        for row in joint_torques_of(campaign, torques):
            yield RecordingJointTorques(recording=name, **dict(row))
