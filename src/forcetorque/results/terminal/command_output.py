# SPDX-License-Identifier: BSD-3-Clause
"""Where results, figures and messages go: results to standard output, everything else to standard error."""

from __future__ import annotations

import codecs
import logging
import os
import shlex
import sys
from collections.abc import Collection, Sequence
from contextvars import ContextVar
from enum import StrEnum
from glob import escape
from io import TextIOWrapper
from os.path import commonprefix
from pathlib import Path
from shutil import get_terminal_size
from typing import TYPE_CHECKING, Final, TextIO, TypeVar

import typer

from forcetorque.base.errors import ForceTorqueError
from forcetorque.base.output_file import STANDARD_OUTPUT, declare_outputs, refuse_existing

if TYPE_CHECKING:
    from forcetorque.results.result import DrawnResult, Result

_Drawn = TypeVar("_Drawn", bound="DrawnResult")

_PIPE_WIDTH = 120
"""Columns of a table that goes to a file or a pipe."""


_MOST_FILES = 4
"""Experiment files that a command lists; of more it has a pattern."""


class Format(StrEnum):
    """Form of a result on standard output."""

    TABLE = "table"
    JSON = "json"
    CSV = "csv"


TYPED: Final[ContextVar[tuple[str, ...]]] = ContextVar("typed words", default=())
"""What was typed after the name of the program."""
HELD: Final = {"held": True}
"""Extra of a message that waits for the result, to be counted with its warnings."""


class _StandardError(logging.StreamHandler[TextIO]):
    """Messages on standard error, at once but those that wait for the result."""

    def __init__(self, stream: TextIO) -> None:
        super().__init__(stream)
        self.held: list[logging.LogRecord] = []

    def emit(self, record: logging.LogRecord) -> None:
        if getattr(record, "held", False):
            self.held.append(record)
        else:
            super().emit(record)


def release_messages() -> tuple[str, ...]:
    """Take the messages that wait for the result, each once.

    Returns:
        The messages; they are not printed.
    """
    handlers = [one for one in logging.getLogger("forcetorque").handlers if isinstance(one, _StandardError)]
    messages = tuple(dict.fromkeys(record.getMessage() for handler in handlers for record in handler.held))
    for handler in handlers:
        handler.held.clear()
    return messages


def print_messages() -> None:
    """Print the messages that wait for a result, where none is shown."""
    for sentence in release_messages():
        logging.getLogger("forcetorque").warning("%s", sentence)


def start_logging() -> logging.Logger:
    """Send the library's and the command's messages to standard error.

    Returns:
        The logger of the command line.
    """
    logger = logging.getLogger("forcetorque")
    if not logger.handlers:
        handler = _StandardError(sys.stderr)
        handler.setFormatter(logging.Formatter("%(levelname)s: %(message)s"))
        logger.addHandler(handler)
        logger.setLevel(logging.INFO)
        # where its cache is and that it is built is of no use to who reads the result
        logging.getLogger("matplotlib").setLevel(logging.ERROR)
    return logger


def report_error(error: Exception) -> None:
    """Say on standard error, in one line, what was refused, below the messages that wait for a result.

    Args:
        error: A known error.
    """
    print_messages()
    sys.stderr.write("error: " + " ".join(str(error).split()) + "\n")


def end_with(refusals: Sequence[ForceTorqueError]) -> None:
    """Say what was refused, and leave with exit code 2 if anything was.

    Raises:
        typer.Exit: If there is one.
    """
    if not refusals:
        return
    print_messages()
    sys.stderr.write("".join(f"{line}\n" for line in refusal_lines(refusals)))
    raise typer.Exit(2)


def refusal_lines(refusals: Sequence[ForceTorqueError]) -> list[str]:
    """Write what was refused; a reason that an earlier one has already is not repeated.

    Returns:
        A line each: where it is, and the reason.
    """
    lines: list[str] = []
    said: set[str] = set()
    for refusal in refusals:
        words = " ".join(str(refusal).split()).split(": ")
        reasons = [": ".join(words[k:]) for k in range(len(words))]
        same = next((k for k, reason in enumerate(reasons) if k and reason in said), None)
        lines.append(f"error: {reasons[0] if same is None else ': '.join([*words[:same], 'the same'])}")
        said.update(reasons)
    return lines


