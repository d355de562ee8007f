# SPDX-License-Identifier: BSD-3-Clause
"""A signal at even instants, with the frequencies up to which its clock lets anything be said of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only, require_shape
from forcetorque.base.errors import RecordingError
from forcetorque.sensor.bandwidth.even_record import even_record

GAP_SHARE = 0.1
"""Periods of the highest frequency in the longest pause of an uneven clock: a line drawn over a tenth of a period is
off by a twentieth of the amplitude."""
LEAST_SAMPLES = 32
"""Samples of a signal."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EvenedSignal:
    """One signal at even instants."""

    start_s: float
    """Instant of the first sample; s."""
    rate_hz: float
    """Rate; Hz."""
    values: FloatArray
    """Samples; shape (n,)."""
    highest_hz: float
    """Frequency up to which it tells of vibrations: half of the rate, less where the clock is uneven; Hz."""
    longest_step_s: float
    """Longest time between samples that were taken; s."""
    even: bool
    """Whether the samples are those that were taken; if not, straight lines through these."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "values", read_only(self.values, name="values", shape=(None,)))

    @property
    def duration_s(self) -> float:
        """Time that it lasts, one period for every sample; s."""
        return len(self.values) / self.rate_hz

    @property
    def time_s(self) -> FloatArray:
        """Instants; shape (n,); s."""
        return self.start_s + np.arange(len(self.values)) / self.rate_hz


def evened(time_s: Any, values: Any, *, name: str) -> EvenedSignal:
    """Bring a signal to even instants.

    Samples that are even, as `even_record` takes them for, stay as they are. Others are read off straight lines at the
    mean rate, and only frequencies of which the longest pause is a small part of a period are kept for later.

    Args:
        time_s: Instants, not falling; shape (n,); s. Of several samples of one instant the first is taken.
        values: The signal; shape (n,). Samples that are no finite number are left out, as if they had not been logged.
        name: What it is, for messages.

    Returns:
        The signal.

    Raises:
        RecordingError: If it is short, its time falls, or it never changes.
    """
    time, signal = np.asarray(time_s, dtype=np.float64), np.asarray(values, dtype=np.float64)
    require_shape(time, name="time_s", shape=(None,))
    require_shape(signal, name="values", shape=time.shape)
    if (np.diff(time) < 0.0).any():
        k = int((np.diff(time) < 0.0).argmax())
        raise RecordingError(
            f"{name}: expected instants that do not fall, got {time[k + 1]:.4f} s after {time[k]:.4f} s"
        )
    known = np.isfinite(signal) & np.isfinite(time)
    known[1:] &= np.diff(time) > 0.0
    time, signal = time[known], signal[known]
    if len(time) < LEAST_SAMPLES:
        raise RecordingError(f"{name}: expected at least {LEAST_SAMPLES} samples with a value, got {len(time)}")
    if np.ptp(signal) == 0.0:
        raise RecordingError(
            f"{name}: expected a column that changes, got {signal[0]:g} in all of {len(signal)} samples; choose "
            "another, or see why it was not logged"
        )
    longest = float(np.diff(time).max())
    try:
        record = even_record(time, signal[:, None], name=name)
    except RecordingError:
        rate = (len(time) - 1) / float(time[-1] - time[0])
        grid = time[0] + np.arange(len(time)) / rate
        return EvenedSignal(
            start_s=float(time[0]),
            rate_hz=rate,
            values=np.interp(grid, time, signal),
            highest_hz=min(GAP_SHARE / longest, 0.5 * rate),
            longest_step_s=longest,
            even=False,
        )
    return EvenedSignal(
        start_s=record.start_s,
        rate_hz=record.rate_hz,
        values=signal,
        highest_hz=0.5 * record.rate_hz,
        longest_step_s=longest,
        even=True,
    )
