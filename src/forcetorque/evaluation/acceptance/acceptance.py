# SPDX-License-Identifier: BSD-3-Clause
"""Acceptance: what was measured of sensors against the limits of an acceptance file."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import ClassVar, Literal, Self

from pydantic import Field, model_validator

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ForceTorqueError
from forcetorque.evaluation.acceptance.acceptance_file import AcceptanceFile
from forcetorque.evaluation.acceptance.criteria import Bound, Criterion, RecordingCriterion, Subject, criteria_of
from forcetorque.evaluation.acceptance.static_checks import RecordingChecks, StaticChecks, check
from forcetorque.evaluation.load_cases.verdict import LoadCaseVerdict, use_verdicts
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.campaign import Campaign, Runs
from forcetorque.experiment.recording_notes import with_recording_notes
from forcetorque.experiment.seen_and_outside_samples import (
    SamplesOutside,
    doubts_about_choice,
    readings_outside,
    sentences,
)
from forcetorque.recording.recording import Use
from forcetorque.results.number_text import finite_or_none
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Table, with_first_column

_OF_ERRORS = {"evaluate", "improvement", "validate"}
"""Tables of an acceptance file that limit errors, so that it matters whether a calibration may be used."""


class Acceptance(DrawnResult):
    """Which criteria sensors meet, and everything that was measured of them without one."""

    drawn_by: ClassVar[str] = "forcetorque.evaluation.figures.acceptance_and_contact_forces:acceptance_figure"

    answered_by: ClassVar[str | None] = "forcetorque.evaluation.acceptance.answers:acceptance_answers"

    of_several: ClassVar[tuple[str, ...]] = ("recordings", "recordings_measured")

    interval_uses = ()

    schema_name: Literal["forcetorque/accept/2"] = Field(default="forcetorque/accept/2", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment; of several recordings their names, apart by semicolons."""
    specification: str
    """Name of the specification."""
    accepted: bool = False
    """Whether every criterion holds for every sensor, and none is undecided; computed, a given value is ignored."""
    undecided: bool = False
    """Whether every criterion holds, but `evaluate` has not enough data on a sensor whose errors are limited."""
    criteria: tuple[Criterion, ...]
    """One per sensor and limit: of errors of all recordings pooled, or of the worst recording."""
    recordings: tuple[RecordingCriterion, ...] = ()
    """The same of every recording by itself, which decides nothing; none where there is one recording."""
    measured: tuple[StaticChecks, ...]
    """One per sensor, with or without limits; of several recordings they stand in `recordings_measured`."""
    recordings_measured: tuple[RecordingChecks, ...] = ()
    """One per sensor and recording; none where there is one recording."""
    validity: tuple[SamplesOutside, ...] = ()
    """One per calibration whose errors were judged: how far the readings lie outside what it was fitted on."""
    load_cases: tuple[LoadCaseVerdict, ...] = ()
    """One per calibration and load case: whether it may be used, as `evaluate` says."""

    @model_validator(mode="after")
    def _accept_what_passes(self) -> Self:
        # a field, not a property, because a property would stand at the end of the JSON
        hold = all(criterion.passed for criterion in self.criteria)
        unsure = any(self.unsure(criterion.sensor) for criterion in self.criteria)
        object.__setattr__(self, "accepted", hold and not unsure)
        object.__setattr__(self, "undecided", hold and unsure)
        return self

    def unsure(self, sensor: str) -> tuple[LoadCaseVerdict, ...]:
        """Give the verdicts of `evaluate` that leave a sensor undecided.

        Args:
            sensor: Name of the sensor.

        Returns:
            Those without enough data; none where load cases of the file are criteria, or no error is limited.
        """
        tables = {row.criterion.partition(".")[0] for row in self.criteria if row.sensor == sensor}
        if "load_case" in tables or not tables & _OF_ERRORS:
            return ()
        uses = (use for use in self.load_cases if use.sensor == sensor)
        return tuple(use for use in uses if use.decision == "not enough data")

    @property
    def passed(self) -> bool:
        """Whether it is accepted."""
        return self.accepted

    @property
    def exit_code(self) -> int:
        """0 where it is accepted, 1 where a criterion fails, 3 where it is undecided."""
        return 3 if self.undecided else super().exit_code

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
            apart = [criterion for criterion in self.recordings if criterion.sensor == sensor]
            count = len({criterion.recording for criterion in apart})
            where = f"{count} recordings" if apart else self.experiment
            yield criteria_table(criteria, f"{where}: {first.sensor} ({first.serial}), {first.calibration}")
            if apart:
                table = criteria_table(apart, f"{first.sensor} ({first.serial}), each recording by itself")
                yield with_first_column(table, "recording", [criterion.recording for criterion in apart])
        passed = sum(criterion.passed for criterion in self.criteria)
        verdict = "accepted" if self.accepted else "undecided" if self.undecided else "NOT accepted"
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


