# SPDX-License-Identifier: BSD-3-Clause
"""Small streams and recordings that tests share, and a way to compare two recordings bit by bit."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
import pytest

from forcetorque.base.errors import ForceTorqueError
from forcetorque.recording.recording import Interval, Recording
from forcetorque.recording.stream import QUANTITIES, Labels, Signal, Stream

EPOCH_NS = 1_700_000_000_000_000_000
"""A stamp of the year 2023, so large that a float of it in seconds errs by some 100 ns."""

UNITS = {
    "position": "rad", "velocity": "rad/s", "acceleration": "rad/s2", "torque": "N m", "raw": "counts",
    "scalar": "V", "taxel_counts": "counts", "motor_current": "A", "pwm": "1", "skin_event": "1",
}  # fmt: skip
"""Unit of quantities whose columns are free to name."""


def signal(quantity: str, values: Any, columns: tuple[str, ...] | None = None) -> Signal:
    """A valid signal; columns that are free to name are a, b, c unless given."""
    array = np.asarray(values, dtype=np.float64)
    known = QUANTITIES[quantity]
    frame = "frame" if known.has_frame else None
    if known.labels is Labels.FIXED:
        return Signal(quantity=quantity, values=array, columns=known.columns, units=known.units, frame=frame)
    names = columns or tuple("abcdefgh"[: array.shape[1]])
    return Signal(quantity=quantity, values=array, columns=names, units=(UNITS[quantity],) * len(names), frame=frame)


def stream(stamp_ns: Any, *signals: Signal, name: str = "s", clock: str = "robot", sequence: Any = None) -> Stream:
    """A stream of these signals; without any, one of positions that are all zero."""
    held = signals or (signal("position", np.zeros((len(stamp_ns), 1))),)
    return Stream(name=name, clock=clock, stamp_ns=stamp_ns, sequence=sequence, signals={s.quantity: s for s in held})


def recording(*streams: Stream, **rest: Any) -> Recording:
    """A recording of these streams."""
    return Recording(streams={s.name: s for s in streams}, **rest)


def even_stamps(count: int, *, rate_hz: float = 100.0) -> Any:
    """Evenly spaced stamps from the epoch on; shape (count,); ns."""
    return EPOCH_NS + np.rint(np.arange(count) * 1e9 / rate_hz).astype(np.int64)


def jittered_stamps(count: int, *, rate_hz: float = 100.0, seed: int) -> Any:
    """Increasing stamps, each up to a fifth of a period off; shape (count,); ns."""
    jitter = np.random.default_rng(seed).uniform(-0.2, 0.2, count)
    return EPOCH_NS + np.rint((np.arange(count) + jitter) * 1e9 / rate_hz).astype(np.int64)


def described(whole: Recording) -> dict[str, Any]:
    """Everything that a recording holds, as plain values and raw bytes that compare bit by bit."""
    return {
        "streams": {key: _stream_described(held) for key, held in whole.streams.items()},
        "order": list(whole.streams),
        "intervals": [_interval_described(interval) for interval in whole.intervals],
        "findings": list(whole.findings),
        "origin": dict(whole.origin),
    }


def _stream_described(held: Stream) -> dict[str, Any]:
    return {
        "name": held.name,
        "clock": held.clock,
        "stamp_ns": _bits(held.stamp_ns),
        "sequence": None if held.sequence is None else _bits(held.sequence),
        "signals": [(key, s.quantity, _bits(s.values), s.columns, s.units, s.frame) for key, s in held.signals.items()],
    }


def _interval_described(interval: Interval) -> tuple[Any, ...]:
    support = interval.support
    supported = None if support is None else (support.frame, _bits(support.gravity_direction))
    return (interval.label, interval.start_ns, interval.end_ns, interval.use, supported)


def _bits(array: Any) -> tuple[str, tuple[int, ...], bytes]:
    return (array.dtype.str, array.shape, array.tobytes())


@contextmanager
def refused(kind: type[ForceTorqueError], match: str) -> Iterator[None]:
    """Expect an error of the library with this message, on one line."""
    with pytest.raises(kind, match=match) as caught:
        yield
    assert type(caught.value) is kind
    assert "\n" not in str(caught.value)
