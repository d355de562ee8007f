# SPDX-License-Identifier: BSD-3-Clause
"""How the sensor may be turned against the axes of the motion: by multiples of 90 degrees with names, then a little."""

from __future__ import annotations

from itertools import permutations, product

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.loads.problem import LoadProblem
from forcetorque.loads.unknowns import AXES
from forcetorque.spatial import FORCE, reading_sign


def quarter_turns() -> list[FloatArray]:
    """List the 24 rotations that bring axes to axes.

    Returns:
        Rotations, none first; shape (3, 3) each.
    """
    turns = []
    for order in permutations(range(3)):
        for signs in product((1.0, -1.0), repeat=3):
            turn = np.eye(3)[list(order)] * np.array(signs)[:, None]
            if np.linalg.det(turn) > 0.0:
                turns.append(turn)
    return sorted(turns, key=lambda turn: -float(np.trace(turn)))


def turn_words(turn: FloatArray) -> str:
    """Name a rotation that brings axes to axes.

    Args:
        turn: `sensor_R_motion`; shape (3, 3).

    Returns:
        Words such as `x of the sensor is -y of the motion, y is x, z is z`.
    """
    named = []
    for axis, row in zip(AXES, turn, strict=True):
        k = int(np.abs(row).argmax())
        named.append(f"{axis} is {'-' if row[k] < 0.0 else ''}{AXES[k]}")
    return f"{named[0].replace('is', 'of the sensor is', 1)} of the motion, {named[1]}, {named[2]}"


def first_mount(problem: LoadProblem) -> FloatArray:
    """Turn the axes of the motion to those of the sensor as the weight shows itself in the forces.

    Forces are `sign m R a + bias`, whatever the centre of mass: R is the rotation that is nearest to the best matrix.

    Args:
        problem: The problem.

    Returns:
        `sensor_R_motion`; shape (3, 3).
    """
    sign = reading_sign(problem.direction, child_is_outboard=True)
    moment = force_response(problem)
    left, _, right = np.linalg.svd(sign * moment)
    flip = np.diag([1.0, 1.0, float(np.sign(np.linalg.det(left @ right))) or 1.0])
    rotation: FloatArray = left @ flip @ right
    return rotation


def force_response(problem: LoadProblem) -> FloatArray:
    """Covariance of forces with proper accelerations within sessions and loads, which is that of `m R` for even turns.

    Args:
        problem: The problem.

    Returns:
        Shape (3, 3); N m/s2.
    """
    rows = problem.rows
    force, moved = rows.moved(rows.wrench[:, FORCE]), rows.moved(rows.proper_acceleration)
    response: FloatArray = force.T @ moved @ np.linalg.pinv(moved.T @ moved, rcond=1e-6, hermitian=True)
    return response
