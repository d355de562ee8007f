# SPDX-License-Identifier: BSD-3-Clause
"""Columns of a recording by the names that people use for them, and scalars such as a temperature."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from difflib import get_close_matches

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import RecordingError, known_names
from forcetorque.recording.alignment import interpolate
from forcetorque.recording.recording import Recording


@dataclass(frozen=True, slots=True, kw_only=True)
class ScalarSource:
    """One column of a recording."""

    stream: str
    """Name of the stream."""
    quantity: str
    """Name of the quantity."""
    column: str
    """Name of the column."""

    def unit(self, recording: Recording) -> str:
        """Give its unit.

        Returns:
            Unit of the column.

        Raises:
            RecordingError: If stream, quantity or column are not there.
        """
        signal = recording.stream(self.stream).signal(self.quantity)
        signal.column(self.column)
        return signal.units[signal.columns.index(self.column)]

    def at(self, recording: Recording, at_ns: IntArray) -> FloatArray:
        """Interpolate over time; never across gaps.

        Args:
            recording: The recording.
            at_ns: Instants; shape (m,); ns.

        Returns:
            Values; shape (m,); NaN in gaps and outside the stream.
        """
        stream = recording.stream(self.stream)
        return interpolate(stream, stream.signal(self.quantity).column(self.column)[:, None], at_ns)[:, 0]


def named_columns(recording: Recording) -> Iterator[tuple[str, ScalarSource]]:
    """Name every column.

    Yields:
        `stream.quantity.column` and the column, in the order of the log.
    """
    for stream in recording.streams.values():
        for signal in stream.signals.values():
            for column in signal.columns:
                source = ScalarSource(stream=stream.name, quantity=signal.quantity, column=column)
                yield f"{stream.name}.{signal.quantity}.{column}", source


def find_column(recording: Recording, name: str) -> ScalarSource:
    """Find a column by `column`, `stream.column` or `stream.quantity.column`, whichever is enough.

    Returns:
        The column.

    Raises:
        RecordingError: If there is none of that name, or several.
    """
    columns = dict(named_columns(recording))
    fitting = [
        full
        for full, source in columns.items()
        if name in (full, f"{source.stream}.{source.column}", source.column)
        or (name in (source.stream, f"{source.stream}.{source.quantity}") and _alone(recording, source, name))
    ]
    if len(fitting) == 1:
        return columns[fitting[0]]
    if fitting:
        raise RecordingError(f"column {name!r}: expected one column, got {', '.join(fitting)}; choose one of them")
    raise RecordingError(f"no column {name!r}; {known_columns(name, column_units(recording))}")


def known_columns(wanted: str, units: Mapping[str, str]) -> str:
    """List columns with their units, the likeliest one first.

    Args:
        wanted: Name that was not found.
        units: Units by name of the column.

    Returns:
        Text to append to a message.
    """
    # com_z for robot.com_y is close by its last component
    spelled = {part.lower(): name for name in units for part in (name.rpartition(".")[2], name)}
    close = get_close_matches(wanted.lower(), spelled, n=1)
    hint = f'did you mean "{spelled[close[0]]}"? ' if close else ""
    return hint + known_names("", [f"{name} ({unit})" for name, unit in units.items()])


def column_units(recording: Recording) -> dict[str, str]:
    """List the columns as people may name them, with their units.

    Returns:
        Units by name: `stream` where that is enough, `stream.column` else, and the full name where that is another's
        too.
    """
    columns = list(named_columns(recording))
    shorter = Counter(f"{source.stream}.{source.column}" for _, source in columns)
    units = {}
    for full, source in columns:
        short = f"{source.stream}.{source.column}"
        name = full if shorter[short] > 1 else source.stream if _alone(recording, source, source.stream) else short
        units[name] = source.unit(recording)
    return units


def _alone(recording: Recording, source: ScalarSource, name: str) -> bool:
    """Whether a name without a column is enough: the stream, or its quantity, has one column only."""
    signals = recording.streams[source.stream].signals
    here = [signals[source.quantity]] if name != source.stream else list(signals.values())
    return sum(len(signal.columns) for signal in here) == 1
