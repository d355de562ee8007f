# SPDX-License-Identifier: BSD-3-Clause
"""Times of a variable that has none: those of another stream's rows."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Literal

import numpy as np

from forcetorque.arrays import IntArray
from forcetorque.errors import FormatError
from forcetorque.recording import Finding, Signal, Stream


def rows_of_another(
    place: str,
    name: str,
    signals: Mapping[str, Signal],
    other: Stream,
    *,
    shift_rows: int | Literal["estimated"] | None,
) -> tuple[Stream, tuple[Finding, ...]]:
    """Give samples without times those of another stream's rows.

    Args:
        place: File and array, for messages.
        name: Name of the stream.
        signals: Its samples.
        other: Stream with times.
        shift_rows: By how many of its rows this one begins later; `estimated` for a pressure beside counts of taxels.

    Returns:
        The stream, without samples before the first and after the last time, and what was found.

    Raises:
        FormatError: If no sample lies between the two.
    """
    rows = len(next(iter(signals.values())).values)
    findings: list[Finding] = []
    if shift_rows == "estimated":
        stamps, finding = _estimated(name, signals, other)
        findings.append(finding)
        kept = (stamps >= other.stamp_ns.min()) & (stamps <= other.stamp_ns.max())
    else:
        places = np.arange(rows) + (shift_rows or 0)
        kept = (places >= 0) & (places < len(other))
        stamps = other.stamp_ns[np.clip(places, 0, len(other) - 1)]
    if not kept.any():
        raise FormatError(
            f"{place}: expected rows beside some of the {len(other)} of {other.name!r}, got none of {rows} with "
            f"shift_rows = {shift_rows}; correct the shift"
        )
    if not kept.all():
        left = int(np.count_nonzero(~kept))
        text = f"{left} of {rows} rows lie before or after {other.name!r}, and are left out"
        findings.append(Finding(stream=name, kind="cropped", message=text, count=left))
    cut = {key: replace(signal, values=signal.values[kept]) for key, signal in signals.items()}
    return Stream(name=name, clock=other.clock, stamp_ns=stamps[kept], signals=cut), tuple(findings)


def _estimated(name: str, signals: Mapping[str, Signal], other: Stream) -> tuple[IntArray, Finding]:
    from forcetorque.skin import match_pressure  # here because most logs have no skin

    if set(signals) != {"pressure"} or "taxel_counts" not in other.signals:
        raise FormatError(
            f'shift_rows = "estimated": expected a pressure with the rows of a stream of taxel_counts, got '
            f"{', '.join(signals)} with those of {', '.join(other.signals)}; state a number of rows"
        )
    start = other.stamp_ns[0]
    seconds = (other.stamp_ns - start) * 1e-9
    pressure = signals["pressure"].values[:, 0]
    clock = match_pressure(seconds, other.signals["taxel_counts"].values, pressure)
    stamps = start + np.rint((clock.start_s + clock.period_s * np.arange(len(pressure))) * 1e9).astype(np.int64)
    period = float(seconds[-1]) / (len(seconds) - 1)
    text = (
        f"{len(pressure)} rows without a clock beside {len(seconds)} of {other.name!r}: their steps agree best if the "
        f"first is {clock.start_s:+.2f} s from the first of {other.name!r} and rows are {1e3 * clock.period_s:.2f} ms "
        f"apart, where those of {other.name!r} are {1e3 * period:.2f} ms: correlation {clock.correlation:.3f}, by a "
        f"shift alone {clock.shifted_correlation:.3f}"
    )
    return stamps, Finding(
        stream=name, kind="estimated_clock", message=text, count=len(pressure), size=clock.start_s, unit="s"
    )
