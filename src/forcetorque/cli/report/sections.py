# SPDX-License-Identifier: BSD-3-Clause
"""The document of a report: verdicts first, then what they rest on."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np

from forcetorque import report as figures
from forcetorque.calibration import Calibration
from forcetorque.cli.report import sphere_tables, tables
from forcetorque.cli.report.gather import ExperimentMaterial, SensorMaterial
from forcetorque.cli.report.result import ReportResult
from forcetorque.cli.scene import scene_of
from forcetorque.errors import ForceTorqueError
from forcetorque.experiment import Experiment
from forcetorque.report.document import Block, Document, Figure, List, Page, Section, Text, Tone, Verdict
from forcetorque.result.names import short_names
from forcetorque.spatial import WRENCH_COMPONENTS
from forcetorque.viewer import MOST_SAMPLES, page_of


def report_document(
    result: ReportResult, material: Sequence[ExperimentMaterial], viewers: Sequence[Section] = ()
) -> Document:
    """Put numbers and figures into the order in which they are read.

    Args:
        result: The numbers.
        material: Samples for the figures, experiment after experiment.
        viewers: Sections with a viewer.

    Returns:
        The document.
    """
    several = len(material) > 1
    parts: list[Section] = [Section(title="Verdict", sections=tuple(_verdicts(material)))]
    parts += [_recording(each) for each in material]
    for each in material:
        for sensor in each.sensors:
            title = f"{sensor.report.sensor} ({sensor.report.serial})"
            parts.append(_sensor(f"{title}, {each.report.experiment}" if several else title, sensor))
    parts += [*viewers, *(_findings(each) for each in material)]
    for file, content in result.results.items():
        shown = tuple(tables.result_tables(content))
        note = Text(text=f"{file}, {content['schema']}")
        parts.append(Section(title=f"Result of {content['schema'].split('/')[1]}", blocks=(note, *shown)))
    parts.append(_provenance(result))
    count = sum(len(each.sensors) for each in material)
    robots = ", ".join(dict.fromkeys(each.report.robot for each in material))
    return Document(
        title=result.title,
        subtitle=f"{robots}; {count} sensor(s) in {len(material)} recording(s); forcetorque {result.code_version}",
        created=result.created,
        sections=tuple(parts),
    )


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


def _verdicts(material: Sequence[ExperimentMaterial]) -> Iterator[Section]:
    for each in material:
        for sensor in each.sensors:
            lines = tuple(Verdict(tone=Tone(line.tone), text=line.text) for line in sensor.report.verdict)
            yield Section(
                title=f"{sensor.report.sensor} ({sensor.report.serial}), {each.report.experiment}", blocks=lines
            )


def _recording(each: ExperimentMaterial) -> Section:
    report = each.report
    return Section(
        title=f"What was measured: {report.experiment}",
        blocks=(
            Text(text=f"{report.file}: {report.duration_s:.1f} s of the robot {report.robot}."),
            tables.interval_table(report),
            tables.stream_table(report),
        ),
    )


def _findings(each: ExperimentMaterial) -> Section:
    found = each.report.findings
    block = tables.finding_table(each.report) if found else Text(text="Nothing was found wrong.")
    return Section(title=f"Findings: {each.report.experiment}", blocks=(block,))


def _sensor(title: str, sensor: SensorMaterial) -> Section:
    makers: tuple[tuple[str, Callable[[SensorMaterial], Iterator[Block]]], ...] = (
        ("Errors on data that was not fitted", _errors),
        ("Force and moment space", _space),
        ("Contact force where nothing touches", _contacts),
        ("Joint torques", _torques),
        ("Choice of lambda", _lambda),
        ("Excitation", _excitation),
        ("Uncertainty", _uncertainty),
        ("What the sensor can do", _static),
        ("Acceptance", _acceptance),
    )
    made = ((name, tuple(_drawn(make(sensor)))) for name, make in makers)
    return Section(title=title, sections=tuple(Section(title=name, blocks=blocks) for name, blocks in made if blocks))


def _drawn(blocks: Iterator[Block]) -> Iterator[Block]:
    """Blocks up to one that cannot be made, which is said: it does not cost the document."""
    try:
        yield from blocks
    except ForceTorqueError as error:
        yield Text(text=f"What follows could not be drawn: {error}")


def _errors(sensor: SensorMaterial) -> Iterator[Block]:
    report, judged = sensor.report, sensor.judged
    if report.evaluation:
        yield tables.evaluation_table(report)
    if report.comparisons:
        yield tables.comparison_table(report)
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


def _space(sensor: SensorMaterial) -> Iterator[Block]:
    report = sensor.report
    if sensor.spheres:
        yield sphere_tables.sphere_table(report.spheres)
        yield sphere_tables.mass_table(report.spheres)
        if any(row.moment_with_reference is not None for row in report.spheres):
            yield sphere_tables.moment_table(report.spheres)
        names = short_names([row.candidate for row in report.spheres])
        reasons = {
            f"{names[row.candidate]}, {label}: not identifiable: {'; '.join(fit.why)}"
            for row in report.spheres
            for label, fit in (("with the model", row.with_reference), ("without", row.without_reference))
            if fit is not None and fit.why
        }
        if reasons:
            yield List(points=tuple(sorted(reasons)))
        yield Figure(
            png=figures.sphere_figure(sensor.spheres),
            caption="Forces, the ellipsoid through them and the sphere of the weight; dotted: not identifiable.",
            description="Clouds of forces seen along the three axes, with ellipsoids and a circle of the weight.",
        )
    if sensor.judged is not None:
        judged = sensor.judged
        names = short_names([name for name, _ in judged.measured])
        read = [*((names[name], wrench) for name, wrench in judged.measured), ("reference", judged.reference)]
        clouds = [(name, wrench[:, 3:]) for name, wrench in read]
        yield Figure(
            png=figures.force_space_figure({report.sensor: clouds}, quantity="moment"),
            caption="Moments on data that was not fitted, and what the model demands.",
            description="Clouds of moments seen along the three axes, measured and expected.",
        )


def _contacts(sensor: SensorMaterial) -> Iterator[Block]:
    report = sensor.report
    if not report.contact_forces:
        return
    yield tables.contact_table(report)
    names = short_names([row.candidate for row in report.contact_forces])
    if len(names) > 1:
        yield List(
            points=tuple(
                f"offset {best.offset}: best is {names[best.by_magnitude]} by magnitude; by axis "
                + ", ".join(f"{axis} {names[name]}" for axis, name in zip(WRENCH_COMPONENTS, best.by_axis, strict=True))
                for best in report.best
            )
        )


def _torques(sensor: SensorMaterial) -> Iterator[Block]:
    if sensor.report.joint_torques:
        yield tables.torque_table(sensor.report)


def _lambda(sensor: SensorMaterial) -> Iterator[Block]:
    names = short_names(list(sensor.report.calibrations))
    curves, ratios = {}, {}
    for file, calibration in sensor.report.calibrations.items():
        selection = calibration.selection
        yield Text(text=f"{names[file]}: {_lambda_words(calibration.lambda_counts2)}; {selection.rule}.")
        if selection.lambda_counts2:
            chosen = np.inf if calibration.lambda_counts2 is None else calibration.lambda_counts2
            tried = np.array([np.inf if value is None else value for value in selection.lambda_counts2])
            curves[names[file]] = (tried, np.array(selection.held_out_rmse), chosen)
            ratios[names[file]] = np.array(selection.worst_ratio_to_prior)
    if curves:
        yield Figure(
            png=figures.held_out_figure(curves, worst_ratios=ratios),
            caption="Error on held-out blocks over lambda; the chosen one is marked.",
            description="Curve of the held-out error over lambda for every calibration.",
        )


def _lambda_words(value: float | None) -> str:
    return "lambda infinite, the prior matrix" if value is None else f"lambda {value:.4g} counts²"


def _excitation(sensor: SensorMaterial) -> Iterator[Block]:
    calibrations = sensor.report.calibrations
    if calibrations:
        names = short_names(list(calibrations))
        yield Figure(
            png=figures.excitation_figure(
                [names[file] for file in calibrations],
                [one.validity.variance_counts2 for one in calibrations.values()],
                [one.validity.explained for one in calibrations.values()],
                [one.validity.excited for one in calibrations.values()],
                [one.validity.directions for one in calibrations.values()],
            ),
            caption="How far the loads moved each direction of the raw readings while fitting, and how much of that "
            "motion they explain.",
            description="Bars of the deviation and explained share per raw direction, and what each is made of.",
        )


def _uncertainty(sensor: SensorMaterial) -> Iterator[Block]:
    names = short_names(list(sensor.report.calibrations))
    for file, calibration in sensor.report.calibrations.items():
        yield tables.matrix_table(names[file], calibration)


def _static(sensor: SensorMaterial) -> Iterator[Block]:
    if sensor.report.static:
        yield tables.static_table(sensor.report.static)


def _acceptance(sensor: SensorMaterial) -> Iterator[Block]:
    if sensor.report.criteria:
        yield tables.criteria_table(sensor.report.criteria)


def _provenance(result: ReportResult) -> Section:
    made = [
        f"{file}: made {one.provenance.created} by forcetorque {one.provenance.code_version} from "
        f"{one.provenance.experiment}, {one.provenance.samples} samples of "
        + ", ".join(repr(interval.label) for interval in one.provenance.intervals)
        + f"; prior: {one.prior.source if one.prior else 'none'}"
        for each in result.experiments
        for sensor in each.sensors
        for file, one in sensor.calibrations.items()
    ]
    return Section(title="Provenance", blocks=(List(points=tuple(made)), tables.input_table(result.experiments)))
