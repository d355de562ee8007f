# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque skin wrench`: contacts on a patch and what they do to the link."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from forcetorque.results.terminal.options import FormatOption
from forcetorque.results.terminal.output import Format, show, start_logging

if TYPE_CHECKING:
    from forcetorque.skin.wrench.wrench import SkinWrench


class HeatChoice(StrEnum):
    """How heat is taken out of readings."""

    LEARNED = "learned"
    FIRMWARE = "firmware"
    NONE = "none"


class MethodChoice(StrEnum):
    """How pressures between taxels are told."""

    KRIGING = "kriging"
    LINEAR = "linear"
    THESIS = "thesis"
    SIMPLE = "simple"


def wrench(
    experiment: Annotated[Path, typer.Argument(help="Experiment file (TOML) with [[patch]]; see docs/skin_wrench.md.")],
    table: Annotated[Path, typer.Option("--table", help="Calibration of the taxels, of `skin calibrate` (JSON).")],
    patch: Annotated[str | None, typer.Option("--patch", help="Name of the patch. Default: the only one.")] = None,
    method: Annotated[
        MethodChoice, typer.Option("--method", help="How pressures between taxels are told.")
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
    answer = skin_wrench(experiment, table, patch=patch, choice=choice)
    show(answer if figure is None else _drawn(answer, figure), output_format)


def _drawn(answer: SkinWrench, figure: Path) -> SkinWrench:
    from forcetorque.base.files import write_bytes_atomically
    from forcetorque.results.figures.canvas import png_bytes
    from forcetorque.skin.figures import skin_wrench_figure

    write_bytes_atomically(figure, png_bytes(skin_wrench_figure(answer.picture)))
    return answer.model_copy(update={"figure": str(figure)})
