# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque skin`: check a layout, calibrate taxels, and compute wrenches of contacts."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from forcetorque.results.command import Option, Saved, command
from forcetorque.results.terminal.command_from_signature import command_function
from forcetorque.results.terminal.options import WholeSentences

if TYPE_CHECKING:
    from forcetorque.skin.layout.check import SkinCheck
    from forcetorque.skin.patches_of_experiment import PatchExperiment
    from forcetorque.skin.taxels.calibrate import SkinCalibration
    from forcetorque.skin.taxels.patch_calibration_and_pressure_table import PatchCalibration
    from forcetorque.skin.wrench.skin_wrench import SkinWrench

_PATCH = Option("Name of the patch. Default: the only one.")


@command(
    "positions and normals, as written and as rebuilt",
    Saved(
        flags=("--repaired",),
        help="Table of the layout (CSV) to write, with normals rebuilt from the positions; no taxel is moved.",
        function="forcetorque.skin.layout.check:save_repaired_layout",
        endings=(".csv",),
    ),
)
def check_skin(
    layout: Annotated["Path | str", Option("File with the layout of a patch; see docs/skin/layout.md.")],
) -> "SkinCheck":
    """Find what is wrong with a layout; exit code 1 if anything is.

    Example: forcetorque skin check right_leg_lower.txt

    Python: `skin.check_skin("right_leg.txt")`

    Returns:
        What is wrong with it.
    """
    from forcetorque.skin.layout.check import check_patch
    from forcetorque.skin.layout.formats.registry import describe_patch

    return check_patch(describe_patch(layout))


@command(
    "pressure and counts over time, and of curves of taxels",
    Saved(
        flags=("--output", "-o"),
        help="File of the calibration (JSON) to write.",
        required=True,
        standard_output=True,
    ),
    Saved(
        flags=("--table",),
        help="CSV of the pressure of every taxel at 0 to 255 counts below rest.",
        function="forcetorque.skin.taxels.calibrate:save_pressure_table",
    ),
)
def calibrate_skin(
    *experiments: Annotated["Path | str", Option("Experiment files (TOML) of one [[patch]]; see docs/skin/taxels.md.")],
    patch: Annotated[str | None, _PATCH] = None,
    curve: Annotated[
        str,
        Option(
            "Form of the curves to keep; all are compared where not fitted.",
            choices=("monotone", "line", "polynomial", "capacitor", "logarithmic"),
        ),
    ] = "monotone",
    highest_pa: Annotated[
        float | None,
        Option(
            "Highest pressure above rest to fit; higher ones validate. Default: all.",
            "--highest-kpa",
            reads=lambda kilopascals: 1e3 * kilopascals,
        ),
    ] = None,
    warm_up: Annotated[
        "Path | str | None",
        Option("Experiment file of a warm-up without contact, to separate heat from pressure."),
    ] = None,
) -> "SkinCalibration":
    """Fit the pressure curve of every taxel of a patch of skin.

    Example: forcetorque skin calibrate fit.toml held_out.toml -o patch.json

    Python: `forcetorque.calibrate_skin("chamber.toml")`

    Returns:
        What the curves are worth, with the curves as its `calibration`.

    Raises:
        FitError: If no taxel is valid.
        ExperimentError: If no interval is for calibration.
    """
    from importlib.metadata import version

    from forcetorque.results.result import created_now
    from forcetorque.skin.taxels.calibrate import calibrate_skin

    return calibrate_skin(
        experiments,
        code_version=version("forcetorque"),
        created=created_now(),
        patch=patch,
        curve=curve,
        highest_pa=highest_pa,
        warm_up=warm_up,
    )


@command(
    "the field of pressure and of forces over time",
    Saved(
        flags=("--output", "-o"),
        help="File (CSV) of every contact of every frame.",
        function="forcetorque.skin.wrench.skin_wrench:save_contacts",
        endings=(".csv",),
    ),
    Saved(
        flags=("--film",),
        help="GIF of the field of pressure over time.",
        function="forcetorque.skin.figures:save_skin_film",
        endings=(".gif",),
    ),
)
def skin_wrench(
    experiment: Annotated[
        "PatchExperiment | Path | str", Option("Experiment file (TOML) with [[patch]]; see docs/skin/wrench.md.")
    ],
    calibration: Annotated[
        "PatchCalibration | Path | str", Option("Calibration of the taxels, of `skin calibrate` (JSON).", "--table")
    ],
    *,
    patch: Annotated[str | None, _PATCH] = None,
    method: Annotated[
        str,
        Option("How pressures are interpolated between taxels.", choices=("kriging", "linear", "thesis", "simple")),
    ] = "kriging",
    taxel_area_mm2: Annotated[
        float | None,
        Option("Area of a taxel, for --method simple; with others the figure has it beside them."),
    ] = None,
    weight_kg: Annotated[
        float | None,
        Option(
            "Mass of a known weight that was put on the level patch, several times: what is read is held against it."
        ),
    ] = None,
    plan: Annotated["Path | None", Option("Drawing of the patch (skinGui .ini), for --method thesis.")] = None,
    written_normals: Annotated[
        bool, Option("Take the normals of the layout, not those of its rebuilt surface.")
    ] = False,
    rest_s: Annotated[float, Option("Time at the beginning in which nothing touches the patch.")] = 2.0,
    averaged: Annotated[int, Option("Messages that are averaged to one frame.", "--average")] = 10,
    temperature: Annotated[
        str | None,
        Option(
            "How heat is taken out. Default: as learned, if the table has a warm-up.",
            choices=("learned", "firmware", "none"),
        ),
    ] = None,
    re_tare: Annotated[bool, Option("Take what is left after a release as rest, where heat explains it.")] = False,
) -> "SkinWrench":
    """Find contacts on a patch of skin, and their wrenches on the link.

    Example: forcetorque skin wrench experiment.toml --table patch.json

    Python: `forcetorque.skin_wrench("touch.toml", "taxels.json")`

    Returns:
        Every contact of every frame.
    """
    from forcetorque.skin.wrench.skin_wrench import WrenchChoice, skin_wrench

    choice = WrenchChoice(
        method=method,
        taxel_area_mm2=taxel_area_mm2,
        weight_kg=weight_kg,
        plan=plan,
        written_normals=written_normals,
        rest_s=rest_s,
        averaged=averaged,
        temperature=temperature,
        re_tare=re_tare,
    )
    return skin_wrench(experiment, calibration, patch=patch, choice=choice)


skin = typer.Typer(
    name="skin",
    cls=WholeSentences,
    help="Check, calibrate and use patches of artificial skin.",
    no_args_is_help=True,
    rich_markup_mode=None,
)

for _name, _analysis in (("calibrate", calibrate_skin), ("check", check_skin), ("wrench", skin_wrench)):
    skin.command(_name)(command_function(_analysis))
