# SPDX-License-Identifier: BSD-3-Clause
"""The toy command of `tests/toy_command`, added as docs/architecture.md says."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path

import pytest

from forcetorque import analysis, cli
from forcetorque.cli.main import app

TOY = Path(__file__).parents[1] / "toy_command"
NAME = "extent"


@contextmanager
def added_command(folder: Path = TOY) -> Iterator[None]:
    """Its two files in the packages, its name in that of questions and in the list of commands."""
    modules = [f"forcetorque.{package}.{NAME}" for package in ("analysis", "cli")]
    with pytest.MonkeyPatch.context() as patch:
        for package in (analysis, cli):
            place = package.__name__.rpartition(".")[2]
            patch.setattr(package, "__path__", [*package.__path__, str(folder / place)])
            # what the import leaves behind in the package goes with the rest
            patch.setattr(package, NAME, None, raising=False)
        question, command = map(import_module, modules)
        patch.setattr(analysis, NAME, question.extent)
        patch.setattr(analysis, "Extent", question.Extent, raising=False)
        patch.setattr(app, "registered_commands", [*app.registered_commands])
        app.command(NAME)(command.extent)
        try:
            yield
        finally:
            for module in modules:
                del sys.modules[module]
