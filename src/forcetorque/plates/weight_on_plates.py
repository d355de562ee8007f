# SPDX-License-Identifier: BSD-3-Clause
"""The weight of who or what stands still on force plates, and what contradicts it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, true_runs
from forcetorque.base.errors import ExperimentError
from forcetorque.base.noise.window_means import mean_error
from forcetorque.formats.c3d.force_platform import EDGE_M, ForcePlate, centre_of_pressure
from forcetorque.plates.plate_file import PlateFile
from forcetorque.plates.result import PlateRow, PlateWeight

LOADED_N = 20.0
"""Force below which a plate counts as free: its centre of pressure is noise then."""
WINDOW_S = 0.1
"""Windows whose means show whether the load is at rest."""
STEADY = 0.05
"""Share of the force by which the means of windows may depart from their median."""
_LIGHTEST = 1.0 / 3.0
"""Share of the largest force below which nobody stands on the plates with all of the weight (heuristic)."""
_SHORTEST_S = 0.5
"""Shortest interval of standing."""
_TARED_N = 1.0
"""Force that a free plate may measure; N."""
_SIDEWAYS = 0.03
"""Share of the weight that the mean force along the surface of who stands still does not reach; 1.7 degrees."""


def weigh(
    plates: PlateFile, *, gravity: float, start_s: float | None = None, end_s: float | None = None
) -> PlateWeight:
    """Weigh who or what stands on plates.

    The force along z of each plate counts by its size, so that the sign of the channels does not matter.

    Args:
        plates: The plates.
        gravity: Magnitude of gravity; m/s2.
        start_s: Start of the interval after the first sample; s; None for that of the longest interval at rest.
        end_s: Its end; None likewise.

    Returns:
        Mass, centre of pressure on each plate, and contradictions.

    Raises:
        ExperimentError: If gravity is not above 0, nothing stands still on the plates, or the interval holds no load.
    """
    path, time = plates.file.path, plates.time_s
    if not 0.0 < gravity < np.inf:
        raise ExperimentError(f"--gravity: expected a number above 0 m/s2, got {gravity:g}")
    down = np.column_stack([plate.wrench[:, 2] for plate in plates.plates])  # (n, plates)
    if not np.isfinite(down).all():
        raise ExperimentError(f"{path}: expected finite forces, got samples without; export the trial again")
    if start_s is None and end_s is None:
        within = _longest_rest(time, _total(down), np.ones(len(time), dtype=np.bool_))
        if within is None:
            raise ExperimentError(
                f"{path}: expected {_SHORTEST_S:g} s in which the total force is above {LOADED_N:g} N, above a third "
                f"of its largest, and within {100.0 * STEADY:.0f} % of its median, got none: nobody stands still; "
                "choose --start-s and --end-s"
            )
    else:
        within = (time >= (start_s or 0.0)) & (time < (np.inf if end_s is None else end_s))
    if within.sum() < 2 or abs(_total(down[within]).mean()) < LOADED_N:
        raise ExperimentError(
            f"{path}: --start-s, --end-s: expected an interval with a load above {LOADED_N:g} N, got "
            f"{_total(down[within]).mean() if within.any() else 0.0:.1f} N"
        )
    mass_kg, half_width_kg = _mass(time[within], _total(down[within]), gravity)
    rows = tuple(_row(plates, plate, within, down, k, gravity) for k, plate in enumerate(plates.plates))
    bearing = [(row, plate) for row, plate in zip(rows, plates.plates, strict=True) if row.force_N > LOADED_N]
    return PlateWeight(
        file=str(path),
        start_s=float(time[within][0]),
        end_s=float(time[within][-1]),
        gravity=gravity,
        mass_kg=mass_kg,
        half_width_95_kg=half_width_kg,
        plates=rows,
        contradictions=(
            *_signs(rows),
            *_untared(plates, down),
            *_without_corners(plates),
            *_outside(rows),
            *_sideways(bearing, within),
            *_apart(rows),
        ),
    )


def _total(down: FloatArray) -> FloatArray:
    """Sum over the plates of the force along z, each with the sign that its load has; shape (n,)."""
    loaded = np.where(np.abs(down) > LOADED_N, down, 0.0).sum(axis=0)
    return np.asarray(down @ np.where(loaded < 0.0, -1.0, 1.0), dtype=np.float64)


def _longest_rest(time: FloatArray, total: FloatArray, allowed: BoolArray) -> BoolArray | None:
    """Samples of the longest interval in which a force is steady; None for none."""
    window = np.floor(time / WINDOW_S + 1e-6).astype(np.int64)
    count = np.bincount(window)
    mean = np.bincount(window, total) / np.maximum(count, 1)
    is_free = np.bincount(window, ~allowed) > 0
    loaded = (np.abs(mean) > max(LOADED_N, _LIGHTEST * float(np.abs(mean).max(initial=0.0)))) & ~is_free
    best: tuple[int, int] | None = None
    for first, last in true_runs(loaded):
        values = mean[first : last + 1]
        level = np.median(values)
        for low, high in true_runs(np.abs(values - level) < STEADY * abs(level)):
            # the first and last window hold the step onto the plate
            start, end = first + low + 1, first + high - 1
            if best is None or end - start > best[1] - best[0]:
                best = (start, end)
    if best is None or (best[1] - best[0] + 1) * WINDOW_S < _SHORTEST_S - 1e-9:
        return None
    return (window >= best[0]) & (window <= best[1])


def _mass(time: FloatArray, force: FloatArray, gravity: float) -> tuple[float, float]:
    """Mass by the force down, and half of its 95 % interval; kg."""
    half_width = float(mean_error(force[:, None], time).half_width[0])
    return abs(float(force.mean())) / gravity, half_width / gravity


def _row(plates: PlateFile, plate: ForcePlate, within: BoolArray, down: FloatArray, k: int, gravity: float) -> PlateRow:
    time = plates.time_s
    force = float(down[within, k].mean())
    centre = sway = None
    if abs(force) > LOADED_N:
        centre = 1e3 * centre_of_pressure(plate.wrench[within].mean(axis=0)[None])[0]
        # the moment that the mean centre leaves, over the mean force: a ratio of samples would have outliers
        left = plate.wrench[within][:, [4, 3]] + plate.wrench[within][:, 2:3] * (1e-3 * centre * (1.0, -1.0))
        sway = float(1e3 * np.sqrt((left**2).sum(axis=1).mean()) / abs(force))
    others = np.delete(down, k, axis=1)
    alone_kg = alone_half_width_kg = None
    if len(plates.plates) > 1:
        is_alone = np.asarray((np.abs(others) < LOADED_N).all(axis=1), dtype=np.bool_)
        rest = _longest_rest(time, down[:, k], is_alone)
        if rest is not None:
            alone_kg, alone_half_width_kg = _mass(time[rest], down[rest, k], gravity)
    edges = plate.half_edges_m
    return PlateRow(
        plate=plate.number,
        type=plate.type,
        force_N=abs(force),
        is_negative=force < 0.0,
        x_mm=None if centre is None else float(centre[0]),
        y_mm=None if centre is None else float(centre[1]),
        sway_mm=sway,
        half_edges_mm=None if edges is None else 1e3 * edges,
        alone_kg=alone_kg,
        alone_half_width_95_kg=alone_half_width_kg,
    )


def _signs(rows: Sequence[PlateRow]) -> Iterator[str]:
    loaded = [row for row in rows if row.force_N > LOADED_N]
    for sign in (True, False):
        numbers = [str(row.plate) for row in loaded if row.is_negative is sign]
        if sign and numbers and len(numbers) < len(loaded):
            yield (
                f"Fz of plate {', '.join(numbers)} is below 0 and that of the others is not: one has another sign, or "
                "corners in another order"
            )


def _untared(plates: PlateFile, down: FloatArray) -> Iterator[str]:
    """Plates that measure a force while they are free."""
    fewest = round(_SHORTEST_S * plates.file.analog_rate_hz)
    for plate, force in zip(plates.plates, down.T, strict=True):
        free = [force[first : last + 1] for first, last in true_runs(np.abs(force) < LOADED_N)]
        longest = max(free, key=len, default=np.zeros(0))
        if len(longest) >= fewest and abs(rest := float(np.median(longest))) > _TARED_N:
            yield (
                f"plate {plate.number} measures {rest:.1f} N while nothing stands on it: tare it, or state "
                "FORCE_PLATFORM:ZERO"
            )


def _without_corners(plates: PlateFile) -> Iterator[str]:
    numbers = [str(plate.number) for plate in plates.plates if plate.corners_m is None]
    if numbers:
        yield (
            f"the corners of plate {', '.join(numbers)} are those of no rectangle with edges of {EDGE_M[0]:g} to "
            f"{EDGE_M[1]:g} m, so its centre of pressure is not checked: check CORNERS and length_unit"
        )


def _outside(rows: Sequence[PlateRow]) -> Iterator[str]:
    for row in rows:
        if row.centre_mm is None or row.half_edges_mm is None:
            continue
        beyond = float((np.abs(row.centre_mm) - row.half_edges_mm).max())
        if beyond > (row.sway_mm or 0.0):
            yield (
                f"the centre of pressure of plate {row.plate} is {beyond:.0f} mm outside of it: check ORIGIN, CORNERS "
                "and the units of moments"
            )


def _sideways(bearing: Sequence[tuple[PlateRow, ForcePlate]], within: BoolArray) -> Iterator[str]:
    """A body at rest is held by its weight alone, so forces along the surfaces cancel."""
    poses = [plate.lab_H_plate for _, plate in bearing]
    if not bearing or any(pose is None for pose in poses):
        return
    total = np.zeros(3)
    for pose, (row, plate) in zip(poses, bearing, strict=True):
        if pose is not None:
            total += (-1.0 if row.is_negative else 1.0) * pose[:3, :3] @ plate.wrench[within, :3].mean(axis=0)
    if poses[0] is None:
        return
    normal = poses[0][:3, 2]
    vertical = float(total @ normal)
    sideways = float(np.linalg.norm(total - vertical * normal))
    if sideways > _SIDEWAYS * abs(vertical):
        yield (
            f"the plates together are pushed sideways by {sideways:.1f} N, {100.0 * sideways / abs(vertical):.0f} % of "
            "the weight, which nobody who stands still does: cross-talk, a plate that is not level, or corners that "
            "are off"
        )


def _apart(rows: Sequence[PlateRow]) -> Iterator[str]:
    """Plates that bore the load alone, one after the other."""
    alone = [row for row in rows if row.alone_kg is not None]
    for row in alone[1:]:
        first = alone[0]
        difference = (row.alone_kg or 0.0) - (first.alone_kg or 0.0)
        width = float(np.hypot(row.alone_half_width_95_kg or 0.0, first.alone_half_width_95_kg or 0.0))
        if abs(difference) > width:
            yield (
                f"plate {row.plate} alone weighs {row.alone_kg:.2f} kg, plate {first.plate} alone "
                f"{first.alone_kg:.2f} kg: {abs(difference):.2f} kg apart (95 %: ±{width:.2f} kg)"
            )
