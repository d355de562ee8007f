# SPDX-License-Identifier: BSD-3-Clause
"""The answers of `study fits` and `study skin` in a few lines: the candidates to take, and torques by skin."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from forcetorque.results.answer import Answer, Concern
from forcetorque.results.number_text import amount, counted, plus_minus, within
from forcetorque.study.candidate_fits import WORKBENCH
from forcetorque.study.candidate_selection import FAR_SD, TWO_SIGMA

if TYPE_CHECKING:
    from forcetorque.study.result import ChosenCandidate, Studies
    from forcetorque.study.skin.result import ComparedRow, SkinStudy


def study_answers(studies: Studies) -> Iterator[Answer]:
    """Give the answer for every sensor.

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
            written=(row.folder, studies.figure_file if row is studies.sensors[-1] else None),
            concern=Concern.UNCERTAIN if far or best.name == WORKBENCH else Concern.NONE,
        )


def _force(chosen: ChosenCandidate) -> str:
    return within(chosen.force_mean_N, TWO_SIGMA * chosen.force_mean_error_N, "N")


def _far(best: ChosenCandidate) -> str:
    return (
        f"at loads that were not fitted it is {best.unfitted.deviation_sd or 0.0:.1f} standard deviations from the "
        "generative fit of the same data: the contact force decides little there"
    )


def skin_study_answer(study: SkinStudy) -> Answer:
    """Say how far forces and torques by skin are off, and what the thesis printed.

    Args:
        study: Simulated trials.

    Returns:
        The answer.
    """
    from forcetorque.study.skin import result as of

    simple, interpolated, gained_simple, gained, to_ft, to_truth, lost = (
        study.compared_of(quantity)
        for quantity in (
            of.SIMPLE,
            of.INTERPOLATED,
            of.GAINED_SIMPLE,
            of.GAINED_INTERPOLATED,
            of.TO_FT,
            of.TO_TRUTH,
            of.LOST,
        )
    )
    return Answer(
        subject=f"{study.layout}, {study.taxels} taxels, {counted(study.trials, 'simulated trial')}",
        verdict=f"ERROR OF FORCES: interpolated {_compared(interpolated)}, simple {_compared(simple)}",
        why=(
            f"with the gain that fits best, which corrects a wrong area: interpolated {_compared(gained)}, simple "
            f"{_compared(gained_simple)}",
            f"knee torque by skin: RMSE to the sensor {_compared(to_ft)}, to the truth {_compared(to_truth)}; from 90 "
            f"to 75 degrees it changes by {_changed(lost)} against the sensor",
        ),
    )


def _compared(row: ComparedRow) -> str:
    """The number with its upper bound, and that of the thesis where it has one."""
    size = amount(row.simulated, row.unit) if row.half_width_95 is None else within(*_numbers(row))
    return f"{size}{_thesis(row)}"


def _changed(row: ComparedRow) -> str:
    """The number with a sign and its interval, and that of the thesis."""
    return f"{plus_minus(*_numbers(row))}{_thesis(row)}"


def _numbers(row: ComparedRow) -> tuple[float, float | None, str]:
    return row.simulated, row.half_width_95, row.unit


def _thesis(row: ComparedRow) -> str:
    return "" if row.thesis is None else f" (thesis {amount(row.thesis, row.unit)})"
