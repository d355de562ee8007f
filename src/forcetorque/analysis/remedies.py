# SPDX-License-Identifier: BSD-3-Clause
"""What to do about a reason that speaks against a use, in words."""

from __future__ import annotations

from typing import Final

from forcetorque.evaluation.use import PredictedError

LOOK_FOR_CAUSE: Final = (
    "find out what the measured error is before more is recorded: `forcetorque inspect` names contacts, steps, delays "
    "and losses; masses that the robot's model lacks and a sensor that warms up look like it too"
)
"""About an error on data that were not fitted which nothing predicts."""
MEND_DATA: Final = "put right in the recording or the experiment file what the doubt names, and calibrate again"
"""About fitted data that were in doubt."""
_BY_SOURCE: Final = {
    "matrix": "the matrix makes most of it: record more and larger loads, like those of the use, and calibrate again",
    "offset": 'the offset makes most of it: tare the sensor before use and state offset = "tared" in [[load_case]], or '
    "record where the loads are known to less",
    "variables": "temperature and other variables make most of it: record over the whole range of the use, and "
    "calibrate again",
    "noise": "noise makes most of it, which no recording lowers: average readings over more than a second, or allow "
    "more",
}


def lower_the_predicted(after: PredictedError, allowed: tuple[float, float]) -> str:
    """Say what lowers a predicted error, by what makes most of it where it is farthest beyond what is allowed.

    Args:
        after: The predicted error.
        allowed: Allowed force and moment error; N, N m; infinite where it is not judged.

    Returns:
        Words that go on a sentence.
    """
    force, moment = allowed
    worst = after.force if after.force.at_most / force >= after.moment.at_most / moment else after.moment
    shares = {source: float(getattr(worst.sources, source)) for source in _BY_SOURCE}
    quantity = "force" if worst is after.force else "moment"
    return f"to lower the {quantity} error: {_BY_SOURCE[max(shares, key=shares.__getitem__)]}"
