# SPDX-License-Identifier: BSD-3-Clause
"""Intervals that a question is asked of."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from forcetorque.analysis.runs.sensor_run import SensorRun
from forcetorque.errors import ExperimentError, known_names
from forcetorque.recording import Interval, Use


def chosen_intervals(runs: Sequence[SensorRun], labels: Collection[str]) -> list[tuple[SensorRun, Interval]]:
    """Find the intervals of some labels.

    Args:
        runs: The sensor in one or several recordings, of which only some may have a label.
        labels: Their labels; all that are not to be ignored if none is named.

    Returns:
        Intervals with their recordings, in the order of time within each.

    Raises:
        ExperimentError: If no recording has an interval of a label.
    """
    known = {interval.label for run in runs for interval in run.experiment.recording.intervals}
    for label in labels:
        if label not in known:
            raise ExperimentError(f"no interval is labelled {label!r}; {known_names(label, known)}")
    return [
        (run, interval)
        for run in runs
        for interval in sorted(run.experiment.recording.intervals, key=lambda interval: interval.start_ns)
        if (interval.label in labels if labels else interval.use is not Use.IGNORE)
    ]
