# SPDX-License-Identifier: BSD-3-Clause
"""Moments of a sensor in a long recording, segment by segment, so that the recording does not fill the memory."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any, Final

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError, RecordingError
from forcetorque.base.rows_on_disk import RowsOnDisk
from forcetorque.calibration.doubts import mount_doubts
from forcetorque.calibration.moments import agreeing_moments, moments_of
from forcetorque.experiment.calibration.model_error import ErrorTerm
from forcetorque.experiment.calibration.moment_blocks import BLOCK_S
from forcetorque.experiment.calibration.moments import DataSet, Moments, pooled
from forcetorque.experiment.calibration.provenance import Content
from forcetorque.experiment.calibration.sensor_model import LinearVariable
from forcetorque.experiment.calibration.stored_moments import IntervalMoments, RecordingMoments
from forcetorque.experiment.campaign import Campaign
from forcetorque.experiment.campaign_intervals import CampaignInterval, CampaignRecording
from forcetorque.experiment.long_recording import IntervalParts, share_of_segments
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.sensor_samples import IntervalSamples
from forcetorque.inspection.plausibility.checks import examine
from forcetorque.inspection.plausibility.reversed_sense_and_gain import require_moving_load
from forcetorque.payload.load_warnings import reference_doubts
from forcetorque.recording.frozen_and_saturated_samples import UnusableCounts
from forcetorque.recording.recording import Interval, Use

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
        if parts:
            self._add_parts(run, parts)

    def _add_parts(self, run: SensorRun, parts: Sequence[IntervalSamples]) -> None:
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
            blocks += _of_interval(_with_lost(own, self._parts.lost.get(label, ())), interval)
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


def _with_lost(blocks: Sequence[IntervalMoments], lost: Sequence[tuple[int, UnusableCounts]]) -> list[IntervalMoments]:
    """Blocks of which the first counts the samples of parts that have no block."""
    if not blocks or not lost:
        return list(blocks)
    first = blocks[0]
    counts = {
        "dropped": first.dropped + sum(dropped for dropped, _ in lost),
        "unusable": UnusableCounts.total([first.unusable, *(unusable for _, unusable in lost)]),
    }
    return [first.model_copy(update=counts), *blocks[1:]]


def _of_interval(blocks: Sequence[IntervalMoments], interval: Interval) -> Iterator[IntervalMoments]:
    """Blocks of parts of an interval as those of the interval."""
    contents = [block.interval.content for block in blocks if block.interval.content is not None]
    content = Content.joined(contents)
    for block in blocks:
        update = {"start_ns": interval.start_ns, "end_ns": interval.end_ns, "content": content}
        yield block.model_copy(update={"interval": block.interval.model_copy(update=update)})


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
