# SPDX-License-Identifier: BSD-3-Clause
"""What a log holds of a sensor, by which samples are known again where stamps say nothing."""

from __future__ import annotations

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.calibration import Content
from forcetorque.experiment.content import Experiment, ExperimentSensor
from forcetorque.recording import Interval
from forcetorque.recording.fingerprint import fingerprint, kept_hashes, window_hashes


def logged_content(experiment: Experiment, sensor: ExperimentSensor, interval: Interval) -> Content | None:
    """Say by what the readings in an interval are known again.

    Args:
        experiment: The experiment.
        sensor: One of its sensors.
        interval: An interval of its recording.

    Returns:
        Hashes of windows of samples; None where these are too few, or hardly change.
    """
    windows = fingerprint(_logged(experiment, sensor, interval))
    return Content(quantity=sensor.quantity, windows=windows) if windows else None


class LoggedReadings:
    """Readings in an interval, to be compared with what a calibration has seen."""

    def __init__(self, experiment: Experiment, sensor: ExperimentSensor, interval: Interval) -> None:
        """Take them from a recording.

        Args:
            experiment: The experiment.
            sensor: One of its sensors.
            interval: An interval of its recording.
        """
        self._quantity = sensor.quantity
        self._hashes = window_hashes(_logged(experiment, sensor, interval))

    def were_in(self, content: Content | None) -> bool | None:
        """Tell whether some of them were seen before, under whatever stamps.

        Args:
            content: By what readings that were seen are known again; None where nobody knows.

        Returns:
            Whether they were; None where that cannot be told: nobody knows, they are of another quantity, or hardly
            change.
        """
        if content is None or content.quantity != self._quantity or not len(self._hashes):
            return None
        return bool(np.isin(kept_hashes(content.windows), self._hashes).any())


def _logged(experiment: Experiment, sensor: ExperimentSensor, interval: Interval) -> FloatArray:
    stream = experiment.recording.stream(sensor.stream)
    values: FloatArray = stream.signal(sensor.quantity).values[interval.holds(stream.stamp_ns)]
    return values
