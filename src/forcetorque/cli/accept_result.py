# SPDX-License-Identifier: BSD-3-Clause
"""The result of `forcetorque accept`: criteria, and everything that was measured without one."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from forcetorque.analysis import Acceptance, StaticChecks
from forcetorque.cli.output import finite_or_none


class CriterionRow(BaseModel):
    """One number and its limit."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    candidate: str
    """The calibration file, or the prior."""
    criterion: str
    """Table, key and, where there are six limits, component of the acceptance file, such as `evaluate.rmse.fx`."""
    measured: float | None
    """What was measured; None if it is infinite."""
    bound: Literal["at most", "at least"]
    """Side of the limit on which it is accepted; on the limit it is."""
    limit: float
    """The limit."""
    unit: str
    """Unit of both; empty for a plain number."""
    count: int | None
    """Number of samples, sensors or intervals that it is made from; None for what needs none."""
    note: str
    """Where the worst was found: interval, component or feature."""
    passed: bool
    """Whether it is accepted."""


class FeatureRow(BaseModel):
    """Where one number of the matrix stands among those of other sensors."""

    feature: str
    """`condition`, or `row_norm`, `coupling` or `alignment` of a component."""
    value: float | None
    """Value of the matrix; None if it is infinite."""
    median: float | None
    """Median of the others; None if it is infinite."""
    quantile: float
    """Share of the others below it, those that are equal counted half."""
    robust_z: float | None
    """Distance from the median over 1.4826 times the median absolute deviation; None without scatter."""


class IntervalRow(BaseModel):
    """What an interval lacks of a sensor's readings."""

    label: str
    """Label of the interval."""
    samples: int
    """Number of its samples."""
    saturated_share: float
    """Share of samples that were held or at the limit."""
    missing_share: float
    """Share of samples without a reading."""
    lost_share: float | None
    """Share of messages lost by their sequence numbers; None without these."""


class OffsetRow(BaseModel):
    """Offset with which the matrix fits an interval best."""

    label: str
    """Label of the interval."""
    samples: int
    """Number of its samples that the model covers."""
    offset: list[float]
    """Offset per component; N, N m."""
    temperature_degC: float | None
    """Mean temperature; None if the sensor has no such variable."""


class MeasuredRow(BaseModel):
    """Static checks of one sensor; None is what could not be measured, see `not_measured`."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    candidate: str
    """The calibration file, or the prior."""
    limit_counts: float
    """Largest magnitude of a reading; counts."""
    condition: float | None
    """Condition of the matrix with its rows over the stated full scale; None also if it is infinite."""
    resolution_worst: list[float] | None
    """Change of a component when all channels are off by one count with the worst signs; N, N m."""
    resolution_rms: list[float] | None
    """The same when they err independently with one count each; N, N m."""
    full_scale_stated: list[float] | None
    """Full scale with all channels at their limit, which no load reaches; N, N m."""
    full_scale_positive: list[float] | None
    """Largest load along each axis before a channel saturates; N, N m."""
    full_scale_negative: list[float] | None
    """Lowest load along each axis before a channel saturates; N, N m."""
    population_count: int | None
    """Number of other sensors that the matrix is compared with."""
    population: list[FeatureRow]
    """One per feature of the matrix."""
    offsets: list[OffsetRow]
    """One per interval."""
    offset_change: list[float] | None
    """Largest less smallest offset; N, N m."""
    offset_force_change_N: float | None
    """Largest norm of the difference of two offsets, force part."""
    offset_per_degC: list[float] | None
    """Slope of the offset against temperature; N/degC, N m/degC."""
    recording: list[IntervalRow]
    """One per interval."""
    not_measured: dict[str, str]
    """Reason by what is missing: matrix, full_scale, population, offset."""


class AcceptResult(BaseModel):
    """What `forcetorque accept` found."""

    model_config = ConfigDict(populate_by_name=True)

    schema_name: Literal["forcetorque/accept/1"] = Field(default="forcetorque/accept/1", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment."""
    specification: str
    """Name of the specification."""
    accepted: bool
    """Whether every criterion holds for every sensor."""
    criteria: list[CriterionRow]
    """One per sensor and limit."""
    measured: list[MeasuredRow]
    """One per sensor, with or without limits."""


def criterion_rows(acceptance: Acceptance) -> list[CriterionRow]:
    """Give the criteria of one sensor as rows.

    Args:
        acceptance: What was measured and judged.

    Returns:
        One row per criterion.
    """
    checks = acceptance.checks
    return [
        CriterionRow(
            sensor=checks.sensor,
            serial=checks.serial,
            candidate=checks.candidate,
            criterion=each.name,
            measured=finite_or_none(each.measured),
            bound=each.bound.value,
            limit=each.limit,
            unit=each.unit,
            count=each.count,
            note=each.note,
            passed=each.passed,
        )
        for each in acceptance.criteria
    ]


def measured_row(checks: StaticChecks) -> MeasuredRow:
    """Give the static checks of one sensor as a row.

    Args:
        checks: The checks.

    Returns:
        The row.
    """
    matrix, offset, population = checks.matrix, checks.offset, checks.population
    full_scale = None if matrix is None else matrix.full_scale
    reasons = dict(checks.not_measured)
    if matrix is not None and full_scale is None:
        reasons["full_scale"] = matrix.no_full_scale
    return MeasuredRow(
        sensor=checks.sensor,
        serial=checks.serial,
        candidate=checks.candidate,
        limit_counts=checks.limit_counts,
        condition=None if matrix is None else finite_or_none(matrix.condition),
        resolution_worst=None if matrix is None else matrix.resolution.worst.tolist(),
        resolution_rms=None if matrix is None else matrix.resolution.rms.tolist(),
        full_scale_stated=None if matrix is None else matrix.stated_full_scale.tolist(),
        full_scale_positive=None if full_scale is None else full_scale.positive.tolist(),
        full_scale_negative=None if full_scale is None else full_scale.negative.tolist(),
        population_count=None if population is None else population.count,
        population=[
            FeatureRow(
                feature=each.feature,
                value=finite_or_none(each.value),
                median=finite_or_none(each.median),
                quantile=each.quantile,
                robust_z=finite_or_none(each.robust_z),
            )
            for each in (population.features if population else ())
        ],
        offsets=[
            OffsetRow(
                label=each.label,
                samples=each.samples,
                offset=each.offset.tolist(),
                temperature_degC=each.temperature,
            )
            for each in checks.offsets
        ],
        offset_change=None if offset is None else offset.change.tolist(),
        offset_force_change_N=None if offset is None else offset.force_change,
        offset_per_degC=None if offset is None or offset.per_degree is None else offset.per_degree.tolist(),
        recording=[
            IntervalRow(
                label=each.label,
                samples=each.samples,
                saturated_share=each.saturated_share,
                missing_share=each.missing_share,
                lost_share=each.lost_share,
            )
            for each in checks.intervals
        ],
        not_measured=reasons,
    )
