# SPDX-License-Identifier: BSD-3-Clause
"""Calibrations against their priors on the same samples that were not fitted, and what those samples are worth."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated, Any, Literal

import numpy as np

from forcetorque.analysis.runs.campaign import Campaign, Runs
from forcetorque.analysis.runs.judged import JudgedWrenches
from forcetorque.analysis.use.error_comparison import OFFSET_WORDS, ErrorComparison, Quantity, ratio_fields
from forcetorque.calibration import Calibration
from forcetorque.evaluation import ErrorRatio, Offset, PairedErrors, autocorrelation, compare_errors
from forcetorque.recording import Use
from forcetorque.result import Row, Shown, ShownWrench, finite_or_none
from forcetorque.spatial import FORCE, MOMENT


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
