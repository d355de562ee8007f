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
from forcetorque.base.rows_on_disk import row_blocks

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
    scatter = scatter_of(raw, *by_point.values())
    for number, point in enumerate(by_point, start=1):
        force, moment = (_share_left(scatter, 6 * number + first, first) for first in (0, 3))
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
    scatter = scatter_of(wrench[:, :3], raw[:, :3])
    product = scatter[:3, 3:]
    if not np.isfinite(scatter).all():
        return None
    left, sizes, right = np.linalg.svd(product)
    if not sizes[1] > _AGREES * sizes[0] > 0.0:  # the force moves along one line
        return None
    turn = left @ np.diag([1.0, 1.0, np.linalg.det(left @ right)]) @ right
    vector: FloatArray = np.rad2deg(Rotation.from_matrix(turn).as_rotvec())
    axes = np.eye(6)
    axes[3:, 3:] = turn
    explained = _share_left(axes @ scatter @ axes.T, 0, 3) < _AGREES
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
    if felt is None:
        return
    count, total, sizes = 0, np.zeros(3), 0.0
    for own, turn in row_blocks(felt, base_R_flange):
        finite = np.isfinite(own).all(axis=1) & np.isfinite(turn[:, 0, 0])
        count += int(np.count_nonzero(finite))
        total += np.einsum("nij,nj->i", turn[finite], own[finite])
        sizes += float(np.linalg.norm(own[finite], axis=1).sum())
    if not count:
        return
    up = total / count
    size = float(np.linalg.norm(up))
    # of an accelerometer with other axes, or of an arm that moves, the mean says nothing
    alike = size > _SAME_AXES * sizes / count
    if alike and _GRAVITY[0] < size < _GRAVITY[1] and float(-up @ down) < _ALONG * size:
        raise FormatError(
            f"{path}: gravity_direction: expected {(np.round(-up / size, 2) + 0.0).tolist()}, in which things fall by "
            f"actual_tool_accelerometer, got {down.tolist()}: the base of the arm is not level"
        )


def _is_of_sensor(raw: FloatArray) -> bool:
    return all(np.abs(forces).max() < _WITHOUT_SENSOR for (forces,) in row_blocks(raw[:, :3]))


def scatter_of(*arrays: FloatArray) -> FloatArray:
    """Give the products of columns about their means, of the rows without a gap.

    Args:
        arrays: Columns; shapes (n, k), (n, l), ...

    Returns:
        Their sums; shape (k + l + ..., k + l + ...); not finite where a column has huge numbers.
    """
    width = sum(array.shape[1] for array in arrays)
    count, mean, scatter = 0, np.zeros(width), np.zeros((width, width))
    with np.errstate(over="ignore", invalid="ignore"):  # damaged files hold huge numbers
        for blocks in row_blocks(*arrays):
            rows = np.hstack(blocks)
            finite = np.isfinite(rows).all(axis=1)
            rows = rows if finite.all() else rows[finite]
            if not len(rows):
                continue
            own, total = rows.mean(axis=0), count + len(rows)
            about, step = rows - own, own - mean
            scatter += about.T @ about + np.outer(step, step) * (count * len(rows) / total)
            mean += step * (len(rows) / total)
            count = total
    return scatter


def _share_left(scatter: FloatArray, first: int, other: int) -> float:
    """What the difference of three columns to three others changes by, over what the others change by."""
    one, two = slice(first, first + 3), slice(other, other + 3)
    with np.errstate(over="ignore", invalid="ignore"):
        own, change = np.trace(scatter[one, one]), np.trace(scatter[two, two])
        left = max(own - 2.0 * np.trace(scatter[one, two]) + change, 0.0)
        return float(np.sqrt(left / change)) if change > 0.0 else np.inf
