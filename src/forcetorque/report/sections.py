# SPDX-License-Identifier: BSD-3-Clause
"""The sections of a report: pages to decide by first, then what they rest on."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from forcetorque.base.errors import ForceTorqueError
from forcetorque.calibration.figures.joint import joint_figure
from forcetorque.calibration.report_blocks import origin_words
from forcetorque.contests.figure import contest_figure
from forcetorque.contests.ranking import Contest
from forcetorque.contests.result import ContestLoadRow
from forcetorque.estimation.report_blocks import torque_section
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.experiment.experiment import Experiment
from forcetorque.inspection.inspect import finding_table
from forcetorque.report import record_tables as tables
from forcetorque.report.assessment.assessment import Assessment
from forcetorque.report.assessment.experiment_assessment import ExperimentAssessment
from forcetorque.report.decision_page import judgement_section
from forcetorque.report.questions import ERRORS, QUESTIONS
from forcetorque.results.document.content import Block, Document, Figure, List, Page, Section, Text
from forcetorque.results.document.picture import Picture
from forcetorque.results.table import Table, table_of
from forcetorque.sensor.bandwidth.bandwidth import Response
from forcetorque.sensor.bandwidth.figure import response_figure
from forcetorque.skin.report_blocks import skin_section
from forcetorque.viewer.build import scene_of
from forcetorque.viewer.page import MOST_SAMPLES, page_of


def report_document(
    experiments: Sequence[ExperimentAssessment],
    pages: Sequence[Section],
    *,
    title: str,
    created: str,
    code_version: str,
    results: Mapping[str, Mapping[str, Any]],
    viewers: Sequence[Section],
) -> Document:
    """Put numbers and figures into the order in which they are asked for.

    Args:
        experiments: What is said about every experiment.
        pages: A page per sensor to decide by.
        title: Title of the document.
        created: When it was made, ISO 8601 with time zone.
        code_version: Version of this library.
        results: Results of other commands by file.
        viewers: Sections with a viewer.

    Returns:
        The document: the pages, then all that they rest on, folded.
    """
    parts = [_question(*ERRORS, experiments), judgement_section(experiments)]
    parts += [_question(name, make, experiments) for name, make in QUESTIONS]
    parts += [_parts(experiment) for experiment in experiments]
    parts += [skin_section(experiment) for experiment in experiments]
    parts += [torque_section(experiment) for experiment in experiments]
    parts += [_recording(experiment) for experiment in experiments]
    parts += [*viewers, *(_findings(experiment) for experiment in experiments)]
    for file, content in results.items():
        note = Text(text=f"{file}, {content['schema']}")
        shown = tuple(tables.result_tables(content))
        drawn = tuple(_drawn(result_figures(content)))
        parts.append(Section(title=f"Result of {content['schema'].split('/')[1]}", blocks=(note, *drawn, *shown)))
    parts.append(_provenance(experiments))
    sensors = {(sensor.sensor, sensor.serial) for experiment in experiments for sensor in experiment.sensors}
    robots = ", ".join(dict.fromkeys(experiment.robot for experiment in experiments))
    patches = {patch.patch for experiment in experiments for patch in experiment.skin}
    patches |= {row.stream for experiment in experiments for row in experiment.skin_events}
    what = ", ".join(_counted(len(some), noun) for some, noun in ((sensors, "sensor"), (patches, "patch")) if some)
    counts = f"{what or 'no sensor'} in {_counted(len(experiments), 'recording')}"
    return Document(
        title=title,
        subtitle=f"{robots}; {counts}; forcetorque {code_version}",
        created=created,
        sections=(*pages, *(replace(part, folded=True) for part in parts if part.blocks or part.sections)),
    )


def result_figures(content: Mapping[str, Any]) -> Iterator[Block]:
    """Draw the results of other commands whose JSON holds all that is drawn.

    Args:
        content: The result.

    Yields:
        Figures; none for most commands.
    """
    if content["schema"] == Contest.model_fields["schema_name"].default:
        rows = [ContestLoadRow.model_validate(row) for row in content["loads"]]
        yield Figure(
            picture=Picture(lambda: contest_figure(rows)),
            caption="Errors of every contestant over the loads, on which nobody was fitted, with 95 % intervals.",
            description="Six plots over the load, one per component, with a curve for each contestant.",
        )
    elif content["schema"] == Response.model_fields["schema_name"].default and (content["curve"] or content["decays"]):
        response = Response.model_validate(content)
        yield Figure(
            picture=Picture(lambda: response_figure(response)),
            caption="Gain, phase and coherence with 95 % intervals where a force was measured, and decays of events.",
            description="Plots over frequency, and a plot over time for each of the first events.",
        )


def _counted(count: int, noun: str) -> str:
    several = f"{noun}es" if noun.endswith("ch") else f"{noun}s"
    return f"{count} {noun if count == 1 else several}"


def _question(
    title: str, make: Callable[[Assessment], Iterator[Block]], experiments: Sequence[ExperimentAssessment]
) -> Section:
    """One question to all sensors: a part for each if there are several."""
    several = len(experiments) > 1
    answers = {
        f"{sensor.sensor} ({sensor.serial})" + (f", {experiment.experiment}" if several else ""): tuple(
            _drawn(make(sensor))
        )
        for experiment in experiments
        for sensor in experiment.sensors
    }
    if len(answers) == 1:
        return Section(title=title, blocks=next(iter(answers.values())))
    return Section(
        title=title, sections=tuple(Section(title=name, blocks=blocks) for name, blocks in answers.items() if blocks)
    )


def _parts(experiment: ExperimentAssessment) -> Section:
    title = f"Parts that nothing touches: {experiment.experiment}"
    residuals = experiment.part_residuals
    if not residuals:
        return Section(title=title)
    words = (
        "What the sensors around a part read, added up, is what moves its bodies, whatever the rest of the robot "
        "touches. What is left, by the first calibration of each sensor on data that was not fitted: root mean square; "
        "offsets are those of the session where it was fitted, else the best."
    )
    figure = Figure(
        picture=Picture(lambda: joint_figure(residuals)),
        caption="What is left of every part over time, by the prior matrices and by the calibrations.",
        description="For every part two plots over time, force and moment, each before and after.",
    )
    return Section(title=title, blocks=(Text(text=words), table_of(experiment.parts, "Parts"), figure))


def _recording(experiment: ExperimentAssessment) -> Section:
    blocks: list[Block] = [Text(text=f"{experiment.file}: {experiment.duration_s:.1f} s of {experiment.robot}.")]
    if experiment.intervals:
        blocks.append(table_of(experiment.intervals, "Intervals"))
    blocks.append(table_of(experiment.streams, "Streams"))
    return Section(title=f"What was measured: {experiment.experiment}", blocks=tuple(blocks))


def _findings(experiment: ExperimentAssessment) -> Section:
    caption = "Findings about the recording; of many alike the first few, the JSON has them all"
    findings = experiment.findings
    block = finding_table(findings, caption) if findings else Text(text="Nothing was found wrong.")
    return Section(title=f"Findings: {experiment.experiment}", blocks=(block,))


def _drawn(blocks: Iterator[Block]) -> Iterator[Block]:
    """Blocks up to one that cannot be made, which is said: it does not cost the document."""
    try:
        yield from blocks
    except ForceTorqueError as error:
        yield Text(text=f"What follows could not be drawn: {error}")


def _provenance(experiments: Sequence[ExperimentAssessment]) -> Section:
    points = [
        origin_words(file, one)
        for experiment in experiments
        for sensor in experiment.sensors
        for file, one in sensor.calibrations.items()
    ]
    files = dict(item for experiment in experiments for item in experiment.inputs_sha256.items())
    read = Table(caption="Files that were read", headings=("file", "SHA-256"), rows=tuple(files.items()))
    return Section(title="Provenance", blocks=(List(points=tuple(points)), read))


def viewer_section(path: Path, experiment: Experiment, calibrations: Mapping[str, Calibration]) -> Section:
    """Put the viewer of an experiment into a section.

    Args:
        path: Experiment file.
        experiment: What it points to.
        calibrations: Calibrations by their file.

    Returns:
        The section.

    Raises:
        ForceTorqueError: If there are too many samples for one file.
    """
    built = scene_of(path, experiment, calibrations)
    if built.scene.samples > MOST_SAMPLES:
        raise ForceTorqueError(
            f"--viewer: expected at most {MOST_SAMPLES} samples inside a document, got {built.scene.samples}; leave it "
            "out and serve them with `forcetorque view`"
        )
    page = Page(
        html=page_of(built),
        title=f"Viewer of {experiment.name}",
        instead=f"The HTML file has a viewer here; `forcetorque view {path}` opens it too.",
    )
    return Section(title=f"Posture and forces: {experiment.name}", blocks=(page,))
