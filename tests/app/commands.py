# SPDX-License-Identifier: BSD-3-Clause
"""Which commands there are, as they are typed."""

from __future__ import annotations

from typer import Typer

from forcetorque.app.command_line import commands


def typed_commands(program: Typer) -> list[str]:
    """Words of every command: its name, behind that of its group where it is in one.

    Args:
        program: The program, or a group.

    Returns:
        Such as `evaluate` and `skin check`; sorted.
    """
    words = [str(command.name) for command in program.registered_commands]
    for group in program.registered_groups:
        assert group.typer_instance is not None
        words += [f"{group.typer_instance.info.name} {name}" for name in typed_commands(group.typer_instance)]
    return sorted(words)


def question_of(command: str) -> str:
    """Name of the question that a command asks, which its schema, snapshot and files have."""
    function = commands().get(command, command).partition(":")[2]
    return function or command.replace(" ", "_").replace("-", "_")
