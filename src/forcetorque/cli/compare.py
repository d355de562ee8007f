# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque compare`: the spheres of many sensors, mounting conditions and trials in one table and one figure."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from forcetorque.cli.options import ComparedCalibrationsOption, FormatOption, SensorOption, SphereIntervalOption
from forcetorque.cli.output import Format, TrialsChoice, show, start_logging, stop_at_failures

if TYPE_CHECKING:
    from forcetorque.analysis import Comparison


def compare(
    experiments: Annotated[
        list[Path], typer.Argument(help="Experiment files (TOML), in the order of the trials; see docs/sphere.md.")
    ],
    sensor: SensorOption = None,
    calibration: ComparedCalibrationsOption = None,
    interval: SphereIntervalOption = None,
    trials: Annotated[
        TrialsChoice,
        typer.Option("--trials", help="Whether a trial is a file with all its intervals, or each interval."),
    ] = TrialsChoice.FILES,
    figure: Annotated[
        Path | None, typer.Option("--figure", help="PNG of the indices of trials, their mean and the pooled fit.")
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Compare the spheres of many sensors, mountings and trials.

    Example: forcetorque compare first.toml second.toml third.toml
    """
    from forcetorque import analysis
    from forcetorque.cli.figure_file import refuse_figure
    from forcetorque.cli.reading import read_calibrations

    log = start_logging()
    refuse_figure(figure)
    result = analysis.compare(
        experiments,
        sensors=sensor,
        calibrations=read_calibrations(calibration),
        intervals=interval,
        by_interval=trials is TrialsChoice.INTERVALS,
        progress=log.info,
    )
    if figure is not None and result.analyses:
        result = _drawn(result, figure)
    show(result, output_format)
    stop_at_failures(result.failures)


def _drawn(result: Comparison, figure: Path) -> Comparison:
    """Draw the figure, and name it if it was drawn; what fails then must not cost the result."""
    from forcetorque.analysis import FailureRow
    from forcetorque.atomic import write_bytes_atomically
    from forcetorque.errors import ForceTorqueError
    from forcetorque.report import figures
    from forcetorque.report.figures.canvas import png_bytes

    try:
        write_bytes_atomically(figure, png_bytes(figures.index_figure(result.analyses)))
    except (ForceTorqueError, OSError) as error:
        failure = FailureRow(file=str(figure), sensor=None, message=" ".join(str(error).split()))
        return result.model_copy(update={"failures": (*result.failures, failure)})
    return result.model_copy(update={"figure": str(figure)})
