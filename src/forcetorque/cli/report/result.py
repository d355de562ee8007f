# SPDX-License-Identifier: BSD-3-Clause
"""The result of `forcetorque report`: every number of the document."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from forcetorque.calibration import Calibration
from forcetorque.cli.accept_result import CriterionRow, MeasuredRow
from forcetorque.cli.evaluate_result import VerdictRow
from forcetorque.cli.inspect_result import FindingRow
from forcetorque.cli.sphere_result import SphereRow
from forcetorque.cli.validate_result import BestRow, ContactForceRow, JointTorqueRow
from forcetorque.evaluation import Offset


class VerdictLine(BaseModel):
    """A sentence of the verdict."""

    tone: Literal["good", "caution", "bad", "unknown", "note"]
    """How good it is."""
    text: str
    """The sentence."""


class IndependenceRow(BaseModel):
    """How many independent samples the errors of a candidate are worth; neighbours repeat each other."""

    candidate: str
    """The calibration file, or the prior."""
    samples: int
    """Number of judged samples."""
    independent: list[float | None]
    """Effective number of independent samples per component; none where the error does not change."""


class ComparisonRow(BaseModel):
    """A calibration against its prior on the same samples: norms of the errors, and what they differ by."""

    candidate: str
    """The calibration file."""
    prior: str
    """Its prior, as the evaluation names it."""
    offset: Offset
    """Offset of the fitted data, or re-estimated on the judged samples."""
    quantity: Literal["force", "moment"]
    """What the errors are of."""
    unit: Literal["N", "N m"]
    """Unit of the errors."""
    samples: int
    """Number of judged samples."""
    independent: float | None
    """How many independent ones their differences are worth; none where they do not change."""
    mean: float
    """Mean norm of the error with the calibration."""
    prior_mean: float
    """The same with its prior."""
    gain: float
    """Mean of the differences, prior less calibration."""
    gain_low: float | None
    """Lower end of its 95 % interval; none where the samples are too few to tell."""
    gain_high: float | None
    """Upper end."""
    constant: float
    """Norm of the mean error vector: the part that another offset would take away."""


class SensorReport(BaseModel):
    """Everything about one sensor; what could not be judged is empty and stands in `not_judged`."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    verdict: list[VerdictLine]
    """What the rest comes to."""
    evaluation: list[VerdictRow]
    """Errors on data that was not fitted."""
    comparisons: list[ComparisonRow]
    """Calibrations against their priors."""
    independence: list[IndependenceRow]
    """What these errors are worth."""
    contact_forces: list[ContactForceRow]
    """Contact wrenches where nothing touches."""
    best: list[BestRow]
    """Best candidates by these."""
    joint_torques: list[JointTorqueRow]
    """Errors of the joint torques that are estimated from the sensor."""
    spheres: list[SphereRow]
    """Sphere analyses."""
    static: list[MeasuredRow]
    """Static checks of every calibration, or of the prior."""
    criteria: list[CriterionRow]
    """Criteria of the acceptance file."""
    calibrations: dict[str, Calibration]
    """Calibrations of the sensor, with their uncertainty, excitation and choice of lambda, by file."""
    warnings: list[str]
    """What makes a verdict flatter or doubtful."""
    not_judged: dict[str, str]
    """Reason by what could not be judged."""


class StreamRow(BaseModel):
    """A stream of the recording."""

    stream: str
    """Its name."""
    samples: int
    """Number of its samples."""
    rate_hz: float | None
    """Median rate; none for fewer than two samples."""
    quantities: list[str]
    """Its quantities."""


class IntervalRow(BaseModel):
    """An interval of the recording."""

    label: str
    """Its label."""
    use: str
    """What it is for."""
    start_s: float
    """Start; s from the earliest stamp."""
    end_s: float
    """End; s from the earliest stamp."""
    support: str | None
    """Frame that touches the world."""


class ExperimentReport(BaseModel):
    """Everything about one experiment."""

    experiment: str
    """Its name."""
    file: str
    """Its file."""
    robot: str
    """Name of the robot."""
    duration_s: float
    """Time from the earliest to the latest stamp."""
    streams: list[StreamRow]
    """Streams of the recording."""
    intervals: list[IntervalRow]
    """Its intervals."""
    findings: list[FindingRow]
    """What is wrong with the recording."""
    sensors: list[SensorReport]
    """Its sensors."""
    inputs_sha256: dict[str, str]
    """SHA-256 of every input file."""


class ReportResult(BaseModel):
    """What `forcetorque report` wrote."""

    model_config = ConfigDict(populate_by_name=True)

    schema_name: Literal["forcetorque/report/1"] = Field(default="forcetorque/report/1", alias="schema")
    """Form of the result."""
    title: str
    """Title of the document."""
    created: str
    """When it was made, ISO 8601 with time zone."""
    code_version: str
    """Version of forcetorque."""
    experiments: list[ExperimentReport]
    """One per experiment file."""
    results: dict[str, dict[str, Any]]
    """Results of other commands by file, as they were given."""
