# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque skin calibrate`: from counts of taxels to pressure."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from forcetorque.results.terminal.options import ForceOption, FormatOption
from forcetorque.results.terminal.output import (
    Format,
    refuse_standard_output,
    refuse_two_on_standard_output,
    show,
    show_warnings,
    start_logging,
)

if TYPE_CHECKING:
    from forcetorque.skin.taxels.calibrate import SkinCalibration


class CurveChoice(StrEnum):
    """Form of the curves that are kept."""

    MONOTONE = "monotone"
    LINE = "line"
    POLYNOMIAL = "polynomial"
    CAPACITOR = "capacitor"


def calibrate(
    experiments: Annotated[
        list[Path],
        typer.Argument(help="Experiment files (TOML) of one [[patch]]; see docs/taxel_calibration.md."),
    ],
    output: Annotated[Path, typer.Option("--output", "-o", help="File of the calibration (JSON) to write.")],
    patch: Annotated[str | None, typer.Option("--patch", help="Name of the patch. Default: the only one.")] = None,
    curve: Annotated[
        CurveChoice, typer.Option("--curve", help="Form of the curves to keep; all are compared where not fitted.")
    ] = CurveChoice.MONOTONE,
    highest: Annotated[
        float | None,
        typer.Option("--highest-kpa", help="Highest pressure above rest to fit; higher ones only judge. Default: all."),
    ] = None,
    warm_up: Annotated[
        Path | None,
        typer.Option("--warm-up", help="Experiment file of a warm-up without contact, to tell heat from pressure."),
    ] = None,
    table: Annotated[
        Path | None, typer.Option("--table", help="CSV of the pressure of every taxel at 0 to 255 counts below rest.")
    ] = None,
    figure: Annotated[
        Path | None, typer.Option("--figure", help="PNG of pressure and counts over time, and of curves of taxels.")
    ] = None,
    force: ForceOption = False,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Fit the pressure curve of every taxel of a patch of skin.

    Example: forcetorque skin calibrate fit.toml held_out.toml -o patch.json
    """
    from importlib.metadata import version

    from forcetorque.base.output_file import declare_outputs
    from forcetorque.results.created import created_now
    from forcetorque.results.terminal.output import refuse_figure
    from forcetorque.skin.taxels.calibrate import calibrate_skin, read_patches
    from forcetorque.skin.taxels.pressure_table import write_pressure_table

    log = start_logging()
    refuse_two_on_standard_output(output, output_format)
    refuse_standard_output("--table", table)
    refuse_figure(figure, force=force)
    declare_outputs(output, table, force=force)
    contents = read_patches(experiments)
    for content in contents:
        for finding in content.recording.findings:
            log.warning("%s: %s: %s", content.file, finding.stream, finding.message)
    answer = calibrate_skin(
        contents,
        code_version=version("forcetorque"),
        created=created_now(),
        patch=patch,
        curve=curve.value,
        highest_pa=None if highest is None else 1e3 * highest,
        warm_up=warm_up,
    )
    answer.calibration.save(output)
    if table is not None:
        write_pressure_table(table, answer.calibration.table())
    answer = answer.model_copy(update={"file": str(output)})
    if figure is not None:
        answer = _drawn(answer, figure)
    if output.name == "-":
        show_warnings(answer)
    else:
        show(answer, output_format)


def _drawn(answer: SkinCalibration, figure: Path) -> SkinCalibration:
    from forcetorque.base.files import write_bytes_atomically
    from forcetorque.results.figures.canvas import png_bytes
    from forcetorque.skin.figures import taxel_figure

    write_bytes_atomically(figure, png_bytes(taxel_figure(answer.picture)))
    return answer.model_copy(update={"figure": str(figure)})
