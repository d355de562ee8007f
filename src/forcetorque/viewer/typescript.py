# SPDX-License-Identifier: BSD-3-Clause
"""What the page shares with the library, in files for its bundle: `python -m forcetorque.viewer.typescript web/src`."""

from __future__ import annotations

import ast
import dataclasses
import inspect
import json
import sys
import types
from pathlib import Path
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints

from forcetorque.base.output_file import write_bytes_atomically
from forcetorque.results.visual_roles import PRESSURES, SURFACES, css_variables, named_roles
from forcetorque.viewer import scene

_LICENCE = "SPDX-License-Identifier: BSD-3-Clause"
_ORIGIN = "Written by `make web-types` from src/forcetorque/{file}; change that file instead."
_WORDS = {str: "string", int: "number", float: "number", bool: "boolean", type(None): "null"}


def scene_types() -> str:
    """Write the classes as TypeScript.

    Returns:
        Text of the module.
    """
    classes = [
        member for member in vars(scene).values() if inspect.isclass(member) and dataclasses.is_dataclass(member)
    ]
    return "\n\n".join([_head("viewer/scene.py"), *map(_interface, classes)]) + "\n"


def visual_roles() -> str:
    """Write the visual roles as TypeScript.

    Returns:
        Text of the module.
    """
    roles = {
        name: {"word": role.word, "colours": [role.colour, role.dark], "dash": list(role.dash)}
        for name, role in named_roles().items()
    }
    constants = {"ROLES": roles, "SURFACES": SURFACES, "PRESSURES": PRESSURES}
    lines = [f"export const {name} = {json.dumps(value, indent=2)} as const;" for name, value in constants.items()]
    return "\n\n".join([_head("results/visual_roles.py"), *lines]) + "\n"


def visual_style() -> str:
    """Write the visual roles as variables of a style sheet: for a light ground, a dark one, and paper.

    Returns:
        Text of the style sheet.
    """
    light, dark = (css_variables(dark=ground) for ground in (False, True))
    head = "\n".join(f"/* {line} */" for line in (_LICENCE, _ORIGIN.format(file="results/visual_roles.py")))
    paper = "@media print {\n:root[data-ground] {\n" + light + "\n}\n}\n"
    return f'{head}\n:root {{\n{light}\n}}\n:root[data-ground="dark"] {{\n{dark}\n}}\n{paper}'


SHARED = {"scene_types.ts": scene_types, "visual_roles.ts": visual_roles, "visual_roles.css": visual_style}
"""Files in the folder of the page's sources, and what writes them."""


def _head(file: str) -> str:
    return "\n".join(f"// {line}" for line in (_LICENCE, _ORIGIN.format(file=file)))


def _interface(cls: type) -> str:
    hints, comments = get_type_hints(cls), _field_docstrings(cls)
    lines = [*_comment(inspect.getdoc(cls) or "", ""), f"export interface {cls.__name__} {{"]
    for field in dataclasses.fields(cls):
        lines += [
            *_comment(comments[field.name], "  "),
            f"  readonly {field.name}: {typescript_of(hints[field.name])};",
        ]
    return "\n".join([*lines, "}"])


def typescript_of(hint: Any) -> str:
    """Write one type as TypeScript.

    Args:
        hint: Type of a field.

    Returns:
        The type of what JSON makes of such a value.

    Raises:
        TypeError: If JSON has no such value.
    """
    if hint in _WORDS:
        return _WORDS[hint]
    if dataclasses.is_dataclass(hint):
        return str(getattr(hint, "__name__", hint))
    arguments = get_args(hint)
    if get_origin(hint) is Literal:
        return " | ".join(f'"{word}"' for word in arguments)
    if get_origin(hint) in (Union, types.UnionType):
        return " | ".join(map(typescript_of, arguments))
    if get_origin(hint) is tuple and arguments[1:] == (...,):
        return f"readonly {typescript_of(arguments[0])}[]"
    raise TypeError(f"{hint}: expected text, a number, a class of the scene, a Literal, a union or tuple[X, ...]")


def _field_docstrings(cls: type) -> dict[str, str]:
    """Docstrings that stand below the fields."""
    (definition,) = ast.parse(inspect.getsource(cls)).body
    statements = definition.body if isinstance(definition, ast.ClassDef) else []
    docstrings = {}
    for field, text in zip(statements, statements[1:], strict=False):
        if isinstance(field, ast.AnnAssign) and isinstance(text, ast.Expr) and isinstance(text.value, ast.Constant):
            docstrings[ast.unparse(field.target)] = str(text.value.value)
    return docstrings


def _comment(text: str, indent: str) -> list[str]:
    lines = text.splitlines()
    if len(lines) == 1:
        return [f"{indent}/** {lines[0]} */"]
    return [f"{indent}/**", *(f"{indent} * {line}".rstrip() for line in lines), f"{indent} */"]


if __name__ == "__main__":
    for name, text in SHARED.items():
        write_bytes_atomically(Path(sys.argv[1]) / name, text().encode())
