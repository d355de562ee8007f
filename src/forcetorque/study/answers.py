# SPDX-License-Identifier: BSD-3-Clause
"""The answer of `study` in a few lines: the best candidate, and how it compares with the prior matrix."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from forcetorque.results.answer import Answer, Concern
from forcetorque.results.number_text import within
from forcetorque.study.one_sensor import WORKBENCH
from forcetorque.study.selection import FAR_SD

if TYPE_CHECKING:
    from forcetorque.study.result import ChosenCandidate, Studies

_TWO_SIGMA = 1.96
"""Standard errors of a bound that holds with 95 %."""


def study_answers(studies: Studies) -> Iterator[Answer]:
    """Give the answer for every sensor.

    Args:
        studies: Their studies.

    Yields:
        One answer each.
    """
    for row in studies.sensors:
        best = min((mode.best for mode in row.modes), key=lambda chosen: chosen.force_mean_N, default=row.workbench)
        if best is None:
            continue
        far = best.unfitted.deviation_sd is not None and best.unfitted.deviation_sd > FAR_SD
        prior = "" if row.workbench is None else f", {WORKBENCH} {_force(row.workbench)}"
        yield Answer(
            subject=f"{row.sensor} ({row.serial}), {row.candidates + row.generative} candidates",
            verdict=f"BEST: {best.name}",
            why=(
                f"mean contact force where nothing touches, {row.validation_samples} samples: {_force(best)}{prior}",
                *((_far(best),) if far else ()),
            ),
            step="evaluate a calibration of the folder at the loads to come" if row.folder is not None else "",
            written=(row.folder,),
            concern=Concern.UNCERTAIN if far or best.name == WORKBENCH else Concern.NONE,
        )


def _force(chosen: ChosenCandidate) -> str:
    return within(chosen.force_mean_N, _TWO_SIGMA * chosen.force_mean_error_N, "N")


def _far(best: ChosenCandidate) -> str:
    return (
        f"at loads that were not fitted it is {best.unfitted.deviation_sd or 0.0:.1f} standard deviations from the "
        "generative fit of the same data: the contact force decides little there"
    )
