# SPDX-License-Identifier: BSD-3-Clause
"""Calibrations against their prior matrices on the same validation samples."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated, Any, Literal

import numpy as np

from forcetorque.base.noise.autocorrelation import autocorrelation
from forcetorque.base.noise.paired_comparison import ErrorRatio, Judgement, PairedErrors, compare_errors
from forcetorque.base.wrench import FORCE, MOMENT
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.experiment.campaign import Campaign, Runs
from forcetorque.experiment.candidates import JudgedWrenches
from forcetorque.experiment.offset_policy import Offset
from forcetorque.recording.recording import Use
from forcetorque.results.number_text import finite_or_none
from forcetorque.results.row import Row, Shown, ShownWrench

Quantity = Literal["force", "moment"]

OFFSET_WORDS = {
    Offset.FITTED: "its own offset",
    Offset.FIRST_SECOND: "the offset of the first second",
    Offset.JUDGED_MEAN: "the mean of the judged samples taken off",
    Offset.NONE: "no offset removed",
}
"""The offsets in sentences."""

_WIDEST = 10.0
"""Upper over lower end of an interval beyond which it is said in words."""


class ErrorComparison(Row):
    """Errors of a candidate over those of another on the same samples, as norms."""

    candidate: Annotated[str, Shown("candidate", file=True)]
    """The calibration file, or the prior."""
    offset: Annotated[Offset, Shown("offset")]
    """Which offset they are judged with."""
    quantity: Annotated[Quantity, Shown("error of")]
    """What the errors are of."""
    unit: Annotated[Literal["N", "N m"], Shown("unit")]
    """Unit of the errors."""
    samples: int
    """Number of judged samples."""
    mean: Annotated[float, Shown("mean", digits=3)]
    """Mean norm of the error with the candidate."""
    ratio: Annotated[float, Shown("ratio", digits=2)]
    """Root mean square error of the candidate over that of the other, geometric mean over the stretches."""
    ratio_low: Annotated[float | None, Shown("at least", digits=2)]
    """Lower end of its 95 % interval; none where too few stretches do not give one."""
    ratio_high: Annotated[float | None, Shown("at most", digits=2)]
    """Upper end."""
    stretches: Annotated[int, Shown("stretches")]
    """Independent stretches of time that the interval comes from."""
    judgement: Annotated[Judgement, Shown("judgement")]
    """What the interval says of the candidate."""

    def against(self, other_mean: float, other: str) -> str:
        """Say what the test says.

        Args:
            other_mean: Mean norm of the error with the other; N or N m.
            other: The other, in words.

        Returns:
            Both means, the judgement, and its interval where it says something.
        """
        digits = 2 if self.quantity == "force" else 3
        means = f"{self.mean:.{digits}f} {self.unit} against {other_mean:.{digits}f} {self.unit} with {other}"
        return f"{means} ({self.judgement}: {self._interval()})"

    def _interval(self) -> str:
        stretches = f"{self.stretches} stretch{'' if self.stretches == 1 else 'es'}"
        if self.ratio_low == self.ratio_high == 1.0:
            return "the same in every sample"
        if self.ratio_low is None or self.ratio_high is None:
            return f"the errors repeat themselves, and are worth {stretches} only"
        if self.judgement == "not told apart" and self.ratio_high > _WIDEST * self.ratio_low:
            return f"{stretches} are too few, or too unlike"
        return f"{self.ratio:.2f} of it, {self.ratio_low:.2f} to {self.ratio_high:.2f} over {stretches}"


def ratio_fields(ratio: ErrorRatio) -> dict[str, Any]:
    """Give a ratio as fields of a row.

    Args:
        ratio: The ratio.

    Returns:
        Fields of `ErrorComparison`.
    """
    known = finite_or_none(ratio.high) is not None
    return {
        "ratio": ratio.ratio,
        "ratio_low": ratio.low if known else None,
        "ratio_high": ratio.high if known else None,
        "stretches": ratio.stretches,
        "judgement": ratio.judgement,
    }


class Independence(Row):
    """How many independent samples the errors of a candidate are worth; neighbours repeat each other."""

    candidate: Annotated[str, Shown("candidate", file=True)]
    """The calibration file, or the prior."""
    samples: Annotated[int, Shown("samples")]
    """Number of judged samples."""
    independent: Annotated[tuple[float | None, ...], ShownWrench(digits=0, counts=True)]
    """Effective number of independent samples per component; none where the error does not change."""


class PriorComparison(ErrorComparison):
    """A calibration against its prior."""

    sensor: str
    """Sensor."""
    prior: Annotated[str, Shown("prior", file=True)]
    """Its prior, as the evaluation names it."""
    prior_mean: Annotated[float, Shown("of the prior", digits=3)]
    """Mean norm of the error with its prior."""
    constant: Annotated[float, Shown("constant", digits=3)]
    """Norm of the mean error vector: the part that another offset would take away."""


def comparison_sentence(name: str, rows: Sequence[PriorComparison]) -> str:
    """Say how a calibration does against its prior, the same wherever it is said.

    Args:
        name: The calibration.
        rows: Its comparisons with one offset, force and moment.

    Returns:
        A sentence.
    """
    words = "; ".join(f"{row.quantity} error {row.against(row.prior_mean, 'the prior')}" for row in rows)
    constant = f"; {rows[0].constant:.2f} N is constant" if rows[0].offset is Offset.FITTED else ""
    offset, samples = OFFSET_WORDS[rows[0].offset], rows[0].samples
    return f"{name} with {offset}, {samples} samples that were not fitted: {words}{constant}"


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


def compare_with_prior(runs: Runs, calibrations: Mapping[str, Calibration]) -> tuple[PriorComparison, ...]:
    """Compare every calibration with its own prior on the validation intervals.

    Args:
        runs: The sensor in one recording, or in several, which are pooled.
        calibrations: Its calibrations by name.

    Returns:
        Two rows, force and moment, per calibration that has a prior and offset.
    """
    campaign = Campaign.of(runs)
    recordings = [run.judged(calibrations) for run in campaign.runs_with(Use.VALIDATION)]
    return prior_comparisons(campaign.sensor.name, recordings)


def prior_comparisons(sensor: str, recordings: Sequence[JudgedWrenches]) -> tuple[PriorComparison, ...]:
    """Compare every calibration with its own prior by what they measure.

    Args:
        sensor: Name of the sensor.
        recordings: Wrenches on data that was not fitted, by the same candidates in every recording.

    Returns:
        Two rows, force and moment, per calibration that has a prior and offset, pooled over the recordings.
    """
    # a calibration may be called `prior` too
    measured = [
        {
            (candidate.name, candidate.prior is None, offset): wrench
            for candidate, offset, wrench in judged.with_either_offset()
        }
        for judged in recordings
    ]
    return tuple(
        row
        for name, prior in recordings[0].priors.items()
        for offset in (Offset.FITTED, Offset.JUDGED_MEAN)
        for row in _compared(
            {"sensor": sensor, "candidate": name, "prior": prior, "offset": offset},
            [
                PairedErrors.of(wrenches[name, False, offset], wrenches[prior, True, offset], judged.reference)
                for wrenches, judged in zip(measured, recordings, strict=True)
            ],
        )
    )


def _compared(names: Mapping[str, Any], pairs: Sequence[PairedErrors]) -> Iterator[PriorComparison]:
    comparison = compare_errors(pairs)
    new, old = (np.concatenate(errors) for errors in zip(*((pair.first, pair.second) for pair in pairs), strict=True))
    quantities: tuple[tuple[Quantity, Literal["N", "N m"], slice, ErrorRatio], ...] = (
        ("force", "N", FORCE, comparison.force),
        ("moment", "N m", MOMENT, comparison.moment),
    )
    for quantity, unit, axes, ratio in quantities:
        mean, prior_mean = (float(np.linalg.norm(error[:, axes], axis=1).mean()) for error in (new, old))
        yield PriorComparison(
            **names,
            quantity=quantity,
            unit=unit,
            samples=comparison.count,
            mean=mean,
            prior_mean=prior_mean,
            constant=float(np.linalg.norm(new[:, axes].mean(axis=0))),
            **ratio_fields(ratio),
        )
