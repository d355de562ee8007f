# SPDX-License-Identifier: BSD-3-Clause
"""Whether the reading follows the reference by as much as a sensor can."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.calibration.gate.doubt import Doubt
from forcetorque.calibration.gate.gain import gains_of
from forcetorque.calibration.gate.movement import Movement
from forcetorque.calibration.gate.setup import ROBOT, Setup
from forcetorque.errors import FitError

_SENSOR = 1.8
"""Factor by which no sensor's gain changes: beyond it, up or down, the model is wrong."""

_SURE, _LIKELY = 3.0, 2.5
"""Standard deviations of the gain that a refusal, or a doubt, takes."""

_TURNED_LESS = 5.0
"""Gain from which on the joints may have turned further than the model did: by 57, less where turns are large."""


def scale_doubts(movement: Movement, prior: FloatArray, setup: Setup = ROBOT) -> Iterator[Doubt]:
    """Judge the gain of a prior's reading on the reference.

    Args:
        movement: How they move.
        prior: The prior; shape (6, c); N/count, N m/count.
        setup: Where the data come from.

    Yields:
        A doubt where the gain changed by more than mounting changes it: no single recording tells it from wrong masses.

    Raises:
        FitError: If no sensor changes its gain by so much.
    """
    gains = gains_of(movement, prior)
    gain, deviation = gains.overall, gains.deviation
    off = abs(gain - 1.0)
    if not 1.0 / _SENSOR < gain < _SENSOR and off > _SURE * deviation:
        raise FitError(
            f"the prior's reading moves {gain:.3g} times as much as the reference, which no sensor does; "
            f"{_cause(movement, gain, setup)}{setup.check_gain}"
        )
    if off > setup.doubtful_gain and off > _LIKELY * deviation:
        yield Doubt(
            kind="scale",
            message=f"the gain changed by {gain - 1.0:+.0%} from the prior's, and wrong masses look the same; "
            f"{_cause(movement, gain, setup)}{setup.check_gain}",
        )


def _cause(movement: Movement, gain: float, setup: Setup) -> str:
    second = np.diag(movement.second)
    size = float(np.linalg.norm(movement.size[:3]))
    change = float(np.sqrt(second[6:9].sum()))
    # the reading moves as the weight of the model would if it turned further
    turned_less = setup.joints_move_too_little and gain > _TURNED_LESS
    if turned_less and change < 0.2 * size and np.sqrt(second[:3].sum()) < 2.0 * size:
        return (
            f"the reference moves by {change:.3g} N only, with a size of {size:.3g} N: are joints in radians read as "
            "degrees (a log of YARP holds degrees; units of [[recording.stream]] otherwise)? If not, "
        )
    return next((f"{words} " for low, high, words in setup.gain_causes if low < gain < high), "")
