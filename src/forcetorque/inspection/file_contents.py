# SPDX-License-Identifier: BSD-3-Clause
"""Contents of files: streams and clocks of a recording, calibrations of makers, and undeclared columns."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Annotated

import numpy as np

from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.formats.log_format import LogSketch, SketchedColumns
from forcetorque.formats.prior.prior_file import PriorFile
from forcetorque.formats.tabular.numbers import ISO8601
from forcetorque.recording.alignment import ClockShift
from forcetorque.recording.stream import Signal, Stream
from forcetorque.results.table import Row, Shown, Table, Values

NO_NUMBERS = "a text"
"""What a column of something else than numbers looks like."""
_MOST_SHOWN = 60
"""Characters of the signals of a stream in the table; JSON has all."""


class StreamRow(Row):
    """One stream."""

    samples: int
    """Number of samples."""
    rate_hz: float | None
    """Rate by the median time between samples; None for fewer than two."""
    longest_gap_s: float | None
    """Longest time between samples; None for fewer than two."""
    clock: str
    """Clock of the stamps; only streams of one clock are combined."""
    holds: tuple[str, ...]
    """Its signals: quantity, number of columns, units, frame."""


def stream_rows(streams: Mapping[str, Stream]) -> dict[str, StreamRow]:
    """Describe streams.

    Args:
        streams: Streams by name.

    Returns:
        A record for each, by name.
    """
    return {name: _stream_record(stream) for name, stream in streams.items()}


def stream_table(rows: Mapping[str, StreamRow], caption: str) -> Table:
    """Make the table of streams.

    Args:
        rows: Streams by name.
        caption: Name of the inspected file or folder.

    Returns:
        A line per stream.
    """
    return Table(
        caption=caption,
        headings=("stream", "samples", "rate, Hz", "longest gap, s", "clock", "holds"),
        rows=tuple(
            (name, str(row.samples), _shown(row.rate_hz), _shown(row.longest_gap_s), row.clock, _short(row.holds))
            for name, row in rows.items()
        ),
    )


def _stream_record(stream: Stream) -> StreamRow:
    steps = np.diff(stream.stamp_ns) * 1e-9
    period = float(np.median(steps)) if len(steps) else 0.0
    return StreamRow(
        samples=len(stream),
        rate_hz=1.0 / period if period > 0.0 else None,
        longest_gap_s=float(steps.max()) if len(steps) else None,
        clock=stream.clock,
        holds=tuple(map(_held, stream.signals.values())),
    )


def _held(signal: Signal) -> str:
    units = ", ".join(dict.fromkeys(signal.units))
    return f"{signal.quantity} x {len(signal.units)}, {units}" + (
        f" in {signal.frame}" if signal.frame is not None else ""
    )


def _shown(number: float | None) -> str:
    return "" if number is None else f"{number:.3g}"


def _short(holds: tuple[str, ...]) -> str:
    text = "; ".join(holds)
    return text if len(text) <= _MOST_SHOWN else f"{text[: _MOST_SHOWN - 3]}..."


class ClockRow(Row):
    """One `[[clock]]` of the experiment file."""

    stream: str
    """Stream whose stamps are corrected; of several that share a clock, the first."""
    to: str
    """Stream whose clock is kept."""
    estimated: bool
    """Whether the delay was to be estimated; else it is specified in the file."""
    delay_s: float | None
    """Delay of its stamps in the middle of the stream; None where the recording does not determine it."""
    delay_half_width_95_s: float | None
    """Half of its 95 % interval; None where it was specified, or is undetermined."""
    drift: float | None
    """Seconds by which the delay grows in a second; None where it is undetermined."""
    drift_half_width_95: float | None
    """Half of its 95 % interval; None where it was not estimated."""
    drift_not_requested: float | None
    """Drift that the recording shows although the file has none; None for none."""
    shown_by: str | None
    """Quantity that the delay was estimated from; None where it was specified, or is undetermined."""
    explained: float | None
    """Share of the variance of one stream that the other explains; None likewise."""
    undetermined: str | None
    """Why the recording does not determine the delay; None where it does, or it was specified."""


def clock_rows(clocks: Iterable[ClockShift]) -> tuple[ClockRow, ...]:
    """Make the records of clocks.

    Args:
        clocks: Shifts of the clocks, in the order of the file.

    Returns:
        A record for each.
    """
    return tuple(map(_clock_record, clocks))


def _clock_record(shift: ClockShift) -> ClockRow:
    is_determined = shift.undetermined is None
    return ClockRow(
        stream=shift.stream,
        to=shift.to,
        estimated=not is_determined or shift.shown_by is not None,
        delay_s=shift.delay_s if is_determined else None,
        delay_half_width_95_s=shift.delay_half_width_s,
        drift=shift.drift if is_determined else None,
        drift_half_width_95=shift.drift_half_width,
        drift_not_requested=shift.drift_not_requested,
        shown_by=shift.shown_by,
        explained=shift.explained,
        undetermined=shift.undetermined,
    )


class MatrixRow(Row):
    """One component of the matrix of a maker."""

    component: str
    """fx to tz."""
    unit: str
    """N or N m."""
    full_scale: float | None
    """Full scale, in the unit; None where the file has none."""
    coefficients: Values
    """Coefficient of every channel, in the unit per raw unit."""

    def by_channel(self) -> dict[str, object]:
        """Make a flat record, with a key per channel: six channels are not a wrench.

        Returns:
            Values by key, `channel_0` and so on among them.
        """
        channels = {f"channel_{k}": value for k, value in enumerate(self.coefficients.tolist())}
        return {"component": self.component, "unit": self.unit, "full_scale": self.full_scale, **channels}


class MakerCalibration(Row):
    """The calibration of a maker."""

    form: str
    """Kind of the file."""
    serial: str | None
    """Serial number; None where the file has none."""
    date: str | None
    """Date of calibration, as in the file; None where it has none."""
    raw_unit: str
    """Unit of the channels."""
    rows: tuple[MatrixRow, ...]
    """The matrix."""
    notes: tuple[str, ...]
    """Remarks about the file."""

    def table(self, caption: str) -> Table:
        """Make the table of the matrix.

        Args:
            caption: Name of the file.

        Returns:
            A line per component.
        """
        channels = len(self.rows[0].coefficients)
        per = "" if self.raw_unit == "N, N m" else f" per {self.raw_unit.removesuffix('s')}"
        return Table(
            caption=f"{caption}: {self.form}, serial number {self.serial or 'not stated'}, {self.date or 'no date'}",
            headings=("component", "unit", "full scale", *(f"channel {k}{per}" for k in range(channels))),
            rows=tuple(
                (
                    row.component,
                    row.unit,
                    "" if row.full_scale is None else f"{row.full_scale:g}",
                    *(f"{value:.5g}" for value in row.coefficients),
                )
                for row in self.rows
            ),
        )


class ColumnRow(Row):
    """A column of a table, or an array, that is not declared."""

    column: Annotated[str, Shown("column or array")]
    """Name."""
    rows: Annotated[int, Shown("rows")]
    """Number of rows."""
    columns: Annotated[int, Shown("columns")]
    """Number of columns; 1 in a table."""
    unit: Annotated[str | None, Shown("unit")]
    """Unit in its heading; None for none."""
    smallest: Annotated[float | None, Shown("smallest", digits=4)]
    """Smallest of its numbers; None where none was read."""
    largest: Annotated[float | None, Shown("largest", digits=4)]
    """Largest of its numbers; None where none was read."""
    mean: Annotated[float | None, Shown("mean", digits=4)]
    """Mean of its numbers; None where none was read."""
    looks_like: Annotated[str | None, Shown("looks like")]
    """What it looks like by its name; None for nothing. Nothing is read by that."""


def calibration_row(file: PriorFile) -> MakerCalibration:
    """Make the record of the calibration of a maker.

    Args:
        file: Contents of its file.

    Returns:
        The record.
    """
    full_scale = [None] * 6 if file.full_scale is None else file.full_scale.tolist()
    return MakerCalibration(
        form=file.form,
        serial=file.serial,
        date=file.date,
        raw_unit=file.raw_unit.value,
        rows=tuple(
            MatrixRow(component=component, unit=unit, full_scale=scale, coefficients=coefficients)
            for component, unit, scale, coefficients in zip(
                WRENCH_COMPONENTS, WRENCH_UNITS, full_scale, file.matrix, strict=True
            )
        ),
        notes=file.notes,
    )


def column_rows(sketch: LogSketch, likely: dict[int, str]) -> tuple[ColumnRow, ...]:
    """Describe columns.

    Args:
        sketch: The log.
        likely: Quantities that the names of columns match, by index.

    Returns:
        A record for each.
    """
    return tuple(_column_row(column, likely.get(k)) for k, column in enumerate(sketch.columns))


def times_text(sketch: LogSketch) -> str:
    """Explain the times of a dataset whose format makes them up.

    Args:
        sketch: The dataset.

    Returns:
        A message.
    """
    return (
        f"{len(sketch.episodes)} episode(s), each a recording; times are made up, frame / {sketch.rate_hz:g} Hz, "
        "so jitter, lost frames and delays are not seen; `forcetorque dataset check` examines all episodes"
    )


def sketch_text(rows: Sequence[ColumnRow]) -> str:
    """Explain why a log needs an experiment file.

    Returns:
        A message.
    """
    numbers = [row for row in rows if row.looks_like != NO_NUMBERS]
    without = sum(row.unit is None for row in numbers)
    if not numbers:
        reason = "no column is known to have numbers"
    elif without:
        reason = f"units are missing in {without} of {len(numbers)} columns of numbers"
    else:
        reason = "its headings have units, but state neither frames nor signs"
    names = [row.column for row in rows]
    unnamed = names == [str(k) for k in range(1, len(names) + 1)]
    option = "; give a name for each column by --column-names, for the file has no headings" * unnamed
    return f"the log is read with an experiment file that describes it, because {reason}{option}"


def _column_row(column: SketchedColumns, looks_like: str | None) -> ColumnRow:
    return ColumnRow(
        column=column.name,
        rows=column.rows,
        columns=column.columns,
        unit=column.unit,
        smallest=column.smallest,
        largest=column.largest,
        mean=column.mean,
        looks_like=looks_like if column.is_number or column.unit == ISO8601 else NO_NUMBERS,
    )
