# SPDX-License-Identifier: BSD-3-Clause
"""Where one number per instant comes from, such as the temperature of a sensor."""

from __future__ import annotations

from dataclasses import dataclass

from forcetorque.arrays import FloatArray, IntArray
from forcetorque.recording.alignment import interpolate
from forcetorque.recording.recording import Recording


@dataclass(frozen=True, slots=True, kw_only=True)
class ScalarSource:
    """One column of a recording."""

    stream: str
    """Name of the stream."""
    quantity: str
    """Name of the quantity."""
    column: str
    """Name of the column."""

    def unit(self, recording: Recording) -> str:
        """Tell its unit.

        Args:
            recording: The recording.

        Returns:
            Unit of the column.

        Raises:
            RecordingError: If stream, quantity or column are not there.
        """
        signal = recording.stream(self.stream).signal(self.quantity)
        signal.column(self.column)
        return signal.units[signal.columns.index(self.column)]

    def at(self, recording: Recording, at_ns: IntArray) -> FloatArray:
        """Interpolate over time; never across gaps.

        Args:
            recording: The recording.
            at_ns: Instants; shape (m,); ns.

        Returns:
            Values; shape (m,); NaN in gaps and outside the stream.
        """
        stream = recording.stream(self.stream)
        return interpolate(stream, stream.signal(self.quantity).column(self.column)[:, None], at_ns)[:, 0]
