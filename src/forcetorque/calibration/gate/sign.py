# SPDX-License-Identifier: BSD-3-Clause
"""Refusal of a reading that runs against the reference."""

from __future__ import annotations

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.calibration.gate.gain import gains_of
from forcetorque.calibration.gate.movement import Movement
from forcetorque.calibration.gate.setup import ROBOT, Setup
from forcetorque.errors import FitError

_SURE = 3.0
"""Standard deviations by which a gain is below 0 before it is called negative."""

_EXCITED = 0.1
"""Part of the change of the whole force from which on an axis is judged by itself."""


def require_same_sign(movement: Movement, prior: FloatArray, setup: Setup = ROBOT) -> None:
    """Refuse a prior's reading whose force, or one axis of it, runs against the reference.

    Args:
        movement: How they move.
        prior: The prior; shape (6, c); N/count, N m/count.
        setup: Where the data come from.

    Raises:
        FitError: If it is so; the message names the keys that turn a sign.
    """
    gains = gains_of(movement, prior)
    if gains.overall + _SURE * gains.deviation < 0.0:
        raise FitError(
            f"the prior's reading runs against the reference, by {gains.overall:.2f} times of it; {setup.check_sign}"
        )
    # taking out what variables explain may leave less than nothing of an axis that does not move
    change = np.sqrt(np.maximum(np.diag(movement.second)[6:9], 0.0))
    against = [
        f"f{axis}"
        for axis, gain, deviation, moved in zip("xyz", gains.components, gains.deviations, change, strict=False)
        if gain + _SURE * deviation < 0.0 and moved > _EXCITED * np.linalg.norm(change)
    ]
    if against:
        raise FitError(
            f"{', '.join(against)} of the prior's reading run(s) against the reference, other forces do not; "
            f"{setup.check_axes}"
        )
