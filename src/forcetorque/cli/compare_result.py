# SPDX-License-Identifier: BSD-3-Clause
"""The result of `forcetorque compare`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from forcetorque.analysis import TrialGroup, TrialSphere
from forcetorque.arrays import BoolArray, FloatArray
from forcetorque.cli.output import finite_or_none
from forcetorque.cli.sphere_result import EllipsoidRow, FailureRow, ellipsoid_row
from forcetorque.evaluation.sphere import CloudForm, Drift, EllipsoidFit

_AXES = "xyz"


class TrialRow(BaseModel):
    """One sensor in one trial, read in one way: a row of thesis Table 4.1."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    condition: str | None
    """What was done to the sensor, in the user's words."""
    trial: int
    """Place among the trials of its condition, from 1."""
    candidate: str
    """`prior`, or the calibration file."""
    file: str
    """Experiment file."""
    experiment: str
    """Name of the experiment."""
    intervals: list[str]
    """Intervals whose samples were taken together."""
    fitted_on: list[str]
    """Those of them that the calibration was fitted on, which flatters it."""
    samples: int
    """Number of samples."""
    gravity_m_s2: float
    """Magnitude of gravity."""
    model_mass_kg: float | None
    """Mass that hangs on the sensor by the model."""
    form: CloudForm
    """What part of a sphere the forces can be told to be."""
    no_reference: str | None
    """Why there is no fit with the model; none where there is one."""
    with_reference: EllipsoidRow | None
    """An ellipsoid with the model."""
    without_reference: EllipsoidRow
    """An ellipsoid without the model."""


class DriftRow(BaseModel):
    """What changed from the first trial to the last; margins are for all seven numbers at once, from both intervals."""

    identifiable: bool
    """Whether both trials are; else nothing is said to have changed."""
    index_kg: float
    """Change of the index."""
    index_margin_kg: float | None
    """Its margin; none where it has no end."""
    mass_kg: list[float]
    """Change of the apparent mass of each axis."""
    mass_margin_kg: list[float | None]
    """Their margins."""
    centre_N: list[float]
    """Change of what the sensor reads without force."""
    centre_margin_N: list[float | None]
    """Its margins."""
    exceeds: list[str] | None
    """What changed by more than its margin; none where it is not identifiable."""


class GroupFitRow(BaseModel):
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
    pooled_centre_N: list[list[float]] | None
    """Centre of each trial by it."""
    rank: int | None
    """One more than the number of groups whose index, of the pooled fit or the only trial, has its whole interval below
    that of this one; groups whose intervals overlap are in no order; none where the index is not identifiable."""
    drift: DriftRow | None
    """What changed from the first trial to the last; none with one trial."""


