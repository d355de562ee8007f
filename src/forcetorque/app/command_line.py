# SPDX-License-Identifier: BSD-3-Clause
"""The program: its commands, and what becomes of errors; scientific modules are imported when a command runs."""

from __future__ import annotations

import sys
from typing import Annotated

import typer

from forcetorque.app.schema_command import schema
from forcetorque.base.errors import ForceTorqueError
from forcetorque.base.run_files import files_of_one_run
from forcetorque.calibration.calibrate_command import calibrate
from forcetorque.calibration.export.command import export
from forcetorque.contests.command import contest
from forcetorque.device.command import device
from forcetorque.estimation.command import estimate
from forcetorque.evaluation.commands import accept, compare, evaluate, sphere, validate
from forcetorque.inspection.commands import init, inspect
from forcetorque.locomotion.commands import balance, coherence, motion, torque_loop
from forcetorque.payload.commands import payload, tare
from forcetorque.planning.command import plan
from forcetorque.report.command import report
from forcetorque.results.terminal.output import report_error, spell_missing_letters
from forcetorque.sensor.bandwidth.command import response
from forcetorque.sensor.gains.command import gains
from forcetorque.sensor.temperature.command import thermal
from forcetorque.simulation.command import simulate
from forcetorque.skin.commands import skin
from forcetorque.study.command import study
from forcetorque.viewer.command import view
from forcetorque.workbench.command import workbench

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
