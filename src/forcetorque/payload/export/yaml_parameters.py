# SPDX-License-Identifier: BSD-3-Clause
"""The little of YAML that parameter files of loads use: names with a number, a word, or a list of numbers."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from forcetorque.base.errors import FormatError, MissingFileError, require_known
from forcetorque.base.units import DECIMAL_NUMBER

_ENTRY = re.compile(r"(?P<key>[A-Za-z_]\w*):(?:\s+(?P<value>.*))?$")
_ITEM = re.compile(r"\s*-\s+(?P<value>\S+)$")
_LARGEST = 1 << 20
"""Bytes; a file of parameters has a few hundred."""

Value = float | str | list[float]


def number(value: float) -> str:
    """Write a number that YAML and ROS read as one with a fraction, and that reads back exactly.

    Returns:
        Its digits, without an exponent: YAML 1.1 takes 1e-05 for a word.
    """
    return np.format_float_positional(value + 0.0, unique=True, trim="0")  # + 0.0: no -0.0


def numbers(values: Iterable[float]) -> str:
    """Write a list of numbers.

    Returns:
        The list.
    """
    return "[" + ", ".join(number(float(value)) for value in values) + "]"


def word(text: str) -> str:
    """Write a word, in quotes.

    Returns:
        The word as YAML and JSON read it.
    """
    return json.dumps(text)


def read_plain_yaml(path: Path | str, keys: Iterable[str]) -> dict[str, Value]:
    """Read parameters: one name per line, with a number, a word, or a list of numbers in either style.

    Args:
        path: The file.
        keys: Names that it must have, and no others.

    Returns:
        What they stand for.

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If it is anything else, with the line.
    """
    file, wanted = Path(path), list(keys)
    values: dict[str, Value] = {}
    key = ""
    for line, text in _joined_lines(file):
        item, entry = _ITEM.fullmatch(text), _ENTRY.fullmatch(text)
        if item is not None and isinstance(values.get(key), list):
            items = values[key]
            if isinstance(items, list):
                items.append(_number(file, line, item["value"]))
        elif entry is not None and entry["key"] not in values:
            key = entry["key"]
            require_known(key, wanted, FormatError, f"{file}:{line}: unknown name {key!r}")
            values[key] = _value(file, line, (entry["value"] or "").strip())
        else:
            raise FormatError(f"{file}:{line}: expected a name, a colon and its value, each once, got {text[:60]!r}")
    if lacking := [name for name in wanted if name not in values]:
        raise FormatError(f"{file}: expected {', '.join(wanted)}, got none of {', '.join(lacking)}")
    return values


def _joined_lines(file: Path) -> list[tuple[int, str]]:
    """Lines without comments and blanks; a list in brackets that goes on over several is one."""
    if not file.is_file():
        raise MissingFileError(f"{file}: expected a file of parameters, there is none")
    data = file.read_bytes()
    if len(data) > _LARGEST:
        raise FormatError(f"{file}: expected a file of parameters, got {len(data)} bytes")
    try:
        content = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise FormatError(f"{file}: expected text, got {error.reason}") from error
    lines: list[tuple[int, str]] = []
    for line, raw in enumerate(content.splitlines(), start=1):
        text = re.sub(r"(^|\s)#.*", "", raw).rstrip()
        if not text or text == "---":
            continue
        if lines and lines[-1][1].count("[") > lines[-1][1].count("]"):
            lines[-1] = (lines[-1][0], f"{lines[-1][1]} {text.strip()}")
        else:
            lines.append((line, text))
    return lines


def _value(file: Path, line: int, text: str) -> Value:
    if not text:
        return []  # items follow
    if text.startswith("["):
        if not text.endswith("]"):
            raise FormatError(f"{file}:{line}: expected a list that ends in ], got {text[:60]!r}")
        return [_number(file, line, part.strip()) for part in text[1:-1].split(",")]
    if DECIMAL_NUMBER.fullmatch(text):
        return _number(file, line, text)
    return text.strip("\"'")


def _number(file: Path, line: int, text: str) -> float:
    if not DECIMAL_NUMBER.fullmatch(text) or not np.isfinite(float(text)):
        raise FormatError(f"{file}:{line}: expected a finite number, got {text[:60]!r}")
    return float(text)


def list_of(values: dict[str, Value], key: str, length: int, *, where: str) -> list[float]:
    """Take a list out of parameters.

    Args:
        values: The parameters.
        key: Name of the list.
        length: How many numbers it must have.
        where: File, for the message.

    Returns:
        The numbers.

    Raises:
        FormatError: If it is no list of so many.
    """
    value = values[key]
    if not isinstance(value, list) or len(value) != length:
        raise FormatError(f"{where}: {key}: expected a list of {length} numbers, got {value!r}")
    return value


def number_of(values: dict[str, Value], key: str, *, where: str) -> float:
    """Take a number out of parameters.

    Args:
        values: The parameters.
        key: Its name.
        where: File, for the message.

    Returns:
        The number.

    Raises:
        FormatError: If it is none.
    """
    value = values[key]
    if not isinstance(value, float):
        raise FormatError(f"{where}: {key}: expected a number, got {value!r}")
    return value
