# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque balance`: which feet are down, where their pressure is centred, and the robot's centre of mass."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from forcetorque.cli.options import CalibrationsOption, ForceOption, FormatOption
from forcetorque.cli.output import Format, show, start_logging
from forcetorque.errors import ForceTorqueError

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from logging import Logger

    from forcetorque.analysis import Balance, BalanceOptions, Correction
    from forcetorque.experiment import Experiment, FootForces


def balance(
    experiments: Annotated[list[Path], typer.Argument(help="Experiment files (TOML) with [[sole]]; see balance.md.")],
    touch: Annotated[
        str, typer.Option("--touch", help="Force that a contact reaches, as 50N, or a share of the weight, as 15%.")
    ] = "15%",
    release: Annotated[
        str, typer.Option("--release", help="Force above which it lasts, as 20N or 6%; no more than --touch.")
    ] = "6%",
    dwell: Annotated[
        float, typer.Option("--dwell", help="Shortest contact, and shortest pause between contacts, that counts; s.")
    ] = 0.0,
    least_load: Annotated[
        str | None,
        typer.Option("--least-load", help="Load below which a foot has no centre of pressure. Default: --touch."),
    ] = None,
    height_band: Annotated[
        float | None,
        typer.Option(
            "--height-band",
            help="How far the centre of mass may be from its median height; m. With it, its acceleration by (5.22).",
        ),
    ] = None,
    calibration: CalibrationsOption = None,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="File for every sample, .parquet or .csv.")
    ] = None,
    figure: Annotated[
        Path | None,
        typer.Option("--figure", help="PNG of phases, loads and points of the first interval that it stands in."),
    ] = None,
    force: ForceOption = False,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Say which feet bear the robot, and where.

    Example: forcetorque balance standing.toml --touch 50N --release 20N
    """
    from forcetorque.analysis import BalanceOptions
    from forcetorque.analysis.runs.campaign_recording import refuse_a_file_twice
    from forcetorque.atomic import write_bytes_atomically
    from forcetorque.cli.figure_file import refuse_figure
    from forcetorque.estimation.balance import ForceLimit

    log = start_logging()
    refuse_figure(figure, force=force)
    refuse_a_file_twice(experiments)
    _refuse_output(output, force=force)
    options = BalanceOptions(
        touch=ForceLimit.of(touch),
        release=ForceLimit.of(release),
        dwell_s=dwell,
        least_load=None if least_load is None else ForceLimit.of(least_load),
        height_band_m=height_band,
    )
    result = _answer(experiments, calibration, options, log)
    if output is not None:
        log.info("%s: %d rows", output, result.write(output))
    if figure is not None:
        from forcetorque.report.figures import balance_figure
        from forcetorque.report.figures.canvas import png_bytes

        standing = next(one for one in result.intervals if one.phases.down.any())
        write_bytes_atomically(figure, png_bytes(balance_figure(standing)))
    show(result, output_format)


def _answer(
    experiments: Sequence[Path], calibration: Sequence[Path] | None, options: BalanceOptions, log: Logger
) -> Balance:
    from forcetorque import analysis
    from forcetorque.cli.reading import read_calibrations, read_experiment
    from forcetorque.experiment import has_foot_forces, load_foot_forces
    from forcetorque.experiment.inputs import stated_in

    calibrations = read_calibrations(calibration)
    recordings: list[Experiment | FootForces] = []
    corrections: list[Mapping[str, Correction]] = []
    for path in experiments:
        if has_foot_forces(path):
            recordings.append(load_foot_forces(path))
            corrections.append({})
            continue
        content = read_experiment(path, log)
        with stated_in(str(path)):
            readings = analysis.corrections_of(content, calibrations)
        recordings.append(content)
        corrections.append(readings)
        for sensor, correction in readings.items():
            log.info("%s: %s", sensor, correction.source)
    return analysis.balance(recordings, corrections, options)


def _refuse_output(output: Path | None, *, force: bool) -> None:
    """Say so before work is done for a file that cannot be written."""
    from forcetorque.exchange.sample_table import SUFFIXES
    from forcetorque.output_file import declare_outputs

    if output is None:
        return
    if output.suffix not in SUFFIXES:
        raise ForceTorqueError(f"--output {output}: expected a name that ends in {' or '.join(SUFFIXES)}")
    declare_outputs(output, force=force)
