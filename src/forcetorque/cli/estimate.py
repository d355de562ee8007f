# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque estimate`: contact wrenches, joint torques and expected readings of a recording."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from forcetorque.cli.options import CalibrationsOption, ExperimentArgument, FormatOption
from forcetorque.cli.output import Format, show, start_logging
from forcetorque.errors import ForceTorqueError


def estimate(
    experiment: ExperimentArgument,
    output: Annotated[Path, typer.Option("--output", "-o", help="File for every sample, .parquet or .csv.")],
    calibration: CalibrationsOption = None,
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
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Estimate contact wrenches, joint torques and expected readings.

    Example: forcetorque estimate experiment.toml -o estimates.parquet
    """
    from forcetorque import analysis
    from forcetorque.cli.reading import read_calibrations, read_experiment
    from forcetorque.exchange.estimates_table import SUFFIXES
    from forcetorque.experiment.contacts import contact_in_words
    from forcetorque.experiment.inputs import stated_in

    log = start_logging()
    _refuse_ending(output, SUFFIXES)
    calibrations = read_calibrations(calibration)
    content = read_experiment(experiment, log)
    with stated_in(str(experiment)):
        named = [contact_in_words(words, content.model) for words in contacts] if contacts else None
        corrections = analysis.corrections_of(content, calibrations)
        for sensor, correction in corrections.items():
            log.info("%s: %s", sensor, correction.source)
        with _Progress() as progress:
            spans = analysis.estimate_experiment(
                content, corrections, contacts=named, length_scale=length_scale, progress=progress.show
            )
    show(analysis.summarise_estimates(content, corrections, spans, file=output), output_format)


def _refuse_ending(output: Path, endings: Sequence[str]) -> None:
    """Say so before hours are spent on what cannot be written."""
    if output.suffix not in endings:
        raise ForceTorqueError(f"--output {output}: expected a name that ends in {' or '.join(endings)}")


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
