# SPDX-License-Identifier: BSD-3-Clause
"""Intervals that a question is asked of."""

from __future__ import annotations

from collections.abc import Collection

from forcetorque.analysis.sensor_run import SensorRun
from forcetorque.errors import ExperimentError, known_names
from forcetorque.recording import Interval, Use


def chosen_intervals(run: SensorRun, labels: Collection[str]) -> list[Interval]:
    """Find the intervals of some labels.

    Args:
        run: The sensor, whose recording has them.
        labels: Their labels; all that are not to be ignored if none is named.

    Returns:
        Intervals in the order of time.

    Raises:
        ExperimentError: If there is none of a label.
    """
    known = {interval.label: interval for interval in run.experiment.recording.intervals}
    for label in labels:
        if label not in known:
            raise ExperimentError(f"no interval is labelled {label!r}; {known_names(label, known)}")
    chosen = [known[label] for label in labels] or [one for one in known.values() if one.use is not Use.IGNORE]
    return sorted(chosen, key=lambda interval: interval.start_ns)
