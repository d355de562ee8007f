# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque init` and `forcetorque inspect`."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from forcetorque.base.output_file import STANDARD_OUTPUT, declare_outputs
from forcetorque.results.command import Option, command
from forcetorque.results.terminal.options import DetailsOption, ForceOption, FormatOption
from forcetorque.results.terminal.output import Format, refuse_two_on_standard_output, show, start_logging

if TYPE_CHECKING:
    from forcetorque.inspection.inspect import Inspection


def init(
    log: Annotated[list[Path], typer.Argument(help="A log of any format, or several tables of one recording.")],
    urdf: Annotated[
        Path | None, typer.Option("--urdf", help="The robot. Default: none, a wrist sensor whose pose is logged.")
    ] = None,
    output: Annotated[
        Path, typer.Option("--output", "-o", help="Experiment file to write; - for standard output.")
    ] = Path("experiment.toml"),
    log_format: Annotated[
        str | None,
        typer.Option(help="Format of the log, such as ros or hdf5, as in [recording]. Default: by what is there."),
    ] = None,
    sensor: Annotated[
        list[str] | None,
        typer.Option("--sensor", help="Sensor to draft, by its name or stream; repeat for more. Default: all."),
    ] = None,
    matrices: Annotated[
        Path | None, typer.Option("--matrices", help="Folder of the matrix files that the sensors came with.")
    ] = None,
    force: ForceOption = False,
    details: DetailsOption = False,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Begin an experiment file of a log: what it does not say is a question.

    Example: forcetorque init log.csv --urdf robot.urdf -o experiment.toml

    Python: `inspection.draft_experiment("log.csv", urdf="robot.urdf")`
    """
    from forcetorque.inspection.draft.draft import draft_experiment

    start_logging().info("reading %s", ", ".join(map(str, log)))
    refuse_two_on_standard_output(output, output_format)
    declare_outputs(output, force=force)
    draft = draft_experiment(
        log, output, urdf=urdf, log_format=log_format, sensors=sensor or (), matrices=matrices, force=force
    )
    if output != STANDARD_OUTPUT:  # else the file itself went there
        show(draft, output_format, details=details)


@command()
def inspect(
    log: Annotated["Path | str", Option("Experiment file, or a log that is recognised, such as a YARP dumper folder.")],
    *,
    log_format: Annotated[
        str | None, Option("Format of a log, such as ros or hdf5, as in [recording]. Default: by what is there.")
    ] = None,
    calibration: Annotated[
        "Path | str | None",
        Option("Calibration that reads its sensor. Default: the prior, or as logged.", "--calibration", "-c"),
    ] = None,
) -> "Inspection":
    """Find faults of a log, its experiment file and the URDF.

    Example: forcetorque inspect experiment.toml

    Python: `experiment.inspect()`; of a log without an experiment `inspection.inspect_log("log.csv")`

    Returns:
        What the log or the recording of the experiment holds, and what is wrong with it.
    """
    from forcetorque.inspection.inspect import inspect_log

    return inspect_log(log, log_format=log_format, calibration=calibration)
