# SPDX-License-Identifier: BSD-3-Clause
"""Applied wrenches on a force plate, of an instrumented pole [1] or of weights, with what the plate measures of each.

The pole has a load cell along it and markers, and is pressed by hand: its force goes through the tip, along the pole,
without a couple.

References:
    [1] S. H. Collins, P. G. Adamczyk, D. P. Ferris, A. D. Kuo, A simple method for calibrating force plates and force
        treadmills using an instrumented pole, Gait and Posture 29 (2009).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, true_runs
from forcetorque.base.errors import ExperimentError, FormatError, require_known
from forcetorque.base.input_file import read_text
from forcetorque.base.pose import invert_pose
from forcetorque.base.wrench import MeasureDirection, reading_sign, transform_wrench
from forcetorque.formats.c3d.force_platform import ForcePlate
from forcetorque.formats.c3d.plate_conventions import factor_of, stated_unit
from forcetorque.plates.plate_file import PlateFile
from forcetorque.plates.weight_on_plates import STEADY, WINDOW_S
from forcetorque.workbench.known_loads import BenchLoads, LoadTable, read_loads
from forcetorque.workbench.position_means import Bench

_PRESSED = 0.2
"""Share of the largest force of the pole above which it is pressed: light samples determine little."""
_FREE = 0.05
"""Share of it below which nothing is pressed."""
_SHORTEST_S = 0.1
"""Shortest push, and shortest pause."""
_SLIDING_M = 0.005
"""Distance by which the tip may move in a push; m."""
_FEWEST = 6
"""Pushes, or weights, without which no matrix is determined."""
ONE_MASS = 0.01
"""Relative difference of weights below which gain and offset of Fz cannot be separated."""
_ONE_MASS_NOTE = "all weights have one mass: gain and offset of Fz cannot be separated; use two masses or more"
_SHORTEST_POLE_M = 0.1
"""Least distance of the two markers on the pole."""
_TIP_M = 0.05
"""Largest distance of the marker at the tip from the surface."""
_RANGE = 2.0
"""Full scale over the largest measurement, where a plate states none."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class AppliedLoads(ArrayRecord):
    """Known loads on a plate."""

    bench: Bench
    """Loads and measurements, in the direction of the measurement; raw samples are N and N m about the centre of the
    surface, and the prior matrix is the identity."""
    centre_m: FloatArray = field(metadata=array("n", 2))
    """Where each load acts on the surface, from its centre along the axes of the plate; shape (n, 2); m."""
    source: str
    """Source of the loads, as text."""
    notes: tuple[str, ...] = ()
    """What was left out."""


def loads_of_pole(
    plates: PlateFile,
    plate: ForcePlate,
    *,
    tip: str,
    head: str,
    load_cell: str,
    serial: str,
    measure_direction: MeasureDirection,
) -> AppliedLoads:
    """Compute the wrenches of a pole that is pressed on a plate at many places and tilts.

    Args:
        plates: The trial.
        plate: The plate.
        tip: Label of the marker at the tip, where the force acts.
        head: Label of a marker on the axis of the pole.
        load_cell: Label of the channel of the load cell, compression positive, in N or kN.
        serial: Serial number of the plate.
        measure_direction: Who acts on whom in the channels; the pole is the child.

    Returns:
        A load per push.

    Raises:
        ExperimentError: If markers or channel are not there or the markers are exchanged, the plate has no place, or
            there are too few pushes.
    """
    path = plates.file.path
    if plate.lab_H_plate is None:
        raise ExperimentError(f"{path}: plate {plate.number}: expected CORNERS of a rectangle, to place the pole on it")
    if tip == head:
        raise ExperimentError(f"{path}: --tip, --head: expected two markers, got {tip!r} for both")
    tip_m, head_m = (_marker(plates, label, option) for label, option in ((tip, "--tip"), (head, "--head")))
    cell = _of_frames(plates, _channel(plates, load_cell)[:, None])[:, 0]
    measured = _of_frames(plates, plate.wrench)
    peak = float(np.percentile(cell, 99.0))
    if not peak > 0.0 or abs(float(cell.min())) > peak:
        raise ExperimentError(
            f"{path}: {load_cell}: expected compression above 0, got {cell.min():.0f} to {cell.max():.0f} N: "
            "export the load cell with the other sign"
        )
    rate = plates.file.frame_rate_hz
    shortest = max(2, round(_SHORTEST_S * rate))
    zero, notes = _zero_of_cell(cell, peak, shortest)
    seen = np.isfinite(tip_m).all(axis=1) & np.isfinite(head_m).all(axis=1)
    pushes, sliding = [], 0
    for first, last in true_runs((cell > _PRESSED * peak) & seen):
        if last - first + 1 < shortest:
            continue
        if float(np.ptp(tip_m[first : last + 1], axis=0).max()) > _SLIDING_M:
            sliding += 1
            continue
        pushes.append(slice(first, last + 1))
    if sliding:
        notes.append(f"{sliding} push(es) in which the tip moved by over {1e3 * _SLIDING_M:g} mm are left out")
    if len(pushes) < _FEWEST:
        raise ExperimentError(
            f"{path}: expected at least {_FEWEST} pushes of {_SHORTEST_S:g} s at places of their own, got {len(pushes)}"
            f" ({sliding} slid): press longer, without sliding"
        )
    plate_H_lab = invert_pose(plate.lab_H_plate)
    tip_in_plate, head_in_plate = (m @ plate_H_lab[:3, :3].T + plate_H_lab[:3, 3] for m in (tip_m, head_m))
    pressed = np.concatenate([np.arange(push.start, push.stop) for push in pushes])
    _require_pole(path, tip_in_plate[pressed], head_in_plate[pressed])
    axis = head_m - tip_m
    length = np.linalg.norm(axis, axis=1, keepdims=True)
    force = -(cell - zero)[:, None] * axis / length
    lab = np.hstack([force, np.cross(tip_m, force)])
    applied = transform_wrench(plate_H_lab, lab)
    names = tuple(f"push {k}" for k in range(1, len(pushes) + 1))
    sign = -reading_sign(measure_direction, child_is_outboard=True)
    wrench = sign * np.array([applied[push].mean(axis=0) for push in pushes])
    loads = BenchLoads(names=names, wrench=wrench, series=("all",) * len(names))
    raw = np.array([measured[push].mean(axis=0) for push in pushes])
    time = np.array([0.5 * (push.start + push.stop - 1) for push in pushes]) / rate
    return AppliedLoads(
        bench=_bench(plate, serial, loads, raw, time),
        centre_m=np.array(
            [_on_surface(tip_in_plate[push].mean(axis=0), head_in_plate[push].mean(axis=0)) for push in pushes]
        ),
        source=f"{len(pushes)} pushes of a pole, up to {peak:.0f} N",
        notes=tuple(notes),
    )


