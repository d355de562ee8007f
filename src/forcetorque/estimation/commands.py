# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque estimate`: contact wrenches, joint torques and expected readings of a recording."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from forcetorque.results.terminal.command_output import Format, show, start_logging
from forcetorque.results.terminal.options import (
    CalibrationsOption,
    DetailsOption,
    ExperimentsArgument,
    ForceOption,
    FormatOption,
    OffsetOption,
)

if TYPE_CHECKING:
    from logging import Logger

    from forcetorque.estimation.result import EstimateSummary
    from forcetorque.experiment.calibration.calibration_file import Calibration
    from forcetorque.experiment.experiment import Experiment


def estimate(
    experiments: ExperimentsArgument,
    output: Annotated[
        Path,
        typer.Option(
            "--output",
            "-o",
            help="File for every sample, .parquet or .csv; of several experiments one each, NAME.EXPERIMENT.parquet.",
        ),
    ],
    calibration: CalibrationsOption = None,
    offset: OffsetOption = "fitted",
    contacts: Annotated[
        list[str] | None,
        typer.Option(
            "--contacts",
            help="FRAME, FRAME:force or FRAME:force_along:x,y,z; repeat for more. Default: those of the file, else "
            "at the sensors.",
        ),
    ] = None,
    length_scale: Annotated[
        float | None,
        typer.Option("--length-scale", help="Moment that weighs as much as one newton; m. For more than six unknowns."),
    ] = None,
    fuse: Annotated[
        bool,
        typer.Option(
            "--fuse", help="Joint torques of sensors, known contacts and motors too, beside each other and made one."
        ),
    ] = False,
    figure: Annotated[
        Path | None,
        typer.Option(
            "--figure",
            help="PNG, SVG or PDF of joint torques over time, by source with --fuse; of several experiments one each, "
            "as -o.",
        ),
    ] = None,
    force: ForceOption = False,
    details: DetailsOption = False,
    output_format: FormatOption = Format.TABLE,
) -> Any:
    """Estimate contact wrenches, joint torques and expected readings.

    Example: forcetorque estimate experiment.toml -o estimates.parquet

    Python: `experiment.estimate(calibration)`

    Returns:
        The `Result` that is shown, without samples.
    """
    from forcetorque.base.output_file import declare_outputs, existing_files_replaced_last
    from forcetorque.estimation.result import estimates_of_recordings
    from forcetorque.experiment.campaign_intervals import refuse_a_file_twice
    from forcetorque.experiment.loading import Purpose, experiment_finished
    from forcetorque.experiment.named_files import file_of_each, stated_in
    from forcetorque.formats.sample_table_writing import SUFFIXES
    from forcetorque.results.terminal.command_inputs import read_calibrations, read_experiment
    from forcetorque.results.terminal.command_output import refuse_ending, refuse_figure

    log = start_logging()
    refuse_ending("--output", output, SUFFIXES)
    refuse_figure(figure, force=force)
    refuse_a_file_twice(experiments)
    files, figures = file_of_each(experiments, output), {} if figure is None else file_of_each(experiments, figure)
    written = [*files.values(), *(file for file in figures.values() if file != figure)]
    declare_outputs(*written, force=force)
    calibrations = read_calibrations(calibration)
    summaries = {}
    with existing_files_replaced_last():  # what is written first may be an input of what is read last
        for path, file in files.items():
            # a recording goes when its estimates are written: there may be more of them than memory holds
            content = read_experiment(path, log, Purpose.FORCES)
            with stated_in(str(path)):
                summary = summaries[str(path)] = _estimated(
                    content,
                    calibrations,
                    contacts,
                    length_scale,
                    file,
                    log,
                    offset=offset,
                    fuse=fuse,
                    figure=figures.get(path),
                )
            experiment_finished(path, content, summary)
    several = len(summaries) > 1
    result = estimates_of_recordings(summaries) if several else summaries[str(experiments[0])]
    show(result, output_format, details=details, experiments=experiments)
    return result


def _estimated(
    content: Experiment,
    calibrations: Mapping[str, Calibration],
    contacts: Sequence[str] | None,
    length_scale: float | None,
    file: Path,
    log: Logger,
    *,
    offset: str,
    fuse: bool,
    figure: Path | None,
) -> EstimateSummary:
    """Estimate over one experiment, write every sample, and draw the torques where a file is named."""
    from forcetorque.estimation.estimate import estimate_experiment
    from forcetorque.estimation.result import summarise_estimates
    from forcetorque.estimation.skin_contacts import frames_of_patches
    from forcetorque.estimation.torque.experiment_fusion import TorqueHistory, fuse_experiment
    from forcetorque.experiment.contacts import contact_in_words
    from forcetorque.experiment.offsets import corrections_of
    from forcetorque.results.terminal.command_output import drawn_to

    named = [contact_in_words(words, content.model) for words in contacts] if contacts else None
    corrections = corrections_of(content, calibrations, offset=offset)
    for sensor, correction in corrections.items():
        log.info("%s: %s", sensor, correction.source)
    patches = frames_of_patches(content)
    with _Progress() as progress:
        spans = estimate_experiment(
            content,
            corrections,
            contacts=named,
            length_scale=length_scale,
            progress=progress.show,
            patches=patches,
        )
    fusions, frictions = fuse_experiment(content, corrections, contacts=named, patches=patches) if fuse else ([], ())
    summary = summarise_estimates(content, corrections, spans, file=file, fusions=fusions, frictions=frictions)
    if figure is None:
        return summary
    torques = TorqueHistory(experiment=content, spans=spans, fusions=fusions)
    if left_out := torques.picture().left_out:
        log.info("drawn are the joints whose torques change most, not %s", ", ".join(left_out))
    # without samples afterwards: there may be more of them than memory holds
    return drawn_to(summary.model_copy(update={"torques": torques}), figure).model_copy(update={"torques": None})


class _Progress:
    """A bar on standard error, where somebody looks at it."""

    def __enter__(self) -> _Progress:
        from rich.console import Console
        from rich.progress import Progress

        self.bar = Progress(console=Console(file=sys.stderr), transient=True, disable=not sys.stderr.isatty())
        self.bar.start()
        self.task = self.bar.add_task("estimating", total=None)
        return self

    def __exit__(self, *_: object) -> None:
        self.bar.stop()

    def show(self, done: int, total: int) -> None:
        self.bar.update(self.task, completed=done, total=total)
