# SPDX-License-Identifier: BSD-3-Clause
"""What is wrong with a table, by the errors of its validation, in the words of all other messages."""

from __future__ import annotations

from pydantic import ValidationError
from pydantic_core import ErrorDetails

_TABLES = ("model_type", "model_attributes_type", "dict_type")
_COMPARED = {
    "greater than or equal to ": "at least ",
    "greater than ": "more than ",
    "less than or equal to ": "at most ",
}


def expected_text(entry: ErrorDetails) -> str:
    """Say what was expected at one place of a table.

    Args:
        entry: One error of a validation.

    Returns:
        What was expected, without what is there instead.
    """
    if entry["type"] == "missing":
        return "expected this key, there is none"
    if entry["type"] == "union_tag_invalid":
        return f"expected one of {entry['ctx']['expected_tags']}"
    if entry["type"] in _TABLES:
        return "expected a table"
    if entry["type"] == "union_tag_not_found":
        return "expected this key, there is none"
    if entry["type"] == "too_short" and "ctx" in entry:
        least = entry["ctx"]["min_length"]
        return f"expected at least {least} value{'s' * (least > 1)}"
    if entry["type"] == "value_error":
        return entry["msg"].removeprefix("Value error, ")
    if entry["type"] == "extra_forbidden":
        return "expected no such key"
    words = entry["msg"].removeprefix("Input should be ")
    if words == entry["msg"]:
        return words
    for comparison, shorter in _COMPARED.items():
        words = words.replace(comparison, shorter)
    return f"expected {words}"


def first_error(error: ValidationError, *, whole: str = "content") -> str:
    """Say where a table is wrong first, and what was expected there.

    Args:
        error: What validation found.
        whole: What the table is called where no key of it is at fault.

    Returns:
        Keys apart by dots, and what was expected.
    """
    first = error.errors()[0]
    return f"{'.'.join(map(str, first['loc'])) or whole}: {expected_text(first)}"
