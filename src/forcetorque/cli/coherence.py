# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque coherence`: whether all contacts together bear the weight, whichever of them touch."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from forcetorque.cli.options import ExperimentArgument, FormatOption
from forcetorque.cli.output import Format, show, start_logging

if TYPE_CHECKING:
    from forcetorque.analysis import Coherence


def coherence(
    experiment: ExperimentArgument,
    calibration: Annotated[
        list[Path] | None,
        typer.Option(
            "--calibration",
            "-c",
            help="Calibration file, or a folder of them; repeat for more. All files are one candidate, each folder is "
            "one. The prior is always judged.",
        ),
    ] = None,
    offset: Annotated[
        list[str] | None,
        typer.Option(
            "--offset",
            help="Where offsets come from: one-link-imu:LABEL, one-link-fixed-frame:LABEL, tare:LABEL, fitted or none; "
            "repeat for more. Default: the first interval in which one link alone is touched.",
        ),
    ] = None,
    figure: Annotated[
        Path | None, typer.Option("--figure", help="PNG of the errors by phase, candidate and offset.")
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Hold the net contact force against the weight as contacts switch.

    Example: forcetorque coherence switching.toml -c calibrations
    """
    from forcetorque import analysis
    from forcetorque.cli.figure_file import refuse_figure
    from forcetorque.cli.reading import read_experiment
    from forcetorque.experiment.inputs import stated_in

    log = start_logging()
    refuse_figure(figure)
    policies = analysis.offset_policies(offset or ())
    candidates = analysis.read_candidates(calibration or ())
    content = read_experiment(experiment, log)
    with stated_in(str(experiment)):
        result = analysis.coherence(content, candidates, offsets=policies)
    show(result if figure is None else _drawn(result, figure), output_format)


def _drawn(result: Coherence, figure: Path) -> Coherence:
    from forcetorque.atomic import write_bytes_atomically
    from forcetorque.report.figures import coherence_figure
    from forcetorque.report.figures.canvas import png_bytes

    write_bytes_atomically(figure, png_bytes(coherence_figure(result)))
    return result.model_copy(update={"figure": str(figure)})
