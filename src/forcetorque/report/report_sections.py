# SPDX-License-Identifier: BSD-3-Clause
"""The sections of a report, and the analyses of every sensor below the page to decide by."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

from forcetorque.base.errors import ForceTorqueError
from forcetorque.calibration.figures.information import joint_figure
from forcetorque.calibration.report_blocks import (
    excitation_blocks,
    lambda_blocks,
    learnt_blocks,
    origin_words,
    uncertainty_blocks,
)
from forcetorque.contests.contest_scores import Contest, ContestLoadRow
from forcetorque.contests.figures import contest_figure
from forcetorque.estimation.report_blocks import torque_section
from forcetorque.evaluation.acceptance.acceptance import criteria_table
from forcetorque.evaluation.evaluation import ERROR_WORDS, error_tables
from forcetorque.evaluation.sphere.sphere import interval_table, mass_table, moment_table
from forcetorque.evaluation.validation.contact_force_errors import WORTH, constant_contact_table
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.experiment import Experiment
from forcetorque.inspection.inspect import finding_table
from forcetorque.report import record_tables as tables
from forcetorque.report.decision_page import prior_comparison_section
from forcetorque.report.experiment_assessment import ExperimentAssessment
from forcetorque.report.sensor_assessment import Assessment
from forcetorque.results.document.content import Block, Document, Figure, List, Page, Picture, Section, Text
from forcetorque.results.number_text import counted
from forcetorque.results.table import Table, short_names, table_of, without_vague
from forcetorque.sensor.bandwidth.response import Response
from forcetorque.sensor.figures import response_figure
from forcetorque.skin.report_blocks import skin_section
from forcetorque.viewer.packing import packed
from forcetorque.viewer.page import page_of
from forcetorque.viewer.scene_builder import scene_of

SensorSection = tuple[str, Callable[[Assessment], Iterator[Block]]]
"""Title of a section, and the function that makes its blocks."""


def _errors(sensor: Assessment) -> Iterator[Block]:
    from forcetorque.evaluation.figures.errors_and_matrices import comparison_figure, residual_figure

    if sensor.evaluation:
        yield from error_tables(sensor.evaluation, f"Errors of {sensor.evaluation[0].samples} samples")
        words = "; ".join((ERROR_WORDS, *sensor.smoothing))
        yield Text(text=f"Numbers of these tables: {words}. The verdict goes by root mean squares.")
    if sensor.independence:
        yield table_of(sensor.independence, "How many independent samples the errors are worth")
    judged = sensor.evaluated
    if judged is None:
        return
    names = short_names([name for name, _ in judged.measured])
    shown = {names[name]: wrench for name, wrench in judged.measured}
    yield Figure(
        picture=Picture(lambda: comparison_figure(judged.time_s, judged.reference, shown)),
        caption="Measured wrenches against what the model demands (dashed), on data that was not fitted.",
        description=f"Six plots over time, one per component, of the reference and of {', '.join(shown)}.",
    )
    yield Figure(
        picture=Picture(
            lambda: residual_figure(judged.time_s, {name: wrench - judged.reference for name, wrench in shown.items()})
        ),
        caption="Errors: their distribution, and how long they repeat themselves.",
        description=f"Histograms and autocorrelations of the six error components of {', '.join(shown)}.",
    )


def _space(sensor: Assessment) -> Iterator[Block]:
    from forcetorque.evaluation.figures.sphere import force_space_figure, sphere_figure

    if sensor.spheres:
        yield mass_table(
            sensor.spheres,
            "Apparent mass per axis, its error as a force, and the performance index; what is not known cannot be "
            "compared",
        )
        yield interval_table(sensor.spheres)
        moments = moment_table(sensor.spheres)
        if moments is not None:
            yield moments
        names = short_names([row.calibration for row in sensor.spheres])
        reasons = {
            f"{names[row.calibration]}, {label}: not identifiable: {'; '.join(fit.why)}"
            for row in sensor.spheres
            for label, fit in (("with the model", row.with_model), ("without", row.without_model))
            if fit is not None and fit.why
        }
        if reasons:
            yield List(points=tuple(sorted(reasons)))
        yield Figure(
            picture=Picture(lambda: sphere_figure(sensor.clouds)),
            caption="Forces, the ellipsoid through them and the sphere of the weight; dotted: not identifiable.",
            description="Clouds of forces seen along the three axes, with ellipsoids and a circle of the weight.",
        )
    if sensor.evaluated is not None:
        judged = sensor.evaluated
        names = short_names([name for name, _ in judged.measured])
        read = [*((names[name], wrench) for name, wrench in judged.measured), ("reference", judged.reference)]
        clouds = [(name, wrench[:, 3:]) for name, wrench in read]
        yield Figure(
            picture=Picture(lambda: force_space_figure({sensor.sensor: clouds}, quantity="moment")),
            caption="Moments on data that was not fitted, and what the model demands.",
            description="Clouds of moments seen along the three axes, measured and expected.",
        )


def _contacts(sensor: Assessment) -> Iterator[Block]:
    if not sensor.contact_forces:
        return
    contacts = table_of(
        sensor.contact_forces,
        "Mean absolute contact wrench of the free sub-model, and mean norm of its force ± half its 95 % interval; it "
        "should be zero",
        leave_out=WORTH,
    )
    yield without_vague(contacts)
    yield constant_contact_table(sensor.contact_forces)
    names = short_names([row.calibration for row in sensor.contact_forces])
    if len(names) > 1:
        yield List(points=tuple(best.sentence for best in sensor.best))


def _torques(sensor: Assessment) -> Iterator[Block]:
    if sensor.joint_torques:
        joints = list(dict.fromkeys(row.joint for row in sensor.joint_torques))
        rows = sorted(sensor.joint_torques, key=lambda row: (joints.index(row.joint), row.offset))
        yield table_of(rows, "Torque of each joint as estimated from the sensor, less that of the rigid-body model")


def _static(sensor: Assessment) -> Iterator[Block]:
    if sensor.static:
        yield tables.static_table(sensor.static)


def _acceptance(sensor: Assessment) -> Iterator[Block]:
    if sensor.criteria:
        names = short_names([criterion.calibration for criterion in sensor.criteria])
        for candidate, name in names.items():
            criteria = [criterion for criterion in sensor.criteria if criterion.calibration == candidate]
            yield criteria_table(criteria, f"Criteria of the acceptance file: {name}")


ERRORS: Final[SensorSection] = ("Errors on data that was not fitted", _errors)
"""The first section about the sensors."""
SENSOR_SECTIONS: Final[tuple[SensorSection, ...]] = (
    ("Information gained from the recordings", learnt_blocks),
    ("Uncertainty", uncertainty_blocks),
    ("Choice of lambda", lambda_blocks),
    ("Excitation", excitation_blocks),
    ("Force and moment space", _space),
    ("Contact force where nothing touches", _contacts),
    ("Joint torques", _torques),
    ("What the sensor can do", _static),
    ("Acceptance", _acceptance),
)
"""The sections about the sensors after the comparison with the prior."""


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
    """Arrange numbers and figures in sections.

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
    parts = [_over_sensors(*ERRORS, experiments), prior_comparison_section(experiments)]
    parts += [_over_sensors(name, make, experiments) for name, make in SENSOR_SECTIONS]
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
    what = ", ".join(counted(len(some), noun) for some, noun in ((sensors, "sensor"), (patches, "patch")) if some)
    counts = f"{what or 'no sensor'} in {counted(len(experiments), 'recording')}"
    return Document(
        title=title,
        subtitle=f"{robots}; {counts}; forcetorque {code_version}",
        created=created,
        sections=(*pages, *(replace(part, folded=True) for part in parts if part.blocks or part.sections)),
    )


