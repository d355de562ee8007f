# SPDX-License-Identifier: BSD-3-Clause
"""An analysis whose options are written once, in its signature: the command line and the Python objects take them.

A module of such analyses imports what computes inside its functions, so that `--help` stays quick. Types that are not
imported are quoted; `from __future__ import annotations` would quote the options too.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import wraps
from inspect import cleandoc
from textwrap import fill
from typing import TYPE_CHECKING, Annotated, Any, ForwardRef, ParamSpec, TypeVar, get_origin

if TYPE_CHECKING:
    from forcetorque.results.result import Result

Parameters = ParamSpec("Parameters")
Returned = TypeVar("Returned", bound="Result")

_LINE = 120
_DETAILS = ("Returns", "Raises", "References")


class Option:
    """Help of a parameter of an analysis, and how it is typed; the metadata of `Annotated`."""

    __slots__ = ("all_sensors", "choices", "flags", "folder", "help", "python_only", "reads", "required", "typed")

    def __init__(
        self,
        help_text: str,
        *flags: str,
        required: bool = False,
        choices: tuple[str, ...] = (),
        typed: Any = None,
        reads: str | Callable[[Any], Any] | None = None,
        folder: bool = False,
        all_sensors: bool = False,
        python_only: bool = False,
    ) -> None:
        """Describe a parameter.

        Args:
            help_text: What it is, for the help of the command and the docstring.
            flags: Its flags. Without any, a keyword-only parameter has that of its name, another is an argument.
            required: Whether the command demands it, although the analysis has a default.
            choices: Words that it may be; any if empty.
            typed: Type that the command line has in place of that of the parameter.
            reads: Function, or `module:name` of one, that makes the parameter of what is typed. The default of the
                parameter is then stated in its help.
            folder: Whether it is a folder that the analysis makes, which must not be there yet.
            all_sensors: Whether the command takes all sensors where none is named, also beside calibrations.
            python_only: Whether the command line does not have it.
        """
        self.help, self.flags = help_text, flags
        self.required, self.choices = required, choices
        self.typed, self.reads = typed, reads
        self.folder, self.all_sensors, self.python_only = folder, all_sensors, python_only


SENSORS = Option("Sensor of the experiment. Default: all.", "--sensor")
"""Names of sensors, a `Collection[str]`, of an analysis that goes over sensors by itself."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Saved:
    """A file that a command writes from its result."""

    flags: tuple[str, ...]
    """Flags of its option, the long one first."""
    help: str
    """What it is."""
    function: str | None = None
    """Function of the result and the path that writes it, as `module:name` or `module:Class.name`; if None it is `save`
    of the result, whose `file` then names it."""
    endings: tuple[str, ...] = ()
    """How its name may end; any if empty."""
    required: bool = False
    """Whether the command demands it."""
    standard_output: bool = False
    """Whether `-` writes it to standard output, in place of the result."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Command:
    """What the command line needs to know of an analysis."""

    options: Mapping[str, Option]
    """By name of the parameter."""
    figure: str | None
    """What its figure shows, a `DrawnResult.figure`; None if it has none."""
    saved: tuple[Saved, ...] = ()
    """Files that are written from its result."""


def command(
    figure: str | None = None,
    *saved: Saved,
) -> Callable[[Callable[Parameters, Returned]], Callable[Parameters, Returned]]:
    """Offer an analysis as a command of its name.

    Its docstring has a sentence, an example and the line from Python; its arguments are added from their options.

    Args:
        figure: What the figure of the result, a `DrawnResult`, shows, for the help of `--figure`; None for none.
        saved: Files that the command writes from the result.

    Returns:
        A decorator. The result of the analysis states what experiment files added to their logs and what is left out.
    """

    def offer(analysis: Callable[Parameters, Returned]) -> Callable[Parameters, Returned]:
        hints: Mapping[str, Any] = analysis.__annotations__
        options = {name: hint.__metadata__[0] for name, hint in hints.items() if _has_option(hint)}
        analysis.__annotations__ = {name: _plain(hint) for name, hint in hints.items()}
        analysis.__doc__ = _with_arguments(cleandoc(analysis.__doc__ or ""), options)

        @wraps(analysis)
        def noted(*args: Parameters.args, **named: Parameters.kwargs) -> Returned:
            from forcetorque.experiment.recording_notes import with_notes

            return with_notes(analysis(*args, **named), (*args, *named.values()))

        noted.command = Command(options=options, figure=figure, saved=saved)  # type: ignore[attr-defined]
        return noted

    return offer


def command_of(analysis: Any) -> Command | None:
    """Give what the command line needs to know.

    Args:
        analysis: A function.

    Returns:
        Its options and figure; None if it is no analysis that `command` offers.
    """
    offered = getattr(analysis, "command", None)
    return offered if isinstance(offered, Command) else None


def _has_option(hint: Any) -> bool:
    return get_origin(hint) is Annotated


def _plain(hint: Any) -> Any:
    """The type without its option, as text where it is quoted."""
    kind = hint.__origin__ if _has_option(hint) else hint
    return kind.__forward_arg__ if isinstance(kind, ForwardRef) else kind


def _with_arguments(text: str, options: Mapping[str, Option]) -> str:
    head, *details = _sections(text)
    lines = [
        fill(f"{name}: {option.help}", _LINE - 4, initial_indent=4 * " ", subsequent_indent=8 * " ")
        for name, option in options.items()
    ]
    return "\n\n".join([head, "\n".join(["Args:", *lines]), *details])


def _sections(text: str) -> Iterable[str]:
    """The docstring before its first section, and the sections."""
    places = sorted(place for name in _DETAILS if (place := text.find(f"\n\n{name}:")) >= 0)
    ends = [*places, len(text)]
    return (text[start:end].strip("\n") for start, end in zip([0, *places], ends, strict=True))
