# SPDX-License-Identifier: BSD-3-Clause
"""The door of a package: names that it offers, each imported when it is first asked for.

What a package offers stands in one place, its imports under `if TYPE_CHECKING`, where type checkers, editors and the
API reference read it; the door reads it there as well.
"""

from __future__ import annotations

import ast
import sys
from collections.abc import Mapping
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any


def open_door(package: str) -> None:
    """Let a package import the names that it offers when they are first asked for.

    Args:
        package: Name of the package, which is being imported; its names are imported under `if TYPE_CHECKING`.
    """
    module = sys.modules[package]
    module.__dict__["_homes"] = _homes(Path(str(module.__file__)))
    module.__class__ = _Door


def _homes(file: Path) -> Mapping[str, str]:
    """Of every name that a file imports for type checkers, the module that has it."""
    tree = ast.parse(file.read_text(encoding="utf-8"))
    conditions = [node for node in tree.body if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"]
    imports = [node for condition in conditions for node in condition.body if isinstance(node, ast.ImportFrom)]
    return {alias.name: str(node.module) for node in imports for alias in node.names}


class _Door(ModuleType):
    """A package that looks for what it does not have where its file says."""

    _homes: Mapping[str, str]

    def __getattr__(self, name: str) -> Any:
        home = self.__dict__["_homes"].get(name)
        if home is None:
            raise AttributeError(f"module {self.__name__!r} has no attribute {name!r}")
        value = getattr(import_module(home), name)
        self.__dict__[name] = value
        return value

    def __setattr__(self, name: str, value: object) -> None:
        # the import of a module makes it an attribute of its package, also where that offers a function of this name
        if not (isinstance(value, ModuleType) and name in self._homes):
            super().__setattr__(name, value)

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *self._homes})
