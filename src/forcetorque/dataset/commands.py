# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque dataset check` and `compensate`."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from forcetorque.results.command import Option, Saved, command

if TYPE_CHECKING:
    from forcetorque.base.progress import Progress
    from forcetorque.dataset.result import DatasetCheck

_SENSES = ("sensor_to_world", "world_to_sensor")
_FORMS = ("quat_xyzw", "quat_wxyz", "matrix_rows", "matrix_columns")


@command(
    None,
    Saved(flags=("--html",), help="HTML page of the result.", function="forcetorque.dataset.page:write_page"),
)
def check_dataset(
    folder: Annotated["Path | str", Option("Folder of a LeRobot dataset, v2.1 or v3.0.")],
    *,
    features: Annotated[
        Sequence[str], Option("Feature to examine. Default: those whose names say that they are forces.", "--feature")
    ] = (),
    orientation: Annotated[
        str | None, Option("Feature with the orientation of the sensor. Default: the one with elements qx qy qz qw.")
    ] = None,
    sense: Annotated[
        str | None,
        Option(
            "What its rotation does: sensor_to_world or world_to_sensor. Without, nothing is held against gravity.",
            choices=_SENSES,
        ),
    ] = None,
    form: Annotated[
        str | None, Option("How it is written. Default: by the names of its elements.", choices=_FORMS)
    ] = None,
    mass_kg: Annotated[
        float | None, Option("Known mass of the tool, by which units of forces are checked; kg.", "--mass")
    ] = None,
    progress: "Progress" = lambda _: None,
) -> "DatasetCheck":
    """Find dead, stuck, saturated, noisy, late, biased and drifting forces in a dataset.

    Example: forcetorque dataset check my_dataset --sense sensor_to_world --html check.html

    Python: `dataset.check_dataset("my_dataset", sense="sensor_to_world")`

    Returns:
        Findings by field and kind, and a record for each episode; exit code 1 if one does harm.

    Raises:
        FormatError: If the dataset is damaged, or has no force.
    """
    from forcetorque.dataset.check import checked

    return checked(
        Path(folder),
        features=features,
        orientation=orientation,
        sense=sense,
        form=form,
        mass_kg=mass_kg,
        progress=progress,
    )
