# SPDX-License-Identifier: BSD-3-Clause
"""The report on the sensors of experiments: every number of it, and the document that shows them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

from pydantic import Field

from forcetorque.analysis import Demands, ExperimentAssessment, assess_experiment
from forcetorque.atomic import refuse_unwritable, write_bytes_atomically
from forcetorque.calibration import Calibration
from forcetorque.errors import ForceTorqueError
from forcetorque.experiment import Experiment
from forcetorque.experiment.inputs import stated_in
from forcetorque.report.document import Document, Section, html_bytes, pdf_bytes
from forcetorque.report.figures.canvas import new_figure
from forcetorque.report.sections import report_document
from forcetorque.result import Result, Table, table_of

_WRITERS: dict[str, Callable[[Document], bytes]] = {".html": html_bytes, ".pdf": pdf_bytes}


class Report(Result):
    """Everything about the sensors of experiments, verdict first."""

    schema_name: Literal["forcetorque/report/1"] = Field(default="forcetorque/report/1", alias="schema")
    """Form of the result."""
    title: str
    """Title of the document."""
    created: str
    """When it was made, ISO 8601 with time zone."""
    code_version: str
    """Version of forcetorque."""
    experiments: tuple[ExperimentAssessment, ...]
    """One per experiment file."""
    results: dict[str, dict[str, Any]]
    """Results of other commands by file, as they were given."""
    viewers: tuple[Section, ...] = Field(default=(), exclude=True, repr=False)
    """Sections of the document with a viewer."""

    def blocks(self) -> Iterator[Table | str]:
        """Give the verdict on every sensor.

        Yields:
            A table per sensor.
        """
        for experiment in self.experiments:
            for sensor in experiment.sensors:
                yield table_of(sensor.verdict, f"{experiment.experiment}: {sensor.sensor} ({sensor.serial})")

    def records(self) -> list[dict[str, object]]:
        """Give the sentences of the verdicts as lines.

        Returns:
            A line per sentence.
        """
        return [
            {"experiment": experiment.experiment, "sensor": sensor.sensor, "serial": sensor.serial, **line.flat()}
            for experiment in self.experiments
            for sensor in experiment.sensors
            for line in sensor.verdict
        ]

    @property
    def document(self) -> Document:
        """The document, drawn anew."""
        return report_document(
            self.experiments,
            title=self.title,
            created=self.created,
            code_version=self.code_version,
            results=self.results,
            viewers=self.viewers,
        )

    def save(self, *files: Path | str) -> None:
        """Write the document, drawn once.

        Args:
            files: Files to write, each by the end of its name as .html, .pdf, or .json with the numbers alone.
        """
        paths = [Path(file) for file in files]
        drawn = [path for path in paths if path.suffix.lower() != ".json"]
        require_writable(drawn)
        document = self.document if drawn else None
        for path in paths:
            if document is None or path not in drawn:
                write_bytes_atomically(path, self.model_dump_json(by_alias=True, indent=1).encode())
            else:
                write_bytes_atomically(path, _WRITERS[path.suffix.lower()](document))


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
    """Say everything about the sensors of experiments.

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
    for place, ((file, experiment), groups) in enumerate(zip(experiments, calibrations, strict=True)):
        with stated_in(file):
            assessments.append(
                assess_experiment(experiment, groups, file=file, demands=demands or Demands(), progress=progress)
            )
            if viewer is not None:
                viewers.append(viewer(place))
    names = ", ".join(dict.fromkeys(assessment.experiment for assessment in assessments))
    return Report(
        title=title or f"Force-torque sensors: {names}",
        created=created,
        code_version=code_version,
        experiments=tuple(assessments),
        results=dict(results or {}),
        viewers=tuple(viewers),
    )