class GroupRow(BaseModel):
    """All trials of one sensor under one condition, read in one way."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    condition: str | None
    """What was done to the sensor."""
    candidate: str
    """`prior`, or the calibration file."""
    trials: int
    """Number of trials."""
    not_pooled: str | None
    """Why several trials have no pooled fit."""
    with_reference: GroupFitRow | None
    """By the fits with the model; none where no trial has one."""
    without_reference: GroupFitRow
    """By the fits without the model."""


class CompareResult(BaseModel):
    """What `forcetorque compare` found."""

    model_config = ConfigDict(populate_by_name=True)

    schema_name: Literal["forcetorque/compare/1"] = Field(default="forcetorque/compare/1", alias="schema")
    """Form of the result."""
    tolerance: float
    """Half width of an interval, relative to the mean radius, up to which a number is identifiable."""
    rule: str
    """How it is decided what is identifiable."""
    figure: str | None
    """File of the figure; none where none was drawn."""
    trials: list[TrialRow]
    """One per sensor, trial and way to read it, in the order of the groups."""
    groups: list[GroupRow]
    """One per sensor, condition and way to read it."""
    failures: list[FailureRow]
    """What could not be analysed; the exit code is 1 if there is any."""


def trial_row(trial: TrialSphere, number: int) -> TrialRow:
    """Put a trial into the form of the result.

    Args:
        trial: The trial.
        number: Its place in its group, from 1.

    Returns:
        Its row.
    """
    sphere, analysis = trial.sphere, trial.sphere.analysis
    mapped = analysis.mapped
    return TrialRow(
        sensor=sphere.sensor,
        serial=sphere.serial,
        condition=trial.condition,
        trial=number,
        candidate=sphere.candidate,
        file=trial.file,
        experiment=trial.experiment,
        intervals=list(sphere.intervals),
        fitted_on=list(sphere.fitted_on),
        samples=analysis.samples,
        gravity_m_s2=analysis.gravity,
        model_mass_kg=analysis.mass,
        form=analysis.form,
        no_reference=sphere.no_fit_with_model,
        with_reference=None if mapped is None else ellipsoid_row(mapped.fit, analysis),
        without_reference=ellipsoid_row(analysis.free, analysis),
    )


def group_rows(groups: Sequence[TrialGroup]) -> list[GroupRow]:
    """Put groups into the form of the result, and rank those that are identifiable by what their intervals tell apart.

    Args:
        groups: The groups.

    Returns:
        Their rows, in the same order.
    """
    ranks = {with_reference: _ranks(groups, with_reference=with_reference) for with_reference in (True, False)}
    rows = []
    for k, group in enumerate(groups):
        sphere = group.first.sphere
        mapped = any(trial.fit(with_reference=True) is not None for trial in group.trials)
        rows.append(
            GroupRow(
                sensor=sphere.sensor,
                serial=sphere.serial,
                condition=group.first.condition,
                candidate=sphere.candidate,
                trials=len(group.trials),
                not_pooled=group.not_pooled,
                with_reference=_group_fit(group, ranks[True][k], with_reference=True) if mapped else None,
                without_reference=_group_fit(group, ranks[False][k], with_reference=False),
            )
        )
    return rows


def _ranks(groups: Sequence[TrialGroup], *, with_reference: bool) -> list[int | None]:
    ends = [group.index_interval(with_reference=with_reference) for group in groups]
    tops = [end[1] for end in ends if end is not None]
    return [None if end is None else 1 + sum(top < end[0] for top in tops) for end in ends]


def _group_fit(group: TrialGroup, rank: int | None, *, with_reference: bool) -> GroupFitRow:
    mean, drift = group.mean(with_reference=with_reference), group.drift(with_reference=with_reference)
    fit, analysis, centres = group.pooled_fit(with_reference=with_reference), group.first.sphere.analysis, None
    if group.pooled is not None:
        centres = group.pooled.mapped_centres if with_reference else group.pooled.free_centres
    return GroupFitRow(
        known=0 if mean is None else mean.count,
        mean_index_kg=None if mean is None else mean.mean,
        mean_low_kg=None if mean is None else mean.low,
        mean_high_kg=None if mean is None else finite_or_none(mean.high),
        pooled=None if fit is None else _pooled_row(fit, group),
        pooled_centre_N=None if centres is None else centres.tolist(),
        rank=rank,
        drift=None if drift is None else _drift_row(drift, analysis.gravity),
    )


def _pooled_row(fit: EllipsoidFit, group: TrialGroup) -> EllipsoidRow:
    # it has no centre of its own: each trial has one
    return ellipsoid_row(fit, group.first.sphere.analysis).model_copy(update={"centre_N": None})


def _drift_row(drift: Drift, gravity: float) -> DriftRow:
    exceeds = ["index"] if drift.index_exceeds else []
    exceeds += _named("mass", drift.intersections_exceed) + _named("centre", drift.centre_exceeds)
    return DriftRow(
        identifiable=drift.identifiable,
        index_kg=drift.index / gravity,
        index_margin_kg=finite_or_none(drift.index_margin / gravity),
        mass_kg=(drift.intersections / gravity).tolist(),
        mass_margin_kg=_ends(drift.intersection_margin / gravity),
        centre_N=drift.centre.tolist(),
        centre_margin_N=_ends(drift.centre_margin),
        exceeds=exceeds if drift.identifiable else None,
    )


def _named(what: str, exceed: BoolArray) -> list[str]:
    return [f"{what} {axis}" for axis, beyond in zip(_AXES, exceed, strict=True) if beyond]


def _ends(values: FloatArray) -> list[float | None]:
    return [finite_or_none(float(value)) for value in values]


def flat_rows(result: CompareResult) -> list[dict[str, object]]:
    """Put a result into lines of numbers: those of trials, then means, pooled fits and drifts of groups, then failures.

    Args:
        result: The result.

    Returns:
        Lines by column; `row` says what each is, and `fit` by which ellipsoid.
    """
    rows: list[dict[str, object]] = []
    for trial in result.trials:
        head: dict[str, object] = {"sensor": trial.sensor, "serial": trial.serial, "condition": trial.condition}
        head |= {"candidate": trial.candidate, "trial": trial.trial, "file": trial.file}
        head |= {"model_mass_kg": trial.model_mass_kg, "samples": trial.samples}
        for name, fit in (("with_reference", trial.with_reference), ("without_reference", trial.without_reference)):
            if fit is not None:
                rows.append({"row": "trial", "fit": name, **head, **_flat_fit(fit)})
    for group in result.groups:
        head = {"sensor": group.sensor, "serial": group.serial, "condition": group.condition}
        head |= {"candidate": group.candidate, "trials": group.trials}
        for name, by in (("with_reference", group.with_reference), ("without_reference", group.without_reference)):
            if by is not None:
                rows += [{"row": kind, "fit": name, **head, **values} for kind, values in _flat_group(by)]
    return rows + [{"row": "failure", **failure.model_dump()} for failure in result.failures]


def _flat_group(by: GroupFitRow) -> list[tuple[str, dict[str, object]]]:
    ends = {"index_low_kg": by.mean_low_kg, "index_high_kg": by.mean_high_kg}
    ends["rank"] = by.rank if by.pooled is None else None
    known = by.known > 0
    rows: list[tuple[str, dict[str, object]]] = [
        ("mean", {"trials": by.known, "identifiable": known, "index_kg": by.mean_index_kg, **ends})
    ]
    if by.pooled is not None:
        rows.append(("pooled", {**_flat_fit(by.pooled), "rank": by.rank}))
    if by.drift is not None:
        drift = by.drift
        values: dict[str, object] = {"identifiable": drift.identifiable, "index_kg": drift.index_kg}
        values |= {"index_margin_kg": drift.index_margin_kg}
        for name, numbers in (
            ("mass_{}_kg", drift.mass_kg),
            ("mass_{}_margin_kg", drift.mass_margin_kg),
            ("centre_{}_N", drift.centre_N),
            ("centre_{}_margin_N", drift.centre_margin_N),
        ):
            values |= {name.format(axis): number for axis, number in zip(_AXES, numbers, strict=True)}
        values["exceeds"] = None if drift.exceeds is None else "; ".join(drift.exceeds)
        rows.append(("drift", values))
    return rows


def _flat_fit(fit: EllipsoidRow) -> dict[str, object]:
    flat: dict[str, object] = {"identifiable": fit.identifiable, "index_kg": fit.index_kg}
    flat |= {"index_low_kg": fit.index_low_kg, "index_high_kg": fit.index_high_kg}
    for name, numbers in (("mass_{}_kg", fit.mass_kg), ("error_{}_N", fit.error_N), ("centre_{}_N", fit.centre_N)):
        flat |= {name.format(axis): None if numbers is None else numbers[k] for k, axis in enumerate(_AXES)}
    flat["why"] = "; ".join(fit.why)
    return flat
