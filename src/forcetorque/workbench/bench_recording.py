# SPDX-License-Identifier: BSD-3-Clause
"""A workbench file with all that it points to: blocks of samples, each at a position."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.errors import ExperimentError, FormatError, UnitError, known_names, require_known
from forcetorque.base.toml_file import one_for_each, read_toml
from forcetorque.base.units import si_factor
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS, MeasureDirection
from forcetorque.experiment.calibration.calibration_file import read_calibration
from forcetorque.experiment.calibration.sensor_model import component_names, measured_components
from forcetorque.experiment.named_files import Inputs, stated_in
from forcetorque.experiment.sensors import IDENTITY
from forcetorque.experiment.workbench_file import (
    BIAS,
    THESIS_TABLE,
    BenchFile,
    BenchSensorTable,
    BlockReadings,
    LogReadings,
    PlacementTable,
    RowReadings,
)
from forcetorque.formats.icub_matrix import read_matrix_file
from forcetorque.formats.tabular.table import read_table
from forcetorque.formats.tabular.table_layout import StampColumn, TableLayout, TableSignal
from forcetorque.recording.stream import Stream
from forcetorque.workbench.known_loads import BenchLoads, read_loads
from forcetorque.workbench.position_means import Bench, Block, Placement


def _blocks_of_files(
    readings: BlockReadings, names: tuple[str, ...], full_scale: FloatArray, inputs: Inputs
) -> Iterator[Block]:
    """Blocks of positions with their bias, in the order of the files that exist."""
    left = list(names)
    for file, position in _files(readings, names, inputs):
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
        positions = [position] if position is not None else left[: count - 1]
        if len(positions) != count - 1:
            raise FormatError(f"{path}: expected {len(positions)} positions after the bias, got {count - 1} blocks")
        left = left[len(positions) :]
        bias = None
        for k, name in enumerate([BIAS, *positions]):
            source = f"{file}, rows {k * rows + 1}-{(k + 1) * rows}"
            block = Block.of(name, samples[k * rows : (k + 1) * rows], full_scale, source=source, bias=bias)
            if bias is None:
                bias = block
            else:
                yield block


def _files(readings: BlockReadings, names: tuple[str, ...], inputs: Inputs) -> Iterator[tuple[str, str | None]]:
    """Files that exist, with the position of each where the name of the file determines it."""
    if not isinstance(readings.files, str):
        yield from ((file, None) for file in readings.files)
        return
    numbered = [(readings.files.replace("{}", str(k)), name) for k, name in enumerate(names, start=1)]
    yield from ((file, name) for file, name in numbered if (inputs.folder / file).is_file())


def _blocks_of_log(
    readings: LogReadings, names: tuple[str, ...], full_scale: FloatArray, inputs: Inputs
) -> Iterator[Block]:
    """Blocks of positions with their bias, in the order of the intervals."""
    path = inputs.file(readings.file)
    stamp = StampColumn(column=readings.time, unit=readings.time_unit)
    (stream,) = read_table(path, _layout(readings, stamp), stream=readings.file.name, clock="log").streams
    samples, time = _raw(stream), 1e-9 * (stream.stamp_ns - stream.stamp_ns[0])
    bias = None
    for interval in readings.block:
        if interval.position not in (BIAS, *names):
            raise ExperimentError(
                f"measurements.block: no position is called {interval.position!r}; "
                f"{known_names(interval.position, (BIAS, *names))}"
            )
        within = (time >= interval.start_s) & (time < interval.end_s)
        source = f"{readings.file}, {interval.start_s:g}-{interval.end_s:g} s"
        if not within.any():
            raise ExperimentError(f"measurements.block: {source}: expected rows of the log, there is none")
        is_bias = interval.position == BIAS
        block = Block.of(
            interval.position,
            samples[within],
            full_scale,
            source=source,
            time_s=time[within],
            bias=None if is_bias else bias,
        )
        if is_bias:
            bias = block
        elif bias is not None:
            yield block


def _table_of_means(
    readings: RowReadings, measured: BoolArray, inputs: Inputs
) -> tuple[FloatArray, BenchLoads | None, FloatArray | None]:
    """Mean raw samples, shape (n, c), counts, NaN where missing; loads by line, where the table has them; last bias."""
    path = inputs.file(readings.file)
    (stream,) = read_table(path, _row_layout(readings), stream=readings.file.name, clock="rows").streams
    raw = _raw(stream)
    if readings.known is None:
        return raw, None, None
    states_components = _states_components(readings)
    wrench = _measured_loads(readings, measured, path) if states_components else stream.signal("wrench").values
    first = 1 if readings.columns is not None else 2
    lines = [str(first + k) for k in range(len(raw))]
    stated = wrench[:, measured] if states_components else wrench
    filled = np.isfinite(raw).any(axis=1) | np.isfinite(stated).any(axis=1)
    raw, wrench, lines = raw[filled], wrench[filled], [lines[k] for k in np.flatnonzero(filled)]
    zero = np.flatnonzero(~wrench.any(axis=1))
    if not readings.series_from_zero:
        loads = BenchLoads(names=tuple(lines), wrench=wrench, series=("all",) * len(lines), named="line")
        return raw, loads, None
    if not len(zero) or zero[0] > 0:
        raise ExperimentError(
            f"measurements.series_from_zero: expected the first row of {readings.file} to be without load, got line "
            f"{lines[0] if len(lines) else first} with one; begin the table with such a row, or delete the key"
        )
    own = zero[np.searchsorted(zero, np.arange(len(raw)), side="right") - 1]  # the row without load before each
    used = np.setdiff1d(np.arange(len(raw)), zero)
    loads = BenchLoads(
        names=tuple(lines[k] for k in used),
        wrench=wrench[used],
        series=tuple(f"from line {lines[k]}" for k in own[used]),
        named="line",
    )
    return (raw - raw[own])[used], loads, raw[zero[-1]]


def _states_components(readings: RowReadings) -> bool:
    """Whether the table has fewer than six components of the known wrench."""
    return readings.known is not None and len(readings.known) < len(WRENCH_COMPONENTS)


def _measured_loads(readings: RowReadings, measured: BoolArray, path: Path) -> FloatArray:
    """Known wrenches of a table that has the measured components alone, zeros for the others; shape (n, 6); N, N m."""
    columns, units = readings.known or (), readings.known_units or ()
    names = np.array(WRENCH_COMPONENTS)[measured].tolist()
    if len(columns) != len(names):
        raise ExperimentError(
            f"measurements.known: expected a column for each of fx, fy, fz, tx, ty, tz, or for each of the components "
            f"that are measured ({', '.join(names)}), got {len(columns)}"
        )
    factors = []
    for column, unit, expected in zip(columns, units, np.array(WRENCH_UNITS)[measured], strict=True):
        si_unit, factor = si_factor(unit)
        if si_unit != expected:
            raise UnitError(f"{path}: {column!r}: expected a unit that converts to {expected}, got {unit!r}")
        factors.append(factor)
    signal = TableSignal(quantity="raw", columns=columns, units=("counts",) * len(columns), names=columns)
    layout = replace(_row_layout(readings), signals=(signal,))
    (stream,) = read_table(path, layout, stream=readings.file.name, clock="rows").streams
    wrench = np.zeros((len(_raw(stream)), len(WRENCH_COMPONENTS)))
    wrench[:, measured] = _raw(stream) * factors
    return wrench


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
    if readings.known is not None and readings.known_units is not None and not _states_components(readings):
        signals.append(
            TableSignal(quantity="wrench", columns=readings.known, units=readings.known_units, frame="sensor")
        )
    return TableLayout(delimiter=readings.delimiter, column_names=readings.columns, stamp=None, signals=tuple(signals))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BenchRecording:
    """Contents of one workbench file, and what was recorded so far."""

    file: str
    """The file."""
    sensor: BenchSensorTable
    """The sensor."""
    loads: BenchLoads
    """All loads, recorded or not."""
    left_out: tuple[str, ...]
    """Positions that the file leaves out."""
    blocks: tuple[Block, ...]
    """Blocks of positions in the order of the recording; none of a table of means."""
    bench: Bench | None
    """Measurements of the loads; None before the first."""
    inputs_sha256: dict[str, str]
    """SHA-256 of every file that was read."""

    @classmethod
    def of(cls, bench: Bench, *, measure_direction: MeasureDirection, frame: str = "sensor") -> BenchRecording:
        """Make a recording of arrays, without a file.

        Args:
            bench: Measurements of the sensor.
            measure_direction: Who acts on whom in the measurement; the load is the child.
            frame: Frame along whose axes loads are specified.

        Returns:
            The recording.
        """
        sensor = BenchSensorTable(
            name=bench.sensor,
            serial=bench.serial,
            measure_direction=measure_direction,
            frame=frame,
            full_scale=tuple(bench.full_scale.tolist()),
            components=tuple(np.array(WRENCH_COMPONENTS)[bench.measured].tolist()),
            load_full_scale=None if bench.load_full_scale is None else tuple(bench.load_full_scale.tolist()),
        )
        return cls(
            file=bench.serial,
            sensor=sensor,
            loads=bench.loads,
            left_out=(),
            blocks=(),
            bench=bench,
            inputs_sha256={},
        )


def read_bench(path: Path | str) -> BenchRecording:
    """Read a workbench file and what it points to.

    Args:
        path: TOML file; paths in it are relative to it.

    Returns:
        Loads, blocks and readings.

    Raises:
        FormatError: If the file is a table of readings.
    """
    if Path(path).suffix.lower() in {".csv", ".tsv", ".txt", ".dat"}:
        raise FormatError(
            f"{path}: expected a workbench file (TOML), which names sensor and columns of such a table, got the table; "
            "docs/workbench.md shows the file"
        )
    content = read_toml(path, BenchFile, what="a workbench file")
    inputs = Inputs(Path(path).parent)
    with stated_in(str(path)):
        return _recording(str(path), content, inputs)


def _recording(file: str, content: BenchFile, inputs: Inputs) -> BenchRecording:
    sensor, readings = content.sensor, content.measurements
    if len(readings.channels) < (components := int(sensor.measured.sum())):
        raise ExperimentError(
            f"measurements.channels: expected at least {components}, one for each component, got "
            f"{len(readings.channels)}; a sensor that measures fewer names them as components of [sensor]"
        )
    full_scale = _full_scale(sensor, len(readings.channels))
    blocks: list[Block] = []
    if isinstance(readings, RowReadings):
        raw, known, bias = _table_of_means(readings, sensor.measured, inputs)
        loads = known or _loads(content, inputs)
        if len(raw) > len(loads):
            raise ExperimentError(
                f"measurements.file: expected a row for each of {len(loads)} positions, got {len(raw)}"
            )
        names, error, time = loads.names[: len(raw)], None, None
    else:
        loads = _loads(content, inputs)
        if isinstance(readings, LogReadings):
            blocks = list(_blocks_of_log(readings, loads.names, full_scale, inputs))
        else:
            blocks = list(_blocks_of_files(readings, loads.names, full_scale, inputs))
        names = tuple(block.position for block in blocks)
        biases = [block.bias for block in blocks if block.bias is not None]
        raw = np.array([block.change for block in blocks])
        error = np.array(
            [np.hypot(block.standard_error, bias.standard_error) for block, bias in zip(blocks, biases, strict=True)]
        )
        bias = biases[-1].mean if biases else None
        times = [block.time_s for block in blocks]
        time = None if None in times else np.array(times, dtype=np.float64)
    pairs = _used(names, loads, content.loads.leave_out)
    used = [k for k, _ in pairs]
    bench = None
    if pairs:
        bench = Bench(
            sensor=sensor.name,
            serial=sensor.serial,
            loads=loads.select([position for _, position in pairs]),
            raw=raw[used],
            standard_error=None if error is None else error[used],
            full_scale=full_scale,
            bias=bias,
            time_s=None if time is None else time[used],
            prior=_prior(sensor, len(readings.channels), inputs),
            measured=sensor.measured,
            load_full_scale=None if sensor.load_full_scale is None else np.array(sensor.load_full_scale),
            placement=None if content.placement is None else _placement(content.placement),
        )
    return BenchRecording(
        file=file,
        sensor=sensor,
        loads=loads,
        left_out=content.loads.leave_out,
        blocks=tuple(blocks),
        bench=bench,
        inputs_sha256=inputs.sha256(),
    )


def _loads(content: BenchFile, inputs: Inputs) -> BenchLoads:
    table = content.loads.table
    source = table if table == THESIS_TABLE else inputs.file(Path(table))
    return read_loads(source, measure_direction=content.sensor.measure_direction)


def _full_scale(sensor: BenchSensorTable, channels: int) -> FloatArray:
    limits = one_for_each(sensor.full_scale, channels)
    if len(limits) != channels:
        raise ExperimentError(
            f"sensor.full_scale: expected a number for each of {channels} channels, got {len(limits)}"
        )
    return np.array(limits)


def _used(names: Sequence[str], loads: BenchLoads, left_out: Sequence[str]) -> list[tuple[int, int]]:
    """Indices of blocks that are used, with those of their positions; of a repeated position the last block."""
    for name in left_out:
        require_known(name, loads.names, ExperimentError, f"loads.leave_out: no position {name!r}")
    last = {name: k for k, name in enumerate(names)}
    return [(k, loads.names.index(name)) for name, k in last.items() if name not in left_out]


def _placement(table: PlacementTable) -> Placement:
    return Placement(
        angle_rad=math.radians(table.angle_deg),
        position_m=1e-3 * table.position_mm,
        nonlinearity=table.nonlinearity,
    )


def _prior(sensor: BenchSensorTable, channels: int, inputs: Inputs) -> FloatArray | None:
    if sensor.prior is None:
        return None
    if sensor.prior == IDENTITY:
        count = int(sensor.measured.sum())
        if channels != count:
            raise ExperimentError(
                f'sensor.prior: "identity" expects a channel for each of {count} components, got {channels}'
            )
        return np.eye(6)[:, sensor.measured]
    path = inputs.file(Path(sensor.prior))
    matrix = read_calibration(path).matrix if path.suffix == ".json" else read_matrix_file(path).matrix
    if matrix.shape[1] != channels:
        raise ExperimentError(f"sensor.prior: expected a matrix of {channels} channels, got {matrix.shape[1]}")
    if (wrong := measured_components(matrix) != sensor.measured).any():
        raise ExperimentError(
            f"sensor.prior: expected rows that are zero just where components names none, got otherwise for "
            f"{component_names(wrong)}; write components for the rows that are not zero"
        )
    return matrix
