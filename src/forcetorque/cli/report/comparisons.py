# SPDX-License-Identifier: BSD-3-Clause
"""Calibrations against their priors on data that was not fitted, and what that data is worth."""

from __future__ import annotations

from typing import TypedDict

import numpy as np

from forcetorque.cli.output import finite_or_none
from forcetorque.cli.report.result import ComparisonRow, IndependenceRow
from forcetorque.evaluation import PairedMean, autocorrelation, offset_removed, paired_difference, wrench_errors
from forcetorque.experiment import JudgedWrenches
from forcetorque.study import OffsetSource


def independence_rows(judged: JudgedWrenches) -> list[IndependenceRow]:
    """Count how many independent samples the errors of every candidate are worth.

    Args:
        judged: Wrenches on data that was not fitted.

    Returns:
        A row per candidate.
    """
    return [
        IndependenceRow(
            candidate=name,
            samples=len(judged.time_s),
            independent=[
                finite_or_none(autocorrelation(error, judged.time_s).effective_count)
                for error in (wrench - judged.reference).T
            ],
        )
        for name, wrench in judged.measured
    ]


def comparison_rows(judged: JudgedWrenches) -> list[ComparisonRow]:
    """Compare every calibration with its own prior, sample by sample.

    Args:
        judged: Wrenches on data that was not fitted.

    Returns:
        Two rows, force and moment, per calibration that has a prior and offset mode.
    """
    measured = dict(judged.measured)
    rows = []
    for name, prior in judged.priors.items():
        pair = (measured[name], measured[prior])
        moved = tuple(offset_removed(wrench, judged.reference) for wrench in pair)
        for offset, (new, old) in ((OffsetSource.FITTED, pair), (OffsetSource.RE_ESTIMATED, moved)):
            found = paired_difference(new, old, judged.reference, judged.time_s)
            errors = (wrench_errors(new, judged.reference), wrench_errors(old, judged.reference))
            bias = errors[0].bias
            rows.append(
                ComparisonRow(
                    candidate=name,
                    prior=prior,
                    offset=offset.value,
                    quantity="force",
                    unit="N",
                    samples=found.count,
                    mean=errors[0].force_mean,
                    prior_mean=errors[1].force_mean,
                    constant=float(np.linalg.norm(bias[:3])),
                    **_gain(found.force),
                )
            )
            rows.append(
                ComparisonRow(
                    candidate=name,
                    prior=prior,
                    offset=offset.value,
                    quantity="moment",
                    unit="N m",
                    samples=found.count,
                    mean=errors[0].moment_mean,
                    prior_mean=errors[1].moment_mean,
                    constant=float(np.linalg.norm(bias[3:])),
                    **_gain(found.moment),
                )
            )
    return rows


class _Gain(TypedDict):
    """What is known of the gain over the prior."""

    independent: float | None
    gain: float
    gain_low: float | None
    gain_high: float | None


def _gain(found: PairedMean) -> _Gain:
    return {
        "independent": finite_or_none(found.effective_count),
        "gain": -found.mean,
        "gain_low": finite_or_none(-found.high),
        "gain_high": finite_or_none(-found.low),
    }
