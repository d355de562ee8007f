# SPDX-License-Identifier: BSD-3-Clause
"""A patch in a pressure chamber: counts of taxels whose curves, hysteresis and ailments are known."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.errors import SkinError
from forcetorque.recording import Recording, Signal, Stream
from forcetorque.simulation.skin.response import TaxelResponses
from forcetorque.simulation.trace import EPOCH_NS
from forcetorque.skin.taxels import Ailment

RATE_HZ = 50.0
"""Messages per second, as an insole sends them; Hz."""
REST_S = 5.0
"""Time without pressure at either end, by default; s."""

_GAUGE_PA = 20.0
"""Standard deviation of the gauge; Pa."""
_WRAPPED_COUNTS = 300.0
"""Fall of a taxel that wraps: more than its rest level."""
_JUMP_COUNTS, _JUMPS = 60.0, 5
"""Size and number of the jumps of a taxel that jumps."""
_RISE_COUNTS = 10.0
"""How much a taxel that rises does so at the peak."""
_NOISY_COUNTS = 6.0
"""Standard deviation of a noisy taxel; counts."""


def chamber_recording(
    responses: TaxelResponses,
    *,
    highest_pa: float,
    ramp_s: float,
    rng: np.random.Generator,
    rest_s: float = REST_S,
    broken: Mapping[int, Ailment] | None = None,
) -> Recording:
    """Record a patch while the pressure rises evenly to a peak and falls again.

    Args:
        responses: How each taxel answers.
        highest_pa: Peak of the pressure; Pa.
        ramp_s: Time up to it, and down again; s.
        rng: Source of noise.
        rest_s: Time without pressure at either end; s.
        broken: What is wrong with which taxel; nothing if None.

    Returns:
        The streams `counts`, a column per taxel, and `chamber`, on one clock.

    Raises:
        SkinError: If an ailment is of a taxel that there is not.
    """
    taxels = len(responses.rest)
    seconds = np.arange(round((2.0 * (rest_s + ramp_s)) * RATE_HZ)) / RATE_HZ
    peak_s = rest_s + ramp_s
    pressure = highest_pa * np.clip(1.0 - np.abs(seconds - peak_s) / ramp_s, 0.0, 1.0)
    peak = np.where(seconds > peak_s, highest_pa, pressure)
    fall = responses.fall(pressure[:, None], np.broadcast_to(peak[:, None], (len(seconds), taxels)))
    level = responses.rest - fall + responses.noise * rng.standard_normal(fall.shape)
    counts = np.clip(np.rint(level), 1.0, 254.0)
    for taxel, ailment in (broken or {}).items():
        if not 0 <= taxel < taxels:
            raise SkinError(f"broken: expected taxels of 0 to {taxels - 1}, got {taxel}")
        share = pressure / highest_pa
        counts[:, taxel] = _broken(ailment, level[:, taxel], float(responses.rest[taxel]), share, rng)
    stamps = EPOCH_NS + np.rint(seconds * 1e9).astype(np.int64)
    gauge = pressure + _GAUGE_PA * rng.standard_normal(len(pressure))
    return Recording(streams={stream.name: stream for stream in (_counts(stamps, counts), _chamber(stamps, gauge))})


def _broken(
    ailment: Ailment, level: FloatArray, rest: float, share: FloatArray, rng: np.random.Generator
) -> FloatArray:
    """What a broken taxel sends in place of its level; shape (n,); counts."""
    quiet = rest + rng.normal(0.0, 0.3, len(level))
    sent = level.copy()
    if ailment is Ailment.WRAPS:
        return np.asarray(np.rint(quiet - _WRAPPED_COUNTS * share) % 256.0, dtype=np.float64)
    if ailment is Ailment.RAILS:
        return np.asarray(np.where(share > 0.5, 255.0, np.rint(quiet)), dtype=np.float64)
    if ailment is Ailment.JUMPS:
        sent[rng.choice(np.arange(1, len(sent), 2), _JUMPS, replace=False)] -= _JUMP_COUNTS
    elif ailment is Ailment.NOISE:
        sent += rng.normal(0.0, _NOISY_COUNTS, len(level))
    else:
        sent = quiet + (_RISE_COUNTS * share if ailment is Ailment.RISES else 0.0)
    return np.asarray(np.clip(np.rint(sent), 1.0, 254.0), dtype=np.float64)


def _counts(stamps: np.ndarray, counts: FloatArray) -> Stream:
    names = tuple(str(k) for k in range(counts.shape[1]))
    signal = Signal(quantity="taxel_counts", values=counts, columns=names, units=("counts",) * len(names))
    return Stream(name="counts", clock="board", stamp_ns=stamps, signals={"taxel_counts": signal})


def _chamber(stamps: np.ndarray, pressure: FloatArray) -> Stream:
    signal = Signal(quantity="pressure", values=pressure[:, None], columns=("pressure",), units=("Pa",))
    return Stream(name="chamber", clock="board", stamp_ns=stamps, signals={"pressure": signal})
