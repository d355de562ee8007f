# SPDX-License-Identifier: BSD-3-Clause
"""C3D files with a plate whose wrench is known, in the forms of all types and processors."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.formats.c3d.writing import Parameter, c3d_bytes

CORNERS_MM = np.array([[550.0, 200.0, 2.0], [50.0, 200.0, 2.0], [50.0, 600.0, 2.0], [550.0, 600.0, 2.0]])
"""Of a plate with x as that of the laboratory and z down."""
ORIGIN_MM = np.array([1.5, -2.0, -40.0])
COP_MM = np.array([[60.0, 40.0], [-30.0, 10.0]])
FORCE_N = np.array([[20.0, -15.0, 600.0], [5.0, 7.0, 550.0]])
FREE_MOMENT_NMM = np.array([3000.0, -1000.0])
CAL_MATRIX = np.diag([500.0, 500.0, 1000.0, 4e5, 3e5, 2e5]) + np.add.outer(np.arange(6.0), 2.0 * np.arange(6.0))
"""Not symmetric, so that one that is transposed is noticed; N/V, N mm/V."""


def surface_wrench_nmm() -> FloatArray:
    """Wrench about the centre of the surface by hand: moment = r x F + free moment; shape (2, 6); N, N mm."""
    x, y = COP_MM.T
    fz = FORCE_N[:, 2]
    moment = np.column_stack([y * fz, -x * fz, x * FORCE_N[:, 1] - y * FORCE_N[:, 0] + FREE_MOMENT_NMM])
    return np.hstack([FORCE_N, moment])


def channels(kind: int, sign: float = 1.0) -> tuple[FloatArray, tuple[str, ...]]:
    """Channels of a type, and their units."""
    surface = sign * surface_wrench_nmm()
    sensor = np.hstack([surface[:, :3], surface[:, 3:] - np.cross(surface[:, :3], ORIGIN_MM)])
    if kind == 1:
        return np.hstack([surface[:, :3], COP_MM, surface[:, 5:]]), ("N",) * 3 + ("mm", "mm", "Nmm")
    if kind == 2:
        return sensor, ("N",) * 3 + ("Nmm",) * 3
    if kind == 4:
        return sensor @ np.linalg.inv(CAL_MATRIX).T, ("V",) * 6
    a, b, z = 120.0, 200.0, ORIGIN_MM[2]
    moment = surface[:, 3:] - np.cross(surface[:, :3], [0.0, 0.0, z])
    fx, fy, fz = surface[:, :3].T
    turn = moment[:, 2] / 2.0  # half by the pair along x, half by the pair along y
    one, two, half = moment[:, 0] / (4.0 * b), moment[:, 1] / (4.0 * a), 0.5
    pairs = [half * fx - half * turn / b, half * fx + half * turn / b, half * fy + half * turn / a]
    pairs.append(half * fy - half * turn / a)
    corners = [fz / 4 + one - two, fz / 4 + one + two, fz / 4 - one + two, fz / 4 - one - two]
    return np.column_stack([*pairs, *corners]), ("N",) * 8


def parameters(kind: int, units: tuple[str, ...], **changes: Any) -> dict[str, Parameter]:
    """Parameters of one plate; `changes` by name, `GROUP__NAME`, None to leave one out."""
    origin = np.array([120.0, 200.0, ORIGIN_MM[2]]) if kind == 3 else ORIGIN_MM
    every: dict[str, Any] = {
        "POINT:LABELS": ("tip",),
        "POINT:UNITS": ("mm",),
        "ANALOG:LABELS": tuple(f"ch{k}" for k in range(len(units))),
        "ANALOG:UNITS": units,
        "FORCE_PLATFORM:USED": np.array(1),
        "FORCE_PLATFORM:TYPE": np.array([kind]),
        "FORCE_PLATFORM:ZERO": np.array([1, 0]),
        "FORCE_PLATFORM:CORNERS": CORNERS_MM.T[:, :, None].astype(np.float32),
        "FORCE_PLATFORM:ORIGIN": origin[:, None],
        "FORCE_PLATFORM:CHANNEL": np.arange(1, len(units) + 1)[:, None],
    }
    if kind == 4:
        every["FORCE_PLATFORM:CAL_MATRIX"] = CAL_MATRIX[:, :, None]
        every["FORCE_PLATFORM:UNITS"] = ("N",) * 3 + ("Nmm",) * 3
    every |= {key.replace("__", ":"): value for key, value in changes.items()}
    return {key: value for key, value in every.items() if value is not None}


def plate_bytes(kind: int = 2, sign: float = 1.0, form: Mapping[str, Any] | None = None, **changes: Any) -> bytes:
    """A file with two frames of one sample, and one marker that is hidden in the second."""
    analog, units = channels(kind, sign)
    markers = np.array([[[100.0, 200.0, 300.0]], [[np.nan] * 3]])
    return c3d_bytes(
        parameters(kind, units, **changes), analog=analog, markers=markers, frame_rate_hz=100.0, **(form or {})
    )


def write_plate(path: Path, kind: int = 2, sign: float = 1.0, **changes: Any) -> Path:
    """Write such a file."""
    path.write_bytes(plate_bytes(kind, sign, **changes))
    return path
