# SPDX-License-Identifier: BSD-3-Clause
"""Answers of `sphere` and `compare` in a few lines: by how much axes of a sensor differ over the same weight."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from forcetorque.evaluation.answers import to_calibrate, to_evaluate
from forcetorque.evaluation.sphere.result import EllipsoidRow, FailureRow, SphereRow
from forcetorque.evaluation.trials.result import GroupFitRow, GroupRow, TrialRow
from forcetorque.experiment.calibrations_under_test import PRIOR
from forcetorque.results.answer import Answer, Concern
from forcetorque.results.number_text import bounded
from forcetorque.results.table import short_names

if TYPE_CHECKING:
    from forcetorque.evaluation.sphere.sphere import Spheres
    from forcetorque.evaluation.trials.comparison import Comparison
MEANING = "standard deviation of the masses that the three axes measure"
"""What the index of an ellipsoid is."""


def sphere_answers(spheres: Spheres) -> Iterator[Answer]:
    """Give the answer for every sensor and candidate: by the fit with the model where there is one.

    Args:
        spheres: Spheres of sensors.

    Yields:
        One answer each; of a sensor its calibrations first.
    """
    for sensor in dict.fromkeys(row.sensor for row in spheres.rows):
        own = [row for row in spheres.rows if row.sensor == sensor]
        names = short_names([row.calibration for row in own])
        for row in sorted(own, key=lambda row: row.calibration.startswith(PRIOR)):
            fit = row.with_model or row.without_model
            step, command = _step(row, fit)
            yield Answer(
                subject=f"{row.sensor} ({row.serial}), {names[row.calibration]}",
                verdict=index_verdict(fit),
                why=tuple(_reasons(row, fit)),
                step=step,
                command=command,
                written=(spheres.figure_file,),
                concern=Concern.NONE if fit.identifiable else Concern.UNCERTAIN,
            )
    yield from failed(spheres.failures)


def failed(failures: Sequence[FailureRow]) -> Iterator[Answer]:
    """Give the answer for what could not be analysed.

    Args:
        failures: What failed.

    Yields:
        One answer each; a sensor that nothing turned in several recordings has one.
    """
    static: set[str | None] = set()
    for failure in failures:
        if failure.skipped and failure.sensor in static:
            continue
        static |= {failure.sensor} if failure.skipped else set()
        yield Answer(
            subject=failure.sensor or failure.file,
            verdict="NOT MOVED" if failure.skipped else "FAILED",
            why=(failure.message,),
            concern=Concern.NONE if failure.skipped else Concern.BAD,
        )


def index_verdict(fit: EllipsoidRow) -> str:
    """Say by how much axes differ, or that it is not identifiable."""
    if not fit.identifiable or fit.index_kg is None:
        return "NOT IDENTIFIABLE"
    return f"axes differ by {bounded(fit.index_kg, fit.index_high_kg, 'kg')}"


def _reasons(row: SphereRow, fit: EllipsoidRow) -> Iterator[str]:
    if not fit.identifiable:
        yield "; ".join(fit.why[:2]) or "the forces are flat to rounding"
        return
    yield f"{MEANING}, {row.samples} samples"
    if fit.error_N is not None and row.model_mass_kg is not None:
        errors = ", ".join(f"{error:+.2g}" for error in fit.error_N)
        yield f"force of the axes x, y, z less the weight of {row.model_mass_kg:.3g} kg by the model: {errors} N"


def _step(row: SphereRow, fit: EllipsoidRow) -> tuple[str, str]:
    if not fit.identifiable:
        return "turn the sensor slowly through more directions, and record again", ""
    if row.calibration.startswith(PRIOR):
        return to_calibrate(row.sensor)
    return to_evaluate(row.calibration)


def comparison_answers(comparison: Comparison) -> Iterator[Answer]:
    """Give the answer for every sensor, condition and candidate.

    Args:
        comparison: Trials and their groups.

    Yields:
        One answer each, of calibrations before those of priors, and one for every failure.
    """
    groups = comparison.groups
    names = short_names([row.calibration for row in groups])
    for group in sorted(groups, key=lambda group: group.calibration.startswith(PRIOR)):
        fit, by = _fit(group, comparison.trials)
        words = [f"{group.sensor} ({group.serial})", *([group.condition] if group.condition else [])]
        rank = "" if by.rank is None or len(groups) == 1 else f", rank {by.rank}"
        yield Answer(
            subject=", ".join([*words, names[group.calibration]]),
            verdict=f"{index_verdict(fit)}{rank}",
            why=tuple(_comparison_reasons(group, fit, by)),
            written=(comparison.figure_file,),
            concern=Concern.NONE if fit.identifiable else Concern.UNCERTAIN,
        )
    yield from failed(comparison.failures)


def _fit(group: GroupRow, trials: Sequence[TrialRow]) -> tuple[EllipsoidRow, GroupFitRow]:
    """Pooled fit, or that of the only trial, with the model where there is one."""
    key = (group.sensor, group.serial, group.condition, group.calibration)
    first = next(row for row in trials if (row.sensor, row.serial, row.condition, row.calibration) == key)
    if group.with_model is not None and first.with_model is not None:
        return group.with_model.pooled or first.with_model, group.with_model
    return group.without_model.pooled or first.without_model, group.without_model


def _comparison_reasons(group: GroupRow, fit: EllipsoidRow, by: GroupFitRow) -> Iterator[str]:
    if not fit.identifiable:
        yield "; ".join(fit.why[:2]) or "the forces are flat to rounding"
    else:
        yield f"{MEANING}, {group.trials} trial{'s' * (group.trials > 1)}; ranks are equal where intervals overlap"
    if by.drift is not None and by.drift.exceeds:
        yield f"from the first trial to the last beyond the intervals: {', '.join(by.drift.exceeds)}"
