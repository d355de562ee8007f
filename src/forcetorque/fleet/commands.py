# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque fleet`: recordings of many robots in one dataset."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from forcetorque.results.command import Option, Saved, command
from forcetorque.results.terminal.command_from_signature import command_function
from forcetorque.results.terminal.options import WholeSentences

if TYPE_CHECKING:
    from forcetorque.base.progress import Progress
    from forcetorque.fleet.added_and_failed_recordings import Added
    from forcetorque.fleet.report import FleetReport
    from forcetorque.fleet.run import FleetRun
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
    from forcetorque.fleet.added_and_failed_recordings import add_recordings
    from forcetorque.fleet.sensor_record import AddOptions

    return add_recordings(
        [Path(file) for file in experiments], Path(into), AddOptions(robot=robot), replace=replace, progress=progress
    )


@command("the errors of the priors beside each other, and their median")
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


@command(
    "error and offset of the worst sensors over time",
    Saved(flags=("--output", "-o"), help="HTML page to write."),
)
def fleet_report(
    dataset: Annotated["Path | str", Option("Folder of a dataset; see docs/fleet.md.")],
    *,
    calibrations: Annotated[
        "Sequence[Path | str]",
        Option(
            "Calibration file in use, or folder of them such as fleet run writes. Default: none, no sensor is ranked.",
            "--calibration",
            "-c",
            typed=list[Path],
        ),
    ] = (),
    progress: Annotated["Progress", Option("Called with a line for people.")] = lambda _: None,
) -> "FleetReport":
    """Rank the sensors of a dataset, the worst first, and write one page on them.

    Example: forcetorque fleet report fleet -c calibrations -o fleet.html

    Python: `fleet.fleet_report("fleet", calibrations=["calibrations"]).save("fleet.html")`

    Returns:
        Evaluated sensors, the worst first, their errors over time, loads, what to do next, and failed recordings.

    Raises:
        MissingFileError: If there is no dataset.
        ExperimentError: If two calibrations are of one sensor.
    """
    from forcetorque.fleet.report import fleet_report_of

    return fleet_report_of(Path(dataset), [Path(file) for file in calibrations], progress)


@command("the errors of all calibrations and of their priors on validation data")
def fleet_run(
    plan: Annotated["Path | str", Option("Plan (TOML); see docs/fleet.md.")],
    *,
    workers: Annotated[int | None, Option("Processes of this machine. Default: one per core.", "--workers")] = None,
    dask: Annotated[
        str | None,
        Option("Scheduler of a Dask cluster in place of processes, such as tcp://10.0.0.1:8786.", "--dask"),
    ] = None,
    retry_failed: Annotated[
        bool, Option("Try recordings again that failed in an earlier run.", "--retry-failed")
    ] = False,
    progress: Annotated["Progress", Option("Called with a line for people.")] = lambda _: None,
) -> "FleetRun":
    """Add all recordings of a plan, and calibrate every sensor.

    Example: forcetorque fleet run fleet.toml --workers 8

    Python: `fleet.fleet_run("fleet.toml", workers=8)`

    Returns:
        What was done and what failed; exit code 1 if anything did.

    Raises:
        ForceTorqueError: If a pattern matches nothing, or the scheduler does not answer.
    """
    import os

    from forcetorque.base.errors import ForceTorqueError
    from forcetorque.fleet.process_pool import DaskPool, LocalPool
    from forcetorque.fleet.run import run_plan

    if workers is not None and (workers < 1 or dask is not None):
        expected = "no --workers beside --dask" if dask is not None else "at least 1"
        raise ForceTorqueError(f"--workers {workers}: expected {expected}")
    pool = LocalPool(workers=workers or os.cpu_count() or 1) if dask is None else DaskPool(address=dask)
    return run_plan(Path(plan), pool, retry_failed=retry_failed, progress=progress)


fleet = typer.Typer(
    name="fleet",
    cls=WholeSentences,
    help="Many recordings of many robots: one dataset of results.",
    no_args_is_help=True,
    rich_markup_mode=None,
)

for _name, _analysis in (("add", fleet_add), ("report", fleet_report), ("run", fleet_run), ("table", fleet_table)):
    fleet.command(_name)(command_function(_analysis))