def show(
    result: Result,
    output_format: Format,
    *,
    details: bool = False,
    experiments: Sequence[Path] = (),
    refusals: Sequence[ForceTorqueError] = (),
) -> None:
    """Print a result in the form that was asked for, and its warnings, each once, to standard error.

    Args:
        result: The result.
        output_format: Form.
        details: Whether people read the tables below the answer, and all warnings.
        experiments: Experiment files that were typed, for the next command.
        refusals: What `end_with` says below it, for which the answer leaves room.
    """
    if output_format is Format.TABLE:
        show_table(result, details=details, experiments=experiments, refusals=refusals)
        return
    show_warnings(result)
    if output_format is Format.JSON:
        sys.stdout.write(result.json_text() + "\n")
        return
    sys.stdout.write(result.csv_text())


def show_table(
    result: Result, *, details: bool, experiments: Sequence[Path], refusals: Sequence[ForceTorqueError] = ()
) -> None:
    """Print a result for people: the answer, then its warnings in a line each, or all details.

    Args:
        result: The result.
        details: As of `show`.
        experiments: As of `show`.
        refusals: As of `show`.
    """
    from forcetorque.results.answer import MOST_LINES, STANDARD_WIDTH, answer_text, warnings_text

    answers, columns = tuple(result.answers()), width()
    if not answers:
        show_warnings(result)
        sys.stdout.write(result.text(columns))
        return
    below = sum(-(-len(line) // columns) for line in refusal_lines(refusals))
    most = MOST_LINES + len(answers) + len(refusals) - 1 - below
    warnings: tuple[str, ...] = ()
    if not details:
        warnings = tuple(dict.fromkeys([*result.cautions(), *release_messages()]))
    room = most - 1 - bool(warnings)  # for the last line, and the count of warnings
    text = answer_text(
        answers,
        columns,
        files_text(experiments),
        files_text(experiments[:1]),
        again=_again(experiments),
        most=None if details or columns < STANDARD_WIDTH else room,
        coloured=shows_colours(sys.stdout),
    )
    sys.stdout.write(text)
    if details:
        sys.stdout.write("\n" + result.details(columns))
        show_warnings(result)
        return
    sys.stdout.flush()
    sys.stderr.write(warnings_text(warnings, columns, room - text.count("\n")))
    sys.stderr.flush()
    sys.stdout.write(f"details: {result.details_options}\n")


def shows_colours(stream: TextIO) -> bool:
    """Tell whether a stream is a terminal that shows colours.

    Returns:
        False for a file or a pipe, for a terminal without colours, and where the variable NO_COLOR is not empty.

    References:
        no-color.org.
    """
    without = os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb"
    old_console = os.name == "nt" and "WT_SESSION" not in os.environ
    return stream.isatty() and not without and not old_console


def _again(experiments: Sequence[Path]) -> str:
    """The command that was typed, with its experiment files as in any other next command."""
    from forcetorque.results.answer import EXPERIMENT, typed

    command, *others = TYPED.get() or ("",)
    return typed(command, EXPERIMENT, *(word for word in others if Path(word) not in experiments)) if command else ""


def files_text(files: Sequence[Path]) -> str:
    """Write files as they are typed in a command.

    Returns:
        All of them where they are few; of many a pattern that a shell expands to the same files, or empty where there
        is none.
    """
    names = [str(file) for file in files]
    if len(names) <= _MOST_FILES:
        return shlex.join(names)
    start = commonprefix(names)
    rest = [name[len(start) :][::-1] for name in names]
    end = commonprefix(rest)[::-1]
    folder = Path(files[0].anchor)
    pattern = f"{escape(start.removeprefix(files[0].anchor))}*{escape(end)}"
    if sorted(map(str, folder.glob(pattern))) != sorted(names):
        return ""
    return "*".join(shlex.quote(text) if text else "" for text in (start, end))


def show_warnings(result: Result) -> None:
    """Print the warnings of a result, each once, to standard error."""
    log = start_logging()
    print_messages()
    for sentence in result.cautions():
        log.warning("%s", sentence)


def width() -> int:
    """Tell how wide a line may be.

    Returns:
        Characters of the terminal, or of the variable COLUMNS; of the widest table where there is neither.
    """
    return get_terminal_size((_PIPE_WIDTH, 24)).columns


def refuse_standard_output(option: str, path: Path | None) -> None:
    """Refuse `-` in place of a file or folder that does not go to standard output, which is for the result.

    Args:
        option: Option that names it.
        path: The file or folder; None if the option was not given.

    Raises:
        ForceTorqueError: If it is `-`.
    """
    if path == STANDARD_OUTPUT:
        raise ForceTorqueError(f"{option} -: expected a name, standard output takes the result only; see --format")


def refuse_ending(option: str, path: Path | None, endings: Collection[str]) -> None:
    """Refuse a file whose name ends otherwise, before any work is done.

    Args:
        option: Option that names it.
        path: The file; None if the option was not given.
        endings: Endings that it may have; any if there is none.

    Raises:
        ForceTorqueError: If it has another.
    """
    if path is not None and endings and path.suffix not in endings:
        raise ForceTorqueError(f"{option} {path}: expected a name that ends in {' or '.join(endings)}")


def refuse_output_folder(output: Path, option: str = "--output") -> None:
    """Refuse a folder of results that cannot be made anew, before any work is done.

    Args:
        output: Folder to make.
        option: Option that names it.

    Raises:
        ForceTorqueError: If it is there already, or is `-`.
    """
    refuse_standard_output(option, output)
    refuse_existing(output, where=f"{option} ")


def refuse_two_on_standard_output(output: Path | None, output_format: Format) -> None:
    """Refuse a file and a result on one standard output.

    Args:
        output: File to write; None for none.
        output_format: Form of the result; a table gives way to the file.

    Raises:
        ForceTorqueError: If the file goes to standard output, and the result is to be read by a program.
    """
    if output == STANDARD_OUTPUT and output_format is not Format.TABLE:
        raise ForceTorqueError(
            f"--output -: expected a file name beside --format {output_format}, got standard output for both; name a "
            "file, or leave out --format"
        )


_SPELLED = {
    "±": "+-",
    "…": "...",
    "█": "#",
    "░": ".",
    "─": "-",
    "²": "2",
    "°": "deg",
    "≤": "<=",
    "≥": ">=",
    "·": "*",
    "✓": "ok",
    "✗": "x",
}
_HANDLER = "forcetorque.spelled"


def spell_missing_letters() -> None:
    """Let standard output and standard error spell what their encoding lacks, as under `LC_ALL=C`."""
    codecs.register_error(_HANDLER, _spelled)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):  # not where a test or a notebook has put something else
            stream.reconfigure(errors=_HANDLER)


def _spelled(error: UnicodeError) -> tuple[str, int]:
    if not isinstance(error, UnicodeEncodeError):
        raise error
    letters = error.object[error.start : error.end]
    # a name that is not text in the file system's encoding holds surrogates
    return "".join(_SPELLED.get(letter, f"\\x{ord(letter):x}") for letter in letters), error.end


def refuse_figure(figure: Path | None, *, force: bool | None = None) -> None:
    """Say what is wrong with the figure before hours are spent on what it is to show.

    Args:
        figure: File to draw, PNG, SVG or PDF; None for none.
        force: As of `declare_outputs`.

    Raises:
        ForceTorqueError: If it is not called so, or has no folder to go to; MissingExtraError if nothing can draw it.
    """
    if figure is None:
        return
    from forcetorque.results.figure_style import FIGURE_ENDINGS, new_figure

    if figure.suffix.lower() not in FIGURE_ENDINGS:
        refuse_ending("--figure", figure, FIGURE_ENDINGS)
    if not figure.parent.is_dir():
        raise ForceTorqueError(f"--figure {figure}: expected an existing folder to write to, there is none")
    declare_outputs(figure, force=force)
    new_figure(1.0)


def drawn_to(result: _Drawn, file: Path) -> _Drawn:
    """Draw a result to a file.

    Args:
        result: The result.
        file: PNG, SVG or PDF to write or to replace.

    Returns:
        The result, which names the file if it was drawn.
    """
    from forcetorque.base.output_file import write_bytes_atomically
    from forcetorque.experiment.named_files import stated_in
    from forcetorque.results.figure_style import figure_bytes

    try:
        with stated_in(f"--figure {file}"):
            figure = result.figure()
        write_bytes_atomically(file, figure_bytes(figure, file.suffix.lower()))
    except (ForceTorqueError, OSError) as error:
        return result.without_figure(file, error)
    return result.model_copy(update={"figure_file": str(file)})
