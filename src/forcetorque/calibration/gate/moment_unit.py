# SPDX-License-Identifier: BSD-3-Clause
"""Refusal of moments in another unit than was stated, which the gain of the whole wrench does not show."""

from __future__ import annotations

import numpy as np

from forcetorque.calibration.gate.movement import Movement
from forcetorque.calibration.gate.setup import ROBOT, Setup
from forcetorque.errors import FitError

_LEAST = 0.2
"""Movement of a moment, relative to that of its reference, below which no sensor stays where its force follows.

A force that leaks into moments makes them larger. Only in all three at once, and just so, could it take away this much.
N m that are stated as kgf cm, lbf in or N mm stay below.
"""

_FORCE = (0.5, 2.0)
"""Movement of the force, relative to that of its reference, between which the unit of moments is what is wrong."""

_LEVER_M = 1e-3
"""Lever below which the reference hardly moves a moment, and says nothing about it; m."""


def require_moment_unit(movement: Movement, setup: Setup = ROBOT) -> None:
    """Refuse a prior's reading whose force follows the reference while its moment is far too small.

    Args:
        movement: How the prior's reading and the reference move.
        setup: Where the data come from.

    Raises:
        FitError: If it is so; the message names the unit of the stream.
    """
    # taking out what variables explain may leave less than nothing of what does not move
    second = np.maximum(np.diag(movement.second), 0.0)
    force, moment, reference_force, reference_moment = np.sqrt(second.reshape(4, 3).sum(axis=1))
    if reference_moment <= _LEVER_M * reference_force or not reference_force > 0.0:
        return
    follows = _FORCE[0] < force / reference_force < _FORCE[1]
    if follows and moment < _LEAST * reference_moment:
        raise FitError(
            f"the moment of the prior's reading moves by {moment:.3g} N m, {moment / reference_moment:.2g} times as "
            f"much as that of the reference, while its force moves {force / reference_force:.2g} times as much; "
            f"{setup.check_moment}"
        )