def _require_pole(path: Path, tip_m: FloatArray, head_m: FloatArray) -> None:
    """Refuse markers whose places in the axes of the plate are not those of tip and head; shape (n, 3); m."""
    length = float(np.median(np.linalg.norm(head_m - tip_m, axis=1)))
    if not length >= _SHORTEST_POLE_M:
        raise ExperimentError(
            f"{path}: --tip, --head: expected markers at least {_SHORTEST_POLE_M:g} m apart, got {length:.3g} m: "
            "choose one near each end of the pole"
        )
    # the distance from the surface, as z points down or up by the order of the corners
    tip, head = (float(np.median(np.abs(marker[:, 2]))) for marker in (tip_m, head_m))
    if tip > _TIP_M or head < tip:
        raise ExperimentError(
            f"{path}: --tip, --head: expected the tip within {1e3 * _TIP_M:g} mm of the surface and the head farther, "
            f"got {1e3 * tip:.0f} and {1e3 * head:.0f} mm: are they exchanged?"
        )


def _on_surface(tip_m: FloatArray, head_m: FloatArray) -> FloatArray:
    """Where the axis of the pole meets the surface, z = 0 in the axes of the plate; shape (2,); m."""
    axis = head_m - tip_m
    return np.asarray((tip_m - axis * (tip_m[2] / axis[2]))[:2], dtype=np.float64)


def loads_of_weights(
    plates: PlateFile, plate: ForcePlate, table: Path, *, serial: str, measure_direction: MeasureDirection
) -> AppliedLoads:
    """Compute the wrenches of weights that stand on a plate one after the other.

    Args:
        plates: The trial.
        plate: The plate.
        table: Table of weights as `read_loads` has it, in the axes of the plate from the centre of its surface, z down,
            with `start_s` and `end_s` of each.
        serial: Serial number of the plate.
        measure_direction: Who acts on whom in the channels; the weight is the child.

    Returns:
        A load per weight.

    Raises:
        FormatError: If the table has no intervals.
        ExperimentError: If intervals overlap or leave the file, a load is not steady in its own, or there are too few
            weights.
    """
    loads = read_loads(table, measure_direction=measure_direction)
    if loads.weights is None or len(loads) < _FEWEST:
        raise ExperimentError(f"{table}: expected at least {_FEWEST} weights, got {len(loads)}")
    rate = plates.file.analog_rate_hz
    time, raw = plates.time_s, []
    spans = _spans(table, len(time) / rate)
    for name, (start, end), known in zip(loads.names, spans, loads.wrench, strict=True):
        within = (time >= start) & (time < end)
        where = f"{table}: weight {name!r}"
        if not within.any():
            raise ExperimentError(f"{where}: expected samples from {start:g} to {end:g} s, the file has none")
        _require_steady(where, (start, end), plate.wrench[within, 2], float(np.linalg.norm(known[:3])), rate)
        raw.append(plate.wrench[within].mean(axis=0))
    middle = np.array([0.5 * (start + end) for start, end in spans])
    return AppliedLoads(
        bench=_bench(plate, serial, loads, np.array(raw), middle),
        centre_m=loads.weights.position_m[:, :2],
        source=f"{len(loads)} weights, up to {loads.weights.total_kg.max():g} kg",
        notes=(_ONE_MASS_NOTE,) if np.ptp(loads.wrench[:, 2]) < ONE_MASS * np.abs(loads.wrench[:, 2]).max() else (),
    )


