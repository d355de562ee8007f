# SPDX-License-Identifier: BSD-3-Clause
"""A checker of the JSON schemas that the commands print; a word that it does not know is an error."""

from __future__ import annotations

import re
from typing import Any

_TYPES: dict[str, type | tuple[type, ...]] = {
    "object": dict,
    "array": list,
    "string": str,
    "integer": int,
    "number": (int, float),
    "boolean": bool,
    "null": type(None),
}
_SILENT = {"title", "description", "default", "$defs", "format", "discriminator", "readOnly"}
"""Words that demand nothing of the value."""


def faults(value: Any, schema: dict[str, Any], root: dict[str, Any] | None = None, where: str = "top") -> list[str]:
    """Give what a value has against a schema; nothing if it fits."""
    root = root if root is not None else schema
    found: list[str] = []
    for word, wanted in schema.items():
        if word == "$ref":
            found += faults(value, root["$defs"][wanted.removeprefix("#/$defs/")], root, where)
        elif word == "allOf":
            for part in wanted:
                found += faults(value, part, root, where)
        elif word in ("anyOf", "oneOf"):
            fitting = sum(not faults(value, option, root, where) for option in wanted)
            found += [] if fitting == 1 or (fitting and word == "anyOf") else [f"{where}: {fitting} of {word}"]
        elif word == "properties":
            for key in value.keys() & wanted.keys() if isinstance(value, dict) else ():
                found += faults(value[key], wanted[key], root, f"{where}.{key}")
        elif word == "additionalProperties":
            extra = value.keys() - schema.get("properties", {}).keys() if isinstance(value, dict) else set()
            if wanted is False:
                found += [f"{where}: unknown key {key}" for key in extra]
            elif wanted is not True:
                for key in extra:
                    found += faults(value[key], wanted, root, f"{where}.{key}")
        elif word == "items":
            for index, item in enumerate(value if isinstance(value, list) else ()):
                found += faults(item, wanted, root, f"{where}[{index}]")
        elif word == "prefixItems":
            for index, (item, form) in enumerate(zip(value if isinstance(value, list) else (), wanted, strict=False)):
                found += faults(item, form, root, f"{where}[{index}]")
        elif not _fits(value, word, wanted):
            found.append(f"{where}: {word} {wanted}, got {value!r}")
    return found


def _fits(value: Any, word: str, wanted: Any) -> bool:
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    if word == "type":
        return isinstance(value, _TYPES[wanted]) and (wanted == "boolean" or not isinstance(value, bool))
    if word == "required":
        return not isinstance(value, dict) or value.keys() >= set(wanted)
    if word in ("minItems", "maxItems"):
        return not isinstance(value, list) or (len(value) >= wanted if word == "minItems" else len(value) <= wanted)
    if word == "minLength":
        return not isinstance(value, str) or len(value) >= wanted
    if word == "pattern":
        return not isinstance(value, str) or re.search(wanted, value) is not None
    if word == "minProperties":
        return not isinstance(value, dict) or len(value) >= wanted
    if word == "maximum":
        return not is_number or value <= wanted
    if word in ("minimum", "exclusiveMinimum"):
        return not is_number or (value >= wanted if word == "minimum" else value > wanted)
    if word in ("const", "enum"):
        return bool(value in wanted if word == "enum" else value == wanted)
    assert word in _SILENT, f"this checker does not know {word}"
    return True
