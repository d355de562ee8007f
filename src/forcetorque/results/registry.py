# SPDX-License-Identifier: BSD-3-Clause
"""Which results there are, by the names of their schemas."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module
from pkgutil import walk_packages
from types import ModuleType

from forcetorque.results.result import Result

_FAMILY = "forcetorque"
"""What names of schemas begin with: `forcetorque/NAME/VERSION`."""


def result_classes(*packages: ModuleType) -> dict[str, type[Result]]:
    """Find every result that packages give, so that a new one is known wherever results are.

    Args:
        packages: Packages; all modules below them are imported.

    Returns:
        Class by name of its schema, which is that of the command that shows it; sorted.
    """
    modules = {
        import_module(module.name).__name__
        for package in packages
        for module in walk_packages(package.__path__, f"{package.__name__}.")
    }
    classes = {_name(kind): kind for kind in _below(Result) if kind.__module__ in modules}
    return {name: classes[name] for name in sorted(classes) if name}


def _below(kind: type[Result]) -> Iterator[type[Result]]:
    for child in kind.__subclasses__():
        yield child
        yield from _below(child)


def _name(kind: type[Result]) -> str:
    """The name within the schema; empty for what is only a part of other results."""
    field = kind.model_fields.get("schema_name")
    words = [] if field is None else str(field.default).split("/")
    return words[1] if words[:1] == [_FAMILY] else ""
