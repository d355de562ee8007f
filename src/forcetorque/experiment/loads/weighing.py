# SPDX-License-Identifier: BSD-3-Clause
"""What a sensor read of loads in an interval, and its means: the same for a wrist and for links of a robot."""

from __future__ import annotations

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.errors import ExperimentError
from forcetorque.experiment.content import Experiment, ExperimentSensor
from forcetorque.experiment.sample_quality import sample_quality
from forcetorque.noise import means_over, window_for
from forcetorque.recording import Interval, Use

MOST_ROWS = 3600
"""Means of an interval, at most: an hour has means of 1 s, a day of half a minute."""


def weighing_readings(
    experiment: Experiment, sensor: ExperimentSensor, interval: Interval
) -> tuple[IntArray, FloatArray]:
    """Read a sensor in an interval, without samples that say nothing of its load or lie in an ignored interval.

    Args:
        experiment: The experiment, of which the recording is used.
        sensor: The sensor; raw counts are read by its prior.
        interval: The interval.

    Returns:
        Instants, shape (n,), ns; and wrenches, NaN in gaps, shape (n, 6), N, N m.

    Raises:
        ExperimentError: If there are raw counts and no prior.
    """
    stream = experiment.recording.stream(sensor.stream)
    inside = interval.holds(stream.stamp_ns) & ~sample_quality(experiment, sensor).unusable
    for other in experiment.recording.intervals:
        if other.use is Use.IGNORE:
            inside &= ~other.holds(stream.stamp_ns)
    reading = stream.signal(sensor.quantity).values[inside]
    if sensor.quantity == "raw":
        if sensor.prior is None:
            raise ExperimentError(
                f"sensor {sensor.name!r}: expected prior, a matrix that reads it roughly, without which nobody tells "
                "loads and matrix apart; or state mass_kg and centre_of_mass_m of every [[load]]"
            )
        reading = reading @ sensor.prior.T
    return stream.stamp_ns[inside], reading


def weighing_means(time_s: FloatArray, values: FloatArray) -> tuple[FloatArray, FloatArray, IntArray]:
    """Average the samples of an interval over windows in which noise is nearly white, and that are not too many.

    Args:
        time_s: Times; shape (n,); s.
        values: What is averaged; shape (n, k).

    Returns:
        Middles of the windows, shape (w,), s; means, shape (w, k); and the number of samples of each, shape (w,).
    """
    length = float(time_s[-1] - time_s[0]) if len(time_s) else 0.0
    return means_over(time_s, values, max(window_for(time_s), length / MOST_ROWS))
