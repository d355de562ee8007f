# SPDX-License-Identifier: BSD-3-Clause
"""From the files of a workbench to blocks: which position each is of, and the bias that it is taken from."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from forcetorque.analysis.workbench.bench_file import BlockReadings, LogReadings, RowReadings
from forcetorque.arrays import FloatArray
from forcetorque.errors import ExperimentError, FormatError, known_names
from forcetorque.exchange.tabular import StampColumn, TableLayout, TableSignal, read_table
from forcetorque.experiment.inputs import Inputs
from forcetorque.exsitu import BIAS, BenchLoads, Block
from forcetorque.recording import Stream


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Recorded:
    """A block at a position and the block without load before it."""

    block: Block
    """The position."""
    bias: Block
    """The bias."""


def recorded_blocks(
    readings: BlockReadings | LogReadings, names: tuple[str, ...], full_scale: FloatArray, inputs: Inputs
) -> list[Recorded]:
    """Read the blocks that there are.

    Args:
        readings: How they are stated.
        names: Names of all positions in their order.
        full_scale: Largest magnitude of a reading of every channel; shape (c,); counts.
        inputs: Resolves the files.

    Returns:
        Blocks as they were recorded.
    """
    if isinstance(readings, LogReadings):
        return list(_from_log(readings, names, full_scale, inputs))
    return list(_from_files(readings, names, full_scale, inputs))


def _from_files(
    readings: BlockReadings, names: tuple[str, ...], full_scale: FloatArray, inputs: Inputs
) -> Iterator[Recorded]:
    left = list(names)
    for file, stated in _files(readings, names, inputs):
        path = inputs.file(Path(file))
        (stream,) = read_table(path, _layout(readings), stream=file, clock=file).streams
        samples = _raw(stream)
        rows = readings.block_rows
        count, beyond = divmod(len(samples), rows)
        if beyond or count < 2:
            raise FormatError(
                f"{path}: expected a block of {rows} rows without load, then blocks of {rows} rows, got {len(samples)} "
                "rows; was the recording cut? See block_rows"
            )
        positions = [stated] if stated is not None else left[: count - 1]
        if len(positions) != count - 1:
            raise FormatError(f"{path}: expected {len(positions)} positions after the bias, got {count - 1} blocks")
        left = left[len(positions) :]
        bias, *blocks = (
            Block.of(
                position,
                samples[k * rows : (k + 1) * rows],
                full_scale,
                source=f"{file}, rows {k * rows + 1}-{(k + 1) * rows}",
            )
            for k, position in enumerate([BIAS, *positions])
        )
        for block in blocks:
            yield Recorded(block=block, bias=bias)


def _files(readings: BlockReadings, names: tuple[str, ...], inputs: Inputs) -> Iterator[tuple[str, str | None]]:
    """Files that exist, with the position of each where its name tells it."""
    if not isinstance(readings.files, str):
        yield from ((file, None) for file in readings.files)
        return
    numbered = [(readings.files.replace("{}", str(k)), name) for k, name in enumerate(names, start=1)]
    yield from ((file, name) for file, name in numbered if (inputs.folder / file).is_file())


def _from_log(
    readings: LogReadings, names: tuple[str, ...], full_scale: FloatArray, inputs: Inputs
) -> Iterator[Recorded]:
    path = inputs.file(readings.file)
    stamp = StampColumn(column=readings.time, unit=readings.time_unit)
    (stream,) = read_table(path, _layout(readings, stamp), stream=readings.file.name, clock="log").streams
    samples, time = _raw(stream), 1e-9 * (stream.stamp_ns - stream.stamp_ns[0])
    bias = None
    for stretch in readings.block:
        if stretch.position not in (BIAS, *names):
            raise ExperimentError(
                f"readings.block: no position is called {stretch.position!r}; "
                f"{known_names(stretch.position, (BIAS, *names))}"
            )
        within = (time >= stretch.start_s) & (time < stretch.end_s)
        source = f"{readings.file}, {stretch.start_s:g}-{stretch.end_s:g} s"
        if not within.any():
            raise ExperimentError(f"readings.block: {source}: expected rows of the log, there is none")
        block = Block.of(stretch.position, samples[within], full_scale, source=source, time_s=time[within])
        if stretch.position == BIAS:
            bias = block
        elif bias is not None:
            yield Recorded(block=block, bias=bias)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RecordedRows:
    """A table of mean readings, and the loads that it states."""

    raw: FloatArray
    """Mean readings; shape (n, c); counts; NaN where there is none."""
    loads: BenchLoads | None
    """Loads by line of the file; None where the table states none."""


def recorded_rows(readings: RowReadings, inputs: Inputs) -> RecordedRows:
    """Read a table of mean readings.

    Args:
        readings: How it is stated.
        inputs: Resolves the file.

    Returns:
        Readings and loads.
    """
    path = inputs.file(readings.file)
    (stream,) = read_table(path, _row_layout(readings), stream=readings.file.name, clock="rows").streams
    raw = _raw(stream)
    if readings.known is None:
        return RecordedRows(raw=raw, loads=None)
    wrench = stream.signal("wrench").values
    first = 1 if readings.columns is not None else 2
    lines = [str(first + k) for k in range(len(raw))]
    stated = np.flatnonzero(np.isfinite(raw).any(axis=1) | np.isfinite(wrench).any(axis=1))
    begins = np.cumsum(~wrench[stated].any(axis=1)) if readings.series_from_zero else np.zeros(len(stated), dtype=int)
    names = {number: lines[stated[np.flatnonzero(begins == number)[0]]] for number in np.unique(begins)}
    loads = BenchLoads(
        names=tuple(lines[k] for k in stated),
        wrench=wrench[stated],
        series=tuple(f"from line {names[number]}" for number in begins),
    )
    return RecordedRows(raw=raw[stated], loads=loads)


def _raw(stream: Stream) -> FloatArray:
    return stream.signal("raw").values


def _signal(readings: BlockReadings | LogReadings | RowReadings) -> TableSignal:
    channels = readings.channels
    return TableSignal(quantity="raw", columns=channels, units=("counts",) * len(channels), names=channels)


def _layout(readings: BlockReadings | LogReadings, stamp: StampColumn | None = None) -> TableLayout:
    return TableLayout(
        delimiter=readings.delimiter, column_names=readings.columns, stamp=stamp, signals=(_signal(readings),)
    )


def _row_layout(readings: RowReadings) -> TableLayout:
    signals = [_signal(readings)]
    if readings.known is not None and readings.known_units is not None:
        signals.append(
            TableSignal(quantity="wrench", columns=readings.known, units=readings.known_units, frame="sensor")
        )
    return TableLayout(delimiter=readings.delimiter, column_names=readings.columns, stamp=None, signals=tuple(signals))
