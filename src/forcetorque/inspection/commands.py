# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque init` and `forcetorque inspect`."""

from collections.abc import Collection
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from forcetorque.base.errors import ExperimentError
from forcetorque.base.output_file import STANDARD_OUTPUT, declare_outputs
from forcetorque.results.command import SENSORS, Option, command
from forcetorque.results.terminal.command_output import Format, refuse_two_on_standard_output, show, start_logging
from forcetorque.results.terminal.options import (
    ColumnNamesOption,
    DetailsOption,
    ForceOption,
    FormatOption,
    LoadsOption,
    RecordingOption,
    between_commas,
)

if TYPE_CHECKING:
    from forcetorque.base.progress import Progress
    from forcetorque.inspection.inspect import Inspection


def init(
    log: Annotated[
        list[Path] | None, typer.Argument(help="A log of any format, or several tables of one recording.")
    ] = None,
    urdf: Annotated[
        Path | None,
        typer.Option(
            "--urdf",
            help="URDF file or name of the robot. Default: the log's own description; without, a wrist sensor.",
        ),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output", "-o", help="Experiment file to write; - for standard output. Default: experiment.toml."
        ),
    ] = None,
    log_format: Annotated[
        str | None,
        typer.Option(help="Format of the log, such as ros or hdf5, as in [recording]. Default: by what is there."),
    ] = None,
    column_names: ColumnNamesOption = None,
    recording: RecordingOption = None,
    sensor: Annotated[
        list[str] | None,
        typer.Option("--sensor", help="Sensor to draft, by its name or stream; repeat for more. Default: all."),
    ] = None,
    matrices: Annotated[
        Path | None, typer.Option("--matrices", help="Folder of the matrix files that the sensors came with.")
    ] = None,
    loads: LoadsOption = None,
    resume: Annotated[
        Path | None,
        typer.Option("--resume", help="Experiment file whose questions are asked, and of which changes are proposed."),
    ] = None,
    no_input: Annotated[
        bool, typer.Option("--no-input", help="With --resume: ask nothing, list questions or proposals.")
    ] = False,
    yes: Annotated[
        bool, typer.Option("--yes", help="With --resume: accept all proposals, of which each is tried first.")
    ] = False,
    force: ForceOption = False,
    details: DetailsOption = False,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Begin an experiment file of a log, or propose changes of one.

    Example: forcetorque init log.csv --urdf robot.urdf -o experiment.toml

    Exit codes with --resume: 0 nothing is left, 2 error, 4 questions or proposals are open.

    Python: `inspection.draft_experiment("log.csv", "x.toml", urdf="robot.urdf", sensors=["arm_ft"])`,
    `inspection.resume_experiment("x.toml")`
    """
    if resume is not None:
        of_log = {
            "a log": log,
            "--urdf": urdf,
            "--output": output,
            "--log-format": log_format,
            "--column-names": column_names,
            "--recording": recording,
            "--sensor": sensor,
            "--matrices": matrices,
            "--loads": loads,
            "--force": force,
        }
        _refuse_beside(resume, [name for name, value in of_log.items() if value])
        _resume(resume, output_format, no_input=no_input, yes=yes, details=details)
        return
    from forcetorque.inspection.draft.draft import draft_experiment

    log, output = _required(log), output or Path("experiment.toml")
    start_logging().info("reading %s", ", ".join(map(str, log)))
    refuse_two_on_standard_output(output, output_format)
    declare_outputs(output, force=force)
    draft = draft_experiment(
        log,
        output,
        urdf=urdf,
        log_format=log_format,
        column_names=between_commas(column_names),
        recording=recording or (),
        sensors=sensor or (),
        matrices=matrices,
        loads=loads,
        force=force,
    )
    if output != STANDARD_OUTPUT:  # else the file itself went there
        show(draft, output_format, details=details)


def _required(logs: list[Path] | None) -> list[Path]:
    if not logs:
        raise ExperimentError(
            "init: expected a log, or an experiment file by --resume, got neither; a file without a log, for "
            "`forcetorque plan`, is written by hand, as docs/planning.md shows"
        )
    return logs


def _refuse_beside(file: Path, options: list[str]) -> None:
    if options:
        raise ExperimentError(f"--resume {file}: expected nothing of a log beside it, got {', '.join(options)}")


def _resume(file: Path, output_format: Format, *, no_input: bool, yes: bool, details: bool) -> None:
    from forcetorque.inspection.draft.questions import OPEN_QUESTIONS, resume_experiment
    from forcetorque.results.terminal.options import accepts, ask, has_piped_lines, is_terminal

    if yes and no_input:
        raise ExperimentError("--yes: expected without --no-input, which changes nothing")
    if not (yes or no_input) and has_piped_lines():
        raise ExperimentError(
            "standard input: expected a terminal to answer in, got piped lines, which are not read; accept all "
            "proposals by --yes, or list questions and proposals by --no-input"
        )
    log = start_logging()
    log.info("reading %s", file)
    asks = is_terminal() and not (no_input or yes)

    def accepted(proposal: str) -> bool:
        log.info("accepted: %s", proposal)
        return True

    consents = accepted if yes else accepts if asks else None
    draft = resume_experiment(file, ask=ask if asks else None, accepts=consents)
    show(draft, output_format, details=details)
    if draft.questions or draft.proposals:
        raise typer.Exit(OPEN_QUESTIONS)


@command("when each kind of finding is there, and what is in use")
def inspect(
    log: Annotated["Path | str", Option("Experiment file, or a log that is recognised, such as a YARP dumper folder.")],
    *,
    log_format: Annotated[
        str | None, Option("Format of a log, such as ros or hdf5, as in [recording]. Default: by what is there.")
    ] = None,
    recording: Annotated[
        Collection[str],
        Option("What a log lacks, as moment_about=flange or payload_kg=0; repeat for more.", "--recording"),
    ] = (),
    calibration: Annotated[
        "Path | str | None",
        Option("Calibration that reads its sensor. Default: the prior, or as logged.", "--calibration", "-c"),
    ] = None,
    sensors: Annotated[Collection[str], SENSORS] = (),
    progress: Annotated["Progress", Option("Called with a line for people as work goes on.")] = lambda _: None,
) -> "Inspection":
    """Find faults of a log, its experiment file and the URDF.

    Example: forcetorque inspect experiment.toml

    Python: `experiment.inspect()`; of a log without an experiment `inspection.inspect_log("log.csv")`

    Returns:
        What the log or the recording of the experiment holds, and what is wrong with it.
    """
    from forcetorque.inspection.inspect import inspect_log

    return inspect_log(
        log, log_format=log_format, recording=recording, calibration=calibration, sensors=sensors, progress=progress
    )
