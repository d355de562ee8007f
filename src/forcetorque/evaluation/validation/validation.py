# SPDX-License-Identifier: BSD-3-Clause
"""Evaluate a sensor where nothing touches: by the contact force that it reports, and by joint torques from it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import ClassVar, Literal

from pydantic import Field

from forcetorque.base.errors import ForceTorqueError
from forcetorque.evaluation.evaluation import smoothing_text
from forcetorque.evaluation.load_cases.verdict import LoadCaseVerdict, use_verdicts, verdict_texts
from forcetorque.evaluation.validation.contact_forces import (
    BestCalibration,
    ContactForceErrors,
    RecordingContactForces,
    contact_force_blocks,
    contact_force_rows,
    contact_forces_of,
)
from forcetorque.evaluation.validation.contact_wrenches import ContactWrenches, contact_wrenches
from forcetorque.evaluation.validation.joint_torque_errors import (
    TorqueErrorSamples,
    pooled_torque_errors,
    torque_error_samples,
)
from forcetorque.evaluation.validation.joint_torques import (
    JointTorqueErrors,
    RecordingJointTorques,
    joint_torque_table,
    joint_torques_of,
)
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.experiment.campaign import Campaign
from forcetorque.experiment.free_sub_model import FreeSubModel, SubModelChoice
from forcetorque.experiment.validation_offset import Offset
from forcetorque.experiment.validity import SamplesOutside, readings_outside, sentences
from forcetorque.recording.recording import Use
from forcetorque.results.result import Result
from forcetorque.results.table import Table


class Validation(Result):
    """Contact forces and joint torques of sensors, by their calibrations and the priors that those came from."""

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
    joint_torques = joint_torques_of(campaign, pooled_torque_errors(torques))
    forces = contact_forces_of(campaign.sensor, contacts)
    name = campaign.sensor.name
    validity, unknown = _validity(campaign, calibrations)
    uses, undecided = _uses(campaign, calibrations)
    reasons = (*forces.left_out, *joint_torques.left_out, *unknown, *undecided)
    left_out = tuple(dict.fromkeys(f"{name}: {words}" for words in reasons))
    several = len(campaign.runs) > 1
    return Validation(
        experiment="; ".join(campaign.recordings),
        other_sensors=choice.other_sensors.value,
        contact_forces=forces.verdicts,
        best=forces.best,
        joint_torques=joint_torques.verdicts,
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
    return torque_error_samples(free, calibrations), contact_wrenches(free, calibrations)


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
        for row in joint_torques_of(campaign, torques).verdicts:
            yield RecordingJointTorques(recording=name, **dict(row))
