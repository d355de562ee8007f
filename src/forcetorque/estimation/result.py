# SPDX-License-Identifier: BSD-3-Clause
"""Summaries of estimates over the intervals of an experiment, with contacts on skin; the file of all samples."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import EstimationError
from forcetorque.base.noise.means import sample_statistics
from forcetorque.estimation.estimate import IntervalEstimates
from forcetorque.estimation.samples_file import write_estimates
from forcetorque.estimation.torque.experiment_fusion import (
    IntervalFusion,
    TorqueFusion,
    TorqueHistory,
    summarise_fusion,
)
from forcetorque.estimation.torque.motor import Friction
from forcetorque.experiment.additions import with_recording_notes
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.seen_and_outside_samples import SamplesOutside, outside_row, sentences
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.inspection.diagnosis import reversed_sensors
from forcetorque.recording.alignment import seconds_since
from forcetorque.recording.recording import Use
from forcetorque.results.number_text import finite_or_none
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Row, Shown, Table, optional_table

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class SkinContactSummary(Row):
    """One contact on skin over one interval."""

    interval: Annotated[str, Shown("interval")]
    """Label of the interval."""
    contact: Annotated[str, Shown("contact on skin")]
    """Patch and place of the contact; a place is taken again when a contact was let go."""
    identities: tuple[int, ...]
    """Numbers of the contacts that had it, as `forcetorque skin wrench` has them."""
    samples: Annotated[int, Shown("samples")]
    """Number of samples in which it touches."""
    push_mean_N: Annotated[float, Shown("push", "N", digits=2)]
    """Mean norm of the force that skin feels."""
    force_mean_N: Annotated[float | None, Shown("force", "N", digits=2)]
    """Mean norm of the force with what sensors show of its tangential part; none where that is not determined."""
    force_sd_N: Annotated[float | None, Shown("sd", "N", digits=2)]
    """Root mean square of the standard deviation of that force, all components together."""
    beyond_range: Annotated[int, Shown("beyond range")]
    """Samples in which a taxel reads more than it was calibrated for."""


def skin_rows(span: IntervalEstimates) -> Iterator[SkinContactSummary]:
    """Sum up contacts on skin.

    Args:
        span: Estimates over an interval.

    Yields:
        A row for each contact that touches in it.
    """
    for source in span.skin:
        there = np.isfinite(source.centre).all(axis=1)
        if span.uncertain is None or not there.any():
            continue
        name = source.contact.name
        force, sd = (values[there][:, :3] for values in (span.uncertain.contact(name), span.uncertain.contact_sd(name)))
        determined = np.isfinite(force).all(axis=1)
        yield SkinContactSummary(
            interval=span.interval.label,
            contact=name,
            identities=tuple(np.unique(source.identity[there]).tolist()),
            samples=int(there.sum()),
            push_mean_N=float(np.linalg.norm(source.wrench[there, :3], axis=1).mean()),
            force_mean_N=float(np.linalg.norm(force[determined], axis=1).mean()) if determined.any() else None,
            force_sd_N=float(np.sqrt((sd[determined] ** 2).sum(axis=1).mean())) if determined.any() else None,
            beyond_range=int(source.beyond_range[there].sum()),
        )


def skin_warnings(span: IntervalEstimates, exact: tuple[str, ...], resting: tuple[str, ...]) -> Iterator[str]:
    """Give warnings about estimates with skin.

    Args:
        span: Estimates over an interval.
        exact: Sensors whose errors no calibration predicts.
        resting: Sensors whose offset is that of the calibration intervals, in which nothing is to touch the robot.

    Yields:
        Sentences.
    """
    if span.uncertain is None:
        return
    label = span.interval.label
    for hidden in span.uncertain.undetermined:
        yield f"{label}: {hidden.sentence}; those cells are empty"
    for source in span.skin:
        beyond = int(source.beyond_range.sum())
        if beyond:
            yield (
                f"{label}: {source.contact.name!r} presses a taxel beyond what it was calibrated for in {beyond} of "
                f"{len(source.beyond_range)} samples: its force is extrapolated there"
            )
    touched = int(np.count_nonzero(np.any([source.identity > 0 for source in span.skin], axis=0)))
    if resting and touched and span.interval.use is Use.CALIBRATION:
        yield (
            f"{label}: skin is touched in {touched} of {len(span.stamp_ns)} samples of a calibration interval, and the "
            f"offset of {', '.join(resting)} is taken there as if nothing touched; leave these samples out, or read by "
            "a calibration (-c)"
        )
    if exact:
        yield f"{label}: readings of {', '.join(exact)} count as exact, as no calibration predicts their errors"


class ContactSummary(Row):
    """One contact over one interval."""

    interval: Annotated[str, Shown("interval")]
    """Label of the interval."""
    contact: Annotated[str, Shown("contact")]
    """Name of the contact."""
    samples: Annotated[int, Shown("samples")]
    """Number of samples with an estimate."""
    force_mean_N: Annotated[float | None, Shown("force", "N", digits=2, error="force_half_width_95_N")]
    """Mean norm of the force."""
    force_standard_error_N: float | None
    """Standard error of that mean; none where the norm is no stationary noise (`noise.is_stationary`)."""
    force_half_width_95_N: float | None
    """Half-width of its 95 % interval; none likewise."""
    force_deviation_N: Annotated[float | None, Shown("deviation", "N", digits=2)]
    """Standard deviation of the norm from sample to sample; none for one sample."""
    force_smallest_N: Annotated[float | None, Shown("smallest", "N", digits=2)]
    """Smallest norm of the force."""
    force_largest_N: Annotated[float | None, Shown("largest", "N", digits=2)]
    """Largest norm of the force."""
    moment_mean_Nm: Annotated[float | None, Shown("moment", "N m", digits=3)]
    """Mean norm of the moment."""


class SubModelSummary(Row):
    """The equation of one sub-model over one interval."""

    interval: Annotated[str, Shown("interval")]
    """Label of the interval."""
    sub_model: Annotated[str, Shown("sub-model")]
    """Sensor at its base, or the support frame."""
    rank: Annotated[int, Shown("rank")]
    """Smallest rank over the samples."""
    condition_largest: Annotated[float | None, Shown("condition", digits=1)]
    """Largest condition over the samples."""
    residual_force_mean_N: Annotated[float | None, Shown("residual", "N", digits=2)]
    """Mean norm of the force that its contacts leave unexplained."""
    residual_moment_mean_Nm: Annotated[float | None, Shown("residual", "N m", digits=3)]
    """Mean norm of the moment that they leave unexplained."""
    ambiguous: tuple[tuple[str, ...], ...]
    """Groups of unknowns that cannot be determined apart."""


class EstimatedRecording(Row):
    """The estimates of one of several recordings."""

    experiment: str
    """Name of the experiment."""
    file: str | None
    """File with every sample, where one was written."""
    samples: int
    """Number of samples, which are its rows."""
    wrench_sources: dict[str, str]
    """By sensor, how its reading became a wrench."""
    contacts: tuple[ContactSummary, ...]
    """One per interval and contact."""
    sub_models: tuple[SubModelSummary, ...]
    """One per interval and sub-model."""
    left_out: tuple[str, ...]
    """What the log does not allow to estimate."""
    validity: tuple[SamplesOutside, ...] = ()
    """One per sensor that a calibration reads: how far its readings lie outside what was fitted."""
    fusion: TorqueFusion | None = None
    """Joint torques of several sources; None where they were not asked for."""
    skin: tuple[SkinContactSummary, ...] = ()
    """One per interval and contact on skin."""
    figure_file: str | None = Field(default=None, alias="figure")
    """File of the figure of joint torques; null where none was written."""

    def tables(self) -> Iterator[Table | str]:
        """Give contacts, contacts on skin, sub-models and fused torques.

        Yields:
            Tables and sentences.
        """
        yield from optional_table(self.contacts, self.experiment)
        yield from optional_table(self.skin, f"{self.experiment}: contacts on skin")
        yield from optional_table(self.sub_models, "")
        for row in self.sub_models:
            for group in row.ambiguous:
                yield f"{row.sub_model}, {row.interval}: not separable: {', '.join(group)}"
        if self.fusion is not None:
            yield from self.fusion.blocks()


class EstimateSummary(EstimatedRecording, DrawnResult):
    """Contacts of the robot over the intervals of an experiment, and how well its equations determine them.

    Of several recordings `experiment` holds all names, apart by semicolons, and `rows` all samples; what else an
    `EstimatedRecording` has is in `recordings`.
    """

    of_several: ClassVar[tuple[str, ...]] = ("recordings",)

    interval_uses = ()

    schema_name: Literal["forcetorque/estimate/2"] = Field(default="forcetorque/estimate/2", alias="schema")
    """Form of the result."""
    answered_by: ClassVar[str | None] = "forcetorque.estimation.command:estimate_answers"

    recordings: tuple[EstimatedRecording, ...] = ()
    """The estimates of each of several recordings; none where there is one recording."""
    intervals: tuple[IntervalEstimates, ...] = Field(default=(), exclude=True, repr=False)
    """Every sample, in a script; none where they are written to a file."""
    torques: TorqueHistory | None = Field(default=None, exclude=True, repr=False)
    """What the figure is made of; None for several recordings, and where samples are only written to a file."""

    def figure(self) -> Figure:
        """Draw joint torques over time, by source where they were fused.

        Returns:
            The figure of `torque_figure`.

        Raises:
            EstimationError: If it does not hold the samples of one recording.
            ExperimentError: If no torque of a rotary joint is known.
        """
        from forcetorque.estimation.figures import torque_figure

        if self.torques is None:
            raise EstimationError(
                f"{self.experiment}: expected estimates of one recording with their samples to draw, got none; "
                "`experiment.estimate()` has them"
            )
        picture = self.torques.picture()
        return torque_figure(picture.seconds, picture.joints, picture.torques, deviations=picture.deviations)

    def blocks(self) -> Iterator[Table | str]:
        """Give a table of the contacts and one of the sub-models, of one recording after the other.

        Yields:
            Tables and sentences.
        """
        for recording in self.recordings or (self,):
            yield from recording.tables()
        yield (
            "force and moment: mean norms of what the environment does to the robot, in the contact frame, "
            "± half a 95 % interval of the mean where the norm is stationary noise; deviation: of a sample"
        )
        for recording in self.recordings or (self,):
            if recording.file is not None:
                yield f"{recording.samples} rows written to {recording.file}"
            if recording is not self and recording.figure_file is not None:  # its own is named below
                yield f"drawn to {recording.figure_file}"

    def records(self) -> list[dict[str, object]]:
        """Give the contacts as lines.

        Returns:
            A line per interval and contact; of several recordings with the name of the experiment and the file.
        """
        several = [
            {"experiment": recording.experiment, "file": recording.file, **row.flat()}
            for recording in self.recordings
            for row in recording.contacts
        ]
        return several or [row.flat() for row in self.contacts]

    def columns(self) -> list[str]:
        """Name the columns of the lines.

        Returns:
            The same where nothing could be estimated.
        """
        return [*(("experiment", "file") if self.recordings else ()), *ContactSummary.model_fields]


@with_recording_notes
def estimates_of_recordings(summaries: Mapping[str, EstimateSummary]) -> EstimateSummary:
    """Put what several recordings amount to together; nothing is pooled, as every one has samples of its own.

    Args:
        summaries: Summaries by name of the experiment file.

    Returns:
        One that holds them all.
    """
    return EstimateSummary(
        experiment="; ".join(summary.experiment for summary in summaries.values()),
        file=None,
        samples=sum(summary.samples for summary in summaries.values()),
        wrench_sources={},
        contacts=(),
        sub_models=(),
        left_out=(),
        recordings=tuple(summaries.values()),
        warnings=tuple(f"{name}: {words}" for name, summary in summaries.items() for words in summary.warnings),
    )


@with_recording_notes
def summarise_estimates(
    experiment: Experiment,
    corrections: Mapping[str, Correction],
    spans: Sequence[IntervalEstimates],
    *,
    file: Path | None = None,
    fusions: Sequence[IntervalFusion] = (),
    frictions: tuple[Friction, ...] = (),
) -> EstimateSummary:
    """Summarise estimates, and write every sample of them to a file.

    Args:
        experiment: The experiment.
        corrections: How its sensors were read.
        spans: Its estimates, as `estimate_experiment` gives them.
        file: File for every sample, .parquet or .csv; none if left out.
        fusions: Fused torques over the same intervals, as `fuse_experiment` gives them; none if they are not wanted.
        frictions: Friction of the motors, likewise.

    Returns:
        Mean norms of contacts and residuals.

    Raises:
        FormatError: If the name of the file ends otherwise.
    """
    if file is not None:
        write_estimates(file, experiment, spans, fusions)
    fusion = summarise_fusion(experiment, list(fusions), frictions) if fusions else None
    left_out = tuple(dict.fromkeys(sentence for span in spans for sentence in span.left_out))
    validity = tuple(_outside(corrections, spans))
    return EstimateSummary(
        experiment=experiment.name,
        file=None if file is None else str(file),
        samples=sum(len(span.stamp_ns) for span in spans),
        wrench_sources={sensor: correction.source for sensor, correction in corrections.items()},
        contacts=tuple(row for span in spans for row in _contacts(span)),
        sub_models=tuple(row for span in spans for row in _parts(span)),
        left_out=left_out,
        validity=validity,
        fusion=fusion,
        skin=tuple(row for span in spans for row in skin_rows(span)),
        warnings=(
            *sentences(validity),
            *reversed_sensors(experiment, corrections),
            *_warnings(corrections, spans),
            *(f"left out: {sentence}" for sentence in left_out),
            *(() if fusion is None else fusion.warnings()),
        ),
    )


def _outside(corrections: Mapping[str, Correction], spans: Sequence[IntervalEstimates]) -> Iterator[SamplesOutside]:
    for sensor, correction in corrections.items():
        if correction.calibration is not None:
            yield outside_row(
                correction.matrix_source, correction.calibration, [span.applied[sensor] for span in spans]
            )


def _warnings(corrections: Mapping[str, Correction], spans: Sequence[IntervalEstimates]) -> Iterator[str]:
    exact = tuple(
        name for name, one in corrections.items() if one.calibration is None or one.calibration.posterior is None
    )
    resting = tuple(name for name, one in corrections.items() if one.calibration is None and one.removes_offset)
    for span in spans:
        yield from skin_warnings(span, exact, resting)
    for sensor, one in corrections.items():
        if not one.removes_offset:
            yield (
                f"{sensor}: no offset removed, so that its forces include the offset of the sensor; see --offset, "
                "from Python offset"
            )


def _contacts(span: IntervalEstimates) -> Iterator[ContactSummary]:
    for name in span.estimates.layout.contacts:
        wrench = span.estimates.contact(name)
        norms = _norms(wrench)
        time_s = seconds_since(span.stamp_ns, int(span.stamp_ns[0]))[np.isfinite(wrench).all(axis=1)]
        force = None if norms is None else sample_statistics(norms[:, :1], time_s)
        yield ContactSummary(
            interval=span.interval.label,
            contact=name,
            samples=0 if norms is None else len(norms),
            force_mean_N=None if force is None else float(force.mean[0]),
            force_standard_error_N=None if force is None else finite_or_none(float(force.standard_error[0])),
            force_half_width_95_N=None if force is None else finite_or_none(float(force.half_width[0])),
            force_deviation_N=None if force is None else finite_or_none(float(force.deviation[0])),
            force_smallest_N=None if force is None else float(force.smallest[0]),
            force_largest_N=None if force is None else float(force.largest[0]),
            moment_mean_Nm=None if norms is None else float(norms[:, 1].mean()),
        )


def _parts(span: IntervalEstimates) -> Iterator[SubModelSummary]:
    estimates = span.estimates
    for k, name in enumerate(estimates.layout.parts):
        whole = np.isfinite(estimates.residual[:, k]).all(axis=1)
        norms = _norms(estimates.residual[:, k])
        mean = None if norms is None else norms.mean(axis=0)
        condition = estimates.condition[:, k][np.isfinite(estimates.condition[:, k])]
        yield SubModelSummary(
            interval=span.interval.label,
            sub_model=name,
            rank=int(estimates.rank[whole, k].min()) if whole.any() else 0,
            condition_largest=float(condition.max()) if len(condition) else None,
            residual_force_mean_N=None if mean is None else float(mean[0]),
            residual_moment_mean_Nm=None if mean is None else float(mean[1]),
            ambiguous=span.ambiguous.get(name, ()),
        )


def _norms(wrench: FloatArray) -> FloatArray | None:
    """Norms of force and moment in samples without a gap; shape (n, 2); N, N m; None if every sample has one."""
    whole = wrench[np.isfinite(wrench).all(axis=1)]
    return np.linalg.norm(whole.reshape(-1, 2, 3), axis=2) if len(whole) else None
