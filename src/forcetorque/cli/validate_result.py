# SPDX-License-Identifier: BSD-3-Clause
"""The result of `forcetorque validate`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from forcetorque.analysis import ContactForceVerdict, JointTorqueVerdict
from forcetorque.cli.output import finite_or_none
from forcetorque.evaluation import Offset


class ContactForceRow(BaseModel):
    """Contact wrench that a candidate reports where nothing touches, in the sensor's frame; per axis fx ... tz."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    sub_model: str
    """Sub-model that nothing touches."""
    candidate: str
    """The calibration file, or its prior: `prior`, and `prior of FILE` among several files."""
    offset: Offset
    """Offset from the first second of every judged interval, or that of the candidate."""
    offset_source: str
    """Where that offset comes from, in words."""
    prior: str | None
    """Candidate that is the prior of a calibration file; null for a prior, and where the file has none."""
    samples: int
    """Number of judged samples."""
    force_mean_N: float
    """Mean norm of the force."""
    force_mean_error_N: float | None
    """Standard error of that mean, from blocks of time."""
    moment_mean_Nm: float
    """Mean norm of the moment."""
    mean_absolute: list[float]
    """Mean absolute value per component; N, N m."""


class JointTorqueRow(BaseModel):
    """Error of the torque that is estimated for one joint, where one candidate reads the sensor."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    candidate: str
    """The calibration file, or its prior: `prior`, and `prior of FILE` among several files."""
    offset: Offset
    """Offset from the first second of every judged interval, or that of the candidate."""
    offset_source: str
    """Where that offset comes from, in words."""
    prior: str | None
    """Candidate that is the prior of a calibration file; null for a prior, and where the file has none."""
    joint: str
    """A joint whose torque depends on the sensor."""
    unit: Literal["N m", "N"]
    """Unit of its torque: N for a prismatic joint."""
    samples: int
    """Number of judged samples."""
    rmse: float
    """Root mean square of estimated torque less that of the rigid-body model."""
    rmse_error: float | None
    """Standard error of that root, from blocks of time."""
    mean: float
    """Mean of estimated torque less that of the model."""
    mean_error: float | None
    """Standard error of that mean, from blocks of time."""
    largest: float
    """Largest magnitude of estimated torque less that of the model."""
    logged_samples: int | None
    """Number of samples with a logged torque; null where none can be compared."""
    logged_rmse: float | None
    """Root mean square of estimated torque less the logged one."""
    logged_rmse_error: float | None
    """Standard error of that root, from blocks of time."""


class BestRow(BaseModel):
    """The best candidate of a sensor in one offset mode."""

    sensor: str
    """Sensor."""
    offset: Offset
    """Offset mode."""
    by_magnitude: str
    """Candidate with the smallest mean norm of the force."""
    by_axis: list[str]
    """Candidate with the smallest mean absolute value, per component."""


class ValidateResult(BaseModel):
    """What `forcetorque validate` found."""

    model_config = ConfigDict(populate_by_name=True)

    schema_name: Literal["forcetorque/validate/1"] = Field(default="forcetorque/validate/1", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment."""
    other_sensors: Literal["model", "measured"]
    """What the other sensors of the sub-model were taken to read."""
    contact_forces: list[ContactForceRow]
    """One per sensor, candidate and offset."""
    best: list[BestRow]
    """One per sensor and offset."""
    joint_torques: list[JointTorqueRow]
    """One per sensor, candidate, offset and joint that depends on the sensor."""
    left_out: list[str]
    """Torques that the log does not allow to estimate, and what gaps and short intervals leave out, in words."""


def contact_force_row(verdict: ContactForceVerdict) -> ContactForceRow:
    """Give a verdict on contact forces as a row.

    Args:
        verdict: The verdict.

    Returns:
        The row.
    """
    errors = verdict.errors
    return ContactForceRow(
        sensor=verdict.sensor,
        serial=verdict.serial,
        sub_model=verdict.sub_model,
        candidate=verdict.candidate,
        offset=verdict.offset,
        offset_source=verdict.offset_source,
        prior=verdict.prior,
        samples=errors.count,
        force_mean_N=errors.force_mean,
        force_mean_error_N=finite_or_none(errors.force_mean_error),
        moment_mean_Nm=errors.moment_mean,
        mean_absolute=errors.mean_absolute.tolist(),
    )


def joint_torque_row(verdict: JointTorqueVerdict) -> JointTorqueRow:
    """Give a verdict on the torque of a joint as a row.

    Args:
        verdict: The verdict.

    Returns:
        The row.
    """
    errors, logged = verdict.errors, verdict.from_logged
    return JointTorqueRow(
        sensor=verdict.sensor,
        serial=verdict.serial,
        candidate=verdict.candidate,
        offset=verdict.offset,
        offset_source=verdict.offset_source,
        prior=verdict.prior,
        joint=verdict.joint,
        unit=verdict.unit,
        samples=errors.count,
        rmse=errors.rmse,
        rmse_error=finite_or_none(errors.rmse_error),
        mean=errors.mean,
        mean_error=finite_or_none(errors.mean_error),
        largest=errors.largest,
        logged_samples=None if logged is None else logged.count,
        logged_rmse=None if logged is None else logged.rmse,
        logged_rmse_error=None if logged is None else finite_or_none(logged.rmse_error),
    )


def best_rows(verdicts: Sequence[ContactForceVerdict]) -> list[BestRow]:
    """Find the best candidates.

    Args:
        verdicts: Verdicts on contact forces.

    Returns:
        One row per sensor and offset mode.
    """
    groups: dict[tuple[str, str], list[ContactForceVerdict]] = {}
    for verdict in verdicts:
        groups.setdefault((verdict.sensor, verdict.offset.value), []).append(verdict)
    return [
        BestRow(
            sensor=sensor,
            offset=group[0].offset,
            by_magnitude=min(group, key=lambda one: one.errors.force_mean).candidate,
            by_axis=[
                min(group, key=lambda one, k=axis: float(one.errors.mean_absolute[k])).candidate  # type: ignore[misc]
                for axis in range(6)
            ],
        )
        for (sensor, _), group in groups.items()
    ]
