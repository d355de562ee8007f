# SPDX-License-Identifier: BSD-3-Clause
"""Reduce recordings of a sensor to the moments that a calibration needs, long ones segment by segment."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any, Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError, RecordingError
from forcetorque.base.rows_on_disk import RowsOnDisk
from forcetorque.calibration.contact_windows import Disagreeing, agreeing_samples
from forcetorque.calibration.interval_and_mount_doubts import mount_doubts
from forcetorque.calibration.model_error_derivatives import model_columns
from forcetorque.experiment.calibration.expected_sensor_errors import Assumptions
from forcetorque.experiment.calibration.moment_blocks import BLOCK_S, in_blocks
from forcetorque.experiment.calibration.moments import DataSet, Moments, pooled
from forcetorque.experiment.calibration.posterior import LoadError
from forcetorque.experiment.calibration.provenance import Content
from forcetorque.experiment.calibration.robot_model_error import ErrorTerm
from forcetorque.experiment.calibration.sensor_model import LinearVariable
from forcetorque.experiment.calibration.stored_moments import IntervalMoments, RecordingMoments, VariableDescription
from forcetorque.experiment.campaign import Campaign
from forcetorque.experiment.campaign_intervals import CampaignInterval, CampaignRecording
from forcetorque.experiment.long_recording import share_of_segments
from forcetorque.experiment.raw_counts import full_scale_of, prior_size_of
from forcetorque.experiment.segmented_samples import IntervalParts
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.inspection.plausibility.gate import examine
from forcetorque.inspection.plausibility.gravity_sense_gain_and_unit_checks import require_moving_load
from forcetorque.payload.identification.load_estimates import LoadSolution
from forcetorque.payload.identification.parameter_vector import OF_LOAD, Kind, places
from forcetorque.payload.load_warnings import reference_doubts
from forcetorque.recording.frozen_and_saturated_samples import UnusableCounts
from forcetorque.recording.recording import Interval, Use

_ROUNDING = 1e-12
"""Share of the largest variance below which a combination of loads is known exactly."""


def load_error_of(solution: LoadSolution) -> LoadError | None:
    """Tell by how much errors of estimated loads move the response of a sensor and its offsets.

    Args:
        solution: Loads that were estimated with a matrix that is known in part.

    Returns:
        The errors; None where no load was estimated, or the matrix was taken as exact.
    """
    listed = solution.guess.parameters
    loads = [k for k, one in enumerate(listed) if one.kind in OF_LOAD]
    loads = [k for k in loads if np.isfinite(solution.covariance[k, k])]
    if not loads or not places(listed, Kind.MATRIX):
        return None
    own = solution.covariance[np.ix_(loads, loads)]
    size = np.sqrt(np.diag(own))
    size[size == 0.0] = 1.0
    variance, directions = np.linalg.eigh(own / np.outer(size, size))
    uncertain = variance > _ROUNDING * variance.max(initial=0.0)
    # S^-1/2, in the directions in which loads are uncertain
    root = directions[:, uncertain] / np.sqrt(variance[uncertain]) / size[:, None]
    sessions = [session.session for session in solution.sessions]
    factor = np.zeros((6, 6 + len(sessions), root.shape[1]))
    for row in range(6):
        factor[row, :6] = solution.covariance[np.ix_(places(listed, Kind.MATRIX, row), loads)] @ root
        for number in range(len(sessions)):
            biases = places(listed, Kind.BIAS, number)
            if biases and np.isfinite(solution.covariance[biases[row], biases[row]]):
                factor[row, 6 + number] = solution.covariance[biases[row], loads] @ root
    return LoadError(sessions=tuple(sessions), factor=factor)


def agreeing_moments(
    run: SensorRun,
    intervals: Sequence[CampaignInterval],
    *,
    variables: Sequence[LinearVariable],
    block_s: float | None = None,
    around: Sequence[DataSet] | None = None,
) -> tuple[list[IntervalMoments], list[str]]:
    """Reduce intervals of a recording, without the samples that disagree with all others.

    With a prior matrix they come with what errors of the robot model do to the expected wrenches.

    Args:
        run: The sensor in the recording.
        intervals: Samples of its calibration intervals.
        variables: Linear variables that are fitted.
        block_s: As of `recording_moments`.
        around: The same samples with those beside each interval, of parts that something may touch across their ends;
            None for the intervals alone.

    Returns:
        What is kept of the intervals, and a sentence per span that was left out.
    """
    recording, data_sets = CampaignRecording.of(run), [interval.data_set for interval in intervals]
    compared = data_sets if around is None else around
    of_compared, spans = [np.ones(len(data.raw), dtype=bool) for data in compared], tuple[Disagreeing, ...]()
    if "disagreeing" not in run.experiment.processing.keep:
        of_compared, spans = agreeing_samples(
            compared,
            recording.sensor.prior,
            assumptions_of(recording),
            variables=variables,
            drift=recording.options.drift,
        )
    if around is None:
        agree = of_compared
    else:
        pairs = zip(data_sets, around, of_compared, strict=True)
        agree = [np.isin(data.time_s, wider.time_s[marks]) for data, wider, marks in pairs]
        spans = tuple(_within(data_sets, spans))
    kept: list[IntervalMoments] = []
    for interval, data, marks in zip(intervals, data_sets, agree, strict=True):
        if marks.any():
            moments = interval.moments(marks)
            if recording.sensor.prior is not None:
                moments = moments.with_model(*model_columns(run, interval.part.interval, data.kept(marks)))
            kept += [moments] if block_s is None else in_blocks(moments, data.kept(marks), block_s)
    start_s = recording.start_ns * 1e-9
    return kept, [
        f"interval {span.label!r}: {span.start_s - start_s:.2f} to {span.end_s - start_s:.2f} s is left out: the "
        f"readings disagree there with all others, by up to {span.force_N:.2g} N and {span.moment_Nm:.2g} N m, as if "
        'something touched the distal links; `inspect` shows contacts; keep = ["disagreeing"] in [processing] fits '
        "them too"
        for span in spans
    ]


def _within(data_sets: Sequence[DataSet], spans: Sequence[Disagreeing]) -> Iterator[Disagreeing]:
    """Spans cut at the first and last sample of their intervals."""
    times = {data.label: data.time_s for data in data_sets}
    for span in spans:
        first_s, last_s = (float(times[span.label][place]) for place in (0, -1))
        if span.start_s <= last_s and span.end_s >= first_s:
            yield replace(span, start_s=max(span.start_s, first_s), end_s=min(span.end_s, last_s))


def assumptions_of(recording: CampaignRecording) -> Assumptions:
    """Give what the options of a recording, and the full scale of its sensor, let a fit assume.

    Args:
        recording: The recording of one sensor.

    Returns:
        The assumptions.
    """
    options = recording.options
    full_scale = full_scale_of(recording.sensor, options.accuracy, channels=recording.channels)
    return Assumptions(
        full_scale=full_scale,
        load_full_scale=None if recording.sensor.measured.all() else recording.sensor.full_scale,
        accuracy=options.accuracy,
        repeatability=options.repeatability,
        mount=options.tolerance.mount_of(recording.sensor.name),
        prior_size=prior_size_of(recording.sensor, full_scale),
    )


def moments_of(
    recording: CampaignRecording,
    intervals: Sequence[IntervalMoments],
    *,
    variables: Sequence[LinearVariable],
    doubts: Sequence[str],
) -> RecordingMoments:
    """Put what is kept of intervals beside what the recording says about the sensor.

    Args:
        recording: The recording.
        intervals: What is kept of its intervals.
        variables: Linear variables that are fitted.
        doubts: What makes any fit of them doubtful.

    Returns:
        The moments of the recording.

    Raises:
        ExperimentError: If the full scale of the sensor is not known.
    """
    sensor, options, assumed = recording.sensor, recording.options, assumptions_of(recording)
    return RecordingMoments(
        sensor=recording.identity,
        experiment=recording.experiment,
        prior=sensor.prior,
        prior_source=sensor.prior_source,
        full_scale=assumed.full_scale,
        load_full_scale=assumed.load_full_scale,
        accuracy=assumed.accuracy,
        repeatability=assumed.repeatability,
        mount_rotation_rad=assumed.mount.rotation_rad,
        mount_shift_m=assumed.mount.shift_m,
        prior_size=assumed.prior_size,
        drift=options.drift,
        nonlinear=options.nonlinear,
        variables=tuple(map(VariableDescription.of, variables)),
        intervals=tuple(intervals),
        warnings=tuple(doubts),
        added=recording.added,
        inputs_sha256=dict(recording.inputs_sha256),
    )


_BESIDE_NS: Final = 2 * 10**9
"""Samples beside a part of an interval by which it is told which agree: two windows; ns."""


class SegmentedMoments:
    """Moments of a sensor in a recording of which segments are reduced one after the other."""

    def __init__(self, run: SensorRun, *, block_s: float = BLOCK_S) -> None:
        """Begin.

        Args:
            run: The sensor in the whole recording, of which no samples are computed.
            block_s: Longest block of moments; s.
        """
        self._run, self._block_s = run, block_s
        without = run.experiment.fit_options.with_variables is False
        self._variables: list[LinearVariable] = [] if without else [one.linear for one in run.sensor.variables]
        self._parts = IntervalParts(run, Use.CALIBRATION)
        self._moments: dict[str, list[tuple[IntervalMoments, int]]] = {}
        self._models = RowsOnDisk()  # derivatives by the robot model are most of what is kept
        self._pooled: list[Moments] = []
        self._doubts: list[dict[str, str]] = []
        self._said: list[str] = []

    def add(self, run: SensorRun) -> None:
        """Reduce the next segment.

        Args:
            run: The sensor in the segment.
        """
        parts = list(self._parts.of(run, [variable.name for variable in self._variables]))
        if not parts:
            return
        campaign = Campaign.of(run)
        intervals = campaign.names.intervals(CampaignRecording.of(run), parts)
        data = [interval.data_set for interval in intervals]
        self._pooled.append(pooled(Moments.of(one.raw, one.reference, one.variables) for one in data))
        if _moves(self._pooled[-1]):
            doubts = examine(data, run.sensor.prior, run.sensor.full_scale)
            turned = {f"mount {k}": text for k, text in enumerate(mount_doubts(campaign, intervals))}
            self._doubts.append({doubt.kind: doubt.message for doubt in doubts} | turned)
        around = [self._with_surroundings(run, interval) for interval in intervals]
        kept, left_out = agreeing_moments(
            run, intervals, variables=self._variables, block_s=self._block_s, around=around
        )
        self._said += [*reference_doubts(run), *left_out]
        for block in kept:
            own = self._moments.setdefault(block.interval.label, [])
            own.append((block.model_copy(update={"model": None}), len(self._models)))
            if block.model is not None:
                self._models.append(block.model.ravel())

    def _with_surroundings(self, run: SensorRun, interval: CampaignInterval) -> DataSet:
        """Samples of a part of an interval, and those of the same interval beside the part."""
        part, data = interval.part.interval, interval.data_set
        (whole,) = (one for one in self._run.intervals(Use.CALIBRATION) if one.label == part.label)
        starts = max(whole.start_ns, part.start_ns - _BESIDE_NS), part.start_ns, part.end_ns
        ends = part.start_ns, part.end_ns, min(whole.end_ns, part.end_ns + _BESIDE_NS)
        pieces = []
        for start_ns, end_ns in zip(starts, ends, strict=True):
            if (start_ns, end_ns) == (part.start_ns, part.end_ns):
                pieces.append(data)
            elif start_ns < end_ns:
                beside = replace(part, start_ns=start_ns, end_ns=end_ns)
                with suppress(RecordingError):  # no sample beside it
                    names = [variable.name for variable in self._variables]
                    pieces.append(run.interval_samples(beside, variables=names).data_set)
        return _concatenated(data, pieces)

    def moments(self) -> RecordingMoments | None:
        """Put together what a calibration needs.

        Returns:
            The moments of the recording; None without a calibration interval.

        Raises:
            RecordingError: If an interval has no sample that can be used.
        """
        run = self._run
        if not run.has(Use.CALIBRATION):
            return None
        self._parts.require()
        if not self._moments:
            raise RecordingError(
                f"sensor {run.sensor.name!r}: expected samples that agree in a calibration interval, got none"
            )
        require_moving_load(pooled(self._pooled))
        recording, models = CampaignRecording.of(run), self._models.mapped()
        intervals = {interval.label: interval for interval in run.experiment.recording.intervals}
        blocks: list[IntervalMoments] = []
        for label, interval in intervals.items():
            own = [_with_model(block, models[at:]) for block, at in self._moments.get(label, ())]
            blocks += _of_interval(own, interval, self._parts.lost.get(label, ()))
        said = [*_joined_doubts(self._doubts), *dict.fromkeys(self._said)]
        return moments_of(recording, _with_all_terms(blocks), variables=self._variables, doubts=said)


def _concatenated(data: DataSet, pieces: Sequence[DataSet]) -> DataSet:
    """Data with the samples of pieces one after the other."""
    columns: dict[str, Any] = {
        name: np.concatenate([getattr(piece, name) for piece in pieces])
        for name in ("raw", "reference", "variables", "time_s", "flattening")
        if getattr(data, name) is not None
    }
    return replace(data, **columns)


def _moves(moments: Moments) -> bool:
    """Whether the load moves in a segment; one in which it does not is no fault of a long recording."""
    try:
        require_moving_load(moments)
    except FitError:
        return False
    return True


def _joined_doubts(doubts: Sequence[Mapping[str, str]]) -> Iterator[str]:
    for kind in dict.fromkeys(kind for own in doubts for kind in own):
        texts = [own[kind] for own in doubts if kind in own]
        yield f"{texts[0]}{share_of_segments(len(texts), len(doubts))}"


def _with_model(block: IntervalMoments, values: FloatArray) -> IntervalMoments:
    """A block with its derivatives, the first of some values."""
    if not block.terms:
        return block
    shape = (len(block.time_s), 6 * len(block.terms))
    return block.model_copy(update={"model": values[: shape[0] * shape[1]].reshape(shape)})


def _of_interval(
    blocks: Sequence[IntervalMoments], interval: Interval, lost: Sequence[tuple[int, UnusableCounts]]
) -> Iterator[IntervalMoments]:
    """Blocks of an interval, with the ends of it all; the first has what was lost of segments without a sample too."""
    contents = [block.interval.content for block in blocks if block.interval.content is not None]
    ends = {"start_ns": interval.start_ns, "end_ns": interval.end_ns, "content": Content.joined(contents)}
    for number, block in enumerate(blocks):
        own = () if number else lost
        update = {
            "interval": block.interval.model_copy(update=ends),
            "dropped": block.dropped + sum(dropped for dropped, _ in own),
            "unusable": UnusableCounts.total([block.unusable, *(unusable for _, unusable in own)]),
        }
        yield block.model_copy(update=update)


def _with_all_terms(blocks: Sequence[IntervalMoments]) -> list[IntervalMoments]:
    """Blocks with the same numbers of the model: what moved nothing in a segment has derivatives of zero."""
    terms: dict[str, ErrorTerm] = {term.name: term for block in blocks for term in block.terms}
    if all(len(block.terms) == len(terms) for block in blocks):
        return list(blocks)
    places = {name: k for k, name in enumerate(terms)}
    completed = []
    for block in blocks:
        columns = np.zeros((len(block.time_s), 6, len(terms)))
        if block.model is not None:
            own = [places[term.name] for term in block.terms]
            columns[:, :, own] = block.model.reshape(len(columns), 6, len(own))
        completed.append(block.with_model(tuple(terms.values()), columns))
    return completed
