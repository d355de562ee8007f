# SPDX-License-Identifier: BSD-3-Clause
"""Where a public name is written down: imports are followed to the statement that defines it, as the source has it."""

from __future__ import annotations

import ast
import inspect
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import forcetorque

LIBRARY = Path(forcetorque.__file__).parent
LONGEST_VALUE = 80
"""Characters of a value that a reader still takes in at a glance; longer ones are left to the source."""


@dataclass(frozen=True, slots=True)
class Definition:
    """A name and the statement that defines it."""

    module: str
    """Module in which it is written down."""
    name: str
    """The name."""
    kind: str
    """What it is to Sphinx: `class`, `function`, `data` or `module`."""
    docstring: str | None
    """Its docstring; of data, the text that follows the assignment."""
    value: str = ""
    """Source of the value of data, empty if it is long; of a class, its bases."""


@cache
def definition(module: str, name: str) -> Definition:
    """Find the statement that defines a name of a module.

    Args:
        module: Module that has the name, by its own definition or by an import.
        name: The name.

    Returns:
        The definition.

    Raises:
        LookupError: If the module neither defines nor imports such a name.
    """
    home, name_there = _imports(module).get(name, (None, name))
    if home == module:  # a package that offers one of its modules
        return Definition(module, name, "module", ast.get_docstring(_tree(f"{module}.{name}")))
    if home is not None:
        return definition(home, name_there)
    for found in definitions(module):
        if found.name == name:
            return found
    raise LookupError(f"{module}.{name}: expected a definition or an import of that name")


@cache
def definitions(module: str) -> tuple[Definition, ...]:
    """Collect what a module defines at its top.

    Args:
        module: Name of the module.

    Returns:
        Classes, functions and data, in the order of the source.
    """
    return tuple(_defined(module))


def package_names() -> list[str]:
    """Find the packages of the library.

    Returns:
        Their names, sorted.
    """
    paths = LIBRARY.rglob("__init__.py")
    return sorted(".".join(path.parent.relative_to(LIBRARY.parent).parts) for path in paths)


def offered(package: str) -> tuple[str, ...]:
    """Read the names that a package offers: `__all__`, or the arguments of its `lazy_names`.

    Args:
        package: Name of a package.

    Returns:
        The names; none if the package offers none.
    """
    for node in _tree(package).body:
        match node:
            case ast.Assign(value=ast.Call(func=ast.Name(id="lazy_names"), keywords=modules)):
                return tuple(str(module.arg) for module in modules)
            case ast.Assign(targets=[ast.Name(id="__all__")], value=value):
                return tuple(ast.literal_eval(value))
    return ()


def _defined(module: str) -> Iterator[Definition]:
    body = _tree(module).body
    for node, follower in zip(body, [*body[1:], None], strict=True):
        match node:
            case ast.ClassDef(name=name, bases=bases):
                yield Definition(module, name, "class", ast.get_docstring(node), ", ".join(map(ast.unparse, bases)))
            case ast.FunctionDef(name=name):
                yield Definition(module, name, "function", ast.get_docstring(node))
            case ast.Assign(targets=[ast.Name(id=name)], value=value):
                yield Definition(module, name, "data", _text(follower), _short(value))
            case ast.AnnAssign(target=ast.Name(id=name), value=ast.expr() as value):
                yield Definition(module, name, "data", _text(follower), _short(value))


@cache
def _tree(module: str) -> ast.Module:
    path = LIBRARY.parent.joinpath(*module.split("."))
    source = path / "__init__.py" if path.is_dir() else path.with_suffix(".py")
    return ast.parse(source.read_text(encoding="utf-8"))


@cache
def _imports(module: str) -> dict[str, tuple[str, str]]:
    """Of every name that a module imports from the library, also for types only: module and name there."""
    nodes = [node for node in ast.walk(_tree(module)) if isinstance(node, ast.ImportFrom)]
    return {
        alias.asname or alias.name: (node.module, alias.name)
        for node in nodes
        if node.module and node.module.startswith("forcetorque")
        for alias in node.names
    }


def _text(node: ast.stmt | None) -> str | None:
    match node:
        case ast.Expr(value=ast.Constant(value=str(text))):
            return inspect.cleandoc(text)
    return None


def _short(value: ast.expr) -> str:
    text = ast.unparse(value)
    return text if len(text) <= LONGEST_VALUE else ""
