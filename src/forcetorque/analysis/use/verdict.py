# SPDX-License-Identifier: BSD-3-Clause
"""The verdict on a calibration: may it be used for the loads to come? One sentence, its reasons, its numbers."""

from __future__ import annotations

from typing import Annotated, Literal

from forcetorque.result import Row, Shown, short_names

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
