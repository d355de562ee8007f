# SPDX-License-Identifier: BSD-3-Clause
"""A workbench file with all that it points to: blocks of samples, each at a position."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FormatError, known_names
from forcetorque.base.toml_file import read_toml
from forcetorque.base.wrench import MeasureDirection
from forcetorque.experiment.calibration.artefact import read_calibration
from forcetorque.experiment.input_files import Inputs, stated_in
from forcetorque.experiment.sensors import IDENTITY
from forcetorque.formats.icub_matrix import read_matrix_file
from forcetorque.formats.tabular.table import read_table
from forcetorque.formats.tabular.table_layout import StampColumn, TableLayout, TableSignal
from forcetorque.recording.stream import Stream
from forcetorque.workbench.bench import BIAS, Bench, Block, Placement
from forcetorque.workbench.loads import THESIS_TABLE, BenchLoads, read_loads
from forcetorque.workbench.workbench_file import (
    BenchFile,
    BenchSensorTable,
    BlockReadings,
    LogReadings,
    PlacementTable,
    RowReadings,
)


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


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BenchRecording:
    """What one workbench file says, and what was recorded so far."""

    file: str
    """The file."""
    sensor: BenchSensorTable
    """The sensor."""
    loads: BenchLoads
    """All loads, recorded or not."""
    left_out: tuple[str, ...]
    """Positions that the file leaves out."""
    recorded: tuple[Recorded, ...]
    """Blocks as they came; none of a table of means."""
    bench: Bench | None
    """What was read of loads; None before anything is."""
    inputs_sha256: dict[str, str]
    """SHA-256 of every file that was read."""

    @classmethod
    def of(cls, bench: Bench, *, measure_direction: MeasureDirection, frame: str = "sensor") -> BenchRecording:
        """Take what a sensor read from arrays, without a file.

        Args:
            bench: What it read.
            measure_direction: Who acts on whom in the reading; the load is the child.
            frame: Frame along whose axes loads are stated.

        Returns:
            The same as of a file.
        """
        sensor = BenchSensorTable(
            name=bench.sensor,
            serial=bench.serial,
            measure_direction=measure_direction,
            frame=frame,
            full_scale=tuple(bench.full_scale.tolist()),
        )
        return cls(
            file=bench.serial,
            sensor=sensor,
            loads=bench.loads,
            left_out=(),
            recorded=(),
            bench=bench,
            inputs_sha256={},
        )


def read_bench(path: Path | str) -> BenchRecording:
    """Read a workbench file and what it points to.

    Args:
        path: TOML file; paths in it are relative to it.

    Returns:
        Loads, blocks and readings.
    """
    stated = read_toml(path, BenchFile, what="a workbench file")
    inputs = Inputs(Path(path).parent)
    with stated_in(str(path)):
        return _recording(str(path), stated, inputs)


def _recording(file: str, stated: BenchFile, inputs: Inputs) -> BenchRecording:
    sensor, readings = stated.sensor, stated.readings
    full_scale = _full_scale(sensor, len(readings.channels))
    recorded: list[Recorded] = []
    if isinstance(readings, RowReadings):
        rows = recorded_rows(readings, inputs)
        loads = rows.loads or _loads(stated, inputs)
        if len(rows.raw) > len(loads):
            raise ExperimentError(
                f"readings.file: expected a row for each of {len(loads)} positions, got {len(rows.raw)}"
            )
        names, raw, error, bias, time = loads.names[: len(rows.raw)], rows.raw, None, None, None
    else:
        loads = _loads(stated, inputs)
        recorded = recorded_blocks(readings, loads.names, full_scale, inputs)
        names = tuple(entry.block.position for entry in recorded)
        raw = np.array([entry.block.mean - entry.bias.mean for entry in recorded])
        error = np.array([np.hypot(entry.block.standard_error, entry.bias.standard_error) for entry in recorded])
        bias = recorded[-1].bias.mean if recorded else None
        times = [entry.block.time_s for entry in recorded]
        time = None if None in times else np.array(times, dtype=np.float64)
    used = _used(names, loads, stated.loads.leave_out)
    taken = [k for k, _ in used]
    bench = None
    if used:
        bench = Bench(
            sensor=sensor.name,
            serial=sensor.serial,
            loads=loads.taken([place for _, place in used]),
            raw=raw[taken],
            standard_error=None if error is None else error[taken],
            full_scale=full_scale,
            bias=bias,
            time_s=None if time is None else time[taken],
            prior=_prior(sensor, len(readings.channels), inputs),
            placement=None if stated.placement is None else _placement(stated.placement),
        )
    return BenchRecording(
        file=file,
        sensor=sensor,
        loads=loads,
        left_out=stated.loads.leave_out,
        recorded=tuple(recorded),
        bench=bench,
        inputs_sha256=inputs.sha256(),
    )


def _loads(stated: BenchFile, inputs: Inputs) -> BenchLoads:
    table = stated.loads.table
    source = table if table == THESIS_TABLE else inputs.file(Path(table))
    return read_loads(source, measure_direction=stated.sensor.measure_direction)


def _full_scale(sensor: BenchSensorTable, channels: int) -> FloatArray:
    stated = sensor.full_scale
    if isinstance(stated, float):
        return np.full(channels, stated)
    if len(stated) != channels:
        raise ExperimentError(
            f"sensor.full_scale: expected a number for each of {channels} channels, got {len(stated)}"
        )
    return np.array(stated)


def _used(names: Sequence[str], loads: BenchLoads, left_out: Sequence[str]) -> list[tuple[int, int]]:
    """Numbers of blocks that are used, with those of their positions; of a repeated position the last block."""
    for name in left_out:
        if name not in loads.names:
            raise ExperimentError(f"loads.leave_out: no position {name!r}; {known_names(name, loads.names)}")
    last = {name: k for k, name in enumerate(names)}
    return [(k, loads.names.index(name)) for name, k in last.items() if name not in left_out]


def _placement(stated: PlacementTable) -> Placement:
    return Placement(
        angle_rad=math.radians(stated.angle_deg),
        position_m=1e-3 * stated.position_mm,
        nonlinearity=stated.nonlinearity,
    )


def _prior(sensor: BenchSensorTable, channels: int, inputs: Inputs) -> FloatArray | None:
    if sensor.prior is None:
        return None
    if sensor.prior == IDENTITY:
        if channels != 6:
            raise ExperimentError(f'sensor.prior: "identity" expects six channels, got {channels}')
        return np.eye(6)
    path = inputs.file(Path(sensor.prior))
    matrix = read_calibration(path).matrix if path.suffix == ".json" else read_matrix_file(path).matrix
    if matrix.shape[1] != channels:
        raise ExperimentError(f"sensor.prior: expected a matrix of {channels} channels, got {matrix.shape[1]}")
    return matrix
