# SPDX-License-Identifier: BSD-3-Clause
"""The document of a report: verdicts first, then what they rest on."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from forcetorque.analysis import Assessment, ExperimentAssessment, criteria_table, finding_table
from forcetorque.analysis.contact_forces import WORTH, mean_contact_table
from forcetorque.analysis.evaluation_tables import ERROR_WORDS, error_tables
from forcetorque.analysis.sphere_tables import interval_table, mass_table, moment_table
from forcetorque.errors import ForceTorqueError
from forcetorque.report import figures, tables
from forcetorque.report.calibration_sections import (
    excitation_blocks,
    lambda_blocks,
    learnt_blocks,
    uncertainty_blocks,
)
from forcetorque.report.document import Block, Document, Figure, List, Section, Text, Tone, Verdict
from forcetorque.result import Table, short_names, table_of


def report_document(
    experiments: Sequence[ExperimentAssessment],
    *,
    title: str,
    created: str,
    code_version: str,
    results: Mapping[str, Mapping[str, Any]],
    viewers: Sequence[Section],
) -> Document:
    """Put numbers and figures into the order in which they are read.

    Args:
        experiments: What is said about every experiment.
        title: Title of the document.
        created: When it was made, ISO 8601 with time zone.
        code_version: Version of this library.
        results: Results of other commands by file.
        viewers: Sections with a viewer.

    Returns:
        The document.
    """
    several = len(experiments) > 1
    parts: list[Section] = [Section(title="Verdict", sections=tuple(_verdicts(experiments)))]
    parts += [_recording(experiment) for experiment in experiments]
    for experiment in experiments:
        for sensor in experiment.sensors:
            name = f"{sensor.sensor} ({sensor.serial})"
            parts.append(_sensor(f"{name}, {experiment.experiment}" if several else name, sensor))
    parts += [*viewers, *(_findings(experiment) for experiment in experiments)]
    for file, content in results.items():
        note = Text(text=f"{file}, {content['schema']}")
        shown = tuple(tables.result_tables(content))
        parts.append(Section(title=f"Result of {content['schema'].split('/')[1]}", blocks=(note, *shown)))
    parts.append(_provenance(experiments))
    sensors = {(sensor.sensor, sensor.serial) for experiment in experiments for sensor in experiment.sensors}
    robots = ", ".join(dict.fromkeys(experiment.robot for experiment in experiments))
    counts = f"{_counted(len(sensors), 'sensor')} in {_counted(len(experiments), 'recording')}"
    return Document(
        title=title,
        subtitle=f"{robots}; {counts}; forcetorque {code_version}",
        created=created,
        sections=tuple(parts),
    )


def _counted(count: int, noun: str) -> str:
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


def _verdicts(experiments: Sequence[ExperimentAssessment]) -> Iterator[Section]:
    for experiment in experiments:
        for sensor in experiment.sensors:
            lines = tuple(Verdict(tone=Tone(line.tone), text=line.text) for line in sensor.verdict)
            yield Section(title=f"{sensor.sensor} ({sensor.serial}), {experiment.experiment}", blocks=lines)


def _recording(experiment: ExperimentAssessment) -> Section:
    blocks: list[Block] = [
        Text(text=f"{experiment.file}: {experiment.duration_s:.1f} s of the robot {experiment.robot}.")
    ]
    if experiment.intervals:
        blocks.append(table_of(experiment.intervals, "Intervals"))
    blocks.append(table_of(experiment.streams, "Streams"))
    return Section(title=f"What was measured: {experiment.experiment}", blocks=tuple(blocks))


def _findings(experiment: ExperimentAssessment) -> Section:
    caption = "Findings about the recording; of many alike the first few, the JSON has them all"
    findings = experiment.findings
    block = finding_table(findings, caption) if findings else Text(text="Nothing was found wrong.")
    return Section(title=f"Findings: {experiment.experiment}", blocks=(block,))


def _sensor(title: str, sensor: Assessment) -> Section:
    makers: tuple[tuple[str, Callable[[Assessment], Iterator[Block]]], ...] = (
        ("Errors on data that was not fitted", _errors),
        ("Force and moment space", _space),
        ("Contact force where nothing touches", _contacts),
        ("Joint torques", _torques),
        ("What the recordings taught", learnt_blocks),
        ("Choice of lambda", lambda_blocks),
        ("Excitation", excitation_blocks),
        ("Uncertainty", uncertainty_blocks),
        ("What the sensor can do", _static),
        ("Acceptance", _acceptance),
    )
    sections = ((name, tuple(_drawn(make(sensor)))) for name, make in makers)
    return Section(
        title=title, sections=tuple(Section(title=name, blocks=blocks) for name, blocks in sections if blocks)
    )


def _drawn(blocks: Iterator[Block]) -> Iterator[Block]:
    """Blocks up to one that cannot be made, which is said: it does not cost the document."""
    try:
        yield from blocks
    except ForceTorqueError as error:
        yield Text(text=f"What follows could not be drawn: {error}")


def _errors(sensor: Assessment) -> Iterator[Block]:
    if sensor.evaluation:
        yield from error_tables(sensor.evaluation, f"Errors of {sensor.evaluation[0].samples} samples")
        yield Text(text=f"Numbers of these tables: {'; '.join((ERROR_WORDS, *sensor.smoothing))}.")
    if sensor.independence:
        yield table_of(sensor.independence, "How many independent samples the errors are worth")
    if sensor.comparisons:
        yield table_of(
            sensor.comparisons,
            "Error against that of the prior on the same samples: mean norms, and the ratio of the errors with its "
            "95 % interval over independent stretches of time; another offset would take away what is constant",
        )
    judged = sensor.judged
    if judged is None:
        return
    names = short_names([name for name, _ in judged.measured])
    shown = {names[name]: wrench for name, wrench in judged.measured}
    yield Figure(
        png=figures.comparison_figure(judged.time_s, judged.reference, shown),
        caption="Measured wrenches against what the model demands (dashed), on data that was not fitted.",
        description=f"Six plots over time, one per component, of the reference and of {', '.join(shown)}.",
    )
    errors = {name: wrench - judged.reference for name, wrench in shown.items()}
    yield Figure(
        png=figures.residual_figure(judged.time_s, errors),
        caption="Errors: their distribution, and how long they repeat themselves.",
        description=f"Histograms and autocorrelations of the six error components of {', '.join(errors)}.",
    )


def _space(sensor: Assessment) -> Iterator[Block]:
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
        names = short_names([row.candidate for row in sensor.spheres])
        reasons = {
            f"{names[row.candidate]}, {label}: not identifiable: {'; '.join(fit.why)}"
            for row in sensor.spheres
            for label, fit in (("with the model", row.with_reference), ("without", row.without_reference))
            if fit is not None and fit.why
        }
        if reasons:
            yield List(points=tuple(sorted(reasons)))
        yield Figure(
            png=figures.sphere_figure(sensor.clouds),
            caption="Forces, the ellipsoid through them and the sphere of the weight; dotted: not identifiable.",
            description="Clouds of forces seen along the three axes, with ellipsoids and a circle of the weight.",
        )
    if sensor.judged is not None:
        judged = sensor.judged
        names = short_names([name for name, _ in judged.measured])
        read = [*((names[name], wrench) for name, wrench in judged.measured), ("reference", judged.reference)]
        clouds = [(name, wrench[:, 3:]) for name, wrench in read]
        yield Figure(
            png=figures.force_space_figure({sensor.sensor: clouds}, quantity="moment"),
            caption="Moments on data that was not fitted, and what the model demands.",
            description="Clouds of moments seen along the three axes, measured and expected.",
        )


def _contacts(sensor: Assessment) -> Iterator[Block]:
    if not sensor.contact_forces:
        return
    yield table_of(
        sensor.contact_forces,
        "Mean absolute contact wrench of the free sub-model, and mean norm of its force ± half its 95 % interval; it "
        "should be zero",
        leave_out=WORTH,
    )
    yield mean_contact_table(sensor.contact_forces)
    names = short_names([row.candidate for row in sensor.contact_forces])
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
        names = short_names([criterion.candidate for criterion in sensor.criteria])
        for candidate, name in names.items():
            criteria = [criterion for criterion in sensor.criteria if criterion.candidate == candidate]
            yield criteria_table(criteria, f"Criteria of the acceptance file: {name}")


def _provenance(experiments: Sequence[ExperimentAssessment]) -> Section:
    made = [
        f"{file}: made {one.provenance.created} by forcetorque {one.provenance.code_version} from "
        f"{one.provenance.experiment}, {one.provenance.samples} samples of "
        + ", ".join(repr(interval.label) for interval in one.provenance.intervals)
        + f"; prior: {one.prior.source if one.prior else 'none'}"
        for experiment in experiments
        for sensor in experiment.sensors
        for file, one in sensor.calibrations.items()
    ]
    files = dict(item for experiment in experiments for item in experiment.inputs_sha256.items())
    read = Table(caption="Files that were read", headings=("file", "SHA-256"), rows=tuple(files.items()))
    return Section(title="Provenance", blocks=(List(points=tuple(made)), read))
