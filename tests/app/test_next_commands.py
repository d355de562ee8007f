# SPDX-License-Identifier: BSD-3-Clause
"""Next commands: what a result offers to type is a command of the program, with options that it has."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from typer import BadParameter
from typer.core import TyperGroup
from typer.main import get_command

from forcetorque.app.command_line import whole_program

USAGE_ERROR = BadParameter.__mro__[1]
"""What an unknown command, option or value raises; Typer does not name it."""
SOURCE = Path(__file__).parents[2] / "src" / "forcetorque"


def _word(node: ast.expr) -> str:
    """A word as it is typed."""
    match node:
        case ast.Constant(value=str(word)):
            return word
        case ast.Attribute(attr="value"):  # the format of a payload
            return "ros2-broadcaster"
    return "name.json"


def _offered() -> Iterator[tuple[str, tuple[str, ...]]]:
    """Where a command is offered, and its words; words that are known only at run time are file names."""
    for path in sorted(SOURCE.rglob("*.py")):
        text = path.read_text(encoding="utf-8")
        if "typed(" not in text:
            continue
        for node in ast.walk(ast.parse(text)):
            called = isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "typed"
            if called and not any(isinstance(word, ast.Starred) for word in node.args):  # type: ignore[attr-defined]
                words = tuple(map(_word, node.args))  # type: ignore[attr-defined]
                yield f"{path.relative_to(SOURCE).as_posix()}: {' '.join(words)}", words


OFFERED = dict(_offered())


@cache
def _program() -> Any:
    return get_command(whole_program())


def _parse(words: tuple[str, ...]) -> None:
    """Read a command line as the program does, without running it."""
    command, rest, context = _program(), [*words], None
    while isinstance(command, TyperGroup):
        context = command.make_context("forcetorque", [*rest], parent=context)
        _, found, rest = command.resolve_command(context, rest)
        assert found is not None
        command = found
    command.make_context(str(command.name), rest, parent=context)


@pytest.mark.parametrize("where", OFFERED)
def test_the_program_reads_what_it_offers(where: str) -> None:
    """Command, options and their values."""
    _parse(OFFERED[where])


@pytest.mark.parametrize(
    "words", [("inspekt", "a.toml"), ("evaluate", "a.toml", "--calibratoin", "b.json"), ("plan", "a.toml", "-c")]
)
def test_the_program_refuses_what_it_does_not_know(words: tuple[str, ...]) -> None:
    """Negative control of the test above."""
    assert len(OFFERED) > 10
    with pytest.raises(USAGE_ERROR):
        _parse(words)
