# SPDX-License-Identifier: BSD-3-Clause
"""Samples of the validation intervals of a long recording, segment by segment, in temporary files."""

from __future__ import annotations

import numpy as np

from forcetorque.base.rows_on_disk import RowsOnDisk
from forcetorque.experiment.calibration.provenance import Content
from forcetorque.experiment.long_recording import IntervalParts
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.sensor_samples import logged_content
from forcetorque.fleet.evaluation_blocks import EvaluatedSamples, evaluated_variables
from forcetorque.recording.recording import Use


class SegmentedEvaluation:
    """Samples of the validation intervals of a sensor, in two temporary files however many intervals there are."""

    def __init__(self, run: SensorRun) -> None:
        """Begin.

        Args:
            run: The sensor in the whole recording, of which no samples are computed.
        """
        self._run = run
        self._names = evaluated_variables(run)
        self._of_intervals = IntervalParts(run, Use.VALIDATION)
        self._stamps = RowsOnDisk(dtype=np.int64)
        self._columns: RowsOnDisk | None = None
        self._channels = 0
        self._parts: dict[str, list[slice]] = {}
        self._contents: dict[str, list[Content]] = {}

    def add(self, run: SensorRun) -> None:
        """Keep the samples of the next segment.

        Args:
            run: The sensor in the segment.
        """
        for part in self._of_intervals.of(run, self._names):
            samples, label = part.samples, part.interval.label
            if self._columns is None:
                self._channels = part.raw.shape[1]
                self._columns = RowsOnDisk((self._channels + 6 + samples.variables.shape[1],))
            first = len(self._stamps)
            self._stamps.append(samples.stamp_ns)
            self._columns.append(np.hstack([part.raw, samples.reference, samples.variables]))
            self._parts.setdefault(label, []).append(slice(first, len(self._stamps)))
            content = logged_content(run.experiment, run.sensor, part.interval)
            self._contents.setdefault(label, []).extend([] if content is None else [content])

    def samples(self) -> list[EvaluatedSamples] | None:
        """Put the samples of the validation intervals together.

        Returns:
            The samples, in the order of time; None without a validation interval.

        Raises:
            RecordingError: If an interval has no sample that can be used.
        """
        if not self._run.has(Use.VALIDATION):
            return None
        self._of_intervals.require()
        if self._columns is None:
            return []
        stamps, columns = self._stamps.mapped(), self._columns.mapped()
        return [
            EvaluatedSamples(
                interval=interval,
                content=Content.joined(self._contents[interval.label]),
                channels=self._channels,
                stamp_ns=[stamps[part] for part in self._parts[interval.label]],
                columns=[columns[part] for part in self._parts[interval.label]],
            )
            for interval in self._run.intervals(Use.VALIDATION)
        ]
