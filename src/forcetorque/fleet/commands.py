# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque fleet`: recordings of many robots in one dataset."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from forcetorque.results.command import Option, command
from forcetorque.results.terminal.command import command_function
from forcetorque.results.terminal.help import WholeSentences

if TYPE_CHECKING:
    from forcetorque.base.progress import Progress
    from forcetorque.fleet.add import Added
    from forcetorque.fleet.table import FleetTable


@command()
def fleet_add(
    *experiments: Annotated["Path | str", Option("Experiment files (TOML); see docs/recording.md.")],
    into: Annotated["Path | str", Option("Folder of the dataset, which is made where it is missing.", "--into")],
    robot: Annotated[
        str | None,
        Option("Name of the robot in the dataset. Default: that of its robot model.", "--robot"),
    ] = None,
    replace: Annotated[
        bool, Option("Put a recording that changed after it was added in the place of what was added.", "--replace")
    ] = False,
    progress: Annotated["Progress", Option("Called with a line for people.")] = lambda _: None,
) -> "Added":
    """Add recordings to a dataset; a second time changes nothing.

    Example: forcetorque fleet add monday.toml tuesday.toml --into fleet

    Python: `fleet.fleet_add("monday.toml", "tuesday.toml", into="fleet")`

    Returns:
        What was added and what was there.

    Raises:
        ExperimentError: If a recording changed after it was added, or another robot has a sensor of that serial number.
    """
    from forcetorque.fleet.add import add_recordings
    from forcetorque.fleet.sensor_record import AddOptions

    return add_recordings(
        [Path(file) for file in experiments], Path(into), AddOptions(robot=robot), replace=replace, progress=progress
    )


@command()
def fleet_table(
    dataset: Annotated["Path | str", Option("Folder of a dataset; see docs/fleet.md.")],
) -> "FleetTable":
    """List the sensors of a dataset, the largest error first.

    Example: forcetorque fleet table fleet

    Python: `fleet.fleet_table("fleet")`

    Returns:
        The sensors.

    Raises:
        MissingFileError: If there is no dataset.
    """
    from forcetorque.fleet.table import fleet_table_of

    return fleet_table_of(Path(dataset))


fleet = typer.Typer(
    name="fleet",
    cls=WholeSentences,
    help="Many recordings of many robots: one dataset of results.",
    no_args_is_help=True,
    rich_markup_mode=None,
)

for _name, _analysis in (("add", fleet_add), ("table", fleet_table)):
    fleet.command(_name)(command_function(_analysis))
