# SPDX-License-Identifier: BSD-3-Clause
"""The program: its commands, and what becomes of errors; scientific modules are imported when a command runs."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from typing import Annotated, Any, Final

import typer

from forcetorque.app.wrapped_commands import with_datasets_and_view, with_live_view
from forcetorque.base.errors import ForceTorqueError
from forcetorque.base.lazy import named
from forcetorque.base.run_files import files_of_one_run
from forcetorque.results.capability import all_named
from forcetorque.results.terminal.command_from_signature import command_function
from forcetorque.results.terminal.command_output import print_messages, report_error, spell_missing_letters
from forcetorque.results.terminal.options import WholeSentences

_NAME = "forcetorque"
_CONTEXT: Final[dict[str, Any]] = {"help_option_names": ["-h", "--help"]}
"""Of the program; commands and groups inherit it."""
_TOP = (
    "forcetorque.app.demo:demo",
    "forcetorque.app.run.commands:run",
    "forcetorque.app.schema_command:schema",
    "forcetorque.report.commands:report",
    "forcetorque.viewer.commands:view",
)
"""Commands that are of no capability."""
PANELS: Final[Mapping[str, tuple[str, ...]]] = {
    "Everything at once": ("run", "demo"),
    "Begin": ("init", "inspect"),
    "Calibrate": ("calibrate", "payload", "tare"),
    "Evaluate": ("evaluate", "accept", "plan", "report", "view"),
    "Use": ("export", "estimate", "live"),
    "More": ("bench", "robot", "skin", "study", "dataset", "fleet", "simulate", "schema"),
}
"""Commands and groups in the order of work, as the help shows them."""
GROUPS: Final[Mapping[str, tuple[str, Mapping[str, str]]]] = {
    "bench": (
        "Choose and measure sensors: loads, temperature, fast forces, gains.",
        {
            name: name
            for name in (
                "sensor",
                "workbench",
                "thermal",
                "drift",
                "response",
                "gains",
                "device",
                "contest",
                "plate",
                "fit-plate",
            )
        },
    ),
    "robot": (
        "Examine a whole robot: feet, net force, collisions, motion, torque loops.",
        {
            name: name
            for name in (
                "balance",
                "coherence",
                "collisions",
                "joint-collisions",
                "motion",
                "torque-loop",
                "oscillation-causes",
            )
        },
    ),
    "dataset": (
        "Examine and compensate the forces of datasets for learning.",
        {"check": "check-dataset", "compensate": "compensate-dataset"},
    ),
    "study": (
        "Compare estimation types, trials and sensors, and skin with a sensor.",
        {"fits": "study", "skin": "study-skin"} | {name: name for name in ("sphere", "compare", "validate")},
    ),
}
"""Help of every group, and its commands with the names that their functions have."""


def commands() -> dict[str, str]:
    """Say where the commands are.

    Returns:
        References by what is typed, such as `evaluate` or `bench thermal`; a group that a capability makes by itself,
        such as `skin`, is one entry.
    """
    every = dict(all_named("commands")) | {reference.partition(":")[2]: reference for reference in _TOP}
    by_name = {name.replace("_", "-"): reference for name, reference in every.items()}
    grouped = {
        f"{group} {name}": by_name.pop(function)
        for group, (_, members) in GROUPS.items()
        for name, function in members.items()
    }
    return dict(sorted((by_name | grouped).items()))


class _ByPanels(WholeSentences):
    """The program, in the order of work."""

    panels = PANELS


def _add(program: typer.Typer, name: str, reference: str) -> None:
    found = named(reference)
    if isinstance(found, typer.Typer):
        program.add_typer(found)
    else:
        program.command(name)(with_live_view(name, with_datasets_and_view(name, command_function(found))))


def _add_group(program: typer.Typer, group: str, members: Mapping[str, str]) -> None:
    added = typer.Typer(
        name=group, cls=WholeSentences, help=GROUPS[group][0], no_args_is_help=True, rich_markup_mode=None
    )
    for name, reference in members.items():
        _add(added, name, reference)
    added.callback()(_no_options)
    program.add_typer(added)


def _program(first: list[str]) -> typer.Typer:
    """The program with the one command that is asked for: importing the others takes longer."""
    # options of the program itself stand before a command, so with a command first there are none
    known = commands()
    name, both = next(iter(first), ""), " ".join(first[:2])
    if name not in known and both not in known:
        return whole_program()
    one = typer.Typer(
        name=_NAME,
        cls=WholeSentences,
        add_completion=False,
        pretty_exceptions_enable=False,
        rich_markup_mode=None,
        context_settings=_CONTEXT,
    )
    one.callback(add_help_option=False)(_no_options)
    if name in known:
        _add(one, name, known[name])
    else:
        _add_group(one, name, {first[1]: known[both]})
    return one


def whole_program() -> typer.Typer:
    """Make the program with all commands."""
    program = typer.Typer(
        name=_NAME,
        cls=_ByPanels,
        context_settings=_CONTEXT,
        help="Calibrate force-torque sensors where they are mounted, and say how far to trust them.",
        no_args_is_help=True,
        pretty_exceptions_enable=False,
        rich_markup_mode=None,
    )
    program.callback(invoke_without_command=True)(_version)
    known = commands()
    for name, reference in known.items():
        if " " not in name:
            _add(program, name, reference)
    for group, (_, members) in GROUPS.items():
        _add_group(program, group, {name: known[f"{group} {name}"] for name in members})
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
            _program(sys.argv[1:3])()
    except (ForceTorqueError, OSError) as error:
        report_error(error)
        raise SystemExit(2) from None
    finally:
        print_messages()
