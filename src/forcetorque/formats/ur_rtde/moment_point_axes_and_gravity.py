# SPDX-License-Identifier: BSD-3-Clause
"""What fields of a recording say of each other: reference point of moments, axes of the flange, and gravity.

`ft_raw_wrench` changes as `actual_TCP_force` with the declared payload does, along the axes of the flange and about the
flange; both differ by a constant, the zero. `actual_tool_accelerometer` at rest points up.

A moment about another point than taken is that of another centre of mass: at rest both are the same. In motion the
force is `m (s - A c)` with `s` gravity less the acceleration of the flange, `A = hat(alpha) + hat(omega)^2`, and `c`
the centre of mass, whatever the moment is about.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import FormatError
from forcetorque.base.pose import skew
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


_STEP_S = 0.016
"""Half of the span of a difference: shorter ones make noise of the pose large; s (heuristic)."""
_EVEN = 0.1
"""Part by which spans of differences may deviate: in a longer one rows lack (heuristic)."""
_FEWEST = 100
"""Samples that are needed (heuristic)."""
_NEAR = 0.3
"""Share of the distance of the points within which the centre is that of one of them (heuristic)."""
_MOST_ERROR = 0.05
"""Standard error of the centre, over that distance, from which on the motion is too slow (heuristic)."""
_LARGEST = 1e6
"""No arm has a larger force or moment; N, N m."""
_CORRELATED = 10.0
"""Samples that count as one: noise of the force, of the pose and a delay between them last some time (heuristic)."""


def is_about_other_point(
    stamp_ns: IntArray,
    base_R_flange: FloatArray,
    base_p_flange: FloatArray,
    gravity: FloatArray,
    wrench: FloatArray,
    other_p_taken: FloatArray,
) -> bool:
    """Check whether the centre of mass by the force in motion is the one that the moment gives about another point.

    Delays of some ms between pose and force shift it by millimetres, so that points must be centimetres apart.

    Args:
        stamp_ns: Stamps, which rise; shape (n,); ns.
        base_R_flange: Orientations; shape (n, 3, 3).
        base_p_flange: Positions; shape (n, 3); m.
        gravity: Along the axes of the base; shape (3,); m/s2.
        wrench: Wrench of the load on the flange, as the moment was taken; shape (n, 6); N, N m.
        other_p_taken: What the centre of mass changes by if the moment is about the other point; along the axes of the
            flange; shape (3,); m.

    Returns:
        Whether; False where the motion does not show it.
    """
    distance = float(np.linalg.norm(other_p_taken))
    with np.errstate(over="ignore", invalid="ignore"):  # damaged files hold huge numbers
        if not distance > 0.0 or any((np.abs(rows) >= _LARGEST).any() for (rows,) in row_blocks(wrench)):
            return False
        centre = _centre_by_force(stamp_ns, base_R_flange, base_p_flange, gravity, wrench[:, :3])
        if centre is None or not centre[1] < _MOST_ERROR * distance:
            return False
        apart = centre[0] - _centre_by_moment(wrench) - other_p_taken
    return float(np.linalg.norm(apart)) < _NEAR * distance


def _centre_by_force(
    stamp_ns: IntArray, base_R_flange: FloatArray, base_p_flange: FloatArray, gravity: FloatArray, force: FloatArray
) -> tuple[FloatArray, float] | None:
    """Centre of mass, shape (3,), and the largest standard error of its coordinates; m."""
    usual = 1e-9 * float(np.median(np.diff(stamp_ns))) if len(stamp_ns) > _FEWEST else 0.0
    if not usual > 0.0:
        return None
    k = max(round(_STEP_S / usual), 1)
    rows = 0
    triangle: FloatArray = np.zeros((0, 8))  # of all rows of the design with the force, by QR decomposition
    for stamps, turns, places, forces in row_blocks(stamp_ns, base_R_flange, base_p_flange, force, overlap=4 * k):
        equations = _equations(stamps, turns, places, forces, gravity, k, usual)
        rows += len(equations)
        triangle = np.asarray(np.linalg.qr(np.vstack([triangle, equations]), mode="r"), dtype=np.float64)
    if rows < 3 * _FEWEST:
        return None
    design, values = triangle[:, :7], triangle[:, 7]
    solution, _, rank, _ = np.linalg.lstsq(design, values, rcond=rows * np.finfo(np.float64).eps)
    mass, moment = float(solution[0]), solution[1:4]
    if rank < design.shape[1] or not mass > 0.0:
        return None
    left = values - design @ solution
    variance = _CORRELATED * float(left @ left) / rows * np.diag(np.linalg.inv(design.T @ design))
    return np.asarray(moment / mass, dtype=np.float64), float(np.sqrt(variance[1:4].max())) / mass


def _equations(
    stamp_ns: IntArray,
    base_R_flange: FloatArray,
    base_p_flange: FloatArray,
    force: FloatArray,
    gravity: FloatArray,
    k: int,
    usual_s: float,
) -> FloatArray:
    """Mass, first moment and bias in the force of the rows that have 2k others on either side; shape (m, 8)."""
    half_s = k * usual_s
    spans_s = 1e-9 * (stamp_ns[4 * k :] - stamp_ns[: -4 * k])
    even = np.abs(spans_s - 4.0 * half_s) < _EVEN * usual_s
    turn = base_R_flange[: -2 * k].transpose(0, 2, 1) @ base_R_flange[2 * k :]
    omega = _axis(turn) / (2.0 * half_s)
    alpha = (omega[2 * k :] - omega[: -2 * k]) / (2.0 * half_s)
    position = base_p_flange[k:-k]
    acceleration = (position[2 * k :] - 2.0 * position[k:-k] + position[: -2 * k]) / half_s**2
    middle = slice(2 * k, len(stamp_ns) - 2 * k)
    specific = np.einsum("nji,nj->ni", base_R_flange[middle], gravity - acceleration)
    turning = skew(alpha) + skew(omega[k:-k]) @ skew(omega[k:-k])
    bias = np.broadcast_to(np.eye(3), turning.shape)
    rows = np.concatenate([specific[:, :, None], -turning, bias, force[middle][:, :, None]], axis=2)
    return rows[even & np.isfinite(rows).all(axis=(1, 2))].reshape(-1, 8)


def _axis(rotation: FloatArray) -> FloatArray:
    """Rotation vectors of small rotations, with an error of the third order; shape (n, 3)."""
    part = rotation - rotation.transpose(0, 2, 1)
    return 0.5 * np.stack([part[:, 2, 1], part[:, 0, 2], part[:, 1, 0]], axis=1)


def _centre_by_moment(wrench: FloatArray) -> FloatArray:
    """Point through which the force acts, beside a constant moment; shape (3,); m."""
    scatter = scatter_of(wrench)
    squares, products = scatter[:3, :3], scatter[:3, 3:]
    design = np.trace(squares) * np.eye(3) - squares
    moments = np.array([products[k - 2, k - 1] - products[k - 1, k - 2] for k in range(3)])
    return np.asarray(np.linalg.lstsq(design, moments, rcond=None)[0], dtype=np.float64)