def _bench(plate: ForcePlate, serial: str, loads: BenchLoads, raw: FloatArray, time_s: FloatArray) -> Bench:
    return Bench(
        sensor=plate.name,
        serial=serial,
        loads=loads,
        raw=raw,
        full_scale=_RANGE * np.maximum(np.abs(raw).max(axis=0), 1.0),
        time_s=time_s,
        prior=np.eye(6),
    )


def _spans(table: Path, end_of_file_s: float) -> list[tuple[float, float]]:
    """Intervals of the weights, apart from each other and within the file; s."""
    rows = LoadTable(str(table), read_text(table, "a table of weights"))
    try:
        spans = list(zip(rows.column("start_s").tolist(), rows.column("end_s").tolist(), strict=True))
    except FormatError as error:
        raise FormatError(f"{error}: expected numbers start_s and end_s of each weight") from error
    for number, (start, end) in enumerate(spans, start=1):
        if not 0.0 <= start < end <= end_of_file_s:
            raise ExperimentError(
                f"{table}: weight {number}: expected start_s before end_s, from 0 to {end_of_file_s:g} s, got "
                f"{start:g} to {end:g} s: state the interval in which it stands"
            )
    order = sorted(range(len(spans)), key=spans.__getitem__)
    for one, other in pairwise(order):
        if spans[other][0] < spans[one][1]:
            raise ExperimentError(
                f"{table}: weights {one + 1} and {other + 1}: expected intervals apart, got {spans[one][0]:g} to "
                f"{spans[one][1]:g} s and {spans[other][0]:g} to {spans[other][1]:g} s: they stand one after the other"
            )
    return spans


def _require_steady(where: str, span: tuple[float, float], down: FloatArray, known_N: float, rate_hz: float) -> None:
    """Refuse an interval in which the weight is put down or taken away."""
    count = max(1, len(down) // max(1, round(WINDOW_S * rate_hz)))
    means = np.array([window.mean() for window in np.array_split(down, count)])
    if not np.abs(means - np.median(means)).max() <= STEADY * known_N:
        raise ExperimentError(
            f"{where}, start_s: expected a steady load from {span[0]:g} to {span[1]:g} s, got Fz {means.min():.0f} to "
            f"{means.max():.0f} N; state the interval in which it stands"
        )


def _of_frames(plates: PlateFile, samples: FloatArray) -> FloatArray:
    """Means of the samples of each frame; shape (f, k)."""
    return samples.reshape(-1, plates.file.samples_per_frame, samples.shape[1]).mean(axis=1)


def _channel(plates: PlateFile, label: str) -> FloatArray:
    file = plates.file
    require_known(
        label, file.analog_labels, ExperimentError, f"{file.path}: --load-cell: no channel is called {label!r}"
    )
    k = file.analog_labels.index(label)
    factor = factor_of(stated_unit(file.analog_units[k]), "N")
    if factor is None:
        raise ExperimentError(
            f"{file.path}: {label}: expected a channel in N or kN, got {file.analog_units[k]!r}: export it in N"
        )
    return factor * file.analog[:, k]


def _marker(plates: PlateFile, label: str, option: str) -> FloatArray:
    file = plates.file
    require_known(label, file.marker_labels, ExperimentError, f"{file.path}: {option}: no marker is called {label!r}")
    factor: Any = factor_of(stated_unit(file.length_unit) or plates.table.length_unit, "m")
    return np.asarray(factor * file.markers[:, file.marker_labels.index(label)], dtype=np.float64)


def _zero_of_cell(cell: FloatArray, peak: float, shortest: int) -> tuple[float, list[str]]:
    """Mean of the load cell in pauses, without their ends; zero where there is none."""
    pauses = [slice(first + 1, last) for first, last in true_runs(cell < _FREE * peak) if last - first >= shortest]
    if not pauses:
        return 0.0, ["there is no pause without load: the zero of the load cell is taken as it is"]
    return float(np.median(np.concatenate([cell[pause] for pause in pauses]))), []