@with_recording_notes
def accept(
    runs: Runs,
    spec: AcceptanceFile,
    calibration: tuple[str, Calibration] | None = None,
    *,
    others: Mapping[str, Calibration] | None = None,
    population: Mapping[str, FloatArray] | None = None,
) -> Acceptance:
    """Compare a sensor and its calibration, or its prior, with every limit of an acceptance file.

    Args:
        runs: The sensor in one recording, or in several: their errors are pooled; of what is measured in each by itself
            (recording, offset, matrix, population) the worst counts.
        spec: Content of the acceptance file.
        calibration: Name and calibration; the prior is evaluated if left out.
        others: Calibrations of the other sensors by name, for `[validate]` with other sensors as measured.
        population: Matrices of other sensors by serial number.

    Returns:
        Criteria in the order of `AcceptanceFile`, the verdicts of `evaluate`, and static checks. Where the file
        states no load case, a sensor that `evaluate` forbids to use ("do not use") is not accepted, and one whose
        errors are limited, but whose data are not enough for its verdict, is undecided.

    Raises:
        ForceTorqueError: If a limit is stated for what cannot be measured; the message names its table.
    """
    campaign = Campaign.of(runs)
    several = len(campaign.runs) > 1
    uses, without = _uses(campaign, spec, calibration)
    subjects = []
    for run in campaign.runs:
        with campaign.stated(run):
            checks = check(run, calibration, population=population)
        subjects.append(
            Subject(
                campaign=campaign, run=run, calibration=calibration, others=others or {}, checks=checks, load_cases=uses
            )
        )
    judges_errors = spec.evaluate is not None or spec.improvement is not None or spec.validate_ is not None
    judged = campaign.runs_with(Use.VALIDATION) if calibration and judges_errors else ()
    # what cannot be evaluated says first which limit asks for it
    criteria = tuple(criteria_of(subjects, spec))
    validity = readings_outside(campaign, dict([calibration])) if calibration and judged else ()
    return Acceptance(
        experiment="; ".join(campaign.recordings),
        specification=spec.name,
        criteria=criteria,
        recordings=tuple(row for subject in subjects for row in _apart(subject, spec)) if several else (),
        measured=() if several else (subjects[0].checks,),
        recordings_measured=tuple(
            RecordingChecks(recording_name=campaign.recording(subject.run), **dict(subject.checks))
            for subject in (subjects if several else ())
        ),
        validity=validity,
        load_cases=uses,
        warnings=(
            *without,
            *sentences(validity),
            *(words for run in judged if calibration for words in doubts_about_choice(run, *calibration)),
        ),
    )


def _uses(
    campaign: Campaign, spec: AcceptanceFile, calibration: tuple[str, Calibration] | None
) -> tuple[tuple[LoadCaseVerdict, ...], tuple[str, ...]]:
    """Give the verdicts of `evaluate`; where it has none and no limit needs one, a warning that says why."""
    if calibration is None:
        return (), ()
    try:
        return use_verdicts(campaign, dict([calibration]), spec.load_case), ()
    except ForceTorqueError as error:
        if spec.load_case:
            raise type(error)(f"sensor {campaign.sensor.name!r}: [load_case] cannot be evaluated: {error}") from error
        return (), (f"sensor {campaign.sensor.name!r}: no verdict on its use: {error}",)


def _apart(subject: Subject, spec: AcceptanceFile) -> Iterator[RecordingCriterion]:
    """What one recording shows by itself, without what only the calibration says."""
    absent: dict[str, object] = {"uncertainty": None, "excitation": None, "load_case": ()}
    if not subject.run.has(Use.VALIDATION):
        absent |= {"evaluate": None, "improvement": None, "validate_": None}
    alone = replace(subject, campaign=Campaign(subject.run), load_cases=())
    for criterion in criteria_of([alone], spec.model_copy(update=absent)):
        stated = criterion.model_dump(exclude={"passed"})
        yield RecordingCriterion(recording=subject.campaign.recording(subject.run), **stated)
