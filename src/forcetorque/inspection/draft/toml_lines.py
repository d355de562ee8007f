# SPDX-License-Identifier: BSD-3-Clause
"""Lines of a TOML file that is drafted: values, questions with their evidence, and usual units."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from typing import Any

from forcetorque.base.toml_file import OPEN
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
}
"""Units that quantities usually have, for questions; nothing is taken for granted."""

RATE_LINES = (
    "# rate_hz = 100.0  # rows at even steps of time: how many a second",
    "# start_s = 0.0    # time of the first row, s",
)
"""What may stand in place of a time, as comments."""

_PLAUSIBLE_HZ = (1.0, 10_000.0)
_MOST_TURNS = 13.0
"""Joints and frames seldom turn by more than two turns in rad; in deg they always do."""
_MOST_N = 1e5
"""No sensor of a robot reads so much."""


def time_words(column: SketchedColumns) -> str:
    """Say what each unit would make of a column of times.

    Args:
        column: The column, or the array.

    Returns:
        Words for the question.
    """
    choices = [
        f"{unit} makes {rate:.4g} Hz and {(column.rows - 1) / rate:.4g} s"
        for unit, rate in _usual_rates(column).items()
    ]
    return f"s, ms, us or ns: {'; '.join(choices) or 'none makes a usual rate'}"


def likeliest_time(column: SketchedColumns) -> str | None:
    """Give the unit of a column of times, where only one makes a usual rate.

    Args:
        column: The column, or the array.

    Returns:
        The unit; None where several do, or none.
    """
    rates = list(_usual_rates(column))
    return rates[0] if len(rates) == 1 else None


def _usual_rates(column: SketchedColumns) -> dict[str, float]:
    """Rates in Hz by the units that make a usual one, in a log of a second or more."""
    if column.step is None:
        return {}
    rates = {unit: 1.0 / (column.step * factor) for unit, factor in TIME_UNITS.items()}
    low, high = _PLAUSIBLE_HZ
    return {unit: rate for unit, rate in rates.items() if low <= rate <= high and column.rows - 1 >= rate}


def likeliest_units(quantity: str, count: int, largest: float | None) -> list[str] | None:
    """Give the units that a quantity has most often.

    Args:
        quantity: The quantity.
        count: How many columns it has.
        largest: Largest magnitude in them; None if it is not known.

    Returns:
        A unit for each column; None where nothing is usual.
    """
    if quantity == "wrench" and largest is not None and largest > _MOST_N:
        return None
    if quantity == "wrench":
        return ["N"] * 3 + ["N m"] * 3
    words = USUAL_UNITS.get(quantity, "").split(" or ")
    turned = quantity in ("position", "orientation") and largest is not None and largest > _MOST_TURNS
    return [words[-1 if turned else 0]] * count if words[0] else None


def axes_line(quantity: str, stream: str, frames: Mapping[str, str]) -> str:
    """State or ask for the frame of a signal.

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
