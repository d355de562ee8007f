# SPDX-License-Identifier: BSD-3-Clause
"""Names that are imported when they are first used: of a package (PEP 562), of a class, and as text."""

from __future__ import annotations

import sys
from collections.abc import Callable
from importlib import import_module
from operator import attrgetter
from types import ModuleType
from typing import Any


def lazy_names(package: str, **modules: str) -> tuple[list[str], Callable[[str], Any], Callable[[], list[str]]]:
    """Make the `__all__`, `__getattr__` and `__dir__` of a package.

    A name must not be that of a module in the package: importing the module would hide it. Type checkers know the
    names by imports `X as X` under `TYPE_CHECKING`.

    Args:
        package: Name of the package.
        **modules: For every public name, the module that defines it.

    Returns:
        `__all__`, `__getattr__` and `__dir__` of the package; an unknown name is an `AttributeError`.
    """

    def get(name: str) -> Any:
        if name not in modules:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        value = getattr(import_module(modules[name]), name)
        setattr(sys.modules[package], name, value)
        return value

    def names() -> list[str]:
        held = vars(sys.modules[package]).items()
        own = {name for name, value in held if name.startswith("_") or isinstance(value, ModuleType)}
        return sorted({*own, *modules})  # without what the package itself imported for its names

    return list(modules), get, names


def named(reference: str) -> Any:
    """Import what a text names.

    Args:
        reference: `module:name` or `module:Class.name`.

    Returns:
        The object.
    """
    module, _, name = reference.partition(":")
    return attrgetter(name)(import_module(module))


class LazyMethod:
    """A method that is a function of another module, imported when it is first used.

    From then on the class has the function itself.
    """

    __slots__ = ("_name", "_reference")

    def __init__(self, reference: str) -> None:
        """Name the function.

        Args:
            reference: `module:name`; its first parameter is the object.
        """
        self._reference = reference

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    def __get__(self, instance: object, owner: type) -> Any:
        function = named(self._reference)
        holder = next(kind for kind in owner.__mro__ if vars(kind).get(self._name) is self)
        setattr(holder, self._name, function)
        return function.__get__(instance, owner)
