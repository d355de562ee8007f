# SPDX-License-Identifier: BSD-3-Clause
"""Calibrations against their priors on the same samples that were not fitted, and what those samples are worth."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Annotated, Literal

import numpy as np

from forcetorque.analysis.judged import JudgedWrenches
from forcetorque.analysis.sensor_run import SensorRun
from forcetorque.arrays import FloatArray
from forcetorque.calibration import Calibration
from forcetorque.evaluation import Offset, PairedMean, autocorrelation, paired_difference
from forcetorque.result import Row, Shown, ShownWrench, finite_or_none

FEWEST_INDEPENDENT = 6.0
"""Independent samples below which an interval of a difference is not worth its name: at 3 it misses in 8 to 12 %,
and it can be a thousand times as wide as the difference."""

_FEWEST = 20
"""Samples below which nothing is called better."""

Quantity = Literal["force", "moment"]
Judgement = Literal["better", "worse", "no difference that the recording shows"]


class Independence(Row):
    """How many independent samples the errors of a candidate are worth; neighbours repeat each other."""

    candidate: Annotated[str, Shown("candidate", file=True)]
    """The calibration file, or the prior."""
    samples: Annotated[int, Shown("samples")]
    """Number of judged samples."""
    independent: Annotated[tuple[float | None, ...], ShownWrench(digits=0, counts=True)]
    """Effective number of independent samples per component; none where the error does not change."""


class PriorComparison(Row):
    """A calibration against its prior on the same samples: norms of the errors, and what they differ by."""

    candidate: Annotated[str, Shown("candidate", file=True)]
    """The calibration file."""
    prior: Annotated[str, Shown("prior", file=True)]
    """Its prior, as the evaluation names it."""
    offset: Annotated[Offset, Shown("offset")]
    """Offset of the fitted data, or mean of the judged samples."""
    quantity: Annotated[Quantity, Shown("error of")]
    """What the errors are of."""
    unit: Annotated[Literal["N", "N m"], Shown("unit")]
    """Unit of the errors."""
    samples: int
    """Number of judged samples."""
    independent: Annotated[float | None, Shown("independent", digits=0)]
    """How many independent ones their differences are worth; none where they do not change."""
    mean: Annotated[float, Shown("mean", digits=3)]
    """Mean norm of the error with the calibration."""
    prior_mean: Annotated[float, Shown("of the prior", digits=3)]
    """The same with its prior."""
    gain: Annotated[float, Shown("less by", digits=3)]
    """Mean of the differences, prior less calibration."""
    gain_low: Annotated[float | None, Shown("at least", digits=3)]
    """Lower end of its 95 % interval; none where fewer than 6 independent samples do not give one."""
    gain_high: Annotated[float | None, Shown("at most", digits=3)]
    """Upper end."""
    constant: Annotated[float, Shown("constant", digits=3)]
    """Norm of the mean error vector: the part that another offset would take away."""

    @property
    def judgement(self) -> Judgement | None:
        """What the interval of the difference says; None where the samples are too few to say anything."""
        if self.gain_low is None or self.gain_high is None or self.samples < _FEWEST:
            return None
        if self.gain_low <= 0.0 <= self.gain_high:
            return "no difference that the recording shows"
        return "better" if self.gain_low > 0.0 else "worse"


def independence(judged: JudgedWrenches) -> tuple[Independence, ...]:
    """Count how many independent samples the errors of every candidate are worth.

    Args:
        judged: Wrenches on data that was not fitted.

    Returns:
        A row per candidate.
    """
    return tuple(
        Independence(
            candidate=name,
            samples=len(judged.time_s),
            independent=tuple(
                finite_or_none(autocorrelation(error, judged.time_s).effective_count)
                for error in (wrench - judged.reference).T
            ),
        )
        for name, wrench in judged.measured
    )


def compare_with_prior(run: SensorRun, calibrations: Mapping[str, Calibration]) -> tuple[PriorComparison, ...]:
    """Compare every calibration with its own prior, sample by sample, on the validation intervals.

    Args:
        run: The sensor.
        calibrations: Its calibrations by name.

    Returns:
        Two rows, force and moment, per calibration that has a prior and offset.
    """
    judged = run.judged(calibrations)
    measured = {(candidate.name, offset): wrench for candidate, offset, wrench in judged.with_either_offset()}
    return tuple(
        row
        for name, prior in judged.priors.items()
        for offset in (Offset.FITTED, Offset.JUDGED_MEAN)
        for row in _compared(name, prior, offset, measured[name, offset], measured[prior, offset], judged)
    )


def _compared(
    name: str, prior: str, offset: Offset, new: FloatArray, old: FloatArray, judged: JudgedWrenches
) -> Iterator[PriorComparison]:
    difference = paired_difference(new, old, judged.reference, judged.time_s)
    errors = (new - judged.reference, old - judged.reference)
    quantities: tuple[tuple[Quantity, Literal["N", "N m"], slice, PairedMean], ...] = (
        ("force", "N", slice(0, 3), difference.force),
        ("moment", "N m", slice(3, 6), difference.moment),
    )
    for quantity, unit, axes, gain in quantities:
        mean, prior_mean = (float(np.linalg.norm(error[:, axes], axis=1).mean()) for error in errors)
        low, high = (-gain.high, -gain.low) if gain.effective_count >= FEWEST_INDEPENDENT else (np.nan, np.nan)
        yield PriorComparison(
            candidate=name,
            prior=prior,
            offset=offset,
            quantity=quantity,
            unit=unit,
            samples=difference.count,
            independent=finite_or_none(gain.effective_count),
            mean=mean,
            prior_mean=prior_mean,
            gain=-gain.mean,
            gain_low=finite_or_none(low),
            gain_high=finite_or_none(high),
            constant=float(np.linalg.norm(errors[0][:, axes].mean(axis=0))),
        )
