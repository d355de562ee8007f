# SPDX-License-Identifier: BSD-3-Clause
"""Makes the report and writes its files."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path

from forcetorque.atomic import refuse_unwritable, write_bytes_atomically
from forcetorque.cli.output import Format, console, print_result, start_logging
from forcetorque.cli.reading import read_experiment
from forcetorque.cli.report.gather import Demands, ExperimentMaterial, gather_experiment
from forcetorque.cli.report.inputs import assign_calibrations, sort_inputs
from forcetorque.cli.report.result import ReportResult
from forcetorque.cli.report.sections import report_document, viewer_section
from forcetorque.errors import ForceTorqueError
from forcetorque.experiment import read_population
from forcetorque.experiment.inputs import stated_in
from forcetorque.paths import real_path
from forcetorque.report.canvas import new_figure
from forcetorque.report.document import Document, Section, html_bytes, pdf_bytes

_WRITERS: dict[str, Callable[[Document], bytes]] = {".html": html_bytes, ".pdf": pdf_bytes}


def run(
    paths: Sequence[Path],
    *,
    outputs: Sequence[Path],
    title: str | None,
    population: Sequence[Path] | None,
    with_viewer: bool,
    output_format: Format,
) -> None:
    """Write one document about the sensors of experiments.

    Args:
        paths: Experiment files, calibrations, an acceptance file and results of other commands, in any order.
        outputs: Files to write, .html or .pdf; the numbers are written beside the first, as .numbers.json.
        title: Title of the document.
        population: Matrix files, calibrations or folders of them, of other sensors.
        with_viewer: Whether the viewer stands in the HTML.
        output_format: Form of the result.

    Raises:
        ForceTorqueError: If a file cannot be written, or a calibration is of no sensor of the experiments.
    """
    log = start_logging()
    numbers = outputs[0].with_suffix(".numbers.json")
    _refuse_outputs(outputs, numbers, paths)
    given = sort_inputs(paths)
    demands = Demands(acceptance=given.acceptance, population=read_population(population) if population else None)
    experiments = [(path, read_experiment(path, log)) for path in given.experiments]
    own = assign_calibrations([experiment for _, experiment in experiments], given.calibrations)
    material: list[ExperimentMaterial] = []
    viewers: list[Section] = []
    for (path, experiment), groups in zip(experiments, own, strict=True):
        with stated_in(str(path)):
            material.append(gather_experiment(path, experiment, groups, demands, log.info))
            if with_viewer:
                log.info("building the viewer")
                viewers.append(
                    viewer_section(path, experiment, dict(one for group in groups.values() for one in group.items()))
                )
    names = ", ".join(dict.fromkeys(each.report.experiment for each in material))
    result = ReportResult(
        title=title or f"Force-torque sensors: {names}",
        created=datetime.now(UTC).isoformat(timespec="seconds"),
        code_version=version("forcetorque"),
        experiments=[each.report for each in material],
        results=given.results,
    )
    log.info("drawing")
    document = report_document(result, material, viewers)
    for output in outputs:
        write_bytes_atomically(output, _WRITERS[output.suffix.lower()](document))
    write_bytes_atomically(numbers, result.model_dump_json(by_alias=True, indent=1).encode())
    rows = [
        {"experiment": each.experiment, "sensor": sensor.sensor, "serial": sensor.serial, **line.model_dump()}
        for each in result.experiments
        for sensor in each.sensors
        for line in sensor.verdict
    ]
    files = [str(output) for output in (*outputs, numbers)]
    print_result(result.model_dump(mode="json", by_alias=True), rows, output_format, show=lambda: _show(result, files))


def _refuse_outputs(outputs: Sequence[Path], numbers: Path, inputs: Sequence[Path]) -> None:
    """What cannot be written is said before the work: other kinds of files, folders that are missing, the inputs."""
    given = {real_path(path) for path in inputs}
    for output in outputs:
        if output.suffix.lower() not in _WRITERS:
            raise ForceTorqueError(f"--output {output}: expected a name that ends in {' or '.join(_WRITERS)}")
    for file in (*outputs, numbers):
        refuse_unwritable(file)
        if real_path(file) in given:
            raise ForceTorqueError(f"{file}: this is a file to read; choose another --output")
    empty = Document(title="", subtitle="", created=datetime.now(UTC).isoformat(timespec="seconds"), sections=())
    for output in outputs:  # also whether what writes it is installed
        _WRITERS[output.suffix.lower()](empty)
    new_figure(1.0)


def _show(result: ReportResult, files: Sequence[str]) -> None:
    screen = console()
    for each in result.experiments:
        for sensor in each.sensors:
            screen.print(f"{each.experiment}: {sensor.sensor} ({sensor.serial})", soft_wrap=True)
            for line in sensor.verdict:
                screen.print(f"  {line.tone}: {line.text}", soft_wrap=True)
    screen.print(f"written: {', '.join(files)}", soft_wrap=True)
