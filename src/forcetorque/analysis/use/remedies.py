# SPDX-License-Identifier: BSD-3-Clause
"""What to do about a reason that speaks against a use, in words."""

from __future__ import annotations

from typing import Final

from forcetorque.evaluation.use import PredictedError

LOOK_FOR_CAUSE: Final = (
    "Find the cause of the measured error before recording more: `forcetorque inspect` names contacts, steps, delays "
    "and losses; masses that the robot's model lacks, and a sensor that warms up, look like it too."
)
"""About an error on data that were not fitted which nothing predicts."""
MEND_DATA: Final = "Put right in the recording or the experiment file what the doubt names, and calibrate again."
"""About fitted data that were in doubt."""
JUDGE: Final = (
    'State an interval with use = "validation" in the experiment file, on which the calibration was not fitted and in '
    "which the load moves."
)
"""About a calibration that no data test."""
JUDGE_WHAT_MOVES: Final = (
    "Judge it on data in which the load moves by more than that: a validation interval with other postures or loads."
)
"""About judged data that test little."""
TARE: Final = 'Tare the sensor before use, and state offset = "tared" in [[load_case]].'
"""About a constant error."""
FIT_GENERATIVE: Final = "Calibrate by the generative model, whose calibrations know their errors at any load."
"""About a calibration without a covariance."""
_BY_SOURCE: Final = {
    "matrix": "the matrix: record more and larger loads, like those of the use, and calibrate again.",
    "offset": 'the offset: tare the sensor before use and state offset = "tared" in [[load_case]], or record loads '
    "that are known better.",
    "variables": "temperature and other variables: record over their whole range in use, and calibrate again.",
    "noise": "noise, which no recording lowers: average readings over more than a second, or allow more.",
}


def lower_the_predicted(after: PredictedError, allowed: tuple[float, float]) -> str:
    """Say what lowers a predicted error, by what makes most of it where it is farthest beyond what is allowed.

    Args:
        after: The predicted error.
        allowed: Allowed force and moment error; N, N m; infinite where it is not judged.

    Returns:
        A sentence.
    """
    force, moment = allowed
    worst = after.force if after.force.at_most / force >= after.moment.at_most / moment else after.moment
    shares = {source: float(getattr(worst.sources, source)) for source in _BY_SOURCE}
    quantity = "force" if worst is after.force else "moment"
    return f"Most of the {quantity} error comes from {_BY_SOURCE[max(shares, key=shares.__getitem__)]}"
