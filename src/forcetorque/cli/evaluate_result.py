# SPDX-License-Identifier: BSD-3-Clause
"""The result of `forcetorque evaluate`."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from forcetorque.analysis import Verdict
from forcetorque.cli.output import finite_or_none


class VerdictRow(BaseModel):
    """Errors of one candidate with one offset; per axis in the order fx fy fz (N) tx ty tz (N m)."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    candidate: str
    """The calibration file, or its prior: `prior`, and `prior of FILE` among several files."""
    offset: Literal["fitted", "re-estimated"]
    """Offset of the fitted data, or re-estimated on the judged samples."""
    offset_source: str
    """Where that offset comes from, in words."""
    prior: str | None
    """Candidate that is the prior of a calibration file; null for a prior, and where the file has none."""
    samples: int
    """Number of judged samples."""
    rmse: list[float]
    """Root mean square error per component; N, N m."""
    bias: list[float]
    """Mean error per component; N, N m."""
    largest: list[float]
    """Largest absolute error per component; N, N m."""
    force_error_mean_N: float
    """Mean norm of the force error."""
    force_error_standard_error_N: float | None
    """Standard error of that mean, from contiguous blocks; None for one sample."""
    force_error_largest_N: float
    """Largest norm of the force error."""
    moment_error_mean_Nm: float
    """Mean norm of the moment error."""
    moment_error_standard_error_Nm: float | None
    """Standard error of that mean, from contiguous blocks; None for one sample."""
    moment_error_largest_Nm: float
    """Largest norm of the moment error."""


class EvaluateResult(BaseModel):
    """What `forcetorque evaluate` found."""

    model_config = ConfigDict(populate_by_name=True)

    schema_name: Literal["forcetorque/evaluate/1"] = Field(default="forcetorque/evaluate/1", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment."""
    verdicts: list[VerdictRow]
    """One per sensor, candidate and offset."""


def verdict_row(verdict: Verdict) -> VerdictRow:
    """Give a verdict as a row.

    Args:
        verdict: The verdict.

    Returns:
        The row.
    """
    errors = verdict.errors
    return VerdictRow(
        sensor=verdict.sensor,
        serial=verdict.serial,
        candidate=verdict.candidate,
        offset="fitted" if verdict.offset == "fitted" else "re-estimated",
        offset_source=verdict.offset_source,
        prior=verdict.prior,
        samples=errors.count,
        rmse=errors.rmse.tolist(),
        bias=errors.bias.tolist(),
        largest=errors.largest.tolist(),
        force_error_mean_N=errors.force_mean,
        force_error_standard_error_N=finite_or_none(errors.force_mean_error),
        force_error_largest_N=errors.force_largest,
        moment_error_mean_Nm=errors.moment_mean,
        moment_error_standard_error_Nm=finite_or_none(errors.moment_mean_error),
        moment_error_largest_Nm=errors.moment_largest,
    )
