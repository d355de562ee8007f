# SPDX-License-Identifier: BSD-3-Clause
"""Rows of the comparison of trials: every trial, and every group of them with its mean, pooled fit, rank and drift."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Self

from forcetorque.evaluation.sphere.ellipsoid import CloudForm, EllipsoidFit
from forcetorque.evaluation.sphere.result import EllipsoidRow
from forcetorque.evaluation.trials.trials import DriftRow, TrialGroup, TrialSphere, mean_of_trials
from forcetorque.results.number_text import finite_or_none
from forcetorque.results.table import AxisValues, Row, RowOfSensor


class TrialRow(RowOfSensor):
    """One sensor in one trial, read in one way: a row of thesis Table 4.1."""

    condition: str | None
    """What was done to the sensor, in the user's words."""
    trial: int
    """Place among the trials of its condition, from 1."""
    calibration: str
    """`prior`, or the calibration file."""
    file: str
    """Experiment file."""
    experiment: str
    """Name of the experiment."""
    intervals: tuple[str, ...]
    """Intervals whose samples were taken together."""
    fitted_on: tuple[str, ...]
    """Those of them that the calibration was fitted on, which flatters it."""
    samples: int
    """Number of samples."""
    gravity_m_s2: float
    """Magnitude of gravity."""
    model_mass_kg: float | None
    """Mass beyond the sensor by the model."""
    form: CloudForm
    """What part of a sphere the forces can be told to be."""
    no_model: str | None
    """Why there is no fit with the model; none where there is one."""
    with_model: EllipsoidRow | None
    """An ellipsoid with the model."""
    without_model: EllipsoidRow
    """An ellipsoid without the model."""

    @classmethod
    def of(cls, trial: TrialSphere, number: int) -> Self:
        """Take the numbers of a trial.

        Args:
            trial: The trial.
            number: Its place in its group, from 1.

        Returns:
            Its row.
        """
        sphere, analysis = trial.sphere, trial.sphere.analysis
        mapped = analysis.mapped
        return cls(
            sensor=sphere.sensor,
            serial=sphere.serial,
            condition=trial.condition,
            trial=number,
            calibration=sphere.calibration,
            file=trial.file,
            experiment=trial.experiment,
            intervals=sphere.intervals,
            fitted_on=sphere.fitted_on,
            samples=analysis.samples,
            gravity_m_s2=analysis.gravity,
            model_mass_kg=analysis.mass,
            form=analysis.form,
            no_model=sphere.no_fit_with_model,
            with_model=None if mapped is None else EllipsoidRow.of(mapped.fit, analysis),
            without_model=EllipsoidRow.of(analysis.free, analysis),
        )


class GroupFitRow(Row):
    """The trials of a group by one of the two fits."""

    known: int
    """Trials that are identifiable: those that are averaged."""
    mean_index_kg: float | None
    """Plain mean of their indices: the `Average Std` of thesis Tables 4.3 and 4.4; none where none is identifiable."""
    mean_low_kg: float | None
    """Lower end of its 95 % interval from the scatter between trials."""
    mean_high_kg: float | None
    """Upper end; none with one trial."""
    pooled: EllipsoidRow | None
    """One ellipsoid through the samples of all trials, each about its own centre; none with one trial."""
    pooled_centre_N: tuple[AxisValues, ...] | None
    """Centre of each trial by it."""
    rank: int | None
    """One more than the number of groups whose index, of the pooled fit or the only trial, has its whole interval below
    that of this one; groups whose intervals overlap are in no order; none where the index is not identifiable."""
    drift: DriftRow | None
    """What changed from the first trial to the last; none with one trial."""


class GroupRow(RowOfSensor):
    """All trials of one sensor under one condition, read in one way."""

    condition: str | None
    """What was done to the sensor."""
    calibration: str
    """`prior`, or the calibration file."""
    trials: int
    """Number of trials."""
    not_pooled: str | None
    """Why several trials have no pooled fit."""
    with_model: GroupFitRow | None
    """By the fits with the model; none where no trial has one."""
    without_model: GroupFitRow
    """By the fits without the model."""


def group_rows(groups: Sequence[TrialGroup]) -> tuple[GroupRow, ...]:
    """Put groups into the form of the result, and rank those that are identifiable by what their intervals tell apart.

    Returns:
        Their rows, in the same order.
    """
    ranks = {with_model: _ranks(groups, with_model=with_model) for with_model in (True, False)}
    rows = []
    for k, group in enumerate(groups):
        sphere = group.first.sphere
        mapped = any(trial.fit(with_model=True) is not None for trial in group.trials)
        rows.append(
            GroupRow(
                sensor=sphere.sensor,
                serial=sphere.serial,
                condition=group.first.condition,
                calibration=sphere.calibration,
                trials=len(group.trials),
                not_pooled=group.not_pooled,
                with_model=_group_fit(group, ranks[True][k], with_model=True) if mapped else None,
                without_model=_group_fit(group, ranks[False][k], with_model=False),
            )
        )
    return tuple(rows)


def _ranks(groups: Sequence[TrialGroup], *, with_model: bool) -> list[int | None]:
    ends = [group.index_interval(with_model=with_model) for group in groups]
    tops = [end[1] for end in ends if end is not None]
    return [None if end is None else 1 + sum(top < end[0] for top in tops) for end in ends]


def _group_fit(group: TrialGroup, rank: int | None, *, with_model: bool) -> GroupFitRow:
    indices = group.identifiable_indices(with_model=with_model)
    mean, low, high = mean_of_trials(indices) if indices else (None, None, None)
    fit, centres = group.pooled_fit(with_model=with_model), None
    if group.pooled is not None:
        centres = group.pooled.mapped_centres if with_model else group.pooled.free_centres
    return GroupFitRow(
        known=len(indices),
        mean_index_kg=mean,
        mean_low_kg=low,
        mean_high_kg=None if high is None else finite_or_none(high),
        pooled=None if fit is None else _pooled_row(fit, group),
        pooled_centre_N=None if centres is None else tuple(centres),
        rank=rank,
        drift=group.drift(with_model=with_model),
    )


def _pooled_row(fit: EllipsoidFit, group: TrialGroup) -> EllipsoidRow:
    # it has no centre of its own: each trial has one
    return EllipsoidRow.of(fit, group.first.sphere.analysis).model_copy(update={"centre_N": None})