def result_figures(content: Mapping[str, Any]) -> Iterator[Block]:
    """Draw the results of other commands whose JSON holds all that is drawn.

    Yields:
        Figures; none for most commands.
    """
    if content["schema"] == Contest.model_fields["schema_name"].default:
        rows = [ContestLoadRow.model_validate(row) for row in content["loads"]]
        yield Figure(
            picture=Picture(lambda: contest_figure(rows)),
            caption="Errors of every contestant over the loads, on which none was fitted, with 95 % intervals.",
            description="Six plots over the load, one per component, with a curve for each contestant.",
        )
    elif content["schema"] == Response.model_fields["schema_name"].default and (content["curve"] or content["decays"]):
        response = Response.model_validate(content)
        yield Figure(
            picture=Picture(lambda: response_figure(response)),
            caption="Gain, phase and coherence with 95 % intervals where a force was measured, and decays of events.",
            description="Plots over frequency, and a plot over time for each of the first events.",
        )


def _over_sensors(
    title: str, make: Callable[[Assessment], Iterator[Block]], experiments: Sequence[ExperimentAssessment]
) -> Section:
    """A section over all sensors: a part for each if there are several."""
    several = len(experiments) > 1
    blocks_of = {
        f"{sensor.sensor} ({sensor.serial})" + (f", {experiment.experiment}" if several else ""): tuple(
            _drawn(make(sensor))
        )
        for experiment in experiments
        for sensor in experiment.sensors
    }
    if len(blocks_of) == 1:
        return Section(title=title, blocks=next(iter(blocks_of.values())))
    return Section(
        title=title, sections=tuple(Section(title=name, blocks=blocks) for name, blocks in blocks_of.items() if blocks)
    )


def _parts(experiment: ExperimentAssessment) -> Section:
    title = f"Parts that nothing touches: {experiment.experiment}"
    residuals = experiment.part_residuals
    if not residuals:
        return Section(title=title)
    words = (
        "The sum of the wrenches at the sensors around a link group moves its bodies, independently of contacts "
        "elsewhere on the robot. The residual, by the first calibration of each sensor on data that was not fitted: "
        "root mean square; offsets are those of the session where it was fitted, else the best."
    )
    figure = Figure(
        picture=Picture(lambda: joint_figure(residuals)),
        caption="What is left of every part over time, by the prior matrices and by the calibrations.",
        description="For every part two plots over time, force and moment, each before and after.",
    )
    return Section(title=title, blocks=(Text(text=words), table_of(experiment.sub_models, "Parts"), figure))


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
        yield Text(text=f"What follows could not be drawn: {error}", is_failure=True)


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
        The section; where there is nothing to show, the reason in place of the viewer.
    """
    title = f"Posture and forces: {experiment.name}"
    try:
        built = scene_of(path, experiment, calibrations)
    except ForceTorqueError as error:
        words = f"The viewer could not be made: {error}"
        return Section(title=title, blocks=(Text(text=words, is_failure=True),))
    page = Page(
        html=page_of(packed(built)),
        title=f"Viewer of {experiment.name}",
        instead=f"The HTML file has a viewer here; `forcetorque view {path}` opens it too.",
    )
    return Section(title=title, blocks=(page,))
