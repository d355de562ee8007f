# SPDX-License-Identifier: BSD-3-Clause
"""A workbench file with all that it points to."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from forcetorque.analysis.workbench.bench_file import BenchFile, BenchSensorTable, PlacementTable, RowReadings
from forcetorque.analysis.workbench.bench_readings import Recorded, recorded_blocks, recorded_rows
from forcetorque.arrays import FloatArray
from forcetorque.calibration import read_calibration
from forcetorque.errors import ExperimentError, known_names
from forcetorque.exchange.icub import read_matrix_file
from forcetorque.experiment.inputs import Inputs, stated_in
from forcetorque.experiment.prior import IDENTITY
from forcetorque.exsitu import THESIS_TABLE, Bench, BenchLoads, Placement, read_loads
from forcetorque.spatial import MeasureDirection
from forcetorque.toml_table import read_toml


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
