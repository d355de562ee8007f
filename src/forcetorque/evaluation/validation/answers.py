# SPDX-License-Identifier: BSD-3-Clause
"""The answer of `validate` in a few lines: the contact force where nothing touches, and who reports the least."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from forcetorque.evaluation.answers import to_calibrate, to_evaluate
from forcetorque.experiment.calibrations_under_test import PRIOR
from forcetorque.experiment.validation_offset import Offset
from forcetorque.results.answer import Answer, Concern
from forcetorque.results.number_text import amount, within
from forcetorque.results.table import short_names

if TYPE_CHECKING:
    from forcetorque.evaluation.validation.contact_force_errors import BestCalibration, ContactForceErrors
    from forcetorque.evaluation.validation.validation import JointTorqueErrors, Validation


def validation_answers(validation: Validation) -> Iterator[Answer]:
    """Give the answer for every sensor, with joint torques from it.

    Args:
        validation: Contact forces and joint torques.

    Yields:
        One answer each.
    """
    forces, torques = validation.contact_forces, validation.joint_torques
    for choice in answered_choices(validation.best):
        rows = [row for row in forces if (row.sensor, row.offset) == (choice.sensor, choice.offset)]
        own = [row for row in torques if (row.sensor, row.offset) == (choice.sensor, choice.offset)]
        yield _answer(choice, rows, own)


def answered_choices(best: Sequence[BestCalibration]) -> Iterator[BestCalibration]:
    """Choose the offset by which every sensor is answered.

    Args:
        best: One per sensor and offset.

    Yields:
        One per sensor: that of its own offset where its candidates have one.
    """
    for sensor in dict.fromkeys(row.sensor for row in best):
        of_sensor = [row for row in best if row.sensor == sensor]
        yield next((row for row in of_sensor if row.offset is Offset.FITTED), of_sensor[0])


def _answer(
    choice: BestCalibration, rows: Sequence[ContactForceErrors], torques: Sequence[JointTorqueErrors]
) -> Answer:
    names = short_names([row.calibration for row in rows])
    least = next(row for row in rows if row.calibration == choice.by_magnitude)
    ordered = sorted(rows, key=lambda row: (row.calibration != choice.by_magnitude, row.force_mean_N))
    forces = ", ".join(f"{names[row.calibration]} {_force(row)}" for row in ordered)
    calibrations = [row.calibration for row in ordered if not _is_prior(row.calibration)]
    step, command = to_evaluate(calibrations[0]) if calibrations else to_calibrate(least.sensor)
    return Answer(
        subject=f"{least.sensor} ({least.serial}), nothing touches {least.sub_model}",
        verdict=_verdict(choice, names[choice.by_magnitude], least),
        why=(
            f"contact force, which should be zero, {choice.offset} offset: {forces}",
            *_of_torques(torques, choice.by_magnitude, names),
        ),
        step=step,
        command=command,
        concern=_concern(choice),
    )


def _verdict(choice: BestCalibration, name: str, least: ContactForceErrors) -> str:
    return best_text(choice, name) or f"contact force {_force(least)}"


def best_text(choice: BestCalibration, name: str) -> str:
    """Say who is best.

    Args:
        choice: Candidates of a sensor.
        name: What the one with the least contact force is called.

    Returns:
        The verdict; empty where there is one candidate only.
    """
    if choice.conclusion is None:
        return ""
    if choice.best is not None:
        return f"BEST: {name}"
    return "NONE IS BEST: NO DIFFERENCE" if choice.conclusion == "no difference" else "NONE IS BEST: TOO LITTLE DATA"


def _concern(choice: BestCalibration) -> Concern:
    if choice.conclusion is None:
        return Concern.NONE
    if choice.best is not None:
        return Concern.BAD if _is_prior(choice.best) else Concern.NONE
    return Concern.UNCERTAIN


def _is_prior(candidate: str) -> bool:
    return candidate == PRIOR or candidate.startswith(f"{PRIOR} of ")


def _force(row: ContactForceErrors) -> str:
    return within(row.force_mean_N, row.force_mean_half_width_95_N, "N")


def _of_torques(torques: Sequence[JointTorqueErrors], candidate: str, names: Mapping[str, str]) -> Iterator[str]:
    own = [row for row in torques if row.calibration == candidate]
    if not own:
        return
    worst = max(own, key=lambda row: row.rmse)
    others = ", ".join(
        f"{names.get(row.calibration, row.calibration)} {amount(row.rmse, row.unit)}"
        for row in torques
        if row.joint == worst.joint and row.calibration != candidate
    )
    beside = f", {others}" if others else ""
    yield f"largest joint torque error, {worst.joint}: {names[candidate]} {_torque(worst)}{beside}"


def _torque(row: JointTorqueErrors) -> str:
    return within(row.rmse, row.rmse_half_width_95, row.unit)
