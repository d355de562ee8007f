# SPDX-License-Identifier: BSD-3-Clause
"""The report on the sensors of experiments: every number of it, and the document that shows them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field

from forcetorque.base.errors import ForceTorqueError
from forcetorque.base.output_file import refuse_output, refuse_unwritable, write_bytes_atomically
from forcetorque.evaluation.answers import CONCERN, next_lines, next_step
from forcetorque.evaluation.load_cases.verdict import LoadCaseVerdict, Tone
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.named_files import stated_in
from forcetorque.experiment.recording_notes import added_to
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.report.decision_page import all_sensors_page, decision_page
from forcetorque.report.experiment_assessment import ExperimentAssessment, assess_experiment
from forcetorque.report.pooled_verdicts import NextSteps, Undecided, decide_uses, next_steps, sensor_key, sensor_keys
from forcetorque.report.report_sections import report_document
from forcetorque.report.sensor_assessment import Demands
from forcetorque.results.answer import Answer, Concern
from forcetorque.results.document.content import Document, Section, html_bytes
from forcetorque.results.document.pdf import pdf_bytes
from forcetorque.results.figure_style import new_figure
from forcetorque.results.result import Result
from forcetorque.results.table import Row, Shown, Table, short_names, table_of

_WRITERS: dict[str, Callable[[Document], bytes]] = {".html": html_bytes, ".pdf": pdf_bytes}


class _Line(Row):
    """A decision in one line of a table."""

    sensor: str
    serial: str
    tone: Annotated[Tone, Shown("")]
    text: Annotated[str, Shown("may it be used?")]


class Report(Result):
    """Everything about the sensors of experiments, what to do first."""

    schema_name: Literal["forcetorque/report/2"] = Field(default="forcetorque/report/2", alias="schema")
    """Form of the result."""
    title: str
    """Title of the document."""
    created: str
    """When it was made, ISO 8601 with time zone."""
    code_version: str
    """Version of forcetorque."""
    load_cases: tuple[LoadCaseVerdict, ...] = ()
    """Whether every calibration may be used, by load case; pooled over the recordings that it has not seen."""
    undecided: tuple[Undecided, ...] = ()
    """Calibrations on which there is no such verdict, and sensors without a calibration."""
    next_steps: tuple[NextSteps, ...] = ()
    """What to do next about every sensor."""
    experiments: tuple[ExperimentAssessment, ...]
    """One per experiment file."""
    results: dict[str, dict[str, Any]]
    """Results of other commands by file, as they were given."""
    files: tuple[str, ...] = Field(default=(), exclude=True, repr=False)
    """Files that it is written to."""
    viewers: tuple[Section, ...] = Field(default=(), exclude=True, repr=False)
    """Sections of the document with a viewer."""

    def answers(self) -> Iterator[Answer]:
        """Say of every sensor whether its calibrations may be used, and what to do next.

        Yields:
            One per verdict.
        """
        unjudged = [row.calibration for row in self.undecided if row.calibration is not None]
        names = short_names([*(row.calibration for row in self.load_cases), *unjudged])
        steps = {(row.sensor, row.serial): next(iter(row.steps), "") for row in self.next_steps}
        for use in self.load_cases:
            step, command = next_step(use)
            yield Answer(
                subject=f"{use.sensor} ({use.serial}), {names[use.calibration]}, {use.load_case}",
                verdict=use.decision.upper(),
                why=(use.reasons[0].text,),
                step=step,
                lines=next_lines(use),
                command=command,
                written=self.files,
                concern=CONCERN[use.decision],
            )
        for row in self.undecided:
            name = "no calibration" if row.calibration is None else names[row.calibration]
            yield Answer(
                subject=f"{row.sensor} ({row.serial}), {name}",
                verdict="NO VERDICT",
                why=(row.reason,),
                step=steps.get((row.sensor, row.serial), ""),
                written=self.files,
                concern=Concern.UNCERTAIN,
            )

    def blocks(self) -> Iterator[Table | str]:
        """Give the decision on every sensor, then what its recordings say of it.

        Yields:
            For every sensor sentences and what to do next, then a table per sensor and experiment.
        """
        for steps in self.next_steps:
            name = f"{steps.sensor} ({steps.serial})"
            yield table_of(
                [row for row in self._lines() if (row.sensor, row.serial) == (steps.sensor, steps.serial)], name
            )
            if steps.steps:
                rows = tuple((str(k), step) for k, step in enumerate(steps.steps, start=1))
                yield Table(caption=f"{name}: what to do next", headings=("", "step"), rows=rows)
        for experiment in self.experiments:
            for sensor in experiment.sensors:
                yield table_of(sensor.verdict, f"{experiment.experiment}: {sensor.sensor} ({sensor.serial})")

    def records(self) -> list[dict[str, object]]:
        """Give the decisions, then the other sentences, as lines.

        Returns:
            A line per sentence; without an experiment where all recordings of a sensor are evaluated together.
        """
        decisions: list[dict[str, object]] = [
            {"experiment": None, "sensor": row.sensor, "serial": row.serial, "tone": row.tone, "text": row.text}
            for row in self._lines()
        ]
        return decisions + [
            {"experiment": experiment.experiment, "sensor": sensor.sensor, "serial": sensor.serial, **line.flat()}
            for experiment in self.experiments
            for sensor in experiment.sensors
            for line in sensor.verdict
        ]

    def _lines(self) -> list[_Line]:
        unjudged = [row.calibration for row in self.undecided if row.calibration is not None]
        names = short_names([*(row.calibration for row in self.load_cases), *unjudged])
        decided = [
            _Line(
                sensor=row.sensor,
                serial=row.serial,
                tone=row.tone,
                text=f"{names[row.calibration]}: {row.message}",
            )
            for row in self.load_cases
        ]
        return decided + [
            _Line(
                sensor=row.sensor,
                serial=row.serial,
                tone="unknown",
                text=row.reason if row.calibration is None else f"{names[row.calibration]}: {row.reason}",
            )
            for row in self.undecided
        ]

    @property
    def document(self) -> Document:
        """The document, drawn anew."""
        return report_document(
            self.experiments,
            [*self._first_page(), *(self._page(steps) for steps in self.next_steps)],
            title=self.title,
            created=self.created,
            code_version=self.code_version,
            results=self.results,
            viewers=self.viewers,
        )

    def _first_page(self) -> Iterator[Section]:
        if len(self.next_steps) > 1:
            yield all_sensors_page(self.load_cases, self.undecided, self.next_steps)

    def _page(self, steps: NextSteps) -> Section:
        def own(row: LoadCaseVerdict | Undecided) -> bool:
            return (row.sensor, row.serial) == (steps.sensor, steps.serial)

        sensors = [
            sensor
            for experiment in self.experiments
            for sensor in experiment.sensors
            if (sensor.sensor, sensor.serial) == (steps.sensor, steps.serial)
        ]
        calibrations = {file: one for sensor in sensors for file, one in sensor.calibrations.items()}
        return decision_page(
            steps,
            [verdict for verdict in self.load_cases if own(verdict)],
            [undecided for undecided in self.undecided if own(undecided)],
            calibrations,
            [line for sensor in sensors for line in sensor.verdict],
            explained=steps is self.next_steps[0],
        )

    def save(self, *files: Path | str, force: bool = False) -> tuple[str, ...]:
        """Write the document, drawn once.

        Args:
            files: Files to write, each by the end of its name as .html, .pdf, or .json with the numbers alone.
            force: Whether files that are neither results nor figures may be replaced; inputs never are.

        Returns:
            What could not be made, each with its section and the reason, which stands in its place.
        """
        paths = [Path(file) for file in files]
        drawn = [path for path in paths if path.suffix.lower() != ".json"]
        require_writable(drawn)
        inputs = {digest for one in self.experiments for digest in one.inputs_sha256.values()}
        for path in paths:
            refuse_output(path, inputs_sha256=inputs, force=force)
        document = self.document if drawn else None
        for path in paths:
            if document is None or path not in drawn:
                write_bytes_atomically(path, self.model_dump_json(by_alias=True, indent=1).encode())
            else:
                write_bytes_atomically(path, _WRITERS[path.suffix.lower()](document))
        return () if document is None else document.failures


def _subject(assessments: Sequence[ExperimentAssessment]) -> str:
    """What a report is about: sensors, or skin alone."""
    return "Force-torque sensors" if any(one.sensors for one in assessments) else "Contacts on skin"


def require_writable(paths: Sequence[Path]) -> None:
    """Refuse before the work what cannot be written: other kinds of files, missing folders, what is not installed.

    Args:
        paths: Files that a report is to be written to.

    Raises:
        ForceTorqueError: If one has another ending.
    """
    for path in paths:
        if path.suffix.lower() not in _WRITERS:
            raise ForceTorqueError(f"--output {path}: expected a name that ends in {' or '.join(_WRITERS)}")
        refuse_unwritable(path)
    empty = Document(title="", subtitle="", created="2000-01-01T00:00:00+00:00", sections=())
    for path in paths:
        _WRITERS[path.suffix.lower()](empty)
    new_figure(1.0)


def report(
    experiments: Sequence[tuple[str, Experiment]],
    calibrations: Sequence[Mapping[str, Mapping[str, Calibration]]],
    *,
    created: str,
    code_version: str,
    title: str | None = None,
    demands: Demands | None = None,
    results: Mapping[str, dict[str, Any]] | None = None,
    viewer: Callable[[int], Section] | None = None,
    progress: Callable[[str], None] | None = None,
) -> Report:
    """Assess the sensors of experiments and make the report.

    Args:
        experiments: Name of the file, and experiment.
        calibrations: For every experiment calibrations by name of their file, by sensor.
        created: Date and time, ISO 8601 with time zone, for the record.
        code_version: Version of this library, for the record.
        title: Title of the document; made of the names of the experiments if left out.
        demands: Limits and other sensors to compare with.
        results: Results of other commands by file.
        viewer: Makes the section with the viewer of an experiment, by its place; none if left out.
        progress: Called with what is done next.

    Returns:
        The report, to be looked at or saved.
    """
    assessments, viewers = [], []
    demanded = demands or Demands()
    runs = [_judged_runs(experiment, groups) for (_, experiment), groups in zip(experiments, calibrations, strict=True)]
    for place, ((file, experiment), groups) in enumerate(zip(experiments, calibrations, strict=True)):
        with stated_in(file):
            assessments.append(
                assess_experiment(experiment, groups, file=file, demands=demanded, runs=runs[place], progress=progress)
            )
            if viewer is not None:
                viewers.append(viewer(place))
    if progress is not None:
        progress("deciding")
    uses, undecided = decide_uses(runs, calibrations, demanded)
    names = ", ".join(dict.fromkeys(assessment.experiment for assessment in assessments))
    return Report(
        title=title or f"{_subject(assessments)}: {names}",
        created=created,
        code_version=code_version,
        load_cases=uses,
        undecided=undecided,
        next_steps=tuple(
            next_steps(
                key,
                [row for row in uses if (row.sensor, row.serial) == key],
                [row for row in undecided if (row.sensor, row.serial) == key],
                {file: one for groups in calibrations for file, one in groups.get(key[0], {}).items()},
                {
                    file: run
                    for (file, _), own in zip(experiments, runs, strict=True)
                    for run in own.values()
                    if sensor_key(run) == key
                },
            )
            for key in sensor_keys(uses, undecided)
        ),
        experiments=tuple(assessments),
        results=dict(results or {}),
        viewers=tuple(viewers),
        warnings=tuple(
            dict.fromkeys(words for _, experiment in experiments for words in added_to(experiment.recording))
        ),
    )


def _judged_runs(experiment: Experiment, groups: Mapping[str, Mapping[str, Calibration]]) -> dict[str, SensorRun]:
    """The sensors that have any calibration, or all if none has."""
    return {
        sensor.name: SensorRun(experiment, sensor)
        for sensor in experiment.sensors
        if not groups or sensor.name in groups
    }
