# SPDX-License-Identifier: BSD-3-Clause
"""A record that is evenly sampled and not clipped: what a spectrum and a decay can be taken of."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, read_only, require_shape
from forcetorque.base.errors import RecordingError

UNEVEN = 0.5
"""Share of the median step by which a step may differ from it: a lost sample makes it twice as long."""
JITTER = 0.1
"""Share of the median step by which steps may scatter, root mean square: at a tenth of the rate that is a phase of
0.06 rad."""
DRIFT = 0.01
"""Share of the mean rate by which the rate of a tenth of the record may differ: frequencies are off by as much."""
_PIECES, _LEAST_PIECE = 10, 50
"""Pieces that have a rate of their own, and samples of a piece at least: jitter of `JITTER` moves its rate by 0.3 %."""
FLAT = 3
"""Equal samples in a row at an end of the range that are a limit, where the signal jumps there."""
_JUMP = 5.0
"""Resolutions by which a signal jumps to a limit; the top of a smooth wave is reached by one or two."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EvenRecord:
    """Signals at even instants."""

    start_s: float
    """Instant of the first sample; s."""
    rate_hz: float
    """Rate; Hz."""
    signals: FloatArray
    """Shape (n, k)."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "signals", read_only(self.signals, name="signals", shape=(None, None)))

    def __len__(self) -> int:
        return len(self.signals)

    @property
    def time_s(self) -> FloatArray:
        """Instants; shape (n,); s."""
        return self.start_s + np.arange(len(self)) / self.rate_hz


def even_record(time_s: Any, signals: Any, *, name: str) -> EvenRecord:
    """Take a record for evenly sampled, after a look at its steps.

    Args:
        time_s: Instants; shape (n,); s.
        signals: Signals; shape (n, k).
        name: What was recorded, for messages.

    Returns:
        The record at its mean rate.

    Raises:
        RecordingError: If it is short, uneven, or lacks values.
    """
    time, values = np.asarray(time_s, dtype=np.float64), np.asarray(signals, dtype=np.float64)
    require_shape(values, name="signals", shape=(len(time), None))
    if len(time) < 2 * FLAT:
        raise RecordingError(f"{name}: expected at least {2 * FLAT} samples, got {len(time)}")
    steps = np.diff(time)
    usual = float(np.median(steps))
    if not usual > 0.0:
        raise RecordingError(f"{name}: expected instants that increase, got a usual step of {1e3 * usual:.4g} ms")
    odd = np.flatnonzero(~(np.abs(steps - usual) <= UNEVEN * usual))
    if len(odd):
        raise RecordingError(
            f"{name}: uneven sampling: {len(odd)} of {len(steps)} steps differ from the usual {1e3 * usual:.4g} ms by "
            f"more than half, the first at {time[odd[0]]:.4f} s (sample {odd[0] + 1}) is {1e3 * steps[odd[0]]:.4g} ms; "
            "a decay and a spectrum need even samples: leave the stretch out of the interval, or log without losses"
        )
    scatter = float(np.sqrt(((steps - usual) ** 2).mean())) / usual
    if scatter > JITTER:
        worst = int(np.abs(steps - usual).argmax())
        raise RecordingError(
            f"{name}: uneven sampling: steps scatter by {100 * scatter:.0f} % of the usual {1e3 * usual:.4g} ms, "
            f"most at {time[worst]:.4f} s; expected at most {100 * JITTER:.0f} %: log the sensor's own clock"
        )
    _refuse_drift(time, name)
    missing = np.flatnonzero(~np.isfinite(values).all(axis=1))
    if len(missing):
        raise RecordingError(
            f"{name}: {len(missing)} samples have no value, the first at {time[missing[0]]:.4f} s (sample "
            f"{missing[0] + 1}); leave them out of the interval"
        )
    return EvenRecord(start_s=float(time[0]), rate_hz=(len(time) - 1) / float(time[-1] - time[0]), signals=values)


def _refuse_drift(time: FloatArray, name: str) -> None:
    mean = float(time[-1] - time[0]) / (len(time) - 1)
    edges = np.linspace(0, len(time) - 1, 1 + max(min(_PIECES, len(time) // _LEAST_PIECE), 1)).astype(np.int64)
    drift = np.diff(time[edges]) / np.diff(edges) / mean - 1.0
    worst = int(np.abs(drift).argmax())
    if abs(drift[worst]) > DRIFT:
        raise RecordingError(
            f"{name}: uneven sampling: from {time[edges[worst]]:.4f} s to {time[edges[worst + 1]]:.4f} s steps are "
            f"{100 * drift[worst]:+.1f} % off the mean {1e3 * mean:.4g} ms, expected at most {100 * DRIFT:.0f} %: log "
            "the sensor's own clock, or choose a stretch of one rate"
        )


def refuse_clipped(record: EvenRecord, names: tuple[str, ...], *, where: str, limits: FloatArray | None = None) -> None:
    """Refuse a record that reached a limit.

    Args:
        record: Signals as logged.
        names: Names of the k signals.
        where: What was recorded, for messages.
        limits: Largest magnitude that each signal can have; shape (k,); None if that is not known, and only a flat top
            that the signal jumps to is a limit.

    Raises:
        RecordingError: If one did; a clipped impact has lost its height.
    """
    for k, name in enumerate(names):
        values = record.signals[:, k]
        at = np.zeros(len(values), dtype=bool) if limits is None else np.abs(values) >= limits[k]
        at |= flat_tops(values)
        if at.any():
            first = int(at.argmax())
            raise RecordingError(
                f"{where}: {name} is clipped at {record.time_s[first]:.4f} s (sample {first + 1}): it stays at "
                f"{values[first]:.6g}, and {int(at.sum())} samples are at a limit; strike less hard, or choose a wider "
                "range"
            )


def flat_tops(values: FloatArray) -> BoolArray:
    """Find where a signal stays at an end of its range after it jumped there.

    Args:
        values: The signal; shape (n,).

    Returns:
        Whether each sample is of such a top; shape (n,).
    """
    steps = np.abs(np.diff(values))
    flat = np.zeros(len(values), dtype=bool)
    if not steps.any():
        return flat
    jump = _JUMP * max(float(np.min(steps[steps > 0.0])), float(np.median(steps)))
    for end in (values.max(), values.min()):
        edges = np.flatnonzero(np.diff(np.concatenate([[0], (values == end).astype(np.int64), [0]])))
        for first, after in edges.reshape(-1, 2):
            # a weight that hangs still is an end of the range too, but it was hung on slowly, and jumps only away
            if after - first >= FLAT and first > 0 and steps[first - 1] > jump:
                flat[first:after] = True
    return flat
