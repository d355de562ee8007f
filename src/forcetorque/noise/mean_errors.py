# SPDX-License-Identifier: BSD-3-Clause
"""How well a recording tells the mean of a signal: one rule for evaluations, comparisons and validations."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import FloatArray, read_only, require_shape
from forcetorque.noise.means import WINDOW_S, means_over
from forcetorque.noise.regression import half_width, regress
from forcetorque.noise.timeline import Timeline

_WINDOWS = 120.0
"""Windows of a recording that is shorter than so many seconds."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MeanError:
    """What is known of the plain means of k signals over the samples of a recording."""

    standard_error: FloatArray
    """Standard errors; shape (k,); NaN for a single value."""
    degrees_of_freedom: FloatArray
    """Degrees of freedom of Student's t; shape (k,); 0 where an error cannot be told."""

    def __post_init__(self) -> None:
        k = len(self.standard_error)
        for field in ("standard_error", "degrees_of_freedom"):
            object.__setattr__(self, field, read_only(getattr(self, field), name=field, shape=(k,)))

    @property
    def half_width(self) -> FloatArray:
        """Half-widths of the 95 % intervals; shape (k,); infinite where an error cannot be told."""
        return half_width(self.standard_error, self.degrees_of_freedom)


def mean_error(values: Any, time_s: Any) -> MeanError:
    """Estimate how far means over a recording are from what they would be over one without end.

    Noise is white plus a slow offset. By simulation of recordings of 60 to 300 s, the 95 % intervals hold the mean in
    96 % to 99 % under white noise, and in 91 % and more under slow noise that shows and forgets itself within the
    recording; in 83 % if it takes three times as long. No recording tells of an offset that wanders as slowly as the
    recording is long and hides in the white part: with a tenth of its deviation, 61 %.

    Args:
        values: Signals, all finite; shape (n, k), n at least 1.
        time_s: Instants of the samples, not falling; shape (n,); s.

    Returns:
        Standard errors of the means over all samples, and their degrees of freedom.

    Raises:
        ShapeError: If the shapes differ.
        FitError: If time falls, or anything is no finite number.
    """
    signals = np.asarray(values, dtype=np.float64)
    require_shape(signals, name="values", shape=(None, None))
    line, means = means_in_windows(time_s, signals)
    plain = signals.mean(axis=0)
    fit = regress(line, np.ones((len(line), 1)), means - plain, about=np.zeros((signals.shape[1], 1)))
    error = fit.standard_error[:, 0]
    return MeanError(
        standard_error=np.where(np.isfinite(error), error, np.nan), degrees_of_freedom=fit.degrees_of_freedom[:, 0]
    )


def means_in_windows(time_s: Any, columns: Any) -> tuple[Timeline, FloatArray]:
    """Average signals over windows of 1 s, or a hundred and twentieth of what was recorded if that is shorter.

    Args:
        time_s: Instants of the samples, not falling; shape (n,); s.
        columns: Signals, all finite; shape (n, k).

    Returns:
        When the means were taken, in windows, so that noise of a short recording is slow that is slow against it; and
        the means, shape (m, k).

    Raises:
        ShapeError: If the shapes differ.
        FitError: If time falls, or anything is no finite number.
    """
    time = np.asarray(time_s, dtype=np.float64)
    window = window_for(time)
    middle, means, counts = means_over(time, columns, window)
    return Timeline.of(middle / window, share=counts / np.median(counts)), means


def window_for(time_s: FloatArray) -> float:
    """Choose the length of windows for a recording.

    Args:
        time_s: Instants of the samples, not falling; shape (n,); s.

    Returns:
        1 s, or a hundred and twentieth of what was recorded if that is shorter; s.
    """
    recorded = float(np.median(np.diff(time_s))) * len(time_s) if len(time_s) > 1 else 0.0  # without pauses
    return min(WINDOW_S, recorded / _WINDOWS) if recorded > 0.0 else WINDOW_S
