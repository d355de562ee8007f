# SPDX-License-Identifier: BSD-3-Clause
"""Acceptance: what was measured of sensors against the limits of an acceptance file."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Literal, Self

from pydantic import Field, model_validator

from forcetorque.analysis.acceptance_file import AcceptanceFile
from forcetorque.analysis.criteria import Subject, criteria_of
from forcetorque.analysis.criterion import Bound, Criterion
from forcetorque.analysis.evaluate import doubts_about_choice
from forcetorque.analysis.sensor_run import SensorRun
from forcetorque.analysis.static_checks import StaticChecks, check
from forcetorque.arrays import FloatArray
from forcetorque.calibration import Calibration
from forcetorque.result import Result, Table, finite_or_none


class Acceptance(Result):
    """Which criteria sensors meet, and everything that was measured of them without one."""

    schema_name: Literal["forcetorque/accept/1"] = Field(default="forcetorque/accept/1", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment."""
    specification: str
    """Name of the specification."""
    accepted: bool = False
    """Whether every criterion holds for every sensor; made from the criteria, whatever is given."""
    criteria: tuple[Criterion, ...]
    """One per sensor and limit."""
    measured: tuple[StaticChecks, ...]
    """One per sensor, with or without limits."""

    @model_validator(mode="after")
    def _accept_what_passes(self) -> Self:
        # a field, not a property, because a property would stand at the end of the JSON
        object.__setattr__(self, "accepted", all(criterion.passed for criterion in self.criteria))
        return self

    @classmethod
    def together(cls, results: Iterable[Self]) -> Self:
        """Put the answers for several sensors of one experiment together.

        Args:
            results: Answers by one specification, at least one.

        Returns:
            One with the criteria of all, accepted if every one of them holds.
        """
        return cls.model_validate(dict(super().together(results)))

    def blocks(self) -> Iterator[Table | str]:
        """Give a table per sensor, and the verdict on all.

        Yields:
            Tables and a sentence.
        """
        for sensor in dict.fromkeys(criterion.sensor for criterion in self.criteria):
            criteria = [criterion for criterion in self.criteria if criterion.sensor == sensor]
            first = criteria[0]
            yield criteria_table(criteria, f"{self.experiment}: {first.sensor} ({first.serial}), {first.candidate}")
        passed = sum(criterion.passed for criterion in self.criteria)
        verdict = "accepted" if self.accepted else "NOT accepted"
        yield f"{verdict} by {self.specification!r}: {passed} of {len(self.criteria)} criteria hold"


def criteria_table(criteria: Sequence[Criterion], caption: str) -> Table:
    """Put criteria of one candidate into a table.

    Args:
        criteria: The criteria.
        caption: What they are of.

    Returns:
        A line per criterion.
    """
    return Table(
        caption=caption,
        headings=("criterion", "measured", "bound", "limit", "unit", "n", "verdict", "where"),
        rows=tuple(_cells(criterion) for criterion in criteria),
    )


def _cells(criterion: Criterion) -> tuple[str, ...]:
    return (
        criterion.criterion,
        "infinite" if finite_or_none(criterion.measured) is None else f"{criterion.measured:.4g}",
        "<=" if criterion.bound is Bound.AT_MOST else ">=",
        f"{criterion.limit:.4g}",
        criterion.unit,
        "" if criterion.count is None else str(criterion.count),
        "pass" if criterion.passed else "FAIL",
        criterion.note,
    )


def accept(
    run: SensorRun,
    spec: AcceptanceFile,
    calibration: tuple[str, Calibration] | None = None,
    *,
    others: Mapping[str, Calibration] | None = None,
    population: Mapping[str, FloatArray] | None = None,
) -> Acceptance:
    """Judge a sensor and its calibration, or its prior, by every limit of an acceptance file.

    Args:
        run: The sensor.
        spec: Content of the acceptance file.
        calibration: Name and calibration; the prior is judged if left out.
        others: Calibrations of the other sensors by name, for `[validate]` with other sensors as measured.
        population: Matrices of other sensors by serial number.

    Returns:
        Criteria in the order of `AcceptanceFile`, and static checks.

    Raises:
        ForceTorqueError: If a limit is stated for what cannot be measured; the message names its table.
    """
    checks = check(run, calibration, population=population)
    subject = Subject(run=run, calibration=calibration, others=others or {}, checks=checks)
    judges_errors = spec.evaluate is not None or spec.improvement is not None or spec.validate_ is not None
    return Acceptance(
        experiment=run.experiment.name,
        specification=spec.name,
        criteria=tuple(criteria_of(subject, spec)),
        measured=(checks,),
        warnings=tuple(doubts_about_choice(run, *calibration)) if calibration and judges_errors else (),
    )
