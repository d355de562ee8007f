# SPDX-License-Identifier: BSD-3-Clause
"""Commands as the program has them: they take datasets, and `--view` shows a result or what `live` corrects."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial, update_wrapper, wraps
from inspect import Parameter, cleandoc, signature
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Final, get_args, get_origin, get_type_hints

import typer
from typer.models import ArgumentInfo

from forcetorque.base.errors import ExperimentError, ForceTorqueError

if TYPE_CHECKING:
    from forcetorque.base.progress import Progress
    from forcetorque.experiment.experiment import Experiment
    from forcetorque.fleet.analyses_of_dataset import DatasetLogs
    from forcetorque.results.result import Result
    from forcetorque.viewer.scene_builder import BuiltScene


VIEWED: Final = ("estimate", "evaluate", "payload")
"""Commands with `--view`."""
_ENDINGS: Final = (".rrd", ".mcap", ".html")
_View = Annotated[
    Path | None,
    typer.Option(
        "--view",
        help="File of the recording with the result for Rerun (.rrd), Foxglove and ROS 2 (.mcap) or a browser (.html); "
        "of several experiments one each, NAME.EXPERIMENT.rrd.",
    ),
]


def with_datasets_and_view(name: str, command: Callable[..., Result | None]) -> Callable[..., Result | None]:
    """Let a command take a dataset, and write what the viewer shows of its experiments.

    Args:
        name: Name of the command.
        command: The command, which returns its result; one of `VIEWED` has `experiments` and `calibration`.

    Returns:
        The command, with the option `--view` if it is one of `VIEWED`.
    """
    arguments = _arguments(command)

    @wraps(command)
    def run(**given: Any) -> Result | None:
        view = given.pop("view", None) if name in VIEWED else None
        if view is not None:  # of experiment files, no dataset
            return _run_with_view(name, command, view, given)
        replaced = _logs_of_dataset(name, arguments, given)
        return None if replaced is None else command(**replaced)

    if name in VIEWED:
        typed = [
            *_typed_parameters(command),
            Parameter("view", Parameter.POSITIONAL_OR_KEYWORD, default=None, annotation=_View),
        ]
        _declare(run, command, typed)
        run.__doc__ = cleandoc(command.__doc__ or "").partition("\n\nReturns:")[0]
    return run


def _logs_of_dataset(name: str, arguments: Sequence[str], given: Mapping[str, Any]) -> Mapping[str, Any] | None:
    """What is typed, with logs in the place of a dataset; None where the command was run on the dataset itself."""
    inputs = [path for argument in arguments for path in _paths(given[argument])]
    folders = [path for path in inputs if path.is_dir()]
    if not folders:
        return given
    from forcetorque.fleet.analyses_of_dataset import run_from_dataset
    from forcetorque.fleet.parquet_dataset import is_dataset

    datasets = [path for path in folders if is_dataset(path)]
    if not datasets:
        return given
    if len(inputs) > 1:
        raise ExperimentError(
            f"{datasets[0]}: expected a dataset alone, got it beside other files; add these to it with "
            "`forcetorque fleet add`"
        )
    logs = run_from_dataset(name, datasets[0], given)
    return None if logs is None else {**given, **_in_place_of(datasets[0], logs, given, arguments)}


def _in_place_of(
    dataset: Path, logs: DatasetLogs, given: Mapping[str, Any], arguments: Sequence[str]
) -> dict[str, Any]:
    """What is typed, with the experiment files of a dataset in its place: all, or the last where there can be one."""
    files, sensors = logs
    values: dict[str, Any] = {"sensor": sensors} if "sensor" in given and sensors else {}
    for argument in arguments:
        value = given[argument]
        if isinstance(value, list | tuple) and dataset in value:
            values[argument] = type(value)(files)
        elif value == dataset:
            values[argument] = files[-1]
    if "sensor" in values and not isinstance(given["sensor"], list | tuple):
        (values["sensor"],) = sensors
    return values


def _arguments(command: Callable[..., Any]) -> list[str]:
    """Names of what is typed without a flag."""
    hints = get_type_hints(command, include_extras=True)
    return [
        name
        for name, hint in hints.items()
        if get_origin(hint) is Annotated and any(isinstance(note, ArgumentInfo) for note in get_args(hint))
    ]


def _paths(value: Any) -> list[Path]:
    values = value if isinstance(value, list | tuple) else [value]
    return [one for one in values if isinstance(one, Path)]


def _run_with_view(
    name: str, command: Callable[..., Result | None], view: Path, given: Mapping[str, Any]
) -> Result | None:
    """Run a command, and write what the viewer shows of its experiments."""
    from forcetorque.base.output_file import existing_files_replaced_last
    from forcetorque.experiment.loading import kept_experiments
    from forcetorque.viewer.posture import sample_count
    from forcetorque.viewer.view_file import require_room

    files = _declared(view, given)

    def write(path: Path, experiment: Experiment | None, result: Result) -> None:
        _write(name, path, files[path], given, result, experiment)

    def accept(path: Path, experiment: Experiment) -> None:
        if path in files:
            require_room(files[path], sample_count(experiment, given.get("sensor")))

    # estimates of many recordings let one go after the other
    one_by_one = name == "estimate" and len(files) > 1
    finished = write if one_by_one else None
    with existing_files_replaced_last(), kept_experiments(f"--view {view}", accept, finished) as known:
        result = command(**given)
    if result is not None and not one_by_one:
        for path in files:
            write(path, known.get(path), result)
    return result


def _declared(view: Path, given: Mapping[str, Any]) -> dict[Path, Path]:
    """Files by experiment, which can be written."""
    from forcetorque.base.output_file import declare_outputs
    from forcetorque.experiment.named_files import file_of_each
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
    from forcetorque.results.terminal.command_output import start_logging
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
    from forcetorque.payload.log_without_experiment import is_experiment_file
    from forcetorque.results.terminal.command_inputs import read_calibrations
    from forcetorque.viewer.contact_wrenches import ContactOptions
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


LIVE: Final = "live"
_WINDOW_S: Final = 30.0


def with_live_view(name: str, command: Callable[..., Any]) -> Callable[..., Any]:
    """Let `live` show what it does in the browser.

    Args:
        name: Name of the command.
        command: The command, which takes as `page` what serves a run.

    Returns:
        The command with the options of the page if it is `live`, else as it is.
    """
    if name != LIVE:
        return command

    def run(
        view: Annotated[
            bool, typer.Option("--view", help="Show it in the browser, on a page of this machine.")
        ] = False,
        view_s: Annotated[
            float | None, typer.Option("--view-s", help="Time that the page shows, s. Default: 30.")
        ] = None,
        port: Annotated[
            int | None, typer.Option("--port", help="Port of 127.0.0.1 for the page. Default: any that is free.")
        ] = None,
        no_browser: Annotated[bool, typer.Option("--no-browser", help="Print its address and open nothing.")] = False,
        mesh_dir: Annotated[
            list[Path] | None, typer.Option("--mesh-dir", help="Folder that holds the packages of meshes.")
        ] = None,
        **given: Any,
    ) -> Any:
        stated = {"--view-s": view_s, "--port": port, "--no-browser": no_browser or None, "--mesh-dir": mesh_dir}
        useless = [option for option, value in stated.items() if value is not None]
        if view:
            from forcetorque.viewer.live_page import live_page

            given["page"] = partial(
                live_page,
                window_s=_WINDOW_S if view_s is None else view_s,
                port=port or 0,
                mesh_folders=mesh_dir or (),
                opened=partial(_show_address, open_browser=not no_browser),
            )
        elif useless:
            raise ForceTorqueError(f"{useless[0]} is of the page that --view shows; expected --view too, got none")
        return command(**given)

    typed = [one for one in _typed_parameters(command) if one.name != "page"]
    typed += [one for one in _typed_parameters(run) if one.kind is not Parameter.VAR_KEYWORD]
    update_wrapper(run, command)
    _declare(run, command, typed)
    return run


def _declare(run: Callable[..., Any], command: Callable[..., Any], typed: Sequence[Parameter]) -> None:
    """Give what wraps a command these parameters, by which it is parsed."""
    run.__signature__ = signature(command).replace(parameters=typed)  # type: ignore[attr-defined]
    run.__annotations__ = {one.name: one.annotation for one in typed}


def _typed_parameters(function: Callable[..., Any]) -> list[Parameter]:
    hints = get_type_hints(function, include_extras=True)
    return [one.replace(annotation=hints[one.name]) for one in signature(function).parameters.values()]


def _show_address(url: str, *, open_browser: bool) -> None:
    from forcetorque.results.terminal.command_output import start_logging
    from forcetorque.viewer.page import open_in_browser

    log = start_logging()
    log.info("page: %s", url)
    if open_browser and not open_in_browser(url):
        log.warning("no browser could be opened; open the address yourself")
