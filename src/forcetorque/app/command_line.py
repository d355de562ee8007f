# SPDX-License-Identifier: BSD-3-Clause
"""The program: its commands, and what becomes of errors; scientific modules are imported when a command runs."""

from __future__ import annotations

import sys
from typing import Annotated

import typer

from forcetorque.base.errors import ForceTorqueError
from forcetorque.base.run_files import files_of_one_run
from forcetorque.results.capability import all_named, named
from forcetorque.results.terminal.command import command_function
from forcetorque.results.terminal.output import report_error, spell_missing_letters

_NAME = "forcetorque"
_TOP = (
    "forcetorque.app.run.command:run",
    "forcetorque.app.schema_command:schema",
    "forcetorque.report.command:report",
    "forcetorque.viewer.command:view",
)
"""Commands that are of no capability."""


def _commands() -> dict[str, str]:
    """Where commands and groups of them are, by the words of the command line."""
    every = dict(all_named("commands")) | {reference.partition(":")[2]: reference for reference in _TOP}
    return {name.replace("_", "-"): every[name] for name in sorted(every)}


def _add(program: typer.Typer, name: str, reference: str) -> None:
    found = named(reference)
    if isinstance(found, typer.Typer):
        program.add_typer(found)
    else:
        program.command(name)(command_function(found))


def _program(first: list[str]) -> typer.Typer:
    """The program with the one command that is asked for: importing the others takes longer."""
    # options of the program itself stand before a command, so with a command first there are none
    name = next(iter(first), "")
    reference = _commands().get(name)
    if reference is None:
        return whole_program()
    one = typer.Typer(name=_NAME, add_completion=False, pretty_exceptions_enable=False, rich_markup_mode=None)
    one.callback(add_help_option=False)(_no_options)
    _add(one, name, reference)
    return one


def whole_program() -> typer.Typer:
    """Make the program with all commands.

    Returns:
        The program.
    """
    program = typer.Typer(
        name=_NAME,
        help="Calibrate force-torque sensors where they are mounted, and say how far to trust them.",
        no_args_is_help=True,
        pretty_exceptions_enable=False,
        rich_markup_mode=None,
    )
    program.callback(invoke_without_command=True)(_version)
    for name, reference in _commands().items():
        _add(program, name, reference)
    return program


def _version(
    version: Annotated[bool, typer.Option("--version", help="Print the version and stop.", is_eager=True)] = False,
) -> None:
    if version:
        from importlib.metadata import version as installed_version

        typer.echo(installed_version("forcetorque"))
        raise typer.Exit


def _no_options() -> None:
    pass


def main() -> None:
    """Run the command line; a known error is one line on standard error and exit code 2."""
    spell_missing_letters()
    try:
        with files_of_one_run():
            _program(sys.argv[1:2])()
    except (ForceTorqueError, OSError) as error:
        report_error(error)
        raise SystemExit(2) from None
