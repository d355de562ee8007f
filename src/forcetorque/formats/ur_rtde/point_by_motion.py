# SPDX-License-Identifier: BSD-3-Clause
"""The reference point of a moment by the force of an arm in motion.

A moment about another point than taken is that of another centre of mass: at rest both are the same. In motion the
force is `m (s - A c)` with `s` gravity less the acceleration of the flange, `A = hat(alpha) + hat(omega)^2`, and `c`
the centre of mass, whatever the moment is about.
"""

from __future__ import annotations

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.pose import skew
from forcetorque.base.rows_on_disk import row_blocks
from forcetorque.formats.ur_rtde.consistency import scatter_of

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
