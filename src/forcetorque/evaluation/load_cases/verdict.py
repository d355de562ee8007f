# SPDX-License-Identifier: BSD-3-Clause
"""The verdict on a calibration at a load case: whether it may be used, why, and what to do."""

from __future__ import annotations

from typing import Annotated, Final, Literal

from forcetorque.evaluation.load_cases.prediction import PredictedError
from forcetorque.results.row import Row, Shown
from forcetorque.results.table import short_names

Decision = Literal["use", "do not use", "not enough data"]
Tone = Literal["good", "caution", "bad", "unknown", "note"]

TONES: dict[Decision, Tone] = {"use": "good", "do not use": "bad", "not enough data": "caution"}
"""How good a decision is."""


class Reason(Row):
    """Why a verdict is what it is."""

    against: Literal["use", "data"] | None
    """Whether it forbids the use, or says that data are lacking; None where it speaks for the use or only informs."""
    text: str
    """The reason, in words."""
    remedy: str | None = None
    """What to do about it; None where the reason says it itself, or where nothing is to be done."""


class UseError(Row):
    """Predicted root mean square error of readings, averaged over a second, at the loads of a use."""

    quantity: Annotated[Literal["force", "moment"], Shown("error of")]
    """What the error is of."""
    unit: Annotated[Literal["N", "N m"], Shown("unit")]
    """Its unit; that of all numbers here."""
    load: Annotated[float, Shown("load", digits=3)]
    """Root mean square of the loads."""
    before: Annotated[float | None, Shown("prior", digits=3)]
    """With the prior matrix, as the recordings know it now: median; None without a prior."""
    before_at_least: float | None
    """Lower end of its 95 % interval."""
    before_at_most: Annotated[float | None, Shown("at most", digits=3)]
    """Upper end."""
    after: Annotated[float, Shown("calibration", digits=3)]
    """With the calibration: median."""
    after_at_least: float
    """Lower end of its 95 % interval; the sensor may repeat itself better than is assumed, and err by less."""
    after_at_most: Annotated[float, Shown("at most", digits=3)]
    """Upper end; those of force and moment are both held with 95 %."""
    allowed: Annotated[float | None, Shown("allowed", digits=3)]
    """What the use allows; None where this quantity is not judged."""
    measured: Annotated[float | None, Shown("measured", digits=3)] = None
    """Root mean square on data that were not fitted, at their loads; without its constant part where the use is tared.
    None without such data."""
    axes: tuple[float, float, float]
    """Expected with the calibration along x, y and z."""
    from_matrix: Annotated[float, Shown("matrix", digits=3)]
    """Part of it that the matrix makes."""
    from_offset: Annotated[float, Shown("offset", digits=3)]
    """Part that the offset makes; those of matrix and offset may take each other away."""
    from_variables: Annotated[float, Shown("variables", digits=3)]
    """Part that the coefficients of variables such as temperature make."""
    from_noise: Annotated[float, Shown("noise", digits=3)]
    """Part that noise makes in a mean over a second."""


class UseVerdict(Row):
    """Whether one calibration may be used for one load case."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    candidate: str
    """The calibration file."""
    load_case: str
    """Name of the load case."""
    loads: str
    """What the loads are, in words."""
    offset: Literal["fitted", "tared"]
    """What offset readings are taken with."""
    stated: bool
    """Whether anybody stated the use; else it is the default."""
    decision: Decision
    """What to do."""
    sentence: str
    """The verdict in one sentence."""
    reasons: tuple[Reason, ...]
    """What speaks against it and for it, the weightiest first."""
    within: float | None
    """Predicted probability that the error is no more than allowed; None where nothing predicts it."""
    errors: tuple[UseError, ...]
    """Predicted errors of force and moment; none without a covariance."""

    @property
    def tone(self) -> Tone:
        """How good it is."""
        return TONES[self.decision]


def use_sentences(verdicts: tuple[UseVerdict, ...]) -> list[str]:
    """Give the verdicts as sentences, each with the name of its calibration.

    Args:
        verdicts: Verdicts.

    Returns:
        A sentence each.
    """
    names = short_names([verdict.candidate for verdict in verdicts])
    return [f"{verdict.sensor}, {names[verdict.candidate]}: {verdict.sentence}" for verdict in verdicts]


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
