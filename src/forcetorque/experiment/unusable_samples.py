# SPDX-License-Identifier: BSD-3-Clause
"""What results leave out of the intervals of the sensors that they read, because it says nothing of the load."""

from __future__ import annotations

from collections.abc import Collection, Iterator

import numpy as np

from forcetorque.base.errors import RecordingError
from forcetorque.experiment.experiment import Experiment
from forcetorque.recording.recording import Use
from forcetorque.results.unusable_samples import UnusableSamples
from forcetorque.robot.mechanics.samples import pick_samples


def unusable_samples(experiment: Experiment, *, sensor: str | None, uses: Collection[str]) -> Iterator[UnusableSamples]:
    """Count what is left out of the sensors of an experiment that were read so far.

    Args:
        experiment: The experiment.
        sensor: Name of the only sensor that counts; all if None.
        uses: Uses of the intervals that count; all but ignored ones if empty.

    Yields:
        A row for every sensor and interval of which something is left out.
    """
    for name, quality in experiment.qualities.items():
        if sensor not in (None, name):
            continue
        stream = experiment.recording.stream(experiment.sensor(name).stream)
        for interval in experiment.recording.intervals:
            if interval.use is Use.IGNORE or (uses and interval.use not in uses):
                continue
            try:
                _, among = pick_samples(experiment.recording, stream, interval)
            except RecordingError:  # nothing of the sensor lies in it, so nothing is left out
                continue
            if counts := quality.counted(among):
                yield UnusableSamples(
                    sensor=name,
                    recording=experiment.name,
                    interval=interval.label,
                    use=interval.use.value,
                    samples=int(np.count_nonzero(among)),
                    frozen=counts.frozen,
                    saturated=counts.saturated,
                    repeated=counts.repeated,
                )
