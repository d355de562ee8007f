# SPDX-License-Identifier: BSD-3-Clause
"""What fields of a recording say of each other: reference point of moments, axes of the flange, and gravity.

`ft_raw_wrench` changes as `actual_TCP_force` with the declared payload does, along the axes of the flange and about the
flange; both differ by a constant, the zero. `actual_tool_accelerometer` at rest points up.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError
from forcetorque.base.wrench import FORCE

_WITHOUT_SENSOR = 5e3
"""`ft_raw_wrench` of an arm without a sensor is a constant near 1e4; N."""
_AGREES = 0.2
"""Share of its change that two readings of one wrench may differ by (heuristic)."""
_TURNED_DEG = 5.0
"""Rotation between two readings of one force from which on their axes differ; deg (heuristic)."""
_SAME_AXES = 0.97
"""Share of the acceleration that its mean along the base has, where its axes are those of the flange (heuristic)."""
_GRAVITY = (9.0, 10.6)
"""Magnitudes of gravity that an accelerometer may show; m/s2."""
_ALONG = 0.98
"""Cosine of 11 degrees: no accelerometer of a flange is off by more (heuristic)."""


def agreeing_point(raw: FloatArray | None, by_point: Mapping[str, FloatArray]) -> str | None:
    """Find the reference point about which a moment changes as that of `ft_raw_wrench`.

    Args:
        raw: `ft_raw_wrench`; shape (n, 6); N, N m; None where the log lacks it.
        by_point: Wrench at the flange, declared payload included, if the logged moment is about each of two points;
            shape (n, 6); N, N m.

    Returns:
        The point; None where `raw` lacks, is that of no sensor, has other axes, or shows no difference.
    """
    if raw is None or not _is_of_sensor(raw):
        return None
    shares = {}
    for point, wrench in by_point.items():
        force, moment = _shares_left(wrench, raw)
        if not force < _AGREES:
            return None
        shares[point] = moment
    best, other = sorted(shares, key=lambda point: shares[point])
    return best if shares[best] < _AGREES < shares[other] else None


def turned_by(raw: FloatArray | None, wrench: FloatArray) -> FloatArray | None:
    """Find the rotation by which the force is turned against `ft_raw_wrench`.

    Args:
        raw: As of `agreeing_point`.
        wrench: Wrench at the flange, declared payload included; shape (n, 6); N, N m.

    Returns:
        Rotation vector from the axes of `raw` to those of the flange; shape (3,); deg; None where the axes are the
        same, or no rotation explains the difference.
    """
    from scipy.spatial.transform import Rotation  # here because importing it takes longer than most commands

    if raw is None or not _is_of_sensor(raw):
        return None
    finite = np.isfinite(raw).all(axis=1) & np.isfinite(wrench).all(axis=1)
    with np.errstate(over="ignore", invalid="ignore"):  # damaged files hold huge numbers
        own, other = _about_mean(wrench[finite, FORCE]), _about_mean(raw[finite, FORCE])
        product = own.T @ other
    if not np.isfinite(product).all():
        return None
    left, sizes, right = np.linalg.svd(product)
    if not sizes[1] > _AGREES * sizes[0] > 0.0:  # the force moves along one line
        return None
    turn = left @ np.diag([1.0, 1.0, np.linalg.det(left @ right)]) @ right
    vector: FloatArray = np.rad2deg(Rotation.from_matrix(turn).as_rotvec())
    (left_over,) = _shares_left(own, other @ turn.T)
    explained = left_over < _AGREES
    return vector if explained and float(np.linalg.norm(vector)) > _TURNED_DEG else None


def require_gravity_as_felt(path: Path, felt: FloatArray | None, base_R_flange: FloatArray, down: FloatArray) -> None:
    """Refuse a direction of gravity that the accelerometer of the tool contradicts.

    Args:
        path: The log, for the message.
        felt: `actual_tool_accelerometer`; shape (n, 3); m/s2; None where the log lacks it.
        base_R_flange: Orientation of the flange; shape (n, 3, 3).
        down: Direction of gravity along the axes of the base; shape (3,); of length 1.

    Raises:
        FormatError: If things fall in another direction.
    """
    finite = () if felt is None else np.flatnonzero(np.isfinite(felt).all(axis=1) & np.isfinite(base_R_flange[:, 0, 0]))
    if felt is None or not len(finite):
        return
    up = np.einsum("nij,nj->ni", base_R_flange[finite], felt[finite]).mean(axis=0)
    size = float(np.linalg.norm(up))
    # of an accelerometer with other axes, or of an arm that moves, the mean says nothing
    alike = size > _SAME_AXES * float(np.linalg.norm(felt[finite], axis=1).mean())
    if alike and _GRAVITY[0] < size < _GRAVITY[1] and float(-up @ down) < _ALONG * size:
        raise FormatError(
            f"{path}: gravity_direction: expected {(np.round(-up / size, 2) + 0.0).tolist()}, in which things fall by "
            f"actual_tool_accelerometer, got {down.tolist()}: the base of the arm is not level"
        )


def _is_of_sensor(raw: FloatArray) -> bool:
    return bool(np.abs(raw[:, FORCE]).max(initial=0.0) < _WITHOUT_SENSOR)


def _shares_left(values: FloatArray, other: FloatArray) -> list[float]:
    """What the difference changes by, over what the other changes by, of each three columns."""
    with np.errstate(over="ignore", invalid="ignore"):  # damaged files hold huge numbers
        left = values - other
        finite = np.isfinite(left).all(axis=1)
        if not finite.all():
            left, other = left[finite], other[finite]
        squares = (np.einsum("nk,nk->k", part, part).reshape(-1, 3) for part in map(_about_mean, (left, other)))
        changes, of_other = (part.sum(axis=1) for part in squares)
        return [
            float(np.sqrt(k / change)) if change > 0.0 else np.inf for k, change in zip(changes, of_other, strict=True)
        ]


def _about_mean(values: FloatArray) -> FloatArray:
    return values - values.mean(axis=0) if len(values) else values
