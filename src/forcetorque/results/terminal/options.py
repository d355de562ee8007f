# SPDX-License-Identifier: BSD-3-Clause
"""What several commands share at the terminal: arguments, options, questions, and help in whole sentences."""

from __future__ import annotations

import select
import sys
from collections.abc import Mapping
from io import BufferedReader
from pathlib import Path
from typing import Annotated, Any, ClassVar

import typer
from typer.core import TyperGroup

from forcetorque.results.terminal.command_output import TYPED, Format

ExperimentArgument = Annotated[Path, typer.Argument(help="Experiment file (TOML); see docs/recording.md.")]
ExperimentsArgument = Annotated[
    list[Path], typer.Argument(help="Experiment files (TOML) with the same sensors; see docs/recording.md.")
]
FormatOption = Annotated[Format, typer.Option("--format", help="Form of the result on standard output.")]
DetailsOption = Annotated[bool, typer.Option("--details", help="Show tables and all warnings below the answer.")]
ForceOption = Annotated[
    bool,
    typer.Option(
        "--force", help="Replace a file that is neither a result nor a figure. An input of the command never is."
    ),
]
SensorOption = Annotated[
    list[str] | None, typer.Option("--sensor", help="Sensor of the experiment; repeat for more. Default: all.")
]
ColumnNamesOption = Annotated[
    list[str] | None,
    typer.Option(
        "--column-names",
        help="Names of all columns of a table without headings, as t,fx,fy,fz,tx,ty,tz; once for each table.",
    ),
]
RecordingOption = Annotated[
    list[str] | None,
    typer.Option(
        "--recording",
        help="What a log lacks, as moment_about=flange, payload_kg=0 or measure_direction=parent_to_child; repeat for "
        "more.",
    ),
]
LoadsOption = Annotated[
    str | None,
    typer.Option(
        "--loads",
        help="Weights of a bench: a table of them, thesis-6.1, or the log itself if its columns have the loads.",
    ),
]
CalibrationsOption = Annotated[
    list[Path] | None,
    typer.Option(
        "--calibration", "-c", help="Calibration file, or folder of them; repeat for more. Default: the priors."
    ),
]
OffsetOption = Annotated[
    str,
    typer.Option(
        "--offset",
        help="Where offsets come from: fitted (the calibration's own), one-link-imu:LABEL, one-link-fixed-frame:LABEL, "
        "tare:LABEL, first-second, judged-mean or none; see docs/locomotion/coherence.md.",
    ),
]
PopulationOption = Annotated[
    list[Path] | None,
    typer.Option(
        "--population", help="Matrix file or calibration of another sensor, or a folder of them; repeat for more."
    ),
]


def between_commas(texts: list[str] | None) -> list[list[str]]:
    """Give the parts of each text of an option between commas; none where the option is not given."""
    return [[part.strip() for part in text.split(",")] for text in texts or ()]


_WHOLE = 1000
"""Characters of a sentence that are shown: all."""


class WholeSentences(TyperGroup):
    """A group whose help cuts nothing off; that of the program remembers what was typed."""

    panels: ClassVar[Mapping[str, tuple[str, ...]] | None] = None
    """Titles, and commands in their order, the last with all others; None for one panel of all."""

    def make_context(self, info_name: str | None, args: list[str], parent: Any = None, **extra: Any) -> Any:
        """Parse what was typed, of the program or of a group in it.

        Args:
            info_name: Name of the group.
            args: What was typed after it.
            parent: Context of the program; None for the program.
            extra: Settings of the context.

        Returns:
            The context.
        """
        if parent is None:
            TYPED.set(tuple(args))
        return super().make_context(info_name, args, parent=parent, **extra)

    def format_commands(self, ctx: Any, formatter: Any) -> None:
        """Write a section for every panel.

        Args:
            ctx: The context.
            formatter: What the help is written to.
        """
        panels = {title: list(names) for title, names in (self.panels or {"Commands": ()}).items()}
        shown = {name for names in panels.values() for name in names}
        panels[list(panels)[-1]] += [name for name in self.list_commands(ctx) if name not in shown]
        for title, names in panels.items():
            known = {name: command for name in names if (command := self.get_command(ctx, name)) is not None}
            with formatter.section(title):
                formatter.write_dl(
                    [(name, command.get_short_help_str(limit=_WHOLE)) for name, command in known.items()]
                )


def is_terminal() -> bool:
    """Tell whether a person can answer.

    Returns:
        Whether standard input is a terminal; none that is closed.
    """
    return sys.stdin is not None and not sys.stdin.closed and sys.stdin.isatty()


def has_piped_lines() -> bool:
    """Tell whether lines wait on a standard input that is no terminal.

    Returns:
        Whether there are; an empty or closed one, such as `/dev/null`, has none, and so has one that cannot be asked.
    """
    if is_terminal():
        return False
    try:
        ready, _, _ = select.select([sys.stdin], [], [], 0.0)
        return bool(ready) and isinstance(sys.stdin.buffer, BufferedReader) and bool(sys.stdin.buffer.peek(1))
    except (OSError, ValueError, AttributeError):
        return False


def ask(question: str) -> str:
    """Ask for a value.

    Returns:
        The answer; empty to leave it open.
    """
    sys.stderr.write(f"{question}\n")
    return str(typer.prompt("answer (empty to leave it open)", default="", show_default=False, err=True))


def accepts(proposal: str) -> bool:
    """Ask whether a proposal is accepted.

    Returns:
        Whether it is; no if the answer is empty.
    """
    sys.stderr.write(f"{proposal}\n")
    return bool(typer.confirm("change the file so", default=False, err=True))
