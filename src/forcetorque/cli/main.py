# SPDX-License-Identifier: BSD-3-Clause
"""The program: its commands, and what becomes of errors; scientific modules are imported when a command runs."""

from __future__ import annotations

import sys
from typing import Annotated

import typer

from forcetorque.cli.accept import accept
from forcetorque.cli.balance import balance
from forcetorque.cli.calibrate import calibrate
from forcetorque.cli.coherence import coherence
from forcetorque.cli.compare import compare
from forcetorque.cli.contest import contest
from forcetorque.cli.device import device
from forcetorque.cli.encoding import spell_missing_letters
from forcetorque.cli.estimate import estimate
from forcetorque.cli.evaluate import evaluate
from forcetorque.cli.export import export
from forcetorque.cli.gains import gains
from forcetorque.cli.init import init
from forcetorque.cli.inspect import inspect
from forcetorque.cli.motion import motion
from forcetorque.cli.output import report_error
from forcetorque.cli.payload import payload
from forcetorque.cli.plan import plan
from forcetorque.cli.report import report
from forcetorque.cli.response import response
from forcetorque.cli.schema import schema
from forcetorque.cli.simulate import simulate
from forcetorque.cli.skin import skin
from forcetorque.cli.sphere import sphere
from forcetorque.cli.study import study
from forcetorque.cli.tare import tare
from forcetorque.cli.thermal import thermal
from forcetorque.cli.torque_loop import torque_loop
from forcetorque.cli.validate import validate
from forcetorque.cli.view import view
from forcetorque.cli.workbench import workbench
from forcetorque.errors import ForceTorqueError
from forcetorque.run_files import files_of_one_run

app = typer.Typer(
    name="forcetorque",
    help="Calibrate force-torque sensors where they are mounted, and say how far to trust them.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)


@app.callback(invoke_without_command=True)
def _version(
    version: Annotated[bool, typer.Option("--version", help="Print the version and stop.", is_eager=True)] = False,
) -> None:
    if version:
        from importlib.metadata import version as installed_version

        typer.echo(installed_version("forcetorque"))
        raise typer.Exit


_COMMANDS = (
    accept,
    balance,
    calibrate,
    coherence,
    compare,
    device,
    contest,
    estimate,
    evaluate,
    export,
    gains,
    init,
    inspect,
    motion,
    payload,
    plan,
    report,
    response,
    schema,
    simulate,
    sphere,
    study,
    tare,
    thermal,
    torque_loop,
    validate,
    view,
    workbench,
)

_GROUPS = (skin,)
"""Commands that stand behind the name of what they are about."""

for _command in _COMMANDS:
    app.command(_command.__name__.replace("_", "-"))(_command)
for _group in _GROUPS:
    app.add_typer(_group)


def _program(first: list[str]) -> typer.Typer:
    """The program with the one command that is asked for: making the others and its own options ready takes longer."""
    # options of the program itself stand before a command, so with a command first there are none
    one = typer.Typer(name=app.info.name, add_completion=False, pretty_exceptions_enable=False, rich_markup_mode=None)
    one.callback(add_help_option=False)(_no_options)
    for command in _COMMANDS:
        if [command.__name__] == first:
            one.command(command.__name__)(command)
            return one
    for group in _GROUPS:
        if [group.info.name] == first:
            one.add_typer(group)
            return one
    return app


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
