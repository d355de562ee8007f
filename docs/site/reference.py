# SPDX-License-Identifier: BSD-3-Clause
"""Pages of the API reference, made anew by every build: of each package or module that users import, and each class."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from os.path import commonprefix
from pathlib import Path
from textwrap import indent

from docs.site.definitions import Definition, definition, definitions, offered, package_names

ROOT = Path(__file__).resolve().parents[2]
ERRORS = "forcetorque.base.errors"
"""Module that every user of the library may import, whatever the pages show."""
CLASSES = "classes"
"""Folder of the pages of classes."""
MEMBERS = """\
   :members:
   :undoc-members:
   :exclude-members: model_config"""
"""How a class is shown: with fields whose names say all, but without what pydantic keeps in it."""


def doors() -> dict[str, tuple[str, ...]]:
    """Find what users import.

    Returns:
        Public names by package or module; a module that a package offers as one of its names is a door too.
    """
    found: dict[str, tuple[str, ...]] = {}
    modules = [ERRORS, *documented_modules()]
    for package in package_names():
        names = [definition(package, name) for name in offered(package)]
        if names:
            modules += [f"{package}.{one.name}" for one in names if one.kind == "module"]
            found[package] = tuple(one.name for one in names if one.kind != "module")
    for module in modules:
        # of a module that is no package, names without a docstring are details of the others
        found[module] = tuple(one.name for one in definitions(module) if one.docstring and not one.name.startswith("_"))
    return dict(sorted(found.items()))


def documented_modules() -> list[str]:
    """Find the modules that the pages for users import from.

    Returns:
        Their names, sorted; packages are not among them.
    """
    texts = [path.read_text(encoding="utf-8") for path in sorted((ROOT / "docs").rglob("*.md"))]
    imported = {name for text in texts for name in re.findall(r"^from (forcetorque[.\w]+) import ", text, re.MULTILINE)}
    return sorted(imported - set(package_names()))


def pages() -> Iterator[tuple[str, str]]:
    """Write the pages.

    Yields:
        Name of a page, and its reStructuredText; a door, or a class in the folder `CLASSES`.
    """
    public = doors()
    homes = _homes(public)
    for door, names in public.items():
        found = [definition(door, name) for name in sorted(names, key=str.casefold)]
        own = [one for one in found if homes[one] == door]
        # classes before functions before constants: what is computed, by what, with which numbers
        classes = [one for one in own if one.kind == "class"]
        for one in classes:
            yield f"{CLASSES}/{door}.{one.name}", f"{one.name}\n{'=' * len(one.name)}\n\n{_entry(door, one)}\n"
        entries = [_list_of(door, classes)] if classes else []
        entries += [_entry(door, one) for kind in ("function", "data") for one in own if one.kind == kind]
        guests = [_pointer(homes[one], one) for one in found if homes[one] != door]
        shared = ["Also here\n---------\n\n" + "\n".join(guests)] if guests else []
        head = f"{door}\n{'=' * len(door)}\n\n.. automodule:: {door}"
        yield door, "\n\n".join([head, *entries, *shared]) + "\n"


def _homes(public: dict[str, tuple[str, ...]]) -> dict[Definition, str]:
    """Of the doors that offer a name, the one nearest to its definition tells of it; others point there."""
    homes: dict[Definition, str] = {}
    for door, names in public.items():
        for name in names:
            one = definition(door, name)
            homes[one] = max(homes.get(one, door), door, key=lambda near: len(commonprefix([near, one.module])))
    return homes


def _list_of(door: str, classes: Sequence[Definition]) -> str:
    """Classes with their first line, and their pages in the sidebar below that of the door."""
    pages = "\n".join(f"   {CLASSES}/{door}.{one.name}" for one in classes)
    listed = "\n".join(_pointer(door, one) for one in classes)
    return f"Classes\n-------\n\n{listed}\n\n.. toctree::\n   :hidden:\n\n{pages}"


def _pointer(home: str, one: Definition) -> str:
    first, *_ = (one.docstring or "").splitlines()
    return f"- :py:obj:`{one.name} <{home}.{one.name}>`: {first}"


def _entry(door: str, one: Definition) -> str:
    if one.kind == "class":
        return f".. autoclass:: {door}.{one.name}\n{MEMBERS}" + ("\n   :show-inheritance:" if one.value else "")
    if one.kind == "function":
        return f".. autofunction:: {door}.{one.name}"
    # by hand: autodoc has no docstring of a constant that is imported
    value = f"   :value: {one.value}\n" if one.value else ""
    return f".. py:data:: {one.name}\n   :module: {door}\n{value}\n{indent(one.docstring or '', '   ')}"
