# SPDX-License-Identifier: BSD-3-Clause
"""The toy command and the toy group, added as docs/architecture.md says: `tests/toys/command`, `tests/toys/group`."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path

import pytest

from forcetorque import analysis, cli
from forcetorque.cli.main import app

TOY = Path(__file__).parents[1] / "toys" / "command"
NAME = "extent"
TOY_GROUP = TOY.with_name("group")
GROUP = "toy"
GROUP_COMMAND = "toy count"


@contextmanager
def added_command(folder: Path = TOY) -> Iterator[None]:
    """Its two files in the packages, its name in that of questions and in the list of commands."""
    modules = [f"forcetorque.{package}.{NAME}" for package in ("analysis", "cli")]
    with _files_of(folder, NAME, NAME) as patch:
        question, command = map(import_module, modules)
        patch.setattr(analysis, NAME, question.extent)
        patch.setattr(analysis, "Extent", question.Extent, raising=False)
        app.command(NAME)(command.extent)
        try:
            yield
        finally:
            for module in modules:
                del sys.modules[module]


@contextmanager
def added_group(folder: Path = TOY_GROUP) -> Iterator[None]:
    """Its folder and its question in the packages, its name in the list of groups."""
    modules = ["forcetorque.analysis.toy_count", "forcetorque.cli.toy.count", "forcetorque.cli.toy"]
    with _files_of(folder, "toy_count", GROUP) as patch:
        question, group = import_module(modules[0]), import_module(modules[2])
        patch.setattr(analysis, "toy_count", question.toy_count)
        patch.setattr(analysis, "ToyCount", question.ToyCount, raising=False)
        app.add_typer(group.toy)
        try:
            yield
        finally:
            for module in modules:
                del sys.modules[module]


@contextmanager
def _files_of(folder: Path, question: str, command: str) -> Iterator[pytest.MonkeyPatch]:
    """Files of a toy in the packages of questions and commands; what is added meanwhile goes with them."""
    with pytest.MonkeyPatch.context() as patch:
        for package, name in ((analysis, question), (cli, command)):
            place = package.__name__.rpartition(".")[2]
            patch.setattr(package, "__path__", [*package.__path__, str(folder / place)])
            # what the import leaves behind in the package goes with the rest
            patch.setattr(package, name, None, raising=False)
        patch.setattr(app, "registered_commands", [*app.registered_commands])
        patch.setattr(app, "registered_groups", [*app.registered_groups])
        yield patch
