# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque run`: from logs to sensors that can be used, with one command."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from forcetorque.base.errors import ExperimentError
from forcetorque.results.answer import typed
from forcetorque.results.terminal.command_output import Format, refuse_standard_output, show, start_logging
from forcetorque.results.terminal.options import (
    ColumnNamesOption,
    DetailsOption,
    ForceOption,
    FormatOption,
    LoadsOption,
    SensorOption,
    between_commas,
)

if TYPE_CHECKING:
    from forcetorque.app.run.result import WholeRun


def run(
    files: Annotated[
        list[Path],
        typer.Argument(help="Experiment files (TOML) of the same sensors, workbench files, or a log without a file."),
    ],
    output: Annotated[
        Path, typer.Option("--output", "-o", help="Folder for calibrations, report and exported files.")
    ] = Path("forcetorque_run"),
    sensor: SensorOption = None,
    urdf: Annotated[
        Path | None,
        typer.Option("--urdf", help="URDF file or name of the robot, for a log without an experiment file."),
    ] = None,
    matrices: Annotated[
        Path | None,
        typer.Option("--matrices", help="Folder of matrix files of the sensors, for a log without an experiment file."),
    ] = None,
    column_names: ColumnNamesOption = None,
    loads: LoadsOption = None,
    override: Annotated[
        str | None,
        typer.Option(
            "--override", help="Reason to go on where a stage would stop; written into calibrations and report."
        ),
    ] = None,
    no_input: Annotated[
        bool, typer.Option("--no-input", help="Ask nothing: list what is to be filled in, and stop with exit code 4.")
    ] = False,
    no_report: Annotated[bool, typer.Option("--no-report", help="Draw no report, which takes longest.")] = False,
    force: ForceOption = False,
    details: DetailsOption = False,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Go the whole way: inspect, check, calibrate, evaluate, report, export.

    Example: forcetorque run experiment.toml -o results

    Exit codes: 0 usable, 1 not or not yet usable, 2 error, 3 stopped by a stage, 4 questions open.

    Python: `experiment.run("results")`, of files `forcetorque.run("experiment.toml", "results")`
    """
    from forcetorque.inspection.draft.questions import open_questions

    log = start_logging()
    refuse_standard_output("--output", output)
    if _state_experiments(files):
        _refuse_beside(
            files[0], {"--urdf": urdf, "--matrices": matrices, "--column-names": column_names, "--loads": loads}
        )
        open_files = [file for file in files if file.is_file() and open_questions(file)]
    else:
        files = open_files = [
            _begun(files, output, urdf, sensor or (), matrices, between_commas(column_names), loads, force=force)
        ]
    for file in open_files:
        again = typed(
            "run", *map(str, files), "-o", str(output), *(w for name in sensor or () for w in ("--sensor", name))
        )
        if (unanswered := _unanswered(file, again, no_input=no_input)) is not None:
            _end(unanswered, output_format, details=details, files=files)
    from forcetorque.app.run.run import run as go  # here because open questions need none of its stages

    result = go(
        files,
        output,
        sensors=sensor,
        override=override,
        with_report=not no_report,
        force=force,
        progress=log.info,
    )
    _end(result, output_format, details=details, files=files)


def _end(result: WholeRun, output_format: Format, *, details: bool, files: list[Path]) -> None:
    show(result, output_format, details=details, experiments=files)
    raise typer.Exit(int(result.exit_code))


def _state_experiments(files: list[Path]) -> bool:
    """Whether the files are experiment files; else they are logs. Some of each are refused."""
    stated = [path.suffix.lower() == ".toml" for path in files]
    if any(stated) and not all(stated):
        raise ExperimentError(
            f"{files[stated.index(False)]}: expected experiment files alone, or logs alone to begin one, got both"
        )
    return all(stated)


def _refuse_beside(file: Path, options: Mapping[str, object]) -> None:
    if given := _given(options):
        raise ExperimentError(f"{file}: expected no option of a log beside an experiment file, got {', '.join(given)}")


def _given(options: Mapping[str, object]) -> list[str]:
    return [name for name, value in options.items() if value is not None]


def _begun(
    logs: list[Path],
    output: Path,
    urdf: Path | None,
    sensors: Sequence[str],
    matrices: Path | None,
    column_names: Sequence[Sequence[str]],
    loads: str | None,
    *,
    force: bool,
) -> Path:
    """The experiment file of logs, in the folder of results; one that is there already is taken up again."""
    from forcetorque.inspection.draft.draft import draft_experiment
    from forcetorque.inspection.draft.questions import logs_left_out, logs_of

    file = output / "experiment.toml"
    options = {"--urdf": urdf, "--matrices": matrices, "--column-names": column_names or None, "--loads": loads}
    if file.exists():
        given, named = {log.resolve() for log in logs}, logs_of(file)
        # a folder is in the file beside its tables, or they beside it
        others = [one for one in named if not any(one in (log, *log.parents) or log in one.parents for log in given)]
        if others or given - named - logs_left_out(file):
            raise ExperimentError(
                f"{file}: was begun of another log than {', '.join(map(str, logs))}, or changed since: name the file "
                "itself to go on with it, or another folder by --output"
            )
        if stated := _given(options):
            raise ExperimentError(
                f"{file}: was begun already, so that {', '.join(stated)} would change nothing; leave it out to go on "
                "with the file, or name another folder by --output"
            )
        start_logging().info("going on with %s", file)
        return file
    output.mkdir(parents=True, exist_ok=True)
    draft = draft_experiment(
        logs, file, urdf=urdf, sensors=sensors, matrices=matrices, column_names=column_names, loads=loads, force=force
    )
    for sentence in draft.notes:
        start_logging().info("%s", sentence)
    if draft.lacks_sensor:
        raise ExperimentError(
            f"{', '.join(map(str, logs))}: expected a wrench or raw samples of a force-torque sensor, got none; name "
            "its columns by --column-names where the log has no headings; forcetorque payload weighs the load of a "
            f"Franka arm by its joint torques{''.join(f'; {one}' for one in draft.thermometers)}"
        )
    return file


def _unanswered(file: Path, again: str, *, no_input: bool) -> WholeRun | None:
    """Ask what only a person can answer, then for proposals; what comes out if something stays open, else None."""
    from forcetorque.app.run.result import Stage, WholeRun
    from forcetorque.inspection.draft.questions import resume_experiment
    from forcetorque.results.terminal.options import accepts, ask, is_terminal

    asks = is_terminal() and not no_input
    draft = resume_experiment(file, ask=ask if asks else None, accepts=accepts if asks else None)
    listed = tuple(f"line {one.line}, {one.key}: {one.question}" for one in draft.questions)
    if listed:
        text = f"{len(listed)} question(s) are open, the first: {listed[0]}"
        remedy = f'put the answers in place of "?" in {file}'
        command = again if draft.has_sensor else typed("init", "--resume", str(file))
    elif blocking := [one for one in draft.proposals if one.line is None or not asks]:
        listed = tuple(one.proposal for one in blocking)
        text = f"{len(listed)} proposal(s) are open, the first: {listed[0]}"
        remedy = f"accept or decline each in a terminal; forcetorque {again} declines them all"
        command = typed("init", "--resume", str(file))
    else:
        return None
    stage = Stage(name="init", outcome="stopped", seconds=0.0, text=text, remedy=remedy, command=command)
    return WholeRun(experiment=str(file), stages=(stage,), questions=listed, files=(str(file),))
