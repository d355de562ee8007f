# SPDX-License-Identifier: BSD-3-Clause
"""Whether the reading follows the reference by as much as a sensor can."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.calibration.gate.doubt import Doubt
from forcetorque.calibration.gate.gain import gains_of
from forcetorque.calibration.gate.movement import Movement
from forcetorque.errors import FitError

_SENSOR = 1.8
"""Factor by which no sensor's gain changes: beyond it, up or down, the model is wrong."""

_DOUBTFUL = 0.1
"""Change of the gain from which on the masses are to be checked; mounted sensors stay below."""

_SURE, _LIKELY = 3.0, 2.5
"""Standard deviations of the gain that a refusal, or a doubt, takes."""

_TURNED_LESS = 5.0
"""Gain from which on the joints may have turned further than the model did: by 57, less where turns are large."""

_CAUSES = (
    (300.0, 3000.0, "are masses 1000 times too small, or the prior in N per 1000 counts?"),
    (7.0, 14.0, "is the prior in kgf instead of N?"),
    (1.5, 2.6, "does the model have half of the true mass?"),
    (0.4, 0.65, "does the model have twice the true mass?"),
    (0.07, 0.14, "are weights given instead of masses?"),
    (-0.1, 0.02, "are the masses in grams instead of kg?"),
)
"""What gains between two limits point to; small ones are known to some hundredths only."""

_CHECK = (
    "check the mass of the links beyond the sensor in the file that urdf of [robot] names, or mass_kg of [load], and "
    "whether prior of [[sensor]] is its own, at the amplifier gains of the recording"
)


def scale_doubts(movement: Movement, prior: FloatArray) -> Iterator[Doubt]:
    """Judge the gain of a prior's reading on the reference.

    Args:
        movement: How they move.
        prior: The prior; shape (6, c); N/count, N m/count.

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
            f"{_cause(movement, gain)}{_CHECK}"
        )
    if off > _DOUBTFUL and off > _LIKELY * deviation:
        yield Doubt(
            kind="scale",
            message=f"the gain changed by {gain - 1.0:+.0%} from the prior's, and wrong masses look the same; "
            f"{_cause(movement, gain)}{_CHECK}",
        )


def _cause(movement: Movement, gain: float) -> str:
    second = np.diag(movement.second)
    size = float(np.linalg.norm(movement.size[:3]))
    change = float(np.sqrt(second[6:9].sum()))
    # the reading moves as the weight of the model would if it turned further
    if gain > _TURNED_LESS and change < 0.2 * size and np.sqrt(second[:3].sum()) < 2.0 * size:
        return (
            f"the reference moves by {change:.3g} N only, with a size of {size:.3g} N: are joints in radians read as "
            "degrees (a log of YARP holds degrees; units of [[recording.stream]] otherwise)? If not, "
        )
    return next((f"{words} " for low, high, words in _CAUSES if low < gain < high), "")
