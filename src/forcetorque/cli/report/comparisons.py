# SPDX-License-Identifier: BSD-3-Clause
"""Calibrations against their priors on data that was not fitted, and what that data is worth."""

from __future__ import annotations

from typing import Literal

import numpy as np

from forcetorque.analysis import JudgedWrenches
from forcetorque.cli.output import finite_or_none
from forcetorque.cli.report.result import ComparisonRow, IndependenceRow
from forcetorque.evaluation import Offset, PairedMean, autocorrelation, offset_removed, paired_difference

_Quantity = tuple[Literal["force", "moment"], Literal["N", "N m"], slice, PairedMean]


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
        for offset, (new, old) in ((Offset.FITTED, pair), (Offset.JUDGED_MEAN, moved)):
            found = paired_difference(new, old, judged.reference, judged.time_s)
            errors = (new - judged.reference, old - judged.reference)
            quantities: tuple[_Quantity, ...] = (
                ("force", "N", slice(0, 3), found.force),
                ("moment", "N m", slice(3, 6), found.moment),
            )
            for quantity, unit, part, gain in quantities:
                norms = [float(np.linalg.norm(error[:, part], axis=1).mean()) for error in errors]
                rows.append(
                    ComparisonRow(
                        candidate=name,
                        prior=prior,
                        offset=offset,
                        quantity=quantity,
                        unit=unit,
                        samples=found.count,
                        independent=finite_or_none(gain.effective_count),
                        mean=norms[0],
                        prior_mean=norms[1],
                        gain=-gain.mean,
                        gain_low=finite_or_none(-gain.high),
                        gain_high=finite_or_none(-gain.low),
                        constant=float(np.linalg.norm(errors[0][:, part].mean(axis=0))),
                    )
                )
    return rows
