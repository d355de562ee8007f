# SPDX-License-Identifier: BSD-3-Clause
"""`--view FILE` of commands with a result: what the viewer shows of the same files, with the verdicts of the result."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import wraps
from inspect import Parameter, cleandoc, signature
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Final, get_type_hints

import typer

from forcetorque.base.errors import ExperimentError, ForceTorqueError

if TYPE_CHECKING:
    from forcetorque.base.progress import Progress
    from forcetorque.experiment.experiment import Experiment
    from forcetorque.results.result import Result
    from forcetorque.viewer.scene_builder import BuiltScene

COMMANDS: Final = ("estimate", "evaluate", "payload")
"""Commands that take it."""
_ENDINGS: Final = (".rrd", ".mcap", ".html")
_Option = Annotated[
    Path | None,
    typer.Option(
        "--view",
        help="File of the recording with the result for Rerun (.rrd), Foxglove and ROS 2 (.mcap) or a browser (.html); "
        "of several experiments one each, NAME.EXPERIMENT.rrd.",
    ),
]


def with_view(name: str, command: Callable[..., Result | None]) -> Callable[..., Result | None]:
    """Let a command write what the viewer shows of its experiments.

    Args:
        name: Name of the command.
        command: The command, with `experiments` and `calibration`, which returns its result.

    Returns:
        The command with the option `--view` if it is one of `COMMANDS`, else as it is.
    """
    if name not in COMMANDS:
        return command
    hints = get_type_hints(command, include_extras=True)
    typed = [one.replace(annotation=hints[one.name]) for one in signature(command).parameters.values()]
    typed.append(Parameter("view", Parameter.POSITIONAL_OR_KEYWORD, default=None, annotation=_Option))

    @wraps(command)
    def run(view: Path | None = None, **given: Any) -> Result | None:
        if view is None:
            return command(**given)
        from forcetorque.base.output_file import existing_files_replaced_last
        from forcetorque.experiment.kept_experiments import kept_experiments

        files = _declared(view, given)

        def write(path: Path, experiment: Experiment | None, result: Result) -> None:
            _write(name, path, files[path], given, result, experiment)

        # estimates of many recordings let one go after the other
        one_by_one = name == "estimate" and len(files) > 1
        with existing_files_replaced_last(), kept_experiments(f"--view {view}", write if one_by_one else None) as known:
            result = command(**given)
        if result is not None and not one_by_one:
            for path in files:
                write(path, known.get(path), result)
        return result

    run.__signature__ = signature(command).replace(parameters=typed)  # type: ignore[attr-defined]
    run.__doc__ = cleandoc(command.__doc__ or "").partition("\n\nReturns:")[0]
    run.__annotations__ = {one.name: one.annotation for one in typed}
    return run


def _declared(view: Path, given: Mapping[str, Any]) -> dict[Path, Path]:
    """Files by experiment, which can be written."""
    from forcetorque.base.output_file import declare_outputs
    from forcetorque.experiment.input_files import file_of_each
    from forcetorque.viewer.view_file import require_writer, view_files

    if view.suffix.lower() not in _ENDINGS:
        raise ForceTorqueError(f"--view {view}: expected a name that ends in {', '.join(_ENDINGS)}")
    for path in given["experiments"]:
        if path.is_dir():
            raise ExperimentError(f"--view {view}: expected experiment files, whose samples it needs, got {path}")
    require_writer(view)
    files = file_of_each(given["experiments"], view)
    declare_outputs(*(one for file in files.values() for one in view_files(file)), force=given.get("force"))
    return files


def _write(
    name: str, path: Path, file: Path, given: Mapping[str, Any], result: Result, known: Experiment | None
) -> None:
    from forcetorque.results.terminal.output import start_logging
    from forcetorque.viewer.view_file import view_files, write_view

    log = start_logging()
    built = _scene(path, known, given, log.info)
    for note in built.scene.notes:
        log.info("%s", note)
    verdicts = [
        f"{name}: {answer.subject}: {answer.verdict}" + "".join(f"; {text}" for text in answer.why)
        for answer in result.answers()
    ]
    built = replace(built, scene=replace(built.scene, notes=(*verdicts, *built.scene.notes)))
    log.info("written: %s, %.1f MB", ", ".join(map(str, view_files(file))), 1e-6 * write_view(file, built))


def _scene(path: Path, known: Experiment | None, given: Mapping[str, Any], progress: Progress) -> BuiltScene:
    """What the viewer shows of an experiment, by the options of the command."""
    from forcetorque.experiment.loading import Purpose, load_experiment
    from forcetorque.payload.load_of_log import is_experiment_file
    from forcetorque.results.terminal.reading import read_calibrations
    from forcetorque.viewer.contacts import ContactOptions
    from forcetorque.viewer.scene_builder import build_scene, scene_of

    if known is not None and not is_experiment_file(path):  # a log of an arm, which has no robot and no calibration
        return build_scene(known, {}, progress=progress)
    experiment = load_experiment(path, Purpose.DISPLAY) if known is None else known
    sensors: Sequence[str] | None = given.get("sensor")
    return scene_of(
        path,
        experiment,
        read_calibrations(given.get("calibration"), sensors),
        sensors=sensors,
        progress=progress,
        contact_options=ContactOptions(
            contacts=given.get("contacts"), length_scale=given.get("length_scale"), offset=given.get("offset")
        ),
    )
