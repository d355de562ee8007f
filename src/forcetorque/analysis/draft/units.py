# SPDX-License-Identifier: BSD-3-Clause
"""Units as questions: those that are usual, and what a unit of time would make of a log."""

from __future__ import annotations

from collections.abc import Mapping

from forcetorque.analysis.draft.text import line, question
from forcetorque.exchange.log_sketch import SketchedColumns

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
