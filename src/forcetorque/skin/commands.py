# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque skin`: check a layout, calibrate taxels, and compute wrenches of contacts."""

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
    stop_at_failures,
)

if TYPE_CHECKING:
    from forcetorque.skin.taxels.calibrate import SkinCalibration
    from forcetorque.skin.wrench.wrench import SkinWrench


def check(
    layout: Annotated[Path, typer.Argument(help="File with the layout of a patch; see docs/skin/layout.md.")],
    figure: Annotated[
        Path | None, typer.Option("--figure", help="PNG of positions and normals, as written and as rebuilt.")
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Find what is wrong with a layout; exit code 1 if anything is.

    Example: forcetorque skin check right_leg_lower.txt

    Python: `skin.check_skin("right_leg.txt")`
    """
    from forcetorque.results.terminal.output import refuse_figure
    from forcetorque.skin.layout.check import check_skin

    refuse_figure(figure)
    start_logging().info("reading %s", layout)
    result = check_skin(layout)
    if figure is not None:
        from forcetorque.base.output_file import write_bytes_atomically
        from forcetorque.results.figures import png_bytes
        from forcetorque.skin.figures import skin_layout_figure

        write_bytes_atomically(figure, png_bytes(skin_layout_figure(result.positions, result.normals)))
        result = result.model_copy(update={"figure": str(figure)})
    show(result, output_format)
    stop_at_failures(result.findings)


class CurveChoice(StrEnum):
    """Form of the curves that are kept."""

    MONOTONE = "monotone"
    LINE = "line"
    POLYNOMIAL = "polynomial"
    CAPACITOR = "capacitor"


def calibrate(
    experiments: Annotated[
        list[Path],
        typer.Argument(help="Experiment files (TOML) of one [[patch]]; see docs/skin/taxels.md."),
    ],
    output: Annotated[Path, typer.Option("--output", "-o", help="File of the calibration (JSON) to write.")],
    patch: Annotated[str | None, typer.Option("--patch", help="Name of the patch. Default: the only one.")] = None,
    curve: Annotated[
        CurveChoice, typer.Option("--curve", help="Form of the curves to keep; all are compared where not fitted.")
    ] = CurveChoice.MONOTONE,
    highest: Annotated[
        float | None,
        typer.Option("--highest-kpa", help="Highest pressure above rest to fit; higher ones validate. Default: all."),
    ] = None,
    warm_up: Annotated[
        Path | None,
        typer.Option("--warm-up", help="Experiment file of a warm-up without contact, to separate heat from pressure."),
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

    Python: `forcetorque.calibrate_skin("chamber.toml")`
    """
    from importlib.metadata import version

    from forcetorque.base.output_file import declare_outputs
    from forcetorque.results.result import created_now
    from forcetorque.results.terminal.output import refuse_figure
    from forcetorque.skin.taxels.calibrate import calibrate_skin, read_patches
    from forcetorque.skin.taxels.patch_calibration import write_pressure_table

    log = start_logging()
    refuse_two_on_standard_output(output, output_format)
    refuse_standard_output("--table", table)
    refuse_figure(figure, force=force)
    declare_outputs(output, table, force=force)
    contents = read_patches(experiments)
    for content in contents:
        for finding in content.recording.findings:
            log.warning("%s: %s: %s", content.file, finding.stream, finding.message)
    result = calibrate_skin(
        contents,
        code_version=version("forcetorque"),
        created=created_now(),
        patch=patch,
        curve=curve.value,
        highest_pa=None if highest is None else 1e3 * highest,
        warm_up=warm_up,
    )
    result.calibration.save(output)
    if table is not None:
        write_pressure_table(table, result.calibration.table())
    result = result.model_copy(update={"file": str(output)})
    if figure is not None:
        result = _with_taxel_figure(result, figure)
    if output.name == "-":
        show_warnings(result)
    else:
        show(result, output_format)


def _with_taxel_figure(result: SkinCalibration, figure: Path) -> SkinCalibration:
    from forcetorque.base.output_file import write_bytes_atomically
    from forcetorque.results.figures import png_bytes
    from forcetorque.skin.figures import taxel_figure

    write_bytes_atomically(figure, png_bytes(taxel_figure(result.picture)))
    return result.model_copy(update={"figure": str(figure)})


class HeatChoice(StrEnum):
    """How heat is compensated."""

    LEARNED = "learned"
    FIRMWARE = "firmware"
    NONE = "none"


class MethodChoice(StrEnum):
    """How pressures are interpolated between taxels."""

    KRIGING = "kriging"
    LINEAR = "linear"
    THESIS = "thesis"
    SIMPLE = "simple"


def wrench(
    experiment: Annotated[Path, typer.Argument(help="Experiment file (TOML) with [[patch]]; see docs/skin/wrench.md.")],
    table: Annotated[Path, typer.Option("--table", help="Calibration of the taxels, of `skin calibrate` (JSON).")],
    patch: Annotated[str | None, typer.Option("--patch", help="Name of the patch. Default: the only one.")] = None,
    method: Annotated[
        MethodChoice, typer.Option("--method", help="How pressures are interpolated between taxels.")
    ] = MethodChoice.KRIGING,
    taxel_area: Annotated[
        float | None,
        typer.Option(
            "--taxel-area-mm2", help="Area of a taxel, for --method simple; with others the figure has it beside them."
        ),
    ] = None,
    plan: Annotated[
        Path | None, typer.Option("--plan", help="Drawing of the patch (skinGui .ini), for --method thesis.")
    ] = None,
    written_normals: Annotated[
        bool,
        typer.Option("--written-normals", help="Take the normals of the layout, not those of its rebuilt surface."),
    ] = False,
    rest: Annotated[
        float, typer.Option("--rest-s", help="Time at the beginning in which nothing touches the patch.")
    ] = 2.0,
    average: Annotated[int, typer.Option("--average", help="Messages that are averaged to one frame.")] = 10,
    temperature: Annotated[
        HeatChoice | None,
        typer.Option("--temperature", help="How heat is taken out. Default: as learned, if the table has a warm-up."),
    ] = None,
    re_tare: Annotated[
        bool, typer.Option("--re-tare", help="Take what is left after a release as rest, where heat explains it.")
    ] = False,
    figure: Annotated[
        Path | None, typer.Option("--figure", help="PNG of the field of pressure and of forces over time.")
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Find contacts on a patch of skin, and their wrenches on the link.

    Example: forcetorque skin wrench experiment.toml --table patch.json

    Python: `forcetorque.skin_wrench("touch.toml", "taxels.json")`
    """
    from forcetorque.results.terminal.output import refuse_figure
    from forcetorque.skin.wrench.wrench import WrenchChoice, skin_wrench

    refuse_figure(figure)
    start_logging().info("reading %s", experiment)
    choice = WrenchChoice(
        method=method.value,
        taxel_area_mm2=taxel_area,
        plan=plan,
        written_normals=written_normals,
        rest_s=rest,
        averaged=average,
        temperature=None if temperature is None else temperature.value,
        re_tare=re_tare,
    )
    result = skin_wrench(experiment, table, patch=patch, choice=choice)
    show(result if figure is None else _with_wrench_figure(result, figure), output_format)


def _with_wrench_figure(result: SkinWrench, figure: Path) -> SkinWrench:
    from forcetorque.base.output_file import write_bytes_atomically
    from forcetorque.results.figures import png_bytes
    from forcetorque.skin.figures import skin_wrench_figure

    write_bytes_atomically(figure, png_bytes(skin_wrench_figure(result.picture)))
    return result.model_copy(update={"figure": str(figure)})


skin = typer.Typer(
    name="skin",
    help="Check, calibrate and use patches of artificial skin.",
    no_args_is_help=True,
    rich_markup_mode=None,
)

for _command in (calibrate, check, wrench):
    skin.command(_command.__name__)(_command)
