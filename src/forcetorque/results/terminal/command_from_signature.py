# SPDX-License-Identifier: BSD-3-Clause
"""The command of an analysis, made of its signature: options, input files, sensors in turn, figure, exit code."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property, partial
from inspect import Parameter, Signature, signature
from pathlib import Path
from types import GenericAlias
from typing import TYPE_CHECKING, Annotated, Any, cast, get_args, get_origin

import typer

from forcetorque.base.errors import ForceTorqueError
from forcetorque.base.lazy import named
from forcetorque.base.output_file import STANDARD_OUTPUT, declare_outputs
from forcetorque.results.command import Command, Option, Saved, command_of
from forcetorque.results.terminal.command_output import (
    Format,
    drawn_to,
    end_with,
    refuse_ending,
    refuse_figure,
    refuse_output_folder,
    refuse_standard_output,
    refuse_two_on_standard_output,
    show,
    show_warnings,
    start_logging,
)
from forcetorque.results.terminal.options import (
    DetailsOption,
    ExperimentArgument,
    ExperimentsArgument,
    ForceOption,
    FormatOption,
)

if TYPE_CHECKING:
    from logging import Logger

    from forcetorque.experiment.calibration.calibration_file import Calibration
    from forcetorque.experiment.experiment import Experiment
    from forcetorque.results.result import DrawnResult, Result

_RUN, _RUNS, _EXPERIMENT = "SensorRun", "Runs", "Experiment"
_CALIBRATIONS, _ONE_CALIBRATION, _OTHERS = "Calibrations", "OneCalibration", "OtherCalibrations"
_PROGRESS = "Progress"
_FILLED = (_RUN, _RUNS, _EXPERIMENT, _CALIBRATIONS, _ONE_CALIBRATION, _OTHERS, _PROGRESS)
"""Types of parameters that the command line fills from files, or with its log."""


def command_function(function: Callable[..., Any]) -> Callable[..., Result | None]:
    """Make what typer takes as a command.

    Args:
        function: An analysis with its options, or a command that parses by itself.

    Returns:
        A function whose signature has arguments and options, which returns what it shows; the command itself if it
        parses by itself.
    """
    offered = command_of(function)
    return function if offered is None else _Analysis(function, offered).command()


@dataclass(frozen=True)
class _Analysis:
    """An analysis, and how it is typed."""

    function: Callable[..., Result]
    offered: Command

    @cached_property
    def parameters(self) -> Mapping[str, Parameter]:
        """Its parameters, with types as text where they are quoted."""
        return signature(self.function).parameters

    @cached_property
    def named_by_kind(self) -> Mapping[str, str]:
        """Names of the parameters that are filled from files, by their type."""
        return {_kind(parameter): name for name, parameter in self.parameters.items()}

    @property
    def reads_experiments(self) -> bool:
        """Whether experiment files are typed."""
        return not {_RUN, _RUNS, _EXPERIMENT}.isdisjoint(self.named_by_kind)

    def command(self) -> Callable[..., Result]:
        """The command, which typer parses by its signature."""
        run: Any = partial(self.run)  # a method takes no signature
        typed = [
            *self.typed(),
            _typed("details", DetailsOption, False),
            _typed("output_format", FormatOption, Format.TABLE),
        ]
        typed.sort(key=lambda parameter: parameter.default is not Parameter.empty)
        run.__signature__ = Signature(typed)
        run.__annotations__ = {parameter.name: parameter.annotation for parameter in typed}
        run.__name__ = self.function.__name__
        run.__doc__ = (self.function.__doc__ or "").partition("\n\nArgs:")[0]
        command: Callable[..., Result] = run
        return command

    def typed(self) -> Iterator[Parameter]:
        """What is typed: files, sensors and options."""
        for name, parameter in self.parameters.items():
            option, kind = self.offered.options.get(name), _kind(parameter)
            if kind in (_RUN, _EXPERIMENT):
                yield _typed("experiment", ExperimentArgument)
            elif kind == _RUNS:
                yield _typed("experiments", ExperimentsArgument)
            elif option is not None and kind in (_CALIBRATIONS, _ONE_CALIBRATION):
                yield _option("calibration", list[Path], option, ("--calibration", "-c"), required=option.required)
            elif option is not None and kind not in (_OTHERS, _PROGRESS) and not option.python_only:
                yield _plain(name, parameter, option)
            if kind in (_RUN, _RUNS) and option is not None and option.flags:
                default = "all" if option.all_sensors else "those of the calibrations, else all"
                yield _option(
                    "sensor", list[str], Option(f"Sensor of the experiment. Default: {default}."), option.flags
                )
        for saved in self.offered.saved:
            yield _option(_name(saved), Path, Option(saved.help), saved.flags, required=saved.required)
        if self.offered.figure is not None:
            yield _option("figure", Path, Option(f"PNG, SVG or PDF of {self.offered.figure}."), ("--figure",))
        if self.offered.saved:
            yield _typed("force", ForceOption, False)

    def run(self, **given: Any) -> Result:
        """Compute, draw and show the result.

        Args:
            **given: What was typed, by name.

        Returns:
            The result.

        Raises:
            typer.Exit: With that of the result if it is not as it should be, with code 2 if it lacks a sensor.
        """
        log, figure = start_logging(), given.get("figure")
        self.refuse_outputs(given)
        refusals: list[ForceTorqueError] = []
        result = self.result(given, log, refusals)
        for saved in self.offered.saved:
            if given[_name(saved)] is not None:
                result = _written(result, saved, given[_name(saved)])
        if figure is not None:
            result = drawn_to(cast("DrawnResult", result), figure)
        if any(given[_name(saved)] == STANDARD_OUTPUT for saved in self.offered.saved):  # the file itself went there
            show_warnings(result)
        else:
            files = given.get("experiments") or ([given["experiment"]] if self.reads_experiments else [])
            show(result, given["output_format"], details=given["details"], experiments=files, refusals=refusals)
        end_with(refusals)
        if result.exit_code:
            raise typer.Exit(result.exit_code)
        return result

    def refuse_outputs(self, given: Mapping[str, Any]) -> None:
        """Refuse folders, files and a figure that cannot be written, before anything is computed."""
        for name, option in self.offered.options.items():
            if option.folder and given[name] is not None:
                refuse_output_folder(given[name], option.flags[0])
        for saved in self.offered.saved:
            if saved.standard_output:
                refuse_two_on_standard_output(given[_name(saved)], given["output_format"])
            else:
                refuse_standard_output(saved.flags[0], given[_name(saved)])
            refuse_ending(saved.flags[0], given[_name(saved)], saved.endings)
        refuse_figure(given.get("figure"), force=given.get("force"))
        declare_outputs(*(given[_name(saved)] for saved in self.offered.saved), force=given.get("force"))

    def result(self, given: Mapping[str, Any], log: Logger, refusals: list[ForceTorqueError]) -> Result:
        """Read what is named, and compute; sensors that are refused beside others are added to the refusals."""
        from forcetorque.experiment.named_files import stated_in
        from forcetorque.results.terminal.command_inputs import read_experiment

        files, options = self.read(given, log)
        if _EXPERIMENT in self.named_by_kind:
            content = read_experiment(given["experiment"], log)
            with stated_in(str(given["experiment"])):
                return self.function(content, **options)
        if _RUN in self.named_by_kind or _RUNS in self.named_by_kind:
            results = []
            for compute in self.by_sensor(given, options, log):
                try:
                    results.append(compute())
                except ForceTorqueError as error:
                    refusals.append(error)
            if not results:
                raise refusals[0]
            return type(results[0]).together(results)
        first = next(iter(self.parameters))
        file = options.get(first)
        if isinstance(file, Path) and not self.offered.options[first].flags and _PROGRESS not in self.named_by_kind:
            log.info("reading %s", file)
        return self.function(*files, **options)

    def read(self, given: Mapping[str, Any], log: Logger) -> tuple[Sequence[Any], dict[str, Any]]:
        """Positional arguments, and options, both without experiments and calibrations."""
        files: list[Any] = []
        options: dict[str, Any] = {}
        for name, parameter in self.parameters.items():
            if _kind(parameter) == _PROGRESS:
                options[name] = log.info
            value, option = given.get(name), self.offered.options.get(name)
            if value is None or option is None or _kind(parameter) in _FILLED:
                continue
            if option.reads is not None:
                value = (named(option.reads) if isinstance(option.reads, str) else option.reads)(value)
            elif option.choices:
                value = value.value
            if parameter.kind is Parameter.VAR_POSITIONAL:
                files += value
            else:
                options[name] = value
        return files, options

    def by_sensor(
        self, given: Mapping[str, Any], options: dict[str, Any], log: Logger
    ) -> Iterator[Callable[[], Result]]:
        """Computations of the sensors that are named, else of those of the calibrations, else of all."""
        from forcetorque.experiment.applicability import by_sensor, one_per_sensor
        from forcetorque.results.terminal.command_inputs import (
            read_calibrations,
            read_experiment,
            read_experiments,
            refuse_left_out,
            sensors_named,
        )

        calibrations = read_calibrations(given.get("calibration"), given.get("sensor"))
        if _RUNS in self.named_by_kind:
            contents = read_experiments(given["experiments"], log)
        else:
            contents = {given["experiment"]: read_experiment(given["experiment"], log)}
        content = next(iter(contents.values()))
        groups = by_sensor(content, calibrations)
        if _ONE_CALIBRATION in self.named_by_kind:
            one_per_sensor(content, calibrations)
        option = next(
            self.offered.options[self.named_by_kind[kind]] for kind in (_RUN, _RUNS) if kind in self.named_by_kind
        )
        sensors = sensors_named(content, given.get("sensor") or (() if option.all_sensors else groups))
        if _OTHERS not in self.named_by_kind:
            refuse_left_out(content, sensors, calibrations)
        for sensor in sensors:
            yield partial(self.of_sensor, sensor.name, contents, options | self.calibrations(groups, sensor.name), log)

    def of_sensor(
        self, sensor: str, contents: Mapping[Path, Experiment], options: Mapping[str, Any], log: Logger
    ) -> Result:
        """Result of one sensor; errors name file and sensor."""
        from forcetorque.experiment.named_files import stated_in
        from forcetorque.results.terminal.command_inputs import campaign_of

        file, where, subject = next(iter(contents)), f"sensor {sensor!r}", campaign_of(contents, sensor)
        if _RUN in self.named_by_kind:
            with stated_in(str(file)):
                return self.function(*subject.runs, **options)
        log.info(where)
        with _located(f"{file}: {where}" if len(contents) == 1 else where, options):
            return self.function(subject, **options)

    def calibrations(self, groups: Mapping[str, Mapping[str, Calibration]], sensor: str) -> dict[str, Any]:
        """Parameters with the calibrations of a sensor, and with those of the others."""
        rest = {file: one for other, group in groups.items() if other != sensor for file, one in group.items()}
        own = groups.get(sensor, {})
        values = {_CALIBRATIONS: own, _ONE_CALIBRATION: own or None, _OTHERS: rest}
        return {self.named_by_kind[kind]: value for kind, value in values.items() if kind in self.named_by_kind}


def _written(result: Any, saved: Saved, path: Path) -> Result:
    """The result, with the name of the file that it is saved in, where it has a field for that."""
    if saved.function is None:
        result.save(path)
        return result.model_copy(update={"file": str(path)})
    named(saved.function)(result, path)
    field = f"{_name(saved)}_file"
    return result.model_copy(update={field: str(path)}) if field in type(result).model_fields else result


@contextmanager
def _located(where: str, options: Mapping[str, Any]) -> Iterator[None]:
    """Put file and sensor in front of errors, but of those that begin with another file that is an option."""
    from forcetorque.experiment.named_files import stated_in

    try:
        yield
    except ForceTorqueError as error:
        if str(error).startswith(tuple(f"{file}: " for file in options.values() if isinstance(file, Path))):
            raise
        with stated_in(where):
            raise


def _kind(parameter: Parameter) -> str:
    """Type of a parameter as text, without `| None`; empty for one that is typed as it is."""
    return parameter.annotation.removesuffix(" | None") if isinstance(parameter.annotation, str) else ""


def _plain(name: str, parameter: Parameter, option: Option) -> Parameter:
    """An argument or option as it is typed."""
    kind, flags = option.typed or _typed_kind(parameter), option.flags
    required = parameter.default is Parameter.empty
    if not flags and parameter.kind is not Parameter.KEYWORD_ONLY:
        argument = typer.Argument(help=option.help)
        return _typed(name, Annotated[kind if required else kind | None, argument], *(() if required else (None,)))
    default = None if required or parameter.default == () or option.reads else parameter.default
    return _option(
        name,
        kind,
        option,
        flags or (f"--{name.replace('_', '-')}",),
        required=required or option.required,
        default=default,
    )


def _typed_kind(parameter: Parameter) -> Any:
    """Type on the command line: a file where a file may be given, a list where there may be several."""
    kind = parameter.annotation
    if re.search(r"\bPath\b", str(kind)):
        kind = Path
    elif get_origin(kind) in (Sequence, Collection):
        return GenericAlias(list, get_args(kind))
    return GenericAlias(list, (kind,)) if parameter.kind is Parameter.VAR_POSITIONAL else kind


def _option(
    name: str, kind: Any, option: Option, flags: Sequence[str], *, required: bool = False, default: Any = None
) -> Parameter:
    several = " Repeat for more." if get_origin(kind) is list else ""
    if option.choices:
        choice: Any = StrEnum("choice", list(option.choices))  # type: ignore[misc]  # mypy wants the words written here
        kind, default = choice, None if default is None else choice(default)
    declared = typer.Option(*flags, help=option.help + several)
    if required:
        return _typed(name, Annotated[kind, declared])
    return _typed(name, Annotated[kind | None if default is None else kind, declared], default)


def _name(saved: Saved) -> str:
    """The name by which the path of a file is given."""
    return saved.flags[0].removeprefix("--").replace("-", "_")


def _typed(name: str, kind: Any, default: Any = Parameter.empty) -> Parameter:
    return Parameter(name, Parameter.POSITIONAL_OR_KEYWORD, default=default, annotation=kind)
