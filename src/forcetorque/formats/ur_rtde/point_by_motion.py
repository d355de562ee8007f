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
        if not (distance > 0.0 and np.abs(wrench[np.isfinite(wrench)]).max(initial=0.0) < _LARGEST):
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
    time_s = 1e-9 * (stamp_ns - stamp_ns[0])
    usual = float(np.median(np.diff(time_s))) if len(time_s) > _FEWEST else 0.0
    if not usual > 0.0:
        return None
    k = max(round(_STEP_S / usual), 1)
    half_s = k * usual
    even = np.abs(time_s[4 * k :] - time_s[: -4 * k] - 4.0 * half_s) < _EVEN * usual
    turn = base_R_flange[: -2 * k].transpose(0, 2, 1) @ base_R_flange[2 * k :]
    omega = _axis(turn) / (2.0 * half_s)
    alpha = (omega[2 * k :] - omega[: -2 * k]) / (2.0 * half_s)
    position = base_p_flange[k:-k]
    acceleration = (position[2 * k :] - 2.0 * position[k:-k] + position[: -2 * k]) / half_s**2
    middle = slice(2 * k, len(time_s) - 2 * k)
    specific = np.einsum("nji,nj->ni", base_R_flange[middle], gravity - acceleration)
    turning = skew(alpha) + skew(omega[k:-k]) @ skew(omega[k:-k])
    bias = np.broadcast_to(np.eye(3), turning.shape)
    design = np.concatenate([specific[:, :, None], -turning, bias], axis=2)
    values = force[middle]
    used = even & np.isfinite(design).all(axis=(1, 2)) & np.isfinite(values).all(axis=1)
    flat, values = design[used].reshape(-1, 7), values[used].reshape(-1)
    if used.sum() < _FEWEST:
        return None
    solution, _, rank, _ = np.linalg.lstsq(flat, values, rcond=None)
    mass, moment = float(solution[0]), solution[1:4]
    if rank < flat.shape[1] or not mass > 0.0:
        return None
    left = values - flat @ solution
    variance = _CORRELATED * float(left @ left) / len(values) * np.diag(np.linalg.inv(flat.T @ flat))
    return moment / mass, float(np.sqrt(variance[1:4].max())) / mass


def _axis(rotation: FloatArray) -> FloatArray:
    """Rotation vectors of small rotations, with an error of the third order; shape (n, 3)."""
    part = rotation - rotation.transpose(0, 2, 1)
    return 0.5 * np.stack([part[:, 2, 1], part[:, 0, 2], part[:, 1, 0]], axis=1)


def _centre_by_moment(wrench: FloatArray) -> FloatArray:
    """Point through which the force acts, beside a constant moment; shape (3,); m."""
    known = wrench[np.isfinite(wrench).all(axis=1)]
    change = known - known.mean(axis=0)
    design = -skew(change[:, :3]).reshape(-1, 3)
    return np.asarray(np.linalg.lstsq(design, change[:, 3:].reshape(-1), rcond=None)[0], dtype=np.float64)
