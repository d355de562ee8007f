# SPDX-License-Identifier: BSD-3-Clause
"""Contact forces that calibrations report where nothing touches, and which calibration is best there."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Literal, Self

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.noise.paired_comparison import PairedErrors, compare_errors
from forcetorque.base.rows_on_disk import in_blocks
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.evaluation.load_cases.validation_evidence import (
    ErrorComparison,
    fewest_independent,
    known_interval,
    validation_excitation,
)
from forcetorque.evaluation.validation.contact_wrenches import ContactWrenches, contact_wrenches, pooled_contacts
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibrations_under_test import errors_from_zero
from forcetorque.experiment.campaign import Campaign, Runs
from forcetorque.experiment.experiment import ExperimentSensor
from forcetorque.experiment.free_sub_model import BEYOND_SENSOR, SubModelChoice
from forcetorque.experiment.validation_offset import Offset
from forcetorque.results.number_text import finite_or_none
from forcetorque.results.table import (
    Row,
    RowOfSensor,
    Shown,
    ShownWrench,
    Table,
    WrenchValues,
    short_names,
    table_of,
    with_first_column,
    without_vague,
)


class CalibrationComparison(ErrorComparison):
    """The contact force of a candidate against that of another."""

    other: Annotated[str, Shown("against", file=True)]
    """The other candidate."""
    other_mean: Annotated[float, Shown("of that", digits=3)]
    """Mean norm of the contact force with the other."""


class BestCalibration(Row):
    """The candidates of a sensor with one offset, and whether one is best."""

    sensor: str
    """Sensor."""
    offset: Offset
    """Which offset the calibrations are evaluated with."""
    by_magnitude: str
    """Candidate with the smallest mean norm of the force; whether it is the best, `conclusion` says."""
    by_axis: tuple[str, ...]
    """Candidate with the smallest mean absolute value, per component."""
    conclusion: Literal["better", "no difference", "inconclusive"] | None
    """Of that by magnitude: better than every other, no different from those that it is not better than, or too little
    data to tell; null where there is no other."""
    comparisons: tuple[CalibrationComparison, ...]
    """The same against every other."""

    @property
    def best(self) -> str | None:
        """The candidate that is better than every other; none where the recording does not tell."""
        return self.by_magnitude if self.conclusion == "better" else None

    @property
    def sentence(self) -> str:
        """Who is best, if the recording tells, and on which axes the mean of another is smaller."""
        names = short_names([self.by_magnitude, *(row.other for row in self.comparisons), *self.by_axis])
        least = names[self.by_magnitude]
        words = [f"best is {least}" if self.best else "none is best"]
        words += [
            f"contact force of {least} {row.against(row.other_mean, names[row.other])}" for row in self.comparisons
        ]
        others = [
            f"{component} of {names[name]}"
            for component, name in zip(WRENCH_COMPONENTS, self.by_axis, strict=True)
            if name != self.by_magnitude
        ]
        words += [f"smaller in the mean: {', '.join(others)}"] if others else []
        return f"{self.sensor}, offset {self.offset}: {'; '.join(words)}"


def best_candidate(
    sensor: str,
    offset: Offset,
    candidates: Sequence[tuple[int, Offset]],
    pooled: ContactWrenches,
    recordings: Sequence[ContactWrenches],
) -> BestCalibration:
    """Find the candidate with the smallest contact force, and tell whether it is better than every other.

    Args:
        sensor: Name of the sensor.
        offset: The offset that they are evaluated with.
        candidates: Keys of their wrenches, each with a sample without a gap.
        pooled: Contact wrenches of all recordings.
        recordings: Those of every recording.

    Returns:
        The candidate, and the test of it against every other.
    """
    sizes = {key: _Size.of(pooled.wrenches[key]) for key in candidates}
    norms = {key: size.norm for key, size in sizes.items()}
    least = min(candidates, key=norms.__getitem__)
    names = {key: pooled.candidates[key[0]].name for key in candidates}
    comparisons = []
    for key in candidates:
        if key == least:
            continue
        ratio = compare_errors(_pairs(recordings, least, key)).force
        low, high = known_interval(ratio)
        comparisons.append(
            CalibrationComparison(
                calibration=names[least],
                offset=offset,
                quantity="force",
                unit="N",
                samples=sizes[least].samples,
                mean=norms[least],
                other=names[key],
                other_mean=norms[key],
                ratio=ratio.ratio,
                ratio_low=low,
                ratio_high=high,
                segments=ratio.segments,
                conclusion=ratio.conclusion,
            )
        )
    by_axis = np.argmin([size.by_axis for size in sizes.values()], axis=0)
    return BestCalibration(
        sensor=sensor,
        offset=offset,
        by_magnitude=names[least],
        by_axis=tuple(names[candidates[place]] for place in by_axis),
        conclusion=_conclusion(comparisons),
        comparisons=tuple(comparisons),
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Size:
    """How large contact wrenches are, over the samples without a gap."""

    samples: int
    norm: float
    """Mean norm of the force; N."""
    by_axis: FloatArray
    """Mean absolute value; shape (6,); N, N m."""

    @classmethod
    def of(cls, wrenches: FloatArray) -> Self:
        count, norm, by_axis = 0, 0.0, np.zeros(6)
        for (block,) in in_blocks(wrenches):
            whole = block[~np.isnan(block).any(axis=1)]
            count += len(whole)
            norm, by_axis = norm + np.linalg.norm(whole[:, :3], axis=1).sum(), by_axis + np.abs(whole).sum(axis=0)
        return cls(samples=count, norm=float(norm) / count, by_axis=by_axis / count)


def _pairs(
    recordings: Sequence[ContactWrenches], first: tuple[int, Offset], second: tuple[int, Offset]
) -> list[PairedErrors]:
    """Contact wrenches of two candidates where nothing touches: what should be zero is the error."""
    return [
        PairedErrors.of(one.wrenches[first], one.wrenches[second], np.broadcast_to(0.0, one.wrenches[first].shape))
        for one in recordings
        if first in one.wrenches
    ]


def _conclusion(
    comparisons: Sequence[CalibrationComparison],
) -> Literal["better", "no difference", "inconclusive"] | None:
    judgements = {row.conclusion for row in comparisons}
    if not judgements:
        return None
    if judgements == {"better"}:
        return "better"
    return "no difference" if judgements <= {"better", "no difference"} else "inconclusive"


WORTH = frozenset({"bias", "independent", "excitation_N", "excitation_Nm"})
"""Fields of a second table: the constant part, and what tells how much the errors are worth."""


class ContactForceErrors(RowOfSensor):
    """Contact wrench that a candidate reports where nothing touches, in the sensor's frame; per axis fx ... tz."""

    sub_model: str
    """Sub-model that nothing touches."""
    calibration: Annotated[str, Shown("calibration", file=True)]
    """The calibration file, or its prior: `prior`, and `prior of FILE` among several files."""
    offset: Annotated[Offset, Shown("offset")]
    """Offset from the first second of every validation interval, or that of the candidate."""
    offset_source: str
    """Where that offset comes from, in words."""
    prior: str | None
    """Candidate that is the prior of a calibration file; null for a prior, and where the file has none."""
    samples: Annotated[int, Shown("samples")]
    """Number of validation samples."""
    force_mean_N: Annotated[float, Shown("force", "N", digits=2, error="force_mean_half_width_95_N")]
    """Mean norm of the force."""
    force_mean_error_N: float | None
    """Standard error of that mean; none for one sample."""
    force_mean_half_width_95_N: float | None
    """Half-width of its 95 % interval; none where the samples do not determine it."""
    moment_mean_Nm: Annotated[float, Shown("moment", "N m", digits=3)]
    """Mean norm of the moment."""
    mean_absolute: Annotated[WrenchValues, ShownWrench(digits=3)]
    """Mean absolute value per component; N, N m."""
    bias: Annotated[WrenchValues, ShownWrench(digits=3)]
    """Mean per component, the constant part; N, N m."""
    independent: Annotated[float | None, Shown("independent", digits=0)]
    """How many independent samples they are worth, of the component worth the fewest; None where none changes."""
    excitation_N: Annotated[float, Shown("moved", "N", digits=1)]
    """Standard deviation of the force that the sensor should read, all three components together."""
    excitation_Nm: Annotated[float, Shown("moved", "N m", digits=2)]
    """The same of the moment."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactForces:
    """Contact wrenches of a sub-model that nothing touches, by all candidates of a sensor."""

    verdicts: tuple[ContactForceErrors, ...]
    """One per calibration and offset."""
    best: tuple[BestCalibration, ...]
    """One per offset."""
    left_out: tuple[str, ...]
    """What could not be evaluated of the intervals, in words."""


class RecordingContactForces(ContactForceErrors):
    """The same on one of several recordings."""

    recording: str
    """Name of the recording, unique in the campaign: that of the experiment, with the file where several have it."""


def contact_forces(
    runs: Runs,
    calibrations: Mapping[str, Calibration],
    choice: SubModelChoice = BEYOND_SENSOR,
) -> ContactForces:
    """Evaluate calibrations of a sensor by the contact wrench of a sub-model that nothing touches.

    Args:
        runs: The sensor in one recording, or in several, whose errors are pooled; the validation intervals are used.
        calibrations: Calibrations of that sensor by name; their priors are evaluated too, or that of the experiment
            where there is none.
        choice: Which sub-model nothing touches, and what the other sensors read.

    Returns:
        For every candidate the errors with its own offset and with one from each interval's first second, and the
        intervals that are not in them.

    Raises:
        ExperimentError: If there is nothing to evaluate, or an interval has no support.
    """
    campaign = Campaign.of(runs)
    recordings = choice.in_campaign(campaign, lambda free: contact_wrenches(free, calibrations))
    return contact_forces_of(campaign.sensor, recordings)


def contact_forces_of(sensor: ExperimentSensor, recordings: Mapping[str, ContactWrenches]) -> ContactForces:
    """Evaluate calibrations of a sensor by given contact wrenches.

    Args:
        sensor: The sensor.
        recordings: Contact wrenches by every candidate, by name of the recording, candidates in the same order.

    Returns:
        The same as `contact_forces`.

    Raises:
        ExperimentError: If there is nothing to evaluate.
    """
    contacts = pooled_contacts(recordings)
    verdicts = tuple(contact_force_rows(sensor, contacts))
    if not verdicts:
        raise ExperimentError(f"nothing can be evaluated: {'; '.join(contacts.left_out)}")
    return ContactForces(
        verdicts=verdicts,
        best=tuple(_best(sensor, contacts, list(recordings.values()))),
        left_out=contacts.left_out,
    )


def contact_force_blocks(
    verdicts: Sequence[ContactForceErrors],
    best: Sequence[BestCalibration],
    recordings: Sequence[RecordingContactForces] = (),
) -> Iterator[Table | str]:
    """Show contact forces of any number of sensors.

    Args:
        verdicts: The rows.
        best: Best candidates; said where there are several to choose from.
        recordings: The rows of every recording by itself, where there are several.

    Yields:
        A table per sensor, one of its recordings, and a sentence per sensor and offset.
    """
    for sensor in dict.fromkeys(row.sensor for row in verdicts):
        rows = [row for row in verdicts if row.sensor == sensor]
        yield without_vague(_table(rows))
        yield constant_contact_table(rows)
        apart = [row for row in recordings if row.sensor == sensor]
        if apart:
            names = [row.recording for row in apart]
            caption = f"{sensor} ({apart[0].serial}), each recording by itself"
            yield with_first_column(without_vague(table_of(apart, caption, leave_out=WORTH)), "recording", names)
            yield with_first_column(constant_contact_table(apart), "recording", names)
    if len({row.calibration for row in verdicts}) > 1:
        yield from (candidate.sentence for candidate in best)


def contact_force_rows(sensor: ExperimentSensor, contacts: ContactWrenches) -> Iterator[ContactForceErrors]:
    """Sum up contact wrenches.

    Args:
        sensor: The sensor.
        contacts: Contact wrenches by every candidate.

    Yields:
        A row per candidate and offset that has samples without gaps.
    """
    expected = contacts.expected[np.isfinite(contacts.expected).all(axis=1)]
    if not len(expected):
        return
    (moved_N, _), (moved_Nm, _) = validation_excitation(expected, ())
    for index, offset in _judgeable(contacts):
        wrenches = contacts.wrenches[index, offset]
        candidate, errors = contacts.candidates[index], errors_from_zero(wrenches, contacts.time_s[index, offset])
        yield ContactForceErrors(
            sensor=sensor.name,
            serial=sensor.serial,
            sub_model=contacts.sub_model,
            calibration=candidate.name,
            offset=candidate.offset(offset),
            offset_source=candidate.offset_source(offset),
            prior=candidate.prior,
            samples=errors.count,
            force_mean_N=errors.force_mean,
            force_mean_error_N=finite_or_none(errors.force_mean_error),
            force_mean_half_width_95_N=finite_or_none(errors.force_mean_half_width),
            moment_mean_Nm=errors.moment_mean,
            mean_absolute=errors.mean_absolute,
            bias=errors.bias,
            independent=fewest_independent(wrenches.T, contacts.time_s[index, offset]),
            excitation_N=moved_N,
            excitation_Nm=moved_Nm,
        )


def _judgeable(contacts: ContactWrenches) -> list[tuple[int, Offset]]:
    """Keys of the wrenches that have a sample without a gap."""
    return [
        key
        for key, wrenches in contacts.wrenches.items()
        if not all(np.isnan(block).any(axis=1).all() for (block,) in in_blocks(wrenches))
    ]


def _best(
    sensor: ExperimentSensor, contacts: ContactWrenches, recordings: Sequence[ContactWrenches]
) -> Iterator[BestCalibration]:
    """Best candidate with each offset, of one sensor."""
    groups: dict[Offset, list[tuple[int, Offset]]] = {}
    for index, offset in _judgeable(contacts):
        groups.setdefault(contacts.candidates[index].offset(offset), []).append((index, offset))
    for offset, candidates in groups.items():
        yield best_candidate(sensor.name, offset, candidates, contacts, recordings)


def _table(rows: Sequence[ContactForceErrors]) -> Table:
    row = rows[0]
    alike = len({row.samples for row in rows}) == 1
    count = f", {row.samples} samples" if alike else ""
    return table_of(
        rows,
        f"{row.sensor} ({row.serial}): contact wrench of the free sub-model {row.sub_model}{count}; "
        "force: mean norm ± half its 95 % interval; per axis: mean absolute value",
        leave_out={"samples", *WORTH} if alike else WORTH,
    )


def constant_contact_table(rows: Sequence[ContactForceErrors]) -> Table:
    """Put the constant part of contact wrenches into a table, with what tells how much the wrenches are worth.

    Returns:
        A line per row.
    """
    return table_of(
        rows,
        "mean contact wrench, the constant part; moved: standard deviation of what the sensor should read",
        leave_out={"samples", "force_mean_N", "moment_mean_Nm", "mean_absolute"},
    )
