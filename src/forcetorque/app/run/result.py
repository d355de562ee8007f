# SPDX-License-Identifier: BSD-3-Clause
"""What `run` gives: its stages, where it stopped and why, verdicts, and the files that were written."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from enum import IntEnum
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field

from forcetorque.evaluation.load_cases.verdict import LoadCaseVerdict
from forcetorque.inspection.draft.questions import OPEN_QUESTIONS
from forcetorque.results.answer import Answer, Concern
from forcetorque.results.result import Result
from forcetorque.results.table import Row, Shown, Table, table_of

StageName = Literal["init", "inspect", "check", "calibrate", "payload", "workbench", "evaluate", "report", "export"]
_NAMED = 3
"""Files that the answer names; of more it has the number."""
Outcome = Literal["done", "stopped", "overridden", "skipped"]


class ExitCode(IntEnum):
    """Exit codes of `forcetorque run`, for unattended use; 2 is an error, as of every command."""

    USABLE = 0
    """Everything may be used."""
    NOT_USABLE = 1
    """It went to the end, and something may not be used, or not yet."""
    STOPPED = 3
    """A stage stopped it: what follows would mislead."""
    QUESTIONS = OPEN_QUESTIONS
    """The experiment file of a log has questions, or proposals, that only a person can answer."""


class Stage(Row):
    """One stage."""

    name: Annotated[StageName, Shown("stage")]
    """What was done."""
    outcome: Annotated[Outcome, Shown("outcome")]
    """How it ended: `stopped` where the rest would mislead, `overridden` where a person went on in spite of that."""
    seconds: Annotated[float, Shown("time", "s", digits=1)]
    """Time that it took."""
    text: Annotated[str, Shown("result")]
    """What came out."""
    reasons: tuple[str, ...] = ()
    """Why the rest would mislead, one of each sensor, file or fault; empty where the stage went well."""
    remedy: str | None = None
    """What to change; None where nothing is to be changed."""
    lines: tuple[str, ...] = ()
    """Lines of the file that the remedy is about."""
    command: str | None = None
    """Command to type next, without the name of the program; None where there is none."""


class WholeRun(Result):
    """The whole way of one experiment, or of several recordings of the same sensors."""

    schema_name: Literal["forcetorque/run/2"] = Field(default="forcetorque/run/2", alias="schema")
    """Form of the result."""
    experiment: str
    """The files."""
    stages: tuple[Stage, ...]
    """Stages in their order."""
    questions: tuple[str, ...] = ()
    """What only a person can answer, with line and key in the experiment file."""
    load_cases: tuple[LoadCaseVerdict, ...] = ()
    """Verdicts on the calibrations, one per load case."""
    files: tuple[str, ...] = ()
    """Files that were written."""
    override: str | None = None
    """Reason that a person gave to go on where a stage would have stopped."""
    details_of: tuple[Result, ...] = Field(default=(), exclude=True, repr=False)
    """Results of the stages, for people."""
    final: tuple[Answer, ...] = Field(default=(), exclude=True, repr=False)
    """Answers of the last stage that has any."""

    @property
    def stopped(self) -> Stage | None:
        """The stage that stopped it; None where it went to the end."""
        return next((stage for stage in self.stages if stage.outcome == "stopped"), None)

    @property
    def exit_code(self) -> ExitCode:
        """How an unattended run learns what came out."""
        if (stage := self.stopped) is not None:
            return ExitCode.QUESTIONS if stage.name == "init" else ExitCode.STOPPED
        usable = all(use.decision == "use" for use in self.load_cases) and all(
            answer.concern is Concern.NONE for answer in self.final
        )
        return ExitCode.USABLE if usable else ExitCode.NOT_USABLE

    @property
    def passed(self) -> bool:
        """Whether it went to the end and everything may be used."""
        return self.exit_code is ExitCode.USABLE

    @property
    def details_options(self) -> str:
        """With `--force` where files were written, which are not replaced without it."""
        return "--force --details" if self.files else "--details"

    def answers(self) -> Iterator[Answer]:
        """Say where it stopped and what to change; else what came out of the last stage, and the files.

        Yields:
            One per sensor, or one on the stage that stopped.
        """
        if (stage := self.stopped) is not None:
            yield Answer(
                subject=self.experiment,
                verdict=f"STOPPED AT {stage.name.upper()}",
                why=stage.reasons or (stage.text,),
                step=stage.remedy or "",
                lines=stage.lines,
                command=stage.command or "",
                written=self.files,
                concern=Concern.BAD,
            )
            return
        folder = Path(self.files[0]).parent if self.files else None
        names = [Path(file).name for file in sorted(self.files, key=lambda file: not file.endswith(".html"))]
        more = f" and {len(names) - _NAMED} more" if len(names) > _NAMED else ""
        written = (f"{folder}: {', '.join(names[:_NAMED])}{more}",) if folder is not None else ()
        for answer in self.final:
            yield replace(answer, written=written)

    def blocks(self) -> Iterator[Table | str]:
        """Give the stages, and the details of each.

        Yields:
            Tables and sentences.
        """
        yield table_of(self.stages, f"{self.experiment}: stages")
        yield from self.questions
        if self.override is not None:
            yield f"override: {self.override}"
        for result in self.details_of:
            yield from result.blocks()
