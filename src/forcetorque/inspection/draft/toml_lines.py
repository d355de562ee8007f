# SPDX-License-Identifier: BSD-3-Clause
"""Lines of a TOML file that is drafted or changed: values, questions with their evidence, and usual units."""

from __future__ import annotations

import codecs
import json
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from forcetorque.base.output_file import write_bytes_atomically
from forcetorque.base.run_files import files_of_one_run
from forcetorque.base.toml_file import OPEN, parsed_toml
from forcetorque.formats.log_format import SketchedColumns

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


class Question(str):
    """A line with a question, and the line with the likeliest value."""

    __slots__ = ("likeliest",)
    likeliest: str | None

    def __new__(cls, text: str, likeliest: str | None) -> Question:
        """Make a line.

        Args:
            text: The line.
            likeliest: The line with the likeliest value; None where no value is likely.

        Returns:
            The line.
        """
        question = super().__new__(cls, text)
        question.likeliest = likeliest
        return question


def question(key: str, words: str, likeliest: Any = None) -> str:
    """Write a key to fill in.

    Args:
        key: The key.
        words: The question, with evidence from the log.
        likeliest: The likeliest value, for a first reading of the log; None where no value is likely.

    Returns:
        The line.
    """
    return Question(line(key, OPEN, words), None if likeliest is None else line(key, likeliest))


def likeliest_text(lines: Iterable[str]) -> str:
    """Join lines with the likeliest values, for a first reading of the log.

    Args:
        lines: Lines, some of them questions.

    Returns:
        The text; questions without a likely value are still in it.
    """
    return "\n".join(text.likeliest or text if isinstance(text, Question) else text for text in lines)


def listed(names: Iterable[str], most: int = 24) -> str:
    """List names for a question.

    Args:
        names: The names.
        most: Largest number that is listed; the others are counted.

    Returns:
        The names, with commas.
    """
    all_names = list(names)
    more = f" and {len(all_names) - most} more" if len(all_names) > most else ""
    return ", ".join(all_names[:most]) + more


def _key(key: str) -> str:
    return key if key and all(c.isascii() and (c.isalnum() or c in "_-") for c in key) else toml_value(key)


def _holds_tables(value: Iterable[Any]) -> bool:
    return any(isinstance(entry, Mapping) for entry in value)


TIME_UNITS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
"""Units of time, in seconds."""
USUAL_UNITS = {
    "wrench": '["N", "N", "N", "N m", "N m", "N m"]',
    "position": "rad or deg",
    "velocity": "rad/s or deg/s",
    "acceleration": "rad/s2 or deg/s2",
    "torque": "N m",
    "motor_current": "A or mA",
    "proper_acceleration": "m/s2 or g",
    "angular_velocity": "rad/s or deg/s",
    "orientation": "rad or deg",
    "gravity": "m/s2",
    "temperature": "degC",
    "raw": "counts",
    "pressure": "Pa or kPa",
}
"""Usual units of quantities, for questions only."""

RATE_LINES = (
    "# rate_hz = 100.0  # rows at even steps of time: how many a second",
    "# start_s = 0.0    # time of the first row, s",
)
"""Alternatives to a column of times, as comments."""

_PLAUSIBLE_HZ = (1.0, 10_000.0)
_MOST_TURNS = 13.0
"""Joints and frames seldom turn by more than two turns in rad; in deg they always do."""
_MOST_N = 1e5
"""No sensor of a robot measures larger forces."""


def time_text(column: SketchedColumns) -> str:
    """List rate and duration of a column of times by unit.

    Args:
        column: The column, or the array.

    Returns:
        Text for the question.
    """
    choices = [
        f"{unit} makes {rate:.4g} Hz and {(column.rows - 1) / rate:.4g} s"
        for unit, rate in _usual_rates(column).items()
    ]
    return f"s, ms, us or ns: {'; '.join(choices) or 'none makes a usual rate'}"


def likeliest_time(column: SketchedColumns) -> str | None:
    """Find the unit of a column of times, where only one gives a usual rate.

    Args:
        column: The column, or the array.

    Returns:
        The unit; None where several do, or none.
    """
    rates = list(_usual_rates(column))
    return rates[0] if len(rates) == 1 else None


def _usual_rates(column: SketchedColumns) -> dict[str, float]:
    """Usual rates in Hz by unit, of a log of a second or more."""
    if column.step is None:
        return {}
    rates = {unit: 1.0 / (column.step * factor) for unit, factor in TIME_UNITS.items()}
    low, high = _PLAUSIBLE_HZ
    return {unit: rate for unit, rate in rates.items() if low <= rate <= high and column.rows - 1 >= rate}


def likeliest_units(quantity: str, count: int, largest: float | None) -> list[str] | None:
    """Find the usual units of a quantity.

    Args:
        quantity: The quantity.
        count: Number of columns.
        largest: Largest magnitude in them; None if it is not known.

    Returns:
        A unit for each column; None where there is no usual one.
    """
    if quantity == "wrench" and largest is not None and largest > _MOST_N:
        return None
    if quantity == "wrench":
        return ["N"] * 3 + ["N m"] * 3
    words = USUAL_UNITS.get(quantity, "").split(" or ")
    turned = quantity in ("position", "orientation") and largest is not None and largest > _MOST_TURNS
    return [words[-1 if turned else 0]] * count if words[0] else None


def axes_line(quantity: str, stream: str, frames: Mapping[str, str]) -> str:
    """Write the frame of a signal, or the question for it.

    Args:
        quantity: Its quantity.
        stream: Its stream.
        frames: Sensors by the streams of their wrenches.

    Returns:
        The line.
    """
    if quantity in ("wrench", "applied_wrench") and stream in frames:
        return line("frame", frames[stream])
    words = "link of the URDF, or name of the frame, along whose axes it is"
    near = {frames[stream]} if stream in frames else set(frames.values())
    if len(near) == 1:
        words += f'; "{near.pop()}" for those of the sensor'
    return question("frame", words, "frame")


def text_of(file: Path) -> str:
    r"""Read the text of an experiment file, whose keys may still be to be filled in.

    Returns:
        The text without a byte-order mark, its line ends `\n`.

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If it is not TOML.
    """
    with files_of_one_run():  # the file is rewritten, so that it is no input of what goes on after this
        return parsed_toml(file, what="an experiment file")[0]


def write_text_of(file: Path, text: str) -> None:
    r"""Replace the text of an experiment file, in the form that the file has.

    Args:
        file: The file; with a byte-order mark, and with `\r\n` at the ends of lines, if it has these in most lines.
        text: The text, its line ends `\n`.
    """
    before = file.read_bytes()
    if 2 * before.count(b"\r\n") > before.count(b"\n"):
        text = text.replace("\n", "\r\n")
    mark = codecs.BOM_UTF8 if before.startswith(codecs.BOM_UTF8) else b""
    write_bytes_atomically(file, mark + text.encode())


def tables_of(content: Mapping[str, Any], name: str) -> Sequence[Mapping[str, Any]]:
    """Find the tables of a list.

    Args:
        content: Tables of a file, not checked.
        name: Name of the list.

    Returns:
        The tables; none where the key is no list of tables.
    """
    tables = content.get(name)
    return tables if isinstance(tables, list) and all(isinstance(one, dict) for one in tables) else ()
