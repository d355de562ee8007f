# SPDX-License-Identifier: BSD-3-Clause
"""Lines of a TOML file that is drafted: values, and questions with what is known about them behind."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from typing import Any

from forcetorque.toml_table import OPEN

_LONGEST_LIST = 96
"""Characters of a list that stays on one line."""


def toml_value(value: Any) -> str:
    """Write a value on one line.

    Args:
        value: Text, number, truth, list or mapping of these.

    Returns:
        Its TOML.
    """
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int | float):
        return repr(value)
    if isinstance(value, Mapping):
        inner = ", ".join(f"{_key(key)} = {toml_value(entry)}" for key, entry in value.items())
        return f"{{ {inner} }}"
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(toml_value, value))}]"
    # JSON's escapes are TOML's, but for the one control character that JSON leaves as it is
    return json.dumps(str(value), ensure_ascii=False).replace("\x7f", "\\u007F")


def line(key: str, value: Any, words: str = "") -> str:
    """Write a key with its value.

    Args:
        key: The key.
        value: Its value.
        words: Comment behind it; none if empty.

    Returns:
        The line; of a list that is long, several.
    """
    text = toml_value(value)
    comment = f"  {remark(words)}" if words else ""
    if isinstance(value, list | tuple) and (len(text) > _LONGEST_LIST or _holds_tables(value)):
        entries = "".join(f"  {toml_value(entry)},\n" for entry in value)
        return f"{_key(key)} = [{comment}\n{entries}]"
    return f"{_key(key)} = {text}{comment}"


def remark(words: str) -> str:
    """Write a comment.

    Args:
        words: What it says; names in it may hold anything.

    Returns:
        One line of characters that TOML allows there.
    """
    return f"# {''.join(c if c.isprintable() else ' ' for c in ' '.join(words.split()))}"


class Asked(str):
    """A line with a question, and what it would be if the likeliest answer were right."""

    __slots__ = ("likeliest",)
    likeliest: str | None

    def __new__(cls, text: str, likeliest: str | None) -> Asked:
        """Hold a line.

        Args:
            text: The line.
            likeliest: The same with the likeliest answer; None where nothing is likely.

        Returns:
            The line.
        """
        asked = super().__new__(cls, text)
        asked.likeliest = likeliest
        return asked


def question(key: str, words: str, likeliest: Any = None) -> str:
    """Write a key that somebody has to fill in.

    Args:
        key: The key.
        words: What is asked, and what is known about it.
        likeliest: The likeliest answer, for a first look at the log; None where nothing is likely.

    Returns:
        The line.
    """
    return Asked(line(key, OPEN, words), None if likeliest is None else line(key, likeliest))


def likeliest_text(lines: Iterable[str]) -> str:
    """Give the text with the likeliest answers, for a first look that decides nothing.

    Args:
        lines: Lines, some of them questions.

    Returns:
        The text; questions of which nothing is likely are still in it.
    """
    return "\n".join(one.likeliest or one if isinstance(one, Asked) else one for one in lines)


def listed(names: Iterable[str], most: int = 24) -> str:
    """List names for a question.

    Args:
        names: The names.
        most: How many are listed; the others are counted.

    Returns:
        Them, with commas.
    """
    every = list(names)
    more = f" and {len(every) - most} more" if len(every) > most else ""
    return ", ".join(every[:most]) + more


def _key(key: str) -> str:
    return key if key and all(c.isascii() and (c.isalnum() or c in "_-") for c in key) else toml_value(key)


def _holds_tables(value: Iterable[Any]) -> bool:
    return any(isinstance(entry, Mapping) for entry in value)
