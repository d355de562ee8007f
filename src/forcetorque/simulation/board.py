# SPDX-License-Identifier: BSD-3-Clause
"""What the board of a sensor sends: many apply the factory's matrix and never send counts."""

from __future__ import annotations

from dataclasses import replace

from forcetorque.arrays import FloatArray, require_shape
from forcetorque.errors import RecordingError
from forcetorque.recording import QUANTITIES, Recording, Signal


def calibrated_by_board(recording: Recording, stream: str, *, matrix: FloatArray, frame: str) -> Recording:
    """Replace the counts of a sensor by the wrench that its board makes of them.

    Args:
        recording: The recording.
        stream: Stream with the counts.
        matrix: Matrix that the board applies; shape (6, c); N/count, N m/count.
        frame: Frame of the sensor.

    Returns:
        The recording with `wrench` in place of `raw` in that stream.

    Raises:
        RecordingError: If the stream holds a wrench already.
    """
    source = recording.stream(stream)
    raw = source.signal("raw")
    if "wrench" in source.signals:
        raise RecordingError(f"stream {stream!r}: expected counts alone, got a wrench beside them")
    require_shape(matrix, name="matrix", shape=(6, len(raw.columns)))
    quantity = QUANTITIES["wrench"]
    wrench = Signal(
        quantity=quantity.name,
        values=raw.values @ matrix.T,
        columns=quantity.columns,
        units=quantity.units,
        frame=frame,
    )
    signals = {
        "wrench" if name == "raw" else name: wrench if name == "raw" else s for name, s in source.signals.items()
    }
    return replace(recording, streams={**recording.streams, stream: replace(source, signals=signals)})
