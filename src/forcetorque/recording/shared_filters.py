# SPDX-License-Identifier: BSD-3-Clause
"""Rates and second derivatives of streams that several analyses look at: every block of rows is filtered once."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.recording.smoothing import FilteredColumns, SavitzkyGolay
from forcetorque.recording.stream import Signal, Stream

_BLOCK: Final = 8192
"""Rows that are filtered at a time: long against the window of a filter."""
_DERIVATIVES: Final = (1, 2)


class SharedFilters:
    """Derivatives of signals of one recording, kept as long as this is."""

    def __init__(self) -> None:
        """Begin without any."""
        self._kept: dict[tuple[str, int, SavitzkyGolay], _Derivatives] = {}

    def at(
        self, stream: Stream, signal: Signal, columns: Sequence[int], window: SavitzkyGolay, rows: IntArray
    ) -> list[FloatArray]:
        """Differentiate some columns in some rows, as `FilteredColumns` does.

        Args:
            stream: A stream of the recording.
            signal: One of its signals.
            columns: Columns of the signal, k of them.
            window: The filter.
            rows: Increasing rows of the stream; shape (m,).

        Returns:
            Rates and second derivatives; shape (m, k) each; the unit of the signal per s, per s2; NaN as of
            `FilteredColumns`.
        """
        key = (stream.name, id(signal), window)  # the recording keeps the signal
        if key not in self._kept:
            self._kept[key] = _Derivatives(stream.stamp_ns, signal.values, window)
        return self._kept[key].at(list(columns), rows)


class _Derivatives:
    def __init__(self, stamp_ns: IntArray, values: FloatArray, window: SavitzkyGolay) -> None:
        self._stamp_ns, self._values, self._window = stamp_ns, values, window
        # pages that are not written to take no memory
        self._results = [np.empty(values.shape) for _ in _DERIVATIVES]
        self._done = np.zeros((-(-len(values) // _BLOCK), values.shape[1]), dtype=bool)
        self._filters: dict[tuple[int, ...], FilteredColumns] = {}

    def at(self, columns: list[int], rows: IntArray) -> list[FloatArray]:
        if not len(rows):
            return [np.empty((0, len(columns))) for _ in _DERIVATIVES]
        blocks = rows // _BLOCK
        for block in blocks[np.flatnonzero(np.diff(blocks, prepend=-1))].tolist():
            missing = [column for column in columns if not self._done[block, column]]
            if missing:
                self._fill(block, missing)
        if rows[-1] - rows[0] == len(rows) - 1:
            own = slice(int(rows[0]), int(rows[-1]) + 1)
            return [result[own][:, columns] for result in self._results]
        return [result[rows[:, None], columns] for result in self._results]

    def _fill(self, block: int, columns: list[int]) -> None:
        key = tuple(columns)
        if key not in self._filters:
            self._filters[key] = FilteredColumns(
                self._stamp_ns, self._values, self._window, columns=columns, derivatives=_DERIVATIVES
            )
        own = np.arange(block * _BLOCK, min((block + 1) * _BLOCK, len(self._values)))
        for result, values in zip(self._results, self._filters[key].at(own), strict=True):
            result[own[:, None], columns] = values
        self._done[block, columns] = True
