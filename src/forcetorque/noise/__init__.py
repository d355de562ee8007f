# SPDX-License-Identifier: BSD-3-Clause
"""What measurements do beside what they measure: fast noise that averages out, and slow noise that does not."""

from forcetorque.noise.mean_errors import MeanError, mean_error, means_in_windows, window_for
from forcetorque.noise.means import WINDOW_S, means_over, one_after_another
from forcetorque.noise.regression import CONFIDENCE, SHAPES, Regression, half_width, log_prior, regress
from forcetorque.noise.slow import CANDIDATES, SlowNoise
from forcetorque.noise.stationary import SampleStatistics, is_stationary, sample_statistics
from forcetorque.noise.timeline import Timeline

__all__ = [
    "CANDIDATES",
    "CONFIDENCE",
    "SHAPES",
    "WINDOW_S",
    "MeanError",
    "Regression",
    "SampleStatistics",
    "SlowNoise",
    "Timeline",
    "half_width",
    "is_stationary",
    "log_prior",
    "mean_error",
    "means_in_windows",
    "means_over",
    "one_after_another",
    "regress",
    "sample_statistics",
    "window_for",
]
