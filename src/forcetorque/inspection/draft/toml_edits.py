# SPDX-License-Identifier: BSD-3-Clause
"""Changes of single keys and intervals in the text of a TOML file; all other lines keep their comments and order."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from forcetorque.inspection.draft.intervals_and_clocks import WHOLE_LOG
from forcetorque.inspection.draft.toml_lines import line, remark, toml_value

_HEADER = re.compile(r"""^\s*\[{1,2}\s*(?P<name>[\w."' -]+?)\s*\]{1,2}\s*(?:#.*)?$""")
_TEXT = re.compile(r""""(?:[^"\\]|\\.)*"|'[^']*'""")


@dataclass(frozen=True, slots=True, kw_only=True)
class Edit:
    """Lines of a file that are replaced by others."""

    line: int
    """First line that is replaced, or before which lines are put; from 1."""
    old: tuple[str, ...]
    """Lines that are replaced; none where lines are put in."""
    new: tuple[str, ...]
    """Lines in their place."""

    @property
    def text(self) -> str:
        """The change in words."""
        new = "; ".join(words for words in self.new if words)
        if not self.old:
            return f"put at line {self.line}: {new}"
        if len(self.old) == len(self.new) == 1:
            return f"line {self.line}: {self.old[0].partition('#')[0].strip()} -> {new.partition('#')[0].strip()}"
        return f"from line {self.line} on, {len(self.old)} lines become {len(self.new)}"

    def applied(self, text: str) -> str:
        """Change a file.

        Args:
            text: Its content.

        Returns:
            The content with the change.
        """
        lines = _lines(text)
        lines[self.line - 1 : self.line - 1 + len(self.old)] = self.new
        return "\n".join(lines) + "\n"

    def results_in(self, content: Mapping[str, Any], text: str) -> bool:
        """Check the effect on a file, whose keys may be written in a form that the change does not expect.

        Args:
            content: Tables that it has to have then.
            text: Its content before.

        Returns:
            Whether it has these, and no others.
        """
        try:
            return tomllib.loads(self.applied(text)) == content
        except tomllib.TOMLDecodeError:
            return False


def key_edit(text: str, table: str, index: int, key: str, value: Any, *, behind: str = "") -> Edit | None:
    """Set a key of a table.

    Args:
        text: Content of the file.
        table: Name of the table, or of a table of a list of tables.
        index: Which of the list, from 0.
        key: The key.
        value: Its value.
        behind: Key behind which it is put if it is not there; the end of the table if empty.

    Returns:
        The change; comments of the first and last line of a key that is there stay. None where the table is not
        written with a header.
    """
    lines = _lines(text)
    extents = table_extents(lines, table)
    if index >= len(extents):
        return None
    first, after = extents[index]
    for place, end in _keys(lines, first + 1, after, key):
        comment = "".join(_comment(lines[at]) for at in dict.fromkeys((place, end - 1)))
        new = f"{key} = {toml_value(value)}{comment}"
        return Edit(line=place + 1, old=tuple(lines[place:end]), new=(new,))
    places = [end - 1 for _, end in _keys(lines, first + 1, after, behind)] if behind else []
    last = next(iter(places), _last_of(lines, first, after))
    return Edit(line=last + 2, old=(), new=(line(key, value),))


def table_edit(text: str, table: str, content: Mapping[str, Any], *, before: str) -> Edit | None:
    """Put a table in front of another.

    Args:
        text: Content of the file.
        table: Name of the list of tables that it is added to.
        content: Its keys.
        before: Name of the other table, of which the first is meant.

    Returns:
        The change; None where the other table is not written with a header.
    """
    lines = _lines(text)
    extents = table_extents(lines, before)
    if not extents:
        return None
    first = extents[0][0]
    while first > 0 and lines[first - 1].startswith("#"):  # comments on the table that follows
        first -= 1
    new = [f"[[{table}]]", *(line(key, value) for key, value in content.items()), ""]
    return Edit(line=first + 1, old=(), new=tuple(new))


def interval_edit(text: str, pieces: Sequence[Sequence[Mapping[str, Any]]]) -> Edit | None:
    """Replace every interval by pieces of it.

    Args:
        text: Content of the file.
        pieces: Keys of each piece of each interval that differ from those of the interval, in the order of the file.

    Returns:
        The change, from the first interval on; None where intervals are not written as `[[interval]]`.
    """
    lines = _lines(text)
    extents = table_extents(lines, "interval")
    if not extents or len(extents) != len(pieces):
        return None
    first, last = extents[0][0], _last_of(lines, *extents[-1])
    new = list(lines[first : last + 1])
    for (start, after), changes in reversed(list(zip(extents, pieces, strict=True))):
        end = _last_of(lines, start, after) + 1
        block = "\n".join(lines[start:end]) + "\n"
        copies = []
        for change in changes:
            copy = block.replace(f"  {remark(WHOLE_LOG)}", "") if change else block
            for key, value in change.items():
                edit = key_edit(copy, "interval", 0, key, value, behind="start_s")
                copy = copy if edit is None else edit.applied(copy)
            copies.append(copy)
        new[start - first : end - first] = _lines("\n".join(copies))
    return Edit(line=first + 1, old=tuple(lines[first : last + 1]), new=tuple(new))


def table_extents(lines: Sequence[str], table: str) -> list[tuple[int, int]]:
    """Find tables by their headers.

    Args:
        lines: Lines of the file.
        table: Name of the table.

    Returns:
        Index of the header, and of the line of the next header, of each table of that name.
    """
    headers = [(k, match["name"]) for k, text in enumerate(lines) if (match := _HEADER.match(text)) is not None]
    headers = [(k, name) for k, name in headers if _is_header(lines, k)]
    ends = [*(k for k, _ in headers[1:]), len(lines)][: len(headers)]
    return [(k, end) for (k, name), end in zip(headers, ends, strict=True) if name == table]


@dataclass(frozen=True, slots=True, kw_only=True)
class TableBlocks:
    """Lines of a table with lists of tables in it."""

    before: tuple[str, ...]
    """Lines in front of it."""
    head: tuple[str, ...]
    """Its header and own keys."""
    inner: tuple[tuple[str, ...], ...]
    """Lines of each table of the list in it, with the tables in these."""
    behind: tuple[str, ...]
    """Lines behind it."""


def table_blocks(text: str, table: str, index: int) -> TableBlocks | None:
    """Divide a file at a table of a list, and this at the tables in it.

    Args:
        text: Content of the file.
        table: Name of the list of tables.
        index: Which of the list, from 0.

    Returns:
        Its lines; None where the table is not written with a header.
    """
    lines = _lines(text)
    extents = table_extents(lines, table)
    if index >= len(extents):
        return None
    start, after = extents[index]
    places = [start]
    headers = ((k, match["name"]) for k in range(after, len(lines)) if (match := _HEADER.match(lines[k])))
    for k, name in headers:
        if not _is_header(lines, k):
            continue
        depth = name.removeprefix(f"{table}.").count(".") if name.startswith(f"{table}.") else -1
        if depth < 0:
            end = k
            break
        if depth == 0:
            places.append(k)
    else:
        end = len(lines)
    while end > places[-1] + 1 and lines[end - 1].startswith("#"):  # comments on the table that follows
        end -= 1
    ends = [*places[1:], end]
    head, *inner = (tuple(lines[a:b]) for a, b in zip(places, ends, strict=True))
    return TableBlocks(before=tuple(lines[:start]), head=head, inner=tuple(inner), behind=tuple(lines[end:]))


def edit_between(old: str, new: str) -> Edit:
    """Find the lines that differ.

    Args:
        old: Content of a file.
        new: Its content after a change.

    Returns:
        The change, from the first line that differs to the last.
    """
    before, after = _lines(old), _lines(new)
    shorter = min(len(before), len(after))
    first = next((k for k in range(shorter) if before[k] != after[k]), shorter)
    same = next((k for k in range(shorter - first) if before[-1 - k] != after[-1 - k]), shorter - first)
    return Edit(
        line=first + 1, old=tuple(before[first : len(before) - same]), new=tuple(after[first : len(after) - same])
    )


def _lines(text: str) -> list[str]:
    """Lines as TOML has them: other separators of Unicode are characters of a comment or a text."""
    return text.removesuffix("\n").split("\n")


def _is_header(lines: Sequence[str], place: int) -> bool:
    """Whether what stands before is complete, so that the line is no element of a list."""
    try:
        tomllib.loads("\n".join(lines[:place]))
    except tomllib.TOMLDecodeError:
        return False
    return True


def _keys(lines: Sequence[str], first: int, after: int, key: str) -> list[tuple[int, int]]:
    """Index of the line of a key, and of the line after its value."""
    start = re.compile(rf"^\s*{re.escape(key)}\s*=")
    for place in range(first, after):
        if start.match(lines[place]):
            for end in range(place + 1, after + 1):
                try:
                    tomllib.loads("\n".join(lines[place:end]))
                except tomllib.TOMLDecodeError:
                    continue
                return [(place, end)]
    return []


def _last_of(lines: Sequence[str], first: int, after: int) -> int:
    """Index of the last line of a table: comments and empty lines behind it belong to the next one."""
    last = after - 1
    while last > first and (not lines[last].strip() or (lines[last].startswith("#") and after < len(lines))):
        last -= 1
    return last


def _comment(text: str) -> str:
    """The comment of a line, with the spaces in front."""
    hidden = _TEXT.sub(lambda match: "x" * len(match[0]), text)
    place = hidden.find("#")
    if place < 0:
        return ""
    before = text[:place]
    return before[len(before.rstrip()) :] + text[place:]
