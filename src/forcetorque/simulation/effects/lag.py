# SPDX-License-Identifier: BSD-3-Clause
"""First-order lag: what follows a cause with a time constant, as creep and slow warming do."""

from __future__ import annotations

import numpy as np

from forcetorque.arrays import FloatArray


def lagging(values: FloatArray, time_constant_s: float, *, rate_hz: float) -> FloatArray:
    """Put evenly spaced samples behind a first-order lag that is at rest when they start.

    Args:
        values: Samples; shape (n, ...).
        time_constant_s: Time in which 63 % of a step has come; s.
        rate_hz: Rate of the samples; Hz.

    Returns:
        The late values; same shape.
    """
    from scipy.signal import lfilter  # here because importing it takes longer than most commands

    keep = float(np.exp(-1.0 / (time_constant_s * rate_hz)))
    late: FloatArray = lfilter([1.0 - keep], [1.0, -keep], values, axis=0, zi=keep * values[:1])[0]
    return late
