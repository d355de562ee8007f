# SPDX-License-Identifier: BSD-3-Clause
"""How a text holds a table: encoding, quotes, delimiter and decimal sign; and why a text cannot be read as a table."""

from __future__ import annotations

import codecs
import contextlib
import csv
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import BinaryIO, cast

from forcetorque.base.errors import FormatError
from forcetorque.formats.headings import headings_of, named_columns, repeated_heading_message
from forcetorque.formats.tabular.numbers import is_date

LOOKED_AT = 1 << 20
"""Bytes from the beginning of a text that are looked at; lines are counted in all of it."""
PROBED_LINES = 4
"""Lines of which the first ones of a table are."""
DELIMITERS = ("\t", ";", ",", " ")
"""What may stand between columns, the surest first."""
MOST_COLUMNS = 10_000
"""More columns are not looked at."""
_MOST_SKIPPED = 64
"""Lines in front of a table that are looked through."""
_FEWEST_BELOW = 8
"""Rows below such lines, so that no prose with a few numbers is a table."""
_COMMA = re.compile(r"[+-]?\d*,\d+(?:[eE][+-]?\d+)?")
_THOUSANDS = re.compile(r"[+-]?[1-9]\d{0,2},\d{3}")
"""What may be a number of four to six digits as well."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TableForm:
    """How a text holds a table."""

    delimiter: str
    """Character between columns."""
    decimal: str
    """Character in front of decimals."""
    names: tuple[str, ...]
    """Names of the columns, or their numbers."""
    has_headings: bool
    """Whether a line has the names."""
    skipped: tuple[str, ...] = ()
    """Lines in front."""
    names_apart: bool = False
    """Whether the last two of those have names and units."""

    @property
    def lines_above(self) -> int:
        """Lines in front of the first row."""
        return len(self.skipped) + int(self.has_headings and not self.names_apart)

    def is_bare(self, column: int) -> bool:
        """Check whether a column lacks a heading where others have one.

        Args:
            column: Its place.

        Returns:
            Whether it is called by its number.
        """
        return self.has_headings and self.names[column] == str(column + 1)

    def cells(self, line: str) -> list[str]:
        """Take a line apart.

        Args:
            line: The line.

        Returns:
            Its cells, those with numbers as Python writes them.
        """
        return _with_points(cells_of(line, self.delimiter), self.decimal)


def first_lines(path: Path) -> str:
    """Read the first lines.

    Args:
        path: The file.

    Returns:
        The text, without the last line where it may be cut; empty where it is no text.
    """
    with open_text(path) as file:
        data = file.read(LOOKED_AT)
        if file.read(4):
            data = data[: data.rfind(b"\n") + 1]
    if b"\0" in data:
        return ""
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return ""


def table_form(text: str) -> TableForm | None:
    """Find how a text holds a table, from its first line on or below lines of something else.

    Args:
        text: The first lines.

    Returns:
        The form; None where it holds none, or one whose headings come twice or are one too few.
    """
    lines = text.splitlines()
    probed = [line for line in lines if line.strip()][:PROBED_LINES]
    form = _form_of_lines(probed)
    if form is not None or repeated_headings(probed) or lacks_last_heading(probed):
        return form
    for count in range(1, min(len(lines), _MOST_SKIPPED + 1)):
        form = _form_of_lines(lines[count : count + PROBED_LINES])
        if form is None:
            continue
        first = count + int(form.has_headings)
        if _is_below(form, lines[:first], lines[first:]):
            return _with_units(replace(form, skipped=tuple(lines[:count])), lines)
    return None


def named_form(path: Path, text: str, names: Sequence[str]) -> TableForm | None:
    """Find how a text holds a table whose columns have names that are not its own.

    Args:
        path: The file, for messages.
        text: Its first lines.
        names: Names of all columns.

    Returns:
        The form, in which a line of headings is one in front; None where the text holds no table.

    Raises:
        FormatError: If the names are not one for each column.
    """
    form = table_form(text)
    if form is None:  # the first line may have fewer headings than there are columns
        first, _, rest = text.partition("\n")
        form = table_form(rest)
        form = None if form is None or form.has_headings else replace(form, skipped=(first, *form.skipped))
    if form is None:
        return None
    if len(names) != len(form.names) or len(set(names)) < len(names) or not all(names):
        raise FormatError(
            f"{path}: expected a name for each of {len(form.names)} columns, each once, got {len(names)}: "
            f"{', '.join(names)}"
        )
    skipped = tuple(text.splitlines()[: form.lines_above])
    return replace(form, names=tuple(names), has_headings=False, names_apart=False, skipped=skipped)


def repeated_headings(lines: Sequence[str]) -> tuple[str, ...]:
    """Give the headings of some lines where one comes twice.

    Args:
        lines: The first lines of a text, none of them empty.

    Returns:
        All headings; none where each comes once, or the first line is not one of headings above rows.
    """
    for delimiter in DELIMITERS:
        rows = [cells_of(line, delimiter) for line in lines]
        if rows and len(rows[0]) > 1 and len({len(row) for row in rows}) == 1:
            first, *others = rows
            names = [cell for cell in first if not is_value_or_empty(cell)]
            if len(names) > len(first) / 2 and are_rows([_with_points(row, _decimal(others)) for row in others]):
                return tuple(first) if len(set(names)) < len(names) else ()
    return ()


def lacks_last_heading(lines: Sequence[str]) -> bool:
    """Check whether rows end with a delimiter that their headings end without.

    Args:
        lines: The first lines of a text, none of them empty.

    Returns:
        Whether the first line has one cell less than the others, none of it a number, and the others nothing in it.
    """
    for delimiter in DELIMITERS:
        first, *others = ([cells_of(line, delimiter) for line in lines]) or [[]]
        if len(first) > 1 and not any(map(is_value_or_empty, first)) and are_rows(others):
            return all(len(row) == len(first) + 1 and not row[-1] for row in others)
    return False


def _with_units(form: TableForm, lines: Sequence[str]) -> TableForm:
    """The same with names and units of two lines, where these are what stands above."""
    first = form.lines_above
    names, units = (form.cells(line) for line in lines[first - 2 : first]) if first > 1 else ((), ())
    headings = headings_of(names, units)
    if headings is None:
        return form
    return replace(form, names=headings, has_headings=True, skipped=tuple(lines[:first]), names_apart=True)


def _form_of_lines(lines: Sequence[str]) -> TableForm | None:
    for delimiter in DELIMITERS:
        texts = [cells_of(line, delimiter) for line in lines]
        if not texts or not 2 <= len(texts[0]) <= MOST_COLUMNS or len({len(row) for row in texts}) > 1:
            continue
        decimal = _decimal(texts[1:])
        first, *others = rows = [_with_points(row, decimal) for row in texts]
        if all(map(is_value_or_empty, first)):
            names = tuple(str(k) for k in range(1, len(first) + 1))
            if not are_rows(rows):
                return None
            return TableForm(delimiter=delimiter, decimal=decimal, names=names, has_headings=False)
        if are_rows(others) and _are_headings(texts[0], others):
            return TableForm(delimiter=delimiter, decimal=decimal, names=named_columns(texts[0]), has_headings=True)
    return None


def _are_headings(cells: Sequence[str], rows: Sequence[Sequence[str]]) -> bool:
    """Whether each comes once; a column without one is empty, but for the first, which may count the rows."""
    bare = [k for k, cell in enumerate(cells) if k and not cell and any(row[k] for row in rows)]
    names = named_columns(cells)
    return len(set(names)) == len(names) and not bare


def _is_below(form: TableForm, above: Sequence[str], below: Sequence[str]) -> bool:
    """Whether lines are rows of a table, enough of them, and none above them is."""
    rows, others = ([form.cells(line) for line in lines if line.strip()] for lines in (below, above))
    width = len(form.names)
    return (
        len(rows) >= _FEWEST_BELOW
        and {len(row) for row in rows} == {width}
        and are_rows(rows)
        and not any(len(row) == width and are_rows([row]) for row in others)
    )


def are_rows(rows: Sequence[Sequence[str]]) -> bool:
    """Check whether each has two numbers or dates, and none begins with another text, as lines of prose do.

    Args:
        rows: Cells of lines.

    Returns:
        Whether there are rows, and all are such.
    """
    return bool(rows) and all(sum(map(_is_value, row)) >= 2 and is_value_or_empty(row[0]) for row in rows)


def is_value_or_empty(cell: str) -> bool:
    """Check whether a cell may be one of numbers or dates.

    Args:
        cell: The cell.

    Returns:
        Whether it is empty, a number with a decimal point, or a date with a time of day.
    """
    return not cell or _is_value(cell)


def has_decimal_comma(cell: str) -> bool:
    """Check whether a cell is a number if its comma stands in front of decimals.

    Args:
        cell: The cell.

    Returns:
        Whether it is; it may have digits by thousands as well.
    """
    return _COMMA.fullmatch(cell) is not None


def _is_value(cell: str) -> bool:
    return _is_number(cell) or is_date(cell)


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return "_" not in cell


def _decimal(rows: Sequence[Sequence[str]]) -> str:
    """A comma where one stands in numbers, not all of which may be thousands, and a point in none."""
    cells = [cell for row in rows for cell in row]
    commas = [cell for cell in cells if has_decimal_comma(cell)]
    is_comma = any(not _THOUSANDS.fullmatch(cell) for cell in commas)
    return "," if is_comma and not any("." in cell and _is_number(cell) for cell in cells) else "."


def _with_points(cells: list[str], decimal: str) -> list[str]:
    if decimal == ".":
        return cells
    return [cell.replace(",", ".") if has_decimal_comma(cell) else cell for cell in cells]


_DATE = re.compile(r"'?\d{1,4}[-/.]\d{1,2}[-/.]\d{1,4}([T ]|$)|'?\d{1,2}:\d{2}(:|$)")
_TABLES = {".csv", ".tsv"}
"""Endings of files of which one line alone is that of headings."""
_SHOWN = 40
"""Characters of a cell that are shown."""


def rejection_reason(path: Path) -> str | None:
    """Give the reason why a file cannot be read as a table.

    Args:
        path: A file that is not recognised as one.

    Returns:
        Where, what was expected, what is there, and what to do; None where it is nothing like a table.
    """
    text = first_lines(path)
    if not text.strip():
        return _of_encoding(path)
    lines = [(number, line) for number, line in enumerate(text.splitlines(), start=1) if line.strip()][:PROBED_LINES]
    repeated = repeated_headings([line for _, line in lines])
    if repeated:
        return repeated_heading_message(path, lines[0][0], repeated)
    if len(lines) == 1 and path.suffix.lower() in _TABLES:
        return f"{path}:{lines[0][0]}: expected rows of numbers below the headings, got none"
    numbers = [number for number, _ in lines]
    for delimiter in DELIMITERS:
        rows = [cells_of(line, delimiter) for _, line in lines]
        reason = None if min(map(len, rows), default=0) < 2 else _of_rows(rows, numbers, delimiter)
        if reason is not None:
            return f"{path}:{reason}"
    return None


def _of_encoding(path: Path) -> str | None:
    with path.open("rb") as file:
        data = file.read(LOOKED_AT)
    if not data.strip():
        return f"{path}: expected a log, got an empty file; was the recording stopped before it began?"
    for name, code in (("UTF-16", "utf-16-le"), ("UTF-16", "utf-16-be"), ("another encoding than UTF-8", "cp1252")):
        text = data[: len(data) // 2 * 2].decode(code, errors="replace")
        if "\0" not in text and table_form(text[: text.rfind("\n") + 1]) is not None:
            return (
                f"{path}: expected a table in UTF-8, or in UTF-16 with a byte-order mark, got {name}; save it as UTF-8"
            )
    return None


def _of_rows(rows: Sequence[Sequence[str]], numbers: Sequence[int], delimiter: str) -> str | None:
    """What keeps lines from being a table with a delimiter, from the number of the line on."""
    headings, below = rows[0], rows[1:]
    if len({len(row) for row in below}) != 1:
        return None
    plain = [["0" if _DATE.match(cell) or has_decimal_comma(cell) else cell for cell in row] for row in below]
    if all(map(is_value_or_empty, headings)) or not are_rows(plain):
        return None
    if len(headings) != len(below[0]):
        got = f"{len(headings)} headings and {len(below[0])} columns in line {numbers[1]}"
        if not any(row[-1] for row in below):
            got += f": a {delimiter!r} ends each row"
        return (
            f"{numbers[0]}: expected a heading for every column, got {got}; make the first line as long as the others, "
            f"or specify skip_rows = {numbers[0]} and column_names of [[recording.stream]]: in `forcetorque init` "
            "--column-names with a name for each column, between commas"
        )
    for k, cell in enumerate(below[0], start=1):
        if _DATE.match(cell) and not is_date(cell):
            return (
                f"{numbers[1]}: expected the time as a number, or as 2026-11-23T10:05:03.123, got {cell[:_SHOWN]!r} in "
                f"column {k}; write it so, or as seconds, or delete the column"
            )
        if has_decimal_comma(cell):
            return (
                f"{numbers[1]}: expected decimals behind points, or behind commas throughout, got {cell[:_SHOWN]!r} in "
                f"column {k}, whose comma may stand behind thousands; write its numbers with points"
            )
    return None


QUOTE = '"'
"""What may stand around a cell."""


def cells_of(line: str, delimiter: str) -> list[str]:
    """Take a line apart.

    Args:
        line: The line.
        delimiter: Character between columns; a space stands for any run of blanks, and cells then have no quotes.

    Returns:
        Its cells, without blanks and quotes around them.
    """
    if delimiter == " ":
        return line.split()
    cells = line.split(delimiter)
    if QUOTE in line:
        with contextlib.suppress(csv.Error):  # of a cell of megabytes, which is no number either
            (cells,) = csv.reader([line], delimiter=delimiter, quotechar=QUOTE)
    return [cell.strip() for cell in cells]


def has_open_quote(line: str, delimiter: str) -> bool:
    """Check whether a cell of a line begins with a quote and does not end with one.

    Args:
        line: The line.
        delimiter: As above.

    Returns:
        Whether one does.
    """
    if delimiter == " " or QUOTE not in line:
        return False
    try:
        list(csv.reader([line], delimiter=delimiter, quotechar=QUOTE, strict=True))
    except csv.Error:
        return True
    return False


def quote_of(delimiter: str) -> str | bool:
    """Give Arrow the quote of cells.

    Args:
        delimiter: Character between columns.

    Returns:
        The quote; False for none.
    """
    return False if delimiter == " " else QUOTE


_MARKS = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)


def open_text(file: Path) -> BinaryIO:
    """Open a text file.

    Args:
        file: The file; it exists.

    Returns:
        Its bytes, those of UTF-16 as UTF-8 where the file begins with a byte-order mark; what is no character becomes
        one that no number has, so that the reader of the line refuses it.
    """
    stream = file.open("rb")
    mark = stream.read(len(_MARKS[0]))
    stream.seek(0)
    if mark not in _MARKS:
        return stream
    return cast(BinaryIO, codecs.EncodedFile(stream, "utf-8", "utf-16", errors="replace"))
